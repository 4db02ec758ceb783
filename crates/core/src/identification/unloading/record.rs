//! The stiffness of an unloading, by a power law fitted to a part of it (Oliver & Pharr, J. Mater. Res. 7 (1992) 1564).
//!
//! P = B (h − h_f)^m is fitted as h = h_f + c (P/P_max)^{1/m}: it is the penetration that scatters. At the largest force
//! S = dP/dh = m P_max/c, with the standard error by those of c and m. P_max and h_max are those of the last point under nearly the largest
//! force: the end of a hold.

use super::error::UnloadingError;
use crate::identification::least_squares::{self, End, Linearised};
use crate::identification::pattern::Pattern;

/// Part of the largest force that the last point before the unloading has at least.
const HELD: f64 = 0.995;
/// Numbers of the power law: h_f, c and m.
const LAW: usize = 3;
/// Fewest points of a fit.
const FEWEST: usize = 5;
/// Part of the largest force by which noise makes it rise during unloading.
const NOISE: f64 = 0.02;
/// 1/m from which the search starts, and between which it has to stay.
const START: f64 = 1.0 / 1.5;
const EXPONENTS: [f64; 2] = [0.05, 2.0];
/// Least standard error of a stiffness, relative: records of a few digits know no more, and records without scatter none.
const LEAST_ERROR: f64 = 1e-6;

/// The stiffness that was measured by an unloading.
#[derive(Debug, Clone, PartialEq)]
pub struct Unloading {
    /// Force P_max at which the unloading begins, a pressure times a length squared.
    pub force: f64,
    /// Penetration h_max there, a length.
    pub penetration: f64,
    /// Standard deviation of a penetration, a length: the one known of the first point, else the one about the fit.
    pub scatter: f64,
    /// S = dP/dh there, a force per length.
    pub stiffness: f64,
    /// Standard error of S by the scatter.
    pub stiffness_error: f64,
    /// Exponent m of the power law.
    pub exponent: f64,
    /// Penetration h_f that it leaves, a length.
    pub residual_depth: f64,
    /// Forces of the fitted points.
    pub forces: Vec<f64>,
    /// Penetrations of the fitted points, lengths.
    pub penetrations: Vec<f64>,
    /// Penetrations of the power law there, lengths.
    pub fitted: Vec<f64>,
    /// Root mean square of measured minus fitted penetrations, a length.
    pub rms: f64,
    /// Whether the residuals are a pattern over the force.
    pub is_systematic: bool,
}

impl Unloading {
    /// Parts of the largest force between which unloading is fitted where nothing else is said.
    pub const PART: [f64; 2] = [0.25, 0.95];

    /// The unloading of a whole test, in the order in which it was measured: forces, penetrations and their standard deviations where they
    /// are known. Fitted are the points between two parts of the largest force.
    ///
    /// # Errors
    /// [`UnloadingError`].
    pub fn new(
        forces: &[f64],
        penetrations: &[f64],
        deviations: Option<&[f64]>,
        part: [f64; 2],
    ) -> Result<Self, UnloadingError> {
        check(forces, penetrations, deviations)?;
        let [low, high] = part;
        if !(low > 0.0 && low < high && high < 1.0) {
            return Err(UnloadingError::Part(part));
        }
        let largest = forces.iter().copied().fold(0.0, f64::max);
        let top = forces.iter().rposition(|&force| force >= HELD * largest).unwrap_or(0);
        let force = forces[top];
        let end = top + forces[top..].iter().position(|&x| x < low * force).unwrap_or(forces.len() - top);
        let taken: Vec<usize> = (top..end).filter(|&i| forces[i] <= high * force).collect();
        let (Some(&from), Some(&to)) = (taken.first(), taken.last()) else {
            return Err(UnloadingError::Missing { largest, high });
        };
        reloaded(&forces[top..=to], force).map_or(Ok(()), |[least, most]| {
            let [from, to] = [top + least, top + most];
            Err(UnloadingError::Reloaded { from, to, forces: [forces[from], forces[to]] })
        })?;
        if taken.len() < FEWEST {
            return Err(UnloadingError::Few { count: taken.len(), least: FEWEST, part });
        }
        let of = |all: &[f64]| taken.iter().map(|&i| all[i]).collect::<Vec<f64>>();
        let points = Points {
            parts: taken.iter().map(|&i| forces[i] / force).collect(),
            penetrations: of(penetrations),
            deviations: deviations.map(of),
        };
        let [_, rise] = points.line(&points.penetrations, 1.0);
        if rise.is_nan() || rise <= 0.0 {
            return Err(UnloadingError::Rises { from, to, slope: rise / force });
        }
        let law = points.law().ok_or(UnloadingError::NoPowerLaw)?;
        let [residual_depth, c, n] = law.place;
        let stiffness = force / (c * n);
        Ok(Self {
            force,
            penetration: penetrations[top],
            scatter: deviations.map_or(law.scatter, |all| all[top]),
            stiffness,
            stiffness_error: stiffness * (law.recovery_error / (c * n)).max(LEAST_ERROR),
            exponent: 1.0 / n,
            residual_depth,
            forces: of(forces),
            fitted: points.penetrations.iter().zip(&law.lengths).map(|(measured, by)| measured + by).collect(),
            penetrations: points.penetrations,
            rms: (least_squares::sum(&law.lengths) / law.lengths.len() as f64).sqrt(),
            is_systematic: Pattern::of(&law.lengths).is_systematic(),
        })
    }

    /// Fitted points less the three numbers of the power law.
    pub fn freedom(&self) -> usize {
        self.forces.len() - LAW
    }
}

/// Refuses unequal numbers of values, and values that are none.
fn check(forces: &[f64], penetrations: &[f64], deviations: Option<&[f64]>) -> Result<(), UnloadingError> {
    let columns = [("force", Some(forces)), ("penetration", Some(penetrations)), ("standard deviation", deviations)];
    for (name, column) in columns.into_iter().filter_map(|(name, column)| Some((name, column?))) {
        if column.len() != forces.len() {
            return Err(UnloadingError::Unequal(forces.len(), column.len()));
        }
        let is_good = |x: f64| x.is_finite() && (name != "standard deviation" || x > 0.0);
        if let Some(index) = column.iter().position(|&x| !is_good(x)) {
            return Err(UnloadingError::Value { index, name, value: column[index] });
        }
    }
    Ok(())
}

/// Indices of a least force and of a later one beyond noise above it.
fn reloaded(forces: &[f64], largest: f64) -> Option<[usize; 2]> {
    let mut least = 0;
    for (index, &force) in forces.iter().enumerate() {
        if force < forces[least] {
            least = index;
        }
        if force - forces[least] > NOISE * largest {
            let most = (index..forces.len()).max_by(|&a, &b| forces[a].total_cmp(&forces[b]))?;
            return Some([least, most]);
        }
    }
    None
}

/// Points of an unloading: forces over P_max, penetrations and their deviations.
struct Points {
    parts: Vec<f64>,
    penetrations: Vec<f64>,
    deviations: Option<Vec<f64>>,
}

/// The power law of an unloading.
struct Law {
    /// h_f and c, lengths, and n = 1/m.
    place: [f64; LAW],
    /// Fitted minus measured penetrations, lengths.
    lengths: Vec<f64>,
    /// Standard deviation of a penetration about the law, a length.
    scatter: f64,
    /// Standard error of P_max/S = c n, a length.
    recovery_error: f64,
}

impl Points {
    /// Length by which a residual is measured: the deviation of its point, or the largest penetration.
    fn deviation(&self, i: usize) -> f64 {
        let largest = || self.penetrations.iter().fold(f64::MIN_POSITIVE, |most, h| most.max(h.abs()));
        self.deviations.as_ref().map_or_else(largest, |all| all[i])
    }

    /// a and b of a + b (P/P_max)ⁿ with a given n, by least squares of values at the points.
    fn line(&self, values: &[f64], n: f64) -> [f64; 2] {
        let mut sums = [0.0; 5];
        for (i, (part, value)) in self.parts.iter().zip(values).enumerate() {
            let (x, w) = (part.powf(n), self.deviation(i).powi(-2));
            [w, w * x, w * x * x, w * value, w * value * x].iter().zip(&mut sums).for_each(|(term, sum)| *sum += term);
        }
        let [w, x, xx, value, product] = sums;
        let b = (w * product - x * value) / (w * xx - x * x);
        [(value - b * x) / w, b]
    }

    /// The power law; `None` where its fit does not converge. The search is for n alone: h_f and c are the best ones at each n (Golub & Pereyra,
    /// SIAM J. Numer. Anal. 10 (1973) 413).
    fn law(&self) -> Option<Law> {
        let at = |t: &[f64]| {
            let n = START * t[0].exp();
            if !(EXPONENTS[0]..EXPONENTS[1]).contains(&n) {
                return Err(());
            }
            let [h, c] = self.line(&self.penetrations, n);
            let slopes: Vec<f64> = self.parts.iter().map(|part| c * n * part.ln() * part.powf(n)).collect();
            let taken_up = self.line(&slopes, n);
            let row = |i: usize| {
                let (power, deviation) = (self.parts[i].powf(n), self.deviation(i));
                let slope = slopes[i] - taken_up[0] - taken_up[1] * power;
                ((h + c * power - self.penetrations[i]) / deviation, vec![slope / deviation])
            };
            let (residuals, jacobian) = (0..self.parts.len()).map(row).unzip();
            Ok(Linearised { residuals, jacobian, model: [h, c, n] })
        };
        let found = least_squares::minimise(vec![0.0], at).ok().filter(|found| found.end == End::Converged)?;
        let Linearised { residuals, model: place, .. } = found.linearised;
        let [_, c, n] = place;
        let row = |(i, part): (usize, &f64)| {
            let power = part.powf(n);
            // By h_f, ln c and ln n, in lengths of c.
            [1.0, power, n * part.ln() * power].map(|slope| c * slope / self.deviation(i)).to_vec()
        };
        let jacobian: Vec<Vec<f64>> = self.parts.iter().enumerate().map(row).collect();
        let inverse = least_squares::inverse(&least_squares::normal(&jacobian))?;
        let reduced = least_squares::sum(&residuals) / (residuals.len() - LAW) as f64;
        let variance = if self.deviations.is_some() { reduced.max(1.0) } else { reduced };
        // ln(c n) is the sum of the logarithms of both.
        let square = inverse[1][1] + 2.0 * inverse[1][2] + inverse[2][2];
        Some(Law {
            place,
            scatter: self.deviation(0) * reduced.sqrt(),
            recovery_error: c * n * (variance * square).sqrt(),
            lengths: residuals.iter().enumerate().map(|(i, r)| r * self.deviation(i)).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Loading, a hold with creep, and an unloading by h_f = 100, c = 60 and m in nanometres.
    fn test(m: f64) -> [Vec<f64>; 2] {
        let loading = (1..=50).map(|k| [f64::from(k) / 5.0, 160.0 * (f64::from(k) / 50.0).sqrt() - 5.0]);
        let hold = (0..20).map(|k| [10.0, 155.0 + f64::from(k) / 4.0]);
        let unloading = (0..100).map(|k| 10.0 - f64::from(k) / 10.0);
        let unloading = unloading.map(|force| [force, 100.0 + 60.0 * (force / 10.0).powf(1.0 / m)]);
        loading.chain(hold).chain(unloading).map(|[force, h]| (force, h)).unzip::<_, _, Vec<f64>, Vec<f64>>().into()
    }

    fn refused(forces: &[f64], penetrations: &[f64]) -> String {
        Unloading::new(forces, penetrations, None, Unloading::PART).unwrap_err().to_string()
    }

    #[test]
    fn the_stiffness_of_an_exact_power_law_is_found() {
        for m in [1.1, 1.4, 1.5, 2.0, 3.0] {
            let [forces, penetrations] = test(m);
            let found = Unloading::new(&forces, &penetrations, None, Unloading::PART).unwrap();
            assert!((found.stiffness / (m * 10.0 / 60.0) - 1.0).abs() < 1e-6, "{m}: {found:?}");
            assert!((found.exponent / m - 1.0).abs() < 1e-6 && (found.residual_depth - 100.0).abs() < 1e-4);
            assert_eq!((found.force, found.penetration, found.forces.len()), (10.0, 160.0, 71));
        }
    }

    /// Gaussian noise of 0.3 nm, 400 draws: the part whose 95 % interval holds S is within 3.3 √(0.95·0.05/400) = 3.6 % of it, and 1 % is
    /// left to the curvature of the law.
    #[test]
    fn standard_errors_cover_the_noise() {
        let [forces, exact] = test(1.5);
        let mut state = 1u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64 + 0.5) / (1u64 << 53) as f64
        };
        let mut normal = || (-2.0 * uniform().ln()).sqrt() * (2.0 * std::f64::consts::PI * uniform()).cos();
        for known in [None, Some(vec![0.3; forces.len()])] {
            let mut inside = 0;
            for _ in 0..400 {
                let noisy: Vec<f64> = exact.iter().map(|h| h + 0.3 * normal()).collect();
                let found = Unloading::new(&forces, &noisy, known.as_deref(), Unloading::PART).unwrap();
                inside += i32::from((found.stiffness - 0.25).abs() < 1.98 * found.stiffness_error);
                assert!((found.scatter / 0.3 - 1.0).abs() < 0.35, "{found:?}");
            }
            assert!((f64::from(inside) / 400.0 - 0.95).abs() < 0.046, "{inside} of 400");
        }
    }

    #[test]
    fn records_without_a_stiffness_are_refused_with_what_to_do() {
        let [forces, penetrations] = test(1.5);
        assert!(refused(&forces[..70], &penetrations[..70]).contains("there is no unloading"));
        assert!(refused(&forces[..77], &penetrations[..77]).contains("2 points of the unloading"));
        let mut rising = penetrations.clone();
        rising.iter_mut().zip(&forces).skip(70).for_each(|(h, force)| *h = 200.0 - force);
        assert!(refused(&forces, &rising).contains("does not fall with the force"), "{}", refused(&forces, &rising));
        let mut cycles = forces.clone();
        cycles[110..130].iter_mut().for_each(|force| *force += 3.0);
        assert!(refused(&cycles, &penetrations).contains("the force rises again"));
        assert!(refused(&forces, &penetrations[1..]).contains("170 forces, but 169"));
        let part = |part| Unloading::new(&forces, &penetrations, None, part).unwrap_err();
        assert_eq!(part([0.9, 0.5]), UnloadingError::Part([0.9, 0.5]));
        let mut unknown = penetrations;
        unknown[3] = f64::NAN;
        assert!(refused(&forces, &unknown).contains("point 4: the penetration must be finite"));
    }
}

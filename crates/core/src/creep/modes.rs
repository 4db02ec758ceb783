//! Modes of retardation of a compliance, from its values at few frequencies.
//!
//! Under a load held from t = 0 on a passive body creeps by C(t) = C_g + Σ Aⱼ(1 − e^{−t/θⱼ}), Aⱼ > 0, θⱼ > 0: its compliance at the
//! Laplace variable s is a Stieltjes function,
//!
//! C(s) = C_g + f(s),  f(s) = Σ Aⱼ/(1 + sθⱼ) = **b**ᵀ(s + Λ)⁻¹**b**,  Λ = diag 1/θⱼ,  bⱼ² = Aⱼ/θⱼ.
//!
//! Within the span X of few [states](super::states) **x** = (s + Λ)⁻¹**b** at places s = iω, f(s) ≈ **b**ᵀX(s XᵀX + XᵀΛX)⁻¹Xᵀ**b**: it has the values
//! and the slopes of f at their places (A. J. Mayo and A. C. Antoulas, Linear Algebra Appl. 425, 634 (2007), Section 4), its matrices are
//! symmetric and positive, and so are its rates 1/θ and amplitudes. Its error is of the order of the square of what the span leaves of
//! other states (Galerkin's method: the symmetric part of e^{−iπ/4}(iω + Λ) is (ω + Λ)/√2).

use super::states::{Sample, Span, State};
use crate::numeric::eigen::eigen;
use crate::numeric::number::Number;

/// Amplitude over the compliance at s = 1/θ below which a mode is dropped.
const NEGLIGIBLE: f64 = 1e-12;

/// One mode of retardation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// Retardation time θ, a time.
    pub time: f64,
    /// Amplitude A, a length per pressure as the compliance.
    pub amplitude: f64,
}

/// Compliance C(s) = C_g + Σ A/(1 + sθ).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RetardationModes {
    /// Glassy compliance C_g, of a load just applied: a length per pressure.
    pub glassy: f64,
    /// Modes of positive times and amplitudes, from the longest time to the shortest.
    pub modes: Vec<Mode>,
}

impl RetardationModes {
    /// Modes of a compliance with a glassy value, of which `samples` are given in ascending frequencies.
    pub fn through(glassy: f64, samples: &[Sample]) -> Self {
        let span = Span::of(samples);
        let column = |state: &State| span.forward(span.states.iter().map(|other| state.weighted(other, glassy)));
        let half: Vec<Vec<f64>> = span.states.iter().map(column).collect();
        let whole = (0..half.len()).map(|k| span.forward(half.iter().map(|column| column[k])));
        let loads = span.forward(span.states.iter().map(|state| state.load(glassy)));
        let mode = |(rate, vector): (f64, Vec<f64>)| {
            let load: f64 = vector.iter().zip(&loads).map(|(x, y)| x * y).sum();
            Mode { time: rate.recip(), amplitude: load * load / rate }
        };
        let mut modes: Vec<Mode> = eigen(whole.collect()).into_iter().map(mode).collect();
        modes.sort_by(|a, b| b.time.total_cmp(&a.time));
        let all = Self { glassy, modes };
        let counts = |mode: &Mode| mode.time > 0.0 && mode.amplitude > NEGLIGIBLE * all.at(mode.time.recip());
        Self { glassy, modes: all.modes.iter().copied().filter(counts).collect() }
    }

    /// The modes with `factor` times the compliance.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mode = |mode: &Mode| Mode { amplitude: factor * mode.amplitude, ..*mode };
        Self { glassy: factor * self.glassy, modes: self.modes.iter().map(mode).collect() }
    }

    /// Compliance at the Laplace variable s, one over a time: a length per pressure.
    pub fn at<N: Number>(&self, s: N) -> N {
        let term = |sum: N, mode: &Mode| sum + N::from(mode.amplitude).over(N::from(1.0) + s * mode.time);
        self.modes.iter().fold(N::from(self.glassy), term)
    }

    /// Displacement over a pressure that is held for a time t ≥ 0: a length per pressure.
    pub fn after(&self, time: f64) -> f64 {
        self.modes.iter().fold(self.glassy, |sum, mode| sum - mode.amplitude * (-time / mode.time).exp_m1())
    }

    /// Relaxed compliance C_g + ΣA, of a load held for long: a length per pressure.
    pub fn relaxed(&self) -> f64 {
        self.modes.iter().fold(self.glassy, |sum, mode| sum + mode.amplitude)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustfft::num_complex::Complex64;

    /// Samples of a function that gives value and slope, four a decade.
    fn samples(decades: [i32; 2], of: impl Fn(Complex64) -> [Complex64; 2]) -> Vec<Sample> {
        let place = |k: i32| Complex64::new(0.0, 10f64.powf(0.25 * f64::from(k)));
        let sample = |k: i32| {
            let [value, slope] = of(place(k));
            Sample { place: place(k), value, slope }
        };
        (4 * decades[0]..=4 * decades[1]).map(sample).collect()
    }

    /// Largest relative difference from samples.
    fn misfit(modes: &RetardationModes, samples: &[Sample]) -> f64 {
        let error = |sample: &Sample| (modes.at(sample.place) - sample.value).norm() / sample.value.norm();
        samples.iter().map(error).fold(0.0, f64::max)
    }

    fn of_modes(modes: &RetardationModes) -> impl Fn(Complex64) -> [Complex64; 2] {
        |s| {
            let slope = |mode: &Mode| -mode.amplitude * mode.time / (1.0 + s * mode.time).powi(2);
            [modes.at(s), modes.modes.iter().map(slope).sum()]
        }
    }

    /// Times half a decade and more apart over six decades, amplitudes from 1e-7 to 1e3 of the glassy compliance.
    #[test]
    fn modes_apart_are_found_again() {
        let mode = |time, amplitude| Mode { time, amplitude };
        let modes = vec![
            mode(300.0, 40.0),
            mode(90.0, 1e3),
            mode(5.0, 0.3),
            mode(0.2, 7.0),
            mode(0.01, 1e-3),
            mode(3e-4, 1e-7),
        ];
        let given = RetardationModes { glassy: 1.0, modes };
        let found = RetardationModes::through(1.0, &samples([-4, 5], of_modes(&given)));
        assert_eq!(found.modes.len(), 6, "{found:?}");
        for (found, given) in found.modes.iter().zip(&given.modes) {
            // Rounding of the compliance at the time of the mode, over its amplitude.
            let tolerance = 1e-12 + 1e-14 / (given.amplitude / 1e3).min(1.0);
            assert!((found.time / given.time - 1.0).abs() < tolerance, "{found:?} {given:?}");
            assert!((found.amplitude / given.amplitude - 1.0).abs() < tolerance, "{found:?} {given:?}");
        }
    }

    /// Two times that differ by 1e-3, and by 1e-9, which are one to rounding.
    #[test]
    fn close_modes_count_as_one_where_no_sample_tells_them_apart() {
        for (apart, count) in [(1e-3, 2), (1e-9, 1)] {
            let modes = vec![Mode { time: 1.0 + apart, amplitude: 1.0 }, Mode { time: 1.0, amplitude: 2.0 }];
            let given = RetardationModes { glassy: 0.5, modes };
            let all = samples([-2, 2], of_modes(&given));
            let found = RetardationModes::through(0.5, &all);
            assert_eq!(found.modes.len(), count, "{found:?}");
            assert!(misfit(&found, &all) < 1e-12 && (found.relaxed() - 3.5).abs() < 1e-11);
        }
    }

    /// C = 1/(1 + √s): a continuum of times from 0 to ∞ is met within the samples, at real s too.
    #[test]
    fn a_continuum_of_times_is_met_by_positive_modes() {
        let power = |s: Complex64| {
            let root = s.sqrt();
            [(1.0 + root).inv(), -0.5 / (root * (1.0 + root).powi(2))]
        };
        let all = samples([-3, 3], power);
        let found = RetardationModes::through(0.0, &all);
        assert!(misfit(&found, &all) < 1e-9 && found.modes.len() <= all.len() * 2, "{}", found.modes.len());
        assert!(found.modes.iter().all(|mode| mode.time > 0.0 && mode.amplitude > 0.0));
        for k in -20..=20 {
            let s = 10f64.powf(0.1 * f64::from(k) + 0.03);
            let error = found.at(s) * (1.0 + s.sqrt()) - 1.0;
            assert!(error.abs() < 1e-10, "{s}: {error:e}");
        }
    }

    /// Lengths, pressures and times in other units, by powers of two: the same bits.
    #[test]
    fn units_change_nothing() {
        let modes = vec![Mode { time: 7.0, amplitude: 1.0 }, Mode { time: 0.3, amplitude: 20.0 }];
        let given = RetardationModes { glassy: 0.1, modes };
        let all = samples([-2, 2], of_modes(&given));
        let [time, compliance] = [2f64.powi(12), 2f64.powi(-30)];
        let change = |sample: &Sample| Sample {
            place: sample.place / time,
            value: sample.value * compliance,
            slope: sample.slope * (compliance * time),
        };
        let changed: Vec<Sample> = all.iter().map(change).collect();
        let [one, other] =
            [(1.0, &all), (compliance, &changed)].map(|(unit, all)| RetardationModes::through(0.1 * unit, all));
        let back =
            other.modes.iter().map(|mode| Mode { time: mode.time / time, amplitude: mode.amplitude / compliance });
        assert_eq!(one.modes, back.collect::<Vec<Mode>>());
    }

    #[test]
    fn an_elastic_compliance_has_no_modes() {
        let all = samples([-2, 2], |_| [3.0.into(), 0.0.into()]);
        let found = RetardationModes::through(3.0, &all);
        assert_eq!(found, RetardationModes { glassy: 3.0, modes: vec![] });
        assert_eq!((found.after(7.0), found.relaxed(), found.at(0.3)), (3.0, 3.0, 3.0));
        assert_eq!(RetardationModes::through(3.0, &[]), found);
    }
}

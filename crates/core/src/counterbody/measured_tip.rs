//! Tips that were measured: the axisymmetric profile f(r) whose cross-section has the measured area, π r² = A(f).
//!
//! The area function A(h) of an instrument is the area of the cross-section of the tip at the distance h from its apex. A profile of equal
//! area takes a pyramid, and whatever has worn, as round.

use crate::notation::number;
use crate::numeric::limited_cubic::{between, slopes};
use std::f64::consts::PI;

/// Depths at which the profile of coefficients is taken; between them it is a cubic.
const NODES: u32 = 400;
/// Halvings of an interval in which a radius is searched for.
const HALVINGS: usize = 52;
/// Most slope over the flatter secant beside it with which a cubic rises everywhere (Fritsch & Carlson, SIAM J. Numer. Anal. 17 (1980) 238).
const STEEPEST: f64 = 3.0;

/// Why an area function is none of a tip.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TipError {
    /// Fewer than two depths.
    #[error("an area function has two depths above 0 at least, not {0}")]
    Few(usize),
    /// A depth or an area that is not finite, or not larger than the one before.
    #[error(
        "depths and areas of a tip must be above 0 and rise: behind the depth {} with the area {} stands {} with {}",
        number(.before[0]), number(.before[1]), number(.after[0]), number(.after[1])
    )]
    NotRising {
        /// Index of the point, from 0.
        index: usize,
        /// Depth and area before it.
        before: [f64; 2],
        /// Depth and area of it.
        after: [f64; 2],
    },
    /// Depths between which coefficients hold that are not two ascending ones above 0.
    #[error("an area function holds between two depths above 0, the smaller one first, not {} and {}", number(.0[0]), number(.0[1]))]
    Range([f64; 2]),
}

/// Profile of a tip by its area function A(h).
///
/// Between the measured depths the profile is a cubic in the radius, which rises everywhere. Below the first one the apex is rounded, f ~ r²;
/// beyond the last one the tip goes on as a cone.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredTip {
    /// Radii √(A/π) of the apex, which is 0, and of the depths; lengths.
    radii: Vec<f64>,
    depths: Vec<f64>,
    slopes: Vec<f64>,
}

impl MeasuredTip {
    /// The tip with these depths h and areas A(h), lengths and lengths squared; a first point at the depth 0 of the area 0 is the apex.
    ///
    /// # Errors
    /// [`TipError`] with fewer than two depths, and where depths or areas do not rise.
    pub fn from_areas(points: &[[f64; 2]]) -> Result<Self, TipError> {
        let skipped = usize::from(points.first() == Some(&[0.0; 2]));
        let measured = &points[skipped..];
        if measured.len() < 2 {
            return Err(TipError::Few(measured.len()));
        }
        let mut before = [0.0; 2];
        for (index, &after) in measured.iter().enumerate() {
            if !(0..2).all(|k| after[k] > before[k] && after[k].is_finite()) {
                return Err(TipError::NotRising { index: index + skipped, before, after });
            }
            before = after;
        }
        let radii: Vec<f64> = std::iter::once(0.0).chain(measured.iter().map(|point| (point[1] / PI).sqrt())).collect();
        let depths: Vec<f64> = std::iter::once(0.0).chain(measured.iter().map(|point| point[0])).collect();
        let secant = |k: usize| (depths[k + 1] - depths[k]) / (radii[k + 1] - radii[k]);
        let last = radii.len() - 1;
        let limited = |(k, slope): (usize, f64)| match k {
            0 => 0.0,
            _ if k == last => slope.clamp(secant(k - 1), STEEPEST * secant(k - 1)),
            _ => slope.clamp(0.0, STEEPEST * secant(k - 1).min(secant(k))),
        };
        let slopes = slopes(&radii, &depths).into_iter().enumerate().map(limited).collect();
        Ok(Self { radii, depths, slopes })
    }

    /// The tip with the area function A = C₀ h² + C₁ h + C₂ h^½ + C₃ h^¼ + … + C₈ h^{1/128} between two depths (Oliver & Pharr,
    /// J. Mater. Res. 7 (1992) 1564); lengths, and areas in their square.
    ///
    /// # Errors
    /// [`TipError`] for depths that are not two ascending ones, and where the area does not rise between them.
    pub fn from_coefficients(coefficients: &[f64], range: [f64; 2]) -> Result<Self, TipError> {
        let [least, most] = range;
        if !(least > 0.0 && most > least && most.is_finite()) {
            return Err(TipError::Range(range));
        }
        let area = |h: f64| -> f64 {
            let powers = (0..).map(|k| if k == 0 { 2.0 } else { 0.5f64.powi(k - 1) });
            coefficients.iter().zip(powers).map(|(c, power)| c * h.powf(power)).sum()
        };
        let depth =
            |k: u32| if k == NODES { most } else { least * (most / least).powf(f64::from(k) / f64::from(NODES)) };
        let points: Vec<[f64; 2]> = (0..=NODES).map(depth).map(|h| [h, area(h)]).collect();
        Self::from_areas(&points)
    }

    /// Least and largest radius √(A/π) that was measured, lengths.
    pub fn range(&self) -> [f64; 2] {
        [self.radii[1], self.radii[self.radii.len() - 1]]
    }

    /// Profile f at the radius `r` ≥ 0, a length.
    pub fn profile(&self, r: f64) -> f64 {
        let Self { radii, depths, slopes } = self;
        let Some(k) = self.interval(r) else {
            let last = radii.len() - 1;
            return depths[last] + slopes[last] * (r - radii[last]);
        };
        let apart = radii[k + 1] - radii[k];
        between([[depths[k], slopes[k]], [depths[k + 1], slopes[k + 1]]], apart, (r - radii[k]) / apart)
    }

    /// Slope f′ at the radius `r` ≥ 0, dimensionless.
    pub fn slope(&self, r: f64) -> f64 {
        let Self { radii, depths, slopes } = self;
        let Some(k) = self.interval(r) else { return slopes[radii.len() - 1] };
        let apart = radii[k + 1] - radii[k];
        let t = (r - radii[k]) / apart;
        let secant = (depths[k + 1] - depths[k]) / apart;
        6.0 * t * (1.0 - t) * secant + (1.0 - t) * (1.0 - 3.0 * t) * slopes[k] + t * (3.0 * t - 2.0) * slopes[k + 1]
    }

    /// Radius at which the profile has a depth ≥ 0; lengths.
    pub fn section_radius(&self, depth: f64) -> f64 {
        let Self { radii, depths, slopes } = self;
        let behind = depths.partition_point(|node| *node <= depth);
        if behind == depths.len() {
            return radii[behind - 1] + (depth - depths[behind - 1]) / slopes[behind - 1];
        }
        let mut ends = [radii[behind - 1], radii[behind]];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (ends[0] + ends[1]);
            ends[usize::from(self.profile(middle) > depth)] = middle;
        }
        0.5 * (ends[0] + ends[1])
    }

    /// Index of the node before a radius; `None` from the last one on.
    fn interval(&self, r: f64) -> Option<usize> {
        let behind = self.radii.partition_point(|radius| *radius <= r);
        (behind < self.radii.len()).then(|| behind - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A = 2πRh is that of a paraboloid, A = c h² that of a cone.
    #[test]
    fn areas_of_a_paraboloid_and_of_a_cone_give_their_profiles() {
        let radius = 0.7;
        let areas: Vec<[f64; 2]> = [0.0, 0.01, 0.03, 0.04, 0.09, 0.2].map(|h| [h, 2.0 * PI * radius * h]).to_vec();
        let tip = MeasuredTip::from_areas(&areas).unwrap();
        let [least, most] = tip.range();
        assert!((least - (2.0 * radius * 0.01f64).sqrt()).abs() < 1e-15);
        for r in (1..200).map(|k| most * f64::from(k) / 200.0) {
            assert!(
                (tip.profile(r) - r * r / (2.0 * radius)).abs() < 1e-14 && (tip.slope(r) - r / radius).abs() < 1e-12,
                "{r}"
            );
        }
        let cone = MeasuredTip::from_coefficients(&[24.5], [1e-3, 1.0]).unwrap();
        let slope = (PI / 24.5f64).sqrt();
        for r in [0.01, 0.3, 2.0, 2.7, 30.0] {
            assert!((cone.profile(r) / (slope * r) - 1.0).abs() < 1e-6, "{r}: {}", cone.profile(r) / r);
            assert!((cone.slope(r) / slope - 1.0).abs() < 1e-5, "{r}: {}", cone.slope(r));
        }
    }

    /// Coefficients of any sign: the profile has the area of the polynomial at every depth, its slope is that of the profile, and it rises.
    #[test]
    fn a_profile_has_the_area_of_its_coefficients() {
        let coefficients = [24.5, 0.8, -0.05, 0.02, 0.001];
        let tip = MeasuredTip::from_coefficients(&coefficients, [0.02, 3.0]).unwrap();
        for h in [0.021f64, 0.05, 0.1234, 0.9, 2.77] {
            let area = 24.5 * h * h + 0.8 * h - 0.05 * h.sqrt() + 0.02 * h.powf(0.25) + 0.001 * h.powf(0.125);
            let r = (area / PI).sqrt();
            assert!((tip.profile(r) / h - 1.0).abs() < 1e-7, "{h}: {}", tip.profile(r));
            let step = 1e-6 * r;
            let quotient = (tip.profile(r + step) - tip.profile(r - step)) / (2.0 * step);
            assert!((tip.slope(r) / quotient - 1.0).abs() < 1e-5, "{h}");
        }
        let [.., most] = tip.range();
        let rises = (0..3000).map(|k| tip.profile(most * f64::from(k) / 2000.0));
        assert!(rises.collect::<Vec<f64>>().windows(2).all(|pair| pair[1] > pair[0]));
    }

    /// Few points of a kinked tip: no cubic between them falls or leaves their range.
    #[test]
    fn between_few_points_the_profile_rises_too() {
        let tip = MeasuredTip::from_areas(&[[0.1, 0.2], [0.11, 3.0], [5.0, 3.1], [5.1, 40.0]]).unwrap();
        let profile: Vec<f64> = (0..=5000).map(|k| tip.profile(f64::from(k) * 1e-3)).collect();
        assert!(profile.windows(2).all(|pair| pair[1] >= pair[0]) && profile[0] == 0.0);
        assert!((0..5000).all(|k| tip.slope(f64::from(k) * 1e-3) >= 0.0));
    }

    #[test]
    fn areas_that_do_not_rise_are_refused() {
        let rising = |points: &[[f64; 2]]| MeasuredTip::from_areas(points);
        assert_eq!(rising(&[[0.0, 0.0], [1.0, 2.0]]), Err(TipError::Few(1)));
        for (points, index) in [
            (&[[1.0, 2.0], [2.0, 2.0]][..], 1),
            (&[[0.0, 0.0], [1.0, 2.0], [1.0, 3.0]], 2),
            (&[[0.0, 1.0], [1.0, 2.0]], 0),
            (&[[1.0, 2.0], [2.0, f64::NAN]], 1),
        ] {
            assert!(matches!(rising(points), Err(TipError::NotRising { index: at, .. }) if at == index), "{points:?}");
        }
        let coefficients = |range| MeasuredTip::from_coefficients(&[24.5, -10.0], range);
        assert!(matches!(coefficients([0.1, 1.0]), Err(TipError::NotRising { .. })));
        assert_eq!(coefficients([1.0, 1.0]), Err(TipError::Range([1.0, 1.0])));
        assert!(coefficients([0.5, 1.0]).is_ok());
    }
}

//! A closed line around an axis, given by its radii at equally spaced angles from θ = 0, and Fourier series in the angle.

use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Number of angles at which lines are given.
pub const ANGLES: usize = 360;
/// Highest harmonic of the tabulated waves.
pub const HIGHEST: usize = 24;

/// Angle with an index, radians.
pub fn angle(index: usize) -> f64 {
    TAU * index as f64 / ANGLES as f64
}

/// Radius at an angle, linear between the given ones.
pub fn radius(radii: &[f64], theta: f64) -> f64 {
    let count = radii.len();
    let place = theta.rem_euclid(TAU) / TAU * count as f64;
    let (before, rest) = (place as usize % count, place.fract());
    (1.0 - rest) * radii[before] + rest * radii[(before + 1) % count]
}

/// √(enclosed area/π); 0 without radii.
pub fn mean_radius(radii: &[f64]) -> f64 {
    (radii.iter().map(|r| r * r).sum::<f64>() / radii.len().max(1) as f64).sqrt()
}

/// The line moved outwards by the shifts, scaled in proportion so that none exceeds `most`: the line stays smooth.
pub fn moved(radii: &[f64], shifts: &[f64], most: f64) -> Vec<f64> {
    let largest = shifts.iter().fold(0.0, |most: f64, shift| most.max(shift.abs()));
    let part = (most / largest).min(1.0);
    radii.iter().zip(shifts).map(|(radius, shift)| radius + part * shift).collect()
}

/// Waves 1, cos θ, sin θ, … of the harmonics up to `highest`.
pub fn waves(theta: f64, highest: usize) -> Vec<f64> {
    let mut waves = vec![0.0; 1 + 2 * highest];
    waves_into(theta, &mut waves);
    waves
}

/// Waves 1, cos θ, sin θ, … of as many harmonics as the slice holds.
pub fn waves_into(theta: f64, waves: &mut [f64]) {
    let (sine, cosine) = theta.sin_cos();
    let (mut c, mut s) = (1.0, 0.0);
    let (first, pairs) = waves.split_at_mut(1);
    first[0] = 1.0;
    for pair in pairs.chunks_exact_mut(2) {
        (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
        pair.copy_from_slice(&[c, s]);
    }
}

/// [`waves`] at the angle with an index, up to the harmonic [`HIGHEST`].
pub fn waves_at(index: usize) -> &'static [f64] {
    static WAVES: LazyLock<Vec<[f64; 1 + 2 * HIGHEST]>> = LazyLock::new(|| {
        let at = |index| {
            let mut waves = [0.0; 1 + 2 * HIGHEST];
            waves_into(angle(index), &mut waves);
            waves
        };
        (0..ANGLES).map(at).collect()
    });
    &WAVES[index]
}

/// Values of a series of [`waves`] at the angles of a line.
pub fn series_line(coefficients: &[f64]) -> Vec<f64> {
    let sum = |index| coefficients.iter().zip(waves_at(index)).map(|(c, wave)| c * wave).sum();
    (0..ANGLES).map(sum).collect()
}

/// Value of a series of [`waves`] at an angle; it has at least one coefficient.
pub fn series(coefficients: &[f64], theta: f64) -> f64 {
    let (sine, cosine) = theta.sin_cos();
    let (mut c, mut s) = (1.0, 0.0);
    let mut sum = coefficients[0];
    for pair in coefficients[1..].chunks_exact(2) {
        (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
        sum += c * pair[0] + s * pair[1];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_line_of_two_lobes_has_its_radii_and_its_area() {
        let radii: Vec<f64> = (0..ANGLES).map(|index| series(&[1.0, 0.0, 0.0, 0.1, 0.0], angle(index))).collect();
        let [.., c, s] = waves(0.7, 12)[..] else { panic!("twelve harmonics") };
        assert!((c - 8.4f64.cos()).abs() < 1e-14 && (s - 8.4f64.sin()).abs() < 1e-14);
        assert!((radius(&radii, -PI) - 1.1).abs() < 1e-12 && (radius(&radii, 2.5 * PI) - 0.9).abs() < 1e-12);
        assert!((mean_radius(&radii) - 1.005f64.sqrt()).abs() < 1e-12 && mean_radius(&[]) == 0.0);
    }

    #[test]
    fn a_series_at_the_angles_of_a_line_is_its_sum_at_each() {
        let coefficients: Vec<f64> = (0..=2 * HIGHEST).map(|k| (1.7 * k as f64).cos()).collect();
        for (index, value) in series_line(&coefficients).into_iter().enumerate() {
            assert!((value - series(&coefficients, angle(index))).abs() < 1e-12, "{index}");
        }
    }
}

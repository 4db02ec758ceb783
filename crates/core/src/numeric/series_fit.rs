//! Linear least squares whose unknowns are Fourier series in an angle.
//!
//! Σᵢ [Σₜ aₜᵢ sₜ(θᵢ) − yᵢ]² is least over the series sₜ of given highest harmonics. As products of waves are waves, the
//! normal equations need no more than the sums Σᵢ aₜᵢ aᵤᵢ cos kθᵢ and Σᵢ aₜᵢ aᵤᵢ sin kθᵢ: samples at one angle are added before
//! they are multiplied by its waves.

use super::least_squares::solved;

/// The sums of the normal equations of a fit.
#[derive(Debug, Clone)]
pub struct SeriesFit {
    /// Highest harmonic of each term.
    harmonics: Vec<usize>,
    /// Sums of aₜaᵤ with the waves up to the sum of their harmonics, for the terms t ≥ u one after the other.
    products: Vec<Vec<f64>>,
    /// Sums of aₜ y with the waves of each term.
    values: Vec<Vec<f64>>,
}

impl SeriesFit {
    /// A fit without samples, of terms with series of given highest harmonics.
    pub fn new(harmonics: Vec<usize>) -> Self {
        let sums = |highest: usize| vec![0.0; 1 + 2 * highest];
        let pairs = harmonics.iter().enumerate().flat_map(|(t, a)| harmonics[..=t].iter().map(move |b| a + b));
        Self {
            products: pairs.map(sums).collect(),
            values: harmonics.iter().map(|&highest| sums(highest)).collect(),
            harmonics,
        }
    }

    /// Adds samples at one angle, given by its waves: the sums Σ aₜaᵤ for u ≤ t, one t after the other, and Σ aₜy.
    pub fn add(&mut self, waves: &[f64], products: &[f64], values: &[f64]) {
        let totals = self.products.iter_mut().chain(&mut self.values);
        for (sums, factor) in totals.zip(products.iter().chain(values)).filter(|(_, factor)| **factor != 0.0) {
            sums.iter_mut().zip(waves).for_each(|(sum, wave)| *sum += factor * wave);
        }
    }

    /// Coefficients of the series, one series after the other, each in the order of [`waves`](super::closed_line::waves);
    /// `None` where the samples do not determine them.
    pub fn solve(self) -> Option<Vec<f64>> {
        let places: Vec<(usize, usize)> =
            self.harmonics.iter().enumerate().flat_map(|(t, h)| (0..=2 * h).map(move |k| (t, k))).collect();
        let line = |(row, &(t, j)): (usize, &(usize, usize))| {
            let entry = |&(u, k): &(usize, usize)| product(&self.products[t * (t + 1) / 2 + u], j, k);
            places[..=row].iter().map(entry).collect()
        };
        solved(places.iter().enumerate().map(line).collect(), self.values.concat())
    }
}

/// Sum of the product of the waves j and k, from the sums of single waves.
fn product(sums: &[f64], j: usize, k: usize) -> f64 {
    let cosine = |m: usize| if m == 0 { sums[0] } else { sums[2 * m - 1] };
    let sine = |m: i32| if m == 0 { 0.0 } else { f64::from(m.signum()) * sums[2 * m.unsigned_abs() as usize] };
    // Wave k is the cosine (odd k) or sine (even k) of ⌈k/2⌉ times the angle.
    let (a, b) = (j.div_ceil(2), k.div_ceil(2));
    let is_sine = |wave: usize| wave > 0 && wave.is_multiple_of(2);
    match (is_sine(j), is_sine(k)) {
        (false, false) => 0.5 * (cosine(a.abs_diff(b)) + cosine(a + b)),
        (true, true) => 0.5 * (cosine(a.abs_diff(b)) - cosine(a + b)),
        (true, false) => 0.5 * (sine((a + b) as i32) + sine(a as i32 - b as i32)),
        (false, true) => 0.5 * (sine((a + b) as i32) + sine(b as i32 - a as i32)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::closed_line::{series, waves};
    use crate::numeric::least_squares;

    /// Against the fit with rows written out.
    #[test]
    fn series_are_those_of_a_fit_to_rows() {
        let samples = |i: usize| {
            let theta = 0.37 * i as f64;
            let factors =
                [1.0 + 0.3 * (theta * 1.7).sin(), (theta * 0.6).cos(), if i.is_multiple_of(3) { 0.0 } else { 0.8 }];
            (theta, factors, (theta * 2.3).sin() + 0.1 * theta.cos())
        };
        let harmonics = [3, 2, 0];
        let mut fit = SeriesFit::new(harmonics.to_vec());
        for i in 0..400 {
            let (theta, factors, value) = samples(i);
            let products: Vec<f64> = (0..3).flat_map(|t| (0..=t).map(move |u| factors[t] * factors[u])).collect();
            fit.add(&waves(theta, 6), &products, &factors.map(|factor| factor * value));
        }
        let found = fit.solve().unwrap();
        let rows = (0..400).map(samples).map(|(theta, factors, value)| {
            let row = factors.iter().zip(harmonics).flat_map(|(&a, h)| waves(theta, h).into_iter().map(move |w| a * w));
            (row.collect(), value)
        });
        let expected = least_squares::fit(7 + 5 + 1, rows).unwrap();
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
        assert!(series(&found[..7], 0.3).abs() > 1e-3);
    }

    #[test]
    fn too_few_samples_determine_nothing() {
        let mut fit = SeriesFit::new(vec![2]);
        (0..4).for_each(|i| fit.add(&waves(f64::from(i), 4), &[1.0], &[1.0]));
        assert_eq!(fit.solve(), None);
    }
}

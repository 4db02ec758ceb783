//! Transforms of kernels that are even or odd along each axis, from their quadrant of offsets that are not negative:
//!
//! X_{k₁k₂} = Σ_{m,n} K_{|m||n|} trig(2πk₁m/M₁) trig(2πk₂n/M₂),  −N₁ < m < N₁, −N₂ < n < N₂,
//!
//! trig the cosine along an even axis, and along an odd one the sine, with K of the sign of the offset.

use ndarray::{Array2, Axis, Slice};
use percoat_fft::RealToComplex;
use rayon::prelude::*;
use std::sync::Arc;

/// Columns that are gathered at a time.
const GATHERED: usize = 8;

/// Parity of a kernel under a change of sign of an offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Parity {
    Even,
    Odd,
}

/// Transform of a line of offsets from zero on, with its mirror image.
struct Line {
    plan: Arc<dyn RealToComplex<f64>>,
    parity: Parity,
}

impl Line {
    /// A line that is transformed with `points` samples.
    fn new(points: usize, parity: Parity) -> Self {
        Self { plan: percoat_fft::of_real(points), parity }
    }

    /// Calls `value(component, X)` for all components up to half the points.
    fn transform(&self, offsets: impl Iterator<Item = f64>, mut value: impl FnMut(usize, f64)) {
        let (mut samples, mut components) = (self.plan.make_input_vec(), self.plan.make_output_vec());
        let points = samples.len();
        for (offset, sample) in offsets.enumerate() {
            match (self.parity, offset) {
                (Parity::Even, 0) => samples[0] = sample,
                (Parity::Even, _) => (samples[offset], samples[points - offset]) = (sample, sample),
                (Parity::Odd, 0) => {}
                (Parity::Odd, _) => (samples[offset], samples[points - offset]) = (sample, -sample),
            }
        }
        self.plan.process(&mut samples, &mut components).expect("lengths were planned");
        for (component, x) in components.into_iter().enumerate() {
            value(component, if self.parity == Parity::Even { x.re } else { -x.im });
        }
    }
}

/// X at [k₂, k₁], 0 ≤ k₁ ≤ M₁/2, 0 ≤ k₂ ≤ M₂/2, of a quadrant of N₁ × N₂ offsets on `points` = [M₁, M₂], Mᵢ ≥ 2Nᵢ − 1.
pub(super) fn transformed(quadrant: &Array2<f64>, points: [usize; 2], parities: [Parity; 2]) -> Array2<f64> {
    let [half1, half2] = points.map(|n| n / 2 + 1);
    let [down, along] = [0, 1].map(|axis| Line::new(points[axis], parities[axis]));
    let mut rows = Array2::zeros((quadrant.nrows(), half2));
    let lines = rows.as_slice_mut().expect("made row by row").par_chunks_mut(half2);
    let offsets = quadrant.as_slice().expect("in standard layout").par_chunks(quadrant.ncols());
    lines.zip(offsets).for_each(|(line, offsets)| along.transform(offsets.iter().copied(), |k, x| line[k] = x));
    let mut values = Array2::zeros((half2, half1));
    let columns = values.as_slice_mut().expect("made row by row").par_chunks_mut(GATHERED * half1).enumerate();
    columns.for_each(|(group, columns)| {
        let first = group * GATHERED;
        let slice = rows.slice_axis(Axis(1), Slice::from(first..half2.min(first + GATHERED)));
        let gathered = slice.reversed_axes().as_standard_layout().into_owned();
        for (column, offsets) in columns.chunks_exact_mut(half1).zip(gathered.rows()) {
            down.transform(offsets.iter().copied(), |k, x| column[k] = x);
        }
    });
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn transforms_are_their_direct_sums() {
        let ([n1, n2], [m1, m2]) = ([5, 4], [10, 7]);
        let quadrant = Array2::from_shape_fn((n1, n2), |(m, n)| ((7 * m + 3 * n * n) % 11) as f64 - 4.0);
        for parities in [[Parity::Even; 2], [Parity::Odd, Parity::Even], [Parity::Even, Parity::Odd], [Parity::Odd; 2]]
        {
            let found = transformed(&quadrant, [m1, m2], parities);
            for ((k2, k1), value) in found.indexed_iter() {
                let trig = |axis: usize, k: usize, offset: usize, points: usize| {
                    let phase = TAU * (k * offset) as f64 / points as f64;
                    match (parities[axis], offset) {
                        (Parity::Even, 0) => 1.0,
                        (Parity::Even, _) => 2.0 * phase.cos(),
                        (Parity::Odd, _) => 2.0 * phase.sin(),
                    }
                };
                let terms = quadrant.indexed_iter().map(|((m, n), x)| x * trig(0, k1, m, m1) * trig(1, k2, n, m2));
                assert!((terms.sum::<f64>() - value).abs() < 1e-12, "{parities:?} ({k1}, {k2})");
            }
        }
    }
}

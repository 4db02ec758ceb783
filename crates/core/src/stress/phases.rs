//! Phases of plane waves at points.

use crate::lattice::waves::WaveRow;

/// Phases e^{2πiκs} of some s, for a range of κ.
#[derive(Debug)]
pub(super) struct Phases<const P: usize> {
    first: i32,
    values: Vec<[[f64; P]; 2]>,
}

/// Distance in κ of the phases that are computed; those between are products of two.
const PHASE_BLOCK: i32 = 16;

impl<const P: usize> Phases<P> {
    /// Phases of first ≤ κ < end.
    pub fn new([first, end]: [i32; 2], places: [f64; P]) -> Self {
        let short: Vec<[[f64; P]; 2]> = (0..PHASE_BLOCK.min(end - first)).map(|k| phases(k, places)).collect();
        let mut values = Vec::with_capacity((end - first) as usize);
        for start in (first..end).step_by(PHASE_BLOCK as usize) {
            let [long_re, long_im] = phases(start, places);
            values.extend(short.iter().take((end - start) as usize).map(|[re, im]| {
                let real = |p: usize| long_re[p] * re[p] - long_im[p] * im[p];
                let imaginary = |p: usize| long_re[p] * im[p] + long_im[p] * re[p];
                [std::array::from_fn(real), std::array::from_fn(imaginary)]
            }));
        }
        Self { first, values }
    }

    /// Phases of all κ₁ of some rows, at fractions of a₁.
    pub fn along(rows: &[WaveRow], places: [f64; P]) -> Self {
        let first = rows.iter().map(|row| row.first).min().unwrap_or(0);
        let end = rows.iter().map(|row| row.first + row.len as i32).max().unwrap_or(first);
        Self::new([first, end], places)
    }

    /// Phases of the κ₂ of some rows, at fractions of a₂.
    pub fn across(rows: &[WaveRow], places: [f64; P]) -> Self {
        let first = rows.first().map_or(0, |row| row.across);
        Self::new([first, rows.last().map_or(first, |row| row.across + 1)], places)
    }

    /// Phase of the κ₂ of a row.
    pub fn of(&self, row: &WaveRow) -> &[[f64; P]; 2] {
        &self.values[(row.across - self.first) as usize]
    }

    /// Phases of the waves of a row, from the first on.
    pub fn from(&self, row: &WaveRow) -> &[[[f64; P]; 2]] {
        &self.values[(row.first - self.first) as usize..]
    }
}

/// cos 2πks and sin 2πks of some s.
fn phases<const P: usize>(k: i32, places: [f64; P]) -> [[f64; P]; 2] {
    let pairs = places.map(|s| {
        // Whole periods are removed.
        let part = (f64::from(k) * (s - s.round())).fract();
        (std::f64::consts::TAU * part).sin_cos()
    });
    [pairs.map(|(_, cosine)| cosine), pairs.map(|(sine, _)| sine)]
}

//! What is iterated on one grid.

use super::certificate::Certificate;
use crate::load::Load;
use crate::numeric::lanes::{LANES, all_zero, vectorised};
use crate::numeric::rows::{self, Totals};
use crate::numeric::sums::{self, BLOCK};
use fearless_simd::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;

/// Unknowns of one grid: pressure in, pressure, gap and what they prove out; all fields one value per sample. A clone shares
/// the fields until one of the two is iterated further.
#[derive(Debug, Clone)]
pub struct Unknowns {
    /// Pressure p.
    pub pressure: Arc<Vec<f64>>,
    /// Gap g = w + f − δ of the last check.
    pub gap: Arc<Vec<f64>>,
    /// Penetration δ of the last check.
    pub penetration: f64,
    /// What the pressure proves about itself, by the last check.
    pub certificate: Certificate,
}

impl Unknowns {
    /// No pressure yet on so many samples.
    pub fn new(samples: usize) -> Self {
        let zero = Arc::new(vec![0.0; samples]);
        Self { pressure: Arc::clone(&zero), gap: zero, penetration: 0.0, certificate: Certificate::default() }
    }

    /// No pressure anywhere.
    pub(super) fn rest(&mut self) {
        self.pressure = Arc::new(vec![0.0; self.pressure.len()]);
    }

    /// Clips the pressure at zero and, under load control, scales it to the mean; uniform when nothing is left.
    pub(super) fn admit(&mut self, load: Load) {
        let pressure = Arc::make_mut(&mut self.pressure);
        let Totals { sums: [sum], least: [] } =
            rows::sweep(BLOCK, pressure.par_chunks_mut(BLOCK), |_, p| vectorised!(simd => clipped(simd, p)));
        let Load::MeanPressure(mean) = load else { return };
        let total = mean * pressure.len() as f64;
        if sum > 0.0 {
            let scale = total / sum;
            sums::update(pressure, |_, p| scale * p);
        } else {
            pressure.fill(mean);
        }
    }
}

/// p ← max(p, 0); Σ p, sample by sample where there is any.
#[inline(always)]
fn clipped<S: Simd>(simd: S, p: &mut [f64]) -> Totals<1, 0> {
    let mut sum = 0.0;
    for group in p.chunks_mut(LANES) {
        if all_zero(simd, group) {
            continue;
        }
        for p in group {
            *p = p.max(0.0);
            sum += *p;
        }
    }
    Totals { sums: [sum], least: [] }
}

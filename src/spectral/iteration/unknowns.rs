//! What is iterated on one grid.

use crate::load::Load;
use crate::numeric::sums;

/// Unknowns of one grid: pressure in, pressure and gap out; all fields one value per sample.
#[derive(Debug, Clone)]
pub struct Unknowns {
    /// Pressure p.
    pub pressure: Vec<f64>,
    /// Gap g = w + f − δ of the last check.
    pub gap: Vec<f64>,
    /// Penetration δ of the last check.
    pub penetration: f64,
    pub(super) direction: Vec<f64>,
    pub(super) image: Vec<f64>,
    pub(super) previous: Vec<f64>,
    pub(super) active: Vec<bool>,
}

impl Unknowns {
    /// No pressure yet on so many samples.
    pub fn new(samples: usize) -> Self {
        let zero = vec![0.0; samples];
        Self {
            pressure: zero.clone(),
            gap: zero.clone(),
            direction: zero.clone(),
            image: zero.clone(),
            previous: zero,
            active: vec![false; samples],
            penetration: 0.0,
        }
    }

    /// The surface at rest, with this penetration of an indenter that it does not feel.
    pub(super) fn rest(&mut self, initial_gap: &[f64], penetration: f64) {
        self.pressure.fill(0.0);
        sums::update(&mut self.gap, |i, _| initial_gap[i] - penetration);
        self.penetration = penetration;
    }

    /// Clips the pressure at zero and, under load control, scales it to the mean; uniform when nothing is left.
    pub(super) fn admit(&mut self, load: Load) {
        sums::update(&mut self.pressure, |_, p| p.max(0.0));
        let Load::MeanPressure(mean) = load else { return };
        let total = mean * self.pressure.len() as f64;
        let [sum] = sums::of(self.pressure.len(), |i| [self.pressure[i]]);
        if sum > 0.0 {
            let scale = total / sum;
            sums::update(&mut self.pressure, |_, p| scale * p);
        } else {
            self.pressure.fill(mean);
        }
    }
}

//! The pressure over a groove that widens, without the row of samples at its edge.
//!
//! While a groove widens its edge takes in one row of samples after another. A fresh row carries a peak until it is worn down, so that the
//! largest pressure rises and falls by some ten percent from row to row, on any grid and with steps of any length: that is the edge of the
//! grid, and not of the groove. Damage and the largest pressure are those of the mean of the pressure over the passes from one row to the
//! next; half of the rise and fall is the error of the largest pressure.

use crate::body::Side;
use crate::run::WornStep;
use crate::spectral::{Step, Wear};
use ndarray::Axis;

/// The mean of the pressure over the steps of a groove.
#[derive(Debug)]
pub(super) struct Groove {
    /// Axis of the samples along which it runs.
    along: usize,
    /// Rows of samples in contact at its beginning, and by now.
    rows: [usize; 2],
    /// Σ p Δs, sample by sample, and the pressure of the last moment.
    sum: Vec<f64>,
    last: Vec<f64>,
    slid: f64,
    /// Least and largest of the largest pressures.
    peaks: [f64; 2],
}

/// Mean pressure over a groove.
#[derive(Debug)]
pub(super) struct MeanPressure {
    /// Mean of the pressure, sample by sample, a₂ fastest.
    pub pressure: Vec<f64>,
    /// Half of the rise and fall of the largest pressure.
    pub swing: f64,
}

impl Groove {
    /// A groove that begins with a step; `None` where the body does not wear, or along neither cell vector.
    pub fn new(step: &Step, wear: &Wear) -> Option<Self> {
        let parts = step.grid().cell().parts(wear.direction());
        let along = (0..2).find(|&axis| parts[1 - axis].abs() < 1e-9 * parts[axis].abs())?;
        (wear.coefficient(Side::Body) > 0.0).then(|| {
            let (pressure, rows) = (step.finest().pressures(), rows_in_contact(step, along));
            let peak = pressure.iter().copied().fold(0.0, f64::max);
            let (sum, last) = (vec![0.0; pressure.len()], pressure.to_vec());
            Self { along, rows: [rows; 2], sum, last, slid: 0.0, peaks: [peak; 2] }
        })
    }

    /// Adds a step of wear that ends with a contact.
    pub fn add(&mut self, worn: &WornStep, end: &Step) {
        let pressure = end.finest().pressures();
        for ((sum, last), now) in self.sum.iter_mut().zip(&mut self.last).zip(pressure) {
            *sum += 0.5 * worn.length * (*last + now);
            *last = *now;
        }
        self.slid += worn.length;
        self.rows[1] = rows_in_contact(end, self.along);
        self.peaks = [self.peaks[0].min(worn.max_pressure), self.peaks[1].max(worn.max_pressure)];
    }

    /// Whether it has taken in a row.
    pub fn has_widened(&self) -> bool {
        self.rows[1] > self.rows[0]
    }

    /// The mean; `None` before the first step.
    pub fn mean(self) -> Option<MeanPressure> {
        let Self { sum, slid, peaks: [least, most], .. } = self;
        let pressure = || sum.into_iter().map(|sum| sum / slid).collect();
        (slid > 0.0).then(|| MeanPressure { pressure: pressure(), swing: 0.5 * (most - least) })
    }
}

/// Rows of samples across the track on which a step has contact.
fn rows_in_contact(step: &Step, along: usize) -> usize {
    let pressure = step.pressure();
    pressure.lanes(Axis(along)).into_iter().filter(|row| row.iter().any(|p| *p > 0.0)).count()
}

//! The pressure over a groove that widens, without the row of samples at its edge.
//!
//! While a groove widens its edge takes in one row of samples after another. A fresh row carries a peak until it is worn down, so that the
//! largest pressure rises and falls by some ten percent from row to row, on any grid and with steps of any length: that is the edge of the
//! grid, and not of the groove. Damage and the largest pressure are those of the mean of the pressure over the passes from one row to the
//! next, on the way there and on the way back; half of the rise and fall is the error of the largest pressure. Where the passes end between
//! two rows the groove is followed on to the next one for the mean alone.

use super::beginning::Beginning;
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
    /// Pressures on the way there, and on the way back where that has others.
    there: Sum,
    back: Option<Sum>,
    slid: f64,
    /// Least and largest of the largest pressures.
    peaks: [f64; 2],
}

/// ∫ p ds of a pressure, sample by sample.
#[derive(Debug)]
struct Sum {
    sum: Vec<f64>,
    last: Vec<f64>,
}

/// Mean pressure over a groove.
#[derive(Debug)]
pub(super) struct MeanPressure {
    /// Mean of the pressure, sample by sample, a₂ fastest.
    pub pressure: Vec<f64>,
    /// Mean of the pressure on the way back, where that has another one.
    pub back: Option<Vec<f64>>,
    /// Half of the rise and fall of the largest pressure.
    pub swing: f64,
}

impl Groove {
    /// A groove that begins with a contact; `None` where the body does not wear, or along neither cell vector.
    pub fn new(Beginning { step, back, .. }: &Beginning, wear: &Wear) -> Option<Self> {
        let parts = step.grid().cell().parts(wear.direction());
        let along = (0..2).find(|&axis| parts[1 - axis].abs() < 1e-9 * parts[axis].abs())?;
        (wear.coefficient(Side::Body) > 0.0).then(|| {
            let (rows, peak) =
                (rows_in_contact(step, along), step.finest().pressures().iter().copied().fold(0.0, f64::max));
            let back = back.as_ref().map(Sum::new);
            Self { along, rows: [rows; 2], there: Sum::new(step), back, slid: 0.0, peaks: [peak; 2] }
        })
    }

    /// Adds a step of wear that ends with a contact, with that on the way back where it is another one.
    pub fn add(&mut self, worn: &WornStep, end: &Step, back: Option<&Step>) {
        self.there.add(end, worn.length);
        self.back.iter_mut().zip(back).for_each(|(sum, back)| sum.add(back, worn.length));
        self.slid += worn.length;
        self.rows[1] = rows_in_contact(end, self.along);
        self.peaks = [self.peaks[0].min(worn.max_pressure), self.peaks[1].max(worn.max_pressure)];
    }

    /// Whether it has taken in a row.
    pub fn has_widened(&self) -> bool {
        self.rows[1] > self.rows[0]
    }

    /// Whether it is longer than nothing, so that it has a mean.
    pub fn has_begun(&self) -> bool {
        self.slid > 0.0
    }

    /// Mean pressure over the groove; `None` before the first step.
    pub fn mean(self) -> Option<MeanPressure> {
        let (slid, [least, most]) = (self.slid, self.peaks);
        self.has_begun().then(|| MeanPressure {
            pressure: self.there.over(slid),
            back: self.back.map(|sum| sum.over(slid)),
            swing: 0.5 * (most - least),
        })
    }
}

impl Sum {
    /// The sum before the first step, after which the pressure is that of a contact.
    fn new(step: &Step) -> Self {
        let pressure = step.finest().pressures();
        Self { sum: vec![0.0; pressure.len()], last: pressure.to_vec() }
    }

    /// Adds a length at the end of which the pressure is that of a contact.
    fn add(&mut self, end: &Step, length: f64) {
        for ((sum, last), now) in self.sum.iter_mut().zip(&mut self.last).zip(end.finest().pressures()) {
            *sum += 0.5 * length * (*last + now);
            *last = *now;
        }
    }

    /// Mean pressure over a length of sliding.
    fn over(self, length: f64) -> Vec<f64> {
        self.sum.into_iter().map(|sum| sum / length).collect()
    }
}

/// Rows of samples across the track on which a step has contact.
fn rows_in_contact(step: &Step, along: usize) -> usize {
    let pressure = step.pressure();
    pressure.lanes(Axis(along)).into_iter().filter(|row| row.iter().any(|p| *p > 0.0)).count()
}

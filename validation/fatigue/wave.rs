//! A wave in complete contact without friction, at rest in the mean: its range of τ₁ at depths.

use super::lines::{Parts, fatigue_durability, peaks, range};
use crate::steps::{Steps, topography};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::MeanStress;
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::{Reading, contact_radii};
use percoat_core::stress::{PathSought, StressField};
use std::f64::consts::{PI, TAU};

const WAVE: &str = include_str!("wave.csv");
/// Amplitude of the shape, on E* = 1 that of the pressure over π, and the mean pressure over that.
const AMPLITUDE: f64 = 0.01;
const MEAN: f64 = 1.5;
const POINTS: [usize; 2] = [256, 8];
/// τ₁ is the largest of smooth functions: its maxima are smooth, its minima may be corners, which the least number of places a wave, 120,
/// meets to π/120 of the amplitude.
const CORNERS: f64 = PI / 120.0;

pub fn wave(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse("wave", WAVE)?;
    let mut data = Data::new("wave", &["nu", "kz", "range", "range_exact"]);
    for nu in [0.0, 0.3, 0.5] {
        let rows: Vec<&Vec<f64>> = table.rows.iter().filter(|row| row[0] == nu && row[1] == MEAN).collect();
        let depths: Vec<f64> = rows.iter().map(|row| row[2] / TAU).filter(|&z| z > 0.0).collect();
        let law = fatigue_durability()?;
        let body = Parts { coating: None, substrate: [1.0 - nu * nu, nu] }.cut(&depths, |_| law)?;
        let surface =
            topography(Cell::new([1.0, 0.0], [0.0, 1.0 / 32.0])?, POINTS, |s, _| AMPLITUDE * (TAU * s).cos())?;
        let mut steps = Steps::to(Problem::new(surface, body), POINTS, 1e-12)?;
        let unit = PI * AMPLITUDE;
        let step = steps.step(Load::MeanPressure(MEAN * unit))?;
        let field = StressField::new(step.finest(), MeanStress::Confined);
        let [radius, _] = contact_radii(&step, &Reading::of(step.finest()));
        let found = peaks(&field, radius, PathSought::ALL)?;
        for row in rows {
            data.rows.push(vec![nu, row[2], range(&found.planes, 0.0, row[2] / TAU, false)? / unit, row[3]]);
        }
    }
    let pairs = data.rows.iter().map(|row| (row[2], row[3]));
    outcome.checks.push(Check::worst(
        "wave: Δτ₁ over the amplitude of the pressure",
        pairs,
        Tolerance::Absolute(CORNERS),
    ));
    Ok(data)
}

//! References of several figures, and the errors of the mesh in what they show.

use super::model::Model;
use crate::{Check, Outcome, StudyError, Tolerance};
use percoat_core::comparison::Answer;
use percoat_core::reading::{self, LevelReading, Reading};

/// Error of the mesh in the asymmetry of a spot: from 256 to 384 points it moves by up to 1.3e-4.
pub const ASYMMETRY: f64 = 1e-4;
/// Error of the mesh in the relative change from one pressure or penetration to another, each good to 2e-4.
pub const CHANGE: f64 = 4e-4;

/// Samples along the cell to find first touches on.
const TOUCH_POINTS: usize = 192;

/// Checks of a step with three levels against an independent periodic solver (756 points along three periods; 252 and
/// 504 give the same four digits).
pub fn independent_solver(outcome: &mut Outcome, found: &Reading, peaks: [f64; 3], shares: [f64; 3], penetration: f64) {
    let tolerance = Tolerance::Relative(2e-4);
    let pair = |value: fn(&LevelReading) -> f64, expected: [f64; 3]| {
        found.levels.iter().map(value).zip(expected).collect::<Vec<_>>()
    };
    let peaks = pair(|level| level.max_pressure, peaks);
    let shares = pair(|level| level.load_share, shares);
    outcome.checks.push(Check::worst("peaks, independent solver", peaks, tolerance));
    outcome.checks.push(Check::worst("load shares, independent solver", shares, tolerance));
    outcome.checks.push(Check::new("w_a, independent solver", found.penetration, penetration, tolerance));
}

/// Checks of the loads at which the second and the third level touch, known to two or three digits.
pub fn first_touches(outcome: &mut Outcome, model: &Model, expected: [f64; 2]) -> Result<(), StudyError> {
    let touches = reading::first_touches(&mut model.steps(TOUCH_POINTS)?.solver);
    for (level, expected) in (2..).zip(expected) {
        let touch = touches[level - 1].map_or(f64::NAN, |touch| touch.mean_pressure);
        outcome.checks.push(Check::relative(format!("first touch of level {level}, p̄′"), touch, expected, 0.02));
    }
    Ok(())
}

/// Checks of the model without mutual effect against another solution of the integral equation, known to three digits;
/// `apart` tests its own to six.
pub fn isolated_law(outcome: &mut Outcome, found: &Answer, peaks: [f64; 3], penetration: f64) {
    let peaks = found.levels.iter().map(|level| level.max_pressure).zip(peaks);
    let pairs = peaks.chain([(found.penetration, penetration)]);
    let tolerance = Tolerance::Relative(1e-3);
    outcome.checks.push(Check::worst("without mutual effect: peaks and w_a, independent solution", pairs, tolerance));
}

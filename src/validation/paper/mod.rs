//! The paper itself: Figs 2 to 7 and Table 1 of Goryacheva & Torskaya (2019) with the parameters as printed, and every
//! statement of its §§ 3 and 4 held against what comes out.
//!
//! A figure is a study of its own: it draws the picture as the paper does, from the converged spectral solution and,
//! where the paper has it, without mutual effect. Its [`Claim`]s are judged by numbers; that a claim of the
//! paper does not hold is no failure, that it fares otherwise than found is one. [`table`] writes all of them into
//! `validation/paper/README.md`.

mod apart;
mod asymmetry;
mod claim;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod fig7;
mod model;
mod spot;
pub mod table;
mod table1;
mod under;

pub use claim::{Claim, Rule, Test, Verdict, pinned};

use super::{Check, Outcome, Study, StudyError, Tolerance};
use crate::observables::{LevelObservables, Observables};
use crate::touch::first_touches;
use model::{Answer, Model};

/// The studies, in the order of the paper.
pub const STUDIES: [Study; 7] =
    [fig2::STUDY, fig3::STUDY, table1::STUDY, fig4::STUDY, fig5::STUDY, fig6::STUDY, fig7::STUDY];

/// Error of the mesh in the asymmetry of a spot: from 256 to 384 points it moves by up to 1.3e-4.
const ASYMMETRY: f64 = 1e-4;
/// The same in the relative change from one pressure or penetration to another, each good to 2e-4.
const CHANGE: f64 = 4e-4;

/// Samples along the cell to find first touches on.
const TOUCH_POINTS: usize = 192;

/// Checks of a step with three levels against an independent periodic solver (756 points along three periods; 252 and
/// 504 give the same four digits).
fn against_independent_solver(
    outcome: &mut Outcome,
    found: &Observables,
    peaks: [f64; 3],
    shares: [f64; 3],
    penetration: f64,
) {
    let tolerance = Tolerance::Relative(2e-4);
    let pair = |value: fn(&LevelObservables) -> f64, expected: [f64; 3]| {
        found.levels.iter().map(value).zip(expected).collect::<Vec<_>>()
    };
    let peaks = pair(|level| level.max_pressure, peaks);
    let shares = pair(|level| level.load_share, shares);
    outcome.checks.push(Check::worst("peaks, independent solver", peaks, tolerance));
    outcome.checks.push(Check::worst("load shares, independent solver", shares, tolerance));
    outcome.checks.push(Check::new("w_a, independent solver", found.penetration, penetration, tolerance));
}

/// Checks of the loads at which the second and the third level touch, known to two or three digits.
fn against_first_touches(outcome: &mut Outcome, model: &Model, expected: [f64; 2]) -> Result<(), StudyError> {
    let touches = first_touches(&mut model.steps(TOUCH_POINTS)?.hierarchy);
    for (level, expected) in (2..).zip(expected) {
        let touch = touches[level - 1].unwrap_or(f64::NAN);
        outcome.checks.push(Check::relative(format!("first touch of level {level}, p̄′"), touch, expected, 0.02));
    }
    Ok(())
}

/// Checks of the model without mutual effect against another solution of the integral equation, known to three digits;
/// `apart` tests its own to six.
fn against_isolated_law(outcome: &mut Outcome, found: &Answer, peaks: [f64; 3], penetration: f64) {
    let peaks = found.levels.iter().map(|level| level.peak).zip(peaks);
    let pairs = peaks.chain([(found.penetration, penetration)]);
    let tolerance = Tolerance::Relative(1e-3);
    outcome.checks.push(Check::worst("without mutual effect: peaks and w_a, independent solution", pairs, tolerance));
}

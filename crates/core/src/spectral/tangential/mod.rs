//! Partial slip: the contact sticks where Coulomb's law bears it, and slips elsewhere.
//!
//! - `operator`: tangential displacements under tractions and pressure; `disc`: the tractions that Coulomb's law admits;
//! - `stick_slip`: one step as a convex problem, with its certificate; `preconditioner`: by levels of slip; `plain`: the same step in plain lines, for
//!   its tests;
//! - `prolonged`: the tractions of a coarser grid as a start;
//! - `track`: steps one after another on one grid, together with the normal contact;
//! - `rolling`: the history as it moves through a contact that rolls;
//! - [`SlipSolver`]: steps on several tracks at once, with the errors of their results.

mod aim;
mod disc;
mod operator;
#[cfg(test)]
mod plain;
mod preconditioner;
mod prolonged;
mod rolling;
mod solver;
mod stick_slip;
#[cfg(test)]
mod tests;
mod track;

pub(crate) use disc::sticks;
pub use rolling::{NotAlongGrid, Rolling};
pub use solver::{Drive, MeasuredVector, RollError, RollingDrive, Slides, SlipError, SlipSolver, SlipStep};
pub use stick_slip::{SlipReport, SlipSettings};

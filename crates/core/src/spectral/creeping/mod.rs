//! Contact of bodies that creep, from time to time: each step in time is an elastic contact with another compliance, below a surface that
//! earlier pressures have displaced.
//!
//! - [`CreepSolver`]: a problem along a path of times and loads; [`CreepStep`]: its state at one time;
//! - `surface_history`: the pressure of a grid as far as it counts, with the operator and the displacement of an interval;
//! - `pace`: lengths of the steps in time, by the error of each.

mod error;
mod pace;
mod solver;
mod surface_history;

pub use error::CreepError;
pub use solver::{CreepSolver, CreepStep, TIME_TOLERANCE, TimeError};

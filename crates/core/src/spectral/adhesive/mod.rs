//! Surfaces that adhere: the gap is sought instead of the pressure, whose sign is free.
//!
//! - `tension`: the law over the gap, as a grid holds it; `elastic`: the bodies, displacement → pressure and back;
//! - `minimiser`: the gap of least energy near that of a start; `stability`: how far that is from a jump;
//! - `track`: a state at a load on one grid; `walk`: from state to state, with jumps and pull-off; `plain`: the twin by contacts without tension;
//! - [`AdhesiveSolver`]: from load to load on two grids.

mod elastic;
mod minimiser;
#[cfg(test)]
mod plain;
mod solver;
mod stability;
mod tension;
#[cfg(test)]
mod tests;
mod track;
mod walk;

pub use elastic::widths;
pub use solver::{
    AdhesiveError, AdhesiveSolver, AdhesiveStep, FEW_ACROSS, FEWEST_ACROSS, check_grid, samples, zone_law,
};
pub use tension::soft_end;
pub use track::Numbers as AdhesiveNumbers;
pub use walk::{Jump, PullOff};

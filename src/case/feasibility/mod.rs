//! Whether a case can be solved on this machine, and whether it means what it says.
//!
//! `magnitude` refuses what double precision cannot carry, while the case is read. [`resources`] estimates memory and disk of a run
//! and refuses what does not fit, an [`Allowed`] job fits. [`plausibility`] warns of what looks mixed up, with `si_sizes` of numbers that no material has in
//! its SI units and `sublayers` of graded layers that are laid out too coarsely. `single_contact` estimates steep flanks and
//! coarse grids before anything is solved.

mod allowed;
pub(super) mod magnitude;
pub mod plausibility;
pub mod resources;
mod si_sizes;
pub(super) mod single_contact;
pub(super) mod sublayers;

pub use allowed::Allowed;

//! Whether a case can be solved on this machine, and warnings about implausible numbers.
//!
//! `magnitude` refuses ratios beyond double precision while the case is read, `hardness` loads that the surfaces cannot bear. [`resources`] estimates memory and disk of a run; an
//! [`Allowed`] job fits into them. [`plausibility`] warns of units mixed up, `si_sizes` of values that no material has in SI units,
//! `durability` of hardness, wear and fatigue that no material has, `sublayers` of graded layers with too few sublayers, `single_contact` of steep flanks and coarse grids, `ball` of contacts of balls that
//! no solid bears, `adhesion` of surfaces that pull more than materials bear, `silent` of properties that have no effect.

mod adhesion;
mod allowed;
mod ball;
mod durability;
pub(super) mod hardness;
pub(super) mod magnitude;
pub mod plausibility;
pub mod resources;
mod si_sizes;
mod silent;
pub(super) mod single_contact;
mod springs;
pub(super) mod sublayers;

pub use allowed::Allowed;

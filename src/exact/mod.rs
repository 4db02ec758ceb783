//! Closed forms of contact mechanics that percoat is held against.
//!
//! They share nothing with the solver: each is an equation of its own source, written down once for the tests, for
//! [`crate::validation`] and for whoever needs a number without a grid.

pub mod coated_contact;
pub mod coating;
pub mod galin;
pub mod hertz;
pub mod lattice_sums;
pub mod localization;
pub mod periodic_hertz;
mod quadrature;
pub mod sinusoidal;
pub mod wavy;
pub mod westergaard;

pub use coated_contact::CoatedContact;
pub use coating::Coating;
pub use galin::{Contact, Term};
pub use hertz::Hertz;
pub use lattice_sums::Sums;
pub use localization::Localization;
pub use periodic_hertz::System;
pub use wavy::Wavy;

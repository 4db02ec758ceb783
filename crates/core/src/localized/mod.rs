//! The paper's own method: boundary elements inside a circle, the mean pressure outside it.
//!
//! Around an indenter of each level a circle holds a number of indenters, each with its own pressure, equal for all
//! indenters of a site; outside it acts p̄. The displacement under the indenter in its centre is
//!
//! w(**x**) = Σ_c Σ_i ∫ K(|**x** − **r**_i − **y**|) p_c(**y**) d²y − p̄ D_R(|**x**|),
//!
//! K the displacement under a point force on the layered surface, D_R that under a disc of the circle's radius: uniform
//! p̄ outside the disc is p̄ everywhere, which only moves the mean plane, minus p̄ on the disc. In the place of p̄ the
//! indenters outside can act themselves, as a lattice sum. In contact w + f − δ = 0 with one penetration δ for all levels, and
//! all pressures together carry p̄, Eq. (5).
//!
//! The method shares with the spectral solver only the indenters' shapes, the layered half-space (transfer function and
//! amplitudes) and general numerics, so that each checks the other. The boundary of a contact is read in its own way too:
//! `outline` fits pressures and gaps with separate slopes and the ratios of `edge_ratios`, where the spectral reading fits the
//! gap alone; the two readings share six constants. In the order of use:
//!
//! - `quadrature`, [`point`]: K by adaptive quadrature of the layer correction, tabulated;
//! - [`square`], [`disc`]: influence coefficients, Eq. (7), and the far field;
//! - `circle`: the indenters inside, and the radius, Eq. (4); [`exterior`]: the lattice sum outside, in the place of p̄;
//! - [`mesh`], `press`: elements and the contact of one spot; [`spot`], `edge_ratios`, `outline`: its readings;
//! - [`System`]: the indenters and the half-space; [`Setup`]: circles and elements;
//! - [`Coupled`], `passes`, `exchange`: level by level to one penetration and one load; [`Localized`]: on meshes that fit the contacts;
//! - [`Solution`]: its readings, and the additional displacement w_a of Eq. (8); [`stress`], `subsurface`: the stresses below;
//! - [`isolated`]: indenters without mutual effect.

pub mod circle;
mod coupled;
pub mod disc;
pub(crate) mod edge_ratios;
mod exchange;
pub mod exterior;
pub mod isolated;
pub mod mesh;
pub(crate) mod outline;
mod passes;
mod patterns;
pub mod point;
pub(crate) mod press;
pub(crate) mod quadrature;
mod solution;
mod solver;
pub mod spot;
pub mod square;
pub mod stress;
mod subsurface;
mod system;
mod tables;

pub use circle::{Circle, CircleRadius};
pub use coupled::Coupled;
pub use solution::{Solution, Stop};
pub use solver::{Localized, LocalizedError, Setup};
pub use system::System;

//! The paper's own method: boundary elements inside a circle, the nominal pressure outside it.
//!
//! Around an indenter of each level a circle holds a number of indenters, each with its own pressure (the same pattern
//! for all indenters of a site); outside it acts p̄. The displacement under the indenter in its centre is
//!
//! w(**x**) = Σ_c Σ_i ∫ K(|**x** − **r**_i − **y**|) p_c(**y**) d²y − p̄ D_R(|**x**|),
//!
//! K the displacement under a point force on the layered surface, D_R that under a disc of the circle's radius: uniform
//! p̄ outside the disc is p̄ everywhere, which only moves the mean plane, minus p̄ on the disc. In its place the indenters
//! outside can stand themselves, as a lattice sum. Contact means w + f − δ
//! = 0 with one penetration δ for all levels, and all pressures together carry p̄, Eq. (5).
//!
//! It shares nothing with the spectral solver but the indenters' shapes, the layered half-space (transfer function and
//! amplitudes) and general numerics, so that each checks the other; also the boundary of a contact is read in its own way
//! (`outline`, from pressures and gaps with slopes of their own, after an edge law computed for it in `edge`, where the
//! spectral reading takes the gap alone). In the order of building:
//!
//! - `quadrature`, [`point`]: K by adaptive quadrature of the layer correction, tabulated;
//! - [`square`], [`disc`]: influence coefficients, Eq. (7), and the far field;
//! - `circle`: who stands inside, and the radius, Eq. (4); [`exterior`]: the lattice sum outside, in the place of p̄;
//! - [`mesh`], `press`: elements and the contact of one spot; [`spot`], `edge`, `outline`: what is read off it;
//! - [`System`]: the indenters and what they press into; [`Setup`]: what is asked for;
//! - [`Coupled`]: level by level to one penetration and one load; [`Localized`]: on meshes that fit;
//! - [`Solution`]: what is read off it, and the additional displacement w_a of Eq. (8); [`stress`]: the stresses below;
//! - [`isolated`]: indenters without mutual effect.

pub(crate) mod circle;
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
mod system;
mod tables;

pub use circle::{Circle, CircleRadius};
pub use coupled::Coupled;
pub use solution::{Solution, Stop};
pub use solver::{Localized, NoIndenters, Setup};
pub use system::System;

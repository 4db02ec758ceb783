//! Normal contact on one grid: p ≥ 0, g = w + f − δ ≥ 0, p g = 0, with w = C p.
//!
//! Without friction, or without its coupling, it is the minimum of ½⟨p, Cp⟩ + ⟨p, f⟩ over p ≥ 0 with a given mean (load control),
//! or of ½⟨p, Cp⟩ + ⟨p, f − δ⟩ over p ≥ 0 with a given δ (displacement control). Under coupled friction w = A p with C the
//! symmetric part of A.
//!
//! A [`ContactProblem`] is solved from and into [`Unknowns`], with any elastic operator:
//!
//! ```text
//! init       problem          operator, initial gap, load, tolerance
//!            admissible       the pressures of the search: where contact may occur, between which bounds, projection, duality
//!            fields           unknowns and working fields, and what lies in whose memory
//!            route, fallback  what iterates: nothing, a variant of the method, a search for the load
//!            full_step        pressures of zero and the hardness alone
//! step       preconditioned   the method, by inner_iteration; direction and update are its fused loops
//!            plain            its twin in plain lines
//!            splitting        under a strong skew part: splitting around the method, set_system for its trials
//!            polonsky_keer    the baseline
//! terminate  check            criteria of convergence from one convolution, with the certificate
//!            stopping         no progress, or nothing but rounding
//!            monotone_bound   the error under a skew part, sharply
//!            report           reason and route
//! ```
//!
//! **Stopping.** By the [`Certificate`] of the pressure alone, with one tolerance:
//!
//! - energy gap: Σ p (g − min g) / ½⟨p, Cp⟩ < 20 tolerance (min(0, min g) under displacement control);
//! - residual: ε = Σ p|g| / (δ Σp) < tolerance;
//! - deepest penetration outside contact < 10 tolerance · δ,
//!
//! where δ is the penetration below first touch, the scale of the deformation: dimensionless, so the unit of length
//! does not matter, and as sharp at first touch as near full contact. ε is an average: it is small for a start interpolated
//! onto a fine grid, which errs on the few samples of the edges alone; the energy gap is not. Under load control
//! Σ pg = 0, the gap is |min g| Σp, and ½⟨p, Cp⟩ ≤ ½ δ Σp: the first line then holds |min g|, in contact too, to the
//! third line's 10 tolerance · δ. That is where the 20 comes from.
//!
//! An iteration that stalls, and that rounding alone keeps from these, has converged to rounding (`stopping`).

mod admissible;
mod bounds;
mod certificate;
mod check;
mod direction;
mod duality;
mod fallback;
mod fields;
mod full_step;
mod inner_iteration;
mod monotone_bound;
#[cfg(test)]
mod plain;
mod polonsky_keer;
mod preconditioned;
mod problem;
mod projection;
mod report;
mod route;
mod set_system;
mod splitting;
mod stopping;
mod update;

pub use admissible::AdmissibleSet;
pub use bounds::Bounds;
pub use certificate::Certificate;
pub use fields::{Unknowns, Working};
pub use monotone_bound::ErrorNorm;
pub use problem::{ContactProblem, Method, Settings};
pub use report::{Progress, Report, Route, Stop};
pub(in crate::spectral) use set_system::{Invertible, SampleSet};

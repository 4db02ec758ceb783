//! Normal contact on one grid: p ≥ 0, g = w + f − δ ≥ 0, p g = 0, with w = C p.
//!
//! Without friction, or without its coupling, it is the minimum of ½⟨p, Cp⟩ + ⟨p, f⟩ over p ≥ 0 with a given mean (load control), or of ½⟨p, Cp⟩ + ⟨p, f − δ⟩ over
//! p ≥ 0 with a given δ (displacement control). Two conjugate-gradient methods are offered,
//! `preconditioned` and `polonsky_keer`; what they return is judged by the [`Certificate`] of the pressure alone. Under coupled friction w = A p with C the
//! symmetric part of A: the traction follows the steps of the first method, or an outer iteration around it (`solve`).
//!
//! **Stopping.** On what is certified, with one tolerance:
//!
//! - energy gap: Σ p (g − min g) / ½⟨p, Cp⟩ < 20 tolerance (min(0, min g) under displacement control);
//! - residual: ε = Σ p|g| / (δ Σp) < tolerance;
//! - deepest penetration outside contact < 10 tolerance · δ,
//!
//! where δ is the penetration below first touch, the scale of the deformation: dimensionless, so the unit of length
//! does not matter, and as sharp at first touch as near full contact. ε is an average: a start interpolated onto a fine
//! grid errs on the few samples of the edges alone, and ε lets it pass; the energy gap does not. Under load control
//! Σ pg = 0, the gap is |min g| Σp, and ½⟨p, Cp⟩ ≤ ½ δ Σp: the first line then holds |min g|, in contact too, to the
//! third line's 10 tolerance · δ. That is where the 20 comes from.
//!
//! Where an iteration stalls at what rounding alone makes of these, it has converged as far as double precision carries (`rounding`).

mod certificate;
mod check;
mod directions;
mod iterate;
mod load_search;
mod polonsky_keer;
mod preconditioned;
mod problem;
mod report;
mod residuals;
mod rounding;
mod settings;
mod solve;
mod steps;
mod stopping;
mod unknowns;
mod working;

pub use certificate::Certificate;
pub use problem::GridProblem;
pub use report::{Progress, Report, Route, Stop};
pub use settings::{Method, Settings};
pub use unknowns::Unknowns;
pub use working::Working;

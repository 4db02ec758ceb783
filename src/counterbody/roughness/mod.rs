//! Rough surfaces: made periodic, resampled, measured and generated.
//!
//! Heights h are given at N₁ × N₂ samples of a cell, axis 0 along **a**₁, axis 1 along **a**₂. Between the samples the surface is
//! the sum of the shortest waves through them, h(**x**) = h̄ + Σ ĥ_**q** e^{i**q**·**x**} over the first Brillouin zone of the
//! samples; on another grid it is that sum ([`Spectrum::resampled`]).

mod apex;
mod band;
mod border;
mod jet;
mod plane;
mod self_affine;
mod spectrum;
mod statistics;
mod window;

pub(crate) use apex::apex;
pub use border::{MAX_BORDER_JUMP, border_jumps};
pub use plane::levelled;
pub use self_affine::{Rms, SelfAffine, SelfAffineError};
pub use spectrum::{Radial, Spectrum};
pub use statistics::Statistics;
pub use window::{RunOut, Window, tapered};

//! Rough surfaces: freed of their form, of holes and of short waves, made periodic, resampled, measured and generated.
//!
//! Heights h are given at N₁ × N₂ samples of a cell, axis 0 along **a**₁, axis 1 along **a**₂. Between the samples the surface is
//! the sum of the shortest waves through them, h(**x**) = h̄ + Σ ĥ_**q** e^{i**q**·**x**} over the first Brillouin zone of the
//! samples; on another grid it is that sum ([`Spectrum::resampled`]).

mod apex;
mod band;
mod border;
mod form;
mod gaussian;
mod holes;
mod jet;
mod kink;
mod noise;
mod plane;
mod polynomial;
mod round;
mod self_affine;
mod spectrum;
mod statistics;
mod window;

pub(crate) use apex::{apex, apex_by};
pub use border::{MAX_BORDER_JUMP, border_jumps};
pub use form::{FormError, SurfaceForm, without_form};
pub use gaussian::{MEMORY as SMOOTHING_MEMORY, smoothed};
pub use holes::{MEMORY as FILLING_MEMORY, filled};
pub(crate) use kink::above_waves;
pub use noise::{Noise, short_wave_noise};
pub use self_affine::{Rms, SelfAffine, SelfAffineError};
pub use spectrum::{Radial, Spectrum};
pub use statistics::{MeasuredRms, Statistics};
pub use window::{RunOut, Window, tapered};

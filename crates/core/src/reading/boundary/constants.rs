//! Constants of the fits of contact boundaries, those of the spectral reading and of the localized one.
//!
//! Chosen by experiment. `validation/discretisation` (random contacts against grids four times as fine), `validation/rings` and
//! `validation/thin-coatings` (closed forms) hold the spectral reading to the errors it states with them; the tests in
//! `crates/core/src/reading/boundary/mod.rs` and `crates/core/src/localized/outline.rs` hold both readings to Hertz' contact and to rings. A spacing is
//! the distance between neighbouring samples, or the side of an element of the localized method.

/// Fewest spacings along a radius for a fit.
pub(crate) const MIN_RESOLUTION: f64 = 3.0;
/// Highest harmonic of a boundary that is not a polygon.
pub(crate) const HARMONICS: usize = 6;
/// Distance from the edge, in spacings, over which the weight of a sample rises from zero to one.
pub(crate) const WEIGHT_RISE: f64 = 2.5;
/// Largest distance of a fitted boundary from the counted one, in spacings, beside a part of its radius: beyond it the fit is
/// rejected.
pub(crate) const MAX_SHIFT: f64 = 2.0;
/// Error of the radius of a counted area, in spacings. Where the fit is good, counting errs by 0.27 elements at most (530
/// outlines of the localized method on bare bodies, soft and hard coatings).
pub(crate) const COUNTED_ERROR: f64 = 0.5;
/// Largest number of iterations of a fit, each from the boundary of the last.
pub(crate) const MAX_ITERATIONS: usize = 8;

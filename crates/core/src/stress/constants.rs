//! Constants of the largest stresses and of their stated errors, fitted by experiment.
//!
//! `tests/library/surface_stress.rs` (`full_table` prints the errors of the surface stresses of Hertz' contact by samples per
//! contact radius; random contacts against grids four times as fine), `tests/library/largest_stresses.rs` (dense searches of
//! random stacks) and `tests/library/stated_errors.rs` (sliding contacts) chose them and hold them to what is stated;
//! `validation/hertz-stresses`, `validation/sliding-sphere`, `validation/sliding-wave` and `validation/convergence` compare with
//! closed forms. n is the number of samples along the radius of a contact spot, a spacing the distance between samples.

/// Width of the Gaussian near an edge, times the least wavenumber that the grid cannot hold.
pub(super) const EDGE_WIDTH: f64 = 4.5;
/// Width of the Gaussian away from edges, times the least wavenumber that the grid cannot hold.
pub(super) const OPEN_WIDTH: f64 = 3.0;
/// n of the smallest spot from which on the width near edges grows against the spacing, and the power of n with which it does.
pub(super) const WIDTH_GROWTH: (f64, f64) = (12.0, 0.4);
/// Distances from the edge, in widths, within which the stress is the sharpened one and beyond which it is the series itself.
pub(super) const BLEND: [f64; 2] = [1.0, 3.0];

/// Factors of the usual widths with which the largest tension is read again; the changes estimate its error.
pub(super) const OTHER_WIDTHS: [f64; 2] = [0.7, 1.45];
/// Number of edges that are compared by the exact sum.
pub(super) const EXACT_EDGES: usize = 8;
/// Least error of a tension at an edge, times n²: over the tension itself, and over the usual one.
pub(super) const EDGE_ERROR: f64 = 0.3;
/// Least error of the cusp that a traction makes at the trailing edge, times n, over the stress 2μp that leads to it.
pub(super) const CUSP_ERROR: f64 = 0.22;
/// Error of the cusp where coupling ends the pressure like d^{½+η}, over |η| n^{|η|−½} and the stress that leads to the cusp
/// (`validation/sliding-wave`).
pub(super) const EXPONENT_ERROR: f64 = 0.1;
/// Usual tension at an edge over the largest pressure: (1 − 2ν)/3 at Hertz' contact.
pub(super) const USUAL_TENSION: f64 = 0.13;
/// Safety factor of the error of a largest surface stress, with which nineteen of twenty stated errors hold.
pub(super) const CREST_SAFETY: f64 = 1.5;
/// Change of a largest surface stress from the next coarser grid over the error on the finer one. Errors fall at least as n^{−1.5},
/// so that with twice the spacing the ratio is 2^{1.5} − 1. Under a counterbody that slides they fall as n^{−1.2} where an edge lies
/// awkwardly between the samples (`validation/sliding-sphere`), with the ratio 2^{1.2} − 1 = 1.3, which [`CREST_SAFETY`] covers.
pub(super) const CHANGE_OVER_ERROR: f64 = 1.8;

/// Part of the changes by the [`OTHER_WIDTHS`], and of the waves unlike those of the surface material, in the error at an edge where the
/// cusp of a traction makes at least [`CUSP_PART`] of the stress: what smoothing leaves there is mostly [`CUSP_ERROR`]
/// (`tests/library/sliding_edges.rs`).
pub(super) const CUSP_SPREAD: f64 = 0.4;
/// Part of the change from the next coarser grid in that error.
pub(super) const CUSP_CHANGE: f64 = 0.2;
/// Least part of the stress 2μp in one at a sliding edge for these factors; below it the edge is nearly one at rest.
pub(super) const CUSP_PART: f64 = 0.5;

/// Depth in spacings down to which the series converges slowly.
pub(super) const SHALLOW: f64 = 2.0;
/// Factor of the change of a stress from the next coarser grid in its error.
pub(super) const CHANGE_SAFETY: f64 = 1.6;
/// Least error of a stress above [`SHALLOW`] spacings, times n, over the size of the stress.
pub(super) const SHALLOW_ERROR: f64 = 0.2;
/// Least error of a shear below, times n², over the size of the stress.
pub(super) const DEEP_SHEAR_ERROR: f64 = 0.015;
/// Least error of the opening stress of an interface below, times n², over the size of the stress.
pub(super) const DEEP_OPENING_ERROR: f64 = 0.01;
/// Least error of a tension below, times n², over the size of the stress.
pub(super) const DEEP_TENSION_ERROR: f64 = 0.1;

/// Least error of a stress below under discs, whose waves are known, over the size of the stress: what the polynomials of the free field
/// leave of it.
pub(super) const EXACT_ERROR: f64 = 1e-5;

/// Largest part of a maximum that the samples of a plane may miss: planes whose largest sample lies lower are no starts of a climb.
pub(super) const MISSED_BY_SAMPLES: f64 = 0.05;
/// Rise of a maximum between three planes above the middle one, over the larger drop beside it: a parabola rises by an eighth
/// where the planes are equally far apart; twice that is allowed for.
pub(super) const RISE_BETWEEN_PLANES: f64 = 0.25;
/// Largest relative difference of value and depth of maxima that are equal by symmetry.
pub(super) const EQUAL_BY_SYMMETRY: f64 = 1e-3;

/// Part of a stress in a section by which equal ones of mirror images differ, as closely as contacts are solved: the first of them is the
/// largest, whatever the processor.
pub(crate) const SAME_IN_SECTION: f64 = 1e-6;

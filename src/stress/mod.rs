//! Stresses and displacements inside coating and substrate, exact per wavenumber.
//!
//! Each plane wave c e^{i**q**·**x**} of the pressure, with **n** = **q**/q, causes at the depth z
//!
//! σ_zz = s_zz c e^{i**q**·**x**},  σ_αz = −i n_α s_qz c e^{…},  σ_αβ = [n_α n_β s_qq + (δ_αβ − n_α n_β) s_tt] c e^{…},
//! u_z = u_z c e^{…},  u_α = −i n_α u_q c e^{…}
//!
//! with the amplitudes of [`crate::layered::Interior`]; the mean pressure adds the state of [`MeanStress`]. At the
//! depth z only waves with qz up to 60 count.
//!
//! - **planes**: inverse transforms, one component at a time ([`Field::plane`]);
//! - **sections** and **lines**: the waves are first collapsed across the section onto their wavenumbers along it
//!   ([`Field::section`]);
//! - **points**: the sum itself ([`Field::points`]);
//! - **maxima** over each material and each face ([`maxima`]).

mod field;
pub mod maxima;
mod mean;
mod section;
mod spectrum;
mod tensor;

pub use field::{Depth, Field, Plane};
pub use mean::MeanStress;
pub use section::Line;
pub use tensor::State;

/// Estimated relative error of the largest tension on the surface with `samples` = a/√(sample area) per contact radius.
///
/// A pressure ends at the edge of contact like a square root, so that its series converges slowly on the surface.
/// Measured under a sphere on a half-space (`tests/surface_stress.rs`, worst of several places on the grid; σ_r over
/// the peak pressure p₀):
///
/// | samples | largest tension | σ_r, r < 0.8a | within a spacing of the edge | σ_r at z = 0.05a | largest τ₁ below |
/// |---|---|---|---|---|---|
/// | 5 | 15 % | 1.8e-2 | 0.10 | 2.5e-2 | 1.6e-3 |
/// | 10 | 7 % | 3.4e-3 | 0.07 | 8.2e-3 | 9.5e-5 |
/// | 21 | 2.6 % | 1.5e-3 | 0.05 | 2.3e-3 | 4.5e-5 |
/// | 41 | 0.4 % | 6.1e-4 | 0.04 | 6.6e-4 | 3.6e-5 |
/// | 165 | 1.0 % | 7.7e-5 | 0.02 | 7.9e-5 | 2.9e-5 |
///
/// The bound is max(1.2 n^−1.2, 0.012): the largest tension is too low on coarse grids, where no sample stands at the
/// edge, and too high by the overshoot of the series, at most 1 %, on fine ones. On a hard coating thinner than the
/// contact radius the largest tension stands off the edge and errs by less than 0.14/n. For other shapes, soft coatings
/// and merged contacts the bound is an indication.
pub fn surface_error(samples: f64) -> f64 {
    (1.2 * samples.powf(-1.2)).max(0.012)
}

//! Closed forms of contact mechanics that percoat is held against.
//!
//! The forms share nothing with the solver: each is an equation of its own source, written down once for the studies,
//! for the tests and for whoever needs a number without a grid.

pub mod cattaneo_mindlin;
pub mod coated_contact;
pub mod coating;
pub mod galin;
pub mod hertz;
pub mod lattice_sums;
pub mod localization;
pub mod periodic_hertz;
pub mod sinusoidal;
pub mod sliding_sphere;
pub mod sliding_wave;
pub mod wavy;
pub mod westergaard;

pub use cattaneo_mindlin::CattaneoMindlin;
pub use coated_contact::CoatedContact;
pub use coating::Coating;
pub use galin::{Contact, Term};
pub use hertz::Hertz;
pub use lattice_sums::Sums;
pub use localization::Localization;
pub use periodic_hertz::System;
pub use sliding_wave::SlidingWave;
pub use wavy::Wavy;

/// Abscissae, ascending, and weights of the Gauss–Legendre rule of `n` points on [`from`, `to`].
fn gauss_between(from: f64, to: f64, n: usize) -> Vec<[f64; 2]> {
    let half = 0.5 * (to - from);
    percoat_core::numeric::quadrature::gauss(n)
        .into_iter()
        .map(|[x, weight]| [0.5 * (from + to) - half * x, half * weight])
        .collect()
}

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

mod edge;
mod field;
pub mod maxima;
mod mean;
mod section;
mod spectrum;
mod spots;
mod surface;
mod tensor;

pub use field::{Depth, Field, Plane};
pub use mean::MeanStress;
pub use section::{Line, Trace};
pub use surface::Crest;
pub use tensor::State;

//! Stresses and displacements inside coating and substrate, exact per wavenumber.
//!
//! Each plane wave c e^{i**q**·**x**} of the pressure, with **n** = **q**/q, causes at the depth z
//!
//! σ_zz = s_zz c e^{i**q**·**x**},  σ_αz = −i n_α s_qz c e^{…},  σ_αβ = [n_α n_β s_qq + (δ_αβ − n_α n_β) s_tt] c e^{…},
//! u_z = u_z c e^{…},  u_α = −i n_α u_q c e^{…}
//!
//! with the amplitudes of [`crate::body::Interior`]; the mean pressure adds the state of [`crate::MeanStress`]. At the
//! depth z only waves with qz up to 32 count: the stresses of shorter ones are below 5·10⁻¹³ of their traction.
//!
//! A tangential traction **q** adds its own stresses, wave by wave: of the part **q**·**n** along **n** by
//! the amplitudes of [`LayeredResponse::interior`](crate::body::LayeredResponse::interior), of the part across by those of
//! [`Antiplane`](crate::body::Antiplane); its mean adds the shear σ_αz = −q̄_α at every depth. A [`Traction`] says what **q** is: μp**e**
//! of a counterbody that slides, with μ**e** times the waves of the pressure, or two fields with waves of their own. The residual stress of a
//! layer adds to its σ_xx and σ_yy. Coupled friction changes the pressure's square root at the edge of contact into the powers
//! ½ ± η, |η| ≤ atan(μβ)/π, β = (1 − 2ν)/(2(1 − ν)): readings at edges treat them as square roots, and state the error
//! that the grids show.
//!
//! - **planes**: inverse transforms of the components, from the waves that reach the depth, as arrays or row by row ([`StressField::plane`], [`StressField::stresses_by_rows`]);
//! - **sections** and **lines**: the waves summed by their wavenumbers along the line ([`StressField::section`]);
//! - **points**: the exact sum ([`StressField::points`]);
//! - **paths**: the stresses that points of the body meet while the counterbody slides ([`SlidingPath`]);
//! - **maxima** over each material and each face ([`maxima`]).

mod beyond_window;
mod chord;
mod climb;
mod constants;
mod contender;
mod crest;
mod cubic;
mod depth_response;
mod deviator;
mod disc_crest;
mod disc_waves;
mod eight_waves;
mod enclosing_ball;
mod expansion;
mod far_field;
mod far_plane;
mod far_tables;
mod field;
mod fields;
mod found;
mod line_around;
mod line_cycles;
mod line_path;
mod line_plane;
mod loaded_window;
mod loss;
pub mod maxima;
mod mean_states;
mod measure;
mod passed;
mod passed_expansion;
mod passed_shells;
mod path_measure;
mod path_search;
mod peak;
mod phases;
mod plane;
mod plane_search;
mod rainflow;
mod range_map;
mod range_plane;
mod regions;
mod search;
mod section;
mod series;
mod series_grid;
mod sliding_path;
mod smoothed_edge;
mod smoothed_shear;
mod smoothed_surface;
mod strain;
mod strength_peaks;
mod surroundings;
mod tables;
mod taylor;
mod temperature_field;
mod tensor;
mod thermal;
mod trace;
mod traction;
mod traction_waves;
mod transform;
mod window_waves;
mod work;

pub(crate) use constants::SAME_IN_SECTION;
pub use crest::Crest;
pub use field::StressField;
pub use fields::StressFields;
pub use loaded_window::bytes_far;
pub(crate) use loss::losses;
pub use path_search::{Others, PassOver, PathPeak, PathPeaks, PathSought, transmitted};
pub use peak::{Peak, Rival};
pub use plane::DepthPlane;
pub use range_plane::RangePlane;
pub use section::{SurfaceLine, VerticalSection};
pub use series_grid::times as series_times;
pub use sliding_path::SlidingPath;
pub(crate) use sliding_path::period_along;
pub use strain::{Compliance, StrainState};
pub(crate) use strength_peaks::StrengthPeaks;
pub(crate) use tables::Tables;
pub use temperature_field::TemperatureField;
pub use tensor::StressState;
pub use traction::Traction;
pub use work::StressWork;

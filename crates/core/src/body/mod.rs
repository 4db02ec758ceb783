//! Response of a layered elastic half-space to plane harmonic tractions on its surface: pressure, and shear along and across
//! the wavevector.
//!
//! ξ runs along the wavevector, z into the body, x = qz. With the amplitudes p and t of the tractions
//! σ_zz = −p cos, σ_qz = t sin, and of the displacements u_z = w cos, u_q = −U sin, plane strain
//! across the wavevector gives, going **up** (ζ = −x, displacements in units of 1/(Gq)):
//!
//! dU/dζ = w + t,  dw/dζ = −r U + m p,  dt/dζ = e U + r p,  dp/dζ = −t,
//! e = 2/(1−ν),  r = ν/(1−ν),  m = (1−2ν)/(2(1−ν)),
//!
//! equilibrium and Hooke's law for the four quantities that interfaces connect (with the stress function F of the plane
//! problem, p = F and t = F′). Two tools are enough, and neither contains a growing exponential:
//!
//! - `minors`: everything below a depth confines (U, w, t, p) to a plane; the plane's five 2 × 2 minors are
//!   carried from the substrate up (delta-matrix method, Dunkin 1965). The surface compliance is a ratio of two
//!   of them.
//! - `interior`: everything above a depth imposes "no shear at the surface" (under a shear traction: no pressure), one
//!   linear functional carried from the surface down. Plane and functional meet in one vector: the amplitudes at that depth.
//!
//! Across the wavevector the body is sheared alone (`across`). Under all three tractions the surface responds by one
//! Hermitian 3 × 3 matrix, the [`SurfaceResponse`].
//!
//! On a rigid base U = w = 0: there the plane is that of (t, p), its only minor N. What holds of the layers on an elastic
//! substrate holds of those on a rigid base, which is its limit; the recursion starts with the limit itself.
//!
//! The moduli G and ν may be complex ([`Moduli`]): wavenumbers and thicknesses are real, and so are all exponents.
//!
//! Everything belongs to the [`LayeredResponse`] of a [`HalfSpace`]. For many wavenumbers there are tables: of the surface
//! compliance (`compliances`) and of the interior (`interior_table`).

mod across;
mod bending;
mod bodies;
mod compliances;
mod composite_hardness;
mod conduction;
mod depth;
mod durability;
mod functional;
mod half_space;
mod interior;
mod interior_table;
mod layer;
mod material;
mod mean;
mod minors;
mod moduli;
mod moving;
mod names;
mod passed_table;
mod relaxation;
mod response;
mod strain_life;
mod strata;
mod strength;
mod stress_function;
mod substrate;

pub use across::Antiplane;
pub use bodies::Bodies;
pub(crate) use compliances::{Compliances, ShearCompliances};
pub use composite_hardness::{CompositeError, CompositeHardness, HardnessLaw};
pub use conduction::{Conduction, ConductionError};
pub use depth::Depth;
pub use durability::{Durability, Endurance, Fatigue};
pub use half_space::HalfSpace;
pub use interior::{Amplitudes, InPlane, Interior};
pub use interior_table::{InteriorTable, REACH};
pub use layer::{Interface, Layer};
pub use material::{Material, MaterialError};
pub use mean::MeanStress;
pub use moduli::Moduli;
pub use names::{InterfaceId, MaterialId, Name, Side};
pub use passed_table::PassedTable;
pub use relaxation::{ConstantModulus, Relaxation, RelaxationError, RelaxationTerm};
pub use response::{LayeredResponse, SurfaceResponse};
pub use strain_life::{StrainDirection, StrainLife};
pub use strength::{InterfaceStrength, Strength};
pub(crate) use stress_function::derivatives as stress_function_derivatives;
pub use substrate::Substrate;

pub use crate::numeric::number::Number;

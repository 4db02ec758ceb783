//! Parameters of a layered body from the stiffness of unloading, by Oliver and Pharr's method (J. Mater. Res. 7 (1992) 1564) with the layered
//! body in place of the bare one.
//!
//! An unloading has the largest force P, the penetration h there, and S = dP/dh by a power law. A tip of the area A(h_c) touches at the
//! contact depth h_c = h − ε P/S with the radius a = √(A/π). As it comes loose, the impression that it leaves is taken as flat, and the
//! tip as a paraboloid: the body of the parameters then has
//!
//! S = β S_punch(a),   ε = (δ − a²/(2R)) S/P,
//!
//! those of a flat punch and of a paraboloid of the contact radius a on both bodies (`punch`). ε depends on a/h of a coating, so that a and ε
//! follow from each other. A frame of the compliance C_f adds C_f P to h and C_f to 1/S, a missed zero δ₀ to h. Least squares of S by one or
//! more unloadings give the parameters.
//!
//! A bare body has S = 2E*a and ε = 3/4: the formula E_r = √π S/(2β√A).

mod contact;
mod error;
mod fit;
mod punch;
mod record;
mod search;

pub use contact::{BareModulus, NoContact, UnloadingModel};
pub use error::UnloadingError;
pub use fit::{FromUnloading, UnloadingContact, UnloadingDoubt};
pub use punch::Punch;
pub use record::Unloading;

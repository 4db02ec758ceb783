//! General numerics that the physics rests on: sums whose order is fixed, small systems, quadrature, Chebyshev series,
//! maxima and tops, lines around an axis, fields as arrays, and numbers as a person reads them.

pub mod array;
pub mod chebyshev;
pub mod closed_line;
pub mod least_squares;
pub mod linear;
pub mod number;
pub mod paraboloid;
pub mod quadrature;
pub mod search;
pub mod sums;

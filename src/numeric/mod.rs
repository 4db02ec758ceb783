//! General numerics that the physics rests on: sums whose order is fixed, small systems, quadrature, Chebyshev series,
//! maxima and tops, lines around an axis and series along them, fields as arrays, swept and transformed eight samples at a time, and
//! numbers as a person reads them.

pub mod aligned;
pub mod array;
pub mod chebyshev;
pub mod closed_line;
pub mod fourier;
pub mod lanes;
pub mod least_squares;
pub mod linear;
pub mod number;
pub mod paraboloid;
pub mod quadrature;
pub mod rows;
pub mod search;
#[cfg(feature = "serde")]
pub mod serialised;
pub mod series_fit;
pub mod sums;

//! General numerics that the physics rests on: sums in a fixed order, small systems of equations, quadrature, Chebyshev series,
//! maxima, closed lines around an axis with Fourier series in the angle, fields as arrays, and transforms and passes over rows
//! with eight samples at a time.

pub mod aligned;
pub mod array;
pub mod chebyshev;
pub mod closed_line;
pub mod fourier;
pub mod lanes;
pub mod least_squares;
pub mod limited_cubic;
pub mod linear;
pub mod paraboloid;
pub mod quadrature;
pub mod rows;
pub mod search;
pub mod serialised;
pub mod series_fit;
pub mod sums;

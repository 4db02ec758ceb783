//! General numerics that the physics rests on: real or complex moduli, dual numbers, sums in a fixed order, small systems of equations and
//! eigenvalues, quadrature, Chebyshev series, maxima, closed lines around an axis with Fourier series in the angle, fields as arrays, and
//! transforms and passes over rows with eight samples at a time.

pub(crate) mod aligned;
pub mod array;
pub(crate) mod chebyshev;
pub(crate) mod closed_line;
pub(crate) mod dual;
pub(crate) mod eigen;
pub mod fourier;
pub(crate) mod lanes;
pub mod least_squares;
pub(crate) mod limited_cubic;
pub mod linear;
pub mod number;
pub(crate) mod paraboloid;
pub(crate) mod parallel;
pub mod quadrature;
pub(crate) mod rows;
pub(crate) mod runge_kutta_chebyshev;
pub mod search;
pub(crate) mod serialised;
pub(crate) mod series_fit;
pub mod sums;

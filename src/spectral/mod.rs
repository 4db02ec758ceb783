//! The spectral method: the whole cell on a doubly periodic grid, the half-space exact in Fourier space.
//!
//! - [`fourier`]: convolution in one fused pass;
//! - [`operator`]: pressure → displacement, and its inverse as preconditioner;
//! - `iteration`: conjugate gradients on one grid, and the certificate of what they return;
//! - [`Solver`]: a problem on its nested grids, from load to load; [`Step`]: one load solved, [`Contact`]: on one grid.

mod contact;
pub mod fourier;
mod iteration;
pub mod operator;
mod solver;
mod step;

pub use contact::Contact;
pub use iteration::{Certificate, Compliance, Method, Progress, Report, Route, Settings, Stop};
pub use solver::{Solver, memory};
pub use step::Step;

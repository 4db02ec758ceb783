//! The spectral method: the whole cell on a doubly periodic grid, the half-space exact in Fourier space.
//!
//! - `multiplier`: what they multiply with; `convolution`: transforms there and back in one fused pass;
//! - [`operator`]: pressure → displacement and back, the one that counts and the one that leads there;
//! - `extension`: the residual continued beyond the contact, for the preconditioner;
//! - `iteration`: conjugate gradients on one grid, and the certificate of what they return;
//! - `prolongation`: a solution carried over to the next finer grid;
//! - [`Solver`]: a problem on its nested grids, from load to load; [`Step`]: one load solved, [`Contact`]: on one grid;
//!   [`Checkpoint`]: what a run that was interrupted goes on with.

mod checkpoint;
mod contact;
mod convolution;
mod extension;
mod iteration;
mod multiplier;
pub mod operator;
mod prolongation;
mod solver;
mod step;

pub use checkpoint::{Checkpoint, OtherGrids};
pub use contact::Contact;
pub use iteration::{Certificate, Method, Progress, Report, Route, Settings, Stop, Unknowns};
pub use solver::{Memory, Solver};
pub use step::Step;

//! The spectral method: the whole cell on a doubly periodic grid, the half-space exact in Fourier space.
//!
//! - [`operator`]: the elastic body as the iteration uses it, a trait; `layered_operator`: the layered half-space, periodic; `free_space`: one
//!   contact without images;
//!   `convolution`, `multiplier`, `by_rows`: transforms there and back in one fused pass;
//! - `iteration`: conjugate gradients on one grid, with the certificate of their result; `extension`: the residual continued
//!   beyond the contact, for the preconditioner;
//! - `grid_level`: a problem on one of its nested grids; `prolongation`: a solution carried over to the next finer one;
//! - [`Solver`]: a problem on all of them, from load to load; [`Step`]: one load solved, [`Contact`]: on one grid;
//!   [`Checkpoint`]: the state from which an interrupted run continues;
//! - [`Wear`]: implicit steps of wear, `sliding_mean` of the body that is swept; [`Worn`]: the depths worn off.

mod body_operator;
mod by_rows;
mod checkpoint;
mod contact;
mod convolution;
mod depth_search;
mod extension;
mod field_error;
mod free_space;
mod grid_level;
mod iteration;
mod layered_operator;
mod multiplier;
pub mod operator;
mod prolongation;
mod sliding_mean;
mod solver;
mod step;
mod tangent;
mod wear;
mod wear_error;
mod wear_state;
mod worn;

pub use checkpoint::{Checkpoint, OtherGrids};
pub use contact::Contact;
pub use field_error::FieldError;
pub use free_space::{Coupling, FreeSpaceOperator, OfWavenumber};
pub use iteration::{Certificate, Method, Progress, Report, Route, Settings, Stop, Unknowns};
pub use layered_operator::LayeredOperator;
pub use operator::Workspace;
pub(crate) use solver::MIN_POINTS;
pub use solver::{Memory, Solver};
pub use step::Step;
pub use tangent::Tangent;
pub use wear::Wear;
pub use wear_error::WearError;
pub use wear_state::WearState;
pub use worn::Worn;

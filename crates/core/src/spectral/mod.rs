//! The spectral method: the whole cell on a doubly periodic grid, the half-space exact in Fourier space.
//!
//! - [`operator`]: the elastic body as the iteration uses it, a trait; [`LayeredOperator`]: layered half-spaces, `periodic_operator` on a
//!   periodic cell, `free_space` without images, `body_operator` those of a problem; `local_compliance`: surfaces that give way themselves;
//!   `convolution`, `multiplier`, `by_rows`: transforms there and back in one fused pass;
//! - `iteration`: conjugate gradients on one grid, with the certificate of their result; `extension`: the residual continued
//!   beyond the contact, for the preconditioner;
//! - `grid_level`: a problem on one of its nested grids; `prolongation`: a solution carried over to the next finer one;
//! - [`Solver`]: a problem on all of them, from load to load; [`Step`]: one load solved, [`Contact`]: on one grid;
//!   [`Checkpoint`]: the state from which an interrupted run continues;
//! - `resolvent`, [`Hysteresis`]: bodies that relax below a load that moves steadily: the parts of their operator, and the friction;
//! - `creeping`: bodies that relax under loads in time, an elastic contact each step;
//! - `adhesive`: surfaces that pull each other, by the gap instead of the pressure;
//! - [`Wear`]: implicit steps of wear around the operator of each grid, `sliding_mean` of the body that is swept; [`Worn`]: the depths worn off.

mod adhesive;
mod body_operator;
mod by_rows;
mod checkpoint;
mod contact;
mod convolution;
mod creeping;
mod depth_search;
mod extension;
mod field_error;
mod free_space;
mod frictional_heat;
mod grid_level;
mod hysteresis;
mod iteration;
mod layered_operator;
mod local_compliance;
mod multiplier;
pub mod operator;
mod periodic_operator;
mod prolongation;
mod resolvent;
mod sliding_mean;
mod solver;
mod step;
mod tangent;
mod tangential;
mod transforms;
mod wave_operator;
mod wear;
mod wear_error;
mod wear_state;
mod worn;

pub use adhesive::{
    AdhesiveError, AdhesiveNumbers, AdhesiveSolver, AdhesiveStep, FEW_ACROSS, FEWEST_ACROSS, Jump, PullOff,
    check_grid as check_adhesive_grid, samples as adhesive_samples, soft_end, widths as adhesive_widths, zone_law,
};
pub use checkpoint::{Checkpoint, OtherGrids};
pub use contact::{Contact, Shear};
pub use creeping::{CreepError, CreepSolver, CreepStep, TIME_TOLERANCE, TimeError};
pub use field_error::FieldError;
pub use free_space::{Coupling, OfWavenumber};
pub use frictional_heat::{Hottest, SurfaceHeat};
pub use hysteresis::Hysteresis;
pub use iteration::{Certificate, Method, Progress, Report, Route, Settings, Stop, Unknowns};
pub use layered_operator::LayeredOperator;
pub use operator::Workspace;
pub(crate) use solver::MIN_POINTS;
pub use solver::{Memory, Solver};
pub use step::{HeatStep, MotionLoss, Step};
pub use tangent::Tangent;
pub use tangential::{
    Drive, MeasuredVector, NotAlongGrid, RollError, Rolling, RollingDrive, Slides, SlipError, SlipReport, SlipSettings,
    SlipSolver, SlipStep,
};
pub use wear::Wear;
pub use wear_error::WearError;
pub use wear_state::WearState;
pub use worn::Worn;

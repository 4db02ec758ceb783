//! Wear along a path of sliding under a fixed load, in implicit steps of controlled length.
//!
//! The depth h with ∂h/∂s = k p is carried on by TR-BDF2 (`tried_step`). A step is accepted where its error is at most the tolerance, and
//! the next one is as long as that error allows (`path`). Wear levels the pressure, by which the steps grow; of each accepted one a
//! [`WornStep`] is kept.
//!
//! A counterbody that is softer keeps what a step has pressed in: where it is at the hardness, wear lowers the pressure at once. A softer
//! body moves away below the contact, and keeps nothing.
//!
//! Memory besides that of the solver, bytes per sample: 72 on every grid (pressure, gap and initial gap at three moments) and on the finest
//! 80 (the depths of both surfaces at three moments, the errors of a step, their sum, and the depth that gives them).

mod path;
mod tried_step;
mod worn_step;

pub(crate) use path::next_length;
pub use path::{PathEnd, WearPath, WornPath};
pub use worn_step::{WornStep, WornSurface};

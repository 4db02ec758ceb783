//! File formats of heights: NumPy arrays, matrices and points as text, with what their headers say of units and sides.
//!
//! One file a format (`npy`, `text` with its `lines`, `header` and `decimal_commas`, `xyz`); [`Stored`] is what any of them holds, and a
//! [`Fault`] what is wrong with one. `suspicious_values` refuses or doubts numbers that are no heights.

mod decimal_commas;
mod fault;
mod header;
mod lines;
mod npy;
mod stored;
mod suspicious_values;
mod text;
pub mod unit;
mod xyz;

pub use fault::{Fault, Heights, fits};
pub use header::{HeightsUnit, Length};
pub use stored::{FORMATS, Format, Stored};

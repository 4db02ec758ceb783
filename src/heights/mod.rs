//! File formats of heights: NumPy arrays, matrices and points as text, with units and sides from their headers.
//!
//! One module a format (`npy`, `text` with its `lines`, `header` and `decimal_commas`, `xyz`); [`Stored`] is the content of a file, and
//! a [`Fault`] the reason of its refusal. `suspicious_values` refuses values that are not heights, or warns of them.

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
pub use stored::{FORMATS, HeightsFormat, Stored};

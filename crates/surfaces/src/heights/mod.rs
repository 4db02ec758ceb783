//! File formats of heights: NumPy arrays, matrices and points as text, instruments' files, with units and sides from their headers.
//!
//! One module a format (`npy`, `text` with its `lines`, `header`, `spip` and `decimal_commas`, `xyz`, `x3p` with its `archive` and `datums`, `sdf`,
//! `sur`, `gwy`, `asc`; `binary` and `channel` serve several of them); [`Stored`] is the content of a file, and a [`Fault`] the reason of its
//! refusal. `suspicious_values` and `profile` refuse values that are not heights, or warn of them.

mod archive;
mod asc;
mod binary;
mod channel;
mod datums;
mod decimal_commas;
mod fault;
mod gwy;
mod header;
mod lines;
mod measured;
mod npy;
mod profile;
mod sdf;
mod spip;
mod stored;
mod sur;
mod suspicious_values;
mod text;
pub mod unit;
mod x3p;
mod xyz;

pub use channel::WantedChannel;
pub use fault::{ELSEWHERE, Fault, Heights, fits};
pub use header::{HeightsUnit, Length};
pub use stored::{FORMATS, HeightsFormat, Stored};

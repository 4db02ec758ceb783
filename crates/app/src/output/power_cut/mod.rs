//! Kills and power cuts, simulated for tests alone: every state of the disk that one may leave is laid out, and the next run goes
//! on from it.

mod image;
mod journal;
mod publication;
mod run;
pub(super) mod system;

pub(crate) use journal::Journal;

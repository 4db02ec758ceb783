//! Studies: one case, solved for many settings of its keys.
//!
//! An [`Axis`] has the values of a key, a [`Group`] the keys that change together, [`Combinations`] every combination of the
//! groups; a [`Study`] solves them, and a [`Row`] is the result of one. Small grids are solved several at once, large ones one
//! after another by all threads; the rows are equal, bit for bit.
//!
//! A row is appended to a [`Log`] as soon as it is done. After a kill the study is resumed with the rows of the log: those whose case
//! has an equal fingerprint are not solved again. A line of the log that was changed since it was written is not a row.

mod axis;
mod combinations;
#[cfg(test)]
pub(crate) mod examples;
mod fields;
mod known;
mod log;
mod memory;
mod parts;
#[cfg(test)]
mod power_cut;
mod result;
mod row;
mod study;
mod table;
mod task;
mod workers;

pub use axis::{Axis, AxisError};
pub use combinations::{Combination, Combinations, CombinationsError, Group, column};
pub use known::Known;
pub use log::{Damage, Log, Logged, read};
pub use parts::{Part, PartError, UNFINISHED, join};
pub use result::{Foremost, Kind, LimitValue, SCALARS, Scalar, SweepResult};
pub use row::{Row, Status};
pub use study::{Study, StudyError};
pub use table::{Description, SweptKey, columns, fingerprint, table};
pub use task::Task;

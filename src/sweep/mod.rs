//! Studies: one case, solved for many settings of its keys.
//!
//! [`Axis`] says which values a key takes, [`Group`] which keys change together, [`Combinations`] makes every combination of
//! the groups, a [`Study`] solves them, and a [`Row`] says what is known of one that is done. Small grids are solved several
//! at once, large ones one after another by all threads; the rows are the same, bit for bit.
//!
//! A row is kept in a [`Log`] as soon as it is done. Whoever goes on after a kill gives the study the rows of the log: those
//! of the same case, told by a fingerprint, are not solved again. A line of the log that is not as it was written is no row.

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

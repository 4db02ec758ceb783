//! Studies: one case, solved for many settings of its keys.
//!
//! An [`Axis`] is a key with its values, a [`Group`] has keys that change together, [`Combinations`] are all combinations of
//! the groups, a [`Study`] solves them, and a [`Row`] has the results of one. Small grids are solved several at once, large
//! ones one after another by all threads; the rows are the same, bit for bit.
//!
//! A [`Design`] makes combinations of uncertain keys instead, whose rows have an [`Uncertainty`].
//!
//! A [`Log`] holds each row from the moment its combination is done. After a kill, [`Study::known`] reads it: combinations whose
//! case has the fingerprint of a row are not solved again. A line of the log that is not as it was written is no row.

mod axis;
mod best;
mod checked;
mod combinations;
mod design;
#[cfg(test)]
pub(crate) mod examples;
mod fields;
mod indices;
mod known;
mod log;
mod memory;
mod parts;
#[cfg(all(test, unix))]
mod power_cut;
mod result;
mod row;
mod study;
mod table;
mod task;
mod uncertainty;
mod varied;
mod workers;

pub use axis::{Axis, AxisError};
pub use best::best_and_worst;
pub use combinations::{Combination, Combinations, CombinationsError, Group, column, keys_once};
pub use design::{Design, Distribution, Varied};
pub use indices::{Estimate, Statistics};
pub use known::Known;
pub use log::{Damage, Log, Logged, read};
pub use parts::{Part, PartError, UNFINISHED, join};
pub use result::{Foremost, LimitValue, SHOWN, SweepResult, shown_with, stated};
pub use row::{Row, Status};
pub use study::{Study, StudyError};
pub use table::{Description, SweptKey, columns, columns_of, files, table, write};
pub use task::Task;
pub use uncertainty::{Spread, Uncertainty, What};
pub use varied::VaryError;

//! What `summary.json` and `limit.json` say, read back as the records they were written from.
//!
//! A number that is not finite is null in JSON: it comes back as infinite where the file calls it singular, as no number where a
//! step says that it is none, and is refused elsewhere, as is every code that is not known. What the files do not hold
//! (boundaries, what a reading says of its own errors) stays empty.

mod due;
mod limit;
mod number;
mod step;
mod stress;
mod unreadable;

pub use limit::limits_of;
pub use step::steps_of;
pub(super) use step::{route, step};
pub use unreadable::Unreadable;

use super::Timing;
use serde_json::Value;

/// Where the time of a run went; `None` where the file does not say.
///
/// # Errors
/// [`Unreadable`] when it says so in another way.
pub fn timing_of(file: &Value) -> Result<Option<Timing>, Unreadable> {
    file.get("timing").map(|timing| unreadable::read("`timing`", timing)).transpose()
}

//! Requests of the page.

use serde::Deserialize;
use serde_json::Value;

/// A request of the page.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "task", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// The materials of the library.
    Materials,
    /// The last load step of a case.
    Solve {
        /// The case, of the shape of a case file.
        case: Value,
        /// Whether pictures are drawn, and the step is kept for [`Request::Picture`] and [`Request::Table`].
        pictures: bool,
        /// Whether the section has half of its points and a third of its depths, for a first answer.
        #[serde(default)]
        coarse: bool,
        /// Whether what is known goes out before the rest is computed: the contact, then the largest stresses.
        #[serde(default)]
        parts: bool,
    },
    /// The loads at which the criteria of a case are reached.
    Limit {
        /// The case, of the shape of a case file.
        case: Value,
    },
    /// A picture of the step that is kept, as PNG.
    Picture {
        /// Name of the picture: `pressure`, `slip`, `section` or `profiles`.
        name: String,
    },
    /// A table of the step that is kept, as CSV.
    Table {
        /// Name of the table: `profile` (pressure and gap along x through the middle), `section` (stresses in the
        /// section) or `numbers` (all scalars).
        name: String,
    },
}

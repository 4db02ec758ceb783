//! The keys of a case: every table of the file, with meaning, forms and defaults of each key.
//!
//! The tables are declared with the sections ([`super::section`]). From them follow the values that the reader admits (`key`,
//! `range`), defaults, advice on misplaced keys, the keys that an override replaces, the `table` of all keys, the text of `percoat explain`
//! (`explanation`, `page`, `wording`) and the JSON `schema`.

mod explanation;
mod key;
mod named;
mod page;
mod range;
mod schema;
mod table;
#[cfg(test)]
mod tests;
mod unit;
mod wording;

pub use explanation::{Explanation, UnknownKey, explain};
pub use named::NamedKey;
pub use page::overview;
pub use schema::schema;
pub use table::table;

pub(super) use key::{Absent, Form, Key, Keys, Written, measured_in};
pub(super) use range::Range;
pub(super) use unit::Unit;
pub(super) use wording::requirement;

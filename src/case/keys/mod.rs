//! The keys of a case: every table of the file, and what each of its keys is.
//!
//! The tables are declared with the sections ([`super::section`]). The reader takes from them which values a key admits
//! (`key`, `range`), what holds where it is absent and where a misplaced one belongs; an override, what it drives out; the
//! README, its table of sections; `percoat explain`, all its text (`explanation`, `page`, in the words of
//! `wording`); an editor, its `schema`.

mod explanation;
mod key;
mod page;
mod range;
mod schema;
#[cfg(test)]
mod tests;
mod unit;
mod wording;

pub use explanation::{Explanation, UnknownKey, explain};
pub use page::overview;
pub use schema::schema;

pub(super) use key::{Absent, Form, Key, Keys, Written, measured_in};
pub(super) use range::Range;
pub(super) use unit::Unit;
pub(super) use wording::told;

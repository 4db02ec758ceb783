//! The keys of a case: every table of the file, and what each of its keys is.
//!
//! The reader learns here what it accepts (`key`, `range`), what holds where a key is absent and where a misplaced one
//! belongs; an override, what it drives out; the README, its table of sections; `percoat explain`, all that it says
//! (`explanation`, `page`, in the words of `form` and `telling`); an editor, its `schema`. The tables: `counterbody`, `body`,
//! `run`, `stress`, and `sections`, which has all.

mod body;
mod counterbody;
mod explanation;
mod form;
mod key;
mod page;
mod range;
mod run;
mod schema;
mod sections;
mod stress;
mod telling;
#[cfg(test)]
mod tests;
mod unit;

pub use explanation::{Explanation, UnknownKey, explain};
pub use page::overview;
pub use range::CARRIED;
pub use schema::schema;

pub(super) use body::LAYERS;
pub(super) use form::told;
pub(super) use key::{Absent, Form, Key, Keys};
#[cfg(test)]
pub(super) use run::LOAD;
pub(super) use sections::{CASE, homes};

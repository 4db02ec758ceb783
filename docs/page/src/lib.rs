//! percoat in a browser: a case as JSON in, numbers, tables and pictures as JSON out.
//!
//! The page sends a [`Request`] and shows the [`Answer`]; both are texts in the memory of the module ([`memory`]). A case has the shape
//! of a case file, is read by the same code, and goes back complete with its defaults, so that the file which the page offers gives
//! the command line the same numbers. Nothing else leaves or enters: there are no files, no clock and no network.

mod answer;
mod memory;
mod numbers;
mod page;
mod request;

pub use answer::{Answer, CaseNumber, TableText};
pub use page::Page;
pub use request::Request;

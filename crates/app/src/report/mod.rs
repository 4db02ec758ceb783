//! The report: the results of an output folder as one HTML page without external files.
//!
//! A run, a sweep, a limit, a life, an identification and a comparison each have a part: the answer with its errors, the problem, pictures, tables, resolution,
//! warnings, the certificate in words and the case to copy. The page is made from the files of the folder alone: numbers are
//! written as the command line writes them, pictures and styles are embedded, there is no script and no request to the
//! network. A result that was changed since percoat wrote it, or that lacks a number, is refused; pictures and fields that are
//! missing or damaged are named.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = tempfile::tempdir()?;
//! let error = percoat_app::report::page(folder.path()).unwrap_err();
//! assert!(error.to_string().contains("holds no finished result"));
//! # Ok(())
//! # }
//! ```

mod answer;
mod certificate;
mod comparison;
mod error;
mod figures;
mod given;
mod identification;
mod life;
mod limit;
mod markup;
mod page;
mod part;
mod problem;
mod ranges;
mod resolution;
mod results;
mod run;
mod sweep;
mod table;
mod trailer;
mod units;

pub use error::ReportError;
pub use page::{Page, page};
pub use trailer::{BEGINNING, is_own};

//! The report: what stands in an output folder as one HTML page, which needs nothing beside itself.
//!
//! A run, a sweep and a limit each have a part: the answer with its errors, what was asked, pictures, tables, resolution and
//! warnings, the certificate in words, the case to copy. The page is read off the files of the folder alone: its numbers
//! are written as the command line writes them, its pictures are those of the folder, its styles stand in it, it has no
//! script and asks the network for nothing. A result that is not as percoat wrote it there, or in which a number that is due is
//! none, is refused; pictures and fields that are missing or damaged are named.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = tempfile::tempdir()?;
//! let error = percoat::report::page(folder.path()).unwrap_err();
//! assert!(error.to_string().contains("holds no finished result"));
//! # Ok(())
//! # }
//! ```

mod answer;
mod asked;
mod certificate;
mod error;
mod figures;
mod finished;
mod given;
mod limit;
mod markup;
mod page;
mod part;
mod ranges;
mod resolution;
mod run;
mod sweep;
mod table;
mod trailer;
mod units;

pub use error::ReportError;
pub use page::{Page, page};
pub use trailer::is_own;

//! Studies with verdicts: what percoat computes, held against closed forms, multiprecision references and peers.
//!
//! A [`Study`] computes its quantities afresh and compares each with its reference: a [`Check`] that holds or fails.
//! Its equation, source and tolerances stand in `validation/<study>/README.md`; reference numbers and case files lie
//! beside it and are part of the program, so that `percoat validate` works wherever it is installed. A [`Report`] prints
//! the verdicts as a table and as Markdown, and finds where two reports differ.
//!
//! ```
//! let study = percoat::validation::find("kernel").expect("a study");
//! let outcome = (study.run)().expect("the study runs");
//! assert!(outcome.checks.iter().all(|check| check.holds()));
//! ```

mod check;
mod convergence;
mod disc;
mod discretisation;
mod draw;
mod hertz;
mod hertz_stresses;
mod isolated;
mod iterations;
mod kernel;
mod lattice_sums;
mod leftover;
mod localized;
mod one_level;
mod outcome;
pub mod paper;
mod peer;
mod periodic_hertz;
mod random;
mod report;
mod rings;
mod sinusoidal_stresses;
mod steps;
mod thin_coatings;
mod wavy;
mod westergaard;

pub use check::{Check, Evidence, Tolerance};
pub use outcome::{Data, Outcome};
pub use report::{Report, differences};

/// Why a study could not be run to its end.
pub type StudyError = Box<dyn std::error::Error + Send + Sync>;

/// One study.
#[derive(Debug, Clone, Copy)]
pub struct Study {
    /// Name, as typed and as the folder in `validation/` is called.
    pub name: &'static str,
    /// What it shows, in one line.
    pub title: &'static str,
    /// Files it leaves in its folder: figures, data of its own and data that are published.
    pub files: &'static [&'static str],
    /// Computes everything afresh.
    pub run: fn() -> Result<Outcome, StudyError>,
}

/// Every study, in the order in which they are run and reported.
pub const STUDIES: [Study; 24] = [
    kernel::STUDY,
    lattice_sums::STUDY,
    hertz::STUDY,
    periodic_hertz::STUDY,
    westergaard::STUDY,
    wavy::STUDY,
    isolated::STUDY,
    thin_coatings::STUDY,
    rings::STUDY,
    hertz_stresses::STUDY,
    sinusoidal_stresses::STUDY,
    convergence::STUDY,
    discretisation::STUDY,
    iterations::STUDY,
    peer::STUDY,
    disc::STUDY,
    localized::STUDY,
    paper::STUDIES[0],
    paper::STUDIES[1],
    paper::STUDIES[2],
    paper::STUDIES[3],
    paper::STUDIES[4],
    paper::STUDIES[5],
    paper::STUDIES[6],
];

/// The study of a name.
pub fn find(name: &str) -> Option<&'static Study> {
    STUDIES.iter().find(|study| study.name == name)
}

/// The study of a name, or all whose folders lie in a folder of that name.
pub fn named(name: &str) -> Vec<&'static Study> {
    let inside =
        |study: &&Study| study.name.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'));
    STUDIES.iter().filter(inside).collect()
}

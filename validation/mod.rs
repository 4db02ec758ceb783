//! Studies with verdicts: results of percoat against closed forms, multiprecision references and other programs.
//!
//! A [`Study`] computes its quantities afresh and compares each with its reference: a [`Check`] that holds or fails.
//! The equation of a study, its source and tolerances are in `validation/<study>/README.md`; reference numbers and case
//! files beside it are embedded in the program, so that `percoat validate` works without the repository. A [`Report`]
//! has the verdicts as a table and as Markdown, and the differences from another report.
//!
//! ```
//! let study = percoat_validation::find("kernel").expect("a study");
//! let outcome = (study.run)().expect("the study runs");
//! assert!(outcome.checks.iter().all(|check| check.holds()));
//! ```

#![allow(clippy::too_many_lines, reason = "a study is told from top to bottom in one function")]

#[path = "adhesion/study.rs"]
mod adhesion;
mod alone;
mod cells;
mod check;
#[path = "convergence/study.rs"]
mod convergence;
#[path = "creep/study.rs"]
mod creep;
#[path = "disc/study.rs"]
mod disc;
#[path = "discretisation/study.rs"]
mod discretisation;
mod draw;
pub mod exact;
#[path = "fatigue/study.rs"]
mod fatigue;
#[path = "free-space/study.rs"]
mod free_space;
#[path = "heat/study.rs"]
mod heat;
#[path = "hertz/study.rs"]
mod hertz;
#[path = "hertz-stresses/study.rs"]
mod hertz_stresses;
#[path = "identification/study.rs"]
mod identification;
#[path = "isolated/study.rs"]
mod isolated;
#[path = "iterations/study.rs"]
mod iterations;
#[path = "kernel/study.rs"]
mod kernel;
#[path = "lattice-sums/study.rs"]
mod lattice_sums;
#[path = "limit/study.rs"]
mod limit;
#[path = "localized/study.rs"]
mod localized;
#[path = "moving/study.rs"]
mod moving;
mod outcome;
pub mod paper;
#[path = "partial-slip/study.rs"]
mod partial_slip;
#[path = "peer/study.rs"]
mod peer;
#[path = "periodic-hertz/study.rs"]
mod periodic_hertz;
#[path = "plasticity/study.rs"]
mod plasticity;
mod random;
#[path = "relaxing-layers/study.rs"]
mod relaxing_layers;
mod report;
#[path = "rings/study.rs"]
mod rings;
#[path = "sinusoidal-stresses/study.rs"]
mod sinusoidal_stresses;
#[path = "sliding-coated/study.rs"]
mod sliding_coated;
#[path = "sliding-sphere/study.rs"]
mod sliding_sphere;
#[path = "sliding-wave/study.rs"]
mod sliding_wave;
mod steps;
#[path = "thin-coatings/study.rs"]
mod thin_coatings;
#[path = "two-bodies/study.rs"]
mod two_bodies;
#[path = "wavy/study.rs"]
mod wavy;
#[path = "wear/study.rs"]
mod wear;
#[path = "westergaard/study.rs"]
mod westergaard;

pub use check::{Check, Evidence, Tolerance};
pub use outcome::{Data, Outcome, Study, StudyError};
pub use report::{Report, contradictions, differences};

/// Every study, in the order in which they are run and reported.
pub const STUDIES: [Study; 40] = [
    kernel::STUDY,
    lattice_sums::STUDY,
    hertz::STUDY,
    periodic_hertz::STUDY,
    westergaard::STUDY,
    sliding_wave::STUDY,
    sliding_coated::STUDY,
    wavy::STUDY,
    isolated::STUDY,
    free_space::STUDY,
    two_bodies::STUDY,
    identification::STUDY,
    partial_slip::STUDY,
    adhesion::STUDY,
    moving::STUDY,
    relaxing_layers::STUDY,
    heat::STUDY,
    creep::STUDY,
    thin_coatings::STUDY,
    rings::STUDY,
    hertz_stresses::STUDY,
    sliding_sphere::STUDY,
    limit::STUDY,
    plasticity::STUDY,
    wear::STUDY,
    fatigue::STUDY,
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

/// The study of a name, or all studies in a folder of that name.
pub fn named(name: &str) -> Vec<&'static Study> {
    let inside =
        |study: &&Study| study.name.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'));
    STUDIES.iter().filter(inside).collect()
}

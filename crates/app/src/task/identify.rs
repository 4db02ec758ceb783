//! Numbers of a case from a measured indentation curve.

use super::refused::Refused;
use crate::output::{IdentificationFile, doubts};
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, CaseError, IdentificationTask, plausibility};
use percoat_common::machine::Capacity;
use percoat_core::identification::{Identification, IdentificationError, Listener, Measurement};

/// Numbers of a case, to be found.
#[derive(Debug)]
pub struct Identify<'a> {
    task: IdentificationTask<'a>,
    notes: Vec<String>,
}

/// The numbers that were found.
#[derive(Debug)]
pub struct Identified<'a> {
    /// The measured curve.
    pub measured: &'a Measurement,
    /// The numbers with their errors, and the fit.
    pub found: Identification,
    /// The case with the numbers.
    pub best: Case,
    /// Warnings about the numbers and the case, a sentence each.
    pub warnings: Vec<String>,
}

impl<'a> Identify<'a> {
    /// The task for free numbers of a case in the memory and disk of `room`, with its `pictures` or without.
    ///
    /// # Errors
    /// [`Refused`] where they do not suffice.
    pub fn new(task: IdentificationTask<'a>, room: Capacity, pictures: bool) -> Result<Self, Refused> {
        Allowed::within(task.case(), room, Job::Identify { pictures }).map_err(Refused::new)?;
        Ok(Self { task, notes: Vec::new() })
    }

    /// The task with notes on what of the test was left out, which stand among its warnings.
    #[must_use]
    pub fn with_notes(self, notes: Vec<String>) -> Self {
        Self { notes, ..self }
    }

    /// Searches for the numbers; `each` receives every trial, and may end the search.
    ///
    /// # Errors
    /// [`IdentificationError`].
    pub fn find<'m>(
        &self,
        measured: &'m Measurement,
        each: &mut Listener<'_>,
    ) -> Result<Identified<'m>, IdentificationError<CaseError>> {
        let (found, best) = self.task.find(measured, each)?;
        let warnings = [self.notes.clone(), doubts(measured, &found, &best), plausibility::of_case(&best)].concat();
        Ok(Identified { measured, found, best, warnings })
    }
}

impl Identified<'_> {
    /// The content of `identification.json`.
    pub fn file(&self) -> IdentificationFile {
        IdentificationFile::new(&self.found, &self.best, &self.warnings)
    }
}

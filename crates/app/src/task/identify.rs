//! Numbers of a case from measured indentation curves.

use super::refused::Refused;
use crate::output::{IdentificationFile, doubts, doubts_of_retraction, doubts_of_unloading};
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, CaseError, Found, IdentificationTask, plausibility};
use percoat_case::measurements::{Curves, Taken};
use percoat_common::machine::Capacity;
use percoat_core::identification::{IdentificationError, Listener};

/// Numbers of a case, to be found.
#[derive(Debug)]
pub struct Identify<'a> {
    task: IdentificationTask<'a>,
}

/// The numbers that were found.
#[derive(Debug)]
pub struct Identified<'a> {
    /// The measured curves.
    pub measured: &'a Taken,
    /// The numbers with their errors, and the fit.
    pub found: Found,
    /// Factor β of the stiffness of unloading.
    pub beta: f64,
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
        Ok(Self { task })
    }

    /// Searches for the numbers; `each` receives every trial, and may end the search.
    ///
    /// # Errors
    /// [`IdentificationError`].
    pub fn find<'m>(
        &self,
        measured: &'m Taken,
        each: &mut Listener<'_>,
    ) -> Result<Identified<'m>, IdentificationError<CaseError>> {
        let (found, best) = self.task.find(&measured.curves, each)?;
        let doubts = match (&measured.curves, &found) {
            (Curves::Loading(curve), Found::Loading(found)) => doubts(curve, found, &best),
            (_, Found::Unloading(found)) => doubts_of_unloading(&measured.names, found, &best),
            (_, Found::Retraction(found)) => doubts_of_retraction(found),
            (Curves::Unloading(_) | Curves::Retraction(_), Found::Loading(_)) => Vec::new(),
        };
        let warnings = [measured.notes.clone(), doubts, plausibility::of_case(&best)].concat();
        Ok(Identified { measured, found, beta: self.task.beta(), best, warnings })
    }
}

impl Identified<'_> {
    /// The content of `identification.json`.
    pub fn file(&self) -> IdentificationFile {
        IdentificationFile::new(self.measured, (&self.found, self.beta), &self.best, &self.warnings)
    }
}

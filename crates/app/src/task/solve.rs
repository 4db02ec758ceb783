//! Every load step of a case.

use super::refused::Refused;
use super::within::Within;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, plausibility};
use percoat_common::machine::Capacity;
use percoat_core::run::{Outcome, Recorder, Run, RunError};

/// The load steps of a case, to be solved.
#[derive(Debug)]
pub struct Solve<'a> {
    case: &'a Case,
    allowed: Allowed<'a>,
    /// The run that the case describes.
    pub run: Run,
}

/// The load steps of a case, solved.
#[derive(Debug)]
pub struct Solved {
    /// The steps, and how they ended.
    pub outcome: Outcome,
    /// Warnings about the run and the case, a sentence each.
    pub warnings: Vec<String>,
}

impl<'a> Solve<'a> {
    /// The task of solving into files in the memory and disk of `room`, with `fields` and `pictures` or without.
    ///
    /// # Errors
    /// [`Refused`] where they do not suffice, and of loads that have no solution.
    pub fn into_files(case: &'a Case, room: Capacity, fields: bool, pictures: bool) -> Result<Self, Refused> {
        Self::new(case, room, Job::Solve { pictures, fields })
    }

    /// The task of solving into memory, in which every step stays.
    ///
    /// # Errors
    /// [`Refused`], as of [`Solve::into_files`].
    pub fn in_memory(case: &'a Case, room: Capacity) -> Result<Self, Refused> {
        Self::new(case, room, Job::Keep)
    }

    fn new(case: &'a Case, room: Capacity, job: Job) -> Result<Self, Refused> {
        let allowed = Allowed::within(case, room, job).map_err(Refused::new)?;
        let run = case.run();
        run.check().map_err(Refused::new)?;
        Ok(Self { case, allowed, run })
    }

    /// Solves the steps one after another.
    ///
    /// # Errors
    /// [`RunError`], as of [`Run::solve`].
    pub fn solve<R: Recorder>(&self, recorder: &mut R) -> Result<Solved, RunError<R::Error>> {
        let outcome = self.run.solve(&mut Within { allowed: self.allowed, recorder })?;
        let warnings = [outcome.warnings.clone(), plausibility::of_case(self.case)].concat();
        Ok(Solved { outcome, warnings })
    }
}

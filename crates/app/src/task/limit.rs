//! The loads at which the materials and interfaces of a case fail.

use super::refused::Refused;
use super::within::Within;
use crate::output::LimitFile;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, plausibility};
use percoat_common::machine::Capacity;
use percoat_core::run::{Limits, Recorder, Run, RunError};

/// The limit loads of a case, to be found.
#[derive(Debug)]
pub struct FindLimits<'a> {
    case: &'a Case,
    allowed: Allowed<'a>,
    run: Run,
    /// Largest load of the search, in the quantity of the case.
    most: f64,
}

/// The limit loads of a case.
#[derive(Debug)]
pub struct Limited<'a> {
    /// The case.
    pub case: &'a Case,
    /// The limit of each criterion, and the loads that were solved for them.
    pub limits: Limits,
    /// Warnings about the limits and the case, a sentence each.
    pub warnings: Vec<String>,
}

impl<'a> FindLimits<'a> {
    /// The task in the memory and disk of `room`, with `pictures` or without.
    ///
    /// # Errors
    /// [`Refused`] where they do not suffice, of loads that have no solution, and without a strength.
    pub fn new(case: &'a Case, room: Capacity, pictures: bool) -> Result<Self, Refused> {
        let allowed = Allowed::within(case, room, Job::Limit { pictures }).map_err(Refused::new)?;
        let run = case.run();
        run.check_limits().map_err(Refused::new)?;
        Ok(Self { case, allowed, run, most: f64::INFINITY })
    }

    /// The task up to a load, as in "20 N"; a number alone is in the units of the case.
    ///
    /// # Errors
    /// [`Refused`] for a text that is no load above 0.
    pub fn up_to(self, load: &str) -> Result<Self, Refused> {
        let most = self.case.load_of(load).map_err(Refused::new)?;
        Ok(Self { most, ..self })
    }

    /// Searches for the loads.
    ///
    /// # Errors
    /// [`RunError`], as of [`Run::limits`].
    pub fn find<R: Recorder>(&self, recorder: &mut R) -> Result<Limited<'a>, RunError<R::Error>> {
        let limits = self.run.limits_up_to(self.most, &mut Within { allowed: self.allowed, recorder })?;
        let warnings = [limits.warnings.clone(), plausibility::of_case(self.case)].concat();
        Ok(Limited { case: self.case, limits, warnings })
    }
}

impl Limited<'_> {
    /// The content of `limit.json`.
    pub fn file(&self) -> LimitFile {
        LimitFile::new(&self.limits, self.case, &self.warnings)
    }
}

//! A job that memory and disk suffice for.

use super::resources::{Job, needs, refusal};
use crate::case::Case;
use percoat_common::machine::Capacity;
use percoat_core::run::Recorder;
use std::convert::Infallible;
use std::path::Path;

/// A job on a case for which the machine has memory and disk.
#[derive(Debug, Clone, Copy)]
pub struct Allowed<'a> {
    case: &'a Case,
    job: Job,
    /// Memory and disk of this machine.
    pub room: Capacity,
}

impl<'a> Allowed<'a> {
    /// Checks a job that writes into `folder` before it starts.
    ///
    /// # Errors
    /// A sentence with the memory or disk needed and available, and what would fit.
    pub fn new(case: &'a Case, folder: &Path, job: Job) -> Result<Self, String> {
        Self::within(case, Capacity::on_this_machine(folder), job)
    }

    /// Checks a job against the memory and disk of `room`.
    ///
    /// # Errors
    /// Those of [`Allowed::new`].
    pub fn within(case: &'a Case, room: Capacity, job: Job) -> Result<Self, String> {
        refusal(case, room, job).map_or(Ok(Self { case, job, room }), Err)
    }
}

/// Records nothing; ends a refinement at the first grid that does not fit.
impl Recorder for Allowed<'_> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        needs(self.case, points, self.job).fit(self.room)
    }
}

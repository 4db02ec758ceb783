//! The room that a job may take.

use super::ending::Failure;
use crate::case::Case;
use crate::case::resources::{Job, needs, refusal};
use crate::machine::Capacity;
use crate::run::Recorder;
use std::convert::Infallible;
use std::path::Path;

/// What there is for a job on a case.
#[derive(Debug, Clone, Copy)]
pub struct Allowed<'a> {
    case: &'a Case,
    job: Job,
    /// Memory and disk.
    pub room: Capacity,
}

impl<'a> Allowed<'a> {
    /// For a job that writes into `folder`; what does not find enough is refused before any is taken.
    pub fn new(case: &'a Case, folder: &Path, job: Job) -> Result<Self, Failure> {
        Self::within(case, Capacity::on_this_machine(folder), job)
    }

    /// The same where the `room` is known.
    pub fn within(case: &'a Case, room: Capacity, job: Job) -> Result<Self, Failure> {
        refusal(case, room, job).map_or(Ok(Self { case, job, room }), |why| Err(Failure::Refused(why)))
    }
}

/// Keeps nothing of a run but that it finds room.
impl Recorder for Allowed<'_> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        needs(self.case, points, self.job).fit(self.room)
    }
}

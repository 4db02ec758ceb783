//! The check that memory and disk suffice for a job.

use super::ending::Failure;
use crate::case::Case;
use crate::case::resources::{Job, needs, refusal};
use crate::machine::Capacity;
use crate::run::Recorder;
use std::convert::Infallible;
use std::path::Path;

/// A job on a case for which memory and disk suffice.
#[derive(Debug, Clone, Copy)]
pub struct Allowed<'a> {
    case: &'a Case,
    job: Job,
    /// Memory and disk of this machine.
    pub room: Capacity,
}

impl<'a> Allowed<'a> {
    /// A job that writes into `folder`; refused before anything is computed where memory or disk does not suffice.
    pub fn new(case: &'a Case, folder: &Path, job: Job) -> Result<Self, Failure> {
        Self::within(case, Capacity::on_this_machine(folder), job)
    }

    /// A job within a known `room`; refused where memory or disk does not suffice.
    pub fn within(case: &'a Case, room: Capacity, job: Job) -> Result<Self, Failure> {
        refusal(case, room, job).map_or(Ok(Self { case, job, room }), |why| Err(Failure::Refused(why)))
    }
}

/// A recorder that checks memory and disk for finer grids and keeps nothing.
impl Recorder for Allowed<'_> {
    type Error = Infallible;

    fn fits(&self, points: [usize; 2]) -> bool {
        needs(self.case, points, self.job).fit(self.room)
    }
}

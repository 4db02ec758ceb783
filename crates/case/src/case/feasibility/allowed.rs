//! A job that memory and disk suffice for.

use super::resources::{Job, needs, refusal};
use crate::case::Case;
use percoat_common::machine::Capacity;

/// A job on a case for which the machine has memory and disk.
#[derive(Debug, Clone, Copy)]
pub struct Allowed<'a> {
    case: &'a Case,
    job: Job,
    room: Capacity,
}

impl<'a> Allowed<'a> {
    /// Checks a job against the memory and disk of `room`.
    ///
    /// # Errors
    /// A sentence with the memory or disk needed and available, and what would fit.
    pub fn within(case: &'a Case, room: Capacity, job: Job) -> Result<Self, String> {
        refusal(case, room, job).map_or(Ok(Self { case, job, room }), Err)
    }

    /// Whether memory and disk suffice for a grid of `points`.
    pub fn fits(&self, points: [usize; 2]) -> bool {
        needs(self.case, points, self.job).fit(self.room)
    }
}

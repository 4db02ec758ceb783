//! Finished steps of an earlier run of the same case.

use super::StepRecord;
use crate::spectral::Checkpoint;

/// Finished steps of an earlier run, which a run resumes.
///
/// The last solved load is not solved again: its step is restored from a checkpoint, and its readings are computed again. The
/// resumed run has the results of one that was never interrupted, bit for bit.
#[derive(Debug, Clone)]
pub struct EarlierRun {
    /// The grid, points along a₁ and a₂.
    pub points: [usize; 2],
    /// Changes between the grids before, of a refinement.
    pub changes: Vec<f64>,
    /// Steps on the grid before, of a refinement; `None` on the first grid.
    pub coarser: Option<Vec<StepRecord>>,
    /// The steps on this grid before the last.
    pub steps: Vec<StepRecord>,
    /// The last load on this grid; `None` where none is solved.
    pub last: Option<LastLoad>,
}

/// The last load that an earlier run has solved.
#[derive(Debug, Clone)]
pub struct LastLoad {
    /// State of the solver after it.
    pub checkpoint: Checkpoint,
    /// Wall time of its solution, seconds.
    pub seconds: f64,
}

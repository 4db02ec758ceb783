//! What an earlier run of the same kind has finished, with which a run goes on.

use super::StepRecord;
use crate::spectral::Checkpoint;

/// What an earlier run has finished on a grid, and on those before it.
///
/// The last load that it solved is not solved again: its step comes from a checkpoint, and all that is read off it is
/// read again. So a run that goes on ends as one that was never interrupted does, bit for bit.
#[derive(Debug, Clone)]
pub struct EarlierRun {
    /// The grid, points along a₁ and a₂.
    pub points: [usize; 2],
    /// Of a refinement, the changes that the grids before have brought.
    pub changes: Vec<f64>,
    /// Of a refinement, the steps on the grid before; `None` on the first.
    pub coarser: Option<Vec<StepRecord>>,
    /// The steps on this grid before the last.
    pub steps: Vec<StepRecord>,
    /// What the solver knew after the last; `None` where the grid has none.
    pub last: Option<LastLoad>,
}

/// The last load that an earlier run has solved.
#[derive(Debug, Clone)]
pub struct LastLoad {
    /// What the solver knew after it.
    pub checkpoint: Checkpoint,
    /// Wall time of its solution, seconds.
    pub seconds: f64,
}

//! How a run ends: what it has found, or why it has not come to its end.

use super::StepRecord;
use super::accuracy::{RefinementEnd, TooOblong};
use crate::lattice::LatticeError;
use crate::notation::number;
use crate::spectral::{OtherGrids, Step};
use std::error::Error;

/// What a run has found.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The load steps on the last grid.
    pub steps: Vec<StepRecord>,
    /// The last of them with its fields.
    pub last: Option<Step>,
    /// Points of the last grid along a₁ and a₂.
    pub points: [usize; 2],
    /// Change against the next coarser grid, where an accuracy was asked for.
    pub change: Option<f64>,
    /// Why the refinement ended, where there was one.
    pub end: Option<RefinementEnd>,
    /// What a reader should know before trusting the numbers.
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Whether the accuracy, if one was asked for, is reached.
    pub fn is_accurate(&self) -> bool {
        self.end.is_none_or(|end| end == RefinementEnd::Reached)
    }

    /// Whether all steps converged, and the accuracy is reached.
    pub fn converged(&self) -> bool {
        self.is_accurate() && self.steps.iter().all(StepRecord::converged)
    }
}

/// A prescribed penetration that no load reaches.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "load.penetration = {penetration} is out of reach: contact becomes complete at {}, and no further however large the \
     load; prescribe less, or mean_pressure instead",
    number(*.complete)
)]
pub struct BeyondFullContact {
    /// What is prescribed, a length.
    pub penetration: f64,
    /// Where contact becomes complete, a length.
    pub complete: f64,
}

impl<E: Error + 'static> RunError<E> {
    /// Why, in one sentence: where it cannot be recorded, the recorder's own words.
    pub fn told(&self) -> String {
        match self {
            Self::Recorder(error) => error.to_string(),
            other => other.to_string(),
        }
    }
}

/// Why a run has not come to its end; `E` is the recorder's reason.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError<E: Error + 'static> {
    /// There is nothing to solve.
    #[error("a run needs a load at least")]
    NoLoads,
    /// Limits are looked for, and nothing has a strength.
    #[error(
        "limits need strengths: give materials a yield_strength or a tensile_strength, or layers an interface_strength"
    )]
    NoStrengths,
    /// There is no such grid.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// The cell is too oblong to be refined.
    #[error(transparent)]
    TooOblong(#[from] TooOblong),
    /// A penetration is beyond complete contact.
    #[error(transparent)]
    BeyondFullContact(#[from] BeyondFullContact),
    /// What an earlier run has finished is not of this one.
    #[error(transparent)]
    OtherGrids(#[from] OtherGrids),
    /// The recorder cannot go on.
    #[error("the run cannot be recorded")]
    Recorder(#[source] E),
}

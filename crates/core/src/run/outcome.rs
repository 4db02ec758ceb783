//! The outcome of a run, and its errors.

use super::StepRecord;
use super::accuracy::{RefinementEnd, TooOblong};
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::notation::number;
use crate::spectral::{AdhesiveError, CreepError, OtherGrids, RollError, SlipError, Solver, Step};
use std::error::Error;

/// The result of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The load steps on the last grid.
    pub steps: Vec<StepRecord>,
    /// The last of them with its fields.
    pub last: Option<Step>,
    /// Points of the last grid along a₁ and a₂.
    pub points: [usize; 2],
    /// Relative change against the next coarser grid, where an accuracy was prescribed.
    pub change: Option<f64>,
    /// Reason of the end of the refinement; `None` without one.
    pub end: Option<RefinementEnd>,
    /// Warnings, a sentence each.
    pub warnings: Vec<String>,
}

impl Outcome {
    /// Whether the prescribed accuracy is reached; true without one.
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
    /// Prescribed penetration, a length.
    pub penetration: f64,
    /// Penetration at which contact becomes complete, a length.
    pub complete: f64,
}

/// A prescribed load that the hardness of the softer surface does not bear.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the load ({load}) has no solution: a surface of the hardness {} bears a mean pressure below it, on this cell or window a force below {}; \
     prescribe less",
    number(*.hardness), number(.hardness * .area)
)]
pub struct BeyondHardness {
    /// The load.
    pub load: Load,
    /// Hardness of the softer surface, a pressure.
    pub hardness: f64,
    /// Area of the cell, or of the window, a length squared.
    pub area: f64,
}

/// A prescribed penetration at which all of the softer surface is at its hardness: any greater one has the same pressure.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "load.penetration = {penetration} brings the whole surface to its hardness {}, where it yields as a whole and any greater penetration \
     has the same pressure: that begins at {}; prescribe less, or mean_pressure instead",
    number(*.hardness), number(*.complete)
)]
pub struct AllAtHardness {
    /// Prescribed penetration, a length.
    pub penetration: f64,
    /// Least penetration at which all of the surface is at the hardness, a length.
    pub complete: f64,
    /// Hardness of the softer surface, a pressure.
    pub hardness: f64,
}

/// Frictional heat by which the surface swells as much as the pressure presses it in, or more: no steady state is unique.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "frictional heat swells the surface too much for a steady state: in a wave of this cell swelling takes {:.0} % of the compliance, and from \
     100 % on hot spots grow instead; lower the velocity, the friction or the period, let more heat flow off, or leave the expansion out",
    100.0 * .taken
)]
pub struct NoSteadyState {
    /// Largest part of the compliance of a wave that swelling takes, 1 or more.
    pub taken: f64,
}

impl NoSteadyState {
    /// Whether frictional heat leaves no steady state in the loads of a solver.
    pub(super) fn of(solver: &Solver) -> Option<Self> {
        let taken = 1.0 - solver.left_by_heat();
        (taken >= 1.0).then_some(Self { taken })
    }
}

impl<E: Error + 'static> RunError<E> {
    /// The reason in one sentence; of an error of the recorder its own message.
    pub fn told(&self) -> String {
        match self {
            Self::Recorder(error) => error.to_string(),
            other => other.to_string(),
        }
    }
}

/// Why a run has ended without a result; `E` is the error of the recorder.
#[derive(Debug, thiserror::Error)]
pub enum RunError<E: Error + 'static> {
    /// There are no loads.
    #[error("a run needs a load at least")]
    NoLoads,
    /// Limits are searched without any strength.
    #[error(
        "limits need strengths: give materials a yield_strength or a tensile_strength, or layers an interface_strength"
    )]
    NoStrengths,
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// Surfaces that adhere cannot be solved for.
    #[error(transparent)]
    Adhesive(#[from] AdhesiveError),
    /// Loads in time are not followed.
    #[error(transparent)]
    Creep(#[from] CreepError),
    /// The cell is too oblong to be refined.
    #[error(transparent)]
    TooOblong(#[from] TooOblong),
    /// Frictional heat leaves no unique steady state.
    #[error(transparent)]
    NoSteadyState(#[from] NoSteadyState),
    /// A load is beyond the hardness.
    #[error(transparent)]
    BeyondHardness(#[from] BeyondHardness),
    /// A penetration takes all of the surface to the hardness.
    #[error(transparent)]
    AllAtHardness(#[from] AllAtHardness),
    /// A penetration is beyond complete contact.
    #[error(transparent)]
    BeyondFullContact(#[from] BeyondFullContact),
    /// Limits are searched of a history under loads that differ.
    #[error(
        "limits are loads under which all of [tangential] is followed, and its steps have loads that differ: give `load` one value"
    )]
    SeveralLoads,
    /// Endurance limits are searched of a history without a closed cycle.
    #[error(
        "endurance limits of a contact that sticks and slips are those of a closed cycle: give tangential.path, or end the steps where an earlier \
         one does, come to from the same side; or leave `endurance` out"
    )]
    NoCycle,
    /// Partial slip cannot be set up.
    #[error(transparent)]
    Slip(#[from] SlipError),
    /// The contact does not stick or roll so.
    #[error(transparent)]
    Roll(#[from] RollError),
    /// The earlier run has other grids than this one.
    #[error(transparent)]
    OtherGrids(#[from] OtherGrids),
    /// The recorder has failed.
    #[error("the run cannot be recorded")]
    Recorder(#[source] E),
}

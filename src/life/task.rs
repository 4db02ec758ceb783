//! What a life is followed from: bodies, load, grid, and how far.

use crate::body::{Durability, MeanStress, Side};
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::problem::Problem;
use crate::run::{Sampling, TooOblong};
use crate::spectral::{FieldError, Settings, Wear, WearError};
use std::sync::Arc;

/// A body that is loaded pass after pass.
#[derive(Debug, Clone)]
pub struct LifeTask {
    /// The bodies in contact, as they are at the beginning.
    pub problem: Arc<Problem>,
    /// The load of each pass.
    pub load: Load,
    /// The grid, or the accuracy of a refinement of the contact before the first pass: what follows is solved on its last grid.
    pub sampling: Sampling,
    /// Tolerance and limits of the solver.
    pub settings: Settings,
    /// Convention for the mean lateral stress.
    pub mean: MeanStress,
    /// Passes up to which it is followed; `None`: only to the first failure.
    pub passes: Option<f64>,
    /// Distance that the counterbody slides in one pass, a length; `None`: the period along the direction of sliding, or the width of the
    /// window along it.
    pub distance: Option<f64>,
    /// Relative error of a step of wear.
    pub tolerance: f64,
}

/// Why a life cannot be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LifeError {
    /// Nothing tires, and nothing wears over a number of passes.
    #[error(
        "neither a fatigue law nor wear is given: give a material `fatigue` or a layer `interface_fatigue`, or `wear` of a surface and `life.passes`"
    )]
    NothingTires,
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// The cell is too oblong for a refinement.
    #[error(transparent)]
    TooOblong(#[from] TooOblong),
    /// A penetration is prescribed while surfaces wear.
    #[error(
        "under a prescribed penetration surfaces wear until they do not touch: give `load.mean_pressure` or `load.force`, or leave `wear` out"
    )]
    Penetration,
    /// Wear is refused.
    #[error(transparent)]
    Wear(#[from] WearError),
    /// A worn surface is no gap.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// It was interrupted.
    #[error("the search for damage was interrupted")]
    Interrupted,
}

impl LifeTask {
    /// Refuses a body that neither tires nor wears, a penetration under which surfaces wear, and wear along a direction that the window of
    /// an isolated contact does not allow.
    ///
    /// # Errors
    /// [`LifeError::NothingTires`], [`LifeError::Penetration`] and [`LifeError::Wear`].
    pub fn check(&self) -> Result<(), LifeError> {
        let wears = self.wears() && self.passes.is_some();
        if !wears {
            return if self.problem.bodies().tire() { Ok(()) } else { Err(LifeError::NothingTires) };
        }
        if let Load::Penetration(_) = self.load {
            return Err(LifeError::Penetration);
        }
        let wear = self.wear(&self.problem)?;
        if self.body_wears() { Ok(wear.check(self.problem.cell())?) } else { Ok(()) }
    }

    fn body_wears(&self) -> bool {
        let wears = |own: Durability| own.wear.is_some_and(|wear| wear > 0.0);
        self.problem.half_space().durabilities().any(wears)
    }

    /// Whether a surface wears by sliding, at first or after layers have come off.
    pub(super) fn wears(&self) -> bool {
        self.body_wears() || self.problem.bodies().wear(Side::Counterbody) > 0.0
    }

    /// Wear of the surfaces of a problem.
    pub(super) fn wear(&self, problem: &Problem) -> Result<Wear, WearError> {
        let wear = Wear::of(problem);
        if self.problem.cell().is_isolated() { wear.with_stroke(self.distance()) } else { Ok(wear) }
    }

    /// Distance that the counterbody slides in one pass, a length.
    pub fn distance(&self) -> f64 {
        let (cell, direction) = (self.problem.cell(), self.problem.direction());
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        self.distance.unwrap_or_else(|| match cell.closing_vector(direction) {
            _ if cell.is_isolated() => {
                let [[width, _], [_, height]] = cell.vectors();
                width * direction[0].abs() + height * direction[1].abs()
            }
            Some(multiples) => length(cell.vector(multiples.map(f64::from))),
            // A path that never closes has no period: the side of a square as large as the cell.
            None => cell.area().sqrt(),
        })
    }
}

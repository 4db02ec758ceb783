//! The task of following a life: bodies, load, grid, and how far.

use crate::body::{Durability, MeanStress, Side};
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::problem::Problem;
use crate::run::{Motion, Sampling, TooOblong};
use crate::spectral::{FieldError, RollError, Settings, SlipError, Wear, WearError};
use crate::stress::period_along;
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
    /// Distance that the counterbody slides in one pass, a length; `None`: the period along the direction of sliding, and of an isolated
    /// contact no distance.
    pub distance: Option<f64>,
    /// Stroke of a counterbody that goes to and fro, a length, in the place of a distance: there and back is one pass.
    pub stroke: Option<f64>,
    /// Relative error of a step of wear.
    pub tolerance: f64,
    /// Motions from the first contact on, the last of which make a closed cycle, of a contact that sticks and slips: a pass is that cycle.
    /// `None` of a counterbody that slides.
    pub motions: Option<Vec<Motion>>,
}

/// Why a life cannot be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LifeError {
    /// The surfaces adhere.
    #[error("fatigue and wear of surfaces that adhere are not followed: leave adhesion out")]
    Adheres,
    /// Nothing tires, and nothing wears over a number of passes.
    #[error(
        "neither a fatigue law nor wear is given: give a material `fatigue` or `strain_life`, or a layer `interface_fatigue`, or `wear` of a \
         surface and `life.passes`"
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
    /// The counterbody of an isolated contact wears, and how far it slides in a pass is not known.
    #[error(
        "the counterbody of an isolated contact wears by the distance that it slides in a pass, which the case does not say: give \
         `life.distance`, of a pin or ball on a disc the circumference of its track (2π times the track radius), or `life.stroke` of one \
         that goes to and fro"
    )]
    NoDistance,
    /// The hardness is that of the coating and its substrate together.
    #[error("`composite_hardness` is that of one loading, not of passes that wear or tire: leave it out")]
    CompositeHardness,
    /// A distance and a stroke.
    #[error("`life.distance` and `life.stroke` both say how far the counterbody slides in a pass: give one of them")]
    DistanceAndStroke,
    /// A stroke that is shorter than the period of the surface.
    #[error(
        "`life.stroke` = {stroke} is shorter than the period {period} of the surface along the path, so that points of the body meet \
         different parts of it: give a longer stroke, or a cell whose period is shorter, or an isolated contact"
    )]
    ShortStroke {
        /// The stroke, a length.
        stroke: f64,
        /// The period along the path, a length.
        period: f64,
    },
    /// Wear is refused.
    #[error(transparent)]
    Wear(#[from] WearError),
    /// A worn surface is no gap.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A history does not end with a closed cycle.
    #[error(
        "a pass of a contact that sticks and slips is a cycle, and [tangential] does not come back, from the same side, to a force or shift that \
         it had before: give tangential.path, or steps that end where an earlier one does"
    )]
    NoCycle,
    /// A contact that rolls.
    #[error("wear by rolling is not followed: percoat solve states the passes to the first damage")]
    Rolls,
    /// A distance or a stroke of a contact that sticks and slips.
    #[error(
        "a pass of a contact that sticks and slips is a cycle of [tangential]: leave life.distance and life.stroke out"
    )]
    CycleAndDistance,
    /// Partial slip cannot be set up.
    #[error(transparent)]
    Slip(#[from] SlipError),
    /// The contact does not stick so.
    #[error(transparent)]
    Slides(#[from] RollError),
    /// The search for damage was interrupted.
    #[error("the search for damage was interrupted")]
    Interrupted,
}

impl LifeTask {
    /// Refuses a body that neither tires nor wears, a penetration under which surfaces wear, wear along a direction that the window of
    /// an isolated contact does not allow, and passes whose length is not known or said twice.
    ///
    /// # Errors
    /// [`LifeError::NothingTires`], [`LifeError::Penetration`], [`LifeError::Wear`], [`LifeError::NoDistance`],
    /// [`LifeError::DistanceAndStroke`] and [`LifeError::ShortStroke`].
    pub fn check(&self) -> Result<(), LifeError> {
        if self.problem.adhesion().is_some() {
            return Err(LifeError::Adheres);
        }
        if matches!(self.load, Load::Grip { .. }) {
            return Err(LifeError::Penetration);
        }
        if self.problem.composite_hardness().is_some() {
            return Err(LifeError::CompositeHardness);
        }
        if self.distance.is_some() && self.stroke.is_some() {
            return Err(LifeError::DistanceAndStroke);
        }
        if let Some(motions) = &self.motions {
            return self.check_in_place(motions);
        }
        if let Some((stroke, period)) = self.stroke.zip(self.period()).filter(|(stroke, period)| stroke < period) {
            return Err(LifeError::ShortStroke { stroke, period });
        }
        let wears = self.wears() && self.passes.is_some();
        if !wears {
            return if self.problem.bodies().tire() { Ok(()) } else { Err(LifeError::NothingTires) };
        }
        if let Load::Penetration(_) = self.load {
            return Err(LifeError::Penetration);
        }
        if self.problem.bodies().wear(Side::Counterbody) > 0.0 && self.distance().is_none() {
            return Err(LifeError::NoDistance);
        }
        let wear = self.wear(&self.problem)?;
        if self.body_wears() { Ok(wear.check(self.problem.cell())?) } else { Ok(()) }
    }

    /// The checks of a contact that sticks and slips.
    fn check_in_place(&self, motions: &[Motion]) -> Result<(), LifeError> {
        if motions.iter().any(|motion| matches!(motion, Motion::Roll(..))) {
            return Err(LifeError::Rolls);
        }
        if self.distance.is_some() || self.stroke.is_some() {
            return Err(LifeError::CycleAndDistance);
        }
        if self.cycle_length().is_none() {
            return Err(LifeError::NoCycle);
        }
        let wears = self.wears() && self.passes.is_some();
        match self.load {
            Load::Penetration(_) if wears => Err(LifeError::Penetration),
            _ if wears || self.problem.bodies().tire_by_stress() => Ok(()),
            _ => Err(LifeError::NothingTires),
        }
    }

    fn body_wears(&self) -> bool {
        let wears = |durability: Durability| durability.wear.is_some_and(|wear| wear > 0.0);
        self.problem.half_space().durabilities().any(wears)
    }

    /// Whether a surface wears by sliding, at first or after layers have come off.
    pub(super) fn wears(&self) -> bool {
        self.body_wears() || self.problem.bodies().wear(Side::Counterbody) > 0.0
    }

    /// Wear of the surfaces of a problem.
    pub(super) fn wear(&self, problem: &Problem) -> Result<Wear, WearError> {
        // A point of the track is passed once in each way; on a periodic cell the stroke does not count.
        Wear::of(problem).with_stroke(self.way().unwrap_or(self.slid()))
    }

    /// Distance that the counterbody slides in one pass, a length: there and back where it goes to and fro. `None` of an isolated contact
    /// without a distance, and of a contact that sticks and slips.
    pub fn distance(&self) -> Option<f64> {
        if self.motions.is_some() {
            return None;
        }
        self.stroke.map(|stroke| 2.0 * stroke).or(self.distance).or_else(|| self.period())
    }

    /// Distance that the counterbody has slid after some passes, a length; `None` where it is not known, or infinite.
    pub fn slid_after(&self, passes: f64) -> Option<f64> {
        self.distance().map(|distance| passes * distance).filter(|slid| slid.is_finite())
    }

    /// Length of one way of a pass, where it is not the period; a length.
    pub(super) fn way(&self) -> Option<f64> {
        self.stroke.or(self.distance)
    }

    /// Distance by which wear in a pass is counted, a length: where none is known the width of the window, of which the wear of the body
    /// in a pass does not depend.
    pub(super) fn slid(&self) -> f64 {
        let direction = self.problem.direction();
        let width = || {
            let [[width, _], [_, height]] = self.problem.cell().vectors();
            width * direction[0].abs() + height * direction[1].abs()
        };
        self.distance().unwrap_or_else(width)
    }

    /// Period of the surface along the path, a length; `None` of an isolated contact.
    fn period(&self) -> Option<f64> {
        period_along(self.problem.cell(), self.problem.direction())
    }
}

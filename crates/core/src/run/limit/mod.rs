//! Limit loads: the mean pressure at which each criterion of strength is reached.
//!
//! Contact is not linear: a limit is found by solving. From the least load whose contact has a few samples along its radius on,
//! the mean pressure is doubled until every criterion has failed by more than its error or contact is complete; the loads of the
//! run are not used. With u the utilisation of a criterion and e its error, the limit is the least load at which u reaches 1,
//! found by secants of ln u(ln p̄) with bisection as their safeguard, to 10⁻³ of the load. Its interval reaches from the least
//! load at which u + e is 1 to the least one at which u − e is. A criterion of which u + e reaches 1 and u − e does not, and u
//! stays below 1, is undecided. Every load that is solved counts for all criteria.
//!
//! Utilisations are not monotone: the tension at an edge and the opening of an interface rise and fall again. Between two
//! loads u lies below lines of the steepest slope of that interval and its neighbours, times 1.5; where these reach 1 below the
//! first crossing, the interval is halved until they do not, or its ends are 5 % apart (10 % for u + e). The remaining uncertainty is
//! part of the limit's interval. Where a level of a shape of its own begins to touch, loads are divided until the load on it
//! grows by a factor of four at most. A topography has spots that begin to touch at any load: a hump that is narrower than
//! the slopes between the loads suggest is not found.
//!
//! Loads for which an isolated contact of indenters has no room in its window are solved in a window twice as large, up to six times
//! one after another. A topography ends with its window.
//!
//! Beyond complete contact the shape adds nothing, and stresses grow by those of a uniform pressure: no limit is searched for
//! there. Shapes with ridges between them come into complete contact under an infinite pressure only; on a grid under a finite
//! one, where the search ends.
//!
//! Under a hardness H no contact bears a mean pressure of H, and the search ends at 0.999 H where contact is not complete before. A given
//! pressure grows until its highest value is 0.999 H.
//!
//! A contact that sticks and slips goes through the whole history of its tangential forces, parts of μP, or shifts at each load that is
//! solved: a utilisation is the largest of all steps, and endurance that of its last closed cycle.

mod band;
mod curve;
mod enclosure;
mod limits;
mod record;
mod search;
mod section;
mod windows;
mod words;

pub use limits::{At, Limit, LimitStep, Limits, SearchEnd, first, rivals};
pub use search::EVENTS;

use super::{Recorder, Run, RunError, Sampling};
use crate::reading::Criterion;
use crate::spectral::CreepError;
use search::LimitSearch;
use std::convert::Infallible;
use std::error::Error;

impl Run {
    /// Checks that limit loads can be searched: there are strengths, and grids. The run's loads are not used.
    ///
    /// # Errors
    /// [`RunError::NoStrengths`], [`TooOblong`](super::TooOblong), [`LatticeError`](crate::lattice::LatticeError).
    pub fn check_limits(&self) -> Result<(), RunError<Infallible>> {
        self.checked_for_limits()
    }

    fn checked_for_limits<E: Error + 'static>(&self) -> Result<(), RunError<E>> {
        if self.times.is_some() {
            return Err(CreepError::Stresses.into());
        }
        if self.motions.is_some() {
            self.history::<E>()?;
        }
        if Criterion::all(self.problem.bodies()).is_empty() {
            return Err(RunError::NoStrengths);
        }
        self.checked_sampling()?;
        self.check_adhesion()
    }

    /// Searches the limit loads of all criteria.
    ///
    /// ```
    /// use percoat_core::*;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// // Spheres that slide on steel with a hard coating, in GPa and µm.
    /// let spheres = Indenters::new(Lattice::square(20.0, 1)?, vec![Level::new(Shape::Sphere { radius: 50.0 }, 0.0)?])?;
    /// let bears = Strength { yielding: None, tensile: Some(1.5) };
    /// let bond = InterfaceStrength { normal: Some(0.5), shear: Some(1.0), friction: 0.0 };
    /// let coating = Layer::new(Material::from_young(300.0, 0.25)?, 2.0, Interface::Bonded)?.with_strengths(bears, bond)?;
    /// let yields = Strength { yielding: Some(2.0), tensile: None };
    /// let body = HalfSpace::new(vec![coating], Material::from_young(210.0, 0.3)?).with_substrate_strength(yields)?;
    /// let problem = Problem::new(spheres, body).sliding(Friction::new(0.2, [1.0, 0.0])?)?;
    /// let run = Run::new(problem, vec![Load::MeanPressure(0.05)], Sampling::Points([64, 64]));
    /// let limits = run.limits(&mut ())?;
    /// println!("{limits}"); // first: cracking of material 1 at the mean pressure …
    /// let first = limits.first().expect("something fails");
    /// assert!(limits.converged() && limits.limits.len() == 3 && first.load() > 0.0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// The search is repeated under [`Sampling::Accuracy`] on finer grids until the limits change by less. The run's loads are not used,
    /// and of its stress request only the convention for the mean lateral stress is.
    ///
    /// # Errors
    /// [`RunError`], see [`check_limits`](Self::check_limits).
    pub fn limits<R: Recorder>(&self, recorder: &mut R) -> Result<Limits, RunError<R::Error>> {
        self.limits_up_to(f64::INFINITY, recorder)
    }

    /// Searches the limit loads of all criteria up to the load `most` > 0, in the [quantity](Self::quantity) of the run: what holds under it
    /// has no limit. No higher load is solved.
    ///
    /// # Errors
    /// [`RunError`], see [`check_limits`](Self::check_limits).
    pub fn limits_up_to<R: Recorder>(&self, most: f64, recorder: &mut R) -> Result<Limits, RunError<R::Error>> {
        self.checked_for_limits()?;
        let mut limits = match self.sampling {
            Sampling::Points(points) => LimitSearch::on_grid(self, (points, most), recorder)?,
            Sampling::Accuracy(accuracy) => {
                let mut refinement = self.refinement(accuracy)?;
                let mut coarse: Option<Limits> = None;
                loop {
                    let points = refinement.points();
                    let mut limits = LimitSearch::on_grid(self, (points, most), recorder)?;
                    limits.change = coarse.take().map(|coarse| limits.change_from(&coarse));
                    if let Some(change) = limits.change {
                        recorder.refined(points, change);
                    }
                    limits.end = refinement.refine(limits.change, |points| recorder.fits(points));
                    if limits.end.is_some() {
                        break limits;
                    }
                    // The memory of its fields is freed before the next grid needs as much and more.
                    limits.shown = Vec::new();
                    coarse = Some(limits);
                }
            }
        };
        limits.warnings = limits.doubts(&self.problem);
        Ok(limits)
    }
}

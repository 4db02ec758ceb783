//! A path of sliding, followed in steps whose length is controlled by their error.
//!
//! A step is accepted where the ratio e of its error to the depth worn is at most the tolerance. The ratio grows as Δs² where pressures are
//! smooth along s, and about as Δs where contact reaches a point: the next step is √(tolerance/e) times as long, the next try of a step
//! that was too long tolerance/e times. The error of the depth at the end of the path is the largest sum of these errors at a point.

use super::worn_step::WornStep;
use crate::body::Side;
use crate::load::Load;
use crate::spectral::{Solver, Step, Stop, Wear, WearError, Worn};
use ndarray::Array2;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Part of the length at which the error would be the tolerance that the next step has.
const SAFETY: f64 = 0.9;
/// Range of the length of a step over that of the one before.
const FACTORS: [f64; 2] = [0.1, 4.0];
/// Least length of a step over that of the path, and of one whose contact is not solved.
const LEAST: f64 = 1e-12;
const LEAST_UNSOLVED: f64 = 1e-6;

/// A path of sliding under a fixed load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearPath {
    /// The load. A penetration counts from the first touch of the surfaces as they are at the start of the path, and stays while
    /// they wear.
    pub load: Load,
    /// The coefficients of wear and the direction.
    pub wear: Wear,
    /// Distance of sliding s, a length.
    pub distance: f64,
    /// Largest error of a step, over the depth that it wears off or a tenth of all.
    pub tolerance: f64,
    /// Depth worn off before the path, a length, which counts to all.
    pub before: f64,
    /// Largest change of the largest pressure in a step, over that at its start; infinite: any.
    pub change: f64,
    /// Length of the first step that is tried; `None`: the tolerance of the distance.
    pub first: Option<f64>,
    /// Largest number of accepted steps.
    pub max_steps: usize,
}

/// How a path ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PathEnd {
    /// The whole distance is slid.
    Complete,
    /// The callback ended the path.
    Stopped,
    /// The largest number of steps is reached.
    StepLimit,
    /// No length of a step solves the contact.
    Unsolved(Stop),
}

/// A path that was followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WornPath {
    /// The accepted steps.
    pub steps: Vec<WornStep>,
    /// How the path ended.
    pub end: PathEnd,
    /// Number of tries that were too long.
    pub rejected: usize,
    /// Length of the step that would be tried next.
    pub next: f64,
}

impl WearPath {
    /// Path of a `distance` under a load, with errors of steps up to the `tolerance`.
    ///
    /// # Errors
    /// [`WearError`] for a distance that is negative or not finite and a tolerance that is not positive and finite.
    pub fn new(load: Load, wear: Wear, distance: f64, tolerance: f64) -> Result<Self, WearError> {
        if !(distance.is_finite() && distance >= 0.0) {
            return Err(WearError::Distance(distance));
        }
        if !(tolerance.is_finite() && tolerance > 0.0) {
            return Err(WearError::Tolerance(tolerance));
        }
        Ok(Self { load, wear, distance, tolerance, before: 0.0, change: f64::INFINITY, first: None, max_steps: 10_000 })
    }

    /// Slides along the path from the present surfaces of a solver, which then has the worn ones. Calls `each` after every accepted
    /// step, with the contact at its end; `Break` ends the path there.
    ///
    /// # Errors
    /// [`WearError`] for a direction that the window does not allow, and for a given pressure.
    pub fn slide(
        &self,
        solver: &mut Solver,
        each: &mut dyn FnMut(&WornStep, &Step) -> ControlFlow<()>,
    ) -> Result<WornPath, WearError> {
        let started = solver.worn().map_or(0.0, Worn::recession);
        let mut path = WornPath { steps: Vec::new(), end: PathEnd::Complete, rejected: 0, next: 0.0 };
        let begun = solver.wear(self.load, &self.wear, 0.0)?;
        if !begun.report.stop.solved() {
            return Ok(WornPath { end: PathEnd::Unsolved(begun.report.stop), ..path });
        }
        let (mut slid, mut convolutions) = (0.0, begun.convolutions);
        let mut errors = Array2::zeros(solver.grid().points());
        drop(begun);
        let keeps = solver.problem().bodies().hardness().is_some_and(|(_, softer)| softer == Side::Counterbody);
        if keeps {
            solver.keep_indentation();
        }
        let mut present = solver.wear_state();
        let least = LEAST * self.distance;
        let mut length = self.first.map_or(self.distance * self.tolerance.min(1.0), |first| first.max(least));
        while slid < self.distance {
            if path.steps.len() == self.max_steps {
                path.end = PathEnd::StepLimit;
                break;
            }
            let left = self.distance - slid;
            length = fitted(length, left);
            let tried = self.tried(solver, started, &present, length)?;
            convolutions += tried.convolutions;
            let excess = tried.excess(self);
            if let (true, Some(step)) = (excess <= 1.0, tried.step) {
                errors += &tried.errors;
                slid = if length == left { self.distance } else { slid + length };
                let worn = WornStep {
                    error: tried.relative,
                    convolutions,
                    length,
                    ..WornStep::of(solver, &step, slid, &errors)
                };
                path.steps.push(worn);
                convolutions = 0.0;
                if keeps {
                    solver.keep_indentation();
                }
                present = solver.wear_state();
                path.next = length * next_length(excess);
                if each(&worn, &step).is_break() {
                    path.end = PathEnd::Stopped;
                    break;
                }
            } else {
                path.rejected += 1;
                solver.return_to(present.clone());
                let least = if tried.stop.solved() { LEAST } else { LEAST_UNSOLVED };
                if length <= least * self.distance {
                    path.end = PathEnd::Unsolved(tried.stop);
                    break;
                }
            }
            length *= if tried.stop.solved() { next_length(excess) } else { FACTORS[0] };
        }
        Ok(path)
    }
}

/// Length of the next step: `length`, or all or half of what is `left` of the path, so that no last step has next to no length.
fn fitted(length: f64, left: f64) -> f64 {
    if left > 2.0 * length {
        length
    } else if left > length {
        0.5 * left
    } else {
        left
    }
}

/// Length of the next step over that of one with an excess, and of the next try after a step that was too long.
pub(crate) fn next_length(excess: f64) -> f64 {
    let part = if excess > 1.0 { SAFETY / excess } else { SAFETY / excess.sqrt() };
    part.clamp(FACTORS[0], FACTORS[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::{Cell, Lattice};
    use crate::numeric::array::samples;
    use crate::problem::Problem;
    use crate::run::wear::worn_step::{largest, worn_depth};
    use crate::spectral::Settings;

    fn solver(cell: Option<Cell>) -> Solver {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
        let indenters = match cell {
            Some(cell) => Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]]).unwrap(), vec![level(0.0)]),
            None => Indenters::new(Lattice::square(1.0, 2).unwrap(), vec![level(0.01), level(0.0)]),
        };
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let problem = Problem::new(indenters.unwrap(), body);
        Solver::new(problem, [48, 48], Settings { tolerance: 1e-10, ..Settings::default() }).unwrap()
    }

    fn go_on(_: &WornStep, _: &Step) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    /// Against equal implicit steps of Euler, extrapolated: the stated error bounds the true one to leading order, and both fall with the
    /// tolerance.
    #[test]
    fn the_stated_error_is_that_of_the_worn_depth() {
        let (load, wear, distance) = (Load::MeanPressure(0.02), Wear::new(0.0, 1.0, [1.0, 0.0]).unwrap(), 0.5);
        let equal = |steps: usize| {
            let mut solver = solver(None);
            for _ in 0..steps {
                solver.wear(load, &wear, distance / steps as f64).unwrap();
            }
            worn_depth(&solver)
        };
        let apart = |a: &Array2<f64>, b: &Array2<f64>| largest(samples(&(a - b)));
        let [coarse, middle, fine] = [128, 256, 512].map(equal);
        let exact = 2.0 * &fine - &middle;
        let deepest = largest(samples(&exact));
        let of_reference = apart(&exact, &(2.0 * middle - coarse)) / deepest;
        assert!(of_reference < 3e-4, "{of_reference:e}");
        let mut last = f64::INFINITY;
        for (tolerance, most) in [(0.1, 16), (1e-2, 60), (1e-3, 250)] {
            let mut solver = solver(None);
            let path = WearPath::new(load, wear, distance, tolerance).unwrap().slide(&mut solver, &mut go_on).unwrap();
            assert_eq!(path.end, PathEnd::Complete);
            let end = path.steps.last().unwrap();
            let error = apart(&worn_depth(&solver), &exact) / deepest;
            assert!(error < 1.5 * end.accumulated_error + of_reference, "{error:e}: {end:?}");
            assert!(error < (0.5 * last).max(of_reference), "{error:e} {last:e}");
            assert!(end.accumulated_error <= 3.0 * tolerance && end.distance == distance);
            assert!(path.steps.iter().all(|step| step.error <= tolerance));
            let length: f64 = path.steps.iter().map(|step| step.length).sum();
            assert!((length / distance - 1.0).abs() < 1e-12);
            let volume = distance * 0.02 * solver.grid().cell().area();
            assert!((end.counterbody.volume / volume - 1.0).abs() < 1e-12 && end.body.volume == 0.0);
            let steps = path.steps.len();
            assert!(steps < most && path.rejected < steps, "{tolerance}: {steps} {}", path.rejected);
            last = error;
        }
    }

    /// Steps of a limited change of the largest pressure.
    #[test]
    fn the_pressure_changes_by_no_more_than_is_allowed_in_a_step() {
        let wear = Wear::new(0.2, 0.5, [1.0, 0.0]).unwrap();
        let path = WearPath::new(Load::MeanPressure(0.02), wear, 0.5, 0.5).unwrap();
        let changes = |change: f64| {
            let mut last = None;
            let mut changes = Vec::new();
            let path = WearPath { change, ..path }.slide(&mut solver(None), &mut |step, _| {
                changes.extend(last.replace(step.max_pressure).map(|last: f64| (step.max_pressure / last - 1.0).abs()));
                ControlFlow::Continue(())
            });
            assert_eq!(path.unwrap().end, PathEnd::Complete);
            changes.into_iter().fold(0.0, f64::max)
        };
        assert!(changes(f64::INFINITY) > 0.05 && changes(0.02) <= 0.02 * (1.0 + 1e-12));
    }

    /// Steps grow while wear levels the pressure: of a path a thousand times as long, few more are needed.
    #[test]
    fn steps_grow_on_a_long_path() {
        let wear = Wear::new(0.2, 0.5, [1.0, 0.0]).unwrap();
        let steps = [1.0, 1e3, 1e6].map(|distance| {
            let path = WearPath::new(Load::MeanPressure(0.02), wear, distance, 0.1).unwrap();
            let path = path.slide(&mut solver(None), &mut go_on).unwrap();
            assert_eq!(path.end, PathEnd::Complete);
            let end = path.steps.last().unwrap();
            assert!(distance < 1e3 || (end.max_pressure / 0.02 - 1.0).abs() < 0.05, "{end:?}");
            path.steps.len()
        });
        assert!(steps[2] < steps[1] + 20 && steps[1] < 100, "{steps:?}");
    }

    /// At a fixed approach of the bodies the force falls, and nothing wears deeper than the penetration.
    #[test]
    fn at_a_fixed_penetration_the_force_falls() {
        for cell in [None, Some(Cell::window([1.2, 1.2]).unwrap())] {
            let wear = Wear::new(0.2, 0.5, [1.0, 0.0]).unwrap();
            let mut forces = Vec::new();
            let path = WearPath::new(Load::Penetration(0.02), wear, 10.0, 0.2).unwrap();
            let mut solver = solver(cell);
            let path = path.slide(&mut solver, &mut |step, contact| {
                forces.push(step.force);
                assert!((contact.penetration() + step.recession - 0.02).abs() < 1e-15);
                ControlFlow::Continue(())
            });
            let path = path.unwrap();
            assert_eq!(path.end, PathEnd::Complete);
            // What wears away within a step is gone but for a part of the tolerance.
            let rise = forces.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
            assert!(rise < 0.02 * forces[0] && forces[forces.len() - 1] < 0.1 * forces[0], "{forces:?}");
            let most = 0.02 * (1.0 + path.steps.last().unwrap().accumulated_error);
            assert!(worn_depth(&solver).iter().all(|&depth| depth < most));
        }
    }

    #[test]
    fn a_callback_ends_the_path_and_an_isolated_contact_at_its_window() {
        let wear = Wear::new(0.0, 1.0, [1.0, 0.0]).unwrap();
        let path = WearPath::new(Load::Force(0.01), wear, 1.0, 0.1).unwrap();
        let stopped = path.slide(&mut solver(None), &mut |_, _| ControlFlow::Break(())).unwrap();
        assert_eq!((stopped.end, stopped.steps.len()), (PathEnd::Stopped, 1));
        let limited = WearPath { max_steps: 2, ..path }.slide(&mut solver(None), &mut go_on).unwrap();
        assert_eq!((limited.end, limited.steps.len()), (PathEnd::StepLimit, 2));
        // A flat as wide as the window.
        let path = WearPath { distance: 100.0, tolerance: 0.5, ..path };
        let mut solver = solver(Some(Cell::window([0.6, 0.6]).unwrap()));
        let ended = path.slide(&mut solver, &mut go_on).unwrap();
        assert_eq!(ended.end, PathEnd::Unsolved(Stop::AtBorder));
        assert!(WearPath::new(path.load, wear, 1.0, 0.0).is_err());
        assert!(WearPath::new(path.load, wear, f64::NAN, 0.1).is_err());
    }
}

//! Wear along a path of sliding under a fixed load, in implicit steps of controlled length.
//!
//! A step Δs is solved at once and again in two halves, h₁ and h₂ the depths worn off both surfaces by then. Of first order, they
//! err by ½Δs²h″ and ¼Δs²h″: the error of the two halves, which are kept, is their difference,
//!
//! e = max |h₁ − h₂| / max Δh₂,
//!
//! over the depth worn in the step. It grows as Δs: a step is accepted where e is at most the tolerance, and the next one, or the next
//! try, is 0.8 tolerance/e times as long. Wear levels the pressure, by which the steps grow; any length is stable. The differences add up
//! to the error of the depth at the end of the path, to leading order at most the tolerance times the depth.
//!
//! Memory besides that of the solver, bytes per sample: 24 on every grid (pressure, gap and initial gap before the step) and on the finest
//! 64 (the depths of both surfaces now and before the step, and those of both together before it, after the step and after the halves).

use crate::body::Side;
use crate::load::Load;
use crate::numeric::array::samples;
use crate::numeric::sums;
use crate::spectral::{Solver, Step, Stop, Wear, WearError, Worn};
use ndarray::Array2;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Part of the length at which the error would be the tolerance that the next step has.
const SAFETY: f64 = 0.8;
/// Range of the length of a step over that of the one before.
const FACTORS: [f64; 2] = [0.1, 4.0];
/// Least length of a step over that of the path.
const LEAST: f64 = 1e-6;

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
    /// Largest error of a step, over the depth that it wears off.
    pub tolerance: f64,
    /// Length of the first step that is tried; `None`: the tolerance of the distance.
    pub first: Option<f64>,
    /// Largest number of accepted steps.
    pub max_steps: usize,
}

/// What is worn off one surface, since the solver was made.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WornSurface {
    /// Volume on one cell or by an isolated contact, a cubed length.
    pub volume: f64,
    /// Largest depth, a length.
    pub depth: f64,
}

/// An accepted step of a path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WornStep {
    /// Distance from the start of the path to the end of the step, a length.
    pub distance: f64,
    /// Length Δs of the step.
    pub length: f64,
    /// Error e of the depth worn off in the step.
    pub error: f64,
    /// Error of the depth worn off on the path so far, over the largest one.
    pub accumulated_error: f64,
    /// What is worn off the body.
    pub body: WornSurface,
    /// What is worn off the counterbody.
    pub counterbody: WornSurface,
    /// Force on one cell or on the isolated contact at the end of the step, a pressure times an area.
    pub force: f64,
    /// Largest pressure at the end of the step.
    pub max_pressure: f64,
    /// Penetration at the end of the step, from the first touch of the worn surfaces, a length.
    pub penetration: f64,
    /// By how much that first touch lies deeper than that of the unworn surfaces, a length.
    pub recession: f64,
    /// Convolutions of its tries, as equivalents of the finest grid.
    pub convolutions: f64,
}

/// How a path ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PathEnd {
    /// At its end.
    Complete,
    /// By the callback.
    Stopped,
    /// At the largest number of steps.
    StepLimit,
    /// At a contact that no length of a step solves.
    Unsolved(Stop),
}

/// A path that was followed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WornPath {
    /// The accepted steps.
    pub steps: Vec<WornStep>,
    /// How it ended.
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
        Ok(Self { load, wear, distance, tolerance, first: None, max_steps: 10_000 })
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
        let (mut slid, mut error, mut convolutions) = (0.0, 0.0, 0.0);
        let mut length = self.first.unwrap_or(self.distance * self.tolerance.min(1.0));
        while slid < self.distance {
            if path.steps.len() == self.max_steps {
                path.end = PathEnd::StepLimit;
                break;
            }
            // What is left is not cut into a last step of next to no length.
            let left = self.distance - slid;
            length = if left > 2.0 * length {
                length
            } else if left > length {
                0.5 * left
            } else {
                left
            };
            let state = solver.wear_state();
            let tried = self.tried(solver, started, length)?;
            convolutions += tried.convolutions;
            let relative = if tried.depth > 0.0 { tried.difference / tried.depth } else { 0.0 };
            if let (true, Some(step)) = (relative <= self.tolerance, tried.step) {
                error += tried.difference;
                slid = if length == left { self.distance } else { slid + length };
                let worn =
                    WornStep { error: relative, convolutions, length, ..self.reached(solver, &step, slid, error) };
                path.steps.push(worn);
                convolutions = 0.0;
                path.next = length * self.factor(relative);
                if each(&worn, &step).is_break() {
                    path.end = PathEnd::Stopped;
                    break;
                }
            } else {
                path.rejected += 1;
                solver.return_to(state);
                if length <= LEAST * self.distance {
                    path.end = PathEnd::Unsolved(tried.stop);
                    break;
                }
            }
            length *= if tried.stop.solved() { self.factor(relative) } else { FACTORS[0] };
        }
        Ok(path)
    }

    /// Length of the next step over that of a step with a relative error.
    fn factor(&self, relative: f64) -> f64 {
        (SAFETY * self.tolerance / relative).clamp(FACTORS[0], FACTORS[1])
    }

    /// A step at once and in two halves; the solver is left after the halves.
    fn tried(&self, solver: &mut Solver, started: f64, length: f64) -> Result<Tried, WearError> {
        let state = solver.wear_state();
        let before = depth(solver);
        let once = solver.wear(self.load_now(solver, started), &self.wear, length)?;
        let failed = |step: &Step, convolutions: f64| Tried {
            step: None,
            stop: step.report.stop,
            difference: 0.0,
            depth: 0.0,
            convolutions,
        };
        let mut convolutions = once.convolutions;
        if !once.report.stop.solved() {
            return Ok(failed(&once, convolutions));
        }
        drop(once);
        let at_once = depth(solver);
        solver.return_to(state);
        let mut last = None;
        for _ in 0..2 {
            drop(last.take());
            let half = solver.wear(self.load_now(solver, started), &self.wear, 0.5 * length)?;
            convolutions += half.convolutions;
            if !half.report.stop.solved() {
                return Ok(failed(&half, convolutions));
            }
            last = Some(half);
        }
        let (halves, stop) = (depth(solver), last.as_ref().map_or(Stop::Stalled, |step| step.report.stop));
        let largest = |a: &Array2<f64>, b: &Array2<f64>| {
            let (a, b) = (samples(a), samples(b));
            -sums::least(a.len(), |i| -(a[i] - b[i]).abs())
        };
        let (difference, depth) = (largest(&at_once, &halves), largest(&halves, &before));
        Ok(Tried { step: last, stop, difference, depth, convolutions })
    }

    /// The load on the surfaces as they are worn by now.
    fn load_now(&self, solver: &Solver, started: f64) -> Load {
        let receded = solver.worn().map_or(0.0, Worn::recession) - started;
        match self.load {
            Load::Penetration(penetration) => Load::Penetration(penetration - receded),
            load => load,
        }
    }

    /// What a step has reached, its own length, error and convolutions left out.
    fn reached(&self, solver: &Solver, step: &Step, distance: f64, error: f64) -> WornStep {
        let worn = solver.worn();
        let surface = |side: Side| WornSurface {
            volume: worn.map_or(0.0, |worn| worn.volume(side)),
            depth: worn.map_or(0.0, |worn| worn.largest(side)),
        };
        let deepest = samples(&depth(solver)).iter().copied().fold(0.0, f64::max);
        let pressure = step.finest().pressures();
        WornStep {
            distance,
            length: 0.0,
            error: 0.0,
            accumulated_error: if deepest > 0.0 { error / deepest } else { 0.0 },
            body: surface(Side::Body),
            counterbody: surface(Side::Counterbody),
            force: sums::of(pressure.len(), |i| [pressure[i]])[0] * step.grid().sample_area(),
            max_pressure: -sums::least(pressure.len(), |i| -pressure[i]),
            penetration: step.penetration(),
            recession: worn.map_or(0.0, Worn::recession),
            convolutions: 0.0,
        }
    }
}

/// A step that was tried.
struct Tried {
    /// The contact at its end, unless it is not solved.
    step: Option<Step>,
    stop: Stop,
    /// Largest difference of the depths, and largest depth worn in the step, lengths.
    difference: f64,
    depth: f64,
    convolutions: f64,
}

/// Depth worn off both surfaces together.
fn depth(solver: &Solver) -> Array2<f64> {
    let none = || Array2::zeros(solver.grid().points());
    solver.worn().map_or_else(none, |worn| &worn.depth(Side::Body) + &worn.depth(Side::Counterbody))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::{Cell, Lattice};
    use crate::problem::Problem;
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

    /// Against 256 equal steps, whose own error is 256 times smaller than that of one: the stated error bounds the true one to leading
    /// order, and both fall with the tolerance.
    #[test]
    fn the_stated_error_is_that_of_the_worn_depth() {
        let (load, wear, distance) = (Load::MeanPressure(0.02), Wear::new(0.0, 1.0, [1.0, 0.0]).unwrap(), 0.5);
        let mut fine = solver(None);
        for _ in 0..512 {
            fine.wear(load, &wear, distance / 512.0).unwrap();
        }
        let exact = depth(&fine);
        let deepest = exact.iter().copied().fold(0.0, f64::max);
        let mut last = f64::INFINITY;
        for tolerance in [0.1, 0.03] {
            let mut own = solver(None);
            let path = WearPath::new(load, wear, distance, tolerance).unwrap().slide(&mut own, &mut go_on).unwrap();
            assert_eq!(path.end, PathEnd::Complete);
            let end = path.steps.last().unwrap();
            let error = (&depth(&own) - &exact).iter().fold(0.0f64, |most, x| most.max(x.abs())) / deepest;
            assert!(error < 1.5 * end.accumulated_error && error < 0.7 * last, "{error:e}: {end:?}");
            assert!(end.accumulated_error <= 1.5 * tolerance && end.distance == distance);
            assert!(path.steps.iter().all(|step| step.error <= tolerance));
            let length: f64 = path.steps.iter().map(|step| step.length).sum();
            assert!((length / distance - 1.0).abs() < 1e-12);
            let volume = distance * 0.02 * own.grid().cell().area();
            assert!((end.counterbody.volume / volume - 1.0).abs() < 1e-12 && end.body.volume == 0.0);
            assert!(
                path.steps.len() < 100 && 3 * path.rejected < path.steps.len(),
                "{} {}",
                path.steps.len(),
                path.rejected
            );
            last = error;
        }
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
        assert!(steps[2] < steps[0] + 40, "{steps:?}");
    }

    /// At a fixed approach of the bodies the force falls, and nothing wears deeper than the penetration.
    #[test]
    fn at_a_fixed_penetration_the_force_falls() {
        for cell in [None, Some(Cell::window([1.2, 1.2]).unwrap())] {
            let wear = Wear::new(0.2, 0.5, [1.0, 0.0]).unwrap();
            let mut forces = Vec::new();
            let path = WearPath::new(Load::Penetration(0.02), wear, 10.0, 0.2).unwrap();
            let mut own = solver(cell);
            let path = path.slide(&mut own, &mut |step, contact| {
                forces.push(step.force);
                assert!((contact.penetration() + step.recession - 0.02).abs() < 1e-15);
                ControlFlow::Continue(())
            });
            assert_eq!(path.unwrap().end, PathEnd::Complete);
            assert!(forces.windows(2).all(|pair| pair[1] < pair[0]) && forces[forces.len() - 1] < 0.5 * forces[0]);
            assert!(depth(&own).iter().all(|&depth| depth < 0.02 * (1.0 + 1e-9)));
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
        let mut own = solver(Some(Cell::window([0.6, 0.6]).unwrap()));
        let ended = path.slide(&mut own, &mut go_on).unwrap();
        assert_eq!(ended.end, PathEnd::Unsolved(Stop::AtBorder));
        assert!(WearPath::new(path.load, wear, 1.0, 0.0).is_err());
        assert!(WearPath::new(path.load, wear, f64::NAN, 0.1).is_err());
    }
}

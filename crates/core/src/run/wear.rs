//! Wear along a path of sliding under a fixed load, in implicit steps of controlled length.
//!
//! The depth h with ∂h/∂s = k p is carried on by TR-BDF2 (Bank et al., IEEE Trans. CAD 4 (1985) 436; Hosea & Shampine, Appl. Numer.
//! Math. 20 (1996) 21): with d = 1 − 1/√2, w = √2/4 and the pressures p₀ at the start, p₁ after 2dΔs, p₂ at the end,
//!
//! h₁ = h₀ + k d Δs (p₀ + p₁),  h₂ = h₀ + k Δs [w (p₀ + p₁) + d p₂]:
//!
//! two implicit steps over dΔs, each after wear by known pressures. It is of second order and stable for any length, its weights are
//! positive, and their sum is one: the worn volume k P Δs under a given force P is exact. Waves that wear away within a step are gone at
//! its end. With the same pressures a third order has other weights, and the difference is the error of the step,
//!
//! k Δs [(√2−1) p₀ − p₁ + (2−√2) p₂]/3.
//!
//! The largest of it is compared with the largest depth worn in the step, or with a tenth of that worn so far where this is more: errors
//! where contact reaches a point are made once at each point, and do not add up. A step is accepted where this ratio e is at most the
//! tolerance. It grows as Δs² where pressures are smooth along s, and about as Δs where contact reaches a point: the next step is
//! √(tolerance/e) times as long, the next try of a step that was too long tolerance/e times. Wear levels the pressure, by which the steps
//! grow. The error of the depth at the end of the path is the largest sum of these errors at a point.
//!
//! A counterbody that is softer keeps what a step has pressed in: where it is at the hardness, wear lowers the pressure at once. A softer
//! body moves away below the contact, and keeps nothing.
//!
//! Memory besides that of the solver, bytes per sample: 72 on every grid (pressure, gap and initial gap at three moments) and on the finest
//! 80 (the depths of both surfaces at three moments, the errors of a step, their sum, and the depth that gives them).

use crate::body::Side;
use crate::load::Load;
use crate::numeric::array::samples;
use crate::numeric::sums;
use crate::spectral::{Solver, Step, Stop, Wear, WearError, WearState, Worn};
use ndarray::Array2;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// d and w of TR-BDF2.
const IMPLICIT: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
const EXPLICIT: f64 = 0.5 * std::f64::consts::FRAC_1_SQRT_2;
/// Weights of its error on the three pressures.
const ERROR: [f64; 3] = [(std::f64::consts::SQRT_2 - 1.0) / 3.0, -1.0 / 3.0, (2.0 - std::f64::consts::SQRT_2) / 3.0];
/// Part of the length at which the error would be the tolerance that the next step has.
const SAFETY: f64 = 0.9;
/// Range of the length of a step over that of the one before.
const FACTORS: [f64; 2] = [0.1, 4.0];
/// Part of the depth worn so far with which the error of a step is compared at least.
const OF_ALL: f64 = 0.1;
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

/// Wear of one surface since the solver was made.
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
    /// Error e of the step, over the depth worn off in it or a tenth of all.
    pub error: f64,
    /// Error of the depth worn off on the path so far, over the largest one since the solver was made.
    pub accumulated_error: f64,
    /// Wear of the body.
    pub body: WornSurface,
    /// Wear of the counterbody.
    pub counterbody: WornSurface,
    /// Force on one cell or on the isolated contact at the end of the step, a pressure times an area.
    pub force: f64,
    /// Largest pressure at the end of the step.
    pub max_pressure: f64,
    /// Penetration at the end of the step, from the first touch of the worn surfaces, a length.
    pub penetration: f64,
    /// Depth of that first touch below the one of the unworn surfaces, a length.
    pub recession: f64,
    /// Convolutions of all tries of the step, as equivalents of the finest grid.
    pub convolutions: f64,
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
                path.next = length * factor(excess);
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
            length *= if tried.stop.solved() { factor(excess) } else { FACTORS[0] };
        }
        Ok(path)
    }

    /// A step from the `present`; the solver is left at its end.
    fn tried(&self, solver: &mut Solver, started: f64, present: &WearState, length: f64) -> Result<Tried, WearError> {
        let [implicit, explicit] = [IMPLICIT, EXPLICIT].map(|part| part * length);
        solver.wear_by(&[(present, implicit)], &self.wear)?;
        let middle = solver.wear(self.load_now(solver, started), &self.wear, implicit)?;
        let mut tried = Tried {
            step: None,
            stop: middle.report.stop,
            errors: Array2::zeros([0, 0]),
            relative: 0.0,
            change: 0.0,
            convolutions: middle.convolutions,
        };
        if !tried.stop.solved() {
            return Ok(tried);
        }
        drop(middle);
        let middle = solver.wear_state();
        // From the start again, with the pressure of the middle as the first guess.
        solver.return_to_surfaces(present);
        solver.wear_by(&[(present, explicit), (&middle, explicit)], &self.wear)?;
        let step = solver.wear(self.load_now(solver, started), &self.wear, implicit)?;
        tried.stop = step.report.stop;
        tried.convolutions += step.convolutions;
        if !tried.stop.solved() {
            return Ok(tried);
        }
        let end = solver.wear_state();
        let moments = [present, &middle, &end];
        let depth = |weights: [f64; 3]| {
            let weighted: Vec<_> = moments.into_iter().zip(weights.map(|weight| weight * length)).collect();
            solver.depth_by(&weighted, &self.wear)
        };
        tried.errors = depth(ERROR)?;
        let of_step = largest(samples(&depth([EXPLICIT, EXPLICIT, IMPLICIT])?));
        let all = self.before + largest(samples(&worn_depth(solver)));
        let scale = of_step.max(OF_ALL * all);
        tried.relative = if scale > 0.0 { largest(samples(&tried.errors)) / scale } else { 0.0 };
        let [before, after] = [present, &end].map(|moment| largest(moment.pressure()));
        tried.change = if before > 0.0 { (after / before - 1.0).abs() } else { 0.0 };
        tried.step = Some(step);
        Ok(tried)
    }

    /// The load on the surfaces as they are worn by now.
    fn load_now(&self, solver: &Solver, started: f64) -> Load {
        let receded = solver.worn().map_or(0.0, Worn::recession) - started;
        match self.load {
            Load::Penetration(penetration) => Load::Penetration(penetration - receded),
            load => load,
        }
    }
}

impl WornStep {
    /// The state that a step has reached, without the length, error and convolutions of the step.
    fn of(solver: &Solver, step: &Step, distance: f64, errors: &Array2<f64>) -> Self {
        let worn = solver.worn();
        let surface = |side: Side| WornSurface {
            volume: worn.map_or(0.0, |worn| worn.volume(side)),
            depth: worn.map_or(0.0, |worn| worn.largest(side)),
        };
        let (deepest, error) = (largest(samples(&worn_depth(solver))), largest(samples(errors)));
        let pressure = step.finest().pressures();
        Self {
            distance,
            length: 0.0,
            error: 0.0,
            accumulated_error: if deepest > 0.0 { error / deepest } else { 0.0 },
            body: surface(Side::Body),
            counterbody: surface(Side::Counterbody),
            force: sums::of(pressure.len(), |i| [pressure[i]])[0] * step.grid().sample_area(),
            max_pressure: largest(pressure),
            penetration: step.penetration(),
            recession: worn.map_or(0.0, Worn::recession),
            convolutions: 0.0,
        }
    }
}

/// A step that was tried.
#[derive(Debug)]
struct Tried {
    /// The contact at its end, unless it is not solved.
    step: Option<Step>,
    stop: Stop,
    /// Errors of the depth, lengths, and the largest over the depth worn in the step or a tenth of all.
    errors: Array2<f64>,
    relative: f64,
    /// Relative change of the largest pressure.
    change: f64,
    convolutions: f64,
}

impl Tried {
    /// The larger of two ratios: error over tolerance, and change of the largest pressure over its limit. A step of at most 1 is accepted.
    fn excess(&self, path: &WearPath) -> f64 {
        (self.relative / path.tolerance).max(self.change / path.change)
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
fn factor(excess: f64) -> f64 {
    let part = if excess > 1.0 { SAFETY / excess } else { SAFETY / excess.sqrt() };
    part.clamp(FACTORS[0], FACTORS[1])
}

/// max |x|.
fn largest(field: &[f64]) -> f64 {
    -sums::least(field.len(), |i| -field[i].abs())
}

/// Depth worn off both surfaces together.
fn worn_depth(solver: &Solver) -> Array2<f64> {
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

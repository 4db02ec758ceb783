//! The engine of a run: what a recorder hears, and how a refinement ends.

use crate::common;

use common::{PAPER, one_level, paraboloid};
use percoat::run::{
    GridStart, Outcome, Recorder, RefinementEnd, Run, RunError, Sampling, StepRecord, StressRequest, change,
};
use percoat::{Cell, Lattice, Load, Method, Problem, Settings, Solver, Step, Stop, StressFields};
use std::convert::Infallible;
use std::ops::ControlFlow;

/// Writes down what it hears, and cannot go on at the step `fails`, or after so many iterations. It has room for so many
/// points along a side.
struct Diary {
    heard: Vec<String>,
    iterations: usize,
    fails: Option<usize>,
    most: Option<usize>,
    room: usize,
}

impl Default for Diary {
    fn default() -> Self {
        Self { heard: Vec::new(), iterations: 0, fails: None, most: None, room: usize::MAX }
    }
}

#[derive(Debug, thiserror::Error)]
#[error("no room in the diary")]
struct Full;

impl Recorder for Diary {
    type Error = Full;

    fn fits(&self, points: [usize; 2]) -> bool {
        points.iter().all(|&n| n <= self.room)
    }

    fn begin(&mut self, solver: &GridStart) -> Result<(), Full> {
        self.heard.push(format!("grid {}", solver.grid().points()[0]));
        Ok(())
    }

    fn iteration(&mut self, _: percoat::Progress) -> Result<(), Full> {
        self.iterations += 1;
        if self.most.is_some_and(|most| self.iterations > most) { Err(Full) } else { Ok(()) }
    }

    fn stresses(&mut self, step: &Step, record: &StepRecord) {
        assert!(record.stress.is_none() && record.reading.penetration == step.reading().penetration);
        self.heard.push("stresses".to_owned());
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), Full> {
        assert_eq!(fields.is_some(), record.stress.is_some());
        if self.fails == Some(self.heard.len()) {
            return Err(Full);
        }
        self.heard.push(format!("step {}", step.load.value()));
        Ok(())
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        assert!(change.is_finite() && change > 0.0);
        self.heard.push(format!("refined {}", points[0]));
    }
}

fn problem() -> Problem {
    let substrate = common::bare();
    Problem::new(one_level(Lattice::square(1.0, 1).unwrap(), paraboloid(0.8, 0.0)), substrate)
}

fn run(sampling: Sampling) -> Run {
    Run::new(problem(), [0.01, 0.02].map(Load::MeanPressure).to_vec(), sampling)
}

#[test]
fn a_recorder_hears_of_grids_steps_and_stresses_in_their_order() {
    let mut diary = Diary::default();
    let stressed = Run { stress: Some(StressRequest::default()), ..run(Sampling::Points([48, 48])) };
    let outcome = stressed.solve(&mut diary).unwrap();
    assert_eq!(diary.heard, ["grid 48", "stresses", "step 0.01", "stresses", "step 0.02"]);
    let iterations: usize = outcome.steps.iter().map(|step| step.iterations).sum();
    assert_eq!(diary.iterations, iterations);
    assert!(outcome.converged() && outcome.end.is_none() && outcome.change.is_none());
    assert_eq!(outcome.last.unwrap().load, Load::MeanPressure(0.02));
}

#[test]
fn a_recorder_that_cannot_go_on_ends_the_run() {
    let mut diary = Diary { fails: Some(2), ..Diary::default() };
    let error = run(Sampling::Points([48, 48])).solve(&mut diary).unwrap_err();
    assert!(matches!(&error, RunError::Recorder(Full)), "{error}");
    assert_eq!(diary.heard, ["grid 48", "step 0.01"]);
}

/// Whichever method iterates, no further iteration is made, and what stands there is a consistent state.
#[test]
fn an_iteration_can_be_the_last() {
    for method in [Method::Preconditioned, Method::PolonskyKeer] {
        let settings = Settings { method, ..Settings::default() };
        let run = Run { settings, ..run(Sampling::Points([48, 48])) };
        let mut diary = Diary { most: Some(2), ..Diary::default() };
        assert!(matches!(run.solve(&mut diary), Err(RunError::Recorder(Full))));
        assert_eq!((diary.heard, diary.iterations), (vec!["grid 48".to_owned()], 3));

        let mut solver = Solver::new(problem(), [48, 48], settings).unwrap();
        let step = solver.solve_with_progress(Load::MeanPressure(0.01), &mut |_| ControlFlow::Break(()));
        assert_eq!((step.report.stop, step.report.iterations), (Stop::Interrupted, 1));
        let mean = step.pressure().mean().unwrap();
        assert!((mean - 0.01).abs() < 1e-15 && (step.reading().mean_pressure.unwrap() - 0.01).abs() < 1e-15);
        // The next step does not begin with it.
        let next = solver.solve(Load::MeanPressure(0.01));
        let fresh = Solver::new(problem(), [48, 48], settings).unwrap().solve(Load::MeanPressure(0.01));
        assert_eq!(next.pressure(), fresh.pressure());
        assert_eq!(next.report.stop, Stop::Converged);
    }
}

/// Every grid holds all loads; the change is that of the last two.
#[test]
fn a_refinement_goes_on_until_the_accuracy_is_reached_or_there_is_no_room() {
    let mut diary = Diary::default();
    let outcome = run(Sampling::Accuracy(1e-4)).solve(&mut diary).unwrap();
    let grids: Vec<&String> = diary.heard.iter().filter(|heard| heard.starts_with("grid")).collect();
    assert!(grids.len() > 2, "{:?}", diary.heard);
    assert_eq!((outcome.end, outcome.is_accurate()), (Some(RefinementEnd::Reached), true));
    assert!(outcome.change.unwrap() < 1e-4);
    let on = |points| run(Sampling::Points(points)).solve(&mut ()).unwrap().steps;
    let [n1, n2] = outcome.points;
    let again = change(&on([n1 / 2, n2 / 2]), &on([n1, n2]));
    assert_eq!(outcome.change, Some(again));

    let first = diary.heard[0].trim_start_matches("grid ").parse::<usize>().unwrap();
    let narrow = run(Sampling::Accuracy(1e-4)).solve(&mut Diary { room: 2 * first, ..Diary::default() }).unwrap();
    assert_eq!((narrow.end, narrow.points[0], narrow.converged()), (Some(RefinementEnd::Room), 2 * first, false));
    assert!(narrow.warnings.iter().any(|warning| warning.contains("accuracy")), "{:?}", narrow.warnings);
}

/// A reading that is NaN agrees with none.
#[test]
fn a_number_that_is_none_counts_as_a_change() {
    let steps = run(Sampling::Points([48, 48])).solve(&mut ()).unwrap().steps;
    assert_eq!(change(&steps, &steps), 0.0);
    let mut spoilt = steps.clone();
    spoilt[0].reading.max_pressure = f64::NAN;
    assert!(change(&steps, &spoilt).is_nan() && change(&spoilt, &steps).is_nan());
}

/// Stresses that are NaN agree with none either; under a tip they are infinite, which is no fault.
#[test]
fn stresses_that_are_no_number_are_neither_agreement_nor_converged() {
    let stressed = Run { stress: Some(StressRequest::default()), ..run(Sampling::Points([48, 48])) };
    let steps = stressed.solve(&mut ()).unwrap().steps;
    let with = |value: f64| {
        let mut stress = steps[0].stress.clone().unwrap();
        stress.overall.tau1.value = value;
        vec![steps[0].clone().with_stress(stress, stressed.problem.bodies())]
    };
    assert_eq!(change(&steps, &steps), 0.0);
    assert_eq!(change(&with(f64::INFINITY), &with(f64::INFINITY)), 0.0);
    assert!(with(f64::INFINITY)[0].converged());
    assert!(change(&steps, &with(f64::NAN)).is_nan() && change(&with(f64::NAN), &steps).is_nan());
    assert!(!with(f64::NAN)[0].converged());
    assert_eq!(with(f64::NAN)[0].stop, Stop::NotANumber);
}

#[test]
fn a_run_without_loads_is_refused() {
    for sampling in [Sampling::Points([48, 48]), Sampling::Accuracy(0.01)] {
        let mut diary = Diary::default();
        let error = Run { loads: vec![], ..run(sampling) }.solve(&mut diary).unwrap_err();
        assert!(matches!(error, RunError::NoLoads) && diary.heard.is_empty(), "{error}");
    }
}

/// Contact that one grid has and the other has not is no agreement either.
#[test]
fn contact_that_comes_or_goes_with_the_grid_counts_as_a_change() {
    let unloaded = Run { loads: vec![Load::MeanPressure(0.0)], ..run(Sampling::Points([48, 48])) };
    let apart = unloaded.solve(&mut ()).unwrap().steps;
    let touching = run(Sampling::Points([48, 48])).solve(&mut ()).unwrap().steps;
    assert_eq!(change(&apart, &apart), 0.0);
    assert_eq!(change(&touching, &apart), f64::INFINITY);
    assert!(change(&apart, &touching) >= 1.0);
}

/// Nothing is begun of it.
#[test]
fn a_cell_too_oblong_for_any_grid_is_refused_by_check_and_by_solve() {
    let substrate = common::bare();
    let lattice = Lattice::new(Cell::new([1000.0, 0.0], [0.0, 1.0]).unwrap(), vec![vec![[0.0, 0.0]]]).unwrap();
    let problem = Problem::new(one_level(lattice, paraboloid(0.8, 0.0)), substrate);
    let oblong = Run::new(problem, vec![Load::MeanPressure(0.01)], Sampling::Accuracy(1e-3));
    assert!(matches!(oblong.check(), Err(RunError::TooOblong(_))));
    let mut diary = Diary::default();
    assert!(matches!(oblong.solve(&mut diary), Err(RunError::TooOblong(_))));
    assert!(diary.heard.is_empty());
    assert!(Run { sampling: Sampling::Points([1024, 16]), ..oblong }.check().is_ok());
}

/// Refused before anything is solved, on the grid of the run.
#[test]
fn a_penetration_beyond_complete_contact_is_refused() {
    let problem = PAPER[0].problem();
    let mut solver = Solver::new(problem.clone(), [48, 48], percoat::Settings::default()).unwrap();
    let complete = solver.full_contact_penetration();
    let run = |part: f64| {
        let loads = vec![Load::Penetration(0.1 * complete), Load::Penetration(part * complete)];
        Run::new(problem.clone(), loads, Sampling::Points([48, 48])).check()
    };
    assert!(run(0.99).is_ok());
    assert!(matches!(run(1.01), Err(RunError::BeyondFullContact(_))));
}

/// A clock that goes on by a second whenever somebody looks.
#[derive(Default)]
struct Ticking(std::cell::Cell<f64>);

impl Recorder for Ticking {
    type Error = Infallible;

    fn clock(&self) -> Option<f64> {
        self.0.set(self.0.get() + 1.0);
        Some(self.0.get())
    }
}

#[test]
fn how_long_a_step_takes_is_told_by_the_recorder_s_clock() {
    let seconds = |outcome: Outcome| outcome.steps.iter().map(|step| step.seconds).collect::<Vec<_>>();
    let run = run(Sampling::Points([48, 48]));
    assert_eq!(seconds(run.solve(&mut Ticking::default()).unwrap()), [Some(1.0); 2]);
    assert_eq!(seconds(run.solve(&mut ()).unwrap()), [None; 2], "without a clock");
}

/// Ends a run at this call during the search for the largest stresses.
struct Impatient {
    calls: std::cell::Cell<usize>,
    last: usize,
}

impl Recorder for Impatient {
    type Error = Full;

    fn searching(&self) -> Result<(), Full> {
        self.calls.set(self.calls.get() + 1);
        assert!(self.calls.get() <= self.last, "the search goes on after its end");
        if self.calls.get() == self.last { Err(Full) } else { Ok(()) }
    }
}

#[test]
fn a_recorder_ends_the_search_for_the_largest_stresses() {
    let run = Run { stress: Some(StressRequest::default()), ..run(Sampling::Points([64, 64])) };
    let count = |last: usize| {
        let mut recorder = Impatient { calls: 0.into(), last };
        let ended = run.solve(&mut recorder);
        (ended.is_err(), recorder.calls.get())
    };
    let (is_err, whole) = count(usize::MAX);
    // Planes, climbs, and the contenders on the coarser grid.
    assert!(!is_err && whole > 40, "{whole} calls in two steps");
    for last in [1, 15, whole / 2, whole] {
        assert_eq!(count(last), (true, last));
    }
}

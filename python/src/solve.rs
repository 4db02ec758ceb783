//! `percoat.solve`: every load step of a case, kept in memory.

use crate::case::Case;
use crate::errors::refused;
use crate::progress::Progress as Told;
use crate::record::{from_python, to_python};
use crate::step::{Kept, Step};
use crate::work::{self, Listener};
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use percoat::Progress;
use percoat::case::resources::{Job, needs};
use percoat::case::{self, plausibility};
use percoat::machine::Capacity;
use percoat::output::{Clock, Phase, Summary, table};
use percoat::run::{Recorder, StepRecord};
use percoat::spectral::Checkpoint;
use percoat::{Load, Solver, StressField, Surface};
use pyo3::prelude::*;
use std::sync::Arc;

/// Nobody waits for the run any more.
#[derive(Debug)]
pub struct Stopped;

impl std::fmt::Display for Stopped {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("stopped before its end")
    }
}

impl std::error::Error for Stopped {}

/// Keeps every step of a run, and tells how far it is.
pub struct Keeping<'a> {
    pub case: &'a Arc<case::Case>,
    pub job: Job,
    pub room: Capacity,
    pub listener: &'a mut Listener,
    pub clock: Clock,
    /// What the steps are called, and how many there are, if that is known.
    pub unit: &'static str,
    pub of: usize,
    pub points: [usize; 2],
    pub done: usize,
    pub surface: Option<Arc<Surface>>,
    /// Whether steps are kept with their fields.
    pub keeps: bool,
    pub checkpoint: Option<Checkpoint>,
    pub steps: Vec<Kept>,
}

impl Keeping<'_> {
    fn tell(&mut self, new: bool, phase: impl FnOnce() -> String, iterated: Option<Progress>) {
        let Self { unit, done, of, points: [n1, n2], .. } = *self;
        let (iteration, residual) = iterated.map_or((0, f64::NAN), |own| (own.iteration, own.residual));
        self.listener.tell(new, |seconds| Told {
            unit,
            done,
            of,
            points: Some((n1, n2)),
            iteration,
            residual,
            phase: phase(),
            seconds,
        });
    }
}

impl Recorder for Keeping<'_> {
    type Error = Stopped;

    fn fits(&self, points: [usize; 2]) -> bool {
        needs(self.case, points, self.job).fit(self.room)
    }

    fn begin(&mut self, solver: &Solver) -> Result<(), Stopped> {
        // Steps on a coarser grid have done their service.
        self.steps.clear();
        (self.done, self.points) = (0, solver.grid().points());
        self.surface = Some(Arc::clone(solver.surface()));
        self.tell(true, || "begins".to_owned(), None);
        self.searching()
    }

    fn clock(&self) -> Option<f64> {
        Some(self.clock.seconds())
    }

    fn load(&mut self, _load: Load) {
        self.clock.turn(Phase::Solve);
    }

    fn iteration(&mut self, progress: Progress) -> Result<(), Stopped> {
        let phase = || format!("iteration {}, ε = {:.1e}", progress.iteration, progress.residual);
        self.tell(false, phase, Some(progress));
        self.searching()
    }

    fn solved(&mut self, checkpoint: &Checkpoint) -> Result<(), Stopped> {
        self.checkpoint = self.keeps.then(|| checkpoint.clone());
        self.searching()
    }

    fn stresses(&mut self) {
        self.clock.turn(Phase::Stress);
        self.tell(true, || "stresses".to_owned(), None);
    }

    fn searching(&self) -> Result<(), Stopped> {
        if self.listener.stops() { Err(Stopped) } else { Ok(()) }
    }

    fn step(&mut self, step: &percoat::Step, record: &StepRecord, _field: Option<&StressField>) -> Result<(), Stopped> {
        if let Some(checkpoint) = self.checkpoint.take() {
            self.steps.push(Kept { case: Arc::clone(self.case), step: step.clone(), checkpoint });
        }
        self.done += 1;
        self.clock.turn(Phase::Setup);
        let pressure = record.reading.mean_pressure;
        self.tell(true, || format!("after mean pressure {}", percoat::output::number(pressure)), None);
        self.searching()
    }
}

/// Fields of a surface: x, y, and the level that owns each sample.
type Places<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>);

/// Solves a case: its summary as a dict, whether the accuracy is reached if one was prescribed, the places of its samples, and
/// its steps.
#[pyfunction]
#[pyo3(signature = (case, threads = None, progress = None))]
pub fn solve<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, bool, Places<'py>, Vec<Step>)> {
    let room = case.get().allow(Job::Keep)?;
    let own = Arc::clone(&case.get().own);
    let solved = work::run(py, threads, progress, move |listener| {
        let run = own.run();
        run.check().map_err(|error| error.told())?;
        let mut keeping = Keeping {
            case: &own,
            job: Job::Keep,
            room,
            listener,
            clock: Clock::start(),
            unit: "step",
            of: run.loads.len(),
            points: [0; 2],
            done: 0,
            surface: None,
            keeps: true,
            checkpoint: None,
            steps: Vec::new(),
        };
        let outcome = run.solve(&mut keeping).map_err(|error| error.told())?;
        let warnings = [outcome.warnings.clone(), plausibility::of_case(&own)].concat();
        let summary = Summary::new(&own, &warnings, outcome.change, &outcome.steps, keeping.clock.timing());
        let surface = keeping.surface.take().expect("a run begins a grid before its steps");
        Ok::<_, String>((summary, outcome.is_accurate(), places(&surface), keeping.steps))
    })?;
    let (summary, accurate, (x, y, owner), kept) = solved.map_err(refused)?;
    let places = (x.into_pyarray(py), y.into_pyarray(py), owner.into_pyarray(py));
    Ok((to_python(py, &summary)?, accurate, places, kept.into_iter().map(Step::from).collect()))
}

fn places(surface: &Surface) -> (Array2<f64>, Array2<f64>, Array2<i32>) {
    let grid = surface.grid();
    let points = grid.points();
    let [x, y] = [0, 1].map(|axis| {
        let values = (0..grid.len()).map(|i| grid.cell().point(grid.fractions(i))[axis]).collect();
        Array2::from_shape_vec(points, values).expect("a value a sample")
    });
    let level = |site: &u32| surface.sites()[*site as usize].level as i32;
    (x, y, surface.owner().map_or(Array2::zeros(points), |owner| owner.map(level)))
}

/// The table of a run that the command line prints, of its summary.
#[pyfunction]
pub fn outcome_text(case: &Bound<'_, Case>, summary: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let summary: Summary = from_python(summary)?;
    Ok(table::outcome(&case.get().own, &summary.steps, summary.accuracy, width))
}

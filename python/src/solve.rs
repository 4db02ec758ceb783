//! `percoat.solve`: every load step of a case, in memory.

use crate::case::Case;
use crate::progress::Progress as Told;
use crate::record::{from_python, to_python};
use crate::step::{Kept, Step};
use crate::work::{self, Listener, Stopped};
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use percoat::Progress;
use percoat::case;
use percoat::output::{Clock, Phase, Summary, number, table};
use percoat::run::{GridStart, Recorder, StepRecord};
use percoat::spectral::Checkpoint;
use percoat::task::{Solve, Solved};
use percoat::{Load, StressFields, Surface};
use pyo3::prelude::*;
use std::sync::Arc;

/// The recorder of a task that reports its progress and, for `percoat.solve`, keeps every step.
pub struct Keeping<'a> {
    case: &'a Arc<case::Case>,
    /// Whether steps are kept with their fields.
    keeps: bool,
    listener: &'a mut Listener,
    clock: Clock,
    /// Name of a step in the progress, and the number of all, 0 where it is not known.
    unit: &'static str,
    of: usize,
    points: [usize; 2],
    done: usize,
    surface: Option<Arc<Surface>>,
    checkpoint: Option<Checkpoint>,
    steps: Vec<Kept>,
}

impl<'a> Keeping<'a> {
    /// The recorder of a task that has not begun, and whether it keeps the steps with their fields.
    pub fn new(
        case: &'a Arc<case::Case>,
        keeps: bool,
        listener: &'a mut Listener,
        (unit, of): (&'static str, usize),
    ) -> Self {
        let (clock, points, done, surface, checkpoint, steps) = (Clock::start(), [0; 2], 0, None, None, Vec::new());
        Self { case, keeps, listener, clock, unit, of, points, done, surface, checkpoint, steps }
    }

    fn tell(&mut self, new: bool, phase: impl FnOnce() -> String, iterated: Option<Progress>) {
        let Self { unit, done, of, points: [n1, n2], .. } = *self;
        let (iteration, residual) = iterated.map_or((0, f64::NAN), |progress| (progress.iteration, progress.residual));
        let points = Some((n1, n2));
        self.listener.tell(new, || Told { done, of, points, iteration, residual, ..Told::new(unit, phase()) });
    }
}

impl Recorder for Keeping<'_> {
    type Error = Stopped;

    fn begin(&mut self, start: &GridStart) -> Result<(), Stopped> {
        // Steps on a coarser grid are not part of the result.
        self.steps.clear();
        (self.done, self.points) = (0, start.grid().points());
        self.surface = Some(Arc::clone(start.surface()));
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

    fn stresses(&mut self, _step: &percoat::Step, _record: &StepRecord) {
        self.clock.turn(Phase::Stress);
        self.tell(true, || "stresses".to_owned(), None);
    }

    fn searching(&self) -> Result<(), Stopped> {
        self.listener.check()
    }

    fn step(
        &mut self,
        step: &percoat::Step,
        record: &StepRecord,
        _fields: Option<&StressFields>,
    ) -> Result<(), Stopped> {
        if self.keeps {
            let checkpoint = self.checkpoint.take();
            self.steps.push(Kept { case: Arc::clone(self.case), step: step.clone(), checkpoint });
        }
        self.done += 1;
        self.clock.turn(Phase::Setup);
        let quantity = self.case.units().quantity();
        let load = number(record.reading.load(quantity));
        self.tell(true, || format!("after {} {load}", quantity.name()), None);
        self.searching()
    }
}

/// Fields (n₁, n₂) of a surface: x and y, and the level whose indenter faces the sample, from 1; 0 for a topography.
type Places<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<i32>>);

/// Solves a case: its summary as a dict, whether the accuracy of the case is reached, if it has one, the places of its samples,
/// and its steps.
#[pyfunction]
#[pyo3(signature = (case, threads = None, progress = None))]
pub fn solve<'py>(
    py: Python<'py>,
    case: &Bound<'py, Case>,
    threads: Option<i64>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, bool, Places<'py>, Vec<Step>)> {
    let case = Arc::clone(&case.get().case);
    let (summary, accurate, (x, y, owner), kept) = work::try_run(py, threads, progress, move |listener| {
        let task = Solve::in_memory(&case, work::room())?;
        let mut keeping = Keeping::new(&case, true, listener, ("step", task.run.loads.len()));
        let Solved { outcome, warnings } = task.solve(&mut keeping).map_err(|error| error.told())?;
        let summary = Summary::new(&case, &warnings, outcome.change, &outcome.steps, keeping.clock.timing());
        let surface = keeping.surface.take().expect("a run begins a grid before its steps");
        Ok((summary, outcome.is_accurate(), places(&surface), keeping.steps))
    })?;
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

/// The table that the command line prints of a run with this summary, in lines of `width` letters.
#[pyfunction]
pub fn outcome_text(case: &Bound<'_, Case>, summary: &Bound<'_, PyAny>, width: usize) -> PyResult<String> {
    let summary: Summary = from_python(summary)?;
    Ok(table::outcome(&case.get().case, &summary.steps, summary.accuracy, width))
}

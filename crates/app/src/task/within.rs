//! A recorder in the memory and disk of a machine.

use percoat_case::case::feasibility::Allowed;
use percoat_core::load::Load;
use percoat_core::run::{EarlierRun, GridStart, Recorder, StepRecord};
use percoat_core::spectral::{Checkpoint, Progress, Step};
use percoat_core::stress::StressFields;

/// A recorder under which a refinement ends before a grid for which memory or disk do not suffice.
pub(super) struct Within<'a, R> {
    pub(super) allowed: Allowed<'a>,
    pub(super) recorder: &'a mut R,
}

impl<R: Recorder> Recorder for Within<'_, R> {
    type Error = R::Error;

    fn fits(&self, points: [usize; 2]) -> bool {
        self.allowed.fits(points) && self.recorder.fits(points)
    }

    fn finished(&mut self) -> Option<EarlierRun> {
        self.recorder.finished()
    }

    fn begin(&mut self, start: &GridStart) -> Result<(), R::Error> {
        self.recorder.begin(start)
    }

    fn load(&mut self, load: Load) {
        self.recorder.load(load);
    }

    fn clock(&self) -> Option<f64> {
        self.recorder.clock()
    }

    fn iteration(&mut self, progress: Progress) -> Result<(), R::Error> {
        self.recorder.iteration(progress)
    }

    fn solved(&mut self, checkpoint: &Checkpoint) -> Result<(), R::Error> {
        self.recorder.solved(checkpoint)
    }

    fn stresses(&mut self, step: &Step, record: &StepRecord) {
        self.recorder.stresses(step, record);
    }

    fn searching(&self) -> Result<(), R::Error> {
        self.recorder.searching()
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), R::Error> {
        self.recorder.step(step, record, fields)
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        self.recorder.refined(points, change);
    }
}

//! The recorder of a run that writes files and shows the progress.

use super::interruption::{self, Saved};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal;
use percoat_app::output::{Clock, OutputError, Recording};
use percoat_core::run::{EarlierRun, GridStart, Recorder, Run, StepRecord};
use percoat_core::spectral::Checkpoint;
use percoat_core::{Load, Step, StressFields, VerticalSection};

/// Records a run and shows its progress.
pub struct ProgressRecorder<'a> {
    recording: Recording<'a>,
    results: &'a Results,
    /// Number of all load steps.
    steps: usize,
    progress: Progress,
}

impl<'a> ProgressRecorder<'a> {
    /// Recorder of a run with its recording and the claimed folder.
    pub fn new(recording: Recording<'a>, results: &'a Results, run: &Run, common: &Common) -> Self {
        let steps = run.loads.len();
        Self { recording, results, steps, progress: Progress::new("step", steps, 0, common) }
    }

    /// Finishes the recording, as [`Recording::finish`].
    pub fn finish(self) -> Result<(Vec<VerticalSection>, Clock), OutputError> {
        self.progress.say("writing fields");
        let finished = self.recording.finish();
        self.progress.finish();
        finished
    }

    /// The steps on disk, which the handler of signals prints.
    fn saved(&self) -> Saved {
        Saved::Steps { done: self.recording.steps(), of: self.steps, folder: self.results.staging() }
    }
}

impl Recorder for ProgressRecorder<'_> {
    type Error = OutputError;

    fn finished(&mut self) -> Option<EarlierRun> {
        self.recording.finished()
    }

    fn solved(&mut self, checkpoint: &Checkpoint) -> Result<(), OutputError> {
        self.recording.solved(checkpoint)
    }

    fn begin(&mut self, start: &GridStart) -> Result<(), OutputError> {
        self.progress.tell(format_args!("{}\n{start}", start.problem()));
        // The handler of signals waits until the steps of a coarser grid have moved aside.
        let mut saved = interruption::hold();
        self.recording.begin(start)?;
        *saved = self.saved();
        drop(saved);
        terminal::tell_aside(self.recording.set_aside(), self.results.saying.quiet);
        self.progress.grid(start.grid().points(), self.recording.steps());
        Ok(())
    }

    fn iteration(&mut self, progress: percoat_core::spectral::Progress) -> Result<(), OutputError> {
        self.progress.say(format!("iteration {}, ε = {:.1e}", progress.iteration, progress.residual));
        Ok(())
    }

    fn load(&mut self, load: Load) {
        self.recording.load(load);
    }

    fn clock(&self) -> Option<f64> {
        self.recording.clock()
    }

    fn stresses(&mut self, step: &Step, record: &StepRecord) {
        self.recording.stresses(step, record);
        self.progress.say("stresses");
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), OutputError> {
        self.progress.tell(format_args!("{}\n{}\n{}", record.reading, record.report(), record.certificate));
        self.recording.step(step, record, fields)?;
        *interruption::hold() = self.saved();
        self.progress.advance();
        Ok(())
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        self.recording.refined(points, change);
        self.progress.tell(format_args!("{points:?} points: change {change:.2e}"));
    }
}

//! A run that can be killed after any call of its recorder.

use percoat::case::{Case, Source};
use percoat::output::{self, Clock, OutputError, Recording, RunFolder, solved_plan, write_scalars};
use percoat::run::{EarlierRun, GridStart, Outcome, Recorder, RunError, StepRecord};
use percoat::spectral::Checkpoint;
use percoat::{Step, StressFields};
use std::fmt;
use std::path::Path;

/// The largest grid that there is room for.
const ROOM: usize = 192;

/// Records a run until it is killed, after so many more calls that leave something on disk.
struct Mortal<'a> {
    recording: Recording<'a>,
    calls: usize,
}

#[derive(Debug)]
enum Death {
    Killed,
    Output(OutputError),
}

impl fmt::Display for Death {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Killed => f.write_str("killed"),
            Self::Output(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Death {}

impl Mortal<'_> {
    fn lives(&mut self, done: Result<(), OutputError>) -> Result<(), Death> {
        done.map_err(Death::Output)?;
        self.calls = self.calls.checked_sub(1).ok_or(Death::Killed)?;
        Ok(())
    }
}

impl Recorder for Mortal<'_> {
    type Error = Death;

    fn finished(&mut self) -> Option<EarlierRun> {
        self.recording.finished()
    }

    fn clock(&self) -> Option<f64> {
        self.recording.clock()
    }

    fn fits(&self, points: [usize; 2]) -> bool {
        points[0] <= ROOM
    }

    fn begin(&mut self, solver: &GridStart) -> Result<(), Death> {
        let done = self.recording.begin(solver);
        self.lives(done)
    }

    fn solved(&mut self, checkpoint: &Checkpoint) -> Result<(), Death> {
        let done = self.recording.solved(checkpoint);
        self.lives(done)
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), Death> {
        let done = self.recording.step(step, record, fields);
        self.lives(done)
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        self.recording.refined(points, change);
    }
}

pub fn case(text: &str) -> Case {
    Case::read(&Source { name: "resumed".to_owned(), text: text.to_owned(), ..Source::default() }, &[]).unwrap()
}

/// A run into a folder, as `percoat solve` does it, going on with what stands there, killed after so many calls; `None` if it was. Else whether it went
/// on, and what it has found.
pub fn run(case: &Case, folder: &Path, fields: bool, calls: usize) -> Option<(bool, Outcome)> {
    let run = case.run();
    let mut plan = solved_plan(case, run.loads.len(), fields);
    plan.resumes = true;
    let claim = RunFolder::claim(folder, plan).unwrap();
    let fingerprint = output::fingerprint(case, if fields { "fields" } else { "scalars" });
    let earlier = if claim.resumes() { output::finished(&claim.staging(), &fingerprint, &run).unwrap() } else { None };
    let went_on = earlier.is_some();
    let recording = Recording::new(&claim, &run, case.to_toml(), Clock::start()).resumable(fingerprint, earlier);
    let recording = if fields { recording } else { recording.without_fields() };
    let mut mortal = Mortal { recording, calls };
    let outcome = match run.solve(&mut mortal) {
        Ok(outcome) => outcome,
        Err(RunError::Recorder(Death::Killed)) => return None,
        Err(error) => panic!("{error:?}"),
    };
    let left = mortal.calls;
    let (_, mut clock) = mortal.recording.finish().unwrap();
    // Killed after fields are gathered.
    if left == 0 {
        return None;
    }
    write_scalars(&claim.staging(), case, &outcome, &outcome.warnings, clock.timing()).unwrap();
    claim.publish().unwrap();
    Some((went_on, outcome))
}

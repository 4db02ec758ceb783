//! Runs that a power cut ends at any moment.

use super::image::{Image, laid};
use super::journal::Journal;
use crate::output::layout::names;
use crate::output::{
    Clock, OutputError, Plan, Recording, RunFolder, disk, fingerprint, finished, solved_plan, whole_lines,
    write_scalars,
};
use percoat_case::case::{Case, Source};
use percoat_core::run::{EarlierRun, GridStart, Recorder, StepRecord};
use percoat_core::spectral::{Checkpoint, Step};
use percoat_core::stress::StressFields;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::{Arc, Mutex};

const SPHERES: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "sphere", radius = 0.8 }]
substrate = { young = 1.0, poisson = 0.3 }
"#;
/// Three loads with volumes of stresses.
const PLAIN: &str = r#"
load = { mean_pressure = [0.01, 0.03, 0.02] }
grid = { points = 16 }
stress = { volume = { depth = 0.2, rows = 2, points = 2 } }
"#;
/// Two loads on grids that are refined.
const REFINED: &str = r#"
load = { mean_pressure = [0.01, 0.03] }
grid = { accuracy = 1e-9 }
"#;
/// The largest grid that there is room for.
const ROOM: usize = 192;

/// Records a run; after each step, how many images its journal has.
struct Watched<'a> {
    recording: Recording<'a>,
    journal: Option<&'a Mutex<Journal>>,
    steps: Vec<usize>,
}

impl Recorder for Watched<'_> {
    type Error = OutputError;

    fn finished(&mut self) -> Option<EarlierRun> {
        self.recording.finished()
    }

    fn clock(&self) -> Option<f64> {
        self.recording.clock()
    }

    fn fits(&self, points: [usize; 2]) -> bool {
        points[0] <= ROOM
    }

    fn begin(&mut self, start: &GridStart) -> Result<(), OutputError> {
        self.recording.begin(start)
    }

    fn solved(&mut self, checkpoint: &Checkpoint) -> Result<(), OutputError> {
        self.recording.solved(checkpoint)
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), OutputError> {
        self.recording.step(step, record, fields)?;
        self.steps.extend(self.journal.map(|journal| journal.lock().unwrap().images.len()));
        Ok(())
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        self.recording.refined(points, change);
    }
}

/// Solves a case into a folder, resuming an interrupted run there. Returns the number of images of the journal after each step.
fn solve(case: &Case, folder: &Path, journal: Option<&Mutex<Journal>>) -> Vec<usize> {
    let run = case.run();
    let plan = solved_plan(case, run.loads.len(), true);
    let claim = RunFolder::claim(folder, Plan { resumes: true, ..plan }).unwrap();
    let print = fingerprint(case, "test");
    let staging = claim.staging();
    let earlier = if claim.resumes() { finished(&staging, &print, &run).unwrap() } else { None };
    let recording = Recording::new(&claim, &run, case.to_toml(), Clock::start()).resumable(print, earlier);
    let mut watched = Watched { recording, journal, steps: Vec::new() };
    let outcome = run.solve(&mut watched).unwrap();
    let Watched { recording, steps, .. } = watched;
    let (_, mut clock) = recording.finish().unwrap();
    write_scalars(&claim.staging(), case, &outcome, &outcome.warnings, clock.timing()).unwrap();
    claim.publish().unwrap();
    steps
}

/// Files of fields, which no two runs may have different.
fn fields(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let names = names(folder).unwrap().into_iter().filter(|name| name.ends_with(".npz") || name.ends_with(".vts"));
    names.map(|name| (name.clone(), fs::read(folder.join(name)).unwrap())).collect()
}

/// States that a power cut may leave of a run, and the number of states when each step was finished.
fn cut(case: &Case) -> (BTreeMap<String, Vec<u8>>, Vec<Image>, Vec<usize>) {
    let place = tempfile::tempdir().unwrap();
    let journal: Arc<Mutex<Journal>> = Journal::begin(place.path());
    let steps = solve(case, place.path(), Some(&journal));
    Journal::end(&journal);
    let images = std::mem::take(&mut journal.lock().unwrap().images);
    (fields(place.path()), images, steps)
}

/// Spheres under loads, which stand in `task` with their grid.
fn case(task: &str) -> Case {
    Case::read(&Source { name: "cut".to_owned(), text: [SPHERES, task].concat(), ..Source::default() }, &[]).unwrap()
}

#[test]
fn a_run_that_a_power_cut_ends_at_any_moment_goes_on_and_ends_as_if_it_had_not_been() {
    let case = case(PLAIN);
    let (whole, images, steps) = cut(&case);
    assert!(whole.len() == 5 && images.len() > 150, "{:?}, {} images", whole.keys(), images.len());
    // Two or three images of every moment.
    for (index, image) in images.iter().enumerate().step_by(3) {
        let place = laid(image);
        let staging = place.path().join("unfinished");
        // A step that was reported as finished is in the log.
        let told = steps.iter().filter(|images| **images <= index).count();
        let logged = whole_lines(&staging.join("steps.jsonl")).map_or(0, |lines| lines.len());
        let is_decided = disk::is_file(&staging.join(".publish.json")) || !disk::is_folder(&staging) && told > 0;
        assert!(logged >= told || is_decided, "{logged} of {told} steps in image {index}: {:#?}", image.keys());
        solve(&case, place.path(), None);
        assert!(fields(place.path()) == whole, "image {index}: {:#?}", image.keys());
    }
}

/// Power cuts from the last step on the first grid to the first one on the second, and at some moments after that.
#[test]
fn so_does_a_refinement_when_its_finer_grid_begins() {
    let case = case(REFINED);
    let (whole, images, steps) = cut(&case);
    assert_eq!(steps.len(), 4, "two loads on two grids");
    let moments = (steps[1] - 1..=steps[2]).step_by(3).chain((steps[2]..images.len()).step_by(29));
    for index in moments {
        let (image, place) = (&images[index], laid(&images[index]));
        solve(&case, place.path(), None);
        assert!(fields(place.path()) == whole, "image {index}: {:#?}", image.keys());
    }
}

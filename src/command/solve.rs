//! `percoat solve`: every load step of a case, the table and the output folder.

use super::interruption::{self, Saved};
use super::pictures::PictureOptions;
use super::plan::plan;
use super::terminal::{self, tell};
use super::{Common, Failure, Outcome, read_case};
use indicatif::{ProgressBar, ProgressStyle};
use percoat::case::resources::{Job, fits, refusal};
use percoat::case::{Case, Room, plausibility};
use percoat::output::summary::{Summary, curve};
use percoat::output::{Fields, OutputError, RunFolder, StepsLog, Stresses, table, write_text};
use percoat::picture::Snapshot;
use percoat::run::{Places, Recorder, StepRecord, StressRequest};
use percoat::{Progress, Section, Solver, Step, StressField, Surface};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

pub fn run(case: Option<&Path>, pictures: &PictureOptions, common: &Common) -> Result<Outcome, Failure> {
    let (case, name) = read_case(case, common)?;
    let folder = common.output.clone().unwrap_or_else(|| Path::new("out").join(&name));
    let started = Instant::now();
    let run = case.run();
    let job = Job::Solve { pictures: pictures.wanted() };
    let room = room_or_refusal(&case, &folder, job)?;
    run.check()?;
    interruption::watch();
    let claim = RunFolder::claim(&folder, &plan(&case, run.loads.len(), pictures))?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let mut recording = Recording::new(&case, &claim, run.stress.as_ref(), common);
    let outcome = run.solve(&mut recording, &|finer| fits(&case, finer, room, job))?;
    let section = recording.gather()?;
    let converged = outcome.converged();
    let warnings = [outcome.warnings, plausibility::of_case(&case)].concat();
    let steps = &outcome.steps;
    if let (Some(last), Some(record), true) = (outcome.last, steps.last(), pictures.wanted()) {
        let snapshot = Snapshot::new(&case.title, last, record.reading.clone());
        let spinner = spinner("drawing pictures", common);
        pictures.draw(&claim.staging(), &snapshot, section.as_ref(), steps)?;
        spinner.finish_and_clear();
    }
    let (percoat, title) = (env!("CARGO_PKG_VERSION"), &case.title[..]);
    let summary =
        Summary { percoat, title, case: &case, complete: true, warnings: &warnings, accuracy: outcome.change, steps };
    write_text(&claim.staging().join("summary.json"), &summary.to_json())?;
    write_text(&claim.staging().join("curve.csv"), &curve(steps))?;
    publish(claim, &folder, common)?;
    if !common.quiet {
        print(&case.title, steps, outcome.change)?;
        writeln!(std::io::stdout(), "{:.2} s; written to {}", started.elapsed().as_secs_f64(), folder.display())?;
        for warning in &warnings {
            tell!("warning: {warning}");
        }
    }
    Ok(if converged { Outcome::Done } else { Outcome::NotConverged })
}

/// What a run leaves on disk while it goes on, and shows of itself.
struct Recording<'a> {
    case: &'a Case,
    claim: &'a RunFolder,
    places: Places,
    common: &'a Common,
    progress: ProgressBar,
    files: Option<Files>,
}

/// Files of the steps on one grid.
struct Files {
    folder: PathBuf,
    surface: Arc<Surface>,
    fields: Fields,
    stresses: Option<Stresses>,
    log: StepsLog,
    done: usize,
}

impl<'a> Recording<'a> {
    fn new(case: &'a Case, claim: &'a RunFolder, stress: Option<&StressRequest>, common: &'a Common) -> Self {
        let places = stress.map_or_else(Places::default, |request| request.places(case.half_space()));
        Self { case, claim, places, common, progress: ProgressBar::hidden(), files: None }
    }

    /// Gathers the fields of all steps; what the section shows of the last one.
    fn gather(self) -> Result<Option<Section>, Failure> {
        let Some(Files { surface, fields, stresses, .. }) = self.files else { return Ok(None) };
        self.progress.finish_and_clear();
        fields.finish(&surface)?;
        let Some(mut stresses) = stresses else { return Ok(None) };
        let section = stresses.take_section();
        stresses.finish()?;
        Ok(section)
    }

    fn progress(&self) -> ProgressBar {
        if !self.common.shows_progress() {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{bar:24} step {pos}/{len}  {msg}");
        let steps = self.case.load.values().len();
        ProgressBar::new(steps as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    }
}

impl Recorder for Recording<'_> {
    type Error = OutputError;

    fn begin(&mut self, solver: &Solver) -> Result<(), OutputError> {
        if self.common.verbose {
            tell!("{}\n{solver}", solver.problem());
        }
        self.files = None;
        let folder = self.claim.staging();
        terminal::tell_aside(self.claim.begin_finer()?.as_deref(), self.common.quiet);
        write_text(&folder.join("case.toml"), &self.case.to_toml())?;
        let stresses = self.case.stress.as_ref().map(|_| Stresses::new(&folder, self.places.clone()));
        self.files = Some(Files {
            surface: Arc::clone(solver.surface()),
            fields: Fields::new(&folder)?,
            stresses: stresses.transpose()?,
            log: StepsLog::new(&folder),
            done: 0,
            folder: folder.clone(),
        });
        interruption::steps(0, self.case.load.values().len(), &folder);
        self.progress.finish_and_clear();
        self.progress = self.progress();
        Ok(())
    }

    fn iteration(&mut self, progress: Progress) {
        self.progress.set_message(format!("iteration {}, ε = {:.1e}", progress.iteration, progress.residual));
    }

    fn stresses(&mut self) {
        self.progress.set_message("stresses");
    }

    fn step(&mut self, step: &Step, record: &StepRecord, field: Option<&StressField>) -> Result<(), OutputError> {
        if self.common.verbose {
            tell!("{}\n{}\n{}", record.reading, record.report, record.certificate);
        }
        let Some(files) = &mut self.files else { return Ok(()) };
        files.fields.add(step, record.reading.mean_pressure)?;
        if let (Some(stresses), Some(field)) = (&mut files.stresses, field) {
            stresses.add(field)?;
        }
        files.log.add(record)?;
        files.done += 1;
        interruption::steps(files.done, self.case.load.values().len(), &files.folder);
        self.progress.inc(1);
        Ok(())
    }

    fn refined(&mut self, points: [usize; 2], change: f64) {
        if self.common.verbose {
            tell!("{points:?} points: change {change:.2e}");
        }
    }
}

/// A sign of life while something without steps goes on.
fn spinner(what: &str, common: &Common) -> ProgressBar {
    if !common.shows_progress() {
        return ProgressBar::hidden();
    }
    let spinner = ProgressBar::new_spinner().with_message(what.to_owned());
    spinner.enable_steady_tick(Duration::from_millis(200));
    spinner
}

/// The result takes the place of the one before.
fn publish(claim: RunFolder, folder: &Path, common: &Common) -> Result<(), Failure> {
    let mut saved = interruption::hold();
    let aside = claim.publish()?;
    *saved = Saved::Result(folder.to_owned());
    terminal::tell_aside(aside.as_deref(), common.quiet);
    Ok(())
}

fn print(title: &str, steps: &[StepRecord], change: Option<f64>) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    if !title.is_empty() {
        writeln!(out, "{title}")?;
    }
    writeln!(out, "\n{}\n\n{}", table::steps(steps), table::solved(steps))?;
    for (number, stress) in (1..).zip(steps).filter_map(|(n, step): (usize, _)| Some((n, step.stress.as_ref()?))) {
        if steps.len() <= table::DETAILED {
            writeln!(out, "step {number}: {}", table::stress(stress))?;
        }
    }
    if let Some(errors) = table::largest_errors(steps) {
        writeln!(out, "{errors}")?;
    }
    if let Some(change) = change {
        writeln!(out, "change from the next coarser grid: {change:.1e}")?;
    }
    Ok(())
}

/// The room there is for a job that writes into `folder`; what does not find enough is refused before any is taken.
pub fn room_or_refusal(case: &Case, folder: &Path, job: Job) -> Result<Room, Failure> {
    let room = Room::on_this_machine(folder);
    refusal(case, room, job).map_or(Ok(room), |why| Err(Failure::Refused(why)))
}

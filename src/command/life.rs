//! `percoat life`: passes until damage first reaches 1, and on demand what happens to the body after that.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::options::Common;
use super::plan::plan;
use super::progress::Progress;
use super::results::Results;
use super::terminal::{self, tell};
use crate::case::feasibility::Allowed;
use crate::case::resources::Job;
use crate::case::{Case, plausibility};
use crate::life::{Beginning, LifeEnd, LifeState, LifeTask};
use crate::output::{self, LifeFile, Plan, Writer, number, table, write_damage};
use crate::picture::{self, Snapshot};
use crate::run::StepRecord;
use clap::Args;
use std::path::Path;
use std::time::Instant;

/// Name of the embedded case that is followed without CASE.
const DEFAULT: &str = "tin-fatigue";

/// Options of `percoat life` alone.
#[derive(Debug, Args)]
pub struct LifeOptions {
    /// Continue an interrupted life into the folder
    #[arg(long)]
    resume: bool,
}

pub fn run(case: Option<&Path>, set: &[String], options: &LifeOptions, common: &Common) -> Result<Ending, Failure> {
    let (started, pictures) = (Instant::now(), &common.pictures);
    let (case, name) = read_case(Some(case.unwrap_or(Path::new(DEFAULT))), set)?;
    let folder = output_folder(common, &name)?;
    let task = case.life_task().map_err(Failure::refused)?;
    Allowed::new(&case, &folder, Job::Life { pictures: pictures.wanted() }).map_err(Failure::Refused)?;
    task.check().map_err(Failure::refused)?;
    let plan = plan(Writer::Life, &["life.json", "life.csv", "damage.npz", "case.toml"], pictures, &["damage", "life"]);
    let results = Results::claim(folder, Plan { resumes: options.resume, ..plan }, common.saying())?;
    let fingerprint = output::fingerprint(&case, "life");
    let progress = Progress::new("", 0, 0, common);
    progress.tell(format_args!("{}", task.problem));
    progress.say("damage of the first pass");
    let begun = task.beginning(&|| true).map_err(Failure::refused)?;
    let state = followed(&task, &begun, &results, &fingerprint, options.resume, &progress)?;
    progress.say("drawing pictures");
    let record = StepRecord { fatigue: begun.fatigue.clone(), ..StepRecord::new(&begun.step, begun.reading.clone()) };
    let warnings = [warnings(&begun, &state), plausibility::of_case(&case)].concat();
    let file = LifeFile::new(&case, &task, (&begun, record), &state, &warnings);
    let json = file.to_json();
    results.write("life.json", &json)?;
    results.write("life.csv", &file.course())?;
    results.write("case.toml", &case.to_toml())?;
    write_damage(&results.staging(), &task, &begun)?;
    draw(&results, &case, &begun, &state, common)?;
    progress.finish();
    output::forget_state(&results.staging())?;
    let line = || format!("{} loads solved; {:.2} s", state.solved.max(1), started.elapsed().as_secs_f64());
    results.finish(|| json, || table::life(&case, &file, terminal::width()), line, &warnings)?;
    Ok(Ending::of(begun.step.report.stop.solved() && state.end != Some(LifeEnd::Unsolved)))
}

/// The last state of a life, or that after the first failure; every state is saved.
fn followed(
    task: &LifeTask,
    begun: &Beginning,
    results: &Results,
    fingerprint: &str,
    resumes: bool,
    progress: &Progress,
) -> Result<LifeState, Failure> {
    let saved = output::saved_state(&results.staging(), fingerprint).filter(|_| resumes);
    if let Some(saved) = &saved {
        tell!("note: goes on after {} passes", number(saved.passes));
    }
    let mut state = saved.unwrap_or_else(|| task.unworn(begun));
    while state.end.is_none() {
        state = task.advance(state, begun, &|| true).map_err(Failure::refused)?;
        output::save_state(&results.staging(), fingerprint, &state)?;
        let events = state.events.len();
        progress.say(format!("{} passes, {events} events, {} loads solved", number(state.passes), state.solved));
    }
    Ok(state)
}

/// Warnings about a life, a sentence each.
fn warnings(begun: &Beginning, state: &LifeState) -> Vec<String> {
    let mut warnings = Vec::new();
    if !begun.step.report.stop.solved() {
        warnings.push("the contact before the first pass has not converged: judge it by its certificate".to_owned());
    }
    if let Some(error) = begun.fatigue.as_ref().and_then(|own| own.first.error).filter(|error| *error > 0.5) {
        warnings.push(format!(
            "the passes to the first failure are known to {:.0} % only: an error of the range of the shear stress counts as often as \
             the exponent; raise grid.points",
            100.0 * error
        ));
    }
    if state.end == Some(LifeEnd::LoadLimit) {
        warnings.push("the life is followed no further: it takes too many loads".to_owned());
    }
    warnings
}

fn draw(results: &Results, case: &Case, begun: &Beginning, state: &LifeState, common: &Common) -> Result<(), Failure> {
    let (pictures, staging) = (&common.pictures, results.staging());
    if !pictures.wanted() {
        return Ok(());
    }
    if let Some(fatigue) = &begun.fatigue {
        let snapshot = Snapshot::new(&case.title, begun.step.clone(), begun.reading.clone()).with_units(case.units());
        pictures.write(&staging, "damage", || picture::damage(&snapshot, fatigue, &begun.planes))?;
    }
    pictures.write(&staging, "life", || {
        picture::course(&case.title, case.problem(), &case.units(), &state.course, &state.events)
    })
}

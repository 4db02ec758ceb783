//! `percoat life`: passes until damage first reaches 1, and on demand what happens to the body after that.

use super::declared::Declared::{self, File, Picture, Text};
use super::declared::plan;
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::interruption::{self, Saved};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::terminal::{self, tell};
use clap::Args;
use percoat_app::output::{self, CannotGoOn, OutputError, Plan, Writer, number, table, write_damage};
use percoat_app::picture::{self, Snapshot};
use percoat_app::task::{FollowError, FollowLife, Followed};
use percoat_common::machine::Capacity;
use percoat_core::life::LifeState;
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
    let task = FollowLife::new(&case, Capacity::on_this_machine(&folder), pictures.wanted())?;
    let plan = Plan { resumes: options.resume, ..plan(Writer::Life, &files(), pictures) };
    let mut results = Results::claim(folder, plan, common.saying())?;
    let fingerprint = output::fingerprint(&case, "life");
    let saved = earlier(&mut results, &fingerprint)?;
    let progress = Progress::new("", 0, 0, common);
    progress.tell(format_args!("{}", task.life.problem));
    progress.say("damage of the first pass");
    let followed = task.follow(saved, &|| true, &mut |state, _| -> Result<(), OutputError> {
        save(state, &results, &fingerprint)?;
        let events = state.events.len();
        progress.say(format!("{} passes, {events} events, {} loads solved", number(state.passes), state.solved));
        Ok(())
    });
    let followed = followed.map_err(|error| match error {
        FollowError::Recorder(error) => Failure::Output(error),
        FollowError::OtherGrid => Failure::refused(CannotGoOn::Foreign(results.staging())),
        refused => Failure::refused(refused),
    })?;
    progress.say("drawing pictures");
    results.write_all(&files(), &followed, pictures)?;
    progress.finish();
    let Followed { state, file, .. } = &followed;
    let line = || format!("{} loads solved; {:.2} s", state.solved.max(1), started.elapsed().as_secs_f64());
    results.finish("life.json", || table::life(&case, file, terminal::width()), line, &file.warnings)?;
    Ok(Ending::of(followed.converged()))
}

/// The state of an interrupted life into the folder with which this one goes on. One of another life is an error, and a damaged one is
/// moved aside.
fn earlier(results: &mut Results, fingerprint: &str) -> Result<Option<LifeState>, Failure> {
    if !results.claim.resumes() {
        return Ok(None);
    }
    match output::saved_state(&results.staging(), fingerprint) {
        Ok(saved) => {
            if let Some(saved) = saved.as_ref().filter(|_| !results.saying.quiet) {
                tell!("note: goes on after {} passes", number(saved.passes));
            }
            Ok(saved)
        }
        Err(foreign @ CannotGoOn::Foreign(_)) => Err(Failure::refused(foreign)),
        Err(damaged) => {
            results.begin_after_damage(&damaged.to_string(), "all passes are followed again")?;
            Ok(None)
        }
    }
}

/// Saves a state, from which an interrupted life goes on.
fn save(state: &LifeState, results: &Results, fingerprint: &str) -> Result<(), OutputError> {
    let mut saved = interruption::hold();
    output::save_state(&results.staging(), fingerprint, state)?;
    *saved = Saved::Passes { passes: state.passes, folder: results.staging() };
    Ok(())
}

/// The files of a life.
fn files<'a>() -> [Declared<Followed<'a>>; 6] {
    [
        Text("life.json", |life| Some(life.file.to_json())),
        Text("life.csv", |life| Some(life.file.course())),
        Text("case.toml", |life| Some(life.case.to_toml())),
        File("damage.npz", |life, path| write_damage(path, life.task, &life.begun)),
        Picture("damage", |life| {
            let (begun, fatigue) = (&life.begun, life.begun.record.fatigue.as_ref()?);
            let snapshot = Snapshot::new(&life.case.title, begun.step.clone(), begun.record.reading.clone());
            picture::damage(&snapshot.with_units(life.case.units()), fatigue, &begun.planes)
        }),
        Picture("life", |life| {
            let Followed { case, begun, state, .. } = life;
            let error = begun.record.fatigue.as_ref().and_then(|fatigue| fatigue.first.error);
            picture::course(&case.title, case.problem(), &case.units(), (&state.course, &state.events), error)
        }),
    ]
}

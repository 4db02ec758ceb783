//! `percoat solve`: every load step of a case, the table and the output folder.

use super::declared::{Declared, names};
use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::interruption::{self, Saved};
use super::options::Common;
use super::progress::Progress;
use super::progress_recorder::ProgressRecorder;
use super::results::Results;
use super::solved_pictures::{Pictured, of_case};
use super::terminal::{self, tell};
use clap::Args;
use percoat_app::output::{
    self, CannotGoOn, Clock, Plan, Recording, Summary, damaged_results, disk, is_beside, solved_plan, table,
    write_scalars,
};
use percoat_app::picture::Snapshot;
use percoat_app::task::{Solve, Solved};
use percoat_case::case::Case;
use percoat_common::machine::Capacity;
use percoat_common::plain;
use percoat_core::run::{EarlierRun, Outcome, Run, Sampling, StepRecord};
use percoat_core::stress::VerticalSection;
use rayon::prelude::*;
use std::io::Write;
use std::path::Path;

/// Commands to try after the embedded default.
const NEXT: &str = "\
next: percoat solve ball-on-disc               a ball on a coated disc, in newtons
      percoat cases                            all examples
      percoat cases ball-on-disc > mine.toml   a case of your own
";

/// Options of `percoat solve` alone.
#[derive(Debug, Args)]
pub struct SolveOptions {
    /// Write scalars only: no contact.npz, stress.npz and volumes
    #[arg(long)]
    no_fields: bool,
    /// Continue an interrupted run into the folder
    #[arg(long)]
    resume: bool,
}

pub fn run(case: Option<&Path>, set: &[String], options: &SolveOptions, common: &Common) -> Result<Ending, Failure> {
    let (clock, pictures) = (Clock::start(), &common.pictures);
    let next = if case.is_none() { NEXT } else { "" };
    let (case, name) = read_case(case, set)?;
    let folder = output_folder(common, &name)?;
    let fields = !options.no_fields;
    // An earlier run that has solved its first load and finished no step leaves nothing to set aside; a run of the same case
    // takes over that load.
    let resumes = options.resume || output::has_solved_alone(&folder);
    let task = Solve::into_files(&case, room(&folder, resumes), fields, pictures.wanted())?;
    let (run, steps) = (&task.run, task.run.loads.len());
    let drawn = of_case(&case, steps);
    let mut plan = Plan { resumes, ..solved_plan(&case, steps, fields) };
    plan.names.extend(names(&drawn, pictures));
    let mut results = Results::claim(folder, plan, common.saying())?;
    let fingerprint = output::fingerprint(&case, if fields { "fields" } else { "scalars" });
    let was_begun = results.claim.resumes();
    let earlier = earlier(&mut results, &fingerprint, run, options.resume)?;
    if options.resume
        && !was_begun
        && let Some((ending, summary)) = finished(&case, &results.folder, steps, fields)
    {
        terminal::tell_aside(results.claim.abandon()?.as_deref(), common.quiet);
        if !common.quiet {
            tell!("note: {} is finished; leave --resume out to solve it again", plain::path(&results.folder));
        }
        if common.json {
            write!(terminal::out(), "{summary}")?;
        }
        return Ok(ending);
    }
    if let Some(earlier) = &earlier {
        *interruption::hold() = Saved::Steps { done: done(earlier), of: steps, folder: results.staging() };
    }
    let recording = Recording::new(&results.claim, run, case.to_toml(), clock).resumable(fingerprint, earlier);
    let recording = if fields { recording } else { recording.without_fields() };
    let mut recording = ProgressRecorder::new(recording, &results, run, common);
    let Solved { outcome, warnings } = task.solve(&mut recording)?;
    let (sections, mut clock) = recording.finish()?;
    draw(&results, &case, &outcome, sections, (&drawn, common))?;
    let timing = clock.timing();
    write_scalars(&results.staging(), &case, &outcome, &warnings, timing)?;
    let beside = || {
        // An indenter alone is elastic.
        let reading = &outcome.steps.last().filter(|_| case.time.is_none())?.reading;
        table::alone(&case, reading, &percoat_core::run::alone(case.problem(), reading)?)
    };
    let tables = || {
        let text = table::outcome(&case, &outcome.steps, outcome.change, terminal::width());
        text + &beside().unwrap_or_default() + next
    };
    let line = || format!("{:.2} s ({})", clock.seconds(), table::timing(&timing));
    results.finish("summary.json", tables, line, &warnings)?;
    Ok(Ending::of(outcome.converged()))
}

/// Memory and disk of this machine for a run into a folder. Files of an earlier run that is resumed take no room again.
fn room(folder: &Path, resumes: bool) -> Capacity {
    let room = Capacity::on_this_machine(folder);
    if resumes { Capacity { disk: room.disk.saturating_add(output::staged_bytes(folder)), ..room } } else { room }
}

/// Draws the pictures of the last step, and of the steps before it.
fn draw(
    results: &Results,
    case: &Case,
    outcome: &Outcome,
    sections: Vec<VerticalSection>,
    (pictures, common): (&[Declared<Pictured>], &Common),
) -> Result<(), Failure> {
    if let (Some(last), Some(record), true) = (&outcome.last, outcome.steps.last(), common.pictures.wanted()) {
        let snapshot = Snapshot::new(&case.title, last.clone(), record.reading.clone());
        let snapshot = snapshot.with_strength(record.strength.clone()).with_units(case.units());
        let progress = Progress::new("", 0, 0, common);
        progress.say("drawing pictures");
        let solved = Pictured { last: snapshot, sections, steps: outcome.steps.clone() };
        let write = |picture: &Declared<_>| picture.write(&solved, &results.staging(), &common.pictures);
        pictures.par_iter().try_for_each(write)?;
        progress.finish();
    }
    Ok(())
}

/// Steps of an earlier run into the folder with which this one goes on. With `demanded` (`--resume`) steps of another run are an
/// error, and damaged ones are moved aside and solved again.
fn earlier(results: &mut Results, fingerprint: &str, run: &Run, demanded: bool) -> Result<Option<EarlierRun>, Failure> {
    let (claim, quiet) = (&mut results.claim, results.saying.quiet);
    if !claim.resumes() {
        return Ok(None);
    }
    let reason = match output::finished(&claim.staging(), fingerprint, run) {
        Ok(Some(found)) => {
            if !quiet {
                let [n1, n2] = found.points;
                tell!("note: goes on after step {} on {n1} × {n2} samples", done(&found));
            }
            return Ok(Some(found));
        }
        Err(foreign @ CannotGoOn::Foreign(_)) if demanded => return Err(Failure::refused(foreign)),
        Err(damaged) => damaged.to_string(),
        Ok(None) => format!("{}/checkpoint.npz is missing, no load can be given again", plain::path(&claim.staging())),
    };
    if demanded {
        results.begin_after_damage(&reason, "all steps are solved again")?;
    } else {
        terminal::tell_aside(claim.begin_anew()?.as_deref(), quiet);
    }
    Ok(None)
}

/// Number of loads that an earlier run has solved on its last grid.
fn done(earlier: &EarlierRun) -> usize {
    earlier.steps.len() + usize::from(earlier.last.is_some())
}

/// Ending and summary of the finished result in a folder; `None` if the result is of another case, or not whole. A warning
/// names a file that is missing or damaged.
fn finished(case: &Case, folder: &Path, steps: usize, fields: bool) -> Option<(Ending, String)> {
    let is_own =
        |name: &str| disk::is_file(&folder.join(name)) && is_beside("summary.json", folder, name).unwrap_or(false);
    if !is_own("summary.json") {
        return None;
    }
    let text = disk::read_text(&folder.join("summary.json")).ok()?;
    let summary = Summary::read(&serde_json::from_str(&text).ok()?).ok()?;
    if summary.fingerprint != output::fingerprint(case, "") {
        return None;
    }
    let planned = solved_plan(case, steps, fields).names;
    let unlike = damaged_results(folder);
    if let Some((name, reason)) = unlike.iter().find(|(name, _)| planned.contains(name)) {
        tell!("warning: {} {reason}; all steps are solved again", plain::path(&folder.join(name)));
        return None;
    }
    // An earlier run without fields has left none.
    if fields && !is_own("contact.npz") {
        return None;
    }
    let reached = match case.grid {
        Sampling::Accuracy(accuracy) => summary.accuracy.is_some_and(|change| change < accuracy),
        Sampling::Points(_) => true,
    };
    let converged = summary.steps.iter().all(StepRecord::converged);
    Some((Ending::of(reached && converged), text))
}

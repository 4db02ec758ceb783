//! `percoat solve`: every load step of a case, the table and the output folder.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_case};
use super::interruption::{self, Saved};
use super::options::{Changes, Common};
use super::pictures::PictureOptions;
use super::plan::may_write;
use super::progress::Progress;
use super::shown::Shown;
use super::terminal::{self, tell};
use crate::case::feasibility::Allowed;
use crate::case::resources::Job;
use crate::case::{Case, plausibility};
use crate::machine::Capacity;
use crate::output::summary::summary;
use crate::output::{
    self, CannotGoOn, Clock, Plan, Recording, RunFolder, disk, is_beside, solved_plan, steps_of, table,
    unlike_published, write_scalars,
};
use crate::picture::Snapshot;
use crate::plain;
use crate::run::{Finished, Run, Sampling, StepRecord};
use clap::Args;
use serde_json::Value;
use std::io::Write;
use std::path::Path;

/// What stays of a run.
#[derive(Debug, Args)]
pub struct SolveOptions {
    /// Keep scalars alone: no contact.npz, stress.npz and volumes
    #[arg(long)]
    no_fields: bool,
    /// Go on from what an earlier run into the folder was stopped at
    #[arg(long)]
    resume: bool,
}

pub fn run(
    case: Option<&Path>,
    changes: &Changes,
    options: &SolveOptions,
    pictures: &PictureOptions,
    common: &Common,
) -> Result<Ending, Failure> {
    let clock = Clock::start();
    let (case, name) = read_case(case, &changes.set)?;
    let folder = output_folder(common, &name)?;
    let run = case.run();
    let job = Job::Solve { pictures: pictures.wanted(), fields: !options.no_fields };
    let mut room = Capacity::on_this_machine(&folder);
    // An earlier run that has solved its first load and finished no step leaves nothing to set aside; a run of the same case
    // takes over that load.
    let goes_on = options.resume || RunFolder::has_solved_alone(&folder);
    if goes_on {
        // What stands there already takes no room again.
        room.disk = room.disk.saturating_add(RunFolder::gathered(&folder));
    }
    let allowed = Allowed::within(&case, room, job).map_err(Failure::Refused)?;
    run.check()?;
    interruption::watch();
    let plan = may_write(&case, run.loads.len(), !options.no_fields, pictures);
    let mut claim = RunFolder::claim(&folder, Plan { resumes: goes_on, ..plan })?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let fingerprint = output::fingerprint(&case, if options.no_fields { "scalars" } else { "fields" });
    let was_begun = claim.resumes();
    let earlier = earlier(&mut claim, &fingerprint, &run, options.resume, common.quiet)?;
    if options.resume
        && !was_begun
        && let Some((ending, summary)) = finished(&case, &folder, run.loads.len(), !options.no_fields)
    {
        claim.leave()?;
        if !common.quiet {
            tell!("note: {} is finished; leave --resume out to solve it again", plain::path(&folder));
        }
        if common.json {
            write!(terminal::out(), "{summary}")?;
        }
        return Ok(ending);
    }
    if let Some(earlier) = &earlier {
        *interruption::hold() = Saved::Steps { done: done(earlier), of: run.loads.len(), folder: claim.staging() };
    }
    let recording = Recording::new(&claim, &run, case.to_toml(), clock).resumable(fingerprint, earlier);
    let recording = if options.no_fields { recording.without_fields() } else { recording };
    let mut recording = Shown::new(recording, &claim, &run, allowed, common);
    let outcome = run.solve(&mut recording)?;
    let (section, mut clock) = recording.finish()?;
    let ending = if outcome.converged() { Ending::Done } else { Ending::NotConverged };
    let warnings = [outcome.warnings.clone(), plausibility::of_case(&case)].concat();
    let steps = &outcome.steps;
    if let (Some(last), Some(record), true) = (&outcome.last, steps.last(), pictures.wanted()) {
        let snapshot = Snapshot::new(&case.title, last.clone(), record.reading.clone());
        let snapshot = snapshot.with_strength(record.strength.clone()).with_units(case.units());
        let progress = Progress::new("", 0, 0, common);
        progress.say("drawing pictures");
        pictures.draw(&claim.staging(), &snapshot, section.as_ref(), steps)?;
        progress.finish();
    }
    let timing = clock.timing();
    write_scalars(&claim.staging(), &case, &outcome, &warnings, timing)?;
    interruption::publish(claim, &folder, common.quiet)?;
    if common.json {
        write!(terminal::out(), "{}", summary(&case, &warnings, outcome.change, steps, timing))?;
    } else if !common.quiet {
        let mut out = terminal::out();
        write!(out, "{}", table::outcome(&case, steps, outcome.change, terminal::width()))?;
        let (seconds, parts) = (clock.seconds(), table::timing(&timing));
        writeln!(out, "{seconds:.2} s ({parts}); written to {}", plain::path(&folder))?;
    }
    terminal::warn(&warnings, common.quiet);
    Ok(ending)
}

/// The steps of an earlier run into the folder from which this one goes on. With `demanded` (`--resume`) steps of another run are
/// an error, and damaged ones are moved aside and solved again.
fn earlier(
    claim: &mut RunFolder,
    fingerprint: &str,
    run: &Run,
    demanded: bool,
    quiet: bool,
) -> Result<Option<Finished>, Failure> {
    if !claim.resumes() {
        return Ok(None);
    }
    let found = match output::finished(&claim.staging(), fingerprint, run) {
        Err(damaged @ CannotGoOn::Damaged { .. }) if demanded => {
            let reason = damaged.to_string();
            terminal::tell_damage(&reason, claim.begin_after_damage()?.as_deref(), "all steps are solved again");
            return Ok(None);
        }
        Err(foreign) if demanded => return Err(Failure::refused(foreign)),
        Ok(found) => found,
        Err(_) => None,
    };
    let Some(found) = found else {
        if demanded {
            let reason =
                format!("{}/checkpoint.npz is missing, no load can be given again", plain::path(&claim.staging()));
            terminal::tell_damage(&reason, claim.begin_after_damage()?.as_deref(), "all steps are solved again");
        } else {
            terminal::tell_aside(claim.begin_anew()?.as_deref(), quiet);
        }
        return Ok(None);
    };
    if !quiet {
        let [n1, n2] = found.points;
        tell!("note: goes on after step {} on {n1} × {n2} samples", done(&found));
    }
    Ok(Some(found))
}

/// Number of loads that an earlier run has solved on its last grid.
fn done(earlier: &Finished) -> usize {
    earlier.steps.len() + usize::from(earlier.last.is_some())
}

/// Ending and summary of the finished result in a folder, if it is of this case and whole; a warning names files that are missing.
fn finished(case: &Case, folder: &Path, steps: usize, fields: bool) -> Option<(Ending, String)> {
    let is_own =
        |name: &str| disk::is_file(&folder.join(name)) && is_beside("summary.json", folder, name).unwrap_or(false);
    if !is_own("summary.json") {
        return None;
    }
    let text = disk::read_text(&folder.join("summary.json")).ok()?;
    let summary: Value = serde_json::from_str(&text).ok()?;
    if summary["fingerprint"] != output::fingerprint(case, "") {
        return None;
    }
    let planned = solved_plan(case, steps, fields).names;
    let unlike = unlike_published(folder);
    if let Some((name, reason)) = unlike.iter().find(|(name, _)| planned.contains(name)) {
        tell!("warning: {} {reason}; all steps are solved again", plain::path(&folder.join(name)));
        return None;
    }
    // An earlier run without fields has left none.
    if fields && !is_own("contact.npz") {
        return None;
    }
    let reached = match case.grid {
        Sampling::Accuracy(accuracy) => summary["accuracy"].as_f64().is_some_and(|change| change < accuracy),
        Sampling::Points(_) => true,
    };
    let converged = steps_of(&summary).ok()?.iter().all(StepRecord::converged);
    Some((if reached && converged { Ending::Done } else { Ending::NotConverged }, text))
}

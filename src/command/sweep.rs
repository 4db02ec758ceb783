//! `percoat sweep`: a case, solved for many settings of its keys.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_source};
use super::interruption::{self, Saved};
use super::options::{Common, Saying};
use super::pictures::PictureOptions;
use super::progress::Progress;
use super::terminal::{self, tell};
use crate::case::{Case, Source};
use crate::machine::Capacity;
use crate::output::{Plan, RunFolder, SWEEP_LOG, Writer, disk, write_text};
use crate::picture;
use crate::plain;
use crate::sweep::{self, Axis, Combinations, Description, Group, Log, Row, Status, Study, Task};
use crate::units::Units;
use clap::Args;
use std::collections::HashSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What is varied, and what stays of it.
#[derive(Debug, Args)]
pub struct SweepOptions {
    /// Pair the values of the keys one by one, instead of every combination
    #[arg(long)]
    zip: bool,
    /// Combinations from a CSV table: keys in its first line, a combination in each further one
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Look for the limit loads of each combination, as `percoat limit` does
    #[arg(long)]
    limit: bool,
    /// Solve the I-th of N parts only, for a cluster's scheduler; `percoat merge` joins them
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<(usize, usize)>,
    /// Go on where an earlier sweep ended, however it did; combinations that are done are not solved again
    #[arg(long)]
    resume: bool,
    /// Keep fields and summary of each combination, in combinations/NNNN
    #[arg(long, conflicts_with = "limit")]
    keep_fields: bool,
    /// Keep scalars alone, which is the default
    #[arg(long, conflicts_with = "keep_fields")]
    no_fields: bool,
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/').and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
    parts
        .filter(|(part, of)| (1..=*of).contains(part))
        .ok_or_else(|| "must be I/N with 1 ≤ I ≤ N, such as 3/8".to_owned())
}

/// How often the table on disk is made again while the sweep goes on.
const REFRESH: Duration = Duration::from_secs(2);

/// What the result consists of, for the sweep and for what is merged.
pub fn plan(pictures: &PictureOptions) -> Plan {
    let names = ["sweep.csv", "sweep.json", SWEEP_LOG].map(str::to_owned).into_iter();
    Plan { names: names.chain(pictures.files(&["sweep"])).collect(), ..Plan::new(Writer::Sweep) }
}

pub fn run(
    case: &Path,
    set: &[String],
    options: &SweepOptions,
    pictures: &PictureOptions,
    common: &Common,
) -> Result<Ending, Failure> {
    let started = Instant::now();
    let (source, name) = read_source(Some(case))?;
    let (combinations, fixed) = combinations(options, set)?;
    // Of what is common to all: it may be no case without what is varied.
    let whole = Case::read(&source, &fixed).ok();
    let text = whole.as_ref().map_or_else(|| source.text.clone(), Case::to_toml);
    let task = if options.limit { Task::Limit } else { Task::Solve };
    let (title, fingerprint) =
        (whole.map_or(String::new(), |case| case.title), sweep::fingerprint(&text, &fixed, &combinations));
    let asked = Description::new(&title, &text, task, fingerprint, combinations.all.len());
    let combinations = match options.shard {
        Some((part, of)) => combinations.shard(part, of),
        None => combinations,
    };
    let mut folder = output_folder(common, &name)?;
    if let (Some((part, of)), None) = (options.shard, &common.output) {
        folder.push(format!("shard-{part}-of-{of}"));
    }
    let room = Capacity::on_this_machine(&folder);
    let study = Study::new(&source, &fixed, &combinations, task, room)?;
    let study = if options.keep_fields { study.keeping_fields() } else { study };
    interruption::watch();
    let mut planned = Plan { resumes: options.resume, ..plan(pictures) };
    planned.names.extend(study.files());
    let mut claim = RunFolder::claim(&folder, planned)?;
    terminal::tell_aside(claim.set_aside(), common.quiet);
    let identity = asked.identity();
    let mut rows = Vec::new();
    if options.resume {
        let mut from = if claim.resumes() { claim.staging() } else { folder.clone() };
        let log = from.join(SWEEP_LOG);
        let input = |error| Failure::Input { path: log.clone(), error };
        let lines = match disk::found(&log) {
            Ok(None) => Vec::new(),
            _ => sweep::read(&log).map_err(input)?,
        };
        let (earlier, damaged): (Vec<_>, Vec<_>) = lines.into_iter().partition(Result::is_ok);
        let earlier: Vec<Row> = earlier.into_iter().flatten().map(|own| own.row).collect();
        let known = study.known(&earlier, &from);
        let damaged = damaged.into_iter().filter_map(Result::err);
        let has_all_files = known.damaged.is_empty();
        let damaged =
            damaged.map(|damage| format!("{}, {damage}", plain::path(&log))).chain(known.damaged).collect::<Vec<_>>();
        rows = known.rows;
        let solved = earlier.iter().filter(|row| !row.results.is_empty()).count();
        if rows.is_empty() && solved > 0 && has_all_files {
            return Err(Failure::refused(format!(
                "none of the {solved} combinations that are done in {} is of this sweep: the case, a --set, --limit, \
                 --keep-fields, a surface or the version of percoat is another one; give the same command again, or leave \
                 --resume out",
                plain::path(&folder)
            )));
        }
        // What cannot be used again is not lost.
        if !damaged.is_empty() {
            let aside = if claim.resumes() { claim.begin_after_damage()? } else { None };
            tell_damaged(&damaged, aside.as_deref());
            from = aside.unwrap_or(from);
        } else if claim.resumes() && (rows.len() < solved || study.has_unlogged(&rows, &from)) {
            let aside = claim.begin_anew()?;
            terminal::tell_aside(aside.as_deref(), common.quiet);
            from = aside.unwrap_or(from);
        }
        study.take_over(&rows, &from, &claim.staging())?;
        if !common.quiet {
            tell!("note: {} of {} combinations are done already", rows.len(), combinations.all.len());
        }
    }
    let staging = claim.staging();
    let mut log = Log::begin(&staging, &identity, &rows)?;
    let describe = |rows: &[Row]| asked.after(rows, started.elapsed().as_secs_f64());
    // A part that is killed can be merged with it.
    write_text(&staging.join("sweep.json"), &describe(&rows).to_json())?;
    let (count, known) = (combinations.all.len(), rows.iter().map(|row| row.combination).collect());
    let saved = |done: usize| Saved::Combinations { done, of: count, folder: staging.clone() };
    *interruption::hold() = saved(rows.len());
    let progress = Progress::new("combination", count, rows.len(), common);
    let (mut refreshed, mut pause) = (Instant::now(), REFRESH);
    study.run(&known, &staging, |row| -> Result<(), Failure> {
        // A signal waits until the row is whole.
        let mut hold = interruption::hold();
        log.add(&row)?;
        *hold = saved(rows.len() + 1);
        drop(hold);
        if common.verbose {
            progress.tell(format_args!("{}: {}, {:.2} s", row.named(), row.status.name(), row.seconds));
        }
        progress.say(format!("{} {}", row.named(), row.status.name()));
        progress.advance();
        rows.push(row);
        if refreshed.elapsed() > pause {
            let began = Instant::now();
            write_text(&staging.join("sweep.csv"), &sweep::table(&rows))?;
            // A long table is made less often: rows do not wait for it.
            (refreshed, pause) = (Instant::now(), REFRESH.max(20 * began.elapsed()));
        }
        Ok(())
    })?;
    progress.finish();
    drop(log);
    rows.sort_by_key(|row| row.combination);
    let description = describe(&rows);
    finish(claim, &folder, &rows, &description, pictures, common.quiet)?;
    print(&rows, &description, &folder, &Saying { quiet: common.quiet, json: common.json })?;
    Ok(ending(&rows))
}

/// Writes the result and puts it in its place.
pub fn finish(
    claim: RunFolder,
    folder: &Path,
    rows: &[Row],
    description: &Description,
    pictures: &PictureOptions,
    quiet: bool,
) -> Result<(), Failure> {
    let staging = claim.staging();
    // In the order of the combinations, not in that of their ends.
    drop(Log::begin(&staging, &description.identity(), rows)?);
    write_text(&staging.join("sweep.csv"), &sweep::table(rows))?;
    write_text(&staging.join("sweep.json"), &description.to_json())?;
    let text = description.case.clone();
    let common = Source { name: "the common case".to_owned(), text, ..Source::default() };
    let units = Case::read(&common, &[]).map_or_else(|_| Units::unknown(), |case| case.units());
    pictures.write(&staging, "sweep", || picture::sweep(&description.title, &units, rows))?;
    Ok(interruption::publish(claim, folder, quiet)?)
}

/// What is varied, and what is the same in all: a key with one value.
fn combinations(options: &SweepOptions, set: &[String]) -> Result<(Combinations, Vec<String>), Failure> {
    let axes = set.iter().map(|text| Axis::parse(text)).collect::<Result<Vec<_>, _>>().map_err(Failure::refused)?;
    let (fixed, axes): (Vec<Axis>, Vec<Axis>) = axes.into_iter().partition(|axis| axis.values.len() == 1);
    let fixed = fixed.iter().flat_map(Axis::settings).collect();
    let mut groups = Vec::new();
    if let Some(path) = &options.table {
        let text = std::fs::read_to_string(path).map_err(|error| Failure::Input { path: path.clone(), error })?;
        let table = Group::table(&text);
        groups.push(table.map_err(|error| Failure::refused(format!("{}, {error}", plain::path(path))))?);
    }
    if options.zip && !axes.is_empty() {
        groups.push(Group::zip(&axes).map_err(Failure::refused)?);
    } else {
        groups.extend(axes.iter().map(Group::of));
    }
    let combinations = Combinations::product(&groups).map_err(Failure::refused)?;
    Ok((combinations, fixed))
}

/// What of an earlier sweep is not as it was written, line by line of the first some, and where all of it is now.
fn tell_damaged(damaged: &[String], aside: Option<&Path>) {
    /// Damages told one by one.
    const TOLD: usize = 5;
    for reason in damaged.iter().take(TOLD) {
        terminal::tell_damage(reason, aside, "this combination is solved again");
    }
    if damaged.len() > TOLD {
        tell!("warning: and {} more that are damaged; their combinations are solved again", damaged.len() - TOLD);
    }
}

/// How many are done, and why others are not.
pub fn print(rows: &[Row], description: &Description, folder: &Path, saying: &Saying) -> Result<(), Failure> {
    /// Failures told one by one.
    const TOLD: usize = 5;
    if saying.json {
        write!(terminal::out(), "{}", description.to_json())?;
    }
    if saying.quiet || saying.json {
        return Ok(());
    }
    let mut out = terminal::out();
    let count = |status: Status| rows.iter().filter(|row| row.status == status).count();
    let (done, open, failed) = (count(Status::Done), count(Status::NotConverged), count(Status::Failed));
    let mut words = format!("{done} of {} combinations done", rows.len());
    for (count, what) in [(open, "not converged"), (failed, "failed")] {
        if count > 0 {
            words += &format!(", {count} {what}");
        }
    }
    let seconds = description.timing.wall;
    writeln!(out, "{words}; {seconds:.2} s; written to {}", plain::path(folder))?;
    drop(out);
    tell_warnings(rows);
    let unsettled: Vec<&Row> = rows.iter().filter(|row| row.status != Status::Done).collect();
    for row in unsettled.iter().take(TOLD) {
        tell!("warning: {}: {}", row.named(), row.reason.as_deref().unwrap_or("not converged"));
    }
    if unsettled.len() > TOLD {
        tell!("warning: and {} more, see the column `reason` of sweep.csv", unsettled.len() - TOLD);
    }
    Ok(())
}

/// Each warning once, whatever its numbers, with the number of combinations that have it.
fn tell_warnings(rows: &[Row]) {
    /// Warnings told.
    const TOLD: usize = 5;
    let mut counted: Vec<(String, &str, HashSet<usize>)> = Vec::new();
    for (row, warning) in rows.iter().flat_map(|row| row.warnings.iter().map(move |warning| (row.combination, warning)))
    {
        let words = without_numbers(warning);
        match counted.iter_mut().find(|(own, ..)| *own == words) {
            Some((.., combinations)) => {
                combinations.insert(row);
            }
            None => counted.push((words, warning, HashSet::from([row]))),
        }
    }
    for (_, first, combinations) in counted.iter().take(TOLD) {
        let count = combinations.len();
        match count {
            1 => tell!("warning: {first} (1 of {})", rows.len()),
            _ => tell!("warning: {first} (this or with other numbers in {count} of {})", rows.len()),
        }
    }
    if counted.len() > TOLD {
        tell!("warning: and {} more, see the column `warnings` of sweep.csv", counted.len() - TOLD);
    }
}

/// A sentence without what differs from one combination to the next.
fn without_numbers(text: &str) -> String {
    text.split(' ').filter(|word| !word.contains(|letter: char| letter.is_ascii_digit())).collect::<Vec<_>>().join(" ")
}

/// Whether everything is as it should be.
pub fn ending(rows: &[Row]) -> Ending {
    if rows.iter().all(|row| row.status == Status::Done) { Ending::Done } else { Ending::NotConverged }
}

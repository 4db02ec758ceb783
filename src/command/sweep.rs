//! `percoat sweep`: a case, solved for many settings of its keys.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_source, read_text};
use super::interruption::{self, Saved};
use super::options::Common;
use super::progress::Progress;
use super::results::Results;
use super::sweep_files::{finish, may_write};
use super::terminal::{self, tell};
use clap::Args;
use percoat_app::output::{Plan, SWEEP_LOG, Writer};
use percoat_app::sweep::{self, Axis, Combinations, Description, Design, Group, Log, Row, Study, Task, VaryError};
use percoat_case::case::Source;
use percoat_common::machine::Capacity;
use percoat_common::plain;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Options of `percoat sweep` alone.
#[derive(Debug, Args)]
pub struct SweepOptions {
    /// Pair the values of the keys one by one, instead of every combination
    #[arg(long)]
    zip: bool,
    /// Combinations from a CSV table: keys in its first line, a combination in each further one
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
    /// Vary a key within its uncertainty: KEY=A:B, KEY=10%, KEY=normal:MEAN:DEVIATION, KEY=normal:5% or KEY=library (repeatable)
    #[arg(long, value_name = "KEY=RANGE", conflicts_with_all = ["zip", "table"])]
    vary: Vec<String>,
    /// Samples of the uncertain keys, a power of 2: each takes two combinations and one more a key
    #[arg(long, value_name = "N", requires = "vary", default_value_t = 128)]
    samples: usize,
    /// Seed of the samples
    #[arg(long, value_name = "SEED", requires = "vary", default_value_t = 0)]
    seed: u32,
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

impl From<VaryError> for Failure {
    fn from(error: VaryError) -> Self {
        match error {
            VaryError::Case(error) => error.into(),
            refused => Self::refused(refused),
        }
    }
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/').and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
    parts
        .filter(|(part, of)| (1..=*of).contains(part))
        .ok_or_else(|| "must be I/N with 1 ≤ I ≤ N, such as 3/8".to_owned())
}

/// Shortest time between two writings of the table of an unfinished sweep.
const REFRESH: Duration = Duration::from_secs(2);

pub fn run(case: &Path, set: &[String], options: &SweepOptions, common: &Common) -> Result<Ending, Failure> {
    let started = Instant::now();
    let (source, name) = read_source(Some(case))?;
    let (combinations, fixed) = combinations(&source, options, set)?;
    let task = if options.limit { Task::Limit } else { Task::Solve };
    let described = Description::of(&source, &fixed, &combinations, task);
    let mut folder = output_folder(common, &name)?;
    let combinations = match options.shard {
        Some((part, of)) => {
            if common.output.is_none() {
                folder.push(format!("shard-{part}-of-{of}"));
            }
            combinations.shard(part, of)
        }
        None => combinations,
    };
    let study = Study::new(&source, &fixed, &combinations, task, Capacity::on_this_machine(&folder))?;
    let study = if options.keep_fields { study.keeping_fields() } else { study };
    let mut plan = Plan { resumes: options.resume, ..may_write(Writer::Sweep, &common.pictures) };
    plan.names.extend(study.files());
    let mut results = Results::claim(folder, plan, common.saying())?;
    let count = combinations.all.len();
    let mut rows = if options.resume { earlier(&study, &mut results, count)? } else { Vec::new() };
    let describe = |rows: &[Row]| described.after(rows, started.elapsed().as_secs_f64());
    let log = Log::begin(&results.staging(), &described.identity(), &rows)?;
    // `percoat merge` needs it of a part that is killed.
    results.write("sweep.json", &describe(&rows).to_json())?;
    solve(&study, &results, log, &mut rows, count, common)?;
    rows.sort_by_key(|row| row.combination);
    finish(results, &rows, &describe(&rows), &common.pictures)
}

/// Combinations of an earlier sweep into the folder with which this one of `count` combinations goes on; their files are taken
/// over. Damaged and unlogged ones are moved aside.
fn earlier(study: &Study, results: &mut Results, count: usize) -> Result<Vec<Row>, Failure> {
    let (claim, quiet) = (&mut results.claim, results.saying.quiet);
    let from = if claim.resumes() { claim.staging() } else { results.folder.clone() };
    let known = study.known(&from).map_err(|error| Failure::Input { path: from.join(SWEEP_LOG), error })?;
    if known.is_foreign {
        return Err(Failure::refused(format!(
            "none of the {} combinations that are done in {} is of this sweep: the case, a --set, --limit, \
             --keep-fields, a surface or the version of percoat is another one; give the same command again, or leave \
             --resume out",
            known.solved,
            plain::path(&results.folder)
        )));
    }
    let mut aside = None;
    if !known.damaged.is_empty() {
        aside = if claim.resumes() { claim.begin_after_damage()? } else { None };
        let damage = |reason: &String| terminal::damage(reason, aside.as_deref(), "this combination is solved again");
        let damaged = known.damaged.iter().map(damage).collect();
        let others = " that are damaged; their combinations are solved again";
        terminal::warn(&terminal::first_five(damaged, others), false);
    } else if claim.resumes() && (known.rows.len() < known.solved || study.has_unlogged(&known.rows, &from)) {
        aside = claim.begin_anew()?;
        terminal::tell_aside(aside.as_deref(), quiet);
    }
    study.take_over(&known.rows, &aside.unwrap_or(from), &claim.staging())?;
    if !quiet {
        tell!("note: {} of {count} combinations are done already", known.rows.len());
    }
    Ok(known.rows)
}

/// Solves all combinations but those of the `rows`, and adds a row to these and to the log when one is done.
fn solve(
    study: &Study,
    results: &Results,
    mut log: Log,
    rows: &mut Vec<Row>,
    count: usize,
    common: &Common,
) -> Result<(), Failure> {
    let (staging, known) = (results.staging(), rows.iter().map(|row| row.combination).collect());
    let saved = |done: usize| Saved::Combinations { done, of: count, folder: staging.clone() };
    *interruption::hold() = saved(rows.len());
    let progress = Progress::new("combination", count, rows.len(), common);
    let (mut refreshed, mut pause) = (Instant::now(), REFRESH);
    study.run(&known, &staging, |row| -> Result<(), Failure> {
        // The handler of signals waits until the row is whole.
        let mut hold = interruption::hold();
        log.add(&row)?;
        *hold = saved(rows.len() + 1);
        drop(hold);
        progress.tell(format_args!("{}: {}, {:.2} s", row.named(), row.status.name(), row.seconds));
        progress.say(format!("{} {}", row.named(), row.status.name()));
        progress.advance();
        rows.push(row);
        if refreshed.elapsed() > pause {
            let began = Instant::now();
            results.write("sweep.csv", &sweep::table(rows))?;
            // A long table is written less often, so that it takes a twentieth of the time at most.
            (refreshed, pause) = (Instant::now(), REFRESH.max(20 * began.elapsed()));
        }
        Ok(())
    })?;
    progress.finish();
    Ok(())
}

/// The combinations of the keys that vary, and the settings of keys with one value.
fn combinations(
    source: &Source,
    options: &SweepOptions,
    set: &[String],
) -> Result<(Combinations, Vec<String>), Failure> {
    let axes = set.iter().map(|text| Axis::parse(text)).collect::<Result<Vec<_>, _>>().map_err(Failure::refused)?;
    // A key with one value and with several is one of neither list alone.
    sweep::keys_once(axes.iter().map(|axis| axis.key.as_str())).map_err(Failure::refused)?;
    let (fixed, axes): (Vec<Axis>, Vec<Axis>) = axes.into_iter().partition(|axis| axis.values.len() == 1);
    let mut groups = Vec::new();
    if let Some(path) = &options.table {
        let table = Group::table(&read_text(path)?);
        let table = table.map_err(|error| Failure::refused(format!("{}, {error}", plain::path(path))))?;
        let fixed = fixed.iter().map(|axis| axis.key.as_str());
        sweep::keys_once(table.keys().chain(fixed)).map_err(Failure::refused)?;
        groups.push(table);
    }
    let fixed: Vec<String> = fixed.iter().flat_map(Axis::settings).collect();
    if !options.vary.is_empty() {
        if let Some(axis) = axes.first() {
            return Err(Failure::refused(format!(
                "--vary takes one value of each other key, and --set gives several of `{}`: sweep once for each",
                axis.key
            )));
        }
        let design = Design::new(source, &fixed, &options.vary, options.samples, options.seed)?;
        return Ok((design.combinations(), fixed));
    }
    if options.zip && !axes.is_empty() {
        groups.push(Group::zip(&axes).map_err(Failure::refused)?);
    } else {
        groups.extend(axes.iter().map(Group::of));
    }
    let combinations = Combinations::product(&groups).map_err(Failure::refused)?;
    Ok((combinations, fixed))
}

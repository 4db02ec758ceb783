//! The finished steps of an interrupted run, checked before the run is resumed.
//!
//! A run is resumed only where every file is as it was written: all entries of the checkpoint, the lines of the log in order and
//! with their checksums, and the files that they name with theirs, all of the same run and loads. Otherwise no step could be
//! reproduced bit for bit, and all are solved again.

use super::checkpoint::{self, RunPosition};
use super::disk;
use super::layout::{self, ARCHIVES, COARSER};
use super::log::whole_lines;
use super::steps_log::{self, LoggedStep, logged};
use super::unpack::unpack;
use percoat_common::plain;
use percoat_core::run::{EarlierRun, LastLoad, Refinement, Run, Sampling, StepRecord};
use std::io;
use std::path::{Path, PathBuf};

/// Why an interrupted run cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum CannotGoOn {
    /// The staging folder is of another run.
    #[error(
        "{} is of another run: the case, its surface, the grid, --no-fields or the version of percoat is another one; give the \
         same command again, or leave --resume out, which moves aside what it has finished", plain::path(.0)
    )]
    Foreign(PathBuf),
    /// A file is damaged or missing, or of an earlier version that wrote no checksums.
    #[error("{}: {reason}", plain::path(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage of the file.
        reason: String,
    },
}

/// The finished steps of an interrupted `run` in the staging folder `folder`; `None` where no solved load is saved.
///
/// # Errors
/// [`CannotGoOn`].
pub fn finished(folder: &Path, fingerprint: &str, run: &Run) -> Result<Option<EarlierRun>, CannotGoOn> {
    let path = folder.join(checkpoint::NAME);
    if !disk::is_file(&path) {
        return Ok(None);
    }
    let damaged = |reason: String| CannotGoOn::Damaged { path: path.clone(), reason };
    let (position, changes, last) = checkpoint::read(&path).map_err(|error| damaged(error.to_string()))?;
    if position.fingerprint != fingerprint {
        return Err(CannotGoOn::Foreign(folder.to_owned()));
    }
    let before = plausible(&position, &changes, last.as_ref(), run).map_err(damaged)?;
    let (log, coarser) = (folder.join(steps_log::NAME), folder.join(COARSER).join(steps_log::NAME));
    // The steps of the coarser grid are moved after the checkpoint of the finer one has been saved.
    let is_moved = position.steps > 0 || !disk::is_file(&log);
    let all = run.loads.len();
    let coarser = before
        .map(|points| {
            GridLog { path: if is_moved { &coarser } else { &log }, fingerprint, run, points }.steps(all, all)
        })
        .transpose()?;
    let count = position.steps.saturating_sub(1);
    let steps = GridLog { path: &log, fingerprint, run, points: position.points }.steps(count, usize::MAX)?;
    whole(folder, &steps)?;
    let records = |steps: Vec<LoggedStep>| -> Vec<StepRecord> { steps.into_iter().map(|step| step.record).collect() };
    Ok(Some(EarlierRun {
        points: position.points,
        changes,
        coarser: coarser.map(records),
        steps: records(steps),
        last,
    }))
}

/// Refuses a checkpoint that does not belong to the loads and grids of `run`. Returns the grid before, of a refinement.
fn plausible(
    position: &RunPosition,
    changes: &[f64],
    last: Option<&LastLoad>,
    run: &Run,
) -> Result<Option<[usize; 2]>, String> {
    let [n1, n2] = position.points;
    let other = || format!("it is of {n1} × {n2} samples after {} changes of the grid", changes.len());
    let before = match run.sampling {
        Sampling::Points(points) if points == position.points && changes.is_empty() => None,
        Sampling::Points(_) => return Err(other()),
        Sampling::Accuracy(accuracy) => {
            let cell = run.problem.cell();
            let mut refinement = Refinement::new(&cell, accuracy).map_err(|error| error.to_string())?;
            refinement.go_on(position.points, changes).map_err(|_| other())?;
            let grids = Refinement::grids(&cell).map_err(|error| error.to_string())?;
            let at = grids.iter().position(|points| *points == position.points).ok_or_else(other)?;
            at.checked_sub(1).map(|before| grids[before])
        }
    };
    let loads = run.loads.len();
    if position.steps > loads || (position.steps == 0) != last.is_none() || position.steps == 0 && before.is_none() {
        return Err(format!("it is of step {} of {loads}", position.steps));
    }
    if position.refined != before.is_some() {
        return Err(other());
    }
    match last {
        Some(last) if !last.checkpoint.fits(position.points, run.settings.method, run.problem.loaded_by().line()) => {
            Err(format!("its fields are not those of {n1} × {n2} samples and their coarser grids"))
        }
        _ => Ok(before),
    }
}

/// The log of the steps of a run on one grid.
struct GridLog<'a> {
    path: &'a Path,
    fingerprint: &'a str,
    run: &'a Run,
    points: [usize; 2],
}

impl GridLog<'_> {
    /// The first `count` steps of a log of at most `most`.
    fn steps(&self, count: usize, most: usize) -> Result<Vec<LoggedStep>, CannotGoOn> {
        let damaged = |reason: String| CannotGoOn::Damaged { path: self.path.to_owned(), reason };
        let lines = match whole_lines(self.path) {
            // The log begins with the second step.
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            lines => lines.map_err(|error| damaged(error.to_string()))?,
        };
        if lines.len() < count || lines.len() > most {
            return Err(damaged(format!("it has {} whole lines, and {count} steps are finished", lines.len())));
        }
        let steps = (1..).zip(&lines[..count]);
        steps.map(|(number, line)| self.step(number, line)).collect::<Result<_, _>>().map_err(damaged)
    }

    fn step(&self, number: usize, line: &str) -> Result<LoggedStep, String> {
        let step = logged(line).map_err(|reason| format!("line {number}: {reason}"))?;
        let identity = &step.identity;
        if identity.step != number {
            return Err(format!("line {number} is that of step {}", identity.step));
        }
        if identity.run.as_deref() != Some(self.fingerprint) {
            return Err(format!("line {number} is of another run"));
        }
        if identity.load != self.run.loads[number - 1].into() {
            return Err(format!("line {number} is of another load"));
        }
        if step.record.points != self.points {
            return Err(format!("line {number} is of another grid"));
        }
        Ok(step)
    }
}

/// Refuses steps whose files were changed since they were written. Entries already gathered in an archive are unpacked again.
fn whole(folder: &Path, steps: &[LoggedStep]) -> Result<(), CannotGoOn> {
    for archive in ARCHIVES {
        let path = folder.join(layout::archive(archive));
        let is_whole = || steps.iter().all(|step| step.files.damaged(folder).is_none());
        if steps.is_empty() || !disk::is_file(&path) || is_whole() {
            continue;
        }
        let names = steps.iter().flat_map(|step| step.files.names());
        unpack(folder, archive, names).map_err(|error| CannotGoOn::Damaged { path, reason: error.to_string() })?;
    }
    for step in steps {
        if let Some((name, reason)) = step.files.damaged(folder) {
            return Err(CannotGoOn::Damaged {
                path: folder.join(name),
                reason: format!("the file of step {} {reason}", step.identity.step),
            });
        }
    }
    Ok(())
}

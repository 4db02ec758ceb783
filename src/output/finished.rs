//! What an unfinished run has finished, as far as it is whole.
//!
//! A run goes on with what an earlier one has left only where all of it is as it was written: the checkpoint with every entry, the
//! lines of the log in their order with their checksums, the files that they name with their checksums, all of this very run and its
//! loads. Where anything is not, no step before can be given again bit for bit, and all are solved again.

use super::checkpoint::{self, RunPosition};
use super::disk;
use super::layout::COARSER;
use super::log::whole_lines;
use super::steps_log::{self, Logged, logged};
use super::unpack::unpack;
use crate::plain;
use crate::run::{Finished, Last, Refinement, Run, Sampling, StepRecord};
use std::io;
use std::path::{Path, PathBuf};

/// Why a run cannot go on with what stands unfinished in its folder.
#[derive(Debug, thiserror::Error)]
pub enum CannotGoOn {
    /// It is of another run.
    #[error(
        "{} is of another run: the case, its surface, --no-fields or the version of percoat is another one; give the same \
         command again, or leave --resume out, which moves its finished steps aside", plain::path(.0)
    )]
    Foreign(PathBuf),
    /// A part of it is damaged or missing, or of an earlier version that wrote no checksums.
    #[error("{}: {reason}", plain::path(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is the matter with it.
        reason: String,
    },
}

/// What an unfinished `run` has finished where its result is gathered; `None` where no load that it has solved is saved.
///
/// # Errors
/// [`CannotGoOn`].
pub fn finished(folder: &Path, fingerprint: &str, run: &Run) -> Result<Option<Finished>, CannotGoOn> {
    let path = folder.join(checkpoint::NAME);
    if !disk::is_file(&path) {
        return Ok(None);
    }
    let damaged = |reason: String| CannotGoOn::Damaged { path: path.clone(), reason };
    let (place, changes, last) = checkpoint::read(&path).map_err(|error| damaged(error.to_string()))?;
    if place.fingerprint != fingerprint {
        return Err(CannotGoOn::Foreign(folder.to_owned()));
    }
    let before = plausible(&place, &changes, last.as_ref(), run).map_err(damaged)?;
    let (own, coarser) = (folder.join(steps_log::NAME), folder.join(COARSER).join(steps_log::NAME));
    // The steps of the grid before move aside after the finer one has been saved as begun.
    let is_moved = place.steps > 0 || !disk::is_file(&own);
    let all = run.loads.len();
    let coarser = before
        .map(|points| {
            let log = Log { path: if is_moved { &coarser } else { &own }, fingerprint, run, points };
            log.steps(all, all)
        })
        .transpose()?;
    let count = place.steps.saturating_sub(1);
    let steps = Log { path: &own, fingerprint, run, points: place.points }.steps(count, usize::MAX)?;
    whole(folder, &steps)?;
    let records = |steps: Vec<Logged>| -> Vec<StepRecord> { steps.into_iter().map(|step| step.record).collect() };
    Ok(Some(Finished { points: place.points, changes, coarser: coarser.map(records), steps: records(steps), last }))
}

/// Refuses a checkpoint that no run of these loads and grids has saved; the grid before, of a refinement.
fn plausible(
    place: &RunPosition,
    changes: &[f64],
    last: Option<&Last>,
    run: &Run,
) -> Result<Option<[usize; 2]>, String> {
    let [n1, n2] = place.points;
    let other = || format!("it is of {n1} × {n2} samples after {} changes of the grid", changes.len());
    let before = match run.sampling {
        Sampling::Points(points) if points == place.points && changes.is_empty() => None,
        Sampling::Points(_) => return Err(other()),
        Sampling::Accuracy(accuracy) => {
            let cell = run.problem.cell();
            let mut refinement = Refinement::new(&cell, accuracy).map_err(|error| error.to_string())?;
            refinement.go_on(place.points, changes).map_err(|_| other())?;
            let grids = Refinement::grids(&cell).map_err(|error| error.to_string())?;
            let at = grids.iter().position(|points| *points == place.points).ok_or_else(other)?;
            at.checked_sub(1).map(|before| grids[before])
        }
    };
    let loads = run.loads.len();
    if place.steps > loads || (place.steps == 0) != last.is_none() || place.steps == 0 && before.is_none() {
        return Err(format!("it is of step {} of {loads}", place.steps));
    }
    if place.refined != before.is_some() {
        return Err(other());
    }
    match last {
        Some(last) if !last.checkpoint.fits(place.points, run.settings.method) => {
            Err(format!("its fields are not those of {n1} × {n2} samples and their coarser grids"))
        }
        _ => Ok(before),
    }
}

/// A log of the steps of a run on a grid.
struct Log<'a> {
    path: &'a Path,
    fingerprint: &'a str,
    run: &'a Run,
    points: [usize; 2],
}

impl Log<'_> {
    /// The first `count` steps of at most so many.
    fn steps(&self, count: usize, most: usize) -> Result<Vec<Logged>, CannotGoOn> {
        let damaged = |reason: String| CannotGoOn::Damaged { path: self.path.to_owned(), reason };
        let lines = match whole_lines(self.path) {
            // Before the second step there is none.
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            lines => lines.map_err(|error| damaged(error.to_string()))?,
        };
        if lines.len() < count || lines.len() > most {
            return Err(damaged(format!("it has {} whole lines, and {count} steps are finished", lines.len())));
        }
        let steps = (1..).zip(&lines[..count]);
        steps.map(|(number, line)| self.step(number, line)).collect::<Result<_, _>>().map_err(damaged)
    }

    fn step(&self, number: usize, line: &str) -> Result<Logged, String> {
        let step = logged(line).map_err(|reason| format!("line {number}: {reason}"))?;
        let place = &step.place;
        if place.step != number {
            return Err(format!("line {number} is that of step {}", place.step));
        }
        if place.run.as_deref() != Some(self.fingerprint) {
            return Err(format!("line {number} is of another run"));
        }
        if place.load != self.run.loads[number - 1].into() {
            return Err(format!("line {number} is of another load"));
        }
        if step.record.points != self.points {
            return Err(format!("line {number} is of another grid"));
        }
        Ok(step)
    }
}

/// Refuses steps whose files are not as they were written. What has been gathered in an archive is taken apart again.
fn whole(folder: &Path, steps: &[Logged]) -> Result<(), CannotGoOn> {
    for archive in ["contact", "stress"] {
        let path = folder.join(format!("{archive}.npz"));
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
                reason: format!("what step {} has left there {reason}", step.place.step),
            });
        }
    }
    Ok(())
}

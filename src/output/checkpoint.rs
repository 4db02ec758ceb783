//! `checkpoint.npz`: what the solver knew after the last load of an unfinished run that is saved, and where in the run that was.
//!
//! It is replaced by the next one at once, and comes before what is read off its step. Writing them takes a small part of
//! the time of a run with several loads; what is solved in between is solved again by the run that goes on.

use super::layout::COARSER;
use super::npz::{Archive, values};
use super::recorded::{self, Unreadable};
use super::steps_log;
use super::{OutputError, disk, write_file};
use crate::run::{Finished, Last, StepRecord};
use crate::spectral::{Certificate, Checkpoint, Report, Stop, Unknowns};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use zip::ZipArchive;

/// Name of the file.
pub(super) const NAME: &str = "checkpoint.npz";
/// Entry of the archive that says where it was.
const PLACE: &str = "place.json";
/// What is solved between two checkpoints takes so many times the time of writing one, at least.
const SHARE: u32 = 20;

/// Why a run cannot go on with what stands unfinished in its folder.
#[derive(Debug, thiserror::Error)]
pub enum CannotGoOn {
    /// It is of another run.
    #[error(
        "{} is of another run: the case, its surface, --no-fields or the version of percoat is another one; give the same \
         command again, or leave --resume out, which moves its finished steps aside", .0.display()
    )]
    Foreign(PathBuf),
    /// It cannot be read, or is not whole.
    #[error("cannot go on from {}: {reason}; leave --resume out to begin anew, which moves finished steps aside", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

/// Where a run was.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Place {
    /// Of what decides about the result.
    fingerprint: String,
    /// The grid.
    points: [usize; 2],
    /// Whether all steps are done on a coarser one.
    refined: bool,
    /// Number of loads solved on it.
    steps: usize,
    /// What the solver says of the last, if there is one.
    solved: Option<Solved>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct Solved {
    stop: String,
    route: String,
    trials: usize,
    iterations: usize,
    outer: usize,
    /// Number of coarser grids that the step keeps, and of all in the file.
    coarser: usize,
    grids: usize,
}

/// Saves the checkpoints of a run.
#[derive(Debug)]
pub(super) struct Checkpoints {
    fingerprint: String,
    /// Number of all loads.
    loads: usize,
    /// What the grids so far have brought.
    pub(super) changes: Vec<f64>,
    /// When the run began.
    began: Instant,
    /// When the last one was written, and how long that took.
    written: Option<(Instant, Duration)>,
}

impl Checkpoints {
    /// Of a run with so many loads.
    pub(super) fn new(fingerprint: String, loads: usize) -> Self {
        Self { fingerprint, loads, changes: Vec::new(), began: Instant::now(), written: None }
    }

    /// Saves that a finer grid begins.
    pub(super) fn begin_finer(&mut self, folder: &Path, points: [usize; 2]) -> Result<(), OutputError> {
        self.write(folder, Place { points, refined: true, steps: 0, ..self.place() }, None)?;
        // A log without a checkpoint of its grid is that of the grid before: the first step is saved before it is logged.
        self.written = None;
        Ok(())
    }

    /// Saves what the solver knows after the step of this number, from 1, unless the last time was a moment ago; `refined`
    /// tells whether there is a coarser grid. The first and the last step on a grid are always saved, but for a run of one
    /// load that has just begun.
    pub(super) fn save(
        &mut self,
        folder: &Path,
        points: [usize; 2],
        refined: bool,
        steps: usize,
        (last, seconds): (&Checkpoint, f64),
    ) -> Result<(), OutputError> {
        let soon = |(when, took): (Instant, Duration)| when.elapsed() < SHARE * took;
        // What is gathered at the end needs the last step of several; of one load alone nothing has to be kept.
        let skipped = match self.written {
            Some(written) => steps < self.loads && soon(written),
            None => self.loads == 1 && !refined && soon((self.began, foreseen(last))),
        };
        if skipped {
            return Ok(());
        }
        let place = Place { points, refined, steps, solved: Some(Solved::of(last)), ..self.place() };
        self.write(folder, place, Some((last, seconds)))
    }

    /// Before anything is solved.
    fn place(&self) -> Place {
        let fingerprint = self.fingerprint.clone();
        Place { fingerprint, points: [0; 2], refined: false, steps: 0, solved: None }
    }

    fn write(&mut self, folder: &Path, place: Place, last: Option<(&Checkpoint, f64)>) -> Result<(), OutputError> {
        let began = Instant::now();
        let place = serde_json::to_string(&place).expect("a place is numbers and texts under names");
        write_file(&folder.join(NAME), |writer| {
            let mut archive = Archive::new(writer);
            archive.text(PLACE, &place)?;
            archive.array("changes", &[self.changes.len()], self.changes.iter().copied())?;
            last.map_or(Ok(()), |(checkpoint, seconds)| add(&mut archive, checkpoint, seconds))?;
            archive.finish()
        })?;
        self.written = Some((Instant::now(), began.elapsed()));
        Ok(())
    }
}

impl Solved {
    fn of(checkpoint: &Checkpoint) -> Self {
        let Report { stop, route, iterations, outer, .. } = checkpoint.report;
        Self {
            stop: stop.to_string(),
            route: route.name().to_owned(),
            trials: route.trials(),
            iterations,
            outer,
            coarser: checkpoint.coarser,
            grids: checkpoint.grids.len(),
        }
    }
}

/// Adds the numbers and fields of a checkpoint whose load took so many seconds.
fn add<W: Write + Seek>(archive: &mut Archive<W>, checkpoint: &Checkpoint, seconds: f64) -> io::Result<()> {
    archive.array("numbers", &[3], [checkpoint.convolutions, checkpoint.report.residual, seconds])?;
    for (index, Unknowns { pressure, gap, penetration, certificate }) in checkpoint.grids.iter().enumerate() {
        let Certificate { energy_gap, penetration: deepest, load } = *certificate;
        archive.array(&format!("proof_{index}"), &[4], [*penetration, energy_gap, deepest, load])?;
        archive.array(&format!("pressure_{index}"), &[pressure.len()], pressure.iter().copied())?;
        archive.array(&format!("gap_{index}"), &[gap.len()], gap.iter().copied())?;
    }
    Ok(())
}

/// A checkpoint alone, for who keeps it elsewhere than in a folder; [`Solver::restore`](crate::Solver::restore) gives its
/// step again.
///
/// # Errors
/// Those of the writer.
pub fn write_checkpoint(writer: impl Write + Seek, checkpoint: &Checkpoint) -> io::Result<()> {
    let solved = serde_json::to_string(&Solved::of(checkpoint)).expect("numbers and texts under names");
    let mut archive = Archive::new(writer);
    archive.text(PLACE, &solved)?;
    add(&mut archive, checkpoint, 0.0)?;
    archive.finish()
}

/// The same, read back.
///
/// # Errors
/// Those of the reader, and what is no such checkpoint.
pub fn read_checkpoint(reader: impl Read + Seek) -> io::Result<Checkpoint> {
    let mut saved = Saved(ZipArchive::new(reader)?);
    let solved: Solved = saved.place()?;
    Ok(saved.last(&solved)?.checkpoint)
}

/// How long writing takes, by a disk that is not slow.
fn foreseen(last: &Checkpoint) -> Duration {
    const BYTES_PER_SECOND: f64 = 1e9;
    let samples: usize = last.grids.iter().map(|own| own.pressure.len()).sum();
    Duration::from_secs_f64(16.0 * samples as f64 / BYTES_PER_SECOND)
}

/// What an unfinished run has finished where its result is gathered; `None` where there is no checkpoint.
///
/// # Errors
/// [`CannotGoOn`].
pub fn finished(folder: &Path, fingerprint: &str) -> Result<Option<Finished>, CannotGoOn> {
    let path = folder.join(NAME);
    if !disk::is_file(&path) {
        return Ok(None);
    }
    let failed = |error: io::Error| CannotGoOn::Unreadable { path: path.clone(), reason: error.to_string() };
    let mut saved = Saved::open(&path).map_err(failed)?;
    let place: Place = saved.place().map_err(failed)?;
    if place.fingerprint != fingerprint {
        return Err(CannotGoOn::Foreign(folder.to_owned()));
    }
    let last = place.solved.as_ref().map(|solved| saved.last(solved)).transpose().map_err(failed)?;
    let changes = saved.array("changes").map_err(failed)?;
    let (path, coarser) = (folder.join(steps_log::NAME), folder.join(COARSER).join(steps_log::NAME));
    let own = if disk::is_file(&path) { steps(&path)? } else { Vec::new() };
    // The steps of the grid before move aside after the finer one has been saved as begun.
    let (mut own, before) = match own.first() {
        Some(step) if step.points != place.points => (Vec::new(), Some(own)),
        _ => (own, None),
    };
    let coarser = place.refined.then(|| before.map_or_else(|| steps(&coarser), Ok)).transpose()?;
    let count = place.steps.saturating_sub(1);
    if own.len() < count {
        return Err(CannotGoOn::Unreadable { path, reason: format!("it has {} of {count} steps", own.len()) });
    }
    own.truncate(count);
    Ok(Some(Finished { points: place.points, changes, coarser, steps: own, last }))
}

/// The steps of a log.
fn steps(path: &Path) -> Result<Vec<StepRecord>, CannotGoOn> {
    let failed = |reason: String| CannotGoOn::Unreadable { path: path.to_owned(), reason };
    let lines = steps_log::whole_lines(path).map_err(|error| failed(error.to_string()))?;
    let step = |line: &String| -> Result<StepRecord, String> {
        let value = serde_json::from_str(line).map_err(|error| error.to_string())?;
        recorded::step(&value).map_err(|error: Unreadable| error.to_string())
    };
    lines.iter().map(step).collect::<Result<_, _>>().map_err(failed)
}

/// A checkpoint that is read back.
struct Saved<R>(ZipArchive<R>);

impl Saved<BufReader<File>> {
    fn open(path: &Path) -> io::Result<Self> {
        Ok(Self(ZipArchive::new(BufReader::new(disk::open(path)?))?))
    }
}

impl<R: Read + Seek> Saved<R> {
    fn place<T: DeserializeOwned>(&mut self) -> io::Result<T> {
        Ok(serde_json::from_reader(self.0.by_name(PLACE)?)?)
    }

    fn array(&mut self, name: &str) -> io::Result<Vec<f64>> {
        let mut entry = self.0.by_name(&format!("{name}.npy"))?;
        let values = values(&mut entry)?;
        // At its end the checksum is looked at.
        io::copy(&mut entry, &mut io::sink())?;
        Ok(values)
    }

    fn numbers<const N: usize>(&mut self, name: &str) -> io::Result<[f64; N]> {
        self.array(name)?.try_into().map_err(|_| unlike(format!("`{name}` has another length")))
    }

    fn last(&mut self, solved: &Solved) -> io::Result<Last> {
        let [convolutions, residual, seconds] = self.numbers("numbers")?;
        let unknown = || unlike(format!("`{}` by `{}` is no end of an iteration", solved.stop, solved.route));
        let stop = Stop::ALL.into_iter().find(|stop| stop.to_string() == solved.stop).ok_or_else(unknown)?;
        let route = recorded::route(&solved.route, solved.trials).ok_or_else(unknown)?;
        let report = Report { stop, route, iterations: solved.iterations, outer: solved.outer, residual };
        let grids = (0..solved.grids).map(|index| self.unknowns(index)).collect::<io::Result<_>>()?;
        let checkpoint = Checkpoint { report, convolutions, coarser: solved.coarser, grids };
        Ok(Last { checkpoint, seconds })
    }

    fn unknowns(&mut self, index: usize) -> io::Result<Unknowns> {
        let [penetration, energy_gap, deepest, load] = self.numbers(&format!("proof_{index}"))?;
        Ok(Unknowns {
            pressure: Arc::new(self.array(&format!("pressure_{index}"))?),
            gap: Arc::new(self.array(&format!("gap_{index}"))?),
            penetration,
            certificate: Certificate { energy_gap, penetration: deepest, load },
        })
    }
}

fn unlike(reason: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, embedded};
    use crate::spectral::Solver;
    use std::io::Cursor;

    /// What was kept gives the step again: its fields, how it was solved, and the coarser grids that errors are read from.
    #[test]
    fn a_checkpoint_alone_gives_its_step_again() {
        let case = Case::read(&embedded::source("fig2").unwrap(), &["grid.points=96".to_owned()]).unwrap();
        let solver = || Solver::new(Arc::clone(case.problem()), [96, 96], case.solver).unwrap();
        let (load, mut first) = (case.load.loads()[0], solver());
        let step = first.solve(load);
        let mut bytes = Cursor::new(Vec::new());
        write_checkpoint(&mut bytes, &first.checkpoint(&step)).unwrap();
        let read = |bytes: &[u8]| read_checkpoint(Cursor::new(bytes));
        let again = solver().restore(load, read(bytes.get_ref()).unwrap()).unwrap();
        assert_eq!((again.pressure(), again.gap()), (step.pressure(), step.gap()));
        assert_eq!((again.report, again.certificate), (step.report, step.certificate));
        assert_eq!((again.reading(), again.coarser().len()), (step.reading(), step.coarser().len()));

        let mut spoilt = bytes.get_ref().clone();
        spoilt[bytes.get_ref().len() / 2] ^= 1;
        assert!(read(&spoilt).is_err(), "a checksum tells");
        assert!(read(&bytes.get_ref()[..1000]).is_err());
    }
}

//! `checkpoint.npz`: the state of the solver after the last saved load of an unfinished run, and the position in the run.
//!
//! The next checkpoint replaces it in one move. It is written before its step is read. Checkpoints take a small part of the time
//! of a run; loads solved since the last one are solved again when the run is resumed.

use super::npy::vector;
use super::npz::Archive;
use super::{OutputError, disk, write_file};
use percoat_core::run::{EarlierRun, LastLoad};
use percoat_core::spectral::{Certificate, Checkpoint, Report, Route, Stop, Unknowns};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};
use zip::ZipArchive;

/// Name of the file.
pub(super) const NAME: &str = "checkpoint.npz";
/// Entry of the archive with the position in the run.
const POSITION: &str = "place.json";
/// Least time between two checkpoints, as a multiple of the time of writing one.
const SHARE: u32 = 20;

/// The position of a checkpoint in its run.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct RunPosition {
    /// [Fingerprint](super::fingerprint) of the run.
    pub(super) fingerprint: String,
    /// The grid.
    pub(super) points: [usize; 2],
    /// Whether all steps are solved on a coarser one.
    pub(super) refined: bool,
    /// Number of loads solved on it.
    pub(super) steps: usize,
    /// How the last of them was solved; `None` where there is none.
    solved: Option<SolvedLoad>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
struct SolvedLoad {
    stop: Stop,
    #[serde(flatten)]
    route: Route,
    iterations: usize,
    outer: usize,
    /// Number of coarser grids that the step keeps.
    coarser: usize,
    /// Number of all grids in the file.
    grids: usize,
    /// Number of grids with depths that earlier loads have pressed in: all, or none.
    #[serde(default)]
    indented: usize,
}

/// Saves the checkpoints of a run.
#[derive(Debug)]
pub(super) struct Checkpoints {
    pub(super) fingerprint: String,
    /// Number of all loads.
    loads: usize,
    /// The present grid; `None` before the first.
    points: Option<[usize; 2]>,
    /// Whether all steps are solved on a coarser one.
    refined: bool,
    /// Changes of the readings from each grid to the next one.
    pub(super) changes: Vec<f64>,
    /// When the run began.
    began: Instant,
    /// When the last checkpoint was written, and how long that took.
    written: Option<(Instant, Duration)>,
}

impl Checkpoints {
    /// Checkpoints of a run with `loads` loads, which resumes an `earlier` one.
    pub(super) fn new(fingerprint: String, loads: usize, earlier: Option<&EarlierRun>) -> Self {
        Self {
            fingerprint,
            loads,
            points: earlier.map(|earlier| earlier.points),
            refined: earlier.is_some_and(|earlier| earlier.coarser.is_some()),
            changes: earlier.map_or(Vec::new(), |earlier| earlier.changes.clone()),
            began: Instant::now(),
            written: None,
        }
    }

    /// Begins a grid. The position at the beginning of a finer one is saved.
    pub(super) fn begin(&mut self, folder: &Path, points: [usize; 2]) -> Result<(), OutputError> {
        if self.points.replace(points).is_some_and(|before| before != points) {
            self.refined = true;
            self.write(folder, 0, None)?;
            // A log without a checkpoint of its grid is that of the grid before: the first step is saved before it is logged.
            self.written = None;
        }
        Ok(())
    }

    /// Saves the state of the solver after a step (number from 1) and the wall time of its load, unless the last checkpoint is
    /// recent. The first and the last step on a grid are always saved, except in a short run of one load on one grid.
    pub(super) fn save(&mut self, folder: &Path, steps: usize, last: (&Checkpoint, f64)) -> Result<(), OutputError> {
        let soon = |(when, took): (Instant, Duration)| when.elapsed() < SHARE * took;
        // A run killed while its archives are gathered is resumed from the last of several steps.
        let skipped = match self.written {
            Some(written) => steps < self.loads && soon(written),
            None => self.loads == 1 && !self.refined && soon((self.began, foreseen(last.0))),
        };
        if skipped { Ok(()) } else { self.write(folder, steps, Some(last)) }
    }

    fn write(&mut self, folder: &Path, steps: usize, last: Option<(&Checkpoint, f64)>) -> Result<(), OutputError> {
        let began = Instant::now();
        let position = RunPosition {
            fingerprint: self.fingerprint.clone(),
            points: self.points.expect("a grid is begun before its loads"),
            refined: self.refined,
            steps,
            solved: last.map(|(checkpoint, _)| SolvedLoad::of(checkpoint)),
        };
        let position = serde_json::to_string(&position).expect("a position is numbers and texts under names");
        write_file(&folder.join(NAME), |writer| {
            let mut archive = Archive::new(writer);
            archive.text(POSITION, &position)?;
            archive.array("changes", &[self.changes.len()], self.changes.iter().copied())?;
            last.map_or(Ok(()), |(checkpoint, seconds)| add(&mut archive, checkpoint, seconds))?;
            archive.finish()
        })?;
        self.written = Some((Instant::now(), began.elapsed()));
        Ok(())
    }
}

impl SolvedLoad {
    fn of(checkpoint: &Checkpoint) -> Self {
        let Report { stop, route, iterations, outer, .. } = checkpoint.report;
        let (coarser, grids) = (checkpoint.coarser, checkpoint.grids.len());
        Self { stop, route, iterations, outer, coarser, grids, indented: checkpoint.indented.len() }
    }
}

/// Adds the numbers and fields of a checkpoint; `seconds` is the wall time of its load.
fn add<W: Write + Seek>(archive: &mut Archive<W>, checkpoint: &Checkpoint, seconds: f64) -> io::Result<()> {
    archive.array("numbers", &[3], [checkpoint.convolutions, checkpoint.report.residual, seconds])?;
    for (index, depths) in checkpoint.indented.iter().enumerate() {
        archive.array(&format!("indentation_{index}"), &[depths.len()], depths.iter().copied())?;
    }
    for (index, Unknowns { pressure, gap, penetration, certificate }) in checkpoint.grids.iter().enumerate() {
        let Certificate { energy_gap, penetration: deepest, load } = *certificate;
        archive.array(&format!("proof_{index}"), &[4], [*penetration, energy_gap, deepest, load])?;
        archive.array(&format!("pressure_{index}"), &[pressure.len()], pressure.iter().copied())?;
        archive.array(&format!("gap_{index}"), &[gap.len()], gap.iter().copied())?;
    }
    Ok(())
}

/// Writes a checkpoint as an `.npz` archive; [`Solver::restore`](percoat_core::Solver::restore) returns its step.
///
/// # Errors
/// Errors of the writer.
pub fn write_checkpoint(writer: impl Write + Seek, checkpoint: &Checkpoint) -> io::Result<()> {
    let solved = serde_json::to_string(&SolvedLoad::of(checkpoint)).expect("numbers and texts under names");
    let mut archive = Archive::new(writer);
    archive.text(POSITION, &solved)?;
    add(&mut archive, checkpoint, 0.0)?;
    archive.finish()
}

/// Reads a checkpoint written by [`write_checkpoint`].
///
/// # Errors
/// Errors of the reader, and [`io::ErrorKind::InvalidData`] for anything but a checkpoint.
pub fn read_checkpoint(reader: impl Read + Seek) -> io::Result<Checkpoint> {
    let mut saved = CheckpointReader::new(reader)?;
    let solved: SolvedLoad = saved.place()?;
    saved.has_only(1, Some(&solved))?;
    Ok(saved.last(&solved)?.checkpoint)
}

/// The checkpoint of a run: its position, the changes from grid to grid, and the last load.
pub(super) fn read(path: &Path) -> io::Result<(RunPosition, Vec<f64>, Option<LastLoad>)> {
    let mut saved = CheckpointReader::new(BufReader::new(disk::open(path)?))?;
    let place: RunPosition = saved.place()?;
    saved.has_only(2, place.solved.as_ref())?;
    let changes = saved.array("changes", true)?;
    let last = place.solved.as_ref().map(|solved| saved.last(solved)).transpose()?;
    Ok((place, changes, last))
}

/// Estimated time of writing a checkpoint on a disk of ordinary speed.
fn foreseen(last: &Checkpoint) -> Duration {
    const BYTES_PER_SECOND: f64 = 1e9;
    let samples: usize = last.grids.iter().map(|grid| grid.pressure.len()).sum();
    Duration::from_secs_f64(16.0 * samples as f64 / BYTES_PER_SECOND)
}

/// Reader of a checkpoint; every entry is read to its end, where `zip` compares its checksum.
struct CheckpointReader<R> {
    zip: ZipArchive<R>,
    /// Length of the file, bytes: no entry is longer.
    bytes: u64,
}

impl<R: Read + Seek> CheckpointReader<R> {
    fn new(mut reader: R) -> io::Result<Self> {
        let bytes = reader.seek(SeekFrom::End(0))?;
        reader.rewind()?;
        let zip = ZipArchive::new(reader)?;
        if zip.has_duplicate_names() {
            return Err(unlike("it has two entries of one name".to_owned()));
        }
        Ok(Self { zip, bytes })
    }

    /// Refuses an archive whose number of entries is not `others` beside those of a solved load.
    fn has_only(&self, others: usize, solved: Option<&SolvedLoad>) -> io::Result<()> {
        const OF_A_GRID: usize = 3;
        let of = |solved: &SolvedLoad| {
            solved.grids.saturating_mul(OF_A_GRID).saturating_add(solved.indented.saturating_add(1))
        };
        let (found, wanted) = (self.zip.len(), solved.map_or(0, of).saturating_add(others));
        if found == wanted { Ok(()) } else { Err(unlike(format!("it has {found} entries instead of {wanted}"))) }
    }

    fn entry<'a>(&'a mut self, name: &str) -> io::Result<(u64, impl Read + use<'a, R>)> {
        let most = self.bytes;
        let entry = self.zip.by_name(name).map_err(|error| unlike(format!("its entry `{name}`: {error}")))?;
        let bytes = entry.size();
        if bytes > most || entry.compressed_size() != bytes {
            return Err(unlike(format!("its entry `{name}` has a wrong length of {bytes} bytes")));
        }
        Ok((bytes, entry))
    }

    fn place<T: DeserializeOwned>(&mut self) -> io::Result<T> {
        let (_, mut entry) = self.entry(POSITION)?;
        let mut text = String::new();
        entry.read_to_string(&mut text)?;
        Ok(serde_json::from_str(&text)?)
    }

    /// The numbers of an array; `finite`: whether to refuse infinite ones, which only an iteration that was not solved leaves.
    fn array(&mut self, name: &str, finite: bool) -> io::Result<Vec<f64>> {
        let (bytes, entry) = self.entry(&format!("{name}.npy"))?;
        let values = vector(entry, bytes).map_err(|error| unlike(format!("its entry `{name}.npy`: {error}")))?;
        match values.iter().position(|value| finite && !value.is_finite()) {
            Some(at) => Err(unlike(format!("value {} of its entry `{name}.npy` is not a number", at + 1))),
            None => Ok(values),
        }
    }

    /// The numbers of an array of pressures or depths, none below zero.
    fn sizes(&mut self, name: &str, finite: bool) -> io::Result<Vec<f64>> {
        let values = self.array(name, finite)?;
        match values.iter().position(|value| *value < 0.0) {
            Some(at) => Err(unlike(format!("value {} of its entry `{name}.npy` is negative", at + 1))),
            None => Ok(values),
        }
    }

    fn numbers<const N: usize>(&mut self, name: &str, finite: bool) -> io::Result<[f64; N]> {
        self.array(name, finite)?.try_into().map_err(|_| unlike(format!("its entry `{name}.npy` has another length")))
    }

    fn last(&mut self, solved: &SolvedLoad) -> io::Result<LastLoad> {
        let SolvedLoad { stop, route, .. } = *solved;
        let finite = stop.solved();
        let [convolutions, residual, seconds] = self.numbers("numbers", finite)?;
        let report = Report { stop, route, iterations: solved.iterations, outer: solved.outer, residual };
        if convolutions < 0.0 || seconds < 0.0 {
            return Err(unlike("a count or a time in it is negative".to_owned()));
        }
        let grids = (0..solved.grids).map(|index| self.unknowns(index, finite)).collect::<io::Result<_>>()?;
        let indented =
            (0..solved.indented).map(|index| self.sizes(&format!("indentation_{index}"), true).map(Arc::new));
        let indented = indented.collect::<io::Result<_>>()?;
        let checkpoint = Checkpoint { report, convolutions, coarser: solved.coarser, grids, indented };
        Ok(LastLoad { checkpoint, seconds })
    }

    fn unknowns(&mut self, index: usize, finite: bool) -> io::Result<Unknowns> {
        let [penetration, energy_gap, deepest, load] = self.numbers(&format!("proof_{index}"), finite)?;
        Ok(Unknowns {
            pressure: Arc::new(self.sizes(&format!("pressure_{index}"), finite)?),
            gap: Arc::new(self.array(&format!("gap_{index}"), finite)?),
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
    use percoat_case::case::{Case, embedded};
    use percoat_core::spectral::Solver;
    use std::io::Cursor;

    /// A step restored from its checkpoint has its fields, its report and the coarser grids of the error estimates.
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
        assert!(read(&spoilt).is_err(), "a checksum differs");
        assert!(read(&bytes.get_ref()[..1000]).is_err());
    }
}

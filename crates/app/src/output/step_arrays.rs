//! Arrays that grow by one entry a load step, gathered in an `.npz` archive at the end.
//!
//! Until then each entry is a `.npy` file in `<archive>.partial/`, readable by NumPy.

use super::checksum::Checksum;
use super::draft::Draft;
use super::error::AtPath;
use super::layout::{archive, partial};
use super::npy::{complete, header, npy, values};
use super::npz::Archive;
use super::staging::remove_own;
use super::{Files, OutputError, disk, make_folder, write_file};
use percoat_common::plain;
use std::fs;
use std::io::{self, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Arrays of the load steps so far, one file an entry, and their archive.
#[derive(Debug)]
pub(super) struct StepArrays {
    folder: PathBuf,
    name: &'static str,
    arrays: Vec<StepArray>,
    steps: usize,
    /// Files of the present step so far, by their names in the folder.
    left: Files,
}

/// An array, and the entry that each step adds to it.
#[derive(Debug)]
struct StepArray {
    array: String,
    /// Shape of an entry, or of each part of it.
    shape: Vec<usize>,
    /// Number of equal parts of an entry, written one after the other; none: it is written whole.
    parts: Option<usize>,
}

/// A part of a step's entry of an array, under construction.
#[derive(Debug)]
pub(super) struct GrowingEntry {
    file: Draft,
    path: PathBuf,
    sum: Checksum,
    shape: Vec<usize>,
    count: usize,
}

impl StepArrays {
    /// The archive `<name>.npz` in a staging folder after the first `steps` load steps of an interrupted run, which are
    /// [checked](super::finished::finished) before; none in a new run.
    pub(super) fn new(folder: &Path, name: &'static str, steps: usize) -> Result<Self, OutputError> {
        let arrays = Self { folder: folder.to_owned(), name, arrays: Vec::new(), steps, left: Files::default() };
        make_folder(&arrays.partial())?;
        Ok(arrays)
    }

    fn archive(&self) -> PathBuf {
        self.folder.join(archive(self.name))
    }

    fn partial(&self) -> PathBuf {
        self.folder.join(partial(self.name))
    }

    /// The file of the entry of `step` (from 1) of an array, or of a part (from 1) of it.
    fn waiting(&self, array: &str, step: usize, part: Option<usize>) -> PathBuf {
        let part = part.map_or(String::new(), |part| format!(".{part:03}"));
        self.partial().join(format!("{array}.{step:04}{part}.npy"))
    }

    /// Begins the next load step: its number, from 1.
    pub(super) fn next_step(&mut self) -> usize {
        self.steps += 1;
        self.steps
    }

    /// Writes the present step's entry of an array. Every step must have the same arrays with the same shapes.
    pub(super) fn add(
        &mut self,
        array: &str,
        shape: &[usize],
        values: impl IntoIterator<Item = f64>,
    ) -> Result<(), OutputError> {
        self.enter(array, None, shape);
        let (path, mut sum) = (self.waiting(array, self.steps, None), Checksum::default());
        write_file(&path, |writer| npy(sum.through(writer), shape, values))?;
        self.leave(&path, sum);
        Ok(())
    }

    /// Begins the next `part` (from 1) of the present step's entry of an array, whose values are added piece by piece; parts become
    /// its first axis.
    pub(super) fn begin(&mut self, array: &str, part: usize, shape: &[usize]) -> Result<GrowingEntry, OutputError> {
        self.enter(array, Some(part), shape);
        let (path, mut sum) = (self.waiting(array, self.steps, Some(part)), Checksum::default());
        let mut file = Draft::new(&path)?;
        file.write(|writer| header::<f64>(sum.through(writer), shape))?;
        Ok(GrowingEntry { file, path, sum, shape: shape.to_vec(), count: 0 })
    }

    /// Ends an entry; an error where values are missing.
    pub(super) fn end(&mut self, entry: GrowingEntry) -> Result<(), OutputError> {
        let GrowingEntry { mut file, path, sum, shape, count } = entry;
        file.write(|_| complete(&shape, count))?;
        file.keep()?;
        self.leave(&path, sum);
        Ok(())
    }

    fn leave(&mut self, path: &Path, sum: Checksum) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        self.left.add(format!("{}.partial/{name}", self.name), sum);
    }

    /// Files of the present step, with their checksums.
    pub(super) fn left(&mut self) -> Files {
        std::mem::take(&mut self.left)
    }

    fn enter(&mut self, array: &str, part: Option<usize>, shape: &[usize]) {
        match self.arrays.iter_mut().find(|entry| entry.array == array) {
            Some(entry) => entry.parts = entry.parts.max(part),
            None => self.arrays.push(StepArray { array: array.to_owned(), shape: shape.to_vec(), parts: part }),
        }
    }

    /// Syncs the names of the present step's entries to the disk; their content is synced already.
    pub(super) fn sync(&self) -> Result<(), OutputError> {
        let partial = self.partial();
        disk::sync_folder(&partial).at(&partial)
    }

    /// Gathers all steps in the archive, after the arrays that `constants` adds; on failure the files of the entries stay.
    pub(super) fn finish(
        self,
        constants: impl FnOnce(&mut Archive<&mut BufWriter<fs::File>>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        write_file(&self.archive(), |writer| {
            let mut archive = Archive::new(writer);
            constants(&mut archive)?;
            for StepArray { array, shape, parts } in &self.arrays {
                let numbers: Vec<Option<usize>> = parts.map_or(vec![None], |parts| (1..=parts).map(Some).collect());
                let files = (1..=self.steps)
                    .flat_map(|step| numbers.iter().map(move |&part| (step, part)))
                    .map(|(step, part)| self.waiting(array, step, part));
                let mut failure = None;
                let values = files.flat_map(|file| {
                    read(&file, shape).unwrap_or_else(|error| {
                        failure = Some(error);
                        Vec::new()
                    })
                });
                let shape: Vec<usize> = [self.steps].into_iter().chain(*parts).chain(shape.iter().copied()).collect();
                archive.array(array, &shape, values).map_err(|error| failure.unwrap_or(error))?;
            }
            archive.finish()
        })?;
        // The archive is on the disk before its entries are removed.
        disk::sync_folder(&self.folder).at(&self.folder)?;
        remove_own(&self.folder, &partial(self.name)).map(|_| ())
    }
}

impl GrowingEntry {
    /// Adds the next values.
    pub(super) fn add(&mut self, values: &[f64]) -> Result<(), OutputError> {
        self.count += values.len();
        let Self { file, sum, .. } = self;
        file.write(|writer| sum.through(writer).write_all(bytemuck::cast_slice(values)))
    }
}

/// Reads the values of an entry of this shape; an error names its file.
fn read(path: &Path, shape: &[usize]) -> io::Result<Vec<f64>> {
    let read = disk::open(path).and_then(|file| values(BufReader::new(file), shape));
    read.map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", plain::path(path))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_that_is_given_up_or_not_whole_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let mut arrays = StepArrays::new(folder.path(), "some", 0).unwrap();
        arrays.next_step();
        let partial = folder.path().join("some.partial");
        let files = || fs::read_dir(&partial).unwrap().count();
        for finished in [false, true] {
            let mut entry = arrays.begin("a", 1, &[2, 3]).unwrap();
            entry.add(&[1.0, 2.0, 3.0]).unwrap();
            assert_eq!(files(), 1);
            if finished {
                assert!(arrays.end(entry).unwrap_err().to_string().contains("3 values"));
            } else {
                drop(entry);
            }
            assert_eq!(files(), 0);
        }
        let mut entry = arrays.begin("a", 1, &[2, 3]).unwrap();
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]].iter().for_each(|row| entry.add(row).unwrap());
        arrays.end(entry).unwrap();
        assert_eq!(read(&partial.join("a.0001.001.npy"), &[2, 3]).unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let left = arrays.left();
        assert_eq!(left.names().collect::<Vec<_>>(), ["some.partial/a.0001.001.npy"]);
        assert_eq!(left.damaged(folder.path()), None, "what is added while it is written is what stands there");
    }
}

//! Arrays that grow by one entry a load step, gathered in an `.npz` archive at the end.
//!
//! Until then the entries stand as one `.npy` file a step in `<archive>.partial/`, where NumPy reads them too.

use super::gathered::remove_waiting;
use super::layout::names;
use super::npz::{Archive, complete, header, npy, values};
use super::{Draft, OutputError, disk, make_folder, write_file};
use std::fs;
use std::io::{self, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

/// An archive that is being gathered on disk.
#[derive(Debug)]
pub(super) struct StepArrays {
    folder: PathBuf,
    name: &'static str,
    arrays: Vec<Entry>,
    steps: usize,
}

/// What each step adds to an array.
#[derive(Debug)]
struct Entry {
    array: String,
    /// Shape of the entry without its parts.
    shape: Vec<usize>,
    /// Number of equal parts it comes in, one after the other; none: it comes whole.
    parts: Option<usize>,
}

/// A part of a step's entry of an array, that is being written.
#[derive(Debug)]
pub(super) struct GrowingEntry {
    file: Draft,
    shape: Vec<usize>,
    count: usize,
}

impl StepArrays {
    /// Nothing yet of the archive `<name>.npz` in `folder`, where the result is gathered. Refused when `<name>.partial/` is
    /// there already, whoever made it.
    pub(super) fn new(folder: &Path, name: &'static str) -> Result<Self, OutputError> {
        let arrays = Self { folder: folder.to_owned(), name, arrays: Vec::new(), steps: 0 };
        let partial = arrays.partial();
        make_folder(folder)?;
        disk::create_folder(&partial).map_err(|error| OutputError::new(&partial, error))?;
        Ok(arrays)
    }

    /// The same where an earlier run has left the entries of so many `steps` at least; one more is still to come, the `last`
    /// of all or another. `None` where that run had come to the last and has gathered the archive.
    pub(super) fn go_on(
        folder: &Path,
        name: &'static str,
        steps: usize,
        last: bool,
    ) -> Result<Option<Self>, OutputError> {
        let arrays = Self { folder: folder.to_owned(), name, arrays: Vec::new(), steps };
        let partial = arrays.partial();
        if last && disk::is_file(&arrays.archive()) {
            remove_waiting(&partial)?;
            return Ok(None);
        }
        make_folder(&partial)?;
        let there = names(&partial)?;
        let gone = (1..=steps).find(|step| !there.iter().any(|name| name.contains(&format!(".{step:04}."))));
        match gone {
            // Where no step has left anything, none had to.
            Some(step) if !there.is_empty() => {
                let error = io::Error::other(format!("what step {step} has left there is gone; leave --resume out"));
                Err(OutputError::new(&partial, error))
            }
            _ => Ok(Some(arrays)),
        }
    }

    fn archive(&self) -> PathBuf {
        self.folder.join(format!("{}.npz", self.name))
    }

    fn partial(&self) -> PathBuf {
        self.folder.join(format!("{}.partial", self.name))
    }

    /// Where the entry of an array for a step (from 1), or a part of it (from 1), waits.
    fn waiting(&self, array: &str, step: usize, part: Option<usize>) -> PathBuf {
        let part = part.map_or(String::new(), |part| format!(".{part:03}"));
        self.partial().join(format!("{array}.{step:04}{part}.npy"))
    }

    /// Begins the next load step: its number, from 1.
    pub(super) fn next_step(&mut self) -> usize {
        self.steps += 1;
        self.steps
    }

    /// Puts the present step's entry of an array on disk. Every step has the same arrays of the same shapes.
    pub(super) fn add(
        &mut self,
        array: &str,
        shape: &[usize],
        values: impl IntoIterator<Item = f64>,
    ) -> Result<(), OutputError> {
        self.enter(array, None, shape);
        write_file(&self.waiting(array, self.steps, None), |writer| npy(writer, shape, values))
    }

    /// Begins the next `part` (from 1) of the present step's entry of an array, its values to come piece by piece: parts
    /// become its first axis.
    pub(super) fn begin(&mut self, array: &str, part: usize, shape: &[usize]) -> Result<GrowingEntry, OutputError> {
        self.enter(array, Some(part), shape);
        let mut file = Draft::new(&self.waiting(array, self.steps, Some(part)))?;
        file.write(|writer| header::<f64>(writer, shape))?;
        Ok(GrowingEntry { file, shape: shape.to_vec(), count: 0 })
    }

    fn enter(&mut self, array: &str, part: Option<usize>, shape: &[usize]) {
        match self.arrays.iter_mut().find(|entry| entry.array == array) {
            Some(entry) => entry.parts = entry.parts.max(part),
            None => self.arrays.push(Entry { array: array.to_owned(), shape: shape.to_vec(), parts: part }),
        }
    }

    /// Brings the names of the present step's entries to the disk, where their content is.
    pub(super) fn sync(&self) -> Result<(), OutputError> {
        let partial = self.partial();
        disk::sync_folder(&partial).map_err(|error| OutputError::new(&partial, error))
    }

    /// Gathers all steps in the archive, after the arrays that `constants` adds; the waiting files stay if that fails.
    pub(super) fn finish(
        self,
        constants: impl FnOnce(&mut Archive<&mut BufWriter<fs::File>>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        write_file(&self.archive(), |writer| {
            let mut archive = Archive::new(writer);
            constants(&mut archive)?;
            for Entry { array, shape, parts } in &self.arrays {
                let numbers: Vec<Option<usize>> = parts.map_or(vec![None], |parts| (1..=parts).map(Some).collect());
                let files = (1..=self.steps)
                    .flat_map(|step| numbers.iter().map(move |&part| (step, part)))
                    .map(|(step, part)| self.waiting(array, step, part));
                let mut failure = None;
                let values = files.flat_map(|file| {
                    read(&file).unwrap_or_else(|error| {
                        failure = Some(error);
                        Vec::new()
                    })
                });
                let shape: Vec<usize> = [self.steps].into_iter().chain(*parts).chain(shape.iter().copied()).collect();
                archive.array(array, &shape, values).map_err(|error| failure.unwrap_or(error))?;
            }
            archive.finish()
        })?;
        // The archive has its name before what it is made of goes.
        disk::sync_folder(&self.folder).map_err(|error| OutputError::new(&self.folder, error))?;
        remove_waiting(&self.partial()).map(|_| ())
    }
}

impl GrowingEntry {
    /// Adds the next values.
    pub(super) fn add(&mut self, values: &[f64]) -> Result<(), OutputError> {
        self.count += values.len();
        self.file.write(|writer| writer.write_all(bytemuck::cast_slice(values)))
    }

    /// All values are there.
    pub(super) fn finish(mut self) -> Result<(), OutputError> {
        self.file.write(|_| complete(&self.shape, self.count))?;
        self.file.keep()
    }
}

fn read(path: &Path) -> io::Result<Vec<f64>> {
    values(BufReader::new(disk::open(path)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_that_is_given_up_or_not_whole_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let mut arrays = StepArrays::new(folder.path(), "some").unwrap();
        arrays.next_step();
        let partial = folder.path().join("some.partial");
        let files = || fs::read_dir(&partial).unwrap().count();
        for finished in [false, true] {
            let mut entry = arrays.begin("a", 1, &[2, 3]).unwrap();
            entry.add(&[1.0, 2.0, 3.0]).unwrap();
            assert_eq!(files(), 1);
            if finished {
                assert!(entry.finish().unwrap_err().to_string().contains("3 values"));
            } else {
                drop(entry);
            }
            assert_eq!(files(), 0);
        }
        let mut entry = arrays.begin("a", 1, &[2, 3]).unwrap();
        [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]].iter().for_each(|row| entry.add(row).unwrap());
        entry.finish().unwrap();
        assert_eq!(read(&partial.join("a.0001.001.npy")).unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }
}

//! `contact.npz`: the fields of every load step.

use super::npz::{Archive, npy};
use super::{OutputError, make_folder, write_file};
use crate::grid::Grid;
use crate::hierarchy::Solution;
use crate::texture::Texture;
use std::fs;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

const NAMES: [&str; 3] = ["pressure", "displacement", "gap"];

/// Fields of the load steps solved so far, kept on disk.
#[derive(Debug)]
pub struct Fields {
    folder: PathBuf,
    mean_pressure: Vec<f64>,
    penetration: Vec<f64>,
}

impl Fields {
    /// No steps yet; `folder` is the output folder. What an earlier run left unfinished there is removed.
    ///
    /// # Errors
    /// [`OutputError`] when the folder cannot be made or cleared.
    pub fn new(folder: &Path) -> Result<Self, OutputError> {
        let fields = Self { folder: folder.to_owned(), mean_pressure: Vec::new(), penetration: Vec::new() };
        let partial = fields.partial();
        if partial.exists() {
            fs::remove_dir_all(&partial).map_err(|error| OutputError::new(&partial, error))?;
        }
        make_folder(&partial)?;
        Ok(fields)
    }

    fn partial(&self) -> PathBuf {
        self.folder.join("contact.partial")
    }

    /// Where a field of a step (from 1) waits.
    fn waiting(&self, name: &str, step: usize) -> PathBuf {
        self.partial().join(format!("{name}.{step:04}.npy"))
    }

    /// Puts the fields of the next step on disk.
    ///
    /// # Errors
    /// [`OutputError`] when one cannot be written.
    pub fn add(&mut self, grid: &Grid, mean_pressure: f64, solution: &Solution) -> Result<(), OutputError> {
        self.mean_pressure.push(mean_pressure);
        self.penetration.push(solution.penetration);
        let fields = [&solution.pressure, &solution.displacement, &solution.gap];
        for (name, field) in NAMES.into_iter().zip(fields) {
            let path = self.waiting(name, self.mean_pressure.len());
            write_file(&path, |writer| npy(writer, &grid.points(), field.iter().copied()))?;
        }
        Ok(())
    }

    /// Gathers all steps in `contact.npz`.
    ///
    /// # Errors
    /// [`OutputError`] when the archive cannot be written; the waiting files then stay.
    pub fn finish(self, grid: &Grid, texture: &Texture) -> Result<(), OutputError> {
        write_file(&self.folder.join("contact.npz"), |writer| self.gather(grid, texture, writer))?;
        let partial = self.partial();
        fs::remove_dir_all(&partial).map_err(|error| OutputError::new(&partial, error))
    }

    fn gather(&self, grid: &Grid, texture: &Texture, writer: impl io::Write + io::Seek) -> io::Result<()> {
        let [n1, n2] = grid.points();
        let steps = self.mean_pressure.len();
        let position = |axis: usize| (0..grid.len()).map(move |i| grid.cell().point(grid.fractions(i))[axis]);
        let mut archive = Archive::new(writer);
        let [a1, a2] = grid.cell().vectors();
        archive.array("a1", &[2], a1)?;
        archive.array("a2", &[2], a2)?;
        archive.array("x", &[n1, n2], position(0))?;
        archive.array("y", &[n1, n2], position(1))?;
        archive.array("mean_pressure", &[steps], self.mean_pressure.iter().copied())?;
        archive.array("penetration", &[steps], self.penetration.iter().copied())?;
        let level = |index: usize| texture.owner.get(index).map_or(0, |&o| texture.sites[o as usize].level as i32);
        archive.array("owner", &[n1, n2], (0..grid.len()).map(level))?;
        for name in NAMES {
            let mut failure = None;
            let values = (1..=steps).flat_map(|step| {
                read(&self.waiting(name, step)).unwrap_or_else(|error| {
                    failure = Some(error);
                    Vec::new()
                })
            });
            archive.array(name, &[steps, n1, n2], values).map_err(|error| failure.unwrap_or(error))?;
        }
        archive.finish()
    }
}

fn read(path: &Path) -> io::Result<Vec<f64>> {
    npyz::NpyFile::new(BufReader::new(fs::File::open(path)?))?.into_vec()
}

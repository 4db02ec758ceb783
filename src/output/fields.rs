//! `contact.npz`: the fields of every load step.

use super::{OutputError, StepArrays};
use crate::grid::Grid;
use crate::hierarchy::Solution;
use crate::texture::Texture;
use std::path::Path;

/// Fields of the load steps solved so far, kept on disk.
#[derive(Debug)]
pub struct Fields(StepArrays);

impl Fields {
    /// No steps yet; `folder` is where the result is gathered.
    ///
    /// # Errors
    /// [`OutputError`] when there are fields already, or no room for them.
    pub fn new(folder: &Path) -> Result<Self, OutputError> {
        Ok(Self(StepArrays::new(folder, "contact")?))
    }

    /// Puts the fields of the next step on disk.
    ///
    /// # Errors
    /// [`OutputError`] when one cannot be written.
    pub fn add(&mut self, grid: &Grid, mean_pressure: f64, solution: &Solution) -> Result<(), OutputError> {
        self.0.next_step();
        self.0.add("mean_pressure", &[], [mean_pressure])?;
        self.0.add("penetration", &[], [solution.penetration])?;
        self.0.add("pressure", &grid.points(), solution.pressure.iter().copied())?;
        self.0.add("displacement", &grid.points(), solution.displacement.iter().copied())?;
        self.0.add("gap", &grid.points(), solution.gap.iter().copied())
    }

    /// Gathers all steps in `contact.npz`.
    ///
    /// # Errors
    /// [`OutputError`] when the archive cannot be written; what waits then stays.
    pub fn finish(self, grid: &Grid, texture: &Texture) -> Result<(), OutputError> {
        let points = grid.points();
        let position = |axis: usize| (0..grid.len()).map(move |i| grid.cell().point(grid.fractions(i))[axis]);
        let level = |index: usize| texture.owner.get(index).map_or(0, |&o| texture.sites[o as usize].level as i32);
        self.0.finish(|archive| {
            let [a1, a2] = grid.cell().vectors();
            archive.array("a1", &[2], a1)?;
            archive.array("a2", &[2], a2)?;
            archive.array("x", &points, position(0))?;
            archive.array("y", &points, position(1))?;
            archive.array("owner", &points, (0..grid.len()).map(level))
        })
    }
}

//! `contact.npz`: the fields of every load step.

use super::step_arrays::StepArrays;
use super::{Files, OutputError};
use crate::counterbody::Surface;
use crate::spectral::Step;
use ndarray::Array2;
use std::path::Path;
use std::sync::Arc;

/// Fields of the load steps solved so far, kept on disk.
#[derive(Debug)]
pub(super) struct Fields {
    arrays: StepArrays,
    /// The undeformed counterbody on the grid of the steps.
    surface: Arc<Surface>,
}

impl Fields {
    /// No steps yet on the grid of `surface`; `folder` is the staging folder. Refused when there are fields already.
    pub(super) fn new(folder: &Path, surface: Arc<Surface>) -> Result<Self, OutputError> {
        Ok(Self { arrays: StepArrays::new(folder, "contact")?, surface })
    }

    /// The fields of the first `steps` load steps, as an interrupted run has left them, see [`StepArrays::go_on`].
    pub(super) fn go_on(folder: &Path, surface: Arc<Surface>, steps: usize) -> Result<Self, OutputError> {
        Ok(Self { arrays: StepArrays::go_on(folder, "contact", steps)?, surface })
    }

    /// Writes the fields of the next step, whose mean pressure is `mean_pressure`. Returns the files that it has left.
    pub(super) fn add(&mut self, step: &Step, mean_pressure: f64) -> Result<Files, OutputError> {
        self.arrays.next_step();
        self.arrays.add("mean_pressure", &[], [mean_pressure])?;
        self.arrays.add("penetration", &[], [step.penetration()])?;
        let displacement = step.displacement();
        for (name, field) in [("pressure", step.pressure()), ("displacement", displacement.view()), ("gap", step.gap())]
        {
            self.arrays.add(name, field.shape(), field.iter().copied())?;
        }
        Ok(self.arrays.left())
    }

    /// Brings the names of the step's fields to the disk.
    pub(super) fn sync(&self) -> Result<(), OutputError> {
        self.arrays.sync()
    }

    /// Gathers all steps in `contact.npz`, with position and level of each sample; the waiting files stay if that fails.
    pub(super) fn finish(self) -> Result<(), OutputError> {
        let surface = &self.surface;
        let grid = surface.grid();
        let (points, samples) = (grid.points(), 0..grid.len());
        let position = |axis: usize| samples.clone().map(move |i| grid.cell().point(grid.fractions(i))[axis]);
        let level = |site: &u32| surface.sites()[*site as usize].level as i32;
        let levels = surface.owner().map_or(Array2::zeros(points), |owner| owner.map(level));
        self.arrays.finish(|archive| {
            let [a1, a2] = grid.cell().vectors();
            archive.array("a1", &[2], a1)?;
            archive.array("a2", &[2], a2)?;
            archive.array("x", &points, position(0))?;
            archive.array("y", &points, position(1))?;
            archive.array("owner", levels.shape(), levels.iter().copied())
        })
    }
}

//! `contact.npz`: the fields of every load step.

use super::layout::CONTACT;
use super::step_arrays::StepArrays;
use super::{Files, OutputError};
use ndarray::Array2;
use percoat_core::counterbody::Surface;
use percoat_core::reading::Reading;
use percoat_core::spectral::{Shear, Step};
use std::path::Path;
use std::sync::Arc;

/// `contact.npz` under construction: the fields of the load steps so far, on disk.
#[derive(Debug)]
pub(super) struct ContactArchive {
    arrays: StepArrays,
    /// The undeformed counterbody on the grid of the steps.
    surface: Arc<Surface>,
}

impl ContactArchive {
    /// The archive on the grid of `surface` after the first `steps` steps, see [`StepArrays::new`].
    pub(super) fn new(folder: &Path, surface: Arc<Surface>, steps: usize) -> Result<Self, OutputError> {
        Ok(Self { arrays: StepArrays::new(folder, CONTACT, steps)?, surface })
    }

    /// Writes the fields of the next step with its load: force, and mean pressure unless contact is isolated. Returns its files.
    pub(super) fn add(&mut self, step: &Step, reading: &Reading) -> Result<Files, OutputError> {
        self.arrays.next_step();
        if let Some(mean) = reading.mean_pressure {
            self.arrays.add("mean_pressure", &[], [mean])?;
        }
        self.arrays.add("force", &[], [reading.force])?;
        self.arrays.add("penetration", &[], [step.penetration()])?;
        let displacement = step.displacement();
        for (name, field) in [("pressure", step.pressure()), ("displacement", displacement.view()), ("gap", step.gap())]
        {
            self.arrays.add(name, field.shape(), field.iter().copied())?;
        }
        if let Some(depths) = step.indentation() {
            self.arrays.add("indentation", depths.shape(), depths.iter().copied())?;
        }
        if let Some(Shear { traction: [qx, qy], slip: [sx, sy], work, .. }) = step.finest().shear() {
            let fields = [("traction_x", qx), ("traction_y", qy), ("slip_x", sx), ("slip_y", sy), ("work", work)];
            for (name, field) in fields {
                self.arrays.add(name, &step.grid().points(), field.iter().copied())?;
            }
        }
        if let Some(tension) = step.finest().tensions() {
            self.arrays.add("tension", &step.grid().points(), tension.iter().copied())?;
        }
        if let Some(heat) = step.finest().heat() {
            self.arrays.add("temperature", &step.grid().points(), heat.body.iter().copied())?;
            self.arrays.add("heat", &step.grid().points(), heat.flux.iter().copied())?;
        }
        Ok(self.arrays.left())
    }

    /// Syncs the names of the step's files to the disk.
    pub(super) fn sync(&self) -> Result<(), OutputError> {
        self.arrays.sync()
    }

    /// Gathers all steps in `contact.npz`, with position and level of each sample; on failure their files stay.
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

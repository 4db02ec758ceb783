//! `stress.npz`: stresses and displacements on planes, on a vertical section and at points, for every load step; and a
//! VTK file of the volume for each.

use super::{OutputError, StepArrays, write_volume};
use crate::body::Depth;
use crate::run::{Places, SectionRows, VolumePlanes};
use crate::stress::{Section, State, StressField};
use std::path::{Path, PathBuf};

/// Names of the stored components: σ_xx … σ_yz, displacements, and what is derived from the tensor.
const COMPONENTS: [&str; 12] = ["xx", "yy", "zz", "xy", "xz", "yz", "ux", "uy", "uz", "tau1", "mises", "s1"];

/// Stresses of the load steps so far, kept on disk.
#[derive(Debug)]
pub struct Stresses {
    folder: PathBuf,
    arrays: StepArrays,
    places: Places,
    /// What the last step shows of the section.
    section: Option<Section>,
}

impl Stresses {
    /// No steps yet; `folder` is where the result is gathered.
    ///
    /// # Errors
    /// [`OutputError`] when there are stresses already, or no room for them.
    pub fn new(folder: &Path, places: Places) -> Result<Self, OutputError> {
        let arrays = StepArrays::new(folder, "stress")?;
        Ok(Self { folder: folder.to_owned(), arrays, places, section: None })
    }

    /// Puts the stresses of the next step on disk, one plane at a time.
    ///
    /// # Errors
    /// [`OutputError`] when they cannot be written.
    pub fn add(&mut self, field: &StressField) -> Result<(), OutputError> {
        self.arrays.next_step();
        for (number, plane) in (1..).zip(self.places.on_planes(field)) {
            let states = plane.states();
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = states.iter().map(|state| component(state, c));
                self.arrays.add_part(&format!("planes_{name}"), number, states.shape(), values)?;
            }
        }
        if let Some(section) = self.places.on_section(field) {
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = section.states.iter().map(|state| component(state, c));
                self.arrays.add(&format!("section_{name}"), section.states.shape(), values)?;
            }
            self.section = Some(section);
        }
        if !self.places.points.is_empty() {
            let states = self.places.at_points(field);
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = states.iter().map(|state| component(state, c));
                self.arrays.add(&format!("points_{name}"), &[states.len()], values)?;
            }
        }
        if let Some(VolumePlanes { depths, points }) = &self.places.volume {
            let name = format!("stress.{:04}.vts", self.arrays.steps());
            write_volume(&self.folder.join(name), field, depths, *points)?;
        }
        Ok(())
    }

    /// Gathers all steps in `stress.npz`; what the section shows of the last one.
    ///
    /// # Errors
    /// [`OutputError`] when the archive cannot be written; what waits then stays.
    pub fn finish(self) -> Result<Option<Section>, OutputError> {
        let Places { planes, section, points, .. } = &self.places;
        let materials = |depths: &[Depth]| depths.iter().map(|depth| depth.material as i32).collect::<Vec<_>>();
        let zs = |depths: &[Depth]| depths.iter().map(|depth| depth.z).collect::<Vec<_>>();
        self.arrays.finish(|archive| {
            archive.array("planes_z", &[planes.len()], zs(planes))?;
            archive.array("planes_side", &[planes.len()], materials(planes))?;
            if let Some(SectionRows { line, depths }) = section {
                let places: Vec<[f64; 2]> = line.places();
                archive.array("section_s", &[line.points], line.distances())?;
                archive.array("section_x", &[line.points], places.iter().map(|place| place[0]))?;
                archive.array("section_y", &[line.points], places.iter().map(|place| place[1]))?;
                archive.array("section_z", &[depths.len()], zs(depths))?;
                archive.array("section_side", &[depths.len()], materials(depths))?;
            }
            if !points.is_empty() {
                let xyz = points.iter().flat_map(|point| [point.place[0], point.place[1], point.depth.z]);
                archive.array("points_xyz", &[points.len(), 3], xyz)?;
                archive.array(
                    "points_side",
                    &[points.len()],
                    points.iter().map(|point| point.depth.material as i32),
                )?;
            }
            Ok(())
        })?;
        Ok(self.section)
    }
}

/// A component by its place in [`COMPONENTS`].
fn component(state: &State, c: usize) -> f64 {
    match c {
        9 => state.tau1(),
        10 => state.mises(),
        11 => state.s1(),
        c => state.components()[c],
    }
}

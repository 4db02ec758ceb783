//! `stress.npz`: stresses and displacements on planes, on a vertical section and at points, for every load step; and a
//! VTK file of the volume for each.

use super::{OutputError, StepArrays, write_volume};
use crate::body::Depth;
use crate::run::Places;
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
        let points = field.grid().points();
        for (number, &depth) in (1..).zip(&self.places.planes) {
            let states = field.plane(depth, points).states();
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = states.iter().map(|state| component(state, c));
                self.arrays.add_part(&format!("planes_{name}"), number, states.shape(), values)?;
            }
        }
        if let Some((line, depths)) = &self.places.section {
            let section = field.section(line, depths);
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = section.states.iter().map(|state| component(state, c));
                self.arrays.add(&format!("section_{name}"), section.states.shape(), values)?;
            }
            self.section = Some(section);
        }
        if !self.places.points.is_empty() {
            let at = |&(place, depth): &([f64; 2], Depth)| field.points(depth, &[place])[0];
            let states: Vec<State> = self.places.points.iter().map(at).collect();
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = states.iter().map(|state| component(state, c));
                self.arrays.add(&format!("points_{name}"), &[states.len()], values)?;
            }
        }
        if let Some((depths, points)) = &self.places.volume {
            let name = format!("stress.{:04}.vts", self.arrays.steps());
            write_volume(&self.folder.join(name), field, depths, *points)?;
        }
        Ok(())
    }

    /// Takes what the last step's section shows.
    pub fn take_section(&mut self) -> Option<Section> {
        self.section.take()
    }

    /// Gathers all steps in `stress.npz`.
    ///
    /// # Errors
    /// [`OutputError`] when the archive cannot be written; what waits then stays.
    pub fn finish(self) -> Result<(), OutputError> {
        let Places { planes, section, points, .. } = &self.places;
        let materials = |depths: &[Depth]| depths.iter().map(|depth| depth.material as i32).collect::<Vec<_>>();
        let zs = |depths: &[Depth]| depths.iter().map(|depth| depth.z).collect::<Vec<_>>();
        self.arrays.finish(|archive| {
            archive.array("planes_z", &[planes.len()], zs(planes))?;
            archive.array("planes_side", &[planes.len()], materials(planes))?;
            if let Some((line, depths)) = section {
                let places: Vec<[f64; 2]> = line.places();
                archive.array("section_s", &[line.points], line.distances())?;
                archive.array("section_x", &[line.points], places.iter().map(|place| place[0]))?;
                archive.array("section_y", &[line.points], places.iter().map(|place| place[1]))?;
                archive.array("section_z", &[depths.len()], zs(depths))?;
                archive.array("section_side", &[depths.len()], materials(depths))?;
            }
            if !points.is_empty() {
                let xyz = points.iter().flat_map(|&([x, y], depth)| [x, y, depth.z]);
                archive.array("points_xyz", &[points.len(), 3], xyz)?;
                archive.array("points_side", &[points.len()], points.iter().map(|(_, depth)| depth.material as i32))?;
            }
            Ok(())
        })
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

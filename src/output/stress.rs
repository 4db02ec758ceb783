//! `stress.npz`: stresses and displacements on planes, on a vertical section and at points, for every load step; and a
//! VTK file of the volume for each.

use super::{OutputError, StepArrays, write_volume};
use crate::stress::{Depth, Field, Line, State};
use std::path::{Path, PathBuf};

/// Names of the stored components: σ_xx … σ_yz, displacements, and what is derived from the tensor.
const COMPONENTS: [&str; 12] = ["xx", "yy", "zz", "xy", "xz", "yz", "ux", "uy", "uz", "tau1", "mises", "s1"];

/// A vertical section: the states below a line down to a depth.
#[derive(Debug, Clone)]
pub struct Section {
    /// The line on the surface.
    pub line: Line,
    /// Its rows; a row on an interface stands twice, once for each side.
    pub depths: Vec<Depth>,
}

/// Where stresses are wanted.
#[derive(Debug, Clone, Default)]
pub struct Wanted {
    /// Horizontal planes; a depth on an interface stands twice.
    pub planes: Vec<Depth>,
    /// A vertical section.
    pub section: Option<Section>,
    /// Single points, x, y and a depth.
    pub points: Vec<([f64; 2], Depth)>,
    /// A volume, one VTK file a step.
    pub volume: Option<Volume>,
}

/// The field under the whole cell, see [`write_volume`].
#[derive(Debug, Clone)]
pub struct Volume {
    /// Depths of its planes.
    pub depths: Vec<Depth>,
    /// Points along a₁ and a₂.
    pub points: [usize; 2],
}

/// What a section shows of a load step.
#[derive(Debug, Clone)]
pub struct Seen {
    /// Where.
    pub section: Section,
    /// For each depth the states at the points of the line.
    pub states: Vec<Vec<State>>,
    /// Where on the surface the stress along the line is largest, and the stress, see [`crate::stress::Trace::highest`].
    pub highest: Option<[f64; 2]>,
}

/// Stresses of the load steps so far, kept on disk.
#[derive(Debug)]
pub struct Stresses {
    folder: PathBuf,
    arrays: StepArrays,
    wanted: Wanted,
    /// States of the last step on the section.
    section: Vec<Vec<State>>,
    /// Where on the surface the stress along the section is largest in the last step, see [`crate::stress::Trace::highest`].
    highest: Option<[f64; 2]>,
}

impl Stresses {
    /// No steps yet; `folder` is where the result is gathered.
    ///
    /// # Errors
    /// [`OutputError`] when there are stresses already, or no room for them.
    pub fn new(folder: &Path, wanted: Wanted) -> Result<Self, OutputError> {
        let arrays = StepArrays::new(folder, "stress")?;
        Ok(Self { folder: folder.to_owned(), arrays, wanted, section: Vec::new(), highest: None })
    }

    /// Puts the stresses of the next step on disk, one plane at a time.
    ///
    /// # Errors
    /// [`OutputError`] when they cannot be written.
    pub fn add(&mut self, field: &Field) -> Result<(), OutputError> {
        self.arrays.next_step();
        let points = field.grid().points();
        for (number, &depth) in (1..).zip(&self.wanted.planes) {
            let plane = field.plane(depth, points);
            let states: Vec<State> = (0..points[0] * points[1]).map(|index| plane.state(index)).collect();
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = states.iter().map(|state| component(state, c));
                self.arrays.add_part(&format!("planes_{name}"), number, &points, values)?;
            }
        }
        if let Some(Section { line, depths }) = &self.wanted.section {
            let trace = field.trace(line);
            self.section = trace.section(depths);
            self.highest = self.section.first().and_then(|surface| trace.highest(surface));
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = self.section.iter().flatten().map(|state| component(state, c));
                self.arrays.add(&format!("section_{name}"), &[depths.len(), line.points], values)?;
            }
        }
        if !self.wanted.points.is_empty() {
            let states: Vec<State> =
                self.wanted.points.iter().map(|&(place, depth)| field.points(depth, &[place])[0]).collect();
            for (c, name) in COMPONENTS.iter().enumerate() {
                let values = states.iter().map(|state| component(state, c));
                self.arrays.add(&format!("points_{name}"), &[states.len()], values)?;
            }
        }
        if let Some(Volume { depths, points }) = &self.wanted.volume {
            let name = format!("stress.{:04}.vts", self.arrays.steps());
            write_volume(&self.folder.join(name), field, depths, *points)?;
        }
        Ok(())
    }

    /// Takes what the last step's section shows.
    pub fn take_section(&mut self) -> Option<Seen> {
        let section = self.wanted.section.clone()?;
        (!self.section.is_empty()).then(|| Seen {
            section,
            states: std::mem::take(&mut self.section),
            highest: self.highest,
        })
    }

    /// Gathers all steps in `stress.npz`.
    ///
    /// # Errors
    /// [`OutputError`] when the archive cannot be written; what waits then stays.
    pub fn finish(self) -> Result<(), OutputError> {
        let Wanted { planes, section, points, .. } = &self.wanted;
        let sides = |depths: &[Depth]| depths.iter().map(|depth| depth.side as i32).collect::<Vec<_>>();
        let zs = |depths: &[Depth]| depths.iter().map(|depth| depth.z).collect::<Vec<_>>();
        self.arrays.finish(|archive| {
            archive.array("planes_z", &[planes.len()], zs(planes))?;
            archive.array("planes_side", &[planes.len()], sides(planes))?;
            if let Some(Section { line, depths }) = section {
                let places: Vec<[f64; 2]> = line.places();
                archive.array("section_s", &[line.points], line.distances())?;
                archive.array("section_x", &[line.points], places.iter().map(|place| place[0]))?;
                archive.array("section_y", &[line.points], places.iter().map(|place| place[1]))?;
                archive.array("section_z", &[depths.len()], zs(depths))?;
                archive.array("section_side", &[depths.len()], sides(depths))?;
            }
            if !points.is_empty() {
                let xyz = points.iter().flat_map(|&([x, y], depth)| [x, y, depth.z]);
                archive.array("points_xyz", &[points.len(), 3], xyz)?;
                archive.array("points_side", &[points.len()], points.iter().map(|(_, depth)| depth.side as i32))?;
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

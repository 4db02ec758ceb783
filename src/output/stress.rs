//! `stress.npz`: stresses and displacements on planes, on a vertical section and at points, for every load step; and a
//! VTK file of the volume for each.

use super::clock::{Clock, Phase};
use super::step_arrays::{GrowingEntry, StepArrays};
use super::volume::added_volume;
use super::{Files, OutputError};
use crate::body::{Depth, HalfSpace};
use crate::run::StressRequest;
use crate::stress::{StressField, StressState, VerticalSection};
use ndarray::{ArrayView3, Axis};
use std::path::{Path, PathBuf};

/// Names of the stored components: σ_xx … σ_yz, displacements, and what is derived from the tensor.
const COMPONENTS: [&str; 12] = ["xx", "yy", "zz", "xy", "xz", "yz", "ux", "uy", "uz", "tau1", "mises", "s1"];

/// `stress.npz` under construction: the stresses of the load steps so far, on disk.
#[derive(Debug)]
pub(super) struct StressArchive {
    folder: PathBuf,
    arrays: StepArrays,
    request: StressRequest,
    half_space: HalfSpace,
    /// The section of the last step.
    section: Option<VerticalSection>,
}

impl StressArchive {
    /// An archive without steps in the staging folder `folder`; an error where it already has stresses.
    pub(super) fn new(folder: &Path, request: StressRequest, half_space: HalfSpace) -> Result<Self, OutputError> {
        let arrays = StepArrays::new(folder, "stress")?;
        Ok(Self { folder: folder.to_owned(), arrays, request, half_space, section: None })
    }

    /// The archive of an interrupted run with its first `steps` steps, see [`StepArrays::go_on`].
    pub(super) fn go_on(
        folder: &Path,
        request: StressRequest,
        half_space: HalfSpace,
        steps: usize,
    ) -> Result<Self, OutputError> {
        let arrays = StepArrays::go_on(folder, "stress", steps)?;
        Ok(Self { folder: folder.to_owned(), arrays, request, half_space, section: None })
    }

    /// Writes the stresses of the next step, one plane at a time; the clock separates computing from writing, except for a
    /// volume, which does both at once. Returns the files of the step.
    pub(super) fn add(&mut self, field: &StressField, clock: &mut Clock) -> Result<Files, OutputError> {
        let Self { folder, arrays, request, half_space, .. } = self;
        let (step, mut volumes) = (arrays.next_step(), Files::default());
        for (number, depth) in (1..).zip(request.plane_depths(half_space)) {
            add_plane(arrays, number, field, depth, clock)?;
        }
        if let Some(cut) = &request.cut {
            clock.turn(Phase::Stress);
            let section = field.section(&cut.line, &cut.depths(half_space));
            clock.turn(Phase::Output);
            add_states(arrays, "section", section.states.shape(), section.states.iter())?;
            self.section = Some(section);
        }
        let points = request.points_at(half_space);
        if !points.is_empty() {
            clock.turn(Phase::Stress);
            let states: Vec<StressState> =
                points.iter().map(|&(place, depth)| field.points(depth, &[place])[0]).collect();
            clock.turn(Phase::Output);
            add_states(arrays, "points", &[states.len()], states.iter())?;
        }
        if let Some(volume) = request.volume {
            clock.turn(Phase::Stress);
            let (name, depths) = (format!("stress.{step:04}.vts"), half_space.rows(volume.depth, volume.rows));
            let sum = added_volume(&folder.join(&name), field, &depths, [volume.points; 2])?;
            volumes.add(name, sum);
            clock.turn(Phase::Output);
        }
        volumes.append(arrays.left());
        Ok(volumes)
    }

    /// Syncs the names of the step's files to the disk, except those of volumes, which are synced with the log.
    pub(super) fn sync(&self) -> Result<(), OutputError> {
        self.arrays.sync()
    }

    /// Gathers all steps in `stress.npz`; on failure their files stay. Returns the section of the last step.
    pub(super) fn finish(self) -> Result<Option<VerticalSection>, OutputError> {
        let Self { arrays, request, half_space, section, .. } = self;
        let materials = |depths: &[Depth]| depths.iter().map(|depth| depth.material as i32).collect::<Vec<_>>();
        let zs = |depths: &[Depth]| depths.iter().map(|depth| depth.z).collect::<Vec<_>>();
        arrays.finish(|archive| {
            let planes = request.plane_depths(&half_space);
            archive.array("planes_z", &[planes.len()], zs(&planes))?;
            archive.array("planes_side", &[planes.len()], materials(&planes))?;
            let residual: Vec<f64> = half_space.residual_stresses().collect();
            archive.array("residual", &[residual.len()], residual)?;
            if let Some(cut) = &request.cut {
                let (line, places, depths) = (cut.line, cut.line.places(), cut.depths(&half_space));
                archive.array("section_s", &[line.points], line.distances())?;
                archive.array("section_x", &[line.points], places.iter().map(|place| place[0]))?;
                archive.array("section_y", &[line.points], places.iter().map(|place| place[1]))?;
                archive.array("section_z", &[depths.len()], zs(&depths))?;
                archive.array("section_side", &[depths.len()], materials(&depths))?;
            }
            let points = request.points_at(&half_space);
            if !points.is_empty() {
                let xyz = points.iter().flat_map(|([x, y], depth)| [*x, *y, depth.z]);
                archive.array("points_xyz", &[points.len(), 3], xyz)?;
                let sides = points.iter().map(|(_, depth)| depth.material as i32);
                archive.array("points_side", &[points.len()], sides)?;
            }
            Ok(())
        })?;
        Ok(section)
    }
}

/// Adds the components of a plane to the arrays `planes_<component>`, some rows at a time: first stresses and derived
/// quantities, then displacements.
fn add_plane(
    arrays: &mut StepArrays,
    number: usize,
    field: &StressField,
    depth: Depth,
    clock: &mut Clock,
) -> Result<(), OutputError> {
    let points = field.grid().points();
    let [stresses, displacements, derived] = [&COMPONENTS[..6], &COMPONENTS[6..9], &COMPONENTS[9..]];
    let begin = |arrays: &mut StepArrays, components: &[&str]| -> Result<Vec<GrowingEntry>, OutputError> {
        components.iter().map(|name| arrays.begin(&format!("planes_{name}"), number, &points)).collect()
    };
    let mut entries = begin(arrays, &[stresses, derived].concat())?;
    clock.turn(Phase::Stress);
    field.stresses_by_rows(depth, points, |rows| add_rows(&mut entries, rows, clock))?;
    clock.turn(Phase::Output);
    entries.into_iter().try_for_each(|entry| arrays.end(entry))?;
    let mut entries = begin(arrays, displacements)?;
    clock.turn(Phase::Stress);
    field.displacements_by_rows(depth, points, |rows| add_rows(&mut entries, rows, clock))?;
    clock.turn(Phase::Output);
    entries.into_iter().try_for_each(|entry| arrays.end(entry))
}

/// Adds rows to the entries of their components, in the phase [output](Phase::Output).
fn add_rows(entries: &mut [GrowingEntry], rows: ArrayView3<'_, f64>, clock: &mut Clock) -> Result<(), OutputError> {
    assert_eq!(entries.len(), rows.len_of(Axis(0)), "an entry for each component");
    clock.turn(Phase::Output);
    for (entry, rows) in entries.iter_mut().zip(rows.outer_iter()) {
        entry.add(rows.as_slice().expect("rows follow one another"))?;
    }
    clock.turn(Phase::Stress);
    Ok(())
}

/// Adds the components of states of this shape to the arrays `<place>_<component>`.
fn add_states<'a>(
    arrays: &mut StepArrays,
    place: &str,
    shape: &[usize],
    states: impl Iterator<Item = &'a StressState> + Clone,
) -> Result<(), OutputError> {
    (0..).zip(COMPONENTS).try_for_each(|(c, name)| {
        let values = states.clone().map(|state| component(state, c));
        arrays.add(&format!("{place}_{name}"), shape, values)
    })
}

/// Component `c` in the order of [`COMPONENTS`].
fn component(state: &StressState, c: usize) -> f64 {
    if c < 9 { state.components()[c] } else { state.derived()[c - 9] }
}

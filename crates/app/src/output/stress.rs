//! `stress.npz`: stresses and displacements on planes, on a vertical section and at points, for every load step, with their
//! strains under `stress.strain = true`, and with the temperatures by frictional heat; and a VTK file of the volume for each load step.

use super::clock::{Clock, Phase};
use super::layout::{STRESS, archive};
use super::npz::Archive;
use super::step_arrays::{GrowingEntry, StepArrays};
use super::volume::added_volume;
use super::{Files, OutputError};
use ndarray::{ArrayView3, Axis};
use percoat_core::body::{Bodies, Depth, HalfSpace, Side};
use percoat_core::run::StressRequest;
use percoat_core::stress::{
    Compliance, StrainState, StressField, StressFields, StressState, TemperatureField, VerticalSection,
};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

/// Names of the stored components: σ_xx … σ_yz, displacements, and what is derived from the tensor.
const COMPONENTS: [&str; 12] = ["xx", "yy", "zz", "xy", "xz", "yz", "ux", "uy", "uz", "tau1", "mises", "s1"];

/// `stress.npz` under construction: the stresses of the load steps so far, on disk.
#[derive(Debug)]
pub(super) struct StressArchive {
    folder: PathBuf,
    arrays: StepArrays,
    request: StressRequest,
    bodies: Bodies,
    /// The sections of the last step, that of the body first.
    sections: Vec<VerticalSection>,
}

impl StressArchive {
    /// Names of the files that it and its volumes leave after so many steps.
    pub(super) fn files(with_volumes: bool, bodies: &Bodies, steps: usize) -> Vec<String> {
        let volumes = |half_space: &HalfSpace| {
            let side = half_space.side();
            (1..=steps).map(move |step| volume_name(side, step))
        };
        [archive(STRESS)].into_iter().chain(bodies.each().filter(|_| with_volumes).flat_map(volumes)).collect()
    }

    /// The archive after the first `steps` steps, see [`StepArrays::new`].
    pub(super) fn new(
        folder: &Path,
        request: StressRequest,
        bodies: Bodies,
        steps: usize,
    ) -> Result<Self, OutputError> {
        let arrays = StepArrays::new(folder, STRESS, steps)?;
        Ok(Self { folder: folder.to_owned(), arrays, request, bodies, sections: Vec::new() })
    }

    /// Writes the stresses of the next step, one plane at a time; the clock separates computing from writing, except for a
    /// volume, which does both at once. Returns the files of the step.
    pub(super) fn add(
        &mut self,
        fields: &StressFields,
        temperatures: &dyn Fn() -> Vec<TemperatureField>,
        clock: &mut Clock,
    ) -> Result<Files, OutputError> {
        let (step, mut volumes) = (self.arrays.next_step(), Files::default());
        self.sections.clear();
        for field in fields.each() {
            self.add_places(field, clock)?;
            if let Some(volume) = self.request.volume {
                clock.turn(Phase::Stress);
                let half_space = field.half_space();
                let name = volume_name(half_space.side(), step);
                let depths = half_space.rows(volume.depth, volume.rows);
                let sum = added_volume(&self.folder.join(&name), field, &depths, [volume.points; 2])?;
                volumes.add(name, sum);
                clock.turn(Phase::Output);
            }
        }
        if self.request.cut.is_some() || !self.request.points.is_empty() {
            temperatures().iter().try_for_each(|heated| self.add_temperatures(heated, clock))?;
        }
        volumes.append(self.arrays.left());
        Ok(volumes)
    }

    /// Writes the stresses of the present step in one body on planes, on the section and at points.
    fn add_places(&mut self, field: &StressField, clock: &mut Clock) -> Result<(), OutputError> {
        let Self { arrays, request, sections, .. } = self;
        let (half_space, prefix) = (field.half_space(), prefix(field.half_space()));
        let hookean = request.strain.then(|| field.hookean()).flatten();
        for (number, depth) in (1..).zip(request.plane_depths(half_space)) {
            add_plane(arrays, number, field, depth, (request.strain, hookean.as_ref()), clock)?;
        }
        if let Some(cut) = &request.cut {
            clock.turn(Phase::Stress);
            let of = |field: &StressField| field.section(&cut.line, &cut.depths(half_space));
            let (section, behind) = (of(field), hookean.as_ref().map(of));
            clock.turn(Phase::Output);
            let place = format!("{prefix}section");
            add_states(arrays, &place, section.states.shape(), section.states.iter())?;
            if request.strain {
                let behind = behind.as_ref().unwrap_or(&section);
                let rows = behind.states.outer_iter().zip(&section.depths);
                let states = rows.flat_map(|(row, &depth)| row.to_vec().into_iter().map(move |state| (state, depth)));
                add_strains(arrays, &place, section.states.shape(), half_space, states)?;
            }
            clock.turn(Phase::Stress);
            let near = field.section_near_edge(&cut.line, &section.depths);
            clock.turn(Phase::Output);
            add_flags(arrays, &format!("{prefix}section"), section.states.shape(), near)?;
            sections.push(section);
        }
        let points = request.points_at(half_space);
        if !points.is_empty() {
            clock.turn(Phase::Stress);
            let of = |field: &StressField| {
                let states = points.iter().map(|&(place, depth)| (field.points(depth, &[place])[0], depth));
                states.collect::<Vec<(StressState, Depth)>>()
            };
            let (states, behind) = (of(field), hookean.as_ref().map(of));
            let near = field.near_edge(&points);
            clock.turn(Phase::Output);
            let (place, shape) = (format!("{prefix}points"), [states.len()]);
            add_states(arrays, &place, &shape, states.iter().map(|(state, _)| state))?;
            if request.strain {
                add_strains(arrays, &place, &shape, half_space, behind.unwrap_or(states).into_iter())?;
            }
            add_flags(arrays, &place, &shape, near)?;
        }
        Ok(())
    }

    /// Writes the temperatures of the present step in one body on the section and at points.
    fn add_temperatures(&mut self, heated: &TemperatureField, clock: &mut Clock) -> Result<(), OutputError> {
        let Self { arrays, request, .. } = self;
        let (half_space, prefix) = (heated.half_space(), prefix(heated.half_space()));
        if let Some(cut) = &request.cut {
            clock.turn(Phase::Stress);
            let section = heated.section(&cut.line, &cut.depths(half_space));
            clock.turn(Phase::Output);
            arrays.add(&format!("{prefix}section_temperature"), section.shape(), section.iter().copied())?;
        }
        let points = request.points_at(half_space);
        if !points.is_empty() {
            clock.turn(Phase::Stress);
            let of = |&(place, depth): &([f64; 2], Depth)| heated.points(depth, &[place])[0];
            let temperatures: Vec<f64> = points.iter().map(of).collect();
            clock.turn(Phase::Output);
            arrays.add(&format!("{prefix}points_temperature"), &[temperatures.len()], temperatures)?;
        }
        Ok(())
    }

    /// Syncs the names of the step's files to the disk, except those of volumes, which are synced with the log.
    pub(super) fn sync(&self) -> Result<(), OutputError> {
        self.arrays.sync()
    }

    /// Gathers all steps in `stress.npz`; on failure their files stay. Returns the sections of the last step.
    pub(super) fn finish(self) -> Result<Vec<VerticalSection>, OutputError> {
        let Self { arrays, request, bodies, sections, .. } = self;
        arrays.finish(|archive| bodies.each().try_for_each(|half_space| add_axes(archive, &request, half_space)))?;
        Ok(sections)
    }
}

/// Beginning of the names of arrays of a body: those of the counterbody begin with "counterbody_".
fn prefix(half_space: &HalfSpace) -> &'static str {
    if half_space.side() == Some(Side::Counterbody) { "counterbody_" } else { "" }
}

/// Name of the file of the volume of a body in a step.
fn volume_name(side: Option<Side>, step: usize) -> String {
    let of = if side == Some(Side::Counterbody) { "counterbody." } else { "" };
    format!("stress.{of}{step:04}.vts")
}

/// Adds the places of a body at which its stresses are, and its residual stresses.
fn add_axes<W: Write + Seek>(
    archive: &mut Archive<W>,
    request: &StressRequest,
    half_space: &HalfSpace,
) -> io::Result<()> {
    let prefix = prefix(half_space);
    let name = |array: &str| format!("{prefix}{array}");
    let materials = |depths: &[Depth]| depths.iter().map(|depth| depth.material as i32).collect::<Vec<_>>();
    let zs = |depths: &[Depth]| depths.iter().map(|depth| depth.z).collect::<Vec<_>>();
    let planes = request.plane_depths(half_space);
    archive.array(&name("planes_z"), &[planes.len()], zs(&planes))?;
    archive.array(&name("planes_side"), &[planes.len()], materials(&planes))?;
    let residual: Vec<f64> = half_space.residual_stresses().collect();
    archive.array(&name("residual"), &[residual.len()], residual)?;
    if let Some(cut) = &request.cut {
        let (line, places, depths) = (cut.line, cut.line.places(), cut.depths(half_space));
        archive.array(&name("section_s"), &[line.points], line.distances())?;
        archive.array(&name("section_x"), &[line.points], places.iter().map(|place| place[0]))?;
        archive.array(&name("section_y"), &[line.points], places.iter().map(|place| place[1]))?;
        archive.array(&name("section_z"), &[depths.len()], zs(&depths))?;
        archive.array(&name("section_side"), &[depths.len()], materials(&depths))?;
    }
    let points = request.points_at(half_space);
    if !points.is_empty() {
        let xyz = points.iter().flat_map(|([x, y], depth)| [*x, *y, depth.z]);
        archive.array(&name("points_xyz"), &[points.len(), 3], xyz)?;
        let sides = points.iter().map(|(_, depth)| depth.material as i32);
        archive.array(&name("points_side"), &[points.len()], sides)?;
    }
    Ok(())
}

/// Adds the components of a plane to the arrays `planes_<component>`, some rows at a time: first stresses and derived
/// quantities, beside them the strains where `strains` is set, then displacements. Strains follow from the stresses of the `hookean` field of a
/// body that relaxes below a moving load, from those of `field` itself in any other body.
fn add_plane(
    arrays: &mut StepArrays,
    number: usize,
    field: &StressField,
    depth: Depth,
    (strains, hookean): (bool, Option<&StressField>),
    clock: &mut Clock,
) -> Result<(), OutputError> {
    let (points, prefix) = (field.grid().points(), prefix(field.half_space()));
    let [stresses, displacements, derived] = [&COMPONENTS[..6], &COMPONENTS[6..9], &COMPONENTS[9..]];
    let begin = |arrays: &mut StepArrays, components: &[&str]| -> Result<Vec<GrowingEntry>, OutputError> {
        components.iter().map(|name| arrays.begin(&format!("{prefix}planes_{name}"), number, &points)).collect()
    };
    let mut entries = begin(arrays, &[stresses, derived].concat())?;
    let mut strained = begin(arrays, if strains { &StrainState::NAMES } else { &[] })?;
    let compliance = Compliance::from(field.half_space().material(depth.material));
    clock.turn(Phase::Stress);
    field.stresses_by_rows(depth, points, |rows| {
        if strains && hookean.is_none() {
            add_rows(&mut strained, compliance.strains(rows).view(), clock)?;
        }
        add_rows(&mut entries, rows, clock)
    })?;
    if let Some(hookean) = hookean {
        hookean
            .stresses_by_rows(depth, points, |rows| add_rows(&mut strained, compliance.strains(rows).view(), clock))?;
    }
    clock.turn(Phase::Output);
    entries.into_iter().chain(strained).try_for_each(|entry| arrays.end(entry))?;
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
    for (c, name) in (0..).zip(COMPONENTS) {
        arrays.add(&format!("{place}_{name}"), shape, states.clone().map(|state| component(state, c)))?;
    }
    Ok(())
}

/// Adds the strains of states of this shape, by Hooke's law of the materials of a half-space, to the arrays `<place>_<component>`.
fn add_strains(
    arrays: &mut StepArrays,
    place: &str,
    shape: &[usize],
    half_space: &HalfSpace,
    states: impl Iterator<Item = (StressState, Depth)>,
) -> Result<(), OutputError> {
    let compliances: Vec<Compliance> = half_space.materials().map(Compliance::from).collect();
    let strains: Vec<[f64; 10]> =
        states.map(|(state, depth)| compliances[depth.material - 1].strain(&state).all()).collect();
    for (c, name) in (0..).zip(StrainState::NAMES) {
        arrays.add(&format!("{place}_{name}"), shape, strains.iter().map(|all| all[c]))?;
    }
    Ok(())
}

/// Adds 1 where no error is known of the stresses, beside an edge of contact, and 0 elsewhere.
fn add_flags(arrays: &mut StepArrays, place: &str, shape: &[usize], near_edge: Vec<bool>) -> Result<(), OutputError> {
    let values: Vec<f64> = near_edge.into_iter().map(|near| f64::from(u8::from(near))).collect();
    arrays.add(&format!("{place}_near_edge"), shape, values)
}

/// Component `c` in the order of [`COMPONENTS`].
fn component(state: &StressState, c: usize) -> f64 {
    if c < 9 { state.components()[c] } else { state.derived()[c - 9] }
}

//! Stresses on vertical sections and lines, without transforms of whole planes: the waves are summed along a [`Trace`].
//!
//! On the surface the stresses are those of [`super::smoothed_surface`], as the series itself overshoots at edges between the
//! samples. Just below, where it still overshoots, stresses are interpolated in depth.

use super::constants::OPEN_WIDTH;
use super::constants::SAME_IN_SECTION;
use super::depth_response::DisplacementComponents;
use super::field::{REACH, StressField};
use super::smoothed_shear::shear_parts;
use super::smoothed_surface::{NearEdge, SmoothedSurface};
use super::tensor::StressState;
use super::trace::Trace;
use crate::body::Depth;
use crate::numeric::array::field;
use crate::numeric::parallel;
use crate::numeric::search::{first_largest, first_summit};
use ndarray::Array2;

/// Number of intervals between two points of a line in which the largest stress is searched.
const REFINEMENT: usize = 512;

/// Equally spaced points on a straight line along the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceLine {
    /// Point (x, y) at s = 0, lengths.
    pub origin: [f64; 2],
    /// Direction in which s increases, a vector of any length; s itself is a length.
    pub direction: [f64; 2],
    /// First and last s, lengths.
    pub span: [f64; 2],
    /// Number of points, both ends included.
    pub points: usize,
}

impl SurfaceLine {
    /// Values of s at the points, lengths.
    pub fn distances(&self) -> Vec<f64> {
        (0..self.points).map(|i| self.span[0] + i as f64 * self.step()).collect()
    }

    /// Positions (x, y) of the points, lengths.
    pub fn places(&self) -> Vec<[f64; 2]> {
        let unit = self.unit();
        self.distances().into_iter().map(|s| [0, 1].map(|k| self.origin[k] + s * unit[k])).collect()
    }

    /// Positions (x, y) of the first and the last point, lengths.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        self.span.map(|s| [0, 1].map(|k| self.origin[k] + s * self.unit()[k]))
    }

    pub(super) fn step(&self) -> f64 {
        (self.span[1] - self.span[0]) / (self.points.max(2) - 1) as f64
    }

    /// The direction as a vector of length 1.
    pub fn unit(&self) -> [f64; 2] {
        let length = self.direction[0].hypot(self.direction[1]);
        self.direction.map(|x| x / length)
    }
}

/// The states on a vertical section.
#[derive(Debug, Clone)]
pub struct VerticalSection {
    /// The line on the surface.
    pub line: SurfaceLine,
    /// Depths of the rows; an interface has two, one for each side.
    pub depths: Vec<Depth>,
    /// Axis 0: rows, as `depths`; axis 1: points of the line.
    pub states: Array2<StressState>,
    /// s at the largest normal stress along the line on the surface, between the points, and that stress; `None` unless the
    /// first row is the surface.
    pub highest: Option<[f64; 2]>,
}

/// The stress field below a line.
#[derive(Debug)]
struct LineField<'a> {
    field: &'a StressField,
    line: SurfaceLine,
    trace: Trace<'a>,
    /// The smoothed surface; `None` where contact has no edge.
    smoothed: Option<SmoothedSurface>,
}

impl StressField {
    /// States on a vertical section: for each depth those at the points of the line, not a number beyond the window of an isolated
    /// contact.
    ///
    /// # Panics
    /// When a depth names a material that does not exist.
    pub fn section(&self, line: &SurfaceLine, depths: &[Depth]) -> VerticalSection {
        let below = LineField::new(self, *line);
        let rows = below.rows(depths);
        let highest = rows.first().filter(|_| depths[0] == Depth::SURFACE).and_then(|surface| below.highest(surface));
        let places = line.places();
        let holding =
            |row: Vec<StressState>| row.into_iter().zip(&places).map(|(state, &at)| self.where_it_holds(at, state));
        let states = field([depths.len(), line.points], rows.into_iter().flat_map(holding).collect());
        VerticalSection { line: *line, depths: depths.to_vec(), states, highest }
    }

    /// Whether no error is known of the stresses at the points of a section, depth by depth; see [`Self::near_edge`].
    pub fn section_near_edge(&self, line: &SurfaceLine, depths: &[Depth]) -> Vec<bool> {
        let is_shallow = |depth: &Depth| depth.z < self.shallow_depth();
        let smoothed = if depths.iter().any(is_shallow) { self.smoothed_edges() } else { None };
        let Some(smoothed) = smoothed else { return vec![false; depths.len() * line.points] };
        let near = self.trace(line).sums(&smoothed.near, [line.span[0], line.step()], line.points);
        let sees: Vec<bool> = near.into_iter().map(|near| smoothed.sees_edge(near)).collect();
        depths.iter().flat_map(|depth| sees.iter().map(move |&sees| sees && is_shallow(depth))).collect()
    }

    /// The waves along a line.
    fn trace(&self, line: &SurfaceLine) -> Trace<'_> {
        let cell = self.series_grid().cell();
        Trace::new(&self.series, cell.fractions(line.origin), cell.parts(line.unit()))
    }

    /// Depth above which stresses are interpolated, a length: where the least wavenumber that the grid cannot hold has decayed as far
    /// as the smoothing damps it on the surface. Zero where contact has no edge; at most the thickness of the coating.
    fn shallow(&self) -> f64 {
        let depth =
            if self.regions().have_edges() { 0.5 * OPEN_WIDTH * OPEN_WIDTH / self.least_aliased() } else { 0.0 };
        depth.min(self.half_space().faces(1).1)
    }
}

impl<'a> LineField<'a> {
    fn new(field: &'a StressField, line: SurfaceLine) -> Self {
        Self { field, line, trace: field.trace(&line), smoothed: field.smoothed_edges() }
    }

    /// States on the vertical section below the line: for each depth those at its points.
    fn rows(&self, depths: &[Depth]) -> Vec<Vec<StressState>> {
        self.field.read_ahead(depths.iter().copied());
        let shallow = self.field.shallow();
        let between = |depth: &Depth| depth.material == 1 && depth.z > 0.0 && depth.z < shallow;
        let at = |z: f64| self.row(&self.line, Depth { z, material: 1 });
        let ends = depths.iter().any(between).then(|| rayon::join(|| at(0.0), || at(shallow)));
        let row = |depth: &Depth| match &ends {
            Some((surface, _)) if *depth == Depth::SURFACE => surface.clone(),
            Some((surface, below)) if between(depth) => {
                let pairs = surface.iter().zip(below).zip(self.displacements(*depth));
                pairs
                    .map(|((a, b), displacement)| StressState { displacement, ..a.toward(b, depth.z / shallow) })
                    .collect()
            }
            _ => self.row(&self.line, *depth),
        };
        parallel::map_items(depths, row)
    }

    /// s at the largest normal stress along the line on the surface, between its points, and that stress; `surface` holds the
    /// states at the points.
    fn highest(&self, surface: &[StressState]) -> Option<[f64; 2]> {
        let line = self.line;
        let cell = self.field.grid().cell();
        let stresses = |states: &[StressState], line: SurfaceLine| -> Vec<f64> {
            let normal_stress = |(state, place): (&StressState, [f64; 2])| {
                if cell.contains(place) { state.along(line.direction) } else { f64::NEG_INFINITY }
            };
            states.iter().zip(line.places()).map(normal_stress).collect()
        };
        // Mirror images differ as closely as contacts are solved.
        let (best, stress) = first_summit(&stresses(surface, line), SAME_IN_SECTION)?;
        let s = line.distances()[best];
        let Some(smoothed) = &self.smoothed else { return Some([s, stress]) };
        // The stress jumps at an edge: a fine line between the points locates it.
        let [first, last] = line.span;
        let span = [s - line.step(), s + line.step()].map(|s| s.clamp(first.min(last), first.max(last)));
        let finer = SurfaceLine { span, points: 2 * REFINEMENT + 1, ..line };
        let (best, finer_stress) = first_largest(stresses(&self.sharp(smoothed, &finer), finer).into_iter())?;
        Some(if finer_stress > stress { [finer.distances()[best], finer_stress] } else { [s, stress] })
    }

    /// States at a depth at the points of `line`, which is a part of the field's line.
    fn row(&self, line: &SurfaceLine, depth: Depth) -> Vec<StressState> {
        let (first, step) = (line.span[0], line.step());
        let response = self.field.depth_response(depth, REACH);
        let states =
            self.trace.sums(&response, [first, step], line.points).into_iter().map(StressState::from_components);
        let Some(smoothed) = self.smoothed.as_ref().filter(|_| depth.z == 0.0) else { return states.collect() };
        let sharp = self.sharp(smoothed, line).into_iter().zip(states);
        sharp.map(|(sharp, state)| StressState { displacement: state.displacement, ..sharp }).collect()
    }

    /// Displacements at a depth at the points of the line.
    fn displacements(&self, depth: Depth) -> Vec<[f64; 3]> {
        let response = self.field.depth_response(depth, REACH);
        self.trace.sums(&DisplacementComponents(&response), [self.line.span[0], self.line.step()], self.line.points)
    }

    /// States on the surface at the points of `line`, displacements left out.
    fn sharp(&self, smoothed: &SmoothedSurface, line: &SurfaceLine) -> Vec<StressState> {
        let places = [line.span[0], line.step()];
        let near = self.trace.sums(&smoothed.near, places, line.points);
        let [edge, open] = [&smoothed.edge, &smoothed.open].map(|flat| self.trace.sums(flat, places, line.points));
        let shear = smoothed.shear.as_ref().map(|shear| self.trace.sums(shear, places, line.points));
        let readings = near.into_iter().zip(edge).zip(open).enumerate();
        let states = readings.map(|(i, ((pressure, edge), open))| {
            let [near, away] = shear_parts(shear.as_ref().map(|shear| shear[i]));
            smoothed.toward_open(smoothed.sharp(NearEdge { pressure, shear: near }, edge), open, away)
        });
        states.collect()
    }
}

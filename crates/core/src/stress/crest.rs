//! The largest tension, τ₁ and von Mises on the surface: at an edge of contact, or away from edges.
//!
//! 1. **Edges** are located between the samples of the smoothed pressure, beside the samples where contact ends, and the
//!    stresses there are interpolated between those of the smoothed stresses.
//! 2. **Everywhere** the stresses are those of the [`SmoothedSurface`]: of the series itself but for a band along the edges.
//! 3. The highest edges and the highest sample are evaluated again by the exact sums, for errors with two more widths of smoothing.
//!
//! Fields are processed row by row and not kept, except for the band of samples near edges.

use super::constants::{
    CHANGE_OVER_ERROR, CREST_SAFETY, CUSP_CHANGE, CUSP_ERROR, CUSP_PART, CUSP_SPREAD, EDGE_ERROR, EXACT_EDGES,
    EXPONENT_ERROR, OTHER_WIDTHS, USUAL_TENSION,
};
use super::cubic::CubicInterpolation;
use super::field::{REACH, StressField};
use super::measure::{RunningMaxima, StressMeasure};
use super::peak::Peak;
use super::smoothed_shear::{ShearSamples, shear_parts};
use super::smoothed_surface::{NearEdge, Sharp, SmoothedSurface};
use super::tensor::StressState;
use super::transform::Transform;
use crate::body::Depth;
use crate::numeric::parallel;
use crate::numeric::search::{first_largest, largest};
use std::sync::Arc;

/// The largest value of a stress measure on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crest {
    /// Value and position.
    pub peak: Peak,
    /// Error of the value as estimated from this grid alone, a pressure.
    pub uncertainty: f64,
    /// Part of the change from the next coarser grid that is added to it.
    pub of_change: f64,
    /// Scale of relative errors, a pressure: the value itself, or the usual tension at an edge, 0.13 of the largest pressure, where
    /// that is more (incompressible materials have no tension at the edge).
    pub scale: f64,
}

impl Crest {
    /// Estimated relative error; `coarser` is the largest value of the measure on the surface of the next coarser grid.
    pub fn error(&self, coarser: Option<f64>) -> f64 {
        let change = coarser.map_or(0.0, |value| (value - self.peak.value).abs());
        (self.uncertainty + self.of_change * change) / self.scale
    }

    /// A crest with the usual safety: `changes` by other widths and the like, a pressure.
    pub(super) fn with_safety(peak: Peak, changes: f64, scale: f64) -> Self {
        Self { peak, uncertainty: CREST_SAFETY * changes, of_change: CREST_SAFETY / CHANGE_OVER_ERROR, scale }
    }
}

/// Whether a point of the surface lies at an edge of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Location {
    Open,
    Edge,
}

/// A point of an edge, between the samples.
#[derive(Debug, Clone, Copy)]
struct EdgePoint {
    /// x, y; lengths.
    place: [f64; 2],
    near: NearEdge,
    /// Samples along the radius of the spot or of the open region beside it, whichever has fewer.
    resolution: f64,
    state: StressState,
}

/// Samples near edges, row by row: their columns, and a value at each.
type EdgeBand<T> = Vec<Vec<(usize, T)>>;

/// State at a point of the surface.
#[derive(Debug, Clone, Copy)]
struct SurfacePoint {
    kind: Location,
    place: [f64; 2],
    state: StressState,
    /// Pressure of the series smoothed near edges.
    smoothed_pressure: f64,
    near: NearEdge,
}

/// Readings of the surface that the crests of all measures share.
#[derive(Debug)]
struct SurfaceReading {
    smoothed: SmoothedSurface,
    /// The surface smoothed with other widths.
    others: Vec<SmoothedSurface>,
    edges: Vec<EdgePoint>,
    /// Position of the largest sample of each measure, lengths.
    samples: Vec<[f64; 2]>,
    /// Largest smoothed pressure.
    pressed: f64,
    /// Largest tangential traction, a pressure.
    rubbed: f64,
}

impl StressField {
    /// The largest values of some measures on the surface; none where contact has no edge: it is complete, or absent. Under discs see
    /// [`Self::crests_of_discs`].
    pub(super) fn crests_of(&self, measures: &[StressMeasure]) -> Vec<(StressMeasure, Crest)> {
        self.crests_with(measures, &OTHER_WIDTHS)
    }

    /// The largest values of some measures on the surface, without their errors; see [`Self::crests_of`].
    pub(super) fn highest_on_surface(&self, measures: &[StressMeasure]) -> Vec<(StressMeasure, f64)> {
        self.crests_with(measures, &[]).into_iter().map(|(measure, crest)| (measure, crest.peak.value)).collect()
    }

    /// The crests, their errors by the changes with these other widths of smoothing.
    fn crests_with(&self, measures: &[StressMeasure], widths: &[f64]) -> Vec<(StressMeasure, Crest)> {
        if !self.regions().have_edges() {
            return self.crests_of_discs(measures, widths);
        }
        let surface = self.read_surface(measures, widths);
        // Points where a measure may be largest, as indices into `places`: most measures share theirs.
        let mut places: Vec<(Location, [f64; 2])> = Vec::new();
        let finalists: Vec<Vec<usize>> = measures
            .iter()
            .zip(&surface.samples)
            .map(|(&measure, &sample)| {
                let number = |place: (Location, [f64; 2])| {
                    places.iter().position(|known| *known == place).unwrap_or_else(|| {
                        places.push(place);
                        places.len() - 1
                    })
                };
                surface.finalists(measure, sample).into_iter().map(number).collect()
            })
            .collect();
        let read = |smoothed: &SmoothedSurface| self.read_places(smoothed, &places);
        let points = read(&surface.smoothed);
        let others: Vec<Vec<SurfacePoint>> = surface.others.iter().map(read).collect();
        let of = |(&measure, numbers): (&StressMeasure, &Vec<usize>)| {
            let highest = |all: &[SurfacePoint]| {
                let candidates = numbers.iter().map(|&number| all[number]);
                candidates.max_by(|a, b| measure.of(&a.state).total_cmp(&measure.of(&b.state)))
            };
            let others = others.iter().filter_map(|other| highest(other));
            highest(&points).map(|highest| (measure, self.crest_of(&surface, measure, highest, others)))
        };
        measures.iter().zip(&finalists).filter_map(of).collect()
    }

    /// The largest tension on the surface; `None` where contact has no edge: it is complete, or absent.
    pub fn crest(&self) -> Option<Crest> {
        self.crests_of(&[StressMeasure::Tension]).first().map(|(_, crest)| *crest)
    }

    /// Places x, y, lengths, at the edges of contact, beside the samples where it ends, and the states there just outside; none without
    /// edges.
    pub(super) fn states_on_edges(&self) -> Vec<([f64; 2], StressState)> {
        if !self.regions().have_edges() {
            return Vec::new();
        }
        let response = Arc::new(self.depth_response(Depth::SURFACE, REACH));
        let smoothed = SmoothedSurface::new(self, &response, 1.0);
        let (transform, mut buffer) = (Transform::new(self.series_grid().points()), Vec::new());
        let shear = ShearSamples::new(self, smoothed.shear.as_ref(), &transform);
        let (edges, band) = self.edges(&smoothed, &shear, &transform, &mut buffer);
        let (edges, _) = self.along_edges(&smoothed, &transform, &mut buffer, edges, band);
        edges.into_iter().map(|edge| (edge.place, edge.state)).collect()
    }

    fn read_surface(&self, measures: &[StressMeasure], widths: &[f64]) -> SurfaceReading {
        let response = Arc::new(self.depth_response(Depth::SURFACE, REACH));
        let smoothed = SmoothedSurface::new(self, &response, 1.0);
        let (transform, mut buffer) = (Transform::new(self.series_grid().points()), Vec::new());
        let shear = ShearSamples::new(self, smoothed.shear.as_ref(), &transform);
        let (edges, band) = self.edges(&smoothed, &shear, &transform, &mut buffer);
        let (edges, band) = self.along_edges(&smoothed, &transform, &mut buffer, edges, band);
        let (samples, pressed) = self.highest_samples((&smoothed, &shear), &transform, buffer, &band, measures);
        SurfaceReading {
            rubbed: shear.largest().unwrap_or_else(|| smoothed.rubbed(pressed)),
            others: widths.iter().map(|&scale| SmoothedSurface::new(self, &response, scale)).collect(),
            smoothed,
            edges,
            samples,
            pressed,
        }
    }

    /// The crest at the highest point, its uncertainty estimated from `others`, the highest points with other widths.
    fn crest_of(
        &self,
        surface: &SurfaceReading,
        measure: StressMeasure,
        highest: SurfacePoint,
        others: impl Iterator<Item = SurfacePoint>,
    ) -> Crest {
        let SurfaceReading { smoothed, edges, pressed, rubbed, .. } = surface;
        let value_of = |edge: &EdgePoint| measure.of(&edge.state);
        let SurfacePoint { kind, place, state, smoothed_pressure, near } = highest;
        let value = measure.of(&state);
        // Excess of the stress at an edge of few samples over the largest one.
        let per_stress = measure.per_stress();
        let usual = if measure.is_tensile() { USUAL_TENSION * pressed * per_stress } else { 0.0 };
        let spread: f64 = others.map(|other| (measure.of(&other.state) - value).abs()).sum();
        let unlike = if kind == Location::Edge { smoothed.unlike(smoothed_pressure, near) * per_stress } else { 0.0 };
        let cusp = 2.0 * rubbed * per_stress;
        let eta = self.form().edge_exponent().abs();
        let few = |edge: &EdgePoint| {
            let (at_edge, n) = (value_of(edge), edge.resolution);
            let turned = EXPONENT_ERROR * eta * n.powf(eta - 0.5);
            at_edge + EDGE_ERROR / (n * n) * usual.max(at_edge.abs()) + (CUSP_ERROR / n + turned) * cusp - value
        };
        let few = largest(edges.iter().map(few));
        let direction = state.s1_direction();
        let (position, material) = ([place[0], place[1], 0.0], self.half_space().material_id(1));
        let peak = Peak { value, position, material, direction, error: None, rival: None };
        let scale = usual.max(value.abs());
        if kind == Location::Edge && cusp >= CUSP_PART * value.abs() {
            return Crest {
                peak,
                uncertainty: CUSP_SPREAD * (spread + unlike) + CREST_SAFETY * few,
                of_change: CUSP_CHANGE,
                scale,
            };
        }
        Crest::with_safety(peak, spread + unlike + few, scale)
    }

    /// Points of edges beside the samples where contact ends, without their stresses; and the samples near edges.
    fn edges(
        &self,
        smoothed: &SmoothedSurface,
        shear: &ShearSamples,
        transform: &Transform,
        buffer: &mut Vec<f64>,
    ) -> (Vec<EdgePoint>, EdgeBand<NearEdge>) {
        let (grid, regions) = (self.series_grid(), self.regions());
        let ([_, n2], cell, len) = (grid.points(), grid.cell(), grid.len());
        let mut fields = vec![0.0; 3 * len];
        let columns = self.series.on_plane(transform, std::mem::take(buffer), &smoothed.near);
        columns.write(&mut fields);
        *buffer = columns.into_buffer();
        let near = |index: usize| [0, 1, 2].map(|k| fields[k * len + index]);
        let beside = |index: usize| -> Option<EdgePoint> {
            let open = grid.neighbours(index).filter(|&next| !regions.touches(next));
            let resolution = open.map(|next| regions.resolution(next)).reduce(f64::min)?.min(regions.resolution(index));
            let (mut place, mut pressure, mut u) = (cell.point(grid.fractions(index)), near(index), 0.0);
            for _ in 0..3 {
                (place, u) = smoothed.moved(place, pressure);
                let between = CubicInterpolation::new(grid.points(), cell.fractions(place));
                pressure = [0, 1, 2].map(|k| between.value(&fields[k * len..(k + 1) * len], n2));
            }
            let [shear, _] = shear.between(&CubicInterpolation::new(grid.points(), cell.fractions(place)), n2);
            let near = NearEdge { pressure, shear };
            (u.abs() < 0.5).then_some(EdgePoint { place, near, resolution, state: StressState::default() })
        };
        let of_row = |i: usize| -> Vec<EdgePoint> {
            (i * n2..(i + 1) * n2).filter(|&index| regions.touches(index)).filter_map(beside).collect()
        };
        let band = |i: usize| {
            let samples = (0..n2).map(|j| (j, near(i * n2 + j)));
            let samples = samples.filter(|(_, near)| smoothed.sees_edge(*near));
            let shear = |j: usize| shear.at(i * n2 + j)[0];
            samples.map(|(j, pressure)| (j, NearEdge { pressure, shear: shear(j) })).collect()
        };
        (parallel::map(grid.points()[0], of_row).into_iter().flatten().collect(), parallel::map(grid.points()[0], band))
    }

    /// The points of edges with their stresses, and the samples near edges with their sharpened stresses.
    fn along_edges(
        &self,
        smoothed: &SmoothedSurface,
        transform: &Transform,
        buffer: &mut Vec<f64>,
        mut edges: Vec<EdgePoint>,
        band: EdgeBand<NearEdge>,
    ) -> (Vec<EdgePoint>, EdgeBand<Sharp>) {
        let (points, cell) = (self.series_grid().points(), self.series_grid().cell());
        // Weights with which each row adds to the edges.
        let places: Vec<CubicInterpolation> =
            edges.iter().map(|edge| CubicInterpolation::new(points, cell.fractions(edge.place))).collect();
        let mut beside: Vec<Vec<(usize, f64)>> = vec![Vec::new(); points[0]];
        for (number, place) in places.iter().enumerate() {
            place.rows.iter().for_each(|&(i, weight)| beside[i].push((number, weight)));
        }
        let columns = self.series.on_plane(transform, std::mem::take(buffer), &smoothed.edge);
        let read = columns.map(|i, row| {
            let at = |j: usize| row.map(|component| component[j]);
            let sharp: Vec<_> = band[i].iter().map(|&(j, near)| (j, smoothed.sharp(near, at(j)))).collect();
            let parts: Vec<[f64; 4]> = beside[i]
                .iter()
                .map(|&(number, weight)| row.map(|component| weight * places[number].across(component)))
                .collect();
            (sharp, parts)
        });
        *buffer = columns.into_buffer();
        let mut sums = vec![[0.0; 4]; edges.len()];
        let (mut sharp, mut rows) = (Vec::with_capacity(read.len()), beside.iter());
        for (sharpened, parts) in read {
            for (&(number, _), part) in rows.next().into_iter().flatten().zip(parts) {
                sums[number].iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
            }
            sharp.push(sharpened);
        }
        for (edge, sum) in edges.iter_mut().zip(sums) {
            edge.state = smoothed.state_on_edge(edge.near, sum);
        }
        (edges, sharp)
    }

    /// Position of the largest sample of each measure, lengths, and the largest smoothed pressure.
    fn highest_samples(
        &self,
        (smoothed, shear): (&SmoothedSurface, &ShearSamples),
        transform: &Transform,
        buffer: Vec<f64>,
        band: &EdgeBand<Sharp>,
        measures: &[StressMeasure],
    ) -> (Vec<[f64; 2]>, f64) {
        let found = RunningMaxima::new(measures);
        let [own_rows, own_columns] = self.own_samples();
        let rows = self.series.on_plane(transform, buffer, &smoothed.open).map(|i, row| {
            let columns = row[0].len();
            let state = |j: usize, sharp: Sharp| {
                let [_, shear] = shear.at(i * columns + j);
                smoothed.toward_open(sharp, row.map(|component| component[j]), shear)
            };
            let mut states: Vec<StressState> = (0..columns).map(|j| state(j, Sharp::AWAY)).collect();
            for &(j, sharp) in &band[i] {
                states[j] = state(j, sharp);
            }
            let inside = if own_rows.contains(&i) { &states[own_columns.clone()] } else { &[] };
            let best = if inside.is_empty() { Vec::new() } else { found.add(inside.len(), |j| inside[j]) };
            (best, largest(row[3].iter().copied()))
        });
        let place = |measure: usize| {
            let of_rows = rows[own_rows.clone()].iter().map(|(best, _)| best[measure].1);
            let i = own_rows.start + first_largest(of_rows).map_or(0, |(i, _)| i);
            let j = own_columns.start + rows[i].0[measure].0;
            self.series_grid().cell().point(self.series_grid().fractions(i * self.series_grid().points()[1] + j))
        };
        ((0..measures.len()).map(place).collect(), largest(rows.iter().map(|&(_, pressed)| pressed)))
    }

    /// States at points of the surface, by the exact sums; points at edges are moved onto the edge first.
    fn read_places(&self, smoothed: &SmoothedSurface, places: &[(Location, [f64; 2])]) -> Vec<SurfacePoint> {
        let of = |kind: Location| places.iter().filter(move |(location, _)| *location == kind).map(|(_, place)| *place);
        let (open, mut edges): (Vec<_>, Vec<_>) = (of(Location::Open).collect(), of(Location::Edge).collect());
        for _ in 0..2 {
            let near = self.at(&edges, &smoothed.near);
            edges.iter_mut().zip(near).for_each(|(place, near)| *place = smoothed.moved(*place, near).0);
        }
        // Pressure and tangential fields near edges, stresses there, and the tangential fields away from them.
        let read = |places: &[[f64; 2]]| {
            let shear = smoothed.shear.as_ref().map(|shear| self.at(places, shear));
            let near = self.at(places, &smoothed.near).into_iter().zip(self.at(places, &smoothed.edge)).enumerate();
            near.map(move |(i, (pressure, edge))| {
                let [shear, away] = shear_parts(shear.as_ref().map(|shear| shear[i]));
                (NearEdge { pressure, shear }, edge, away)
            })
        };
        let mut on_edges = edges.iter().zip(read(&edges)).map(|(&place, (near, edge, _))| SurfacePoint {
            kind: Location::Edge,
            place,
            state: smoothed.state_on_edge(near, edge),
            smoothed_pressure: edge[3],
            near,
        });
        let series = self.at(&open, &smoothed.open);
        let mut in_open =
            open.iter().zip(read(&open)).zip(series).map(|((&place, (near, edge, away)), series)| SurfacePoint {
                kind: Location::Open,
                place,
                state: smoothed.toward_open(smoothed.sharp(near, edge), series, away),
                smoothed_pressure: edge[3],
                near,
            });
        let next = |(kind, _): &(Location, _)| match kind {
            Location::Open => in_open.next(),
            Location::Edge => on_edges.next(),
        };
        places.iter().filter_map(next).collect()
    }
}

impl SurfaceReading {
    /// The largest sample of a measure and the points of edges where it is largest.
    fn finalists(&self, measure: StressMeasure, sample: [f64; 2]) -> Vec<(Location, [f64; 2])> {
        let mut ordered: Vec<(f64, &EdgePoint)> =
            self.edges.iter().map(|edge| (measure.of(&edge.state), edge)).collect();
        ordered.sort_by(|a, b| b.0.total_cmp(&a.0));
        let edges = ordered.iter().take(EXACT_EDGES).map(|(_, edge)| (Location::Edge, edge.place));
        [(Location::Open, sample)].into_iter().chain(edges).collect()
    }
}

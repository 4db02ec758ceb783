//! Planes on which the search for the largest stresses starts: their depths, and their largest samples.
//!
//! Depths are denser towards the faces of each material. A plane has as many points as the waves that reach its depth need, and is
//! processed row by row.

use super::depth_response::StressComponents;
use super::field::StressField;
use super::measure::{RunningMaxima, StressMeasure};
use super::series_grid::{samples_before, times};
use super::smoothed_surface::SurfaceStresses;
use super::tensor::StressState;
use super::transform::Transform;
use crate::body::Depth;
use crate::numeric::fourier::fast_points;
use crate::numeric::search::first_largest;
use std::ops::Range;
use std::sync::Arc;

/// Ratio of successive distances from a face.
const DEPTH_RATIO: f64 = 1.35;
/// qz beyond which waves are neglected in the search: they have e^{−25} of their pressure.
pub(super) const SEARCH_REACH: f64 = 25.0;
/// qz beyond which waves are neglected on planes, whose largest samples the search starts from.
const PLANE_REACH: f64 = 10.0;

/// The sample of a plane where a measure is largest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub value: f64,
    pub depth: Depth,
    pub place: [f64; 2],
    /// Half the distance to the neighbouring samples, a length.
    pub step: f64,
}

/// The largest samples of a plane.
#[derive(Debug)]
pub(super) struct PlaneSamples {
    /// The largest sample by each measure.
    pub best: Vec<(StressMeasure, Candidate)>,
    /// The largest size of the stresses of the waves on the border of the window of an isolated contact, a pressure; zero in a periodic cell.
    pub border: f64,
}

/// Column and value of the largest sample of a row by each measure, and the largest size of stresses on the border.
type RowSamples = (Vec<(usize, f64)>, f64);

/// Columns of a plane that are searched.
struct SearchedColumns {
    /// Number of all columns.
    count: usize,
    /// Rows that pass through a hole, and their columns outside of it.
    beside_hole: Option<(Range<usize>, Vec<usize>)>,
}

impl SearchedColumns {
    /// Column and value of the largest of each measure in a row whose states are given column by column.
    fn largest(
        &self,
        found: &RunningMaxima<'_>,
        row: usize,
        state: impl Fn(usize) -> StressState,
    ) -> Vec<(usize, f64)> {
        match &self.beside_hole {
            Some((rows, columns)) if rows.contains(&row) => {
                let largest = found.add(columns.len(), |k| state(columns[k]));
                largest.into_iter().map(|(k, value)| (columns[k], value)).collect()
            }
            _ => found.add(self.count, state),
        }
    }
}

impl StressField {
    /// Depths at which planes are searched, ascending, faces first and last.
    pub(super) fn search_depths(&self, material: usize, [small, large]: [f64; 2]) -> Vec<f64> {
        let (top, bottom) = self.half_space().faces(material);
        let least = 0.1 * if small > 0.0 { small } else { self.spacing() };
        // Stresses decrease below some six radii, or the cell, and a few coating thicknesses.
        let reach = 6.0 * large.min(self.series_grid().cell().reduced().longer_side()) + 3.0 * top;
        let most = if bottom.is_finite() { 0.5 * (bottom - top) } else { reach };
        let mut depths = vec![top];
        let mut distance = least;
        while distance < most.min(reach) {
            depths.push(top + distance);
            if bottom.is_finite() {
                depths.push(bottom - distance);
            }
            distance *= DEPTH_RATIO;
        }
        if bottom.is_finite() {
            depths.extend([0.5 * (top + bottom), bottom]);
        }
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        depths
    }

    /// The largest samples of a plane by some measures.
    pub(super) fn candidates(&self, depth: Depth, radius: f64, measures: &[StressMeasure]) -> PlaneSamples {
        let grid = self.series_grid();
        let lengths = grid.cell().vectors().map(|[x, y]| x.hypot(y));
        let points = [0, 1].map(|k| {
            let (n, length) = (grid.points()[k], lengths[k]);
            let needed = (PLANE_REACH * length / (std::f64::consts::PI * depth.z)).max(8.0 * length / radius);
            if needed < n as f64 { fast_points(needed.ceil() as usize).min(n) } else { n }
        });
        let start = self.first_fractions();
        let largest_of_rows = self.largest_of_rows(depth, &Transform::new(points), start, measures);
        let [n1, n2] = points.map(|n| n as f64);
        let candidate = |(index, &measure): (usize, &StressMeasure)| {
            let of_rows = || largest_of_rows.iter().map(|(row, _)| row[index]);
            let (i, value) = first_largest(of_rows().map(|(_, value)| value)).unwrap_or((0, f64::NEG_INFINITY));
            let j = of_rows().nth(i).map_or(0, |(j, _)| j);
            let place = grid.cell().point([start[0] + i as f64 / n1, start[1] + j as f64 / n2]);
            (measure, Candidate { value, depth, place, step: 0.5 * (lengths[0] / n1).min(lengths[1] / n2) })
        };
        PlaneSamples {
            best: measures.iter().enumerate().map(candidate).collect(),
            border: largest_of_rows.iter().map(|(_, border)| *border).fold(0.0, f64::max),
        }
    }

    /// The largest samples of each row of a plane.
    fn largest_of_rows(
        &self,
        depth: Depth,
        transform: &Transform,
        start: [f64; 2],
        measures: &[StressMeasure],
    ) -> Vec<RowSamples> {
        // Around an isolated contact only its window is searched, the first half of the rows and columns.
        let part = times(self.grid().cell());
        let (rows, columns) = (transform.points()[0].div_ceil(part), transform.points()[1].div_ceil(part));
        let border = |i: usize, state: &dyn Fn(usize) -> StressState| -> f64 {
            let of = |columns: &mut dyn Iterator<Item = usize>| {
                columns.map(|j| self.size_of_waves(depth, &state(j))).fold(0.0, f64::max)
            };
            match (part, i == 0 || i + 1 == rows) {
                (1, _) => 0.0,
                (_, true) => of(&mut (0..columns)),
                (_, false) => of(&mut [0, columns - 1].into_iter()),
            }
        };
        let (response, found) = (self.depth_response(depth, PLANE_REACH), RunningMaxima::new(measures));
        let searched = SearchedColumns { count: columns, beside_hole: self.beside_hole(transform, start) };
        let is_surface = depth == Depth::SURFACE && !self.stands_for_strains();
        if let Some(traction) = self.traction_over_pressure().filter(|_| is_surface) {
            let surface = SurfaceStresses::new(&Arc::new(response), |_| 1.0);
            let fields = self.series.on_plane_from(start, transform, Vec::new(), &surface);
            return fields.map_first(rows, |i, row| {
                let state = |j: usize| StressState::on_surface(row.map(|component| component[j]), traction);
                (searched.largest(&found, i, state), border(i, &state))
            });
        }
        let fields = self.series.on_plane_from(start, transform, Vec::new(), &StressComponents(&response));
        fields.map_first(rows, |i, row| {
            let state = |j: usize| StressState::from_stresses(row.map(|component| component[j]));
            (searched.largest(&found, i, state), border(i, &state))
        })
    }

    /// Rows of a plane that pass through the hole of the field, and the columns outside of it; `None` without a hole.
    fn beside_hole(&self, transform: &Transform, start: [f64; 2]) -> Option<(Range<usize>, Vec<usize>)> {
        if !self.has_hole() {
            return None;
        }
        let cell = self.series_grid().cell();
        let [n1, n2] = transform.points();
        let middle = cell.fractions([0.0; 2]);
        let is_hidden = |s: f64, t: f64| self.is_hidden(cell.point([s, t]));
        let rows: Vec<usize> =
            (0..n1.div_ceil(2)).filter(|&i| is_hidden(start[0] + i as f64 / n1 as f64, middle[1])).collect();
        let columns = (0..n2.div_ceil(2)).filter(|&j| !is_hidden(middle[0], start[1] + j as f64 / n2 as f64));
        Some((rows.first().copied()?..rows.last()? + 1, columns.collect()))
    }

    /// Rows and columns of the grid of the series that are those of the contact's own grid.
    pub(super) fn own_samples(&self) -> [Range<usize>; 2] {
        let before = samples_before(self.grid());
        [0, 1].map(|axis| before[axis]..before[axis] + self.grid().points()[axis])
    }

    /// Fractions, of the cell of the series, of the first point of the contact's cell.
    pub(super) fn first_fractions(&self) -> [f64; 2] {
        let cell = self.grid().cell();
        if times(cell) == 1 { [0.0; 2] } else { self.series_grid().cell().fractions(cell.corner()) }
    }
}

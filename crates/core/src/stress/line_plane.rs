//! Stresses on the lines of a path, on a plane of constant depth.
//!
//! A plane is sampled by the rows and columns of [`SlidingLines`]: the waves are summed by transforms, with the axes exchanged where
//! rows follow one another along **a**₂, and each row is shifted along the other axis by a phase of its waves, which is exact. On the surface
//! the stresses are those of the [`SmoothedSurface`].

use super::constants::SHALLOW;
use super::depth_response::StressComponents;
use super::far_plane::FarPlane;
use super::field::{REACH, StressField};
use super::series::Response;
use super::series_grid::times;
use super::sliding_path::{LinePoints, SlidingLines};
use super::smoothed_shear::shear_parts;
use super::smoothed_surface::{NearEdge, Sharp, SmoothedSurface};
use super::tensor::StressState;
use super::transform::Transform;
use crate::body::Depth;
use crate::lattice::Cell;
use crate::lattice::waves::WaveRow;
use crate::numeric::fourier::fast_points;
use std::f64::consts::PI;
use std::sync::Arc;

/// qz beyond which waves are neglected: they have e^{−16} of their pressure.
const LINE_REACH: f64 = 16.0;
/// Samples along a contact radius, of waves that vary on its scale.
const PER_RADIUS: f64 = 16.0;
/// Refinement of planes that are read once more, which are few.
const FINER: usize = 3;

/// Stresses that are kept at each sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Kept {
    /// τ₁.
    pub tau1: bool,
    /// The shear traction σ_xz, σ_yz.
    pub shear: bool,
    /// All stresses.
    pub stress: bool,
    /// Whether lines and places are three times as dense.
    pub finely: bool,
}

/// Stresses of a row of samples, those that are kept.
#[derive(Debug, Default)]
struct KeptRow {
    tau1: Vec<f64>,
    shear: Vec<[f64; 2]>,
    stress: Vec<[f64; 6]>,
}

/// Stresses at the samples of a plane.
#[derive(Debug)]
pub(super) struct LinePlane {
    pub points: LinePoints,
    /// Whether stresses vary slowly from sample to sample.
    pub is_smooth: bool,
    rows: Vec<KeptRow>,
    /// Sides of the cell of the series over those of the contact's own cell.
    times: usize,
    lines: SlidingLines,
}

/// Stresses along a line, those that are kept.
#[derive(Debug, Clone, Default)]
pub(super) struct LineStresses {
    /// Places x, y; lengths.
    pub places: Vec<[f64; 2]>,
    pub tau1: Vec<f64>,
    pub shear: Vec<[f64; 2]>,
    pub stress: Vec<StressState>,
    /// Numbers of samples before and behind the window of an isolated contact.
    pub outside: [usize; 2],
    /// Numbers of the first samples in the next window.
    pub seams: Vec<usize>,
}

/// A row of K components that a field of waves and a smooth far field make.
struct Row<'a, const K: usize> {
    waves: [&'a [f64]; K],
    far: Option<FarRow<'a, K>>,
}

/// The far field with its polynomials along a row, and the fractions of the first column and between two.
type FarRow<'a, const K: usize> = (&'a FarPlane<K>, Vec<[f64; K]>, [f64; 2]);

impl<const K: usize> Row<'_, K> {
    fn at(&self, column: usize) -> [f64; K] {
        let waves = self.waves.map(|wave| wave[column]);
        let Some((plane, line, [first, step])) = &self.far else { return waves };
        let turn = first + column as f64 * step;
        // The far field is read in the window, which lies in the first three quarters of a period from its first column on.
        let far = plane.on(line, if turn >= first + 0.75 { turn - 1.0 } else { turn });
        std::array::from_fn(|k| waves[k] + far[k])
    }
}

impl StressField {
    /// Lines of a path along a direction, a unit vector.
    pub(super) fn sliding_lines(&self, direction: [f64; 2]) -> SlidingLines {
        SlidingLines::new(self.grid().cell(), direction)
    }

    /// Depth from which on stresses vary slowly from sample to sample, a length: zero around the window of a contact.
    pub(super) fn shallow_depth(&self) -> f64 {
        if self.has_hole() { 0.0 } else { SHALLOW * self.spacing() }
    }

    /// Stresses on the lines of a plane under contacts of a `radius`, a length.
    pub(super) fn line_plane(&self, lines: &SlidingLines, depth: Depth, radius: f64, kept: Kept) -> LinePlane {
        let points = self.line_points(lines, depth, radius, if kept.finely { FINER } else { 1 });
        let times = times(self.grid().cell());
        let used = used_columns(lines, points, times);
        let rows = if depth == Depth::SURFACE && self.regions().have_edges() {
            self.surface_rows(lines, points, kept)
        } else {
            let response = self.depth_response(depth, LINE_REACH);
            let (row, _) = self.line_rows(lines, points, &StressComponents(&response), Vec::new(), |_, row| {
                let states = (0..used).map(|j| StressState::from_stresses(row.at(j)));
                KeptRow::of(states, kept)
            });
            row
        };
        LinePlane { points, is_smooth: depth.z >= self.shallow_depth(), rows, times, lines: *lines }
    }

    /// Numbers of rows and columns of a plane: as many as its waves and contacts of a `radius` need, `finer` times as many below the
    /// surface.
    fn line_points(&self, lines: &SlidingLines, depth: Depth, radius: f64, finer: usize) -> LinePoints {
        let [own_rows, own_columns] = [lines.advance, 1 - lines.advance].map(|axis| self.series_grid().points()[axis]);
        let part = times(self.grid().cell());
        let fast = |least: usize| part * fast_points(least.div_ceil(part));
        let [a, b, way] = lines.lengths().map(|length| part as f64 * length);
        let shallow = depth.z < self.shallow_depth();
        let finer = if shallow { 1 } else { finer };
        let waves = |length: f64| LINE_REACH * length / (PI * depth.z);
        let needed = |length: f64, way: f64| waves(length).max(PER_RADIUS * way / radius);
        // A slanting line passes more of its length between two rows.
        let own_rows = own_rows as f64 * way / a;
        let rows = if shallow || needed(a, way) >= own_rows { own_rows } else { needed(a, way) }.ceil() as usize;
        let rows = if rows as f64 == own_rows && finer == 1 { rows } else { fast(finer * rows) };
        let least =
            if shallow || needed(b, b) >= own_columns as f64 { own_columns } else { needed(b, b).ceil() as usize };
        let least = finer * least;
        let columns = if lines.is_sheared() {
            // A shift needs every wave in its place.
            let rows = self.series.waves.rows_within(self.wavenumbers_within(depth, LINE_REACH).len());
            let along = |row: &WaveRow| row.first.abs().max((row.first + row.len as i32 - 1).abs());
            let highest = rows.iter().map(|row| if lines.advance == 0 { row.across } else { along(row) });
            lines.columns(least.max(2 * highest.max().unwrap_or(0) as usize + 1), fast)
        } else if least == own_columns {
            own_columns
        } else {
            fast(least)
        };
        LinePoints { rows, columns }
    }

    /// Values of `read` for each row of the samples of some components, with the buffer of the transform; rows beyond the window of an
    /// isolated contact are left out.
    fn line_rows<const K: usize, T: Send + Sync, R: Response<K>>(
        &self,
        lines: &SlidingLines,
        points: LinePoints,
        response: &R,
        buffer: Vec<f64>,
        read: impl Fn(usize, &Row<'_, K>) -> T + Sync,
    ) -> (Vec<T>, Vec<f64>) {
        let LinePoints { rows, columns } = points;
        let (transform, start) = (Transform::new([rows, columns]), self.first_fractions());
        let fields = match lines.advance {
            0 => self.series.of_waves_from(start, &transform, buffer, response),
            _ => self.series.of_waves_exchanged(start, &transform, buffer, response),
        };
        // The cell of the series is twice the window of an isolated contact along each side.
        let times = times(self.grid().cell());
        let part = times as f64;
        let shift = |row: usize| lines.shift(part * row as f64 / rows as f64) / part;
        let fields = if lines.is_sheared() { fields.sheared(shift) } else { fields };
        let far = response.far().map(|far| if lines.advance == 0 { far } else { far.exchanged() });
        let [first_row, first_column] = [start[lines.advance], start[1 - lines.advance]];
        let read_row = |row: usize, waves: [&[f64]; K]| {
            let along = |far: &FarPlane<K>| far.along(first_row + row as f64 / rows as f64);
            let places = [first_column + shift(row), 1.0 / columns as f64];
            let far = far.as_ref().map(|far| (far, along(far), places));
            read(row, &Row { waves, far })
        };
        let count = rows.div_ceil(times);
        (fields.map_first(count, read_row), fields.into_buffer())
    }

    /// Rows of the surface, sharpened at the edges of contact.
    fn surface_rows(&self, lines: &SlidingLines, points: LinePoints, kept: Kept) -> Vec<KeptRow> {
        let response = Arc::new(self.depth_response(Depth::SURFACE, REACH));
        let smoothed = SmoothedSurface::new(self, &response, 1.0);
        let columns = used_columns(lines, points, times(self.grid().cell()));
        let (near, buffer) = self.line_rows(lines, points, &smoothed.near, Vec::new(), |_, row| {
            let samples = (0..columns).map(|j| (j, row.at(j)));
            samples.filter(|(_, near)| smoothed.sees_edge(*near)).collect::<Vec<(usize, [f64; 3])>>()
        });
        // The tangential fields at all samples, near edges and away from them.
        let shear = smoothed.shear.as_ref().map(|shear| {
            let read = |_, row: &Row<'_, 4>| (0..columns).map(|j| row.at(j)).collect::<Vec<_>>();
            self.line_rows(lines, points, shear, Vec::new(), read).0
        });
        let shear = |i: usize, j: usize| shear_parts(shear.as_ref().map(|rows| rows[i][j]));
        let (sharp, buffer) = self.line_rows(lines, points, &smoothed.edge, buffer, |i, row| {
            let near = near[i].iter().map(|&(j, pressure)| (j, NearEdge { pressure, shear: shear(i, j)[0] }));
            near.map(|(j, near)| (j, smoothed.sharp(near, row.at(j)))).collect::<Vec<_>>()
        });
        let (rows, _) = self.line_rows(lines, points, &smoothed.open, buffer, |i, row| {
            let state = |j: usize, sharp: Sharp| smoothed.toward_open(sharp, row.at(j), shear(i, j)[1]);
            let mut states: Vec<StressState> = (0..columns).map(|j| state(j, Sharp::AWAY)).collect();
            for &(j, sharp) in &sharp[i] {
                states[j] = state(j, sharp);
            }
            KeptRow::of(states.into_iter(), kept)
        });
        rows
    }
}

/// The sum of values of some lines, each with a weight; `None` where they are not kept.
fn sum<const K: usize>(weights: &[(f64, usize)], value: impl Fn(usize) -> Option<[f64; K]>) -> Option<[f64; K]> {
    let add = |sum: [f64; K], (weight, values): (f64, [f64; K])| std::array::from_fn(|k| sum[k] + weight * values[k]);
    let terms = weights.iter().map(|&(weight, line)| Some((weight, value(line)?)));
    terms
        .collect::<Option<Vec<_>>>()
        .filter(|terms| !terms.is_empty())
        .map(|terms| terms.into_iter().fold([0.0; K], add))
}

/// Columns, from the first on, that reach into the window of an isolated contact: half of them where they are not shifted.
fn used_columns(lines: &SlidingLines, LinePoints { columns, .. }: LinePoints, times: usize) -> usize {
    if lines.is_sheared() { columns } else { columns.div_ceil(times) }
}

impl KeptRow {
    fn of(states: impl Iterator<Item = StressState>, kept: Kept) -> Self {
        let mut row = Self::default();
        for state in states {
            if kept.tau1 {
                row.tau1.push(state.tau1());
            }
            if kept.shear {
                row.shear.push([state.xz, state.yz]);
            }
            if kept.stress {
                let [stresses @ .., _, _, _] = state.components();
                row.stress.push(stresses);
            }
        }
        row
    }
}

impl LineStresses {
    /// Adds a place with its state behind the others.
    pub fn push(&mut self, place: [f64; 2], state: StressState, kept: Kept) {
        self.places.push(place);
        if kept.tau1 {
            self.tau1.push(state.tau1());
        }
        if kept.shear {
            self.shear.push([state.xz, state.yz]);
        }
        if kept.stress {
            self.stress.push(state);
        }
    }
}

impl LineStresses {
    /// Adds samples behind the others.
    pub fn append(&mut self, other: Self) {
        self.places.extend(other.places);
        self.tau1.extend(other.tau1);
        self.shear.extend(other.shear);
        self.stress.extend(other.stress);
    }

    /// Adds samples of the next window at both ends.
    pub fn lengthen(&mut self, mut before: Self, behind: Self) {
        let [first, last] = [before.places.len(), before.places.len() + self.places.len()];
        let seams = self.seams.iter().map(|seam| seam + first);
        before.seams = std::iter::once(first).chain(seams).chain([last]).collect();
        before.outside = [self.outside[0] + first, self.outside[1] + behind.places.len()];
        before.append(std::mem::take(self));
        before.append(behind);
        *self = before;
    }
}

impl LinePlane {
    /// Number, 0 or 1, of the cell vector along which rows follow one another.
    pub fn advance(&self) -> usize {
        self.lines.advance
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The sum of the samples of some lines in a row, each with a weight; `None` where one of them lies beyond the window of an isolated
    /// contact.
    pub fn combined(&self, cell: Cell, row: usize, weights: &[(f64, usize)]) -> Option<LineStresses> {
        let (mut place, kept) = ([0.0; 2], self.rows.get(row)?);
        for &(weight, line) in weights {
            let sample = self.place(cell, [row, line])?;
            place = [0, 1].map(|k| place[k] + weight * sample[k]);
        }
        Some(LineStresses {
            places: vec![place],
            tau1: sum(weights, |line| kept.tau1.get(line).map(|tau1| [*tau1])).map(|[tau1]| tau1).into_iter().collect(),
            shear: sum(weights, |line| kept.shear.get(line).copied()).into_iter().collect(),
            stress: sum(weights, |line| kept.stress.get(line).copied())
                .map(StressState::from_stresses)
                .into_iter()
                .collect(),
            ..LineStresses::default()
        })
    }

    /// Number of lines.
    pub fn count(&self) -> usize {
        self.lines.count(self.points)
    }

    /// Place x, y of a sample, lengths; `None` beyond the window of an isolated contact.
    fn place(&self, cell: Cell, [row, column]: [usize; 2]) -> Option<[f64; 2]> {
        let LinePoints { rows, columns } = self.points;
        let part = self.times as f64;
        let [u, v] = [part * row as f64 / rows as f64, part * column as f64 / columns as f64];
        let fractions = self.lines.fractions(u, v);
        let is_within = |s: f64| (-1e-9..1.0).contains(&s);
        (self.times == 1 || fractions.into_iter().all(is_within)).then(|| cell.point(fractions))
    }

    /// Place x, y of the first sample of a line, lengths; `None` where none of it lies in the window of an isolated contact.
    pub fn first_place(&self, cell: Cell, line: usize) -> Option<[f64; 2]> {
        self.lines
            .samples(line, self.points)
            .into_iter()
            .take_while(|[row, _]| *row < self.rows.len())
            .find_map(|sample| self.place(cell, sample))
    }

    /// Stresses along a line; empty where none of it lies in the window of an isolated contact.
    pub fn line(&self, cell: Cell, line: usize) -> LineStresses {
        let mut stresses = LineStresses::default();
        for sample @ [row, column] in self.lines.samples(line, self.points) {
            let (Some(place), Some(kept)) = (self.place(cell, sample), self.rows.get(row)) else { continue };
            stresses.places.push(place);
            stresses.tau1.extend(kept.tau1.get(column));
            stresses.shear.extend(kept.shear.get(column));
            stresses.stress.extend(kept.stress.get(column).map(|stress| StressState::from_stresses(*stress)));
        }
        stresses
    }
}

//! The traction on a surface as a sum of plane waves, and linear responses to it.
//!
//! p(**x**) = p̄ + Re Σ c e^{i**q**·**x**} over the [`Waves`] of the grid, and q_x and q_y alike where they do not
//! follow from p, and the flux of heat. A component of stress or displacement at a depth is the same sum with c times a complex factor of **q**: a [`Response`]. It is summed over the points of a plane by transforms,
//! and at single points term by term.

use super::disc_waves::waves_of_discs;
use super::far_plane::FarPlane;
use super::phases::Phases;
use super::series_grid::spread;
use super::traction::Traction;
use super::traction_waves::{TractionWave, TractionWaves, Wave};
use super::transform::{FieldColumn, FieldColumns, Transform};
use super::work::WorkCounter;
use crate::lattice::Grid;
use crate::lattice::waves::{WaveRow, Waves};
use crate::numeric::lanes::{LANES, vectorised};
use crate::numeric::{parallel, sums};
use rustfft::num_complex::Complex64;
use std::ops::Range;
use std::sync::Arc;

/// K components of stress or displacement that depend linearly on the traction.
pub(super) trait Response<const K: usize>: Sync {
    /// Number of shells that contribute, from the longest waves on.
    fn shells(&self) -> usize;
    /// Response to a wave with the wavevector **q** of a shell: its coefficients times factors that are conjugate for −**q**.
    fn times<W: Wave>(&self, q: [f64; 2], shell: usize, wave: W) -> [Complex64; K];
    /// Response to the mean traction.
    fn mean(&self) -> [f64; K];
    /// Whether the response lies as deep below the surface as the exact waves of discs are summed, see [`Series::coefficients`].
    fn is_deep(&self) -> bool {
        false
    }
    /// Difference of the free field and the periodic one of the series; `None` where the system is periodic.
    fn far(&self) -> Option<FarPlane<K>> {
        None
    }
}

/// Plane waves of a periodic traction.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// Mean pressure p̄.
    pub mean: f64,
    pub waves: Arc<Waves>,
    /// Coefficients of each wave of the samples.
    sampled: TractionWaves,
    /// Coefficients with the pressure of the discs themselves, whatever the samples see of them; `None` of another pressure.
    exact: Option<TractionWaves>,
    /// Counters of the planes that are transformed.
    work: Arc<WorkCounter>,
}

/// Least number of waves per thread.
pub(super) const PARALLEL_WAVES: usize = 4096;

impl Series {
    /// Waves of a `pressure`, one value per sample of `grid`.
    pub fn new(grid: &Grid, pressure: &[f64]) -> Self {
        let [n1, n2] = grid.points();
        let columns = Transform::new([n1, n2]).analysed(pressure);
        let waves = Arc::clone(grid.waves());
        let sampled = waves.coefficients(|[k1, k2]| {
            let [k1, k2] = [k1.rem_euclid(n1 as i32) as usize, k2.rem_euclid(n2 as i32) as usize];
            // A wave and its conjugate share one coefficient.
            if 2 * k2 <= n2 {
                2.0 * columns[k2 * n1 + k1]
            } else {
                2.0 * columns[(n2 - k2) * n1 + (n1 - k1) % n1].conj()
            }
        });
        let sampled = TractionWaves { pressure: sampled, shear: None, heat: None };
        Self { mean: columns[0].re, waves, sampled, exact: None, work: Arc::default() }
    }

    /// Waves of a traction on its `own_grid`, and the means of its fields q_x and q_y, zero where these follow from the pressure. `pressure`
    /// has one value per sample of the `grid` of the series.
    pub fn under(grid: &Grid, own_grid: &Grid, traction: &Traction<'_>, pressure: &[f64]) -> (Self, [f64; 2]) {
        let (mut series, mut mean_shear) = (Self::new(grid, pressure), [0.0; 2]);
        if let Some(fields) = traction.fields() {
            let [x, y] = fields.map(|field| Self::new(grid, &spread(own_grid, field)));
            mean_shear = [x.mean, y.mean];
            series.sampled.shear = Some([x, y].map(|field| field.sampled.pressure));
        }
        if let Some(heat) = traction.heat() {
            let flux = Self::new(grid, &spread(own_grid, &heat.flux)).sampled.pressure;
            series.sampled = series.sampled.heated(flux, traction.form().ratio());
        }
        let (discs, pressed) = (traction.discs(), traction.pressure());
        if !discs.is_empty() {
            let pressure = waves_of_discs(&series.waves, grid.cell(), discs);
            let shear = series.sampled.shear.clone().filter(|_| traction.fields().is_some());
            let exact = TractionWaves { pressure, shear, heat: None };
            series.exact = Some(match traction.heat() {
                // Below a given pressure the flux is a multiple of it.
                Some(heat) => {
                    let [flux, whole] = sums::of(pressed.len(), |i| [heat.flux[i], pressed[i]]);
                    let warm = exact.pressure.iter().map(|p| flux / whole * p).collect();
                    exact.heated(warm, traction.form().ratio())
                }
                None => exact,
            });
        }
        (series, mean_shear)
    }

    /// The series of waves with these coefficients, without a mean.
    pub fn of_waves(waves: Arc<Waves>, coefficients: TractionWaves) -> Self {
        Self { mean: 0.0, waves, sampled: coefficients, exact: None, work: Arc::default() }
    }

    /// The series with the same waves in other shells.
    pub fn in_shells_of(self, waves: &Arc<Waves>) -> Self {
        Self { waves: Arc::clone(waves), ..self }
    }

    /// The series, whose planes are counted by `work`.
    pub fn counted_by(self, work: &Arc<WorkCounter>) -> Self {
        Self { work: Arc::clone(work), ..self }
    }

    /// Coefficients of each wave. Near the surface, where waves beyond those of the grid count, they are those of the samples: means
    /// over their cells, which ring less. Where the response `is_deep`, they are those of the discs, if there are any.
    pub fn coefficients(&self, is_deep: bool) -> &TractionWaves {
        self.exact.as_ref().filter(|_| is_deep).unwrap_or(&self.sampled)
    }

    /// Wavevector, shell and coefficient of the waves of a row, see [`Self::coefficients`].
    pub fn of<'a, W: Wave + 'a>(
        &'a self,
        row: &'a WaveRow,
        is_deep: bool,
    ) -> impl Iterator<Item = ([f64; 2], usize, W)> + 'a {
        let range = row.start..row.start + row.len;
        let TractionWaves { pressure, shear, heat } = self.coefficients(is_deep);
        let pairs = self.waves.shells()[range.clone()].iter().zip(&pressure[range.clone()]);
        let shear = shear.as_ref().map(|fields| fields.each_ref().map(|field| &field[range.clone()]));
        let heat = heat.as_ref().map(|flux| &flux[range.clone()]);
        let step = self.waves.step();
        pairs.enumerate().map(move |(k, (&shell, &pressure))| {
            let shear = || shear.map_or_else(Default::default, |[x, y]| [x[k], y[k]]);
            let wave = W::new(pressure, shear, || heat.map_or_else(Default::default, |flux| flux[k]));
            (row.at(k, step), shell as usize, wave)
        })
    }

    /// Components at the points of the transform: exact there, however few they are, as aliased waves add up. For the `buffer`
    /// see [`Transform::columns`].
    pub fn on_plane<'t, const K: usize, R: Response<K>>(
        &self,
        transform: &'t Transform,
        buffer: Vec<f64>,
        response: &R,
    ) -> FieldColumns<'t, K> {
        self.on_plane_from([0.0; 2], transform, buffer, response)
    }

    /// Components at the points of the transform, the first of which is at the fractions `start` of a₁ and a₂.
    pub fn on_plane_from<'t, const K: usize, R: Response<K>>(
        &self,
        start: [f64; 2],
        transform: &'t Transform,
        buffer: Vec<f64>,
        response: &R,
    ) -> FieldColumns<'t, K> {
        self.of_waves_from(start, transform, buffer, response).with_far(response.far(), start)
    }

    /// Contribution of the waves and the mean pressure to [`Self::on_plane_from`].
    pub fn of_waves_from<'t, const K: usize, R: Response<K>>(
        &self,
        start: [f64; 2],
        transform: &'t Transform,
        buffer: Vec<f64>,
        response: &R,
    ) -> FieldColumns<'t, K> {
        let [n1, n2] = transform.points().map(|n| n as i32);
        let rows = self.waves.rows_within(response.shells());
        // Re C e^{iq·x} is half the wave and half its conjugate; each belongs to one column or to its mirror image.
        let sides = rows.iter().flat_map(|row| [(row, 1), (row, -1)]);
        let mut placed: Vec<(i32, i32, &WaveRow)> = sides
            .map(|(row, sign)| ((sign * row.across).rem_euclid(n2), sign, row))
            .filter(|(column, ..)| 2 * column <= n2)
            .collect();
        placed.sort_by_key(|&(column, ..)| column);
        let mean = response.mean();
        let of = |columns: Range<usize>| {
            let [first, end] =
                [columns.start, columns.end].map(|k2| placed.partition_point(|&(column, ..)| column < k2 as i32));
            &placed[first..end]
        };
        let occupied = |columns: Range<usize>| columns.start == 0 || !of(columns).is_empty();
        let has_shear = self.coefficients(response.is_deep()).shear.is_some();
        let moved = Moved::by(start, &rows);
        self.work.add_planes(K);
        transform.columns(buffer, occupied, |k2, column: &mut FieldColumn<'_, K>| {
            if k2 == 0 {
                column.add(0, mean.map(Complex64::from));
            }
            for &(_, sign, row) in of(k2..k2 + 1) {
                match has_shear {
                    false => self.add_row::<Complex64, K, R>((row, sign), n1, moved.as_ref(), column, response),
                    true => self.add_row::<TractionWave, K, R>((row, sign), n1, moved.as_ref(), column, response),
                }
            }
        })
    }

    /// Adds the waves of a row, or with the sign −1 their conjugates, to their bins of a column of `n1`.
    #[inline(always)]
    fn add_row<W: Wave, const K: usize, R: Response<K>>(
        &self,
        (row, sign): (&WaveRow, i32),
        n1: i32,
        moved: Option<&Moved>,
        column: &mut FieldColumn<'_, K>,
        response: &R,
    ) {
        let (side, turns) = (f64::from(sign), moved.map(|moved| moved.of(row)));
        let mut bin = (sign * row.first).rem_euclid(n1);
        for (k, (q, shell, c)) in self.of::<W>(row, response.is_deep()).enumerate() {
            let c = turns.as_ref().map_or_else(|| c * 0.5, |turns| c * (turns.at(k) * 0.5));
            let waves = response.times(q, shell, c);
            column.add(bin as usize, waves.map(|wave| Complex64::new(wave.re, side * wave.im)));
            bin += sign;
            if bin == n1 {
                bin = 0;
            } else if bin < 0 {
                bin = n1 - 1;
            }
        }
    }

    /// Fields of [`Self::of_waves_from`] with the axes of the transform exchanged: rows follow one another along a₂,
    /// columns along a₁.
    pub fn of_waves_exchanged<'t, const K: usize, R: Response<K>>(
        &self,
        start: [f64; 2],
        transform: &'t Transform,
        buffer: Vec<f64>,
        response: &R,
    ) -> FieldColumns<'t, K> {
        let [n2, n1] = transform.points().map(|n| n as i32);
        let (rows, mean, step) = (self.waves.rows_within(response.shells()), response.mean(), self.waves.step());
        let (coefficients, moved) = (self.coefficients(response.is_deep()), Moved::new(start, &rows));
        self.work.add_planes(K);
        transform.columns(
            buffer,
            |_| true,
            |k1, column: &mut FieldColumn<'_, K>| {
                if k1 == 0 {
                    column.add(0, mean.map(Complex64::from));
                }
                // Re C e^{iq·x} is half the wave and half its conjugate; each belongs to one column or to its mirror image.
                for (row, sign) in rows.iter().flat_map(|row| [(row, 1), (row, -1)]) {
                    let (bin, turns) = ((sign * row.across).rem_euclid(n2) as usize, moved.of(row));
                    let first = (sign * k1 as i32 - row.first).rem_euclid(n1) as usize;
                    for k in (first..row.len).step_by(n1 as usize) {
                        let number = row.start + k;
                        let turned = turns.at(k);
                        let (q, shell) = (row.at(k, step), self.waves.shells()[number] as usize);
                        let waves = match coefficients.shear {
                            None => response.times(q, shell, coefficients.at::<Complex64>(number) * 0.5 * turned),
                            Some(_) => response.times(q, shell, coefficients.at::<TractionWave>(number) * 0.5 * turned),
                        };
                        let side = f64::from(sign);
                        column.add(bin, waves.map(|wave| Complex64::new(wave.re, side * wave.im)));
                    }
                }
            },
        )
    }

    /// Components at points, given as fractions of a₁ and a₂, by the exact sum.
    pub fn at<const K: usize, R: Response<K>>(&self, places: &[[f64; 2]], response: &R) -> Vec<[f64; K]> {
        let rows = self.waves.rows_within(response.shells());
        let together = places.chunks_exact(LANES);
        let rest = together.remainder().iter().flat_map(|&place| self.lanes(&rows, [place], response));
        let rest: Vec<[f64; K]> = rest.collect();
        let lanes =
            |places: &[[f64; 2]]| self.lanes::<K, LANES, R>(&rows, std::array::from_fn(|p| places[p]), response);
        let mut all: Vec<[f64; K]> = together.flat_map(lanes).chain(rest).collect();
        if let Some(far) = response.far() {
            for (sum, &place) in all.iter_mut().zip(places) {
                sum.iter_mut().zip(far.at(place)).for_each(|(component, far)| *component += far);
            }
        }
        all
    }

    fn lanes<const K: usize, const P: usize, R: Response<K>>(
        &self,
        rows: &[WaveRow],
        places: [[f64; 2]; P],
        response: &R,
    ) -> [[f64; K]; P] {
        let along = Phases::along(rows, places.map(|[s, _]| s));
        let across = Phases::across(rows, places.map(|[_, t]| t));
        let has_shear = self.coefficients(response.is_deep()).shear.is_some();
        let of_row = |row: &WaveRow| match has_shear {
            false => {
                vectorised!(_simd => self.row::<Complex64, K, P, R>(row, along.from(row), across.of(row), response))
            }
            true => self.row::<TractionWave, K, P, R>(row, along.from(row), across.of(row), response),
        };
        let waves: usize = rows.iter().map(|row| row.len).sum();
        // Rows are added in their order, whatever the threads.
        let sums: Vec<[[f64; P]; K]> =
            parallel::map_by(PARALLEL_WAVES * rows.len() / waves.max(1), rows.len(), |number| of_row(&rows[number]));
        let mean = response.mean();
        std::array::from_fn(|p| std::array::from_fn(|k| mean[k] + sums.iter().map(|sum| sum[k][p]).sum::<f64>()))
    }

    /// Sums over the waves of a row at some points, by their phases.
    #[inline(always)]
    fn row<W: Wave, const K: usize, const P: usize, R: Response<K>>(
        &self,
        row: &WaveRow,
        along: &[[[f64; P]; 2]],
        [across_re, across_im]: &[[f64; P]; 2],
        response: &R,
    ) -> [[f64; P]; K] {
        let mut sums = [[0.0; P]; K];
        for ((q, shell, c), [along_re, along_im]) in self.of::<W>(row, response.is_deep()).zip(along) {
            let waves = response.times(q, shell, c);
            for p in 0..P {
                let re = along_re[p] * across_re[p] - along_im[p] * across_im[p];
                let im = along_re[p] * across_im[p] + along_im[p] * across_re[p];
                for k in 0..K {
                    sums[k][p] += waves[k].re * re - waves[k].im * im;
                }
            }
        }
        sums
    }
}

/// Phases of the waves at the fractions of a₁ and a₂ from which planes begin.
#[derive(Debug)]
struct Moved {
    along: Phases<1>,
    across: Phases<1>,
}

/// Phases of the waves of a row.
#[derive(Debug)]
struct RowTurns<'a> {
    across: Complex64,
    along: &'a [[[f64; 1]; 2]],
}

impl Moved {
    fn new([s, t]: [f64; 2], rows: &[WaveRow]) -> Self {
        Self { along: Phases::along(rows, [s]), across: Phases::across(rows, [t]) }
    }

    /// The phases; `None` at the origin, where they are 1.
    fn by(start: [f64; 2], rows: &[WaveRow]) -> Option<Self> {
        (start != [0.0; 2]).then(|| Self::new(start, rows))
    }

    fn of(&self, row: &WaveRow) -> RowTurns<'_> {
        let &[[re], [im]] = self.across.of(row);
        RowTurns { across: Complex64::new(re, im), along: self.along.from(row) }
    }
}

impl RowTurns<'_> {
    /// The phase of the wave number k of the row.
    #[inline(always)]
    fn at(&self, k: usize) -> Complex64 {
        let [[re], [im]] = self.along[k];
        self.across * Complex64::new(re, im)
    }
}

//! A pressure that is given, on discs or as a field, in the place of a counterbody.
//!
//! A sample of a grid has the mean pressure over its cell, the parallelogram of the grid's steps around it: of a disc the part of the
//! cell that it covers, of a field the overlap with the cells of the samples that it is given on. So the force is exact on every
//! grid. What is left is second order in the spacing d: a wave of the wavenumber q is damped by 1 − (qd)²/24 along each step, which
//! leaves an error of the order (d/z)²/24 at a depth z.

use super::loaded_disc::Arrangement;
use super::{CounterbodyError, LoadedDisc};
use crate::lattice::{Cell, Grid};
use ndarray::{Array2, ArrayView2};
use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

/// Part of a window from its middle within which discs stay: beyond, the outermost samples of a coarse grid would miss a part of them.
const ROOM: f64 = 0.875;

/// A given pressure on one cell, or on the window of an isolated one.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenPressure {
    cell: Cell,
    distribution: Distribution,
}

/// How a pressure is distributed.
#[derive(Debug, Clone, PartialEq)]
enum Distribution {
    Discs(Vec<LoadedDisc>),
    /// Mean pressures of the cells of samples, axes along a₁ and a₂.
    Field(Arc<Array2<f64>>),
}

impl GivenPressure {
    /// Uniform pressures on discs, whose pressures add where they overlap. In a periodic system a disc may cross the border of the
    /// cell.
    ///
    /// # Errors
    /// [`CounterbodyError::Disc`] for one with a radius or a pressure out of range, [`CounterbodyError::OutsideWindow`] for one that
    /// has no room in the window of an isolated system, [`CounterbodyError::Unloaded`] where nothing is loaded.
    pub fn discs(cell: Cell, discs: Vec<LoadedDisc>) -> Result<Self, CounterbodyError> {
        for (number, disc) in (1..).zip(&discs) {
            let LoadedDisc { centre: [x, y], radius, pressure } = *disc;
            let is_valid = [x, y, radius, pressure].iter().all(|x| x.is_finite()) && radius > 0.0 && pressure >= 0.0;
            if !is_valid {
                return Err(CounterbodyError::Disc(number));
            }
            let room = cell.window_sides().map(|sides| sides.map(|side| 0.5 * ROOM * side));
            if let Some(room) = room.filter(|room| x.abs() + radius > room[0] || y.abs() + radius > room[1]) {
                return Err(CounterbodyError::OutsideWindow { disc: number, room });
            }
        }
        let force: f64 = discs.iter().map(|disc| disc.pressure * disc.radius * disc.radius).sum();
        let given = Self { cell, distribution: Distribution::Discs(discs) };
        if force > 0.0 { Ok(given) } else { Err(CounterbodyError::Unloaded) }
    }

    /// A field of pressures ≥ 0 at equally spaced samples, axis 0 along a₁, axis 1 along a₂, sample \[0, 0\] at the corner of the
    /// cell, each the mean over the cell of the sample.
    ///
    /// # Errors
    /// [`CounterbodyError::Pressure`] for a value that is negative or not finite, [`CounterbodyError::Unloaded`] where all are zero
    /// or there are none.
    pub fn field(cell: Cell, pressure: Array2<f64>) -> Result<Self, CounterbodyError> {
        if let Some(((i, j), &value)) = pressure.indexed_iter().find(|(_, p)| !(p.is_finite() && **p >= 0.0)) {
            return Err(CounterbodyError::Pressure { place: [i, j], value });
        }
        if pressure.iter().all(|&p| p == 0.0) {
            return Err(CounterbodyError::Unloaded);
        }
        Ok(Self { cell, distribution: Distribution::Field(Arc::new(pressure)) })
    }

    /// The unit cell, or the window.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// The discs; none for a field.
    pub fn loaded_discs(&self) -> &[LoadedDisc] {
        match &self.distribution {
            Distribution::Discs(discs) => discs,
            Distribution::Field(_) => &[],
        }
    }

    /// The field, axes along a₁ and a₂; `None` for discs.
    pub fn values(&self) -> Option<ArrayView2<'_, f64>> {
        match &self.distribution {
            Distribution::Discs(_) => None,
            Distribution::Field(values) => Some(values.view()),
        }
    }

    /// Force on the cell, a pressure times an area.
    pub fn force(&self) -> f64 {
        match &self.distribution {
            Distribution::Discs(discs) => discs.iter().map(|disc| PI * disc.radius * disc.radius * disc.pressure).sum(),
            Distribution::Field(values) => values.sum() / values.len() as f64 * self.cell.area(),
        }
    }

    /// The largest pressure; where discs overlap, of all of them together.
    pub fn highest(&self) -> f64 {
        match &self.distribution {
            Distribution::Discs(discs) => Arrangement::new(self.cell, discs).highest(),
            Distribution::Field(values) => values.iter().copied().fold(0.0, f64::max),
        }
    }

    /// Area under pressure in the cell, a length squared; `None` where discs overlap.
    pub fn loaded_area(&self) -> Option<f64> {
        match &self.distribution {
            Distribution::Discs(discs) => {
                let arrangement = Arrangement::new(self.cell, discs);
                let area = arrangement.discs().map(|disc| PI * disc.radius * disc.radius).sum();
                (!arrangement.overlaps()).then_some(area)
            }
            Distribution::Field(values) => {
                Some(values.iter().filter(|p| **p > 0.0).count() as f64 / values.len() as f64 * self.cell.area())
            }
        }
    }

    /// The pressure on a grid of the cell, one value per sample, axes along a₁ and a₂; its force is [`Self::force`].
    pub fn on(&self, grid: &Grid) -> Array2<f64> {
        match &self.distribution {
            Distribution::Discs(discs) => {
                let mut pressure = Array2::zeros(grid.points());
                discs.iter().for_each(|disc| disc.add(grid, &mut pressure));
                pressure
            }
            Distribution::Field(values) => averaged(values, grid.points()),
        }
    }
}

/// A field of means over the cells of its samples, over the cells of `points` samples; the sum over the area is kept.
fn averaged(values: &Array2<f64>, points: [usize; 2]) -> Array2<f64> {
    let (n1, n2) = values.dim();
    let [along, across] = [(n1, points[0]), (n2, points[1])].map(|(given, wanted)| overlaps(given, wanted));
    Array2::from_shape_fn(points, |(i, j)| {
        let row = |&(k, weight): &(usize, f64)| {
            weight * across[j].iter().map(|&(l, weight)| weight * values[[k, l]]).sum::<f64>()
        };
        along[i].iter().map(row).sum()
    })
}

/// For each of `wanted` cells around a line, the cells of `given` that it overlaps, with their parts of it.
fn overlaps(given: usize, wanted: usize) -> Vec<Vec<(usize, f64)>> {
    if given == wanted {
        return (0..given).map(|k| vec![(k, 1.0)]).collect();
    }
    // In units of a cell of `given`; both lines have a sample at zero, in the middle of its cell.
    let width = given as f64 / wanted as f64;
    let of = |i: usize| {
        let (start, end) = ((i as f64 - 0.5) * width + 0.5, (i as f64 + 0.5) * width + 0.5);
        let cells = start.floor() as i64..=end.floor() as i64;
        let part = |k: i64| (end.min(k as f64 + 1.0) - start.max(k as f64)) / width;
        cells.map(|k| (k.rem_euclid(given as i64) as usize, part(k))).filter(|(_, part)| *part > 0.0).collect()
    };
    (0..wanted).map(of).collect()
}

impl fmt::Display for GivenPressure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.distribution {
            Distribution::Discs(discs) => {
                write!(f, "given pressure on {} disc{}", discs.len(), if discs.len() == 1 { "" } else { "s" })?;
            }
            Distribution::Field(values) => {
                write!(f, "given pressure at {} × {} samples", values.nrows(), values.ncols())?
            }
        }
        write!(f, " in a {}", self.cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On rectangular and oblique cells, over their borders and on coarse grids, the force is exact; a sample inside has the whole
    /// pressure.
    #[test]
    fn the_force_of_discs_is_exact_on_every_grid() {
        let discs = vec![
            LoadedDisc { centre: [0.1, 0.2], radius: 0.23, pressure: 2.0 },
            LoadedDisc { centre: [0.9, 0.95], radius: 0.31, pressure: 0.7 },
            LoadedDisc { centre: [0.4, 0.4], radius: 1e-3, pressure: 5.0 },
        ];
        let oblique = [([1.0, 0.2], [0.4, 0.9]), ([0.4, 0.9], [1.0, 0.2])].map(|(a1, a2)| Cell::new(a1, a2).unwrap());
        for cell in [Cell::square(1.0).unwrap(), Cell::hexagonal(1.0).unwrap()].into_iter().chain(oblique) {
            let given = GivenPressure::discs(cell, discs.clone()).unwrap();
            for points in [[5, 4], [64, 64], [50, 81]] {
                let grid = Grid::new(cell, points).unwrap();
                let pressure = given.on(&grid);
                let force = pressure.sum() * grid.sample_area();
                assert!((force / given.force() - 1.0).abs() < 1e-12, "{cell}, {points:?}: {force}");
                // At most 7.7, where all three overlap.
                assert!(pressure.iter().all(|p| (0.0..=7.7 + 1e-12).contains(p)), "{cell}, {points:?}");
            }
        }
        let window = Cell::window([2.0, 2.0]).unwrap();
        let given =
            GivenPressure::discs(window, vec![LoadedDisc { centre: [0.2, 0.0], radius: 0.5, pressure: 3.0 }]).unwrap();
        let grid = Grid::new(window, [64; 2]).unwrap();
        let pressure = given.on(&grid);
        let at = |x: f64, y: f64| pressure[[(32.0 * (x + 1.0)) as usize, (32.0 * (y + 1.0)) as usize]];
        assert!((at(0.2, 0.0) - 3.0).abs() < 1e-12 && at(-0.5, 0.0) == 0.0 && at(0.2, 0.9) == 0.0);
        // No sample beyond the reach of the disc has a trace of pressure.
        let beyond = pressure.indexed_iter().filter(|((i, j), p)| {
            let [x, y] = [*i, *j].map(|k| k as f64 / 32.0 - 1.0);
            **p > 0.0 && (x - 0.2).hypot(y) > 0.5 + 0.75 / 32.0
        });
        assert_eq!(beyond.count(), 0);
    }

    /// The moments of a disc on a grid: its middle, and its radius to second order.
    #[test]
    fn a_disc_is_where_it_is() {
        let window = Cell::window([2.0, 2.0]).unwrap();
        let error = |n: usize| {
            let (centre, radius) = ([0.13, -0.21], 0.4);
            let given = GivenPressure::discs(window, vec![LoadedDisc { centre, radius, pressure: 1.0 }]).unwrap();
            let grid = Grid::new(window, [n; 2]).unwrap();
            let place = |i: usize, j: usize| window.point([i as f64 / n as f64, j as f64 / n as f64]);
            let (mut first, mut second) = ([0.0; 2], 0.0);
            for ((i, j), p) in given.on(&grid).indexed_iter() {
                let [x, y] = place(i, j);
                first = [first[0] + p * x, first[1] + p * y];
                second += p * ((x - centre[0]).powi(2) + (y - centre[1]).powi(2));
            }
            let scale = grid.sample_area() / given.force();
            assert!((0..2).all(|k| (first[k] * scale - centre[k]).abs() < 0.1 / (n * n) as f64), "{first:?}");
            second * scale / (0.5 * radius * radius) - 1.0
        };
        let (coarse, fine) = (error(32), error(64));
        assert!(coarse.abs() < 0.02 && fine.abs() < 0.35 * coarse.abs(), "{coarse:e}, {fine:e}");
    }

    #[test]
    fn a_field_keeps_its_force_and_its_values_where_grids_agree() {
        let cell = Cell::square(3.0).unwrap();
        let values = Array2::from_shape_fn([12, 10], |(i, j)| ((7 * i + 3 * j * j) % 5) as f64);
        let given = GivenPressure::field(cell, values.clone()).unwrap();
        for points in [[12, 10], [6, 5], [24, 20], [7, 16]] {
            let grid = Grid::new(cell, points).unwrap();
            let pressure = given.on(&grid);
            assert!((pressure.sum() * grid.sample_area() / given.force() - 1.0).abs() < 1e-13, "{points:?}");
            assert!(points != [12, 10] || pressure == values);
        }
    }

    #[test]
    fn the_area_of_discs_that_overlap_is_left_to_the_samples() {
        let discs = |x: f64, radius: f64| {
            let disc = |x: f64| LoadedDisc { centre: [x, 0.5], radius, pressure: 1.0 };
            GivenPressure::discs(Cell::square(1.0).unwrap(), vec![disc(0.1), disc(0.1 + x)]).unwrap().loaded_area()
        };
        assert_eq!(discs(0.5, 0.2), Some(2.0 * PI * 0.2 * 0.2));
        // By themselves, by an image of the other one, by their own images.
        assert_eq!([discs(0.3, 0.2), discs(0.7, 0.2), discs(0.5, 0.6)], [None; 3]);
        let alone = vec![LoadedDisc { centre: [0.0; 2], radius: 0.8, pressure: 1.0 }];
        let alone = GivenPressure::discs(Cell::window([2.0; 2]).unwrap(), alone).unwrap();
        assert_eq!(alone.loaded_area(), Some(PI * 0.8 * 0.8));
    }

    #[test]
    fn what_is_no_pressure_is_refused() {
        let window = Cell::window([2.0, 2.0]).unwrap();
        let disc = |x: f64, radius: f64, pressure: f64| {
            GivenPressure::discs(window, vec![LoadedDisc { centre: [x, 0.0], radius, pressure }])
        };
        assert_eq!(disc(0.0, 0.0, 1.0), Err(CounterbodyError::Disc(1)));
        assert_eq!(disc(0.0, 0.1, -1.0), Err(CounterbodyError::Disc(1)));
        assert_eq!(disc(0.0, 0.1, 0.0), Err(CounterbodyError::Unloaded));
        assert_eq!(disc(0.6, 0.3, 1.0), Err(CounterbodyError::OutsideWindow { disc: 1, room: [0.875; 2] }));
        let field = |value: f64| GivenPressure::field(window, Array2::from_elem([2, 2], value));
        assert_eq!(field(-1.0), Err(CounterbodyError::Pressure { place: [0, 0], value: -1.0 }));
        assert_eq!(field(0.0), Err(CounterbodyError::Unloaded));
    }
}

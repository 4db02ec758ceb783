//! The doubly periodic grid on a cell, and its wavevectors.
//!
//! Samples lie at x = (i/N₁) **a**₁ + (j/N₂) **a**₂, sample (0, 0) at the [corner](Cell::corner) of the cell, the origin unless it
//! is a window; fields are stored row by row, j
//! (along **a**₂) fastest. The index (k₁, k₂) of a Fourier component means the wavevector k₁**b**₁ + k₂**b**₂ up to
//! multiples of N₁**b**₁ and N₂**b**₂ (its aliases). The one of least length is taken: on an oblique cell the usual
//! index range is a parallelogram that breaks the lattice's symmetry, the set of shortest aliases (the first Brillouin
//! zone of the sampling lattice) keeps it.

use super::cell::norm;
use super::waves::{BORDER_TOLERANCE, WAVENUMBER_TOLERANCE, Waves};
use super::zone::BrillouinZone;
use super::{Cell, LatticeError};
use crate::notation::number;
use std::fmt;
use std::sync::{Arc, OnceLock};

/// A field whose shape is not that of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "a field of {} × {} values does not belong to a grid of {} × {} samples: give one value for each",
    .field[0], .field[1], .points[0], .points[1]
)]
pub struct NotOnGrid {
    /// Shape of the field, along a₁ and a₂.
    pub field: [usize; 2],
    /// Number of samples of the grid along a₁ and a₂.
    pub points: [usize; 2],
}

/// A grid of N₁ × N₂ samples on a cell.
#[derive(Debug, Clone)]
pub struct Grid {
    zone: BrillouinZone,
    waves: OnceLock<Arc<Waves>>,
}

impl Grid {
    /// Grid of `points` = [N₁, N₂] samples along a₁ and a₂.
    ///
    /// # Errors
    /// [`LatticeError::NoPoints`] when a number of points is zero.
    pub fn new(cell: Cell, points: [usize; 2]) -> Result<Self, LatticeError> {
        if points.contains(&0) {
            return Err(LatticeError::NoPoints(points[0], points[1]));
        }
        Ok(Self { zone: BrillouinZone::new(cell, points)?, waves: OnceLock::new() })
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.zone.cell()
    }

    /// Number of samples [N₁, N₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        self.zone.points()
    }

    /// Whether a field of this shape has one value per sample.
    ///
    /// # Errors
    /// [`NotOnGrid`] unless it has.
    pub fn check(&self, field: [usize; 2]) -> Result<(), NotOnGrid> {
        if field == self.points() { Ok(()) } else { Err(NotOnGrid { field, points: self.points() }) }
    }

    /// Number of samples N₁N₂.
    #[allow(clippy::len_without_is_empty, reason = "a grid is never empty")]
    pub fn len(&self) -> usize {
        self.points()[0] * self.points()[1]
    }

    /// Area of the cell per sample, a length squared.
    pub fn sample_area(&self) -> f64 {
        self.cell().area() / self.len() as f64
    }

    /// Fractions of a₁, a₂ of the sample with the flat index `index`.
    pub fn fractions(&self, index: usize) -> [f64; 2] {
        let [n1, n2] = self.points();
        [(index / n2) as f64 / n1 as f64, (index % n2) as f64 / n2 as f64]
    }

    /// Flat indices of the four samples adjacent to one along a₁ and a₂: the next ones, then those before.
    pub fn adjacent(&self, index: usize) -> [usize; 4] {
        let [n1, n2] = self.points();
        let (row, column) = (index / n2, index % n2);
        let places = [(row + 1, column), (row, column + 1), (row + n1 - 1, column), (row, column + n2 - 1)];
        places.map(|(row, column)| row % n1 * n2 + column % n2)
    }

    /// Flat indices of the eight samples around one.
    pub fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> {
        let [n1, n2] = self.points();
        let (row, column) = (index / n2, index % n2);
        (0..9).filter(|&k| k != 4).map(move |k| (row + n1 + k / 3 - 1) % n1 * n2 + (column + n2 + k % 3 - 1) % n2)
    }

    /// The vectors from a sample to the next one along a₁ and along a₂, lengths.
    pub fn steps(&self) -> [[f64; 2]; 2] {
        let [a1, a2] = self.cell().vectors();
        let [n1, n2] = self.points().map(|n| n as f64);
        [a1.map(|x| x / n1), a2.map(|x| x / n2)]
    }

    /// Distance between neighbouring samples, a length: the longer side of the reduced cell of the samples.
    pub fn spacing(&self) -> f64 {
        self.samples_cell().map_or(0.0, |cell| cell.reduced().longer_side())
    }

    /// The cell of one sample.
    pub(super) fn samples_cell(&self) -> Option<Cell> {
        let [e1, e2] = self.steps();
        Cell::new(e1, e2).ok()
    }

    /// Wavevector of the Fourier component (k₁, k₂), 0 ≤ kᵢ < Nᵢ: its shortest alias, 1/length.
    ///
    /// Aliases of equal length are equivalent for everything that depends on the length alone.
    pub fn wavevector(&self, component: [usize; 2]) -> [f64; 2] {
        self.zone.wavevector(component)
    }

    /// All shortest aliases of the component (k₁, k₂) whose lengths agree to the relative `tolerance`, each with the
    /// multiples of b₁, b₂ it is made of.
    pub fn tied_wavevectors(&self, component: [usize; 2], tolerance: f64) -> Vec<([i32; 2], [f64; 2])> {
        self.zone.tied_wavevectors(component, tolerance)
    }

    /// The shortest aliases of the component (k₁, k₂), as multiples of b₁, b₂: waves that share it in equal parts.
    pub(crate) fn aliases(&self, component: [usize; 2]) -> Vec<[i32; 2]> {
        let [n1, n2] = self.points();
        let [k1, k2] = component;
        // In a rectangular cell aliases that are not tied are those of each axis.
        if self.cell().is_rectangular() && 2 * k1 != n1 && 2 * k2 != n2 {
            let signed = |k: usize, n: usize| if 2 * k < n { k as i32 } else { k as i32 - n as i32 };
            return vec![[signed(k1, n1), signed(k2, n2)]];
        }
        self.tied_wavevectors(component, WAVENUMBER_TOLERANCE).into_iter().map(|(index, _)| index).collect()
    }

    /// Wavevector of the component (k₁, k₂), 1/length, and the number of its shortest aliases.
    pub(crate) fn wavevector_and_ties(&self, component: [usize; 2]) -> ([f64; 2], usize) {
        let wavevector = self.wavevector(component);
        (wavevector, if self.resolves(wavevector) { 1 } else { self.aliases(component).len() })
    }

    /// Whether a wavevector, 1/length, has no shorter alias.
    pub(crate) fn holds(&self, wavevector: [f64; 2]) -> bool {
        !self.zone.on_border(wavevector, -BORDER_TOLERANCE)
    }

    /// Whether all aliases of a wavevector, 1/length, are longer, so that the grid distinguishes it from all others.
    pub(crate) fn resolves(&self, wavevector: [f64; 2]) -> bool {
        !self.zone.on_border(wavevector, BORDER_TOLERANCE)
    }

    /// The plane waves of the grid, computed at first use and kept.
    pub(crate) fn waves(&self) -> &Arc<Waves> {
        self.waves.get_or_init(|| Arc::new(Waves::new(&self.zone)))
    }

    /// Mean unit vector of the shortest aliases of the component (k₁, k₂), of length 1 unless several are tied; zero
    /// for a component that is its own conjugate.
    pub fn mean_direction(&self, component: [usize; 2]) -> [f64; 2] {
        let unit = |[x, y]: [f64; 2]| {
            let length = norm([x, y]);
            if length > 0.0 { [x / length, y / length] } else { [0.0; 2] }
        };
        let is_self_conjugate = (0..2).all(|axis| (2 * component[axis]).is_multiple_of(self.points()[axis]));
        if is_self_conjugate {
            return [0.0; 2];
        }
        let q = self.wavevector(component);
        if !self.zone.on_border(q, BORDER_TOLERANCE) {
            return unit(q);
        }
        let tied = self.tied_wavevectors(component, WAVENUMBER_TOLERANCE);
        let sum = tied.iter().fold([0.0; 2], |sum, &(_, q)| [sum[0] + unit(q)[0], sum[1] + unit(q)[1]]);
        sum.map(|x| x / tied.len() as f64)
    }

    /// Mean square c², s² and product cs of the direction (c, s) of the shortest aliases of the component (k₁, k₂); of the component (0, 0),
    /// which has none, those of all directions.
    pub fn mean_dyad(&self, component: [usize; 2]) -> [f64; 3] {
        if component == [0, 0] {
            return [0.5, 0.5, 0.0];
        }
        let dyad = |[x, y]: [f64; 2]| [x * x, y * y, x * y].map(|product| product / (x * x + y * y));
        let q = self.wavevector(component);
        if !self.zone.on_border(q, BORDER_TOLERANCE) {
            return dyad(q);
        }
        let tied = self.tied_wavevectors(component, WAVENUMBER_TOLERANCE);
        let sum = tied.iter().fold([0.0; 3], |sum, &(_, q)| {
            let dyad = dyad(q);
            [0, 1, 2].map(|k| sum[k] + dyad[k])
        });
        sum.map(|x| x / tied.len() as f64)
    }

    /// Length |q| of [`Grid::wavevector`], 1/length.
    pub fn wavenumber(&self, component: [usize; 2]) -> f64 {
        let [x, y] = self.wavevector(component);
        (x * x + y * y).sqrt()
    }

    /// Lengths |q| of the [wavevectors](Grid::wavevector) of the components (k₁, k₂), (k₁, k₂ + 1), … from the `first` on, 1/length.
    pub(crate) fn wavenumbers(&self, first: [usize; 2], values: &mut [f64]) {
        self.zone.squares(first, values);
        values.iter_mut().for_each(|square| *square = square.sqrt());
    }

    /// Least non-zero wavenumber of the cell, 1/length.
    pub fn least_wavenumber(&self) -> f64 {
        norm(self.cell().dual().reduced().short())
    }

    /// A wavenumber that none of the grid's components exceeds, 1/length.
    pub(crate) fn largest_wavenumber(&self) -> f64 {
        // The zone lies within the circle of radius ½(|g₁| + |g₂|) for the two shortest of its facets.
        let [a, b, c] = self.zone.facets().map(norm);
        0.5 * (a + b + c - a.max(b).max(c))
    }

    /// Least wavenumber at which a direction is aliased, 1/length.
    pub fn least_aliased(&self) -> f64 {
        0.5 * norm(self.zone.shortest_facet())
    }
}

impl fmt::Display for Grid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [n1, n2] = self.points();
        write!(f, "grid {n1} × {n2}, spacing {}, sample area {}", number(self.spacing()), number(self.sample_area()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Square, hexagonal (with components on corners of the zone), oblique with odd numbers, and a single row.
    fn grids() -> [Grid; 5] {
        let hexagonal = Cell::hexagonal(2.0).unwrap();
        [
            (Cell::square(1.0).unwrap(), [8, 8]),
            (hexagonal, [12, 9]),
            (hexagonal, [12, 12]),
            (Cell::new([1.0, 0.2], [1.7, 0.9]).unwrap(), [7, 31]),
            (Cell::square(1.0).unwrap(), [1, 6]),
        ]
        .map(|(cell, points)| Grid::new(cell, points).unwrap())
    }

    #[test]
    fn no_component_has_a_larger_wavenumber_than_the_largest() {
        for grid in grids() {
            let points = grid.points();
            let largest = (0..grid.len()).map(|k| grid.wavenumber([k / points[1], k % points[1]])).fold(0.0, f64::max);
            assert!(largest <= grid.largest_wavenumber() * (1.0 + 1e-12), "{grid}: {largest}");
        }
    }

    /// Many at once and one by one, on the border of the zone too.
    #[test]
    fn wavenumbers_of_a_row_are_those_of_its_components() {
        for grid in grids() {
            let points = grid.points();
            for (k1, first) in (0..points[0]).flat_map(|k1| [0, 3].map(|first| (k1, first))) {
                let mut found = vec![0.0; points[1] - first];
                grid.wavenumbers([k1, first], &mut found);
                for (k2, found) in (first..).zip(found) {
                    let expected = grid.wavenumber([k1, k2]);
                    assert!(
                        (found - expected).abs() < 1e-14 * grid.largest_wavenumber(),
                        "{grid}: ({k1}, {k2}): {found}"
                    );
                }
            }
        }
    }

    /// Rotation by 60° of the rhombus a₁ = (1, 0), a₂ = (½, √3/2) maps b₁ → b₁ + b₂, b₂ → −b₁.
    #[test]
    fn shortest_aliases_keep_the_sixfold_symmetry() {
        for n in [8, 9, 12, 30] {
            let grid = Grid::new(Cell::hexagonal(1.7).unwrap(), [n, n]).unwrap();
            for (k1, k2) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let (here, rotated) = (grid.wavenumber([k1, k2]), grid.wavenumber([(n + k1 - k2) % n, k1]));
                assert!((here - rotated).abs() <= 1e-14 * here, "N = {n}, ({k1}, {k2}): {here} {rotated}");
            }
        }
    }

    #[test]
    fn a_rectangular_cell_has_the_usual_wavevectors() {
        let grid = Grid::new(Cell::new([2.0, 0.0], [0.0, 1.0]).unwrap(), [6, 5]).unwrap();
        assert!((grid.wavevector([1, 0])[0] - TAU / 2.0).abs() < 1e-14 && grid.wavevector([1, 0])[1] == 0.0);
        assert!((grid.wavevector([5, 4])[0] + TAU / 2.0).abs() < 1e-14);
        assert!((grid.wavevector([5, 4])[1] + TAU).abs() < 1e-14);
        assert!((grid.wavenumber([3, 0]) - 3.0 * TAU / 2.0).abs() < 1e-14);
    }

    #[test]
    fn the_least_wavenumber_belongs_to_the_reduced_cell() {
        let skewed = Grid::new(Cell::new([1.0, 0.0], [3.0, 1.0]).unwrap(), [4, 4]).unwrap();
        assert!((skewed.least_wavenumber() - TAU).abs() < 1e-13);
        let hexagonal = Grid::new(Cell::hexagonal(1.0).unwrap(), [4, 4]).unwrap();
        assert!((hexagonal.least_wavenumber() - TAU / 0.75f64.sqrt()).abs() < 1e-13);
    }
}

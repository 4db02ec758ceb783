//! Bravais cells, and where the indenters of each level stand in them.
//!
//! A cell is spanned by **a**₁, **a**₂; its reciprocal vectors satisfy **a**ᵢ·**b**ⱼ = 2π δᵢⱼ.
//! With the lattice period l (distance of neighbouring indenters whatever their level):
//!
//! | lattice | levels | cell | sites of levels 1, 2, … in fractions of a₁, a₂ |
//! |---|---|---|---|
//! | hexagonal | 1 | rhombus of 60°, side l | (0, 0) |
//! | hexagonal | 3 | rhombus, side √3 l | (0, 0), (⅓, ⅓), (⅔, ⅔) |
//! | hexagonal | 4 | rhombus, side 2 l | (0, 0), (½, 0), (0, ½), (½, ½) |
//! | square | 1 | square, side l | (0, 0) |
//! | square | 2 | square, side √2 l | (0, 0), (½, ½) |
//! | square | 4 | square, side 2 l | (0, 0), (½, 0), (½, ½), (0, ½) |
//! | oblique | any | a₁, a₂ given | given |

use crate::number::number;
use std::f64::consts::TAU;
use std::fmt;

/// Why a lattice cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LatticeError {
    /// The cell vectors are parallel, zero or not finite.
    #[error("the cell vectors ({}, {}) and ({}, {}) span no area", .0[0], .0[1], .1[0], .1[1])]
    FlatCell([f64; 2], [f64; 2]),
    /// The number of levels has no standard arrangement on this lattice.
    #[error("a {lattice} lattice has no standard arrangement of {levels} levels (it has one for {standard})")]
    NoStandardSites {
        /// Which lattice.
        lattice: &'static str,
        /// Levels asked for.
        levels: usize,
        /// Levels that have an arrangement.
        standard: &'static str,
    },
    /// A level without any site.
    #[error("level {0} has no site")]
    NoSite(usize),
    /// Two indenters at one place.
    #[error("levels {0} and {1} have an indenter at the same place")]
    SharedSite(usize, usize),
}

/// The unit cell of a doubly periodic system, spanned by two vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    a1: [f64; 2],
    a2: [f64; 2],
}

impl Cell {
    /// Cell spanned by `a1` and `a2` (lengths in the case's unit).
    ///
    /// # Errors
    /// [`LatticeError::FlatCell`] when the vectors span no area or are not finite.
    pub fn new(a1: [f64; 2], a2: [f64; 2]) -> Result<Self, LatticeError> {
        let sine = cross(a1, a2) / (norm(a1) * norm(a2));
        if !(sine.is_finite() && sine.abs() > 1e-6) {
            return Err(LatticeError::FlatCell(a1, a2));
        }
        Ok(Self { a1, a2 })
    }

    /// The 60° rhombus of side `side`.
    ///
    /// # Errors
    /// When `side` is zero or not finite.
    pub fn hexagonal(side: f64) -> Result<Self, LatticeError> {
        Self::new([side, 0.0], [0.5 * side, 0.75f64.sqrt() * side])
    }

    /// The square of side `side`.
    ///
    /// # Errors
    /// When `side` is zero or not finite.
    pub fn square(side: f64) -> Result<Self, LatticeError> {
        Self::new([side, 0.0], [0.0, side])
    }

    /// The cell vectors a₁, a₂.
    pub fn vectors(&self) -> [[f64; 2]; 2] {
        [self.a1, self.a2]
    }

    /// The reciprocal vectors b₁, b₂ with aᵢ·bⱼ = 2π δᵢⱼ.
    pub fn reciprocal(&self) -> [[f64; 2]; 2] {
        let scale = TAU / cross(self.a1, self.a2);
        [[scale * self.a2[1], -scale * self.a2[0]], [-scale * self.a1[1], scale * self.a1[0]]]
    }

    /// Area |a₁ × a₂|.
    pub fn area(&self) -> f64 {
        cross(self.a1, self.a2).abs()
    }

    /// The point s₁ a₁ + s₂ a₂.
    pub fn point(&self, [s1, s2]: [f64; 2]) -> [f64; 2] {
        [s1 * self.a1[0] + s2 * self.a2[0], s1 * self.a1[1] + s2 * self.a2[1]]
    }

    /// Fractions s₁, s₂ of a₁, a₂ that make up the vector `x`.
    pub fn fractions(&self, x: [f64; 2]) -> [f64; 2] {
        let determinant = cross(self.a1, self.a2);
        [cross(x, self.a2) / determinant, cross(self.a1, x) / determinant]
    }

    /// The reduced basis of the same lattice (Lagrange–Gauss): its shortest vector, and the shortest one that
    /// completes it.
    pub fn reduced(&self) -> Reduced {
        let dot = |u: [f64; 2], v: [f64; 2]| u[0] * v[0] + u[1] * v[1];
        let (mut short, mut long) = ((self.a1, [1, 0]), (self.a2, [0, 1]));
        loop {
            if dot(long.0, long.0) < dot(short.0, short.0) {
                (short, long) = (long, short);
            }
            let whole = (dot(short.0, long.0) / dot(short.0, short.0)).round();
            if whole == 0.0 {
                break;
            }
            let multiple = whole as i32;
            long.0 = [0, 1].map(|k| long.0[k] - whole * short.0[k]);
            long.1 = [0, 1].map(|k| long.1[k] - multiple * short.1[k]);
            if dot(long.0, long.0) >= dot(short.0, short.0) * (1.0 - 1e-12) {
                break;
            }
        }
        Reduced { cell: Self { a1: short.0, a2: long.0 }, matrix: [short.1, long.1] }
    }
}

/// A reduced basis r₁, r₂ of a cell's lattice, in which the shortest of all equivalent vectors is found at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reduced {
    /// Cell spanned by r₁ and r₂.
    cell: Cell,
    /// rᵢ = Σⱼ `matrix[i][j]` aⱼ.
    matrix: [[i32; 2]; 2],
}

impl Reduced {
    /// A shortest lattice vector.
    pub fn short(&self) -> [f64; 2] {
        if norm(self.cell.a1) <= norm(self.cell.a2) { self.cell.a1 } else { self.cell.a2 }
    }

    /// Length of the shortest lattice vector.
    pub fn shortest_vector(&self) -> f64 {
        norm(self.short())
    }

    /// Length of the longer one of r₁ and r₂.
    pub fn longer_side(&self) -> f64 {
        norm(self.cell.a1).max(norm(self.cell.a2))
    }

    /// The shortest vectors equivalent to s₁a₁ + s₂a₂ (all whose lengths agree to the relative `tolerance`), each with
    /// the whole multiples of a₁, a₂ that were taken off.
    pub fn shortest(&self, [s1, s2]: [f64; 2], tolerance: f64) -> Vec<([f64; 2], [i32; 2])> {
        let candidates = self.candidates([s1, s2]);
        let least = candidates.iter().map(|&(x, _)| norm(x)).fold(f64::INFINITY, f64::min);
        candidates.into_iter().filter(|&(x, _)| norm(x) <= least * (1.0 + tolerance)).collect()
    }

    /// One shortest vector equivalent to s₁a₁ + s₂a₂: in a reduced cell one of the four corners around it is nearest.
    pub fn nearest(&self, s: [f64; 2]) -> [f64; 2] {
        let t = self.fractions(s);
        let [u, v] = t.map(|t| t - t.floor());
        let (mut nearest, mut least) = ([0.0; 2], f64::INFINITY);
        for corner in [[u, v], [u - 1.0, v], [u, v - 1.0], [u - 1.0, v - 1.0]] {
            let x = self.cell.point(corner);
            let square = x[0] * x[0] + x[1] * x[1];
            if square < least {
                (nearest, least) = (x, square);
            }
        }
        nearest
    }

    /// Fractions of r₁, r₂ of the vector s₁a₁ + s₂a₂: the inverse of an integer matrix of determinant ±1 is one too.
    fn fractions(&self, [s1, s2]: [f64; 2]) -> [f64; 2] {
        let [[m11, m12], [m21, m22]] = self.matrix.map(|row| row.map(f64::from));
        let determinant = m11 * m22 - m12 * m21;
        [(m22 * s1 - m21 * s2) * determinant, (m11 * s2 - m12 * s1) * determinant]
    }

    /// The vector and its eight neighbours nearest to the origin: among them are all shortest ones.
    fn candidates(&self, s: [f64; 2]) -> [([f64; 2], [i32; 2]); 9] {
        let t = self.fractions(s);
        let whole = t.map(f64::round);
        std::array::from_fn(|k| {
            let shift = [whole[0] + (k / 3) as f64 - 1.0, whole[1] + (k % 3) as f64 - 1.0];
            let [n1, n2] = shift.map(|n| n as i32);
            let taken = [0, 1].map(|j| n1 * self.matrix[0][j] + n2 * self.matrix[1][j]);
            (self.cell.point([t[0] - shift[0], t[1] - shift[1]]), taken)
        })
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x1, y1], [x2, y2]) = (self.a1, self.a2);
        let [x1, y1, x2, y2, area] = [x1, y1, x2, y2, self.area()].map(number);
        write!(f, "cell a₁ = ({x1}, {y1}), a₂ = ({x2}, {y2}), area {area}")
    }
}

/// A cell and the sites of each level in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    cell: Cell,
    sites: Vec<Vec<[f64; 2]>>,
}

impl Lattice {
    /// Hexagonal lattice of the given period with one indenter of each of 1, 3 or 4 levels in its cell.
    ///
    /// # Errors
    /// [`LatticeError::NoStandardSites`] for another number of levels, [`LatticeError::FlatCell`] for a bad period.
    pub fn hexagonal(period: f64, levels: usize) -> Result<Self, LatticeError> {
        let third = 1.0 / 3.0;
        let (scale, sites) = match levels {
            1 => (1.0, vec![[0.0, 0.0]]),
            3 => (3f64.sqrt(), vec![[0.0, 0.0], [third, third], [2.0 * third, 2.0 * third]]),
            4 => (2.0, vec![[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]]),
            _ => {
                return Err(LatticeError::NoStandardSites { lattice: "hexagonal", levels, standard: "1, 3 and 4" });
            }
        };
        Self::new(Cell::hexagonal(scale * period)?, one_each(sites))
    }

    /// Square lattice of the given period with one indenter of each of 1, 2 or 4 levels in its cell.
    ///
    /// # Errors
    /// As [`Lattice::hexagonal`].
    pub fn square(period: f64, levels: usize) -> Result<Self, LatticeError> {
        let (scale, sites) = match levels {
            1 => (1.0, vec![[0.0, 0.0]]),
            2 => (2f64.sqrt(), vec![[0.0, 0.0], [0.5, 0.5]]),
            4 => (2.0, vec![[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]),
            _ => {
                return Err(LatticeError::NoStandardSites { lattice: "square", levels, standard: "1, 2 and 4" });
            }
        };
        Self::new(Cell::square(scale * period)?, one_each(sites))
    }

    /// Any cell with explicit sites: `sites[m]` holds those of level m + 1 in fractions of a₁, a₂
    /// (any real values; they are brought into [0, 1)).
    ///
    /// # Errors
    /// [`LatticeError::NoSite`] for a level without site, [`LatticeError::SharedSite`] for two indenters at one place.
    pub fn new(cell: Cell, sites: Vec<Vec<[f64; 2]>>) -> Result<Self, LatticeError> {
        if let Some(level) = sites.iter().position(Vec::is_empty) {
            return Err(LatticeError::NoSite(level + 1));
        }
        let sites: Vec<Vec<[f64; 2]>> = sites
            .into_iter()
            .map(|level| level.into_iter().map(|s| s.map(|x| x.rem_euclid(1.0) % 1.0)).collect())
            .collect();
        let all: Vec<(usize, [f64; 2])> =
            (1..).zip(&sites).flat_map(|(level, s)| s.iter().map(move |&x| (level, x))).collect();
        for (i, (level, s)) in all.iter().enumerate() {
            for (other, t) in &all[..i] {
                let apart = [0, 1].map(|k| {
                    let d = s[k] - t[k];
                    (d - d.round()).abs()
                });
                if apart[0] < 1e-9 && apart[1] < 1e-9 {
                    return Err(LatticeError::SharedSite(*other, *level));
                }
            }
        }
        Ok(Self { cell, sites })
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// The vector from the place `from` (fractions of a₁, a₂) to the nearest indenter of `level` (from 1) that is not
    /// there.
    pub fn toward(&self, from: [f64; 2], level: usize) -> [f64; 2] {
        let reduced = self.cell.reduced();
        let other = |site: &[f64; 2]| {
            let vector = reduced.nearest([site[0] - from[0], site[1] - from[1]]);
            // The nearest image of the place itself is a shortest lattice vector away.
            if norm(vector) > 1e-9 * reduced.longer_side() { vector } else { reduced.short() }
        };
        let vectors = self.sites[level - 1].iter().map(other);
        vectors.min_by(|a, b| norm(*a).total_cmp(&norm(*b))).unwrap_or(self.cell.a1)
    }

    /// Sites of each level, in fractions of a₁, a₂ within [0, 1).
    pub fn sites(&self) -> &[Vec<[f64; 2]>] {
        &self.sites
    }
}

impl fmt::Display for Lattice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts: Vec<String> = self.sites.iter().map(|s| s.len().to_string()).collect();
        write!(f, "{}, indenters per level: {}", self.cell, counts.join(", "))
    }
}

fn one_each(sites: Vec<[f64; 2]>) -> Vec<Vec<[f64; 2]>> {
    sites.into_iter().map(|s| vec![s]).collect()
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn norm(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_stand_one_period_apart_whatever_their_level() {
        let lattices = [
            Lattice::hexagonal(0.7, 1),
            Lattice::hexagonal(0.7, 3),
            Lattice::hexagonal(0.7, 4),
            Lattice::square(0.7, 1),
            Lattice::square(0.7, 2),
            Lattice::square(0.7, 4),
        ];
        for lattice in lattices {
            let lattice = lattice.unwrap();
            let cell = lattice.cell();
            let sites: Vec<[f64; 2]> = lattice.sites().concat();
            let mut nearest = f64::INFINITY;
            for (s, t) in sites.iter().flat_map(|s| sites.iter().map(move |t| (s, t))) {
                for (m1, m2) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))) {
                    let d = cell.point([s[0] - t[0] + f64::from(m1), s[1] - t[1] + f64::from(m2)]);
                    if norm(d) > 1e-9 {
                        nearest = nearest.min(norm(d));
                    }
                }
            }
            assert!((nearest - 0.7).abs() < 1e-12, "{lattice}: nearest neighbour at {nearest}");
            let per_indenter = cell.area() / sites.len() as f64;
            let hexagonal = 0.75f64.sqrt() * 0.49;
            assert!((per_indenter - hexagonal).abs() < 1e-12 || (per_indenter - 0.49).abs() < 1e-12);
        }
    }

    #[test]
    fn reciprocal_vectors_are_dual_to_the_cell() {
        let cell = Cell::new([1.3, 0.2], [-0.4, 0.9]).unwrap();
        for (i, a) in cell.vectors().iter().enumerate() {
            for (j, b) in cell.reciprocal().iter().enumerate() {
                let expected = if i == j { TAU } else { 0.0 };
                assert!((a[0] * b[0] + a[1] * b[1] - expected).abs() < 1e-14);
            }
        }
        let s = cell.fractions(cell.point([0.3, -1.7]));
        assert!((s[0] - 0.3).abs() < 1e-14 && (s[1] + 1.7).abs() < 1e-14);
    }

    #[test]
    fn the_reduced_cell_finds_the_shortest_equivalent_however_skewed_the_cell() {
        for (cell, reach) in [(Cell::new([1.0, 0.0], [2.3, 0.4]), 9), (Cell::new([0.3, 0.1], [-15.2, 0.7]), 60)] {
            let cell = cell.unwrap();
            let reduced = cell.reduced();
            assert!((reduced.cell.area() / cell.area() - 1.0).abs() < 1e-12);
            for k in 0..60 {
                let s = [f64::from(k % 7) / 7.0 - 0.4, f64::from(k / 7) / 8.0 - 0.5];
                let at = |m: [i32; 2]| cell.point([s[0] - f64::from(m[0]), s[1] - f64::from(m[1])]);
                let wide = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| [i, j]));
                let true_shortest = wide.map(|m| norm(at(m))).fold(f64::INFINITY, f64::min);
                assert!((norm(reduced.nearest(s)) - true_shortest).abs() < 1e-12);
                for (x, taken) in reduced.shortest(s, 1e-9) {
                    assert!((norm(x) - true_shortest).abs() < 1e-8);
                    let y = at(taken);
                    assert!((x[0] - y[0]).abs() < 1e-12 && (x[1] - y[1]).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn the_nearest_indenter_of_a_level_is_one_period_away() {
        let lattice = Lattice::hexagonal(0.7, 3).unwrap();
        for (level, distance) in [(1, 0.7 * 3f64.sqrt()), (2, 0.7), (3, 0.7)] {
            let vector = lattice.toward(lattice.sites()[0][0], level);
            assert!((norm(vector) - distance).abs() < 1e-12, "level {level}: {vector:?}");
        }
    }

    #[test]
    fn tied_vectors_are_all_found() {
        let hexagonal = Cell::hexagonal(1.0).unwrap().reduced();
        assert_eq!(hexagonal.shortest([1.0 / 3.0, 1.0 / 3.0], 1e-9).len(), 3);
        assert_eq!(hexagonal.shortest([0.5, 0.0], 1e-9).len(), 2);
        assert_eq!(Cell::square(1.0).unwrap().reduced().shortest([0.5, 0.5], 1e-9).len(), 4);
    }

    #[test]
    fn flat_cells_and_shared_sites_are_refused() {
        assert!(matches!(Cell::new([1.0, 1.0], [2.0, 2.0]), Err(LatticeError::FlatCell(..))));
        assert!(matches!(Cell::hexagonal(0.0), Err(LatticeError::FlatCell(..))));
        assert!(matches!(Lattice::hexagonal(1.0, 2), Err(LatticeError::NoStandardSites { levels: 2, .. })));
        let cell = Cell::square(1.0).unwrap();
        assert_eq!(Lattice::new(cell, vec![vec![[0.0, 0.0]], vec![[1.0, 0.0]]]), Err(LatticeError::SharedSite(1, 2)));
    }
}

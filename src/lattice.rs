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

    /// Integer combinations that bring a vector with fractions in [−½, ½] to its shortest
    /// equivalent: all whole-cell vectors that can be needed, the zero one first.
    ///
    /// For a reduced cell these are the eight neighbours; a skewed cell needs more.
    pub fn neighbour_shifts(&self) -> Vec<[i32; 2]> {
        // The shortest equivalent of x is no longer than the covering radius ρ ≤ (|a₁| + |a₂|)/2;
        // fractions of a vector of length ρ are at most ρ |bᵢ|/2π.
        let radius = 0.5 * (norm(self.a1) + norm(self.a2));
        let [b1, b2] = self.reciprocal();
        let reach = |b: [f64; 2]| (radius * norm(b) / TAU + 0.5).floor() as i32;
        let (m1, m2) = (reach(b1), reach(b2));
        let mut shifts: Vec<[i32; 2]> = (-m1..=m1).flat_map(|i| (-m2..=m2).map(move |j| [i, j])).collect();
        shifts.sort_by_key(|[i, j]| i.abs() + j.abs());
        shifts
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x1, y1], [x2, y2]) = (self.a1, self.a2);
        write!(f, "cell a₁ = ({x1:.6}, {y1:.6}), a₂ = ({x2:.6}, {y2:.6}), area {:.6}", self.area())
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
    fn neighbour_shifts_reach_the_shortest_equivalent_in_a_skewed_cell() {
        let cell = Cell::new([1.0, 0.0], [2.3, 0.4]).unwrap();
        let shifts = cell.neighbour_shifts();
        for k in 0..200 {
            let s = [f64::from(k % 14) / 14.0 - 0.5, f64::from(k / 14) / 15.0 - 0.5];
            let length = |m: [i32; 2]| norm(cell.point([s[0] + f64::from(m[0]), s[1] + f64::from(m[1])]));
            let found = shifts.iter().map(|&m| length(m)).fold(f64::INFINITY, f64::min);
            let wide = (-9..=9).flat_map(|i| (-9..=9).map(move |j| [i, j]));
            let true_shortest = wide.map(length).fold(f64::INFINITY, f64::min);
            assert!(found <= true_shortest * (1.0 + 1e-12));
        }
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

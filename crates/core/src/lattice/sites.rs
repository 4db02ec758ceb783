//! Sites of the indenters of each level in the cell.
//!
//! The lattice period l is the distance of neighbouring indenters of any level:
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

use super::cell::{Cell, norm};
use super::error::LatticeError;
use std::fmt;

/// A cell with the sites of each level.
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    cell: Cell,
    sites: Vec<Vec<[f64; 2]>>,
}

impl Lattice {
    /// Hexagonal lattice of the given period with one indenter of each of 1, 3 or 4 levels in its cell.
    ///
    /// # Errors
    /// [`LatticeError::NoStandardSites`] for another number of levels, [`LatticeError::FlatCell`] for a period that is zero or not finite.
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
    /// Errors of [`Lattice::hexagonal`].
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
    /// (any real values; they are reduced to [0, 1)).
    ///
    /// # Errors
    /// [`LatticeError::NoSite`] for a level without site, [`LatticeError::Site`] for a place that is not finite,
    /// [`LatticeError::SharedSite`] for two indenters at one place.
    pub fn new(cell: Cell, sites: Vec<Vec<[f64; 2]>>) -> Result<Self, LatticeError> {
        if let Some(level) = sites.iter().position(Vec::is_empty) {
            return Err(LatticeError::NoSite(level + 1));
        }
        if let Some(level) = sites.iter().position(|level| level.iter().flatten().any(|s| !s.is_finite())) {
            return Err(LatticeError::Site(level + 1));
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

    /// The vector from the point `from` (fractions of a₁, a₂) to the nearest indenter of `level` (from 1) elsewhere, lengths.
    ///
    /// # Panics
    /// When there is no such level.
    pub fn toward(&self, from: [f64; 2], level: usize) -> [f64; 2] {
        let reduced = self.cell.reduced();
        let other = |site: &[f64; 2]| {
            let vector = reduced.nearest([site[0] - from[0], site[1] - from[1]]);
            // The nearest image of an indenter at the point itself is a shortest lattice vector away.
            if norm(vector) > 1e-9 * reduced.longer_side() { vector } else { reduced.short() }
        };
        let vectors = self.sites[level - 1].iter().map(other);
        vectors.min_by(|a, b| norm(*a).total_cmp(&norm(*b))).unwrap_or(reduced.short())
    }

    /// The period l: the least distance of two indenters, whatever their level, a length.
    pub fn period(&self) -> f64 {
        let levels = 1..=self.sites.len();
        let toward = |&from: &[f64; 2]| levels.clone().map(move |level| norm(self.toward(from, level)));
        self.sites.iter().flatten().flat_map(toward).fold(f64::INFINITY, f64::min)
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
                    let d = cell.vector([s[0] - t[0] + f64::from(m1), s[1] - t[1] + f64::from(m2)]);
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
    fn the_nearest_indenter_of_a_level_is_one_period_away() {
        let lattice = Lattice::hexagonal(0.7, 3).unwrap();
        assert!((lattice.period() - 0.7).abs() < 1e-12);
        for (level, distance) in [(1, 0.7 * 3f64.sqrt()), (2, 0.7), (3, 0.7)] {
            let vector = lattice.toward(lattice.sites()[0][0], level);
            assert!((norm(vector) - distance).abs() < 1e-12, "level {level}: {vector:?}");
        }
    }

    #[test]
    fn flat_cells_and_shared_sites_are_refused() {
        assert!(matches!(Cell::new([1.0, 1.0], [2.0, 2.0]), Err(LatticeError::FlatCell(..))));
        assert!(matches!(Cell::hexagonal(0.0), Err(LatticeError::FlatCell(..))));
        assert!(matches!(Cell::new([1e-10, 0.0], [1.0, 1.0]), Err(LatticeError::FlatCell(..))));
        assert!(matches!(Lattice::hexagonal(1.0, 2), Err(LatticeError::NoStandardSites { levels: 2, .. })));
        let cell = Cell::square(1.0).unwrap();
        assert_eq!(Lattice::new(cell, vec![vec![[0.0, 0.0]], vec![[1.0, 0.0]]]), Err(LatticeError::SharedSite(1, 2)));
    }
}

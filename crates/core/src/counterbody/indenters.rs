//! A multi-level system of indenters on a lattice.

use super::{CounterbodyError, Level, Shape};
use crate::lattice::Lattice;
use crate::notation::number;
use std::fmt;

/// Site of an indenter in the cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Site {
    /// Level of the indenter, from 1.
    pub level: usize,
    /// Position in fractions of a₁, a₂.
    pub place: [f64; 2],
    /// Shape of the indenter.
    pub shape: Shape,
    /// Drop of the apex below the highest one, a length ≥ 0.
    pub drop: f64,
}

impl Site {
    /// Depth of the indenter's surface below the highest apex of all at the distance `r` from its axis, lengths.
    pub fn profile(&self, r: f64) -> f64 {
        self.shape.profile(r) + self.drop
    }

    /// Replaces squared distances from the axis by the [depths](Self::profile) at these distances, lengths.
    pub(crate) fn profiles(&self, squares: &mut [f64]) {
        self.shape.profiles(squares);
        squares.iter_mut().for_each(|depth| *depth += self.drop);
    }
}

/// Indenters at several levels on the sites of a lattice: level m + 1 is on `lattice().sites()[m]`.
#[derive(Debug, Clone, PartialEq)]
pub struct Indenters {
    lattice: Lattice,
    levels: Vec<Level>,
}

impl Indenters {
    /// Indenters of `levels` on the sites of `lattice`.
    ///
    /// # Errors
    /// [`CounterbodyError::Levels`] unless there are as many levels as the lattice has.
    pub fn new(lattice: Lattice, levels: Vec<Level>) -> Result<Self, CounterbodyError> {
        let (sites, count) = (lattice.sites().len(), levels.len());
        if sites != count || count == 0 {
            return Err(CounterbodyError::Levels { sites, levels: count });
        }
        Ok(Self { lattice, levels })
    }

    /// The indenters around the middle of a window `factor` times as wide and as high; `None` in a periodic system.
    pub(crate) fn widened(&self, factor: f64) -> Option<Self> {
        let window = self.lattice.cell().widened(factor)?;
        let place = |s: &[f64; 2]| s.map(|s| 0.5 + (s - 0.5) / factor);
        let sites = self.lattice.sites().iter().map(|level| level.iter().map(place).collect()).collect();
        Some(Self { lattice: Lattice::new(window, sites).ok()?, ..self.clone() })
    }

    /// Lattice of the indenters: cell and sites.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Levels of the indenters, one for each level of the lattice.
    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// Drops d_m = max h − h_m of the levels, lengths ≥ 0.
    pub fn drops(&self) -> Vec<f64> {
        let highest = self.levels.iter().map(Level::height).fold(f64::NEG_INFINITY, f64::max);
        self.levels.iter().map(|level| highest - level.height()).collect()
    }

    /// Sites of the cell, level by level.
    pub fn sites(&self) -> Vec<Site> {
        let drops = self.drops();
        let of_level = |(index, places): (usize, &Vec<[f64; 2]>)| -> Vec<Site> {
            let (level, shape, drop) = (index + 1, self.levels[index].shape(), drops[index]);
            places.iter().map(|&place| Site { level, place, shape: shape.clone(), drop }).collect()
        };
        self.lattice.sites().iter().enumerate().flat_map(of_level).collect()
    }
}

impl fmt::Display for Indenters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.lattice)?;
        for (index, (level, drop)) in (1..).zip(self.levels.iter().zip(self.drops())) {
            write!(f, "\nlevel {index}: {}, drop {}", level.shape(), number(drop))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counterbody::Shape;

    #[test]
    fn levels_and_sites_must_match() {
        let level = Level::new(Shape::Cone { slope: 0.1 }, 0.0).unwrap();
        let three = |levels: usize| Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), vec![level.clone(); levels]);
        assert!(three(3).is_ok());
        for levels in [0, 2, 4] {
            assert_eq!(three(levels), Err(CounterbodyError::Levels { sites: 3, levels }));
        }
    }
}

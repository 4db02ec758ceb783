//! The undeformed surface of the rigid counterbody on a grid.
//!
//! f(**x**) = min over all indenters of [f_m(|**x** − **x**ᵢ|) + d_m]: the distance of the counterbody's surface above
//! its highest apex. The indenter that gives the minimum owns the sample. Every profile grows with the radius, so of
//! the periodic images of an indenter only the nearest one counts.

use crate::field;
use crate::grid::Grid;
use crate::indenter::{Level, Shape, drops};
use crate::lattice::{Cell, Lattice, Reduced};
use crate::number::number;
use rayon::prelude::*;
use std::fmt;

/// The rigid counterbody: what its surface is, before any grid.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// Indenters at several levels on the sites of a lattice.
    Indenters {
        /// Cell and sites; level m + 1 stands on `lattice.sites()[m]`.
        lattice: Lattice,
        /// The levels, as many as the lattice has.
        levels: Vec<Level>,
    },
    /// One period of a measured or generated topography.
    Heights {
        /// Its cell.
        cell: Cell,
        /// Samples [n₁, n₂] along a₁ and a₂.
        points: [usize; 2],
        /// Protrusion upward (a length), n₁n₂ values, a₂ fastest.
        heights: Vec<f64>,
    },
}

/// One site of an indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// Level of the indenter, from 1.
    pub level: usize,
    /// Place in fractions of a₁, a₂.
    pub place: [f64; 2],
    /// Shape of the indenter.
    pub shape: Shape,
}

/// The counterbody's surface on a grid.
#[derive(Debug, Clone)]
pub struct Texture {
    /// f, a length ≥ 0 measured from the highest apex, one value per sample, a₂ fastest.
    pub shape: Vec<f64>,
    /// Index into `sites` of the indenter whose surface faces each sample; empty for a topography.
    pub owner: Vec<u32>,
    /// Samples that face the surfaces of several sites at once (to rounding), each with all of them, by ascending
    /// sample.
    pub ties: Vec<(usize, Vec<u32>)>,
    /// Sites by their index; empty for a topography.
    pub sites: Vec<Site>,
    /// Largest minus smallest value of `shape`.
    pub range: f64,
}

impl Surface {
    /// The cell.
    pub fn cell(&self) -> Cell {
        match self {
            Self::Indenters { lattice, .. } => lattice.cell(),
            Self::Heights { cell, .. } => *cell,
        }
    }

    /// Number of levels: 0 for a topography.
    pub fn levels(&self) -> usize {
        match self {
            Self::Indenters { levels, .. } => levels.len(),
            Self::Heights { .. } => 0,
        }
    }

    /// The surface on a grid: exact for indenters, interpolated between the samples of a topography.
    pub fn sample(&self, grid: &Grid) -> Texture {
        let (shape, owner, ties, sites) = match self {
            Self::Indenters { lattice, levels } => sample_indenters(lattice, levels, grid),
            Self::Heights { points, heights, .. } => {
                let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let depths: Vec<f64> = heights.iter().map(|h| highest - h).collect();
                let shape = resample(&depths, *points, grid.points(), Interpolation::on(grid.cell()));
                (shape, Vec::new(), Vec::new(), Vec::new())
            }
        };
        let lowest = field::least(shape.len(), |i| shape[i]);
        let highest = -field::least(shape.len(), |i| -shape[i]);
        Texture { shape, owner, ties, sites, range: highest - lowest }
    }
}

impl Texture {
    /// The vector from the axis of the nearest image of the site `site` to a sample, a length.
    pub fn offset(&self, grid: &Grid, reduced: &Reduced, site: u32, index: usize) -> [f64; 2] {
        let (here, place) = (grid.fractions(index), self.sites[site as usize].place);
        reduced.nearest([here[0] - place[0], here[1] - place[1]])
    }

    /// Mean of `shape` over the cell: the penetration at which contact is complete, a length.
    pub fn mean(&self) -> f64 {
        field::mean(&self.shape)
    }
}

impl fmt::Display for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Indenters { lattice, levels } => {
                write!(f, "{lattice}")?;
                for (index, (level, drop)) in (1..).zip(levels.iter().zip(drops(levels))) {
                    write!(f, "\nlevel {index}: {}, drop {}", level.shape(), number(drop))?;
                }
                Ok(())
            }
            Self::Heights { cell, points: [n1, n2], .. } => write!(f, "{cell}, topography of {n1} × {n2} samples"),
        }
    }
}

/// Shape, owners, ties and sites.
type Faces = (Vec<f64>, Vec<u32>, Vec<(usize, Vec<u32>)>, Vec<Site>);

/// Surfaces closer to a sample than this, relatively, face it together.
const TIE: f64 = 1e-12;

fn sample_indenters(lattice: &Lattice, levels: &[Level], grid: &Grid) -> Faces {
    let reduced = lattice.cell().reduced();
    let drops = drops(levels);
    let sites: Vec<Site> = (1..)
        .zip(lattice.sites())
        .zip(levels)
        .flat_map(|((level, places), own)| places.iter().map(move |&place| Site { level, place, shape: own.shape() }))
        .collect();
    let distance = |index: usize, site: &Site| {
        let here = grid.fractions(index);
        let [x, y] = reduced.nearest([here[0] - site.place[0], here[1] - site.place[1]]);
        site.shape.profile(x.hypot(y)) + drops[site.level - 1]
    };
    let face = |index: usize| {
        let (mut nearest, mut owner, mut tied) = (f64::INFINITY, 0, false);
        for (number, site) in (0..).zip(&sites) {
            let distance = distance(index, site);
            if distance < nearest * (1.0 - TIE) {
                (nearest, owner, tied) = (distance, number, false);
            } else {
                tied |= distance <= nearest * (1.0 + TIE);
            }
        }
        (nearest, (owner, tied))
    };
    let (shape, owner): (Vec<f64>, Vec<(u32, bool)>) = (0..grid.len()).into_par_iter().map(face).unzip();
    let all_facing = |index: usize| {
        let facing = (0..).zip(&sites).filter(|(_, site)| distance(index, site) <= shape[index] * (1.0 + TIE));
        (index, facing.map(|(number, _)| number).collect())
    };
    let tied = owner.iter().enumerate().filter(|(_, (_, tied))| *tied);
    let ties = tied.map(|(index, _)| all_facing(index)).collect();
    let owner = owner.into_iter().map(|(owner, _)| owner).collect();
    (shape, owner, ties, sites)
}

/// How a field is interpolated between four neighbouring samples of a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    /// Bilinear: keeps the symmetry of rectangular cells.
    Bilinear,
    /// Linear on the two triangles that the diagonal between the ends of a₁ and a₂ makes: keeps the symmetry of a 60°
    /// rhombus.
    AcrossDiagonal,
    /// Linear on the two triangles that the diagonal along a₁ + a₂ makes: the same for a 120° rhombus.
    AlongDiagonal,
}

impl Interpolation {
    /// The one that keeps the symmetry of the cell: triangles along the shorter diagonal, if there is a shorter one.
    pub fn on(cell: Cell) -> Self {
        let [[x1, y1], [x2, y2]] = cell.vectors();
        let cosine = (x1 * x2 + y1 * y2) / (x1.hypot(y1) * x2.hypot(y2));
        match cosine {
            c if c > 1e-9 => Self::AcrossDiagonal,
            c if c < -1e-9 => Self::AlongDiagonal,
            _ => Self::Bilinear,
        }
    }

    /// Value at the fractions s, t between the samples at (0, 0), (0, 1), (1, 0), (1, 1).
    fn between(self, [v00, v01, v10, v11]: [f64; 4], s: f64, t: f64) -> f64 {
        match self {
            Self::Bilinear => (1.0 - s) * ((1.0 - t) * v00 + t * v01) + s * ((1.0 - t) * v10 + t * v11),
            Self::AcrossDiagonal if s + t <= 1.0 => (1.0 - s - t) * v00 + (s * v10 + t * v01),
            Self::AcrossDiagonal => (s + t - 1.0) * v11 + ((1.0 - s) * v01 + (1.0 - t) * v10),
            Self::AlongDiagonal if s >= t => (1.0 - s) * v00 + ((s - t) * v10 + t * v11),
            Self::AlongDiagonal => (1.0 - t) * v00 + ((t - s) * v01 + s * v11),
        }
    }
}

/// Periodic interpolation of a field from one grid of a cell to another; exact where samples coincide.
pub fn resample(field: &[f64], from: [usize; 2], to: [usize; 2], interpolation: Interpolation) -> Vec<f64> {
    if from == to {
        return field.to_vec();
    }
    let place = |index: usize, axis: usize| {
        let (before, rest) = (index * from[axis] / to[axis], index * from[axis] % to[axis]);
        (before, (before + 1) % from[axis], rest as f64 / to[axis] as f64)
    };
    let mut result = vec![0.0; to[0] * to[1]];
    result.par_chunks_mut(to[1]).enumerate().for_each(|(i, row)| {
        let (low, high, s) = place(i, 0);
        for (j, value) in row.iter_mut().enumerate() {
            let (left, right, t) = place(j, 1);
            let at = |i: usize, j: usize| field[i * from[1] + j];
            *value = interpolation.between([at(low, left), at(low, right), at(high, left), at(high, right)], s, t);
        }
    });
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::indenter::Shape;

    fn three_levels(points: usize) -> Texture {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
        let surface = Surface::Indenters {
            lattice: Lattice::hexagonal(1.0, 3).unwrap(),
            levels: vec![level(0.02), level(0.01), level(0.0)],
        };
        surface.sample(&Grid::new(surface.cell(), [points, points]).unwrap())
    }

    #[test]
    fn apices_stand_on_their_sites_at_their_drops() {
        let texture = three_levels(12);
        for (site, drop) in [(0, 0.0), (4 * 12 + 4, 0.01), (8 * 12 + 8, 0.02)] {
            assert!((texture.shape[site] - drop).abs() < 1e-15);
        }
        assert_eq!(texture.sites[texture.owner[4 * 12 + 4] as usize].level, 2);
        assert!(texture.range > 0.2 && texture.range < 0.23);
    }

    #[test]
    fn the_nearest_surface_owns_a_sample_not_the_nearest_site() {
        // Halfway between levels 1 and 3 the higher one is nearer.
        let level = |height, radius| Level::new(Shape::Paraboloid { radius }, height).unwrap();
        let surface = Surface::Indenters {
            lattice: Lattice::square(1.0, 2).unwrap(),
            levels: vec![level(0.1, 0.8), level(0.0, 0.8)],
        };
        let texture = surface.sample(&Grid::new(surface.cell(), [24, 24]).unwrap());
        let first = texture.owner.iter().filter(|&&owner| owner == 0).count();
        assert!(first > 24 * 24 / 2, "level 1 owns {first} of 576");
    }

    #[test]
    fn samples_between_equal_indenters_are_tied() {
        let level = Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0).unwrap();
        let lattice = Lattice::square(1.0, 4).unwrap();
        let surface = Surface::Indenters { lattice, levels: vec![level; 4] };
        let texture = surface.sample(&Grid::new(surface.cell(), [8, 8]).unwrap());
        // Rows and columns 2 and 6 lie halfway between the sites: 2·8 + 2·8 − 4 samples, four of them between all
        // sites.
        assert_eq!(texture.ties.len(), 28);
        assert_eq!(texture.ties.iter().filter(|(_, sites)| sites.len() == 4).count(), 4);
    }

    #[test]
    fn shape_is_the_minimum_over_every_image() {
        let level = |shape, height| Level::new(shape, height).unwrap();
        let cell = Cell::new([1.0, 0.1], [1.7, 0.9]).unwrap();
        let places = vec![vec![[0.13, 0.2], [0.6, 0.77]], vec![[0.4, 0.9]]];
        let levels = vec![level(Shape::Cone { slope: 0.4 }, 0.1), level(Shape::Sphere { radius: 3.0 }, 0.04)];
        let surface =
            Surface::Indenters { lattice: Lattice::new(cell, places.clone()).unwrap(), levels: levels.clone() };
        let grid = Grid::new(cell, [10, 9]).unwrap();
        let texture = surface.sample(&grid);
        for index in 0..grid.len() {
            let s = grid.fractions(index);
            let mut least = f64::INFINITY;
            for (m, place) in places.iter().enumerate().flat_map(|(m, p)| p.iter().map(move |x| (m, x))) {
                for (i, j) in (-4..=4).flat_map(|i| (-4..=4).map(move |j| (f64::from(i), f64::from(j)))) {
                    let [x, y] = cell.point([s[0] - place[0] + i, s[1] - place[1] + j]);
                    least = least.min(levels[m].shape().profile(x.hypot(y)) + 0.06 * m as f64);
                }
            }
            assert!((texture.shape[index] - least).abs() < 1e-14);
        }
    }

    #[test]
    fn resampling_keeps_common_samples_and_constants() {
        let field: Vec<f64> = (0..24).map(|i| f64::from(i * i % 7)).collect();
        for interpolation in [Interpolation::Bilinear, Interpolation::AcrossDiagonal, Interpolation::AlongDiagonal] {
            let finer = resample(&field, [4, 6], [8, 12], interpolation);
            assert!((0..24).all(|i| finer[(2 * (i / 6)) * 12 + 2 * (i % 6)] == field[i]));
            let constant = resample(&[2.5; 24], [4, 6], [7, 5], interpolation);
            assert!(constant.iter().all(|&x| (x - 2.5).abs() < 1e-15));
        }
    }
}

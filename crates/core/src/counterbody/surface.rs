//! The undeformed surface of the rigid counterbody on a grid.
//!
//! f(**x**) = min over all indenters of [f_m(|**x** − **x**ᵢ|) + d_m]: the initial gap, the distance of the counterbody's
//! surface above its highest apex. The indenter of the minimum owns the sample. Every profile increases with the
//! radius, so that only the nearest periodic image of an indenter contributes.

use super::roughness::Spectrum;
use super::{Counterbody, Indenters, Site};
use crate::lattice::{Cell, Grid, LatticeError, ReducedBasis};
use crate::numeric::array::{field, samples};
use crate::numeric::sums;
use ndarray::{Array2, ArrayView2};
use rayon::prelude::*;
use std::fmt;
use std::sync::Arc;

/// The undeformed surface of the counterbody on a grid.
#[derive(Debug, Clone)]
pub struct Surface {
    grid: Arc<Grid>,
    initial_gap: Array2<f64>,
    owner: Option<Array2<u32>>,
    /// Samples owned by several sites, to rounding, each with all of these sites; in ascending order.
    ties: Vec<(usize, Vec<u32>)>,
    sites: Vec<Site>,
}

impl Surface {
    /// Surface of the counterbody on a grid of its cell with `points` = [N₁, N₂]: exact for indenters, [resampled](super::Topography::depths)
    /// for a topography.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn new(counterbody: &Counterbody, points: [usize; 2]) -> Result<Self, LatticeError> {
        let grid = Arc::new(Grid::new(counterbody.cell(), points)?);
        match counterbody {
            Counterbody::Indenters(indenters) => Ok(of_indenters(indenters, grid)),
            Counterbody::Topography(topography) => Ok(Self::without_owners(grid, topography.depths(points)?)),
        }
    }

    /// Surface without any height on a grid of a cell.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub(crate) fn flat(cell: Cell, points: [usize; 2]) -> Result<Self, LatticeError> {
        Ok(Self::without_owners(Arc::new(Grid::new(cell, points)?), Array2::zeros(points)))
    }

    fn without_owners(grid: Arc<Grid>, initial_gap: Array2<f64>) -> Self {
        Self { grid, initial_gap, owner: None, ties: Vec::new(), sites: Vec::new() }
    }

    /// Surface without owners on a coarser grid: every k-th sample, with heights unchanged, where the numbers of
    /// samples are multiples along both directions; otherwise the waves that the coarser grid holds.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub(super) fn coarser(&self, points: [usize; 2]) -> Result<Self, LatticeError> {
        let cell = self.grid.cell();
        let grid = Arc::new(Grid::new(cell, points)?);
        Ok(Self::without_owners(grid, restricted(cell, self.initial_gap(), points)?))
    }

    /// The surface with another initial gap, f ≥ 0, lengths measured from first touch, axes along a₁ and a₂; the indenter of
    /// each sample stays.
    pub(crate) fn with_initial_gap(&self, initial_gap: Array2<f64>) -> Self {
        Self { initial_gap, ..self.clone() }
    }

    /// The surface with its initial gap opened by `lift`, lengths sample by sample, a₂ fastest.
    pub(crate) fn opened(&self, lift: &[f64]) -> Self {
        let mut gap = self.initial_gap.clone();
        gap.iter_mut().zip(lift).for_each(|(gap, lift)| *gap += lift);
        self.with_initial_gap(gap)
    }

    /// A gap on a finer grid of the same cell, or on this one, restricted to this grid: as [`Self::coarser`] restricts the
    /// heights of a topography.
    pub(crate) fn restricted(&self, gap: &Array2<f64>) -> Array2<f64> {
        restricted(self.grid.cell(), gap.view(), self.grid.points()).expect("a grid has points")
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// Initial gap f, lengths ≥ 0 measured from the highest apex; axes along a₁ and a₂.
    pub fn initial_gap(&self) -> ArrayView2<'_, f64> {
        self.initial_gap.view()
    }

    /// Initial gap f sample by sample, lengths, a₂ fastest.
    pub(crate) fn gaps(&self) -> &[f64] {
        samples(&self.initial_gap)
    }

    /// Index into [`Surface::sites`] of the indenter whose surface faces each sample, axes along a₁ and a₂; `None` for a
    /// topography.
    pub fn owner(&self) -> Option<ArrayView2<'_, u32>> {
        self.owner.as_ref().map(|owner| owner.view())
    }

    /// Index into [`Surface::sites`] of the owner of each sample, a₂ fastest; empty for a topography.
    pub fn owners(&self) -> &[u32] {
        self.owner.as_ref().map_or(&[], samples)
    }

    /// Level (from 1) of the indenter whose surface faces a sample; 0 for a topography.
    pub fn level_at(&self, sample: usize) -> usize {
        self.owners().get(sample).map_or(0, |&owner| self.sites[owner as usize].level)
    }

    /// Samples owned by several sites, each with all of these sites.
    pub(crate) fn ties(&self) -> &[(usize, Vec<u32>)] {
        &self.ties
    }

    /// The sites of the indenters; none for a topography.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// Index of the first site of a level (from 1).
    pub fn site_of(&self, level: usize) -> Option<usize> {
        self.sites.iter().position(|site| site.level == level)
    }

    /// The vector from the axis of the nearest image of the site `site` to a sample, a length.
    pub fn offset(&self, reduced: &ReducedBasis, site: u32, sample: usize) -> [f64; 2] {
        let (here, place) = (self.grid.fractions(sample), self.sites[site as usize].place);
        reduced.nearest([here[0] - place[0], here[1] - place[1]])
    }

    /// Largest minus smallest initial gap, a length.
    pub fn range(&self) -> f64 {
        let gaps = self.gaps();
        self.largest() - sums::least(gaps.len(), |i| gaps[i])
    }

    /// Largest initial gap, a length.
    pub(crate) fn largest(&self) -> f64 {
        let gaps = self.gaps();
        -sums::least(gaps.len(), |i| -gaps[i])
    }

    /// Mean initial gap, the penetration at which contact is complete, a length.
    pub fn mean(&self) -> f64 {
        sums::mean(self.gaps())
    }
}

impl fmt::Display for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "surface on {}", self.grid)
    }
}

/// Every k-th sample of a gap where its grid has a whole fraction of them along either direction; else the waves that the
/// coarser grid of `points` holds.
fn restricted(cell: Cell, gap: ArrayView2<'_, f64>, points: [usize; 2]) -> Result<Array2<f64>, LatticeError> {
    let (rows, columns) = gap.dim();
    let shape = [rows, columns];
    if (0..2).all(|axis| shape[axis].is_multiple_of(points[axis])) {
        let [every1, every2] = [0, 1].map(|axis| shape[axis] / points[axis]);
        return Ok(Array2::from_shape_fn(points, |(i, j)| gap[[every1 * i, every2 * j]]));
    }
    Spectrum::of(cell, gap)?.resampled(points)
}

/// Largest relative difference of the depths of indenters that own a sample together.
const TIE_TOLERANCE: f64 = 1e-12;

fn of_indenters(indenters: &Indenters, grid: Arc<Grid>) -> Surface {
    let lattice = indenters.lattice();
    let reduced = lattice.cell().reduced();
    let sites = indenters.sites();
    let (first, others) = sites.split_first().expect("a lattice has sites");
    let depth = |index: usize, site: &Site| {
        let here = grid.fractions(index);
        let [x, y] = reduced.nearest([here[0] - site.place[0], here[1] - site.place[1]]);
        site.profile((x * x + y * y).sqrt())
    };
    let all_facing = |index: usize, nearest: f64| {
        let facing = (0..).zip(&sites).filter(|(_, site)| depth(index, site) <= nearest * (1.0 + TIE_TOLERANCE));
        (index, facing.map(|(number, _)| number).collect())
    };
    let points = grid.points();
    let (mut gap, mut owner) = (vec![0.0; grid.len()], vec![0; grid.len()]);
    let rows = (gap.par_chunks_mut(points[1]), owner.par_chunks_mut(points[1])).into_par_iter().enumerate();
    let ties = rows.flat_map_iter(|(row, (gap, owner))| {
        let fill = |site: &Site, depths: &mut [f64]| {
            let here = row as f64 / points[0] as f64;
            reduced.nearest_squares([here - site.place[0], -site.place[1]], points[1], depths);
            site.profiles(depths);
        };
        let (mut depths, mut tied) = (vec![0.0; points[1]], vec![false; points[1]]);
        // Site 0 owns every sample until another one is nearer.
        fill(first, gap);
        for (number, site) in (1..).zip(others) {
            fill(site, &mut depths);
            for (((nearest, owner), tied), &depth) in gap.iter_mut().zip(&mut *owner).zip(&mut tied).zip(&depths) {
                if depth < *nearest * (1.0 - TIE_TOLERANCE) {
                    (*nearest, *owner, *tied) = (depth, number, false);
                } else {
                    *tied |= depth <= *nearest * (1.0 + TIE_TOLERANCE);
                }
            }
        }
        let tied = tied.into_iter().enumerate().filter(|(_, tied)| *tied);
        tied.map(|(column, _)| all_facing(row * points[1] + column, gap[column])).collect::<Vec<_>>()
    });
    let ties = ties.collect();
    Surface { initial_gap: field(points, gap), owner: Some(field(points, owner)), ties, sites, grid }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counterbody::{Level, Shape};
    use crate::lattice::Lattice;

    fn on(lattice: Lattice, levels: Vec<Level>, points: [usize; 2]) -> Surface {
        Surface::new(&Indenters::new(lattice, levels).unwrap().into(), points).unwrap()
    }

    fn paraboloid(height: f64) -> Level {
        Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap()
    }

    #[test]
    fn apices_stand_on_their_sites_at_their_drops() {
        let levels = [0.02, 0.01, 0.0].map(paraboloid).to_vec();
        let surface = on(Lattice::hexagonal(1.0, 3).unwrap(), levels, [12, 12]);
        for (site, drop) in [([0, 0], 0.0), ([4, 4], 0.01), ([8, 8], 0.02)] {
            assert!((surface.initial_gap()[site] - drop).abs() < 1e-15);
        }
        assert_eq!(surface.level_at(4 * 12 + 4), 2);
        assert!(surface.range() > 0.2 && surface.range() < 0.23);
    }

    #[test]
    fn the_nearest_surface_owns_a_sample_not_the_nearest_site() {
        // Halfway between levels 1 and 3 the higher one is nearer.
        let surface = on(Lattice::square(1.0, 2).unwrap(), vec![paraboloid(0.1), paraboloid(0.0)], [24, 24]);
        let first = surface.owners().iter().filter(|&&owner| owner == 0).count();
        assert!(first > 24 * 24 / 2, "level 1 owns {first} of 576");
    }

    #[test]
    fn samples_between_equal_indenters_are_tied() {
        let surface = on(Lattice::square(1.0, 4).unwrap(), vec![paraboloid(0.0); 4], [8, 8]);
        // Rows and columns 2 and 6 lie halfway between the sites: 2·8 + 2·8 − 4 samples, four of them between all
        // sites.
        assert_eq!(surface.ties.len(), 28);
        assert_eq!(surface.ties.iter().filter(|(_, sites)| sites.len() == 4).count(), 4);
        assert!(surface.ties.iter().any(|(sample, sites)| *sample == 2 * 8 + 2 && sites.len() == 4));
    }

    #[test]
    fn the_initial_gap_is_the_minimum_over_every_image() {
        let level = |shape, height| Level::new(shape, height).unwrap();
        let cell = Cell::new([1.0, 0.1], [1.7, 0.9]).unwrap();
        let places = vec![vec![[0.13, 0.2], [0.6, 0.77]], vec![[0.4, 0.9]]];
        let levels = vec![level(Shape::Cone { slope: 0.4 }, 0.1), level(Shape::Sphere { radius: 3.0 }, 0.04)];
        let surface = on(Lattice::new(cell, places.clone()).unwrap(), levels.clone(), [10, 9]);
        for index in 0..surface.grid().len() {
            let s = surface.grid().fractions(index);
            let mut least = f64::INFINITY;
            for (m, place) in places.iter().enumerate().flat_map(|(m, p)| p.iter().map(move |x| (m, x))) {
                for (i, j) in (-4..=4).flat_map(|i| (-4..=4).map(move |j| (f64::from(i), f64::from(j)))) {
                    let [x, y] = cell.vector([s[0] - place[0] + i, s[1] - place[1] + j]);
                    least = least.min(levels[m].shape().profile(x.hypot(y)) + 0.06 * m as f64);
                }
            }
            assert!((surface.gaps()[index] - least).abs() < 1e-14);
        }
    }
}

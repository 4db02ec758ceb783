//! A system of indenters on a layered half-space, as the localized method sees it.

use super::circle::Circle;
use super::point::PointKernel;
use crate::body::HalfSpace;
use crate::counterbody::{Indenters, Level};
use crate::lattice::Cell;
use std::fmt;

/// Indenters in the circles while the size of the contacts is found.
pub(super) const COARSE_INDENTERS: usize = 7;
/// One indenter of the cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Site {
    /// Level, from 1.
    pub level: usize,
    /// Place in fractions of the cell vectors.
    pub place: [f64; 2],
}

/// A system of indenters on a layered half-space.
#[derive(Debug, Clone)]
pub struct System {
    indenters: Indenters,
    drops: Vec<f64>,
    sites: Vec<Site>,
    kernel: PointKernel,
    nearest: f64,
    half_space: HalfSpace,
}

impl System {
    /// `indenters` on `half_space`, for circles of up to `count` of them.
    pub fn new(indenters: &Indenters, half_space: &HalfSpace, count: usize) -> Self {
        let lattice = indenters.lattice();
        let sites: Vec<Site> = (1..)
            .zip(lattice.sites())
            .flat_map(|(level, places)| places.iter().map(move |&place| Site { level, place }))
            .collect();
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        let nearest = sites
            .iter()
            .flat_map(|site| (1..=indenters.levels().len()).map(|level| length(lattice.toward(site.place, level))))
            .fold(f64::INFINITY, f64::min);
        let places: Vec<[f64; 2]> = sites.iter().map(|site| site.place).collect();
        let farthest = (0..sites.len())
            .flat_map(|centre| Circle::new(lattice, &places, centre, count.max(COARSE_INDENTERS)).images.concat())
            .map(length)
            .fold(0.0, f64::max);
        Self {
            drops: indenters.drops(),
            sites,
            // From the far corner of one mesh to that of another, and room for circles whose radius moves.
            kernel: PointKernel::new(half_space, 2.0 * (farthest.max(lattice.cell().area().sqrt()) + 3.0 * nearest)),
            indenters: indenters.clone(),
            nearest,
            half_space: half_space.clone(),
        }
    }

    /// What the indenters press into.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// Point kernel of the half-space.
    pub fn kernel(&self) -> &PointKernel {
        &self.kernel
    }

    /// The indenters of the cell.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// The levels.
    pub fn levels(&self) -> &[Level] {
        self.indenters.levels()
    }

    /// Index of the site whose apex stands highest.
    pub fn highest(&self) -> usize {
        let higher = |a: &usize, b: &usize| self.profile(*a, 0.0).total_cmp(&self.profile(*b, 0.0));
        (0..self.sites.len()).min_by(higher).unwrap_or(0)
    }

    /// Contact modulus E* of the material at the surface, a pressure.
    pub fn contact_modulus(&self) -> f64 {
        self.half_space.surface_material().contact_modulus()
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.indenters.lattice().cell()
    }

    /// Area of the cell.
    pub fn cell_area(&self) -> f64 {
        self.indenters.lattice().cell().area()
    }

    /// Distance of the nearest two indenters, a length.
    pub fn nearest(&self) -> f64 {
        self.nearest
    }

    /// Profile of a site's indenter at the distance `r` from its axis, with its drop: a length.
    pub fn profile(&self, site: usize, r: f64) -> f64 {
        let level = self.sites[site].level - 1;
        self.levels()[level].shape().profile(r) + self.drops[level]
    }

    /// Circles of at least `indenters` around every site.
    pub fn circles(&self, indenters: usize) -> Vec<Circle> {
        let places = self.places();
        (0..places.len()).map(|centre| Circle::new(self.indenters.lattice(), &places, centre, indenters)).collect()
    }

    /// Circles around every site that hold all indenters up to the `distance`, a length.
    pub fn circles_within(&self, distance: f64) -> Vec<Circle> {
        let places = self.places();
        (0..places.len()).map(|centre| Circle::within(self.indenters.lattice(), &places, centre, distance)).collect()
    }

    /// From each site to each other one of the cell, lengths.
    pub fn offsets(&self) -> Vec<Vec<[f64; 2]>> {
        let places = self.places();
        let offset = |from: [f64; 2], to: [f64; 2]| self.cell().point([to[0] - from[0], to[1] - from[1]]);
        places.iter().map(|&from| places.iter().map(|&to| offset(from, to)).collect()).collect()
    }

    fn places(&self) -> Vec<[f64; 2]> {
        self.sites.iter().map(|site| site.place).collect()
    }
}

impl fmt::Display for System {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, influence coefficients to {:.0e}", self.indenters.lattice(), self.kernel.error().max(1e-11))
    }
}

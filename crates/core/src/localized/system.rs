//! A system of indenters on a layered half-space, with the kernel of the localized method.

use super::circle::Circle;
use super::edge_ratios::EdgeRatios;
use super::point::PointKernel;
use crate::body::{Bodies, HalfSpace};
use crate::counterbody::{Indenters, Level, Site};
use crate::lattice::Cell;
use std::fmt;
use std::sync::Arc;

/// Number of indenters in the circles while the size of the contacts is found.
pub(super) const COARSE_INDENTERS: usize = 7;

/// Indenters on a layered half-space, with its point kernel.
#[derive(Debug, Clone)]
pub struct System {
    indenters: Indenters,
    sites: Vec<Site>,
    kernel: PointKernel,
    bodies: Bodies,
    edge: Arc<EdgeRatios>,
}

impl System {
    /// `indenters` on `bodies`, for circles of up to `count` of them.
    pub fn new(indenters: &Indenters, bodies: &Bodies, count: usize) -> Self {
        let lattice = indenters.lattice();
        let (sites, nearest) = (indenters.sites(), lattice.period());
        let places: Vec<[f64; 2]> = sites.iter().map(|site| site.place).collect();
        let farthest = (0..sites.len())
            .flat_map(|centre| Circle::new(lattice, &places, centre, count.max(COARSE_INDENTERS)).images.concat())
            .map(|[x, y]| x.hypot(y))
            .fold(0.0, f64::max);
        // From the far corner of one mesh to that of another, with a margin for circles of varying radius.
        let kernel = PointKernel::new(bodies, 2.0 * (farthest.max(lattice.cell().area().sqrt()) + 3.0 * nearest));
        Self {
            sites,
            edge: Arc::new(EdgeRatios::new(&kernel)),
            kernel,
            indenters: indenters.clone(),
            bodies: bodies.clone(),
        }
    }

    /// The layered half-space.
    pub fn half_space(&self) -> &HalfSpace {
        self.bodies.body()
    }

    /// Point kernel of the half-space.
    pub fn kernel(&self) -> &PointKernel {
        &self.kernel
    }

    /// Ratios of pressure and gap at an edge to those on a bare half-space.
    pub(super) fn edge(&self) -> &Arc<EdgeRatios> {
        &self.edge
    }

    /// Sites of the cell, one per indenter.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// Levels of the indenters.
    pub fn levels(&self) -> &[Level] {
        self.indenters.levels()
    }

    /// Index of the site with the highest apex.
    pub fn highest(&self) -> usize {
        let drop = |site: usize| self.sites[site].drop;
        (0..self.sites.len()).min_by(|&a, &b| drop(a).total_cmp(&drop(b))).unwrap_or(0)
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.indenters.lattice().cell()
    }

    /// Least distance of two indenters, a length.
    pub fn nearest(&self) -> f64 {
        self.indenters.lattice().period()
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

    /// Vectors from each site to each other one of the cell, lengths.
    pub fn offsets(&self) -> Vec<Vec<[f64; 2]>> {
        let places = self.places();
        let offset = |from: [f64; 2], to: [f64; 2]| self.cell().vector([to[0] - from[0], to[1] - from[1]]);
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

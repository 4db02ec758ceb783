//! The circle around an indenter: the indenters inside, and its radius.
//!
//! Whole shells of indenters at equal distance are taken, so that the circle has the lattice's symmetry. Outside the
//! radius R the mean pressure p̄ acts. Eq. (4) gives R for one level only; two rules hold for any number:
//!
//! - **area-balanced**: π R² = N A₁, N indenters inside with the cell area A₁ of one;
//! - **load-balanced**: π R² p̄ = Σ_c N_c P_c, equilibrium inside the circle. It reduces to Eq. (4) for one level.
//!
//! A third rule has no radius: all indenters outside the circle act themselves, as a lattice sum
//! ([`exterior`](super::exterior)).

use crate::lattice::Lattice;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Rule for the radius R of the circle outside of which the mean pressure acts, or what acts there instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CircleRadius {
    /// The indenters inside carry π R² p̄.
    LoadBalanced,
    /// The cells of the indenters inside have the area π R².
    AreaBalanced,
    /// No uniform pressure: the lattice sum of all indenters outside.
    LatticeSum,
}

impl CircleRadius {
    /// Name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Self::LoadBalanced => "load-balanced",
            Self::AreaBalanced => "area-balanced",
            Self::LatticeSum => "lattice-sum",
        }
    }

    /// The rule that a comparison shows beside this one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::LoadBalanced => Self::AreaBalanced,
            Self::AreaBalanced | Self::LatticeSum => Self::LoadBalanced,
        }
    }
}

/// Largest relative difference of the distances within one shell.
const SHELL_TOLERANCE: f64 = 1e-9;

/// The indenters inside the circle around one site.
#[derive(Debug, Clone, PartialEq)]
pub struct Circle {
    /// Vectors from the centre to the images of each site inside the circle, lengths; the centre itself comes first in its own
    /// list.
    pub images: Vec<Vec<[f64; 2]>>,
}

impl Circle {
    /// Circle around the site `centre` of `sites` (places in fractions of the cell vectors) with at least `indenters`
    /// inside, in whole shells.
    pub fn new(lattice: &Lattice, sites: &[[f64; 2]], centre: usize, indenters: usize) -> Self {
        let area = lattice.cell().area() / sites.len() as f64;
        // A circle of this radius contains at least as many.
        let reach = (indenters as f64 * area / PI).sqrt() + 2.0 * lattice.cell().reduced().longer_side();
        let circle = Self::within(lattice, sites, centre, reach);
        let mut distances: Vec<f64> = circle.images.iter().flatten().map(|[x, y]| x.hypot(*y)).collect();
        distances.sort_by(f64::total_cmp);
        Self::within(lattice, sites, centre, distances[indenters.clamp(1, distances.len()) - 1])
    }

    /// Circle around the site `centre` of `sites` that holds all indenters up to the `distance`, a length.
    pub fn within(lattice: &Lattice, sites: &[[f64; 2]], centre: usize, distance: f64) -> Self {
        let reduced = lattice.cell().reduced();
        let mut all: Vec<(f64, usize, [f64; 2])> = Vec::new();
        for (site, place) in sites.iter().enumerate() {
            let from = reduced.nearest([place[0] - sites[centre][0], place[1] - sites[centre][1]]);
            for vector in reduced.vectors_within(distance + reduced.longer_side()) {
                let offset = [from[0] + vector[0], from[1] + vector[1]];
                all.push((offset[0].hypot(offset[1]), site, offset));
            }
        }
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut images = vec![Vec::new(); sites.len()];
        for (r, site, offset) in all {
            if r <= distance * (1.0 + SHELL_TOLERANCE) {
                images[site].push(offset);
            }
        }
        Self { images }
    }

    /// Number of indenters inside, the centre included.
    pub fn indenters(&self) -> usize {
        self.images.iter().map(Vec::len).sum()
    }

    /// Area-balanced radius R, a length, for the cell area `area` of one indenter.
    pub fn area_balanced(&self, area: f64) -> f64 {
        (self.indenters() as f64 * area / PI).sqrt()
    }

    /// Load-balanced radius R, a length, for the `loads` on one indenter of each site under the mean pressure.
    pub fn load_balanced(&self, loads: &[f64], mean_pressure: f64) -> f64 {
        let inside: f64 = self.images.iter().zip(loads).map(|(images, load)| images.len() as f64 * load).sum();
        if mean_pressure > 0.0 { (inside / (PI * mean_pressure)).max(0.0).sqrt() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shells_of_the_hexagonal_lattice_hold_their_numbers_whatever_the_level() {
        let lattice = Lattice::hexagonal(1.0, 3).unwrap();
        let sites: Vec<[f64; 2]> = lattice.sites().concat();
        for centre in 0..3 {
            for (asked, whole) in [(1, 1), (2, 7), (7, 7), (13, 13), (14, 19), (31, 31), (37, 37), (55, 55), (73, 73)] {
                let circle = Circle::new(&lattice, &sites, centre, asked);
                assert_eq!(circle.indenters(), whole, "{asked} asked");
                assert_eq!(circle.images[centre][0], [0.0, 0.0]);
            }
            // One of the level of the centre and three of each other within one period.
            let counts = Circle::new(&lattice, &sites, centre, 7).images.iter().map(Vec::len).collect::<Vec<_>>();
            assert!((0..3).all(|site| counts[site] == if site == centre { 1 } else { 3 }));
        }
    }

    #[test]
    fn both_radii_agree_with_eq_4_for_one_level() {
        let lattice = Lattice::hexagonal(1.0, 1).unwrap();
        let area = lattice.cell().area();
        let circle = Circle::new(&lattice, &lattice.sites().concat(), 0, 7);
        let expected = (7.0 * area / PI).sqrt();
        assert!((circle.area_balanced(area) - expected).abs() < 1e-14);
        assert!((circle.load_balanced(&[0.03 * area], 0.03) - expected).abs() < 1e-14);
    }

    #[test]
    fn a_skewed_cell_misses_no_indenter() {
        let cell = crate::lattice::Cell::new([1.0, 0.0], [7.3, 0.9]).unwrap();
        let lattice = Lattice::new(cell, vec![vec![[0.1, 0.2]], vec![[0.6, 0.3]]]).unwrap();
        let sites: Vec<[f64; 2]> = lattice.sites().concat();
        let circle = Circle::new(&lattice, &sites, 0, 40);
        let farthest = circle.images.iter().flatten().map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
        let mut inside = 0;
        for (i, j) in (-99..=99).flat_map(|i| (-12..=12).map(move |j| (f64::from(i), f64::from(j)))) {
            for site in &sites {
                let x = cell.vector([site[0] - sites[0][0] + i, site[1] - sites[0][1] + j]);
                inside += usize::from(x[0].hypot(x[1]) <= farthest * (1.0 + 1e-9));
            }
        }
        assert_eq!(circle.indenters(), inside);
    }
}

//! A system of indenters on a layered half-space, as the localized method sees it.

use super::circle::{Circle, CircleRadius};
use super::disc;
use super::exterior::Exterior;
use super::mesh::Mesh;
use super::point::PointKernel;
use super::solver::{Coupled, Solution, Stop};
use super::spot::Spot;
use super::square::Squares;
use crate::indenter::{Level, drops};
use crate::lattice::{Cell, Lattice};
use crate::material::HalfSpace;
use crate::solver::Control;
use std::f64::consts::PI;
use std::fmt;

/// Elements along the side of the meshes on which the size of the contacts is found.
const COARSE: usize = 25;
/// Indenters in the circles meanwhile.
const COARSE_INDENTERS: usize = 7;
/// Part of the mesh that the largest contact should fill.
const FILLING: f64 = 0.75;

/// What the localized method is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    /// Indenters inside each circle, at least: whole shells are taken.
    pub indenters: usize,
    /// Elements across the largest contact.
    pub elements: usize,
    /// How large the circles are.
    pub radius: CircleRadius,
    /// Whether the indenters around the one looked at act on it; if not, each is alone on the half-space.
    pub mutual_effect: bool,
}

impl Setup {
    /// Elements along the side of a mesh with so many across the largest contact.
    pub fn width(elements: usize) -> usize {
        (elements as f64 / FILLING).ceil() as usize / 2 * 2 + 1
    }
}

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
pub struct Localized {
    lattice: Lattice,
    levels: Vec<Level>,
    drops: Vec<f64>,
    sites: Vec<Site>,
    kernel: PointKernel,
    nearest: f64,
    contact_modulus: f64,
}

impl Localized {
    /// Indenters of `levels` on `lattice` (as many as it has) on `half_space`, for circles of up to `indenters`.
    pub fn new(lattice: &Lattice, levels: &[Level], half_space: &HalfSpace, indenters: usize) -> Self {
        let sites: Vec<Site> = (1..)
            .zip(lattice.sites())
            .flat_map(|(level, places)| places.iter().map(move |&place| Site { level, place }))
            .collect();
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        let nearest = sites
            .iter()
            .flat_map(|site| (1..=levels.len()).map(|level| length(lattice.toward(site.place, level))))
            .fold(f64::INFINITY, f64::min);
        let places: Vec<[f64; 2]> = sites.iter().map(|site| site.place).collect();
        let farthest = (0..sites.len())
            .flat_map(|centre| Circle::new(lattice, &places, centre, indenters.max(COARSE_INDENTERS)).images.concat())
            .map(length)
            .fold(0.0, f64::max);
        Self {
            lattice: lattice.clone(),
            levels: levels.to_vec(),
            drops: drops(levels),
            sites,
            // From the far corner of one mesh to that of another, and room for circles whose radius moves.
            kernel: PointKernel::new(half_space, 2.0 * (farthest.max(lattice.cell().area().sqrt()) + 3.0 * nearest)),
            nearest,
            contact_modulus: half_space.surface_material().contact_modulus(),
        }
    }

    /// Point kernel of the half-space.
    pub fn kernel(&self) -> &PointKernel {
        &self.kernel
    }

    /// The indenters of the cell.
    pub fn sites(&self) -> &[Site] {
        &self.sites
    }

    /// Number of levels.
    pub fn levels(&self) -> usize {
        self.levels.len()
    }

    /// Contact modulus E* of the material at the surface, a pressure.
    pub fn contact_modulus(&self) -> f64 {
        self.contact_modulus
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.lattice.cell()
    }

    /// Area of the cell.
    pub fn cell_area(&self) -> f64 {
        self.lattice.cell().area()
    }

    /// Distance of the nearest two indenters, a length.
    pub fn nearest(&self) -> f64 {
        self.nearest
    }

    /// Profile of a site's indenter at the distance `r` from its axis, with its drop: a length.
    pub fn profile(&self, site: usize, r: f64) -> f64 {
        let level = self.sites[site].level - 1;
        self.levels[level].shape().profile(r) + self.drops[level]
    }

    /// Circles of at least `indenters` around every site.
    pub fn circles(&self, indenters: usize) -> Vec<Circle> {
        let places = self.places();
        (0..places.len()).map(|centre| Circle::new(&self.lattice, &places, centre, indenters)).collect()
    }

    /// Circles around every site that hold all indenters up to the `distance`, a length.
    pub fn circles_within(&self, distance: f64) -> Vec<Circle> {
        let places = self.places();
        (0..places.len()).map(|centre| Circle::within(&self.lattice, &places, centre, distance)).collect()
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

    /// The mesh with `setup.elements` across the largest contact, and a coarse solution on the way to it: coarse meshes
    /// shrink onto the contacts, with few indenters in the circles.
    pub fn mesh(&self, control: Control, setup: &Setup) -> (Mesh, Solution) {
        let mut mesh = Mesh { width: COARSE, size: self.nearest / COARSE as f64 };
        let mut start = None;
        loop {
            let indenters = setup.indenters.min(COARSE_INDENTERS);
            let solution =
                Coupled::new(self, mesh, indenters, setup.mutual_effect).solve(control, setup.radius, start.as_ref());
            let radius = solution.spots.iter().map(Spot::counted_radius).fold(0.0, f64::max);
            let loose = 2.0 * radius < 0.5 * FILLING * 2.0 * mesh.half();
            if loose && solution.stop == Stop::Converged && solution.mean_pressure > 0.0 {
                mesh.size = 2.0 * (radius + mesh.size) / FILLING / COARSE as f64;
                start = Some(solution);
                continue;
            }
            // Loads that did not come to rest tell nothing of the contact's size.
            let radius = if solution.stop == Stop::Stalled { FILLING * mesh.half() } else { radius };
            let fine = Mesh {
                width: Setup::width(setup.elements),
                size: 2.0 * radius.max(0.5 * mesh.size) / setup.elements as f64,
            };
            return (fine, solution);
        }
    }

    /// Solves one load step.
    pub fn solve(&self, control: Control, setup: &Setup) -> Solution {
        let (mut mesh, start) = self.mesh(control, setup);
        let most = 2 * mesh.width;
        loop {
            let coupled = Coupled::new(self, mesh, setup.indenters, setup.mutual_effect);
            let solution = coupled.solve(control, setup.radius, Some(&start));
            if solution.stop != Stop::Rim {
                return solution;
            }
            mesh.width = mesh.width * 5 / 4 / 2 * 2 + 1;
            if mesh.width > most {
                // Far larger than thought: as many elements across the contact are twice as large.
                mesh = mesh.halved();
            }
        }
    }

    /// Additional displacement w_a by Eq. (8): displacement at the highest apex by the pressures inside its circle,
    /// minus that by p̄ on the circle, or with the lattice sum of what is outside: a length. Summed anew, element by
    /// element.
    ///
    /// It equals the penetration where the highest level touches.
    pub fn additional_displacement(&self, solution: &Solution) -> f64 {
        let highest = (0..self.sites.len()).min_by(|&a, &b| self.profile(a, 0.0).total_cmp(&self.profile(b, 0.0)));
        let Some(highest) = highest else { return 0.0 };
        let spot = &solution.spots[highest];
        let squares = Squares::new(&self.kernel, 0.5 * spot.mesh.size);
        let element = spot.mesh.size * spot.mesh.size;
        let lattice_sum = spot.radius.is_finite() && solution.rule == CircleRadius::LatticeSum;
        let exterior = lattice_sum.then(|| Exterior::new(self, spot.mesh, spot.circle.indenters()));
        let circle = exterior.as_ref().map_or(&spot.circle, |exterior| &exterior.circles()[highest]);
        let mut sum = 0.0;
        for (c, (source, images)) in solution.spots.iter().zip(&circle.images).enumerate() {
            for (index, &p) in source.pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                let [x, y] = source.mesh.place(index);
                sum += p * images.iter().map(|[u, v]| squares.coefficient(x + u, y + v)).sum::<f64>();
                sum += exterior.as_ref().map_or(0.0, |exterior| p * element * exterior.at(highest, c, [-x, -y]));
            }
        }
        if spot.radius.is_finite() && !lattice_sum {
            sum -= solution.mean_pressure * disc::displacement(&self.kernel, spot.radius, 0.0).value;
        }
        sum
    }

    /// What a tribologist reads off a solution, level by level.
    pub fn observe(&self, solution: &Solution) -> Vec<LevelReading> {
        let whole: f64 = solution.spots.iter().map(Spot::load).sum();
        let reading = |level: usize| {
            let own: Vec<&Spot> = solution.spots.iter().filter(|spot| spot.level == level).collect();
            let load: f64 = own.iter().map(|spot| spot.load()).sum();
            let area = |spot: &&Spot| PI * spot.contact_radius().powi(2);
            LevelReading {
                level,
                load: load / own.len() as f64,
                load_share: if whole > 0.0 { load / whole } else { 0.0 },
                max_pressure: own.iter().map(|spot| spot.peak()).fold(0.0, f64::max),
                contact_radius: (own.iter().map(area).sum::<f64>() / PI / own.len() as f64).sqrt(),
                ring: own.iter().any(|spot| spot.outline().is_some_and(|outline| outline.hole > 0.0)),
                radius: own.iter().map(|spot| spot.radius).sum::<f64>() / own.len() as f64,
            }
        };
        (1..=self.levels.len()).map(reading).collect()
    }
}

/// Scalars of one level of a localized solution. Where a level has several indenters in the cell, loads and areas are
/// means over them, peaks the largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelReading {
    /// Level, from 1.
    pub level: usize,
    /// Force on one indenter.
    pub load: f64,
    /// Share of the whole load.
    pub load_share: f64,
    /// Peak pressure.
    pub max_pressure: f64,
    /// √(contact area/π), a length.
    pub contact_radius: f64,
    /// Whether a contact of this level is open in the middle.
    pub ring: bool,
    /// Radius R of the circle, a length; infinite without mutual effect.
    pub radius: f64,
}

impl fmt::Display for Localized {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, influence coefficients to {:.0e}", self.lattice, self.kernel.error().max(1e-11))
    }
}

//! The interaction of the levels on one mesh: circles, influence tables, and what acts outside the circles (paper, §2.3).
//!
//! The surface under the indenter in the centre of the circle m is displaced by its own pressure, by those of the other levels
//! inside the circle, and by what acts outside it: p̄, or the lattice sum ([`CircleRadius`]). `passes.rs` solves for them.

use super::circle::{Circle, CircleRadius};
use super::disc::FarField;
use super::mesh::Mesh;
use super::patterns::Patterns;
use super::solution::Stop;
use super::system::System;
use super::tables::InfluenceTables;
use crate::load::Control;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Number of nearest indenters that a contact is checked against for merging.
const NEIGHBOURS: usize = 13;

/// Circles and influence tables of a system on one mesh.
#[derive(Debug)]
pub struct Coupled {
    pub(super) system: Arc<System>,
    pub(super) mesh: Mesh,
    /// One circle for each site of the cell.
    pub(super) circles: Vec<Circle>,
    /// The nearest shells of indenters around each site, whatever the circle.
    neighbours: Vec<Circle>,
    /// Influence of the indenters inside the circles, computed at first use.
    inside: OnceLock<InfluenceTables>,
    /// Influence of all indenters of the lattice, computed at first use.
    whole: OnceLock<InfluenceTables>,
    /// Profile plus drop at each element, one list per site, lengths.
    pub(super) shapes: Vec<Vec<f64>>,
    mutual_effect: bool,
}

impl Coupled {
    /// Circles of at least `indenters` (in whole shells) on `mesh`; without mutual effect every indenter is alone.
    pub fn new(system: &Arc<System>, mesh: Mesh, indenters: usize, mutual_effect: bool) -> Self {
        let circles = system.circles(if mutual_effect { indenters } else { 1 });
        let places = || (0..mesh.elements()).map(|index| mesh.place(index));
        let shapes = system.sites().iter().map(|site| places().map(|[x, y]| site.profile(x.hypot(y))).collect());
        let shapes = shapes.collect();
        let neighbours = system.circles(NEIGHBOURS);
        let (inside, whole) = (OnceLock::new(), OnceLock::new());
        let system = Arc::clone(system);
        Self { system, mesh, circles, neighbours, inside, whole, shapes, mutual_effect }
    }

    /// Indenters inside the circles: the largest number of any of them.
    pub fn indenters(&self) -> usize {
        self.circles.iter().map(Circle::indenters).max().unwrap_or(0)
    }

    /// Depth at which two elements around the axis of the highest indenter are penetrated: a length.
    pub(super) fn first_depth(&self) -> f64 {
        let site = &self.system.sites()[self.system.highest()];
        site.profile(2.0 * self.mesh.size) - site.profile(0.0)
    }

    /// Influence tables of the indenters that act under a rule.
    pub(super) fn tables(&self, rule: CircleRadius) -> &InfluenceTables {
        if self.mutual_effect && rule == CircleRadius::LatticeSum {
            self.whole.get_or_init(|| InfluenceTables::whole(&self.system, self.mesh, self.circles[0].indenters()))
        } else {
            self.inside.get_or_init(|| InfluenceTables::inside(&self.system, self.mesh, &self.circles))
        }
    }

    /// Displacement of the spot m by each other site's indenters, one value per element, lengths; `None` for sites without load.
    pub(super) fn others(&self, tables: &InfluenceTables, m: usize, patterns: &Patterns) -> Vec<Option<Vec<f64>>> {
        let by = |c: usize| {
            let table = tables.of(m, c).filter(|_| c != m && patterns.loads[c] > 0.0)?;
            let mut displacement = vec![0.0; self.mesh.elements()];
            table.add(&patterns.pressures[c], &mut displacement);
            Some(displacement)
        };
        (0..self.circles.len()).map(by).collect()
    }

    /// Radius of the circle around m, a length; with the lattice sum outside, the load-balanced radius of the indenters inside.
    pub(super) fn radius(&self, m: usize, rule: CircleRadius, mean_pressure: f64, loads: &[f64]) -> f64 {
        let circle = &self.circles[m];
        match rule {
            _ if !self.mutual_effect => f64::INFINITY,
            CircleRadius::AreaBalanced => circle.area_balanced(self.system.cell().area() / self.circles.len() as f64),
            CircleRadius::LoadBalanced | CircleRadius::LatticeSum => circle.load_balanced(loads, mean_pressure),
        }
    }

    /// The disc that is cut out of the uniform pressure around a spot, and the displacement of each element under unit pressure
    /// on the disc; `None` where nothing acts outside, or the lattice sum does.
    pub(super) fn far_field(&self, rule: CircleRadius, radius: f64) -> Option<(FarField<'_>, Vec<f64>)> {
        if !self.mutual_effect || rule == CircleRadius::LatticeSum {
            return None;
        }
        let far = FarField::new(self.system.kernel(), radius, 2f64.sqrt() * self.mesh.half());
        let at = |index| {
            let [x, y] = self.mesh.place(index);
            far.at(x.hypot(y))
        };
        let under = (0..self.mesh.elements()).map(at).collect();
        Some((far, under))
    }

    /// d(p̄D)/dP_c under the spot m, a length per force, D = `under` there: the disc's rim moves with the load inside
    /// (∂D/∂R = 2πR K(R)), p̄ itself under a prescribed penetration.
    pub(super) fn far_coupling(
        &self,
        load: Control,
        rule: CircleRadius,
        m: usize,
        c: usize,
        far: &FarField<'_>,
        under: f64,
    ) -> f64 {
        let share = match load {
            Control::MeanPressure(_) => 0.0,
            Control::Penetration(_) => 1.0 / self.system.cell().area(),
        };
        match rule {
            CircleRadius::LatticeSum => 0.0,
            CircleRadius::AreaBalanced => under * share,
            CircleRadius::LoadBalanced if far.radius == 0.0 => 0.0,
            CircleRadius::LoadBalanced => {
                let rim = self.system.kernel().at(far.radius);
                let inside = self.circles[m].images[c].len() as f64;
                inside * rim + (under - PI * far.radius * far.radius * rim) * share
            }
        }
    }

    /// How a converged iteration ends: contacts may have merged, or reach the rim of their mesh.
    pub(super) fn reached(&self, patterns: &Patterns, merged: &[bool]) -> Stop {
        let on_rim = |pressure: &Vec<f64>| (0..pressure.len()).any(|i| pressure[i] > 0.0 && self.mesh.on_rim(i));
        if merged.contains(&true) {
            Stop::Merged
        } else if patterns.pressures.iter().any(on_rim) {
            Stop::Rim
        } else {
            Stop::Converged
        }
    }

    /// Whether each spot's contact reaches where the surface of a neighbour is nearer than that of its own indenter, or is
    /// reached in this way by a neighbour.
    pub(super) fn merged(&self, patterns: &Patterns) -> Vec<bool> {
        let mut merged = vec![false; self.circles.len()];
        for (m, pressure) in patterns.pressures.iter().enumerate().filter(|_| self.mutual_effect) {
            for index in (0..pressure.len()).filter(|&index| pressure[index] > 0.0) {
                let [x, y] = self.mesh.place(index);
                for (c, images) in self.neighbours[m].images.iter().enumerate() {
                    let nearer = |[u, v]: &[f64; 2]| {
                        self.system.sites()[c].profile((x - u).hypot(y - v)) < self.shapes[m][index]
                    };
                    if images.iter().any(nearer) {
                        (merged[m], merged[c]) = (true, true);
                    }
                }
            }
        }
        merged
    }
}

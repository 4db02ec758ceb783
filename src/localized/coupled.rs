//! Level by level: the contact of every spot with its circle, one penetration, one load (paper, §2.3).
//!
//! Each sweep presses every spot to the present penetration δ against the displacement by the other levels inside its
//! circle, each with the pattern of its last sweep, and by p̄, or by the lattice, outside it. Then the levels exchange loads
//! (`exchange.rs`) so that all have one penetration and carry p̄ together, Eq. (5). Only shapes lag behind, so
//! that some eight sweeps are enough however many indenters stand in the circle. A level comes into contact when a
//! sweep finds it penetrated, and leaves it when it would be pulled.
//!
//! A penetration beyond complete contact has no solution (`press.rs`), and a Newton step of the exchange does not know how
//! deep that is. Under a prescribed load the penetration therefore starts with a few elements and at most doubles from
//! sweep to sweep. A sweep beyond complete contact is undone, and the next one goes half the way from the last penetration
//! that could be pressed. The work is bounded by sweeps and by iterations.

use super::circle::{Circle, CircleRadius};
use super::disc::FarField;
use super::exchange::Sweep;
use super::mesh::Mesh;
use super::patterns::Patterns;
use super::press::{End, press, punch};
use super::solution::{Solution, Stop};
use super::spot::Spot;
use super::system::System;
use super::tables::Tables;
use crate::load::Load;
use crate::numeric::array::field;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Sweeps at most.
const SWEEPS: usize = 60;
/// Iterations on one spot at most, over all sweeps.
const WORK: usize = 2000;
/// Sweeps beyond complete contact, one after the other, after which a prescribed penetration is out of reach.
const OUT_OF_REACH: usize = 3;
/// The penetration starts with at least this part of what one element would need to carry the load.
const LEAST_RISE: f64 = 1e-3;
/// Relative tolerance of the loads, of the surfaces pressed, and of the stiffness.
const TOLERANCE: f64 = 1e-8;
const SURFACE_TOLERANCE: f64 = 1e-9;
const STIFFNESS_TOLERANCE: f64 = 1e-4;

/// Indenters that a contact is watched against.
const NEIGHBOURS: usize = 13;

/// Circles and influence tables of a system on one mesh.
#[derive(Debug)]
pub struct Coupled {
    system: Arc<System>,
    mesh: Mesh,
    circles: Vec<Circle>,
    /// The next shells of indenters, whatever the circle.
    neighbours: Vec<Circle>,
    /// Of the indenters inside the circles, made when a rule first asks for them.
    inside: OnceLock<Tables>,
    /// Of all indenters of the lattice.
    whole: OnceLock<Tables>,
    /// Profile plus drop at each element, per site.
    shapes: Vec<Vec<f64>>,
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

    /// Solves one load step, from an earlier solution where there is one.
    pub fn solve(&self, load: Load, rule: CircleRadius, start: Option<&Solution>) -> Solution {
        let tables = self.tables(rule);
        let count = self.circles.len();
        let cell = self.system.cell().area();
        let element = self.mesh.size * self.mesh.size;
        let mut patterns = Patterns::new(self.mesh, count, start);
        if let Load::Penetration(penetration) = load {
            patterns.penetration = penetration;
        }
        let mut gaps = vec![Vec::new(); count];
        let mut punches = vec![vec![0.0; self.mesh.elements()]; count];
        let mut radii = vec![f64::INFINITY; count];
        let mut mean_pressure = 0.0;
        let mut merged = vec![false; count];
        let (mut stop, mut sweeps) = (Stop::Stalled, 0);
        // Without penetration no spot has contact.
        let mut held = (Patterns::new(self.mesh, count, None), gaps.clone());
        let first_depth = match load {
            Load::MeanPressure(pressure) => {
                self.first_depth().max(LEAST_RISE * pressure * cell / element * tables.own(0).diagonal())
            }
            Load::Penetration(_) => self.first_depth(),
        };
        let (mut work, mut beyond) = (0, 0);
        // The penetration of what is held, where the last sweep was undone.
        let mut undone = None;
        while sweeps < SWEEPS && work < WORK * count && beyond < OUT_OF_REACH {
            sweeps += 1;
            mean_pressure = match load {
                Load::MeanPressure(pressure) => pressure,
                Load::Penetration(_) => patterns.loads.iter().sum::<f64>() / cell,
            };
            let mut sweep = Sweep::new(patterns.loads.clone());
            let (mut pressed, mut unbounded) = (true, false);
            for m in 0..count {
                let others = self.others(tables, m, &patterns);
                radii[m] = self.radius(m, rule, mean_pressure, &sweep.used);
                let far = self.far(rule, radii[m]);
                let wanted: Vec<f64> = (0..self.mesh.elements())
                    .map(|i| {
                        let moved: f64 = others.iter().flatten().map(|other| other[i]).sum();
                        let outside = far.as_ref().map_or(0.0, |(_, under)| mean_pressure * under[i]);
                        patterns.penetration - self.shapes[m][i] - moved + outside
                    })
                    .collect();
                let own = tables.own(m);
                let spot = press(own, &wanted, SURFACE_TOLERANCE, &mut patterns.pressures[m]);
                gaps[m] = spot.gap;
                pressed &= spot.end == End::Met;
                unbounded |= spot.end == End::Unbounded;
                work += spot.iterations;
                sweep.found[m] = patterns.pressures[m].iter().sum::<f64>() * element;
                if sweep.found[m] == 0.0 {
                    continue;
                }
                punches[m] = punch(own, &patterns.pressures[m], STIFFNESS_TOLERANCE, std::mem::take(&mut punches[m]));
                let sum: f64 = punches[m].iter().sum();
                sweep.stiffness[m] = sum * element;
                let under = |field: &[f64]| punches[m].iter().zip(field).map(|(s, u)| s * u).sum::<f64>() / sum;
                for c in 0..count {
                    // A level without a pattern acts from its axes.
                    let direct = match &others[c] {
                        Some(displacement) => under(displacement) / sweep.used[c],
                        None if c == m => 0.0,
                        None => tables.between_axes(m, c),
                    };
                    let outside =
                        far.as_ref().map_or(0.0, |(far, d)| self.far_coupling(load, rule, m, c, far, under(d)));
                    sweep.coupling[m][c] = direct - outside;
                }
            }
            // Only a prescribed penetration can lie beyond complete contact; every mean pressure has a solution.
            beyond = if unbounded && !load.is_mean_pressure() { beyond + 1 } else { 0 };
            if let (Load::MeanPressure(_), true) = (load, unbounded) {
                let depth = 0.5 * (held.0.penetration + patterns.penetration);
                (patterns, gaps) = held.clone();
                undone = Some(patterns.penetration);
                patterns.penetration = depth;
                continue;
            }
            undone = None;
            held = (Patterns { loads: sweep.found.clone(), ..patterns.clone() }, gaps.clone());
            let whole: f64 = sweep.found.iter().sum();
            let prescribed = match load {
                Load::MeanPressure(pressure) => Some(pressure * cell),
                Load::Penetration(_) => None,
            };
            if pressed && sweep.unrest(prescribed.unwrap_or(whole)) <= TOLERANCE * prescribed.unwrap_or(whole) {
                merged = self.merged(&patterns);
                stop = self.reached(&patterns, &merged);
                break;
            }
            if prescribed.is_some() && whole == 0.0 {
                patterns.penetration += patterns.penetration.abs() + first_depth;
                continue;
            }
            let (mut loads, mut rise) = sweep.exchanged(prescribed);
            // A small contact is soft: the penetration at most doubles.
            let most = patterns.penetration.abs() + first_depth;
            if rise > most {
                for (load, found) in loads.iter_mut().zip(&sweep.found) {
                    *load = found + most / rise * (*load - found);
                }
                rise = most;
            }
            patterns.penetration += rise;
            for m in 0..count {
                let factor = if sweep.found[m] > 0.0 { loads[m] / sweep.found[m] } else { 0.0 };
                patterns.scale(m, factor, loads[m]);
            }
        }
        let spots = (0..count)
            .map(|m| Spot {
                level: self.system.sites()[m].level,
                place: self.system.sites()[m].place,
                mesh: self.mesh,
                pressure: field([self.mesh.width; 2], std::mem::take(&mut patterns.pressures[m])),
                gap: field([self.mesh.width; 2], std::mem::take(&mut gaps[m])),
                circle: self.circles[m].clone(),
                radius: radii[m],
                merged: merged[m],
                edge: Arc::clone(self.system.edge()),
            })
            .collect();
        let system = Arc::clone(&self.system);
        let penetration = undone.unwrap_or(patterns.penetration);
        Solution { system, mean_pressure, penetration, rule, spots, stop, sweeps }
    }

    /// Depth at which two elements around the axis of the highest indenter are penetrated: a length.
    fn first_depth(&self) -> f64 {
        let site = &self.system.sites()[self.system.highest()];
        site.profile(2.0 * self.mesh.size) - site.profile(0.0)
    }

    /// Who acts on whom under a rule.
    fn tables(&self, rule: CircleRadius) -> &Tables {
        if self.mutual_effect && rule == CircleRadius::LatticeSum {
            self.whole.get_or_init(|| Tables::whole(&self.system, self.mesh, self.circles[0].indenters()))
        } else {
            self.inside.get_or_init(|| Tables::inside(&self.system, self.mesh, &self.circles))
        }
    }

    /// Displacement of the spot m by each other site's indenters; `None` for those without load.
    fn others(&self, tables: &Tables, m: usize, patterns: &Patterns) -> Vec<Option<Vec<f64>>> {
        let by = |c: usize| {
            let table = tables.of(m, c).filter(|_| c != m && patterns.loads[c] > 0.0)?;
            let mut displacement = vec![0.0; self.mesh.elements()];
            table.add(&patterns.pressures[c], &mut displacement);
            Some(displacement)
        };
        (0..self.circles.len()).map(by).collect()
    }

    /// Radius of the circle around m; with the lattice sum outside, that of the same indenters in equilibrium.
    fn radius(&self, m: usize, rule: CircleRadius, mean_pressure: f64, loads: &[f64]) -> f64 {
        let circle = &self.circles[m];
        match rule {
            _ if !self.mutual_effect => f64::INFINITY,
            CircleRadius::AreaBalanced => circle.area_balanced(self.system.cell().area() / self.circles.len() as f64),
            CircleRadius::LoadBalanced | CircleRadius::LatticeSum => circle.load_balanced(loads, mean_pressure),
        }
    }

    /// The disc that is cut out around a spot, and the displacement under unit pressure on it; `None` where there is
    /// nothing outside, or the lattice.
    fn far(&self, rule: CircleRadius, radius: f64) -> Option<(FarField<'_>, Vec<f64>)> {
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

    /// d(p̄D)/dP_c under the spot m, D = `under` there: the disc's rim moves with the load inside (∂D/∂R = 2πR K(R)), p̄
    /// itself with the penetration prescribed.
    fn far_coupling(&self, load: Load, rule: CircleRadius, m: usize, c: usize, far: &FarField<'_>, under: f64) -> f64 {
        let share = match load {
            Load::MeanPressure(_) => 0.0,
            Load::Penetration(_) => 1.0 / self.system.cell().area(),
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

    /// How converged patterns stand to their meshes and neighbours.
    fn reached(&self, patterns: &Patterns, merged: &[bool]) -> Stop {
        let on_rim = |pressure: &Vec<f64>| (0..pressure.len()).any(|i| pressure[i] > 0.0 && self.mesh.on_rim(i));
        if merged.contains(&true) {
            Stop::Merged
        } else if patterns.pressures.iter().any(on_rim) {
            Stop::Rim
        } else {
            Stop::Converged
        }
    }

    /// Which spots' contacts reach where the surface of a neighbour is nearer than that of their own indenter, and which
    /// neighbours are reached.
    fn merged(&self, patterns: &Patterns) -> Vec<bool> {
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

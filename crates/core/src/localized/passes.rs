//! Passes over the levels: the contact of every spot with its circle, one penetration, one load (paper, §2.3).
//!
//! Each pass presses every spot to the present penetration δ against the displacement by the other levels inside its
//! circle, each with its pressures of the last pass, and by p̄, or by the lattice, outside it. Then the levels exchange loads
//! (`exchange.rs`) so that all have one penetration and carry p̄ together, Eq. (5). Only the shapes of the pressures lag one
//! pass behind, so that some eight passes are enough however many indenters are in the circle. A level comes into contact
//! when a pass finds it penetrated, and leaves it when its load would be tensile.
//!
//! A penetration beyond complete contact has no solution (`press.rs`), and a Newton step of the exchange may lead there. Under
//! a prescribed load the penetration therefore starts with a few elements and at most doubles from pass to pass. A pass beyond
//! complete contact is undone, and the next one bisects the way from the last penetration that had a solution. The work is
//! bounded by passes and by iterations.

use super::circle::CircleRadius;
use super::coupled::Coupled;
use super::exchange::LoadExchange;
use super::patterns::Patterns;
use super::press::{SpotEnd, press, punch};
use super::solution::{Solution, Stop};
use super::spot::Spot;
use super::tables::InfluenceTables;
use crate::load::{Control, Load};
use crate::numeric::array::field;
use std::sync::Arc;

/// Largest number of passes.
const MAX_PASSES: usize = 60;
/// Largest number of iterations on one spot, over all passes.
const MAX_ITERATIONS: usize = 2000;
/// Number of successive passes beyond complete contact after which a prescribed penetration counts as out of reach.
const MAX_BEYOND: usize = 3;
/// Least first penetration, over the depth at which one element would carry the prescribed load.
const MIN_FIRST_DEPTH: f64 = 1e-3;
/// Tolerance of the loads, relative to the whole load.
const LOAD_TOLERANCE: f64 = 1e-8;
/// Tolerance of the gap in contact, relative to the largest displacement.
const GAP_TOLERANCE: f64 = 1e-9;
/// Relative tolerance of the contact stiffness.
const STIFFNESS_TOLERANCE: f64 = 1e-4;

/// The iteration of one load step.
struct Passes<'a> {
    coupled: &'a Coupled,
    tables: &'a InfluenceTables,
    load: Control,
    rule: CircleRadius,
    patterns: Patterns,
    /// Gap over each element of each spot, lengths; empty before the first pass.
    gaps: Vec<Vec<f64>>,
    /// Pressures on each spot per unit of penetration of its contact alone.
    punches: Vec<Vec<f64>>,
    /// Radii of the circles, lengths.
    radii: Vec<f64>,
    mean_pressure: f64,
    /// Patterns and gaps of the last pass below complete contact.
    accepted: (Patterns, Vec<Vec<f64>>),
    /// Penetration of the accepted patterns where the last pass was undone.
    undone: Option<f64>,
    /// Penetration by which the first contact is sought, a length.
    first_depth: f64,
    /// Iterations on all spots so far.
    iterations: usize,
    /// Successive passes beyond complete contact under a prescribed penetration.
    beyond: usize,
}

/// How the spots of one pass ended.
#[derive(Clone, Copy)]
struct PassEnd {
    /// Whether the gap vanishes in all contacts.
    met: bool,
    /// Whether a spot is pressed beyond complete contact.
    unbounded: bool,
}

impl Coupled {
    /// Solves one load step, from an earlier solution where there is one.
    pub fn solve(&self, load: Load, rule: CircleRadius, start: Option<&Solution>) -> Solution {
        let mut iteration = Passes::new(self, load.on(self.system.cell()), rule, start);
        let (mut stop, mut merged, mut passes) = (Stop::Stalled, vec![false; self.circles.len()], 0);
        while passes < MAX_PASSES && iteration.has_work_left() {
            passes += 1;
            let (exchange, end) = iteration.press_spots();
            if iteration.is_undone(end) {
                continue;
            }
            iteration.accept(&exchange);
            if end.met && iteration.is_balanced(&exchange) {
                merged = self.merged(&iteration.patterns);
                stop = self.reached(&iteration.patterns, &merged);
                break;
            }
            iteration.exchange_loads(&exchange);
        }
        iteration.into_solution(stop, &merged, passes)
    }
}

impl<'a> Passes<'a> {
    /// Patterns of the `start`, without contact where there is none.
    fn new(coupled: &'a Coupled, load: Control, rule: CircleRadius, start: Option<&Solution>) -> Self {
        let (mesh, count, tables) = (coupled.mesh, coupled.circles.len(), coupled.tables(rule));
        let mut patterns = Patterns::new(mesh, count, start);
        let mut first_depth = coupled.first_depth();
        match load {
            Control::Penetration(penetration) => patterns.penetration = penetration,
            Control::MeanPressure(pressure) => {
                let (cell, element) = (coupled.system.cell().area(), mesh.size * mesh.size);
                let by_one_element = pressure * cell / element * tables.on_itself(0).diagonal();
                first_depth = first_depth.max(MIN_FIRST_DEPTH * by_one_element);
            }
        }
        let gaps = vec![Vec::new(); count];
        Self {
            coupled,
            tables,
            load,
            rule,
            patterns,
            // Without penetration no spot has contact.
            accepted: (Patterns::new(mesh, count, None), gaps.clone()),
            gaps,
            punches: vec![vec![0.0; mesh.elements()]; count],
            radii: vec![f64::INFINITY; count],
            mean_pressure: 0.0,
            undone: None,
            first_depth,
            iterations: 0,
            beyond: 0,
        }
    }

    fn has_work_left(&self) -> bool {
        self.iterations < MAX_ITERATIONS * self.coupled.circles.len() && self.beyond < MAX_BEYOND
    }

    /// Whole load on the cell, a force, under a prescribed mean pressure.
    fn prescribed(&self) -> Option<f64> {
        match self.load {
            Control::MeanPressure(pressure) => Some(pressure * self.coupled.system.cell().area()),
            Control::Penetration(_) => None,
        }
    }

    /// Presses every spot once.
    fn press_spots(&mut self) -> (LoadExchange, PassEnd) {
        self.mean_pressure = match self.load {
            Control::MeanPressure(pressure) => pressure,
            Control::Penetration(_) => self.patterns.loads.iter().sum::<f64>() / self.coupled.system.cell().area(),
        };
        let mut exchange = LoadExchange::new(self.patterns.loads.clone());
        let mut end = PassEnd { met: true, unbounded: false };
        for m in 0..self.coupled.circles.len() {
            let spot = self.press_spot(m, &mut exchange);
            end.met &= spot == SpotEnd::Met;
            end.unbounded |= spot == SpotEnd::Unbounded;
        }
        (exchange, end)
    }

    /// Presses the spot m against the displacement by all others; its load, stiffness and couplings enter the exchange.
    fn press_spot(&mut self, m: usize, exchange: &mut LoadExchange) -> SpotEnd {
        let coupled = self.coupled;
        let (tables, mesh) = (self.tables, coupled.mesh);
        let others = coupled.others(tables, m, &self.patterns);
        self.radii[m] = coupled.radius(m, self.rule, self.mean_pressure, &exchange.assumed);
        let far = coupled.far_field(self.rule, self.radii[m]);
        let wanted: Vec<f64> = (0..mesh.elements())
            .map(|i| {
                let moved: f64 = others.iter().flatten().map(|other| other[i]).sum();
                let outside = far.as_ref().map_or(0.0, |(_, under)| self.mean_pressure * under[i]);
                self.patterns.penetration - coupled.shapes[m][i] - moved + outside
            })
            .collect();
        let (influence, element) = (tables.on_itself(m), mesh.size * mesh.size);
        let spot = press(influence, &wanted, GAP_TOLERANCE, &mut self.patterns.pressures[m]);
        self.gaps[m] = spot.gap;
        self.iterations += spot.iterations;
        exchange.found[m] = self.patterns.pressures[m].iter().sum::<f64>() * element;
        if exchange.found[m] == 0.0 {
            return spot.end;
        }
        let last = std::mem::take(&mut self.punches[m]);
        self.punches[m] = punch(influence, &self.patterns.pressures[m], STIFFNESS_TOLERANCE, last);
        let punch = &self.punches[m];
        let sum: f64 = punch.iter().sum();
        exchange.stiffness[m] = sum * element;
        let under = |field: &[f64]| punch.iter().zip(field).map(|(s, u)| s * u).sum::<f64>() / sum;
        for c in 0..others.len() {
            // A level without pressures acts from its axes.
            let direct = match &others[c] {
                Some(displacement) => under(displacement) / exchange.assumed[c],
                None if c == m => 0.0,
                None => tables.between_axes(m, c),
            };
            let outside =
                far.as_ref().map_or(0.0, |(far, d)| coupled.far_coupling(self.load, self.rule, m, c, far, under(d)));
            exchange.coupling[m][c] = direct - outside;
        }
        spot.end
    }

    /// Whether the pass went beyond complete contact and was undone. Only a prescribed penetration can lie there; every mean
    /// pressure has a solution.
    fn is_undone(&mut self, end: PassEnd) -> bool {
        self.beyond = if end.unbounded && !self.load.is_mean_pressure() { self.beyond + 1 } else { 0 };
        if !(end.unbounded && self.load.is_mean_pressure()) {
            return false;
        }
        let depth = 0.5 * (self.accepted.0.penetration + self.patterns.penetration);
        (self.patterns, self.gaps) = self.accepted.clone();
        self.undone = Some(self.patterns.penetration);
        self.patterns.penetration = depth;
        true
    }

    /// Keeps what the pass found.
    fn accept(&mut self, exchange: &LoadExchange) {
        self.undone = None;
        self.accepted = (Patterns { loads: exchange.found.clone(), ..self.patterns.clone() }, self.gaps.clone());
    }

    /// Whether the loads found are those assumed, and add to the whole load.
    fn is_balanced(&self, exchange: &LoadExchange) -> bool {
        let whole = self.prescribed().unwrap_or(exchange.whole());
        exchange.imbalance(whole) <= LOAD_TOLERANCE * whole
    }

    /// Loads and penetration of the next pass.
    fn exchange_loads(&mut self, exchange: &LoadExchange) {
        let prescribed = self.prescribed();
        // A small contact is soft: the penetration at most doubles.
        let most = self.patterns.penetration.abs() + self.first_depth;
        if prescribed.is_some() && exchange.whole() == 0.0 {
            self.patterns.penetration += most;
            return;
        }
        let (mut loads, mut rise) = exchange.new_loads(prescribed);
        if rise > most {
            for (load, found) in loads.iter_mut().zip(&exchange.found) {
                *load = found + most / rise * (*load - found);
            }
            rise = most;
        }
        self.patterns.penetration += rise;
        for (m, &found) in exchange.found.iter().enumerate() {
            let factor = if found > 0.0 { loads[m] / found } else { 0.0 };
            self.patterns.scale(m, factor, loads[m]);
        }
    }

    fn into_solution(self, stop: Stop, merged: &[bool], passes: usize) -> Solution {
        let Self { coupled, patterns, gaps, radii, .. } = self;
        let Coupled { system, mesh, circles, .. } = coupled;
        let spots = patterns.pressures.into_iter().zip(gaps).enumerate().map(|(m, (pressure, gap))| Spot {
            level: system.sites()[m].level,
            place: system.sites()[m].place,
            mesh: *mesh,
            pressure: field([mesh.width; 2], pressure),
            gap: field([mesh.width; 2], gap),
            circle: circles[m].clone(),
            radius: radii[m],
            merged: merged[m],
            edge: Arc::clone(system.edge()),
        });
        Solution {
            spots: spots.collect(),
            system: Arc::clone(system),
            mean_pressure: self.mean_pressure,
            penetration: self.undone.unwrap_or(patterns.penetration),
            rule: self.rule,
            stop,
            passes,
        }
    }
}

//! A life of cycles in which points stay in place: both surfaces wear by local slip, and cracks begin at the worst places.
//!
//! A pass is the closed cycle of tangential forces or shifts with which the history ends. In it a sample slips by S = Σ|Δ(**d** − **u**)| over
//! the steps, **d** the shift and **u** the tangential displacement, also just beside the contact. By Archard's law both surfaces wear in place,
//!
//! ∂h/∂N = (k_b + k_c) S p,
//!
//! which opens the gap. The pressure p of the worn surfaces follows at once and levels waves fast: a step ΔN with S as it is at its start is taken in
//! stages of Runge–Kutta–Chebyshev, each with its contact. The cycle is followed once more on the surfaces at the end of the step, and the
//! depth corrected to the mean of both S. Error of the step: that correction and the estimate of the stages, over the volume that it wears off or
//! a tenth of all. Slip and pressure of a sample are multiplied though the pressure may change within a cycle of bodies that couple.
//!
//! Layers are as thick as they are where the surface is worn deepest. Damage of a part is the sum of that at its worst place in each state, by
//! rates halfway between states: no point has more. Where a sum reaches 1 a crack begins; nothing comes off, and the bodies stay whole.

use super::beginning::Beginning;
use super::event::{Event, EventKind};
use super::state::{LifeEnd, LifeState, PartDamage};
use super::task::{LifeError, LifeTask};
use crate::body::Side;
use crate::friction::Friction;
use crate::numeric::runge_kutta_chebyshev as stabilised;
use crate::numeric::search::largest;
use crate::problem::Problem;
use crate::reading::{FatiguePart, Life, Pass, PathReading, SlipReading};
use crate::run::{StepRecord, cycle_of, next_length};
use crate::spectral::{SlipSettings, SlipSolver, Solver, Step, Stop, Wear};
use crate::stress::{PathSought, StressFields};
use ndarray::Array2;
use std::f64::consts::PI;
use std::sync::Arc;

/// Most loads solved, and most tries of a step.
const MAX_LOADS: usize = 1000;
const MAX_TRIES: usize = 12;
/// Most stages of a step.
const STAGES: usize = 150;
/// Part of a failure's passes from which on it has come.
const FAILED: f64 = 1e-4;
/// Depth of the first step that is tried over the penetration.
const FIRST: f64 = 0.02;
/// Slip where contact comes to over the largest within it.
const BESIDE: f64 = 1.3;
/// Part of all volume worn by which the error of a step is measured at least.
const OF_ALL: f64 = 0.1;

/// A cycle that was followed.
#[derive(Debug)]
struct Cycle {
    /// Steps of the cycle, or the last one alone, which closes it.
    steps: Vec<Step>,
    record: StepRecord,
    /// S, lengths sample by sample.
    slid: Vec<f64>,
}

/// A step of wear that is accepted.
struct Worn {
    /// Depth h of both surfaces together, lengths sample by sample.
    depth: Vec<f64>,
    cycles: f64,
    next: f64,
}

impl LifeTask {
    /// Number of the last steps of the history that make a cycle; `None` where it does not come back to where it was.
    pub(super) fn cycle_length(&self) -> Option<usize> {
        cycle_of(self.motions.as_deref()?, &[])
    }

    /// The contact of unworn surfaces on a grid, after its first cycles, with what a cycle does.
    pub(super) fn begun_in_place(
        &self,
        points: [usize; 2],
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Beginning, LifeError> {
        let slip = SlipSettings::default();
        let mut solver = SlipSolver::new(Arc::clone(&self.problem), points, self.settings, slip)?;
        let tires = self.problem.bodies().tire();
        self.begun(self.follow(&mut solver, tires, goes_on)?, goes_on)
    }

    /// The contact at the end of a cycle, with the lives of what tires in it.
    fn begun(&self, cycle: Cycle, goes_on: &dyn Fn() -> bool) -> Result<Beginning, LifeError> {
        let Cycle { mut steps, record, slid } = cycle;
        let step = steps.pop().ok_or(LifeError::NoCycle)?;
        let bodies = step.problem().bodies();
        let found = if record.reading.touches() && bodies.tire() && record.converged() {
            let fields = StressFields::new(step.finest(), self.mean);
            let sought = PathSought { fatigue: true, endurance: false, map: false };
            let pass = Pass { moments: &steps, ..Pass::default() };
            PathReading::of_pass(&step, &record.reading, &fields, (sought, &pass), goes_on)
                .ok_or(LifeError::Interrupted)?
        } else {
            PathReading::default()
        };
        let record = StepRecord { fatigue: found.fatigue, ..record };
        Ok(Beginning { step, back: None, record, planes: Vec::new(), slid, change: None, end: None })
    }

    /// Follows the history from the first contact on, and keeps all steps of its cycle or the last one alone.
    fn follow(&self, solver: &mut SlipSolver, keeps: bool, goes_on: &dyn Fn() -> bool) -> Result<Cycle, LifeError> {
        let motions = self.motions.as_deref().unwrap_or_default();
        let length = self.cycle_length().ok_or(LifeError::NoCycle)?;
        let direction = self.problem.friction().map_or([1.0, 0.0], Friction::direction);
        solver.begin_anew();
        let (mut steps, mut record, mut stop) = (Vec::new(), None, None);
        let (mut slid, mut before) = (Vec::new(), Vec::new());
        for (number, motion) in (1..).zip(motions) {
            if !goes_on() {
                return Err(LifeError::Interrupted);
            }
            let step = motion.step(solver, self.load)?;
            stop = stop.or(Some(step.contact.report.stop).filter(|stop| !stop.solved()));
            stop = stop.or((!step.converged).then_some(Stop::IterationLimit));
            let sheared = solver.sheared();
            if number > motions.len() - length {
                let reading = step.contact.reading();
                record = Some(StepRecord::new(&step.contact, reading).with_slip(SlipReading::of(&step, direction)));
                slid.resize(sheared.len(), 0.0);
                add_slip(&mut slid, &step.contact, &before, &sheared);
                if !keeps {
                    steps.clear();
                }
                steps.push(step.contact);
            }
            before = sheared;
        }
        let record = record.ok_or(LifeError::NoCycle)?;
        if let (Some(stop), Some(last)) = (stop, steps.last_mut()) {
            last.report.stop = stop;
        }
        Ok(Cycle { steps, record: StepRecord { stop: stop.unwrap_or(record.stop), ..record }, slid })
    }

    /// The next state of a life in place, as [`Self::advance`].
    pub(super) fn advance_in_place(
        &self,
        state: LifeState,
        begun: &Beginning,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<LifeState, LifeError> {
        let Some((body, gone)) = self.problem.half_space().uncovered(state.removed()) else {
            return Ok(self.ended(state, LifeEnd::NothingLeft));
        };
        let problem = Arc::new(self.problem_of(&state, body));
        let wear = Wear::of(&problem);
        let k: f64 = [Side::Body, Side::Counterbody].map(|side| wear.coefficient(side)).iter().sum();
        let wears = self.passes.is_some() && k > 0.0;
        let worn = || -> Result<Beginning, LifeError> {
            let gap = self.worn_gap(&problem, &state)?;
            let mut solver = self.on_gap(&problem, opened(&gap, &[]))?;
            self.begun(self.follow(&mut solver, self.problem.bodies().tire(), goes_on)?, goes_on)
        };
        let contact = match (state.solved, wears) {
            (0, false) => begun.clone(),
            // The slip of all states in parts alike, so that their difference is that of the surfaces.
            (0, true) => Beginning { slid: worn()?.slid, ..begun.clone() },
            _ => worn()?,
        };
        let mut next = LifeState { solved: state.solved + 1, ..state };
        let stop = contact.step.report.stop;
        if !stop.solved() {
            return Ok(self.without_contact(next, stop));
        }
        let rates = self.rates_in_place(&contact, gone);
        let pending = std::mem::take(&mut next.pending);
        self.crack(&mut next, &rates, pending);
        let left = next.next_crack(&rates);
        self.record(&mut next, &contact, left);
        let last = self.passes.unwrap_or(f64::INFINITY);
        if next.passes >= last {
            return Ok(LifeState { end: Some(LifeEnd::Passes), ..next });
        }
        if next.solved >= MAX_LOADS {
            return Ok(LifeState { end: Some(LifeEnd::LoadLimit), ..next });
        }
        let slips = contact.slid.iter().zip(contact.step.finest().pressures()).any(|(slid, p)| slid * p > 0.0);
        if !(wears && slips) {
            return Ok(self.unworn_to_the_end(next, &rates, &contact));
        }
        self.wear_in_place(next, (&problem, &wear), (&contact, &rates, gone), goes_on)
    }

    /// The last state of surfaces that stay as they are: cracks until the passes are done, or the first one.
    fn unworn_to_the_end(&self, mut state: LifeState, rates: &[PartDamage], contact: &Beginning) -> LifeState {
        loop {
            let left = self.passes.map_or(f64::INFINITY, |last| last - state.passes);
            let crack = state.next_crack(rates);
            if crack > left {
                self.crack(&mut state, rates, left);
                state.passes += left;
                let next = state.next_crack(rates);
                self.record(&mut state, contact, next);
                return LifeState { end: Some(LifeEnd::Passes), ..state };
            }
            if !crack.is_finite() {
                return LifeState { end: Some(LifeEnd::Endless), ..state };
            }
            state.passes += crack;
            self.crack(&mut state, rates, crack);
            if self.passes.is_none() {
                return LifeState { end: Some(LifeEnd::Passes), ..state };
            }
        }
    }

    /// The state after a step of wear.
    fn wear_in_place(
        &self,
        mut state: LifeState,
        (problem, wear): (&Arc<Problem>, &Wear),
        (contact, rates, gone): (&Beginning, &[PartDamage], usize),
        goes_on: &dyn Fn() -> bool,
    ) -> Result<LifeState, LifeError> {
        let [body, counterbody] = [Side::Body, Side::Counterbody].map(|side| wear.coefficient(side));
        let k = body + counterbody;
        let pressure = contact.step.finest().pressures();
        let rates_of = || contact.slid.iter().zip(pressure).map(|(slid, p)| slid * p);
        let last = self.passes.unwrap_or(f64::INFINITY) - state.passes;
        // Until a place is worn deeper than the deepest one so far by this room.
        let deepest = state.largest_worn(Side::Body) + self.room(&state, gone);
        let until = rates_of().enumerate().map(|(i, rate)| {
            let worn = state.worn[0].get(i).copied().unwrap_or(0.0);
            if rate > 0.0 { (deepest - worn) / (body * rate) } else { f64::INFINITY }
        });
        let most = until.fold(last.min(state.next_crack(rates)), f64::min);
        let first = FIRST * contact.record.reading.penetration.abs() / (k * largest(rates_of()));
        // A flat surface has no penetration to begin with.
        let first = if first > 0.0 { first } else { most };
        let tried = if state.step > 0.0 { state.step } else { first };
        let found = self.worn_by(&state, (problem, k), contact, [tried, most], goes_on)?;
        let Worn { depth, cycles, next } = match found {
            Ok(worn) => worn,
            Err(stop) => return Ok(self.without_contact(state, stop)),
        };
        let removed = state.removed();
        for (side, part) in [body / k, counterbody / k].into_iter().enumerate() {
            if part > 0.0 {
                let depths = &mut state.worn[side];
                depths.resize(depth.len(), 0.0);
                depths.iter_mut().zip(&depth).for_each(|(sum, depth)| *sum += part * depth);
            }
        }
        state.lowered = state.largest_worn(Side::Body);
        // The last step ends with the passes, not by rounding beside them.
        state.passes = if cycles >= last { state.passes + last } else { state.passes + cycles };
        state.step = next;
        self.worn_through(&mut state, removed);
        state.pending = 0.5 * cycles;
        self.crack(&mut state, rates, 0.5 * cycles);
        Ok(state)
    }

    /// A step of wear from a state whose contact is known, `tried` passes long or shorter, and no longer than `most`.
    fn worn_by(
        &self,
        state: &LifeState,
        (problem, k): (&Arc<Problem>, f64),
        contact: &Beginning,
        [tried, most]: [f64; 2],
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Result<Worn, Stop>, LifeError> {
        let slid = &contact.slid;
        let normal = problem.at_rest().without_hardness();
        let mut solver = Solver::new(normal, state.points, self.settings)?;
        // Beside the contact, where it comes to, surfaces slip a little further.
        let touched = slid.iter().zip(contact.step.finest().pressures()).filter(|(_, p)| **p > 0.0);
        let fast = k * BESIDE * largest(touched.map(|(slid, _)| *slid)) / least_compliance(problem, state.points);
        let before: f64 = state.worn.iter().flatten().sum();
        let gap = self.worn_gap(problem, state)?;
        let longest = most.min(stabilised::largest(STAGES) / fast);
        let mut cycles = tried.min(longest);
        let still = vec![0.0; slid.len()];
        let (mut stopped, mut pressures) = (None, Vec::new());
        for attempt in 0..MAX_TRIES {
            if !goes_on() {
                return Err(LifeError::Interrupted);
            }
            let mut rate = |rise: &[f64]| -> Result<Vec<f64>, LifeError> {
                solver.set_gap(opened(&gap, rise))?;
                let step = solver.solve(self.load);
                stopped = stopped.or(Some(step.report.stop).filter(|stop| !stop.solved()));
                pressures = step.finest().pressures().to_vec();
                Ok(slid.iter().zip(&pressures).map(|(slid, p)| k * slid * p).collect())
            };
            let start = rate(&still)?;
            let step = stabilised::step(&start, cycles, stabilised::stages(cycles * fast), &mut rate)?;
            if let Some(stop) = stopped.take() {
                return Ok(Err(stop));
            }
            // Waves of the stages wear nothing back.
            let rise: Vec<f64> = step.rise.iter().map(|rise| rise.max(0.0)).collect();
            let after = self.follow(&mut self.on_gap(problem, opened(&gap, &rise))?, false, goes_on)?;
            if !after.record.converged() {
                return Ok(Err(after.record.stop));
            }
            let corrected = |i: usize| {
                let change = 0.5 * (after.slid[i] - slid[i]);
                // A sample that begins to slip in the step wears by the pressure at the end of the step.
                if slid[i] > 0.0 { rise[i] * (1.0 + change / slid[i]) } else { cycles * k * change * pressures[i] }
            };
            let depth: Vec<f64> = (0..rise.len()).map(|i| corrected(i).max(0.0)).collect();
            // By volume: where a sample begins to slip its own depth is known no better in a shorter step.
            let worn: f64 = depth.iter().sum();
            let error: f64 = (0..rise.len()).map(|i| (depth[i] - rise[i]).abs() + step.error[i]).sum();
            let excess = if error > 0.0 { error / (self.tolerance * worn.max(OF_ALL * (before + worn))) } else { 0.0 };
            let next = cycles * next_length(excess);
            if excess <= 1.0 || cycles <= f64::MIN_POSITIVE {
                // A step that was cut short at first says nothing against the length that was to be tried.
                let next = if attempt == 0 && cycles < tried { next.max(tried) } else { next };
                return Ok(Ok(Worn { depth, cycles, next }));
            }
            cycles = next.min(longest);
        }
        Ok(Err(Stop::IterationLimit))
    }

    /// The gap of the surfaces of a state, lengths.
    fn worn_gap(&self, problem: &Problem, state: &LifeState) -> Result<Array2<f64>, LifeError> {
        let gap = problem.loaded_by().surface(state.points)?.initial_gap().to_owned();
        Ok(state.worn.iter().fold(gap, |gap, depths| opened(&gap, depths)))
    }

    /// A solver for the cycle of surfaces with a gap.
    fn on_gap(&self, problem: &Arc<Problem>, gap: Array2<f64>) -> Result<SlipSolver, LifeError> {
        Ok(SlipSolver::on_gap(Arc::clone(problem), gap, self.settings, SlipSettings::default())?)
    }

    /// Damage in a cycle at the worst place of each part of the body, of whose original `gone` layers have come off.
    fn rates_in_place(&self, contact: &Beginning, gone: usize) -> Vec<PartDamage> {
        let original = self.problem.half_space();
        let lives = contact.record.fatigue.iter().flat_map(|fatigue| &fatigue.lives);
        let of = |life: &Life| {
            let part = match life.part {
                FatiguePart::Material(id) => FatiguePart::Material(original.material_id(id.number + gone)),
                FatiguePart::Interface(id) => FatiguePart::Interface(original.interface_id(id.number + gone)),
                FatiguePart::Strained(_) => return None,
            };
            (life.part.is_followed() && life.damage > 0.0).then_some(PartDamage { part, damage: life.damage })
        };
        lives.filter_map(of).collect()
    }

    /// Adds damage of some passes at these rates. A part whose damage reaches 1 has a crack, once.
    fn crack(&self, state: &mut LifeState, rates: &[PartDamage], passes: f64) {
        for rate in rates {
            let known = state.in_place.iter().position(|damage| damage.part == rate.part);
            let index = known.unwrap_or(state.in_place.len());
            if known.is_none() {
                state.in_place.push(PartDamage { damage: 0.0, ..*rate });
            }
            let damage = &mut state.in_place[index].damage;
            let was_whole = *damage < 1.0 - FAILED;
            // Under a tip the first cycle fails.
            *damage += if rate.damage.is_infinite() { rate.damage } else { rate.damage * passes };
            if was_whole && *damage >= 1.0 - FAILED {
                let removed = state.removed();
                state.events.push(Event {
                    passes: state.passes,
                    distance: None,
                    what: EventKind::Crack,
                    part: rate.part,
                    depth: 0.0,
                    thickness: self.thickness(removed),
                    removed,
                });
            }
        }
    }
}

impl LifeState {
    /// Passes until the damage of a part that is whole reaches 1 at these rates; infinite where none ever does.
    fn next_crack(&self, rates: &[PartDamage]) -> f64 {
        let left = |rate: &PartDamage| {
            let so_far = self.in_place.iter().find(|damage| damage.part == rate.part).map_or(0.0, |part| part.damage);
            if so_far >= 1.0 - FAILED { f64::INFINITY } else { (1.0 - so_far) / rate.damage }
        };
        rates.iter().map(left).fold(f64::INFINITY, f64::min)
    }
}

/// A gap that is opened by further depths, lengths sample by sample, or by none; its least is 0, so that it counts from first touch.
fn opened(gap: &Array2<f64>, depths: &[f64]) -> Array2<f64> {
    let mut opened = gap.clone();
    opened.iter_mut().zip(depths).for_each(|(gap, depth)| *gap += depth);
    let least = opened.iter().copied().fold(f64::INFINITY, f64::min);
    opened.mapv_inplace(|gap| gap - least);
    opened
}

/// Adds the way of a step, by which surfaces are sheared from `before` to `after`, where they do not stick.
fn add_slip(slid: &mut [f64], contact: &Step, before: &[[f64; 2]], after: &[[f64; 2]]) {
    let (pressures, shear) = (contact.finest().pressures(), contact.finest().shear());
    for (i, slid) in slid.iter_mut().enumerate() {
        let sticks = pressures[i] > 0.0 && shear.is_some_and(|shear| shear.sticks(i, pressures[i]));
        if !sticks {
            *slid += (after[i][0] - before[i][0]).hypot(after[i][1] - before[i][1]);
        }
    }
}

/// Least compliance of any wave on a grid, a length per pressure: that of the shortest.
fn least_compliance(problem: &Problem, points: [usize; 2]) -> f64 {
    let [a1, a2] = problem.cell().vectors();
    let side = |a: [f64; 2]| a[0].hypot(a[1]);
    // Reciprocal vectors are as long as 2π times the other side over the area.
    let wave = |n: usize, other: [f64; 2]| n as f64 * PI * side(other) / problem.cell().area();
    problem.bodies().compliance(wave(points[0], a2) + wave(points[1], a1))
}

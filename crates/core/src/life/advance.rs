//! Steps of a life from one state to the next: what fails comes off, and what slides wears.

use super::beginning::Beginning;
use super::damage::{Damage, Failure, FailurePlace};
use super::event::{Event, EventKind};
use super::groove::{Groove, MeanPressure};
use super::rates::Rates;
use super::state::{LifeEnd, LifeState};
use super::task::{LifeError, LifeTask};
use super::worn_path::WornSince;
use crate::body::Side;
use crate::problem::Problem;
use crate::reading::{FatiguePart, contact_radii};
use crate::run::{PathEnd, WearPath};
use crate::spectral::{Solver, Step, Stop, Wear};
use ndarray::Axis;
use std::sync::Arc;

/// Part of the thickness that the first layer had at first, which is gone when the half-space is laid out anew.
const RELAID: f64 = 0.05;
/// Relative change of the largest pressure in a step of wear.
const IN_STEP: f64 = 0.04;
/// Distance over all so far that is slid on at most for the mean over a row of samples.
const ROW: f64 = 10.0;
/// Part of the passes so far within which a failure is due at once: damage while surfaces wear is known no better.
const NOW: f64 = 1e-4;
/// Most failures from one solution of the contact to the next.
const MAX_FAILURES: usize = 10_000;
/// Most loads solved.
const MAX_LOADS: usize = 2000;

impl LifeTask {
    /// The state before the first pass.
    pub fn unworn(&self, beginning: &Beginning) -> LifeState {
        let radii = contact_radii(&beginning.step, &beginning.record.reading);
        LifeState {
            passes: 0.0,
            points: beginning.step.grid().points(),
            detached: 0.0,
            lowered: 0.0,
            damage: Damage::none(self.problem.half_space(), radii, &beginning.planes),
            in_place: Vec::new(),
            worn: [Vec::new(), Vec::new()],
            indented: Vec::new(),
            step: 0.0,
            pending: 0.0,
            sheds: false,
            solved: 0,
            events: Vec::new(),
            course: Vec::new(),
            doubled: 0,
            end: None,
            stop: None,
        }
    }

    /// The next state after `begun`, the contact before the first pass: the contact of the surfaces as they are is solved, and damage and
    /// wear go on until something comes off, the pressure has changed, or the passes are done. A state that has ended stays.
    ///
    /// # Errors
    /// [`LifeError`].
    pub fn advance(
        &self,
        state: LifeState,
        begun: &Beginning,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<LifeState, LifeError> {
        if state.end.is_some() {
            return Ok(state);
        }
        if self.motions.is_some() {
            return self.advance_in_place(state, begun, goes_on);
        }
        let Some((body, gone)) = self.problem.half_space().uncovered(state.removed()) else {
            return Ok(self.ended(state, LifeEnd::NothingLeft));
        };
        let mut solver = self.worn_solver(&Arc::new(self.problem_of(&state, body)), &state)?;
        // The unworn contact is solved already.
        let contact = match state.solved {
            0 => begun.clone(),
            _ => self.contact(&mut solver, goes_on)?,
        };
        let next = LifeState { solved: state.solved + 1, ..state };
        let stop = contact.step.report.stop;
        if !stop.solved() {
            return Ok(self.without_contact(next, stop));
        }
        self.age(next, &mut solver, (&contact, gone), goes_on)
    }

    /// The state that damage and wear make of `next` under a solved contact; `gone` layers of the original body have come off.
    fn age(
        &self,
        mut next: LifeState,
        solver: &mut Solver,
        (contact, gone): (&Beginning, usize),
        goes_on: &dyn Fn() -> bool,
    ) -> Result<LifeState, LifeError> {
        let original = self.problem.half_space();
        if next.doubled > 0 {
            next.damage.widen(&contact.planes);
        }
        let reading = contact.record.fatigue.as_ref();
        let rates = Rates::new(original, gone, &contact.planes, reading, next.damage.y());
        let pending = std::mem::take(&mut next.pending);
        next.damage.add(&rates, pending, next.removed());
        let failure = self.next_failure(&next, &rates);
        self.record(&mut next, contact, failure);
        let last = self.passes.unwrap_or(f64::INFINITY);
        if next.passes >= last {
            return Ok(LifeState { end: Some(LifeEnd::Passes), ..next });
        }
        if next.solved >= MAX_LOADS {
            return Ok(LifeState { end: Some(LifeEnd::LoadLimit), ..next });
        }
        let room = self.room(&next, gone);
        let wear = self.wear(solver.problem())?;
        let wears = [Side::Body, Side::Counterbody].iter().any(|&side| wear.coefficient(side) > 0.0);
        let (before, begun) = (next.removed(), next.passes);
        let mut mean = None;
        let until = if wears && self.passes.is_some() {
            mean = self.wear_on(&mut next, solver, (&wear, room), (&rates, contact), goes_on)?;
            next.passes
        } else {
            keep_indented(&mut next, &contact.step);
            last
        };
        let rates = match mean {
            Some(MeanPressure { pressure, back, swing }) => {
                let back = contact.back.as_ref().zip(back).map(|(step, back)| step.with_mean_pressure(back));
                let over = self.read(contact.step.with_mean_pressure(pressure), back, goes_on)?;
                let rates = Rates::new(original, gone, &over.planes, over.record.fatigue.as_ref(), next.damage.y());
                next.damage.add(&rates, next.passes - begun, before);
                next.bears(&over, swing);
                rates
            }
            None => rates,
        };
        self.tire(&mut next, &rates, contact, until, room);
        if let Some(stop) = next.stop {
            return Ok(self.without_contact(next, stop));
        }
        // Surfaces that stay as they are have this contact to the end.
        if next.end.is_none() && next.passes >= last && next.removed() == before && next.pending == 0.0 {
            let failure = self.next_failure(&next, &rates);
            self.record(&mut next, contact, failure);
            next.end = Some(LifeEnd::Passes);
        }
        Ok(next)
    }

    /// Height that may still wear off a state whose `gone` layers have come off, a length, until the half-space is laid out anew or the first layer is
    /// worn through.
    pub(super) fn room(&self, state: &LifeState, gone: usize) -> f64 {
        let original = self.problem.half_space();
        let left = original.interface_depths().get(gone).map_or(f64::INFINITY, |face| face - state.removed());
        original.layers().get(gone).map_or(f64::INFINITY, |layer| (RELAID * layer.thickness()).min(left))
    }

    /// State after a contact that is not solved: in a wider window where it reaches the border, else at the end.
    pub(super) fn without_contact(&self, state: LifeState, stop: Stop) -> LifeState {
        let wider = if stop == Stop::AtBorder { self.in_wider_window(state.clone()) } else { None };
        match wider {
            Some(wider) => LifeState { stop: None, step: 0.0, ..wider },
            None => self.ended(LifeState { stop: Some(stop), ..state }, LifeEnd::Unsolved),
        }
    }

    /// Lets what fails come off, up to a number of passes, until more than a height `room` is gone.
    fn tire(&self, state: &mut LifeState, rates: &Rates, contact: &Beginning, until: f64, room: f64) {
        let original = self.problem.half_space();
        let begun = state.removed();
        for _ in 0..MAX_FAILURES {
            let removed = state.removed();
            let next = state.damage.next_failure(original, rates, removed);
            let next = self.exact_first(state, contact).or(next);
            let left = self.passes.map_or(f64::INFINITY, |last| last - state.passes);
            let due =
                next.filter(|failure| failure.passes <= (until - state.passes).max((NOW * state.passes).min(left)));
            let Some(failure) = due else {
                let passes = until - state.passes;
                if passes > 0.0 && passes.is_finite() {
                    state.damage.add(rates, passes, removed);
                    state.passes = until;
                } else if next.is_none() && until.is_infinite() {
                    let by_strain = self.first_by_strain(contact);
                    state.passes = by_strain.unwrap_or(state.passes);
                    state.end = Some(by_strain.map_or(LifeEnd::Endless, |_| LifeEnd::Passes));
                }
                return;
            };
            state.damage.add(rates, failure.passes, removed);
            state.passes += failure.passes;
            self.come_off(state, failure);
            if self.passes.is_none() {
                state.end = Some(LifeEnd::Passes);
                return;
            }
            if state.removed() - begun >= room || matches!(failure.place, FailurePlace::Interface(_)) {
                return;
            }
        }
    }

    /// Passes until a material of the unworn body first fails by its strain; `None` where none ever does.
    fn first_by_strain(&self, contact: &Beginning) -> Option<f64> {
        let lives = contact.record.fatigue.iter().flat_map(|fatigue| &fatigue.lives);
        let by_strain =
            lives.filter(|life| !life.part.is_counterbody() && matches!(life.part, FatiguePart::Strained(_)));
        by_strain.map(|life| life.passes).filter(|passes| passes.is_finite()).reduce(f64::min)
    }

    /// The first failure of the unworn body as its reading has it, refined between the planes.
    fn exact_first(&self, state: &LifeState, contact: &Beginning) -> Option<Failure> {
        let life = contact.record.fatigue.as_ref()?.lives.iter().filter(|life| life.part.is_followed());
        let first = life.min_by(|a, b| a.passes.total_cmp(&b.passes))?;
        let place = match first.part {
            FatiguePart::Strained(_) => return None,
            FatiguePart::Material(id) => FailurePlace::Material(id.number),
            FatiguePart::Interface(id) => FailurePlace::Interface(id.number),
        };
        let is_unworn = state.passes == 0.0 && state.events.is_empty() && first.passes.is_finite();
        is_unworn.then_some(Failure { place, passes: first.passes, depth: first.position[2] })
    }

    /// Takes off what lies above a failure.
    fn come_off(&self, state: &mut LifeState, failure: Failure) {
        let original = self.problem.half_space();
        let removed = state.removed();
        let (part, what, depth) = match failure.place {
            FailurePlace::Interface(number) => (
                FatiguePart::Interface(original.interface_id(number)),
                EventKind::Delamination,
                failure.depth - removed,
            ),
            FailurePlace::Material(number) => {
                let ([slice, thin], depth) = (state.damage.slice(failure.place, removed), failure.depth - removed);
                let what = if depth > thin { EventKind::Detachment } else { EventKind::SurfaceWear };
                (FatiguePart::Material(original.material_id(number)), what, depth.max(slice))
            }
        };
        state.detached += depth;
        let is_slice = what == EventKind::SurfaceWear;
        let after = state.removed();
        let thickness = self.thickness(after);
        // A failure just below what has just come off is part of it: damage is next to 1 about the depth that fails.
        let follows = |last: &&mut Event| {
            last.what == EventKind::Detachment && last.part == part && last.passes >= state.passes * (1.0 - NOW)
        };
        if let Some(last) = state.events.last_mut().filter(follows) {
            *last = Event { depth: last.depth + depth, thickness, removed: after, ..*last };
            if is_slice {
                self.worn_through(state, removed);
            }
            return;
        }
        // The first one of slices that follow each other is an event.
        if !(is_slice && state.sheds) {
            let (passes, distance) = (state.passes, self.slid_after(state.passes));
            state.events.push(Event { passes, distance, what, part, depth, thickness, removed: after });
        }
        state.sheds = is_slice;
        if is_slice {
            self.worn_through(state, removed);
        }
    }

    /// A solver for the surfaces of a state.
    fn worn_solver(&self, problem: &Arc<Problem>, state: &LifeState) -> Result<Solver, LifeError> {
        let solver = Solver::new(Arc::clone(problem), state.points, self.settings)?;
        let depths = [&state.worn[0], &state.worn[1], &state.indented];
        if depths.iter().all(|field| field.is_empty()) {
            return Ok(solver);
        }
        let mut gap = solver.surface().initial_gap().to_owned();
        for field in depths {
            gap.iter_mut().zip(field).for_each(|(gap, depth)| *gap += depth);
        }
        // The penetration counts from first touch.
        let least = gap.iter().copied().fold(f64::INFINITY, f64::min);
        gap.mapv_inplace(|gap| gap - least);
        Ok(solver.with_gap(gap)?)
    }

    /// Wears both surfaces on, until the pressure has changed, damage reaches 1, the body is lower by `room`, or for some steps. Where a
    /// groove widens in a body that tires, until it has taken in a row of samples: its mean pressure, of which the damage is to be added.
    fn wear_on(
        &self,
        state: &mut LifeState,
        solver: &mut Solver,
        (wear, room): (&Wear, f64),
        (rates, contact): (&Rates, &Beginning),
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Option<MeanPressure>, LifeError> {
        let (distance, removed) = (self.slid(), state.removed());
        let last = self.passes.unwrap_or(f64::INFINITY);
        let failure = state.damage.next_failure(self.problem.half_space(), rates, removed);
        let until = failure.map_or(last, |failure| last.min(state.passes + failure.passes));
        let until = until.min(state.passes + room / (distance * lowering(&contact.step, wear)));
        let whole = (until - state.passes) * distance;
        if !(whole.is_finite() && whole > 0.0) {
            return Ok(None);
        }
        let first = (state.step > 0.0).then_some(state.step);
        let tires = rates.is_any();
        let change = if tires { IN_STEP } else { f64::INFINITY };
        let before = state.largest_worn(Side::Body) + state.largest_worn(Side::Counterbody);
        let path = WearPath { first, change, before, ..WearPath::new(self.load, *wear, whole, self.tolerance)? };
        let mut worn = WornSince::new(self, contact, wear, tires)?;
        let followed = worn.slide(&path, solver, goes_on)?;
        let slid = worn.slid;
        // The length that is tried next stays where no step was accepted.
        state.step = if followed.next > 0.0 { followed.next } else { state.step };
        state.stop = match followed.end {
            PathEnd::Unsolved(stop) => Some(stop),
            _ => worn.stop,
        };
        let passes = if slid >= whole { until - state.passes } else { slid / distance };
        if !worn.groove.as_ref().is_some_and(Groove::has_begun) {
            // The other half is done at the rates of the worn surfaces.
            state.damage.add(rates, 0.5 * passes, removed);
            state.pending = 0.5 * passes;
        }
        state.passes = if slid >= whole { until } else { state.passes + passes };
        self.keep_worn(state, solver, wear, removed);
        if state.stop.is_none() && state.passes >= last && worn.is_between_rows() {
            let on = WearPath { first: Some(state.step), distance: ROW * last * distance, ..path };
            worn.slide(&on, solver, goes_on)?;
        }
        Ok(worn.groove.and_then(Groove::mean))
    }

    /// Keeps what a solver has worn off and pressed in, of a body that was lower by `removed` before.
    fn keep_worn(&self, state: &mut LifeState, solver: &Solver, wear: &Wear, removed: f64) {
        for (depths, side) in state.worn.iter_mut().zip([Side::Body, Side::Counterbody]) {
            if let Some(worn) = solver.worn().filter(|_| wear.coefficient(side) > 0.0) {
                add(depths, worn.depth(side).iter());
            }
        }
        if let Some(depths) = solver.indented() {
            add(&mut state.indented, depths.iter());
        }
        state.lowered = self.mean_worn(state, Side::Body).unwrap_or_else(|| state.largest_worn(Side::Body));
        self.worn_through(state, removed);
    }
}

impl LifeState {
    /// Has the largest pressure of a contact, which rises and falls by `swing`, in the last row of the course.
    fn bears(&mut self, contact: &Beginning, swing: f64) {
        if let Some(row) = self.course.last_mut() {
            (row.max_pressure, row.max_pressure_error) = (contact.record.reading.max_pressure, Some(swing));
        }
    }
}

/// Height by which the body is lowered over a length of sliding by the pressure of a step: on a lattice k p̄, under an
/// isolated contact k ∫p ds over the stroke along the deepest line of its track.
pub(super) fn lowering(step: &Step, wear: &Wear) -> f64 {
    let (k, grid, pressure) = (wear.coefficient(Side::Body), step.grid(), step.pressure());
    let Some(stroke) = wear.stroke_on(grid.cell()) else {
        return k * pressure.mean().unwrap_or(0.0);
    };
    let along = usize::from(wear.direction()[0].abs() <= wear.direction()[1].abs());
    let [x, y] = grid.cell().vectors()[along];
    let spacing = x.hypot(y) / grid.points()[along] as f64;
    let most = pressure.sum_axis(Axis(along)).into_iter().fold(0.0, f64::max);
    k * most * spacing / stroke
}

/// Keeps what a step has pressed in of a counterbody that is softer.
fn keep_indented(state: &mut LifeState, step: &Step) {
    let softer = step.problem().bodies().hardness().map(|(_, side)| side);
    if let Some(depths) = step.finest().indentation().filter(|_| softer == Some(Side::Counterbody)) {
        add(&mut state.indented, depths.iter());
    }
}

/// Adds depths to those of a state, which are none where it has none.
fn add<'a>(sums: &mut Vec<f64>, depths: impl ExactSizeIterator<Item = &'a f64>) {
    sums.resize(depths.len(), 0.0);
    sums.iter_mut().zip(depths).for_each(|(sum, depth)| *sum += depth);
}

//! From one state of a life to the next: what fails comes off, and what slides wears.

use super::beginning::Beginning;
use super::damage::{Damage, Failure, FailurePlace};
use super::event::{Course, Event, EventKind};
use super::rates::Rates;
use super::state::{LifeEnd, LifeState};
use super::task::{LifeError, LifeTask};
use crate::body::{Layer, Side};
use crate::problem::Problem;
use crate::reading::{FatiguePart, contact_radii};
use crate::run::{PathEnd, WearPath};
use crate::spectral::{Solver, Step, Wear};
use ndarray::Axis;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Part of the thickness that the first layer had at first, which is gone when the half-space is laid out anew.
const RELAID: f64 = 0.05;
/// Relative change of the largest pressure by wear after which damage is computed anew, and that of a step.
const REREAD: f64 = 0.02;
const IN_STEP: f64 = 0.04;
/// Accepted steps of wear from one state to the next, at most.
const WEAR_STEPS: usize = 8;
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
            worn: [Vec::new(), Vec::new()],
            indented: Vec::new(),
            step: 0.0,
            pending: 0.0,
            sheds: false,
            solved: 0,
            events: Vec::new(),
            course: Vec::new(),
            end: None,
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
        let original = self.problem.half_space();
        let Some((body, gone)) = original.uncovered(state.removed()) else {
            return Ok(self.ended(state, LifeEnd::NothingLeft));
        };
        let mut solver = self.worn_solver(&Arc::new(self.problem.on_body(body)), &state)?;
        // The unworn contact is solved already.
        let contact = match state.solved {
            0 => begun.clone(),
            _ => self.contact(&mut solver, goes_on)?,
        };
        let mut next = LifeState { solved: state.solved + 1, ..state };
        if !contact.step.report.stop.solved() {
            return Ok(self.ended(next, LifeEnd::Unsolved));
        }
        let reading = contact.record.fatigue.as_ref();
        let rates = Rates::new(original, gone, &contact.planes, reading, next.damage.y());
        let pending = std::mem::take(&mut next.pending);
        next.damage.add(&rates, pending, next.removed());
        self.record(&mut next, &contact, &rates);
        let last = self.passes.unwrap_or(f64::INFINITY);
        if next.passes >= last {
            return Ok(LifeState { end: Some(LifeEnd::Passes), ..next });
        }
        if next.solved >= MAX_LOADS {
            return Ok(LifeState { end: Some(LifeEnd::LoadLimit), ..next });
        }
        // Until the half-space is laid out anew, or the first layer is worn through.
        let left = original.interface_depths().get(gone).map_or(f64::INFINITY, |face| face - next.removed());
        let room = original.layers().get(gone).map_or(f64::INFINITY, |own| (RELAID * own.thickness()).min(left));
        let wear = self.wear(solver.problem())?;
        let wears = [Side::Body, Side::Counterbody].iter().any(|&side| wear.coefficient(side) > 0.0);
        let before = next.removed();
        let until = if wears && self.passes.is_some() {
            self.wear_on(&mut next, &mut solver, (&wear, room), (&rates, &contact), goes_on)?;
            next.passes
        } else {
            keep_indented(&mut next, &contact.step);
            last
        };
        self.tire(&mut next, &rates, &contact, until, room);
        if next.end == Some(LifeEnd::Unsolved) {
            return Ok(self.ended(next, LifeEnd::Unsolved));
        }
        // Surfaces that stay as they are have this contact to the end.
        if next.end.is_none() && next.passes >= last && next.removed() == before && next.pending == 0.0 {
            self.record(&mut next, &contact, &rates);
            next.end = Some(LifeEnd::Passes);
        }
        Ok(next)
    }

    /// Adds the present state to the course.
    fn record(&self, state: &mut LifeState, contact: &Beginning, rates: &Rates) {
        let failure = state.damage.next_failure(self.problem.half_space(), rates, state.removed());
        let row = Course {
            max_pressure: contact.record.reading.max_pressure,
            contact_area: contact.record.reading.contact_area,
            next: failure.map_or(f64::INFINITY, |failure| failure.passes),
            ..self.row(state)
        };
        state.course.push(row);
    }

    /// The end of a life whose surfaces have no contact that is known: the last row has the pressure before.
    fn ended(&self, mut state: LifeState, end: LifeEnd) -> LifeState {
        let row = self.row(&state);
        state.course.push(row);
        LifeState { end: Some(end), ..state }
    }

    /// What is left and worn in a state, with the last contact that is known.
    fn row(&self, state: &LifeState) -> Course {
        let last = state.course.last();
        Course {
            passes: state.passes,
            thickness: self.thickness(state.removed()),
            removed: state.removed(),
            body: state.mean_worn(Side::Body),
            counterbody: state.mean_worn(Side::Counterbody),
            body_depth: state.largest_worn(Side::Body),
            counterbody_depth: state.largest_worn(Side::Counterbody),
            max_pressure: last.map_or(0.0, |own| own.max_pressure),
            contact_area: last.map_or(0.0, |own| own.contact_area),
            next: f64::INFINITY,
        }
    }

    /// Thickness of all layers together after a height has been removed, a length.
    fn thickness(&self, removed: f64) -> f64 {
        let original = self.problem.half_space();
        let whole: f64 = original.layers().iter().map(Layer::thickness).sum();
        (whole - removed).max(0.0)
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
            let due = next.filter(|own| own.passes <= (until - state.passes).max((NOW * state.passes).min(left)));
            let Some(failure) = due else {
                let passes = until - state.passes;
                if passes > 0.0 && passes.is_finite() {
                    state.damage.add(rates, passes, removed);
                    state.passes = until;
                } else if next.is_none() && until.is_infinite() {
                    state.end = Some(LifeEnd::Endless);
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

    /// The first failure of the unworn body as its reading has it, refined between the planes.
    fn exact_first(&self, state: &LifeState, contact: &Beginning) -> Option<Failure> {
        let life = contact.record.fatigue.as_ref()?.lives.iter().filter(|life| !life.part.is_counterbody());
        let first = life.min_by(|a, b| a.passes.total_cmp(&b.passes))?;
        let place = match first.part {
            FatiguePart::Material(own) => FailurePlace::Material(own.number),
            FatiguePart::Interface(own) => FailurePlace::Interface(own.number),
        };
        let is_unworn = state.passes == 0.0 && state.events.is_empty() && first.passes.is_finite();
        is_unworn.then_some(Failure { place, passes: first.passes, depth: first.position[2] })
    }

    /// What lies above a failure comes off.
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
                let (slice, depth) = (state.damage.slice(failure.place, removed), failure.depth - removed);
                let what = if depth > slice { EventKind::Detachment } else { EventKind::SurfaceWear };
                (FatiguePart::Material(original.material_id(number)), what, depth.max(slice))
            }
        };
        state.detached += depth;
        let is_slice = what == EventKind::SurfaceWear;
        let after = state.removed();
        let thickness = self.thickness(after);
        // What fails just below what has just come off is part of it: damage is next to 1 about the depth that fails.
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
        // Of slices that follow each other the first one is an event.
        if !(is_slice && state.sheds) {
            state.events.push(Event { passes: state.passes, what, part, depth, thickness, removed: after });
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
        if depths.iter().all(|own| own.is_empty()) {
            return Ok(solver);
        }
        let mut gap = solver.surface().initial_gap().to_owned();
        for own in depths {
            gap.iter_mut().zip(own).for_each(|(gap, depth)| *gap += depth);
        }
        // The penetration counts from first touch.
        let least = gap.iter().copied().fold(f64::INFINITY, f64::min);
        gap.mapv_inplace(|gap| gap - least);
        Ok(solver.with_gap(gap)?)
    }

    /// Wears both surfaces on, until the pressure has changed, damage reaches 1, the body is lower by `room`, or for some steps.
    fn wear_on(
        &self,
        state: &mut LifeState,
        solver: &mut Solver,
        (wear, room): (&Wear, f64),
        (rates, contact): (&Rates, &Beginning),
        goes_on: &dyn Fn() -> bool,
    ) -> Result<(), LifeError> {
        let (distance, removed) = (self.distance(), state.removed());
        let last = self.passes.unwrap_or(f64::INFINITY);
        let failure = state.damage.next_failure(self.problem.half_space(), rates, removed);
        let until = failure.map_or(last, |failure| last.min(state.passes + failure.passes));
        let until = until.min(state.passes + room / (distance * lowering(&contact.step, wear)));
        let whole = (until - state.passes) * distance;
        if !(whole.is_finite() && whole > 0.0) {
            return Ok(());
        }
        let first = (state.step > 0.0).then_some(state.step);
        let (begun, tires) = (contact.record.reading.grid_peak(), rates.is_any());
        let change = if tires { IN_STEP } else { f64::INFINITY };
        let before = state.largest_worn(Side::Body) + state.largest_worn(Side::Counterbody);
        let path = WearPath { first, change, before, ..WearPath::new(self.load, *wear, whole, self.tolerance)? };
        let (mut steps, mut slid) = (0, 0.0);
        let followed = path.slide(solver, &mut |step, _| {
            steps += 1;
            slid = step.distance;
            let has_changed = tires && (step.max_pressure / begun - 1.0).abs() > REREAD;
            let ends = has_changed || steps >= WEAR_STEPS || !goes_on();
            if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        if !goes_on() {
            return Err(LifeError::Interrupted);
        }
        // Where no step was accepted the length that is tried next stays.
        state.step = if followed.next > 0.0 { followed.next } else { state.step };
        if let PathEnd::Unsolved(_) = followed.end {
            state.end = Some(LifeEnd::Unsolved);
        }
        let passes = if slid >= whole { until - state.passes } else { slid / distance };
        // The other half is done at the rates of the worn surfaces.
        state.damage.add(rates, 0.5 * passes, removed);
        state.pending = 0.5 * passes;
        state.passes = if slid >= whole { until } else { state.passes + passes };
        for (own, side) in state.worn.iter_mut().zip([Side::Body, Side::Counterbody]) {
            if let Some(worn) = solver.worn().filter(|_| wear.coefficient(side) > 0.0) {
                add(own, worn.depth(side).iter());
            }
        }
        if let Some(depths) = solver.indented() {
            add(&mut state.indented, depths.iter());
        }
        let is_isolated = self.problem.cell().is_isolated();
        state.lowered = if is_isolated { state.largest_worn(Side::Body) } else { state.mean_worn(Side::Body) };
        self.worn_through(state, removed);
        Ok(())
    }

    /// Adds the layers that wear has taken to their end since the body was lower by `before`.
    fn worn_through(&self, state: &mut LifeState, before: f64) {
        let original = self.problem.half_space();
        let gone = |removed: f64| original.uncovered(removed).map_or(original.layers().len(), |(_, gone)| gone);
        let removed = state.removed();
        for number in gone(before) + 1..=gone(removed) {
            let part = FatiguePart::Material(original.material_id(number));
            let (depth, thickness) = (removed - before, self.thickness(removed));
            state.events.push(Event {
                passes: state.passes,
                what: EventKind::WornThrough,
                part,
                depth,
                thickness,
                removed,
            });
            state.sheds = false;
        }
    }
}

/// Height by which the body is lowered over a length of sliding by the pressure of a step: on a lattice k p̄, under an isolated contact
/// that of the deepest line of its track, k ∫p ds over the stroke.
fn lowering(step: &Step, wear: &Wear) -> f64 {
    let (k, grid, pressure) = (wear.coefficient(Side::Body), step.grid(), step.pressure());
    let Some(stroke) = wear.stroke().filter(|_| grid.cell().is_isolated()) else {
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
fn add<'a>(own: &mut Vec<f64>, depths: impl ExactSizeIterator<Item = &'a f64>) {
    own.resize(depths.len(), 0.0);
    own.iter_mut().zip(depths).for_each(|(own, depth)| *own += depth);
}

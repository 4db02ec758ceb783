//! The life of a body under a load, from one state to the next.

use super::damage::{Damage, Failure, FailurePlace, Rates};
use super::event::{Course, Event, EventKind};
use super::state::{LifeEnd, LifeState};
use crate::body::{Layer, MeanStress, Side};
use crate::lattice::LatticeError;
use crate::load::Load;
use crate::problem::Problem;
use crate::reading::{FatiguePart, FatigueReading, PathReading, Reading, contact_radii};
use crate::run::{PathEnd, WearPath};
use crate::spectral::{FieldError, Settings, Solver, Step, Wear, WearError, Worn};
use crate::stress::{PathSought, RangePlane, StressFields};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Part of the first layer that is gone when the half-space is laid out anew.
const RELAID: f64 = 0.05;
/// Relative change of the largest pressure by wear after which damage is computed anew.
const REREAD: f64 = 0.02;
/// Accepted steps of wear from one state to the next, at most.
const WEAR_STEPS: usize = 8;
/// Part of the passes so far within which a failure is due.
const NOW: f64 = 1e-9;
/// Most failures from one solution of the contact to the next.
const MAX_FAILURES: usize = 10_000;
/// Most loads solved.
const MAX_LOADS: usize = 2000;

/// A body that is loaded pass after pass.
#[derive(Debug, Clone)]
pub struct LifeTask {
    /// The bodies in contact, as they are at the beginning.
    pub problem: Arc<Problem>,
    /// The load of each pass.
    pub load: Load,
    /// Samples along a₁ and a₂.
    pub points: [usize; 2],
    /// Tolerance and limits of the solver.
    pub settings: Settings,
    /// Convention for the mean lateral stress.
    pub mean: MeanStress,
    /// Passes up to which it is followed; `None`: only to the first failure.
    pub passes: Option<f64>,
    /// Distance that the counterbody slides in one pass, a length; `None`: the period along the direction of sliding, or the width of the
    /// window along it.
    pub distance: Option<f64>,
    /// Relative error of a step of wear.
    pub tolerance: f64,
}

/// The body before its first pass: the contact with what it does in each pass.
#[derive(Debug, Clone)]
pub struct Beginning {
    /// The step that was solved.
    pub step: Step,
    /// Its reading.
    pub reading: Reading,
    /// Lives of what tires; `None` where nothing does.
    pub fatigue: Option<FatigueReading>,
    /// Range of τ₁ on planes of the materials that tire.
    pub planes: Vec<RangePlane>,
}

/// Why a life cannot be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LifeError {
    /// Nothing tires, and nothing wears over a number of passes.
    #[error(
        "nothing tires or wears: give a material `fatigue` or a layer `interface_fatigue`, or `wear` of a surface and `life.passes`"
    )]
    NothingTires,
    /// The grid is refused.
    #[error(transparent)]
    Grid(#[from] LatticeError),
    /// Wear is refused.
    #[error(transparent)]
    Wear(#[from] WearError),
    /// A worn surface is no gap.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// It was interrupted.
    #[error("the search for damage was interrupted")]
    Interrupted,
}

impl LifeTask {
    /// Refuses a body that neither tires nor wears.
    ///
    /// # Errors
    /// [`LifeError::NothingTires`].
    pub fn check(&self) -> Result<(), LifeError> {
        let any = self.problem.bodies().tire() || (self.wears() && self.passes.is_some());
        if any { Ok(()) } else { Err(LifeError::NothingTires) }
    }

    /// Whether a surface wears by sliding.
    fn wears(&self) -> bool {
        [Side::Body, Side::Counterbody].iter().any(|&side| self.problem.bodies().wear(side) > 0.0)
    }

    /// Distance that the counterbody slides in one pass, a length.
    pub fn distance(&self) -> f64 {
        let (cell, direction) = (self.problem.cell(), self.direction());
        let length = |[x, y]: [f64; 2]| x.hypot(y);
        self.distance.unwrap_or_else(|| match cell.closing_vector(direction) {
            _ if cell.is_isolated() => {
                let [[width, _], [_, height]] = cell.vectors();
                width * direction[0].abs() + height * direction[1].abs()
            }
            Some(multiples) => length(cell.vector(multiples.map(f64::from))),
            // A path that never closes has no period: the side of a square as large as the cell.
            None => cell.area().sqrt(),
        })
    }

    fn direction(&self) -> [f64; 2] {
        self.problem.friction().map_or([1.0, 0.0], |own| own.direction())
    }

    /// The contact before the first pass.
    ///
    /// # Errors
    /// [`LifeError`].
    pub fn beginning(&self, goes_on: &dyn Fn() -> bool) -> Result<Beginning, LifeError> {
        let mut solver = Solver::new(Arc::clone(&self.problem), self.points, self.settings)?;
        self.contact(&mut solver, goes_on)
    }

    fn contact(&self, solver: &mut Solver, goes_on: &dyn Fn() -> bool) -> Result<Beginning, LifeError> {
        let step = solver.solve(self.load);
        let reading = step.reading();
        let fields = StressFields::new(step.finest(), self.mean);
        let sought = PathSought { fatigue: true, endurance: false };
        let found = match reading.touches() {
            true => PathReading::of_while(&step, &reading, &fields, sought, goes_on).ok_or(LifeError::Interrupted)?,
            false => PathReading::default(),
        };
        drop(fields);
        Ok(Beginning { step, reading, fatigue: found.fatigue, planes: found.planes })
    }

    /// The state before the first pass.
    pub fn unworn(&self, beginning: &Beginning) -> LifeState {
        let radius = contact_radii(&beginning.step, &beginning.reading)[0];
        LifeState {
            passes: 0.0,
            detached: 0.0,
            damage: Damage::none(self.problem.half_space(), radius),
            worn: [Vec::new(), Vec::new()],
            step: 0.0,
            sheds: false,
            solved: 0,
            events: Vec::new(),
            course: Vec::new(),
            end: None,
        }
    }

    /// The next state after `begun`, the contact before the first pass: the contact of the surfaces as they are is solved, and damage and wear go on until something comes off, the
    /// pressure has changed, or the passes are done. A state that has ended stays.
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
            return Ok(LifeState { end: Some(LifeEnd::NothingLeft), ..state });
        };
        let first_layer = body.layers().first().map(Layer::thickness);
        let mut solver = self.worn_solver(&Arc::new(self.problem.on_body(body)), &state)?;
        // The unworn contact is solved already.
        let contact = match state.solved {
            0 => begun.clone(),
            _ => self.contact(&mut solver, goes_on)?,
        };
        let mut next = LifeState { solved: state.solved + 1, ..state };
        if !contact.step.report.stop.solved() {
            return Ok(LifeState { end: Some(LifeEnd::Unsolved), ..next });
        }
        let rates = Rates::new(original, gone, contact.planes.clone(), contact.fatigue.as_ref());
        self.record(&mut next, &contact, &rates);
        let last = self.passes.unwrap_or(f64::INFINITY);
        let until = if self.wears() && self.passes.is_some() {
            self.wear_on(&mut next, &mut solver, &rates, &contact)?;
            next.passes
        } else {
            last
        };
        self.tire(&mut next, &rates, &contact, until, first_layer);
        if next.end.is_none() && next.passes >= last {
            next.end = Some(LifeEnd::Passes);
        }
        if next.end.is_none() && next.solved >= MAX_LOADS {
            next.end = Some(LifeEnd::LoadLimit);
        }
        if next.end.is_some() {
            self.record(&mut next, &contact, &rates);
        }
        Ok(next)
    }

    /// Adds the present state to the course.
    fn record(&self, state: &mut LifeState, contact: &Beginning, rates: &Rates) {
        let failure = state.damage.next_failure(self.problem.half_space(), rates, state.removed());
        state.course.push(Course {
            passes: state.passes,
            thickness: self.thickness(state.removed()),
            removed: state.removed(),
            body: state.mean_worn(Side::Body),
            counterbody: state.mean_worn(Side::Counterbody),
            body_depth: state.largest_worn(Side::Body),
            counterbody_depth: state.largest_worn(Side::Counterbody),
            max_pressure: contact.reading.max_pressure,
            contact_area: contact.reading.contact_area,
            next: failure.map_or(f64::INFINITY, |failure| failure.passes),
        });
    }

    /// Thickness of all layers together after a height has been removed, a length.
    fn thickness(&self, removed: f64) -> f64 {
        let original = self.problem.half_space();
        let whole: f64 = original.layers().iter().map(Layer::thickness).sum();
        (whole - removed).max(0.0)
    }

    /// Lets what fails come off, up to a number of passes, until more than a part of the first layer is gone.
    fn tire(&self, state: &mut LifeState, rates: &Rates, contact: &Beginning, until: f64, first_layer: Option<f64>) {
        let original = self.problem.half_space();
        let begun = state.removed();
        for _ in 0..MAX_FAILURES {
            let removed = state.removed();
            let next = state.damage.next_failure(original, rates, removed);
            let next = self.exact_first(state, contact).or(next);
            let due = next.filter(|failure| failure.passes <= (until - state.passes).max(NOW * state.passes));
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
            let is_relaid = first_layer.is_some_and(|thickness| state.removed() - begun > RELAID * thickness);
            if is_relaid || matches!(failure.place, FailurePlace::Interface(_)) {
                return;
            }
        }
    }

    /// The first failure of the unworn body as its reading has it, refined between the planes.
    fn exact_first(&self, state: &LifeState, contact: &Beginning) -> Option<Failure> {
        let life = contact.fatigue.as_ref()?.lives.iter().filter(|life| !life.part.is_counterbody());
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
        // Of slices that follow each other the first one is an event.
        let is_slice = what == EventKind::SurfaceWear;
        if !(is_slice && state.sheds) {
            let removed = state.removed();
            let thickness = self.thickness(removed);
            state.events.push(Event { passes: state.passes, what, part, depth, thickness, removed });
        }
        state.sheds = is_slice;
    }

    /// A solver for the surfaces of a state.
    fn worn_solver(&self, problem: &Arc<Problem>, state: &LifeState) -> Result<Solver, LifeError> {
        let solver = Solver::new(Arc::clone(problem), self.points, self.settings)?;
        if state.worn.iter().all(Vec::is_empty) {
            return Ok(solver);
        }
        let mut gap = solver.surface().initial_gap().to_owned();
        for depths in &state.worn {
            gap.iter_mut().zip(depths).for_each(|(gap, depth)| *gap += depth);
        }
        // The penetration counts from first touch.
        let least = gap.iter().copied().fold(f64::INFINITY, f64::min);
        gap.mapv_inplace(|gap| gap - least);
        Ok(solver.with_gap(gap)?)
    }

    /// Wears both surfaces on, until the pressure has changed, damage reaches 1, or for some steps.
    fn wear_on(
        &self,
        state: &mut LifeState,
        solver: &mut Solver,
        rates: &Rates,
        contact: &Beginning,
    ) -> Result<(), LifeError> {
        let (bodies, distance, removed) = (self.problem.bodies(), self.distance(), state.removed());
        let last = self.passes.unwrap_or(f64::INFINITY);
        let failure = state.damage.next_failure(self.problem.half_space(), rates, removed);
        let until = failure.map_or(last, |failure| last.min(state.passes + failure.passes));
        let whole = (until - state.passes) * distance;
        if !(whole.is_finite() && whole > 0.0) {
            return Ok(());
        }
        let mut wear = Wear::new(bodies.wear(Side::Body), bodies.wear(Side::Counterbody), self.direction())?;
        if self.problem.cell().is_isolated() {
            wear = wear.with_stroke(distance)?;
        }
        let first = (state.step > 0.0).then_some(state.step);
        let path = WearPath { first, ..WearPath::new(self.load, wear, whole, self.tolerance)? };
        let (begun, tires) = (contact.reading.grid_peak(), rates.is_any());
        let (mut steps, mut slid) = (0, 0.0);
        let followed = path.slide(solver, &mut |step, _| {
            steps += 1;
            slid = step.distance;
            let has_changed = tires && (step.max_pressure / begun - 1.0).abs() > REREAD;
            if has_changed || steps >= WEAR_STEPS { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        state.step = followed.next;
        if let PathEnd::Unsolved(_) = followed.end {
            state.end = Some(LifeEnd::Unsolved);
        }
        let passes = if slid >= whole { until - state.passes } else { slid / distance };
        state.damage.add(rates, passes, removed);
        state.passes = if slid >= whole { until } else { state.passes + passes };
        for (own, side) in state.worn.iter_mut().zip([Side::Body, Side::Counterbody]) {
            if let Some(worn) = solver.worn().filter(|_| bodies.wear(side) > 0.0) {
                add(own, worn, side);
            }
        }
        self.worn_through(state, removed);
        Ok(())
    }

    /// Adds the layers that sliding has worn through since the body was lower by `before`.
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

/// Adds worn depths to those of a state.
fn add(own: &mut Vec<f64>, worn: &Worn, side: Side) {
    let depths = worn.depth(side);
    if own.is_empty() {
        own.resize(depths.len(), 0.0);
    }
    own.iter_mut().zip(&depths).for_each(|(own, depth)| *own += depth);
}

//! Thickness left, depths worn and volumes that have come off in a state.

use super::beginning::Beginning;
use super::event::{Course, Event, EventKind, Scar};
use super::rates::Rates;
use super::state::{LifeEnd, LifeState};
use super::task::LifeTask;
use crate::body::{Layer, Side};
use crate::load::Load;
use crate::reading::FatiguePart;
use std::f64::consts::PI;

/// Part of the thickness of all layers that is none.
const ROUNDING: f64 = 1e-8;

impl LifeTask {
    /// Passes until the next failure at these rates; infinite where there is none.
    pub(super) fn next_failure(&self, state: &LifeState, rates: &Rates) -> f64 {
        let failure = state.damage.next_failure(self.problem.half_space(), rates, state.removed());
        failure.map_or(f64::INFINITY, |failure| failure.passes)
    }

    /// Adds the present state to the course, with the passes until the `next` failure.
    pub(super) fn record(&self, state: &mut LifeState, contact: &Beginning, next: f64) {
        // At the end of a groove the mean before stays.
        let groove = state.course.last().filter(|row| row.max_pressure_error.is_some() && self.is_over(state));
        let row = Course {
            max_pressure: groove.map_or(contact.record.reading.max_pressure, |row| row.max_pressure),
            max_pressure_error: groove.and_then(|row| row.max_pressure_error),
            contact_area: contact.record.reading.contact_area,
            next,
            ..self.row(state)
        };
        state.course.push(row);
    }

    /// Whether the passes are done.
    fn is_over(&self, state: &LifeState) -> bool {
        self.passes.is_some_and(|last| state.passes >= last)
    }

    /// The end of a life whose surfaces have no contact that is known: the last row has the pressure before.
    pub(super) fn ended(&self, mut state: LifeState, end: LifeEnd) -> LifeState {
        let row = self.row(&state);
        state.course.push(row);
        LifeState { end: Some(end), ..state }
    }

    /// Thickness left and depths worn in a state, with the last contact that is known.
    fn row(&self, state: &LifeState) -> Course {
        let last = state.course.last();
        let distance = self.slid_after(state.passes);
        let scar = self.scar(state, Side::Counterbody);
        let work = match self.load {
            Load::Force(force) => distance.map(|distance| force * distance).filter(|work| *work > 0.0),
            _ => None,
        };
        Course {
            passes: state.passes,
            distance,
            thickness: self.thickness(state.removed()),
            removed: state.removed(),
            body: self.mean_worn(state, Side::Body),
            counterbody: self.mean_worn(state, Side::Counterbody),
            body_depth: state.largest_worn(Side::Body),
            counterbody_depth: state.largest_worn(Side::Counterbody),
            groove: self.groove(state),
            specific_rate: scar.zip(work).map(|(scar, work)| scar.volume / work),
            scar,
            body_scar: self.scar(state, Side::Body).filter(|_| self.motions.is_some()),
            max_pressure: last.map_or(0.0, |row| row.max_pressure),
            max_pressure_error: None,
            contact_area: last.map_or(0.0, |row| row.contact_area),
            next: f64::INFINITY,
        }
    }

    /// Mean depth that is worn off a surface, a length; `None` of an isolated contact.
    pub(super) fn mean_worn(&self, state: &LifeState, side: Side) -> Option<f64> {
        self.problem.cell().surroundings().per_cell(side).map(|side| state.mean_worn(side))
    }

    /// The scar of a surface of an isolated contact that wears.
    fn scar(&self, state: &LifeState, side: Side) -> Option<Scar> {
        let wears = self.problem.bodies().wear(side) > 0.0;
        if !(wears && self.passes.is_some() && self.problem.kind().is_indentation()) {
            return None;
        }
        let (depths, window) = (state.of(side), self.window(state).area());
        // Of points that stay in place the middle may stick.
        let worn = match self.motions {
            Some(_) => around(depths, state.points[1]),
            None => depths.iter().filter(|depth| **depth > 0.0).count() as f64,
        };
        let area = window * worn / depths.len().max(1) as f64;
        Some(Scar {
            diameter: 2.0 * (area / PI).sqrt(),
            depth: state.largest_worn(side),
            volume: state.mean_worn(side) * window,
        })
    }

    /// Cross-section of the groove in the body under an isolated contact, a length squared; `None` where none is worn.
    fn groove(&self, state: &LifeState) -> Option<f64> {
        let is_swept = self.problem.kind().is_indentation() && self.motions.is_none();
        let is_worn = is_swept && state.largest_worn(Side::Body) > 0.0;
        is_worn.then(|| {
            let (window, direction) = (self.window(state), self.problem.direction());
            let along = usize::from(direction[0].abs() <= direction[1].abs());
            let [x, y] = window.vectors()[1 - along];
            state.mean_worn(Side::Body) * x.hypot(y)
        })
    }

    /// Thickness of all layers together after a height has been removed, a length.
    pub(super) fn thickness(&self, removed: f64) -> f64 {
        let original = self.problem.half_space();
        let whole: f64 = original.layers().iter().map(Layer::thickness).sum();
        let left = whole - removed;
        if left > ROUNDING * whole { left } else { 0.0 }
    }

    /// Adds the layers that wear has taken to their end since the body was lower by `before`.
    pub(super) fn worn_through(&self, state: &mut LifeState, before: f64) {
        let original = self.problem.half_space();
        let gone = |removed: f64| original.uncovered(removed).map_or(original.layers().len(), |(_, gone)| gone);
        let removed = state.removed();
        for number in gone(before) + 1..=gone(removed) {
            let (top, bottom) = original.faces(number);
            state.events.push(Event {
                passes: state.passes,
                distance: self.slid_after(state.passes),
                what: EventKind::WornThrough,
                part: FatiguePart::Material(original.material_id(number)),
                depth: bottom - top,
                thickness: self.thickness(removed),
                removed,
            });
            state.sheds = false;
        }
    }
}

/// Samples of the ellipse in the smallest rectangle around all that are worn, by a thousandth of the deepest at least, in rows of so many.
fn around(depths: &[f64], columns: usize) -> f64 {
    let least = 1e-3 * depths.iter().copied().fold(0.0, f64::max);
    let worn = || depths.iter().enumerate().filter(|(_, depth)| **depth > least).map(|(i, _)| i);
    let width = |places: Vec<usize>| match (places.iter().min(), places.iter().max()) {
        (Some(least), Some(most)) => (most - least + 1) as f64,
        _ => 0.0,
    };
    0.25 * PI * width(worn().map(|i| i / columns).collect()) * width(worn().map(|i| i % columns).collect())
}

//! A load step on one grid: from its own last pressure, with the change of the next coarser grid, to the pressure of the load.
//!
//! A composite hardness follows from the penetration, which is searched with it. A surface that earlier loads have pressed in, and that
//! this one does not reach, bears no pressure.

use super::{Coarser, GridLevel};
use crate::load::{Control, Load};
use crate::numeric::sums;
use crate::spectral::depth_search::{DepthSearch, Found};
use crate::spectral::iteration::{
    AdmissibleSet, Bounds, ContactProblem, Progress, Report, Settings, Unknowns, Working,
};
use crate::spectral::prolongation::prolonged;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Least change of the penetration, over it, at which its composite hardness is known.
const DEPTH_TOLERANCE: f64 = 1e-6;

impl GridLevel {
    /// Solves on this grid after adding the change of the next `coarser` one; returns the convolutions times samples too.
    pub fn solve(
        &mut self,
        mut coarser: Option<Coarser>,
        load: Load,
        settings: Settings,
        working: &mut Working,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> (Report, f64) {
        let Some(composite) = self.composite else {
            return self.solve_at_hardness(coarser, load, settings, working, progress);
        };
        let tolerance = settings.tolerance.max(DEPTH_TOLERANCE);
        let nearly = coarser.as_ref().map(|coarser| coarser.after.penetration);
        let mut search = DepthSearch::new(composite, nearly, tolerance);
        let (mut iterations, mut convolutions) = (0, 0.0);
        loop {
            self.harden(Bounds::up_to(search.hardness()));
            let (mut report, work) = self.solve_at_hardness(coarser.take(), load, settings, working, progress);
            (iterations, convolutions) = (iterations + report.iterations, convolutions + work);
            report.iterations = iterations;
            match search.found(report.stop, self.unknowns.penetration) {
                Found::Another => {}
                Found::NotBorne => self.forget(),
                Found::End(stop) => {
                    self.settle(Bounds::up_to(composite.at(self.unknowns.penetration)));
                    return (Report { stop, ..report }, convolutions);
                }
            }
        }
    }

    /// Gives the surface another hardness, which the pressure of earlier loads does not exceed either.
    fn harden(&mut self, bounds: Bounds) {
        self.bounds = bounds;
        self.set_pressures(|p| bounds.clamp(p));
    }

    /// Gives the surface the hardness of its last penetration, nearly that at which it was solved: the pressure that was the hardness is
    /// this one.
    fn settle(&mut self, bounds: Bounds) {
        let before = std::mem::replace(&mut self.bounds, bounds);
        self.set_pressures(|p| bounds.follow(before, p));
    }

    fn set_pressures(&mut self, of: impl Fn(f64) -> f64 + Sync) {
        sums::update(&mut Arc::make_mut(&mut self.unknowns.pressure)[..], |_, p| of(p));
    }

    /// Solves at the hardness that the surface has.
    fn solve_at_hardness(
        &mut self,
        coarser: Option<Coarser>,
        load: Load,
        settings: Settings,
        working: &mut Working,
        progress: &mut (dyn FnMut(Progress) -> ControlFlow<()> + Send),
    ) -> (Report, f64) {
        if let Some(given) = &self.given {
            let report = self.load_with(given.clone(), load.on(self.surface.grid().cell()));
            return (report, self.surface.grid().len() as f64);
        }
        if let Some(penetration) = self.without_contact(load.on(self.surface.grid().cell())) {
            return (self.stand_off(penetration), 0.0);
        }
        if let Some(coarser) = coarser {
            self.add_change(&coarser, settings.tolerance);
        }
        let Self { surface, largest_gap, mask, bounds, operator, unknowns, .. } = self;
        let (samples, before) = (surface.grid().len(), operator.convolutions());
        let report = ContactProblem {
            operator: &mut *operator,
            working,
            initial_gap: surface.gaps(),
            largest_gap: *largest_gap,
            admissible: AdmissibleSet::new(mask.as_deref()).within(*bounds),
            load: load.on(surface.grid().cell()),
            settings,
            outer: 0,
            progress,
        }
        .solve(unknowns);
        (report, (operator.convolutions() - before) * samples as f64)
    }

    /// Penetration δ of a surface that earlier loads have pressed in, or that creeps, and this one does not reach, a length: without a load that
    /// at which contact begins. `None` where the surface is as at first, or touches.
    fn without_contact(&self, load: Control) -> Option<f64> {
        if self.indented.is_none() && self.flat.is_none() {
            return None;
        }
        let (set, gaps) = (AdmissibleSet::new(self.mask.as_deref()), self.surface.gaps());
        let begins = sums::least(gaps.len(), |i| if set.may_touch(i) { gaps[i] } else { f64::INFINITY });
        match load {
            Control::MeanPressure(mean) => (mean == 0.0).then_some(begins),
            Control::Penetration(penetration) => (0.0..=begins).contains(&penetration).then_some(penetration),
        }
    }

    /// No pressure, at a penetration δ: the gap is f − δ.
    fn stand_off(&mut self, penetration: f64) -> Report {
        let gap = self.surface.gaps().iter().map(|f| f - penetration).collect();
        self.unknowns = Unknowns { gap: Arc::new(gap), penetration, ..Unknowns::new(self.surface.grid().len()) };
        Report::without_contact()
    }

    /// Adds to the pressure the change of that on the next `coarser` grid.
    fn add_change(&mut self, coarser: &Coarser, tolerance: f64) {
        let points = self.points();
        let carried =
            |Unknowns { pressure, gap, .. }: &Unknowns| prolonged(&coarser.grid, pressure, gap, self.modulus, points);
        let after = carried(&coarser.after);
        if coarser.before.pressure.iter().all(|&p| p == 0.0) {
            self.unknowns.pressure = Arc::new(after);
            return;
        }
        let before = carried(&coarser.before);
        // A change below the tolerance is dropped: it would leave traces of pressure around the contact, which no iteration
        // removes where none is needed.
        let least = -tolerance * sums::least(after.len(), |i| -after[i]);
        let (pressure, bounds) = (Arc::make_mut(&mut self.unknowns.pressure), self.bounds);
        sums::update(pressure, |i, p| {
            let rise = after[i] - before[i];
            if rise.abs() > least { bounds.clamp(p + rise) } else { p }
        });
    }
}

//! The way to a solution: at once where there is nothing to iterate, by iteration, or by a search for the load.

use super::check::Check;
use super::iterate::iterate;
use super::load_search;
use super::problem::GridProblem;
use super::report::{Report, Route, Stop};
use super::settings::Method;
use super::unknowns::Unknowns;
use crate::load::Load;
use crate::numeric::sums;
use std::sync::Arc;

impl GridProblem<'_> {
    /// Solves from and into `unknowns` (any values; negative pressures are dropped).
    pub fn solve(&mut self, unknowns: &mut Unknowns) -> Report {
        let report = self.solve_by_route(unknowns);
        Report { outer: self.outer, ..report }
    }

    fn solve_by_route(&mut self, unknowns: &mut Unknowns) -> Report {
        let route = match self.settings.method {
            Method::Preconditioned => Route::Direct,
            Method::PolonskyKeer => Route::Baseline,
        };
        let done = |stop, residual| Report { stop, route, iterations: 0, outer: 0, residual };
        let gap = self.initial_gap;
        if !self.load.value().is_finite() {
            unknowns.rest();
            Check::new(self, unknowns);
            return done(Stop::Stalled, f64::INFINITY);
        }
        if self.load.value() <= 0.0 {
            unknowns.rest();
            Check::new(self, unknowns);
            return done(Stop::NoContact, 0.0);
        }
        match self.load {
            Load::MeanPressure(mean) if gap.iter().all(|f| *f == gap[0]) => {
                // A flat counterbody: complete contact at once.
                unknowns.pressure = Arc::new(vec![mean; gap.len()]);
                Check::new(self, unknowns);
                done(Stop::Converged, 0.0)
            }
            Load::MeanPressure(_) => iterate(self, 0, unknowns),
            Load::Penetration(penetration) => {
                if penetration >= sums::mean(gap) {
                    // Of the step before nothing must pass for an answer.
                    unknowns.rest();
                    Check::new(self, unknowns);
                    return done(Stop::BeyondFullContact, f64::INFINITY);
                }
                let direct = iterate(self, 0, unknowns);
                load_search::unless_found(self, penetration, direct, unknowns)
            }
        }
    }
}

//! The route to a solution: at once where there is nothing to iterate, by iteration, or by a search for the load.
//!
//! **Displacement control by load control.** Close to complete contact the direct iteration under displacement control stalls:
//! a uniform pressure causes no displacement, and only the few open samples hold it. The penetration grows with the mean
//! pressure, so that its root is bracketed and found by regula falsi (Illinois), each trial starting from the last. A trial is
//! accepted by the criteria of displacement control; its tolerance is smaller than theirs, because its own error changes its
//! penetration.

use super::check::ConvergenceCheck;
use super::fallback::iterate;
use super::fields::Unknowns;
use super::problem::{ContactProblem, Method, Settings};
use super::report::{Report, Route, Stop};
use super::stopping::unless_rounding;
use crate::lattice::Surroundings;
use crate::load::Control;
use crate::numeric::sums;
use crate::spectral::operator::ElasticOperator;
use std::sync::Arc;

/// Trials of the mean pressure after which the search counts as stalled.
const MAX_TRIALS: usize = 60;
/// Tolerance of a trial over that of the search.
const TRIAL_TOLERANCE: f64 = 0.1;

impl<O: ElasticOperator> ContactProblem<'_, O> {
    /// Solves from and into `unknowns` (any values; negative pressures are dropped).
    pub fn solve(&mut self, unknowns: &mut Unknowns) -> Report {
        let mut report = self.solved_by_route(unknowns);
        if report.stop.solved() && !self.admissible.is_everywhere() && self.admissible.is_filled(&unknowns.pressure) {
            // Any greater penetration has the same pressure.
            unknowns.clear();
            ConvergenceCheck::new(self, unknowns);
            report = Report { stop: Stop::BeyondHardness, residual: f64::INFINITY, ..report };
        }
        Report { outer: self.outer, ..report }
    }

    /// Whether all of the surface is at the hardness H at a `penetration`: from max f and the mean displacement under H on, which is all
    /// that a uniform pressure displaces.
    fn is_filled_at(&self, penetration: f64) -> bool {
        let displaced = self.admissible.bounds().largest_displacement(self.operator.mean_compliance());
        penetration >= self.largest_gap + displaced
    }

    fn solved_by_route(&mut self, unknowns: &mut Unknowns) -> Report {
        let route = match self.settings.method {
            Method::Preconditioned => Route::Direct,
            Method::PolonskyKeer => Route::Baseline,
        };
        let done = |stop, residual| Report::new(stop, route, 0, residual);
        let gap = self.initial_gap;
        let may_be_complete = self.admissible.is_everywhere() && self.operator.surroundings() == Surroundings::Periodic;
        if !self.load.value().is_finite() {
            unknowns.clear();
            ConvergenceCheck::new(self, unknowns);
            return done(Stop::Stalled, f64::INFINITY);
        }
        if self.operator.coupling().is_infinite() {
            unknowns.clear();
            return done(Stop::NotUnique, f64::INFINITY);
        }
        if self.load.value() <= 0.0 {
            unknowns.clear();
            ConvergenceCheck::new(self, unknowns);
            return done(Stop::NoContact, 0.0);
        }
        if self.admissible.is_exceeded_by(self.load, gap.len()) {
            unknowns.clear();
            ConvergenceCheck::new(self, unknowns);
            return done(Stop::BeyondHardness, f64::INFINITY);
        }
        match self.load {
            Control::MeanPressure(mean) if may_be_complete && gap.iter().all(|f| *f == gap[0]) => {
                // A flat counterbody: complete contact at once.
                unknowns.pressure = Arc::new(vec![mean; gap.len()]);
                ConvergenceCheck::new(self, unknowns);
                done(Stop::Converged, 0.0)
            }
            Control::MeanPressure(_) => iterate(self, 0, unknowns),
            Control::Penetration(penetration) => {
                // Complete contact on a rigid base, and a surface that is pressed in, bear any penetration.
                let yields = self.admissible.bounds().is_finite();
                let is_limited = may_be_complete && self.operator.mean_compliance() == 0.0 && !yields;
                if is_limited && penetration >= sums::mean(gap) {
                    // Nothing of the step before is an answer.
                    unknowns.clear();
                    ConvergenceCheck::new(self, unknowns);
                    return done(Stop::BeyondFullContact, f64::INFINITY);
                }
                if may_be_complete && self.is_filled_at(penetration) {
                    unknowns.clear();
                    ConvergenceCheck::new(self, unknowns);
                    return done(Stop::BeyondHardness, f64::INFINITY);
                }
                let direct = iterate(self, 0, unknowns);
                unless_found(self, penetration, direct, unknowns)
            }
        }
    }
}

/// Report of the `direct` iteration, unless it has stalled: then that of a search for the load that continues from there.
fn unless_found<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    penetration: f64,
    direct: Report,
    unknowns: &mut Unknowns,
) -> Report {
    if direct.stop != Stop::Stalled {
        return direct;
    }
    let report = search_load(problem, penetration, direct.iterations, unknowns);
    Report { stop: unless_rounding(problem, unknowns, report.stop), ..report }
}

/// Searches from and into `unknowns` for the mean pressure of a `penetration`; `iterations` are those before.
fn search_load<O: ElasticOperator>(
    problem: &mut ContactProblem<'_, O>,
    penetration: f64,
    iterations: usize,
    unknowns: &mut Unknowns,
) -> Report {
    let settings = problem.settings;
    let sharper = Settings { tolerance: TRIAL_TOLERANCE * settings.tolerance, ..settings };
    let mut pressure = sums::mean(&unknowns.pressure);
    // Mean pressures and the errors of their penetrations, on either side of the root.
    let (mut low, mut high) = ((0.0, -penetration), None);
    let mut last = Report::new(Stop::Stalled, Route::LoadSearch { trials: 0 }, iterations, f64::INFINITY);
    for trials in 1..=MAX_TRIALS {
        if !(pressure.is_finite() && pressure > 0.0) {
            break;
        }
        let mut trial = ContactProblem {
            operator: &mut *problem.operator,
            working: &mut *problem.working,
            load: Control::MeanPressure(pressure),
            settings: sharper,
            progress: &mut *problem.progress,
            ..*problem
        };
        let report = iterate(&mut trial, last.iterations, unknowns);
        problem.outer = trial.outer;
        let error = unknowns.penetration - penetration;
        let check = ConvergenceCheck::new(problem, unknowns);
        last = Report { route: Route::LoadSearch { trials }, residual: check.residual, ..report };
        if check.converged(settings.tolerance) {
            return Report { stop: Stop::Converged, ..last };
        }
        if !report.stop.solved() {
            return last;
        }
        // Illinois: the value of an end that is kept is halved.
        if error < 0.0 {
            low = (pressure, error);
            high = high.map(|(p, error)| (p, 0.5 * error));
        } else {
            high = Some((pressure, error));
            low.1 *= 0.5;
        }
        pressure = match high {
            // Not up to the hardness, which no mean pressure reaches.
            None => (2.0 * pressure).min(problem.admissible.bounds().halfway(pressure)),
            Some(high) => low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1),
        };
    }
    Report { stop: Stop::Stalled, ..last }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::counterbody::{Counterbody, Indenters, Level, Shape, Surface};
    use crate::lattice::Lattice;
    use crate::spectral::LayeredOperator;
    use crate::spectral::iteration::admissible::AdmissibleSet;
    use crate::spectral::iteration::fields::Working;
    use std::ops::ControlFlow;

    /// Cones on a stiff sliding plate, pushed in by a `part` of what makes contact complete, from a uniform pressure, after a
    /// direct iteration that has stopped so.
    fn after(stop: Stop, part: f64, before: usize, max_iterations: usize) -> (Report, Unknowns, f64) {
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let plate = Layer::new(Material::from_shear(100.0, 0.3).unwrap(), 0.1, Interface::Frictionless).unwrap();
        let cones = [0.02, 0.01, 0.0].map(|height| Level::new(Shape::Cone { slope: 0.1 }, height).unwrap());
        let indenters = Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), cones.to_vec()).unwrap();
        let surface = Surface::new(&Counterbody::from(indenters), [24, 24]).unwrap();
        let mut operator = LayeredOperator::new(surface.grid(), HalfSpace::new(vec![plate], substrate));
        let penetration = part * surface.mean();
        let mut problem = ContactProblem {
            working: &mut Working::of_finest(&operator),
            operator: &mut operator,
            initial_gap: surface.gaps(),
            largest_gap: surface.largest(),
            admissible: AdmissibleSet::default(),
            load: Control::Penetration(penetration),
            settings: Settings { max_iterations, ..Settings::default() },
            outer: 0,
            progress: &mut |_| ControlFlow::Continue(()),
        };
        let mut unknowns = Unknowns::new(surface.grid().len());
        unknowns.pressure = std::sync::Arc::new(vec![0.01; surface.grid().len()]);
        let direct = Report::new(stop, Route::Direct, before, 1.0);
        let report = unless_found(&mut problem, penetration, direct, &mut unknowns);
        (report, unknowns, penetration)
    }

    fn searched(part: f64, before: usize, max_iterations: usize) -> (Report, Unknowns, f64) {
        after(Stop::Stalled, part, before, max_iterations)
    }

    #[test]
    fn a_report_without_a_stall_stays_as_it_is() {
        for stop in [Stop::Converged, Stop::Rounding, Stop::IterationLimit, Stop::Interrupted] {
            let (report, unknowns, _) = after(stop, 0.5, 3, 10_000);
            assert!(report.stop == stop && report.route == Route::Direct && report.iterations == 3, "{report}");
            assert!(unknowns.pressure.iter().all(|&p| p == 0.01));
        }
    }

    /// Light, half closed and almost complete contact.
    #[test]
    fn the_load_that_is_found_has_the_penetration() {
        for part in [0.1, 0.5, 0.9, 0.999] {
            let (report, unknowns, penetration) = searched(part, 0, 10_000);
            assert_eq!(report.stop, Stop::Converged, "{part}: {report}");
            assert!(report.route.trials() > 1, "{part}: {report}");
            assert!((unknowns.penetration / penetration - 1.0).abs() < 1e-7, "{part}: {}", unknowns.penetration);
        }
    }

    #[test]
    fn a_search_keeps_within_the_iterations_it_is_given_and_says_that_it_was_cut() {
        let before = 7;
        let (whole, ..) = searched(0.9, before, 10_000);
        assert!(whole.iterations > 8 * before, "{whole}");
        for given in [before + 1, before + 5, whole.iterations / 4, whole.iterations / 2] {
            let (report, ..) = searched(0.9, before, given);
            assert_eq!(report.stop, Stop::IterationLimit, "{given}: {report}");
            assert!(report.iterations <= given && report.route.trials() > 0, "{given}: {report}");
        }
    }
}

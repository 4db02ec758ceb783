//! Steps to pressures of zero and H alone, for surfaces so soft that elastic displacements change little.
//!
//! Under a gap g a load does the least work ⟨g, p⟩ with p = H on the samples of the least gaps, the rest on the next one and p = 0 on all
//! others. This v is taken where the energy falls all the way from p to v, ⟨g(v), v − p⟩ ≤ 0: a full step of the method of Frank & Wolfe
//! (Nav. Res. Logist. Q. 3 (1956) 95). Where v stays it is the solution. Conjugate gradients alone take many iterations there: their
//! steps, made for the elastic body, exceed H many times.

use super::check::ConvergenceCheck;
use super::fields::Unknowns;
use super::problem::ContactProblem;
use crate::load::Control;
use crate::numeric::sums;
use crate::spectral::operator::ElasticOperator;
use std::sync::Arc;

/// Most steps.
const MAX_STEPS: usize = 30;

/// Takes full steps from and into the pressure of `unknowns`, one convolution each, under a load that a sample at H cannot bear alone.
pub(super) fn full_steps<O: ElasticOperator>(problem: &mut ContactProblem<'_, O>, unknowns: &mut Unknowns) {
    let samples = problem.initial_gap.len();
    let Control::MeanPressure(mean) = problem.load else { return };
    let total = mean * samples as f64;
    if !problem.admissible.bounds().is_full(total) {
        return;
    }
    unknowns.admit(problem.load, problem.admissible);
    ConvergenceCheck::new(problem, unknowns);
    for _ in 0..MAX_STEPS {
        let next = problem.admissible.least_work(&unknowns.gap, total);
        if next == *unknowns.pressure {
            return;
        }
        let before = std::mem::replace(&mut unknowns.pressure, Arc::new(next));
        ConvergenceCheck::new(problem, unknowns);
        let (p, g) = (&unknowns.pressure, &unknowns.gap);
        let [slope] = sums::of(samples, |i| [g[i] * (p[i] - before[i])]);
        if slope > 0.0 {
            unknowns.pressure = before;
            return;
        }
    }
}

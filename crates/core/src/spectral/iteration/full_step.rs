//! Steps to pressures of zero and H alone, for surfaces so soft that elastic displacements change little.
//!
//! Under a gap g a load does the least work ⟨g, p⟩ with p = H on the samples of the least gaps, the rest on the next one and p = 0 on all
//! others. This v is taken where the energy falls all the way from p to v, ⟨g(v), v − p⟩ ≤ 0: a full step of the method of Frank & Wolfe
//! (Nav. Res. Logist. Q. 3 (1956) 95). Where v stays it is the solution. Conjugate gradients alone take many iterations there: their
//! steps, made for the elastic body, exceed H many times.

use super::admissible::AdmissibleSet;
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
    let (most, samples) = (problem.admissible.bound().most, problem.initial_gap.len());
    let Control::MeanPressure(mean) = problem.load else { return };
    if (mean * samples as f64) < most {
        return;
    }
    unknowns.admit(problem.load, problem.admissible);
    ConvergenceCheck::new(problem, unknowns);
    for _ in 0..MAX_STEPS {
        let next = least_work(&unknowns.gap, mean * samples as f64, problem.admissible);
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

/// The pressure of a set with the sum `total` that does the least work ⟨gap, p⟩; of equal gaps the first ones bear it.
fn least_work(gap: &[f64], total: f64, set: AdmissibleSet<'_>) -> Vec<f64> {
    let most = set.bound().most;
    let full = (total / most).floor();
    let mut field = gap.to_vec();
    set.open(&mut field, f64::INFINITY);
    // A load just below what all bear leaves no sample for the rest.
    let rank = (full as usize).min(field.len() - 1);
    let (_, &mut limit, _) = field.select_nth_unstable_by(rank, f64::total_cmp);
    field.copy_from_slice(gap);
    set.open(&mut field, f64::INFINITY);
    let mut left = total - most * field.iter().filter(|gap| **gap < limit).count() as f64;
    for value in &mut field {
        *value = if *value < limit {
            most
        } else if *value == limit {
            let own = left.clamp(0.0, most);
            left -= own;
            own
        } else {
            0.0
        };
    }
    field
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_gaps_bear_the_load() {
        let gap = [3.0, 1.0, 2.0, 2.0, 0.0];
        let set = AdmissibleSet::default().at_most(2.0);
        assert_eq!(least_work(&gap, 5.0, set), [0.0, 2.0, 1.0, 0.0, 2.0]);
        assert_eq!(least_work(&gap, 7.0, set), [0.0, 2.0, 2.0, 1.0, 2.0]);
        assert_eq!(least_work(&gap, 9.5, set), [1.5, 2.0, 2.0, 2.0, 2.0]);
        let mask = [true, false, true, true, true];
        assert_eq!(least_work(&gap, 5.0, AdmissibleSet::new(Some(&mask)).at_most(2.0)), [0.0, 0.0, 2.0, 1.0, 2.0]);
    }
}

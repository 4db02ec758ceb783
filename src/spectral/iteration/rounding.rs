//! What rounding alone makes of the criteria.
//!
//! In double precision the gap g = w + f − δ is known no better than rounding leaves the convolution w = C p and the pressure
//! itself. Where a large pressure meets small displacements (in complete contact, where most of it is uniform; under a stiff
//! coating, whose short waves take large pressures) that may be more than the tolerance asks for, and no iteration gets there.
//! How much it is is not guessed but measured: w is computed again as C(λp)/λ, λ = 0.7, in which every rounding is another one.
//! With d, what both gaps differ by,
//!
//! Σ p|d| / (δ Σp),  Σ p (|d| + max |d|) / ½⟨p, Cp⟩,  max |d| / δ
//!
//! are what rounding makes of the residual, the energy gap and the penetration outside contact of a perfect solution. An
//! iteration that advances no more while each criterion is below its tolerance, or below eight times this, has converged as far
//! as double precision carries.

use super::check::Check;
use super::problem::GridProblem;
use super::unknowns::Unknowns;
use crate::numeric::sums;

/// Multiple of what rounding makes of a criterion up to which it may have come to rest: two gaps differ by the rounding of
/// either, an iterate bears that of all its steps.
const MARGIN: f64 = 8.0;

/// λ: no power of two, so that nothing is rounded as before.
const FACTOR: f64 = 0.7;

/// Whether rounding is all that keeps a pressure from the tolerance; leaves its gap in `unknowns`.
pub(super) fn is_all_that_is_left(problem: &mut GridProblem<'_>, unknowns: &mut Unknowns) -> bool {
    let check = Check::new(problem, unknowns);
    let own = rounding(problem, unknowns, &check);
    let tolerance = problem.settings.tolerance;
    let rests = |(criterion, rounding): (f64, f64)| criterion < tolerance.max(MARGIN * rounding);
    check.criteria().into_iter().zip(own).all(rests)
}

/// The criteria of what the gap of a pressure and the same computed again differ by.
fn rounding(problem: &mut GridProblem<'_>, unknowns: &Unknowns, check: &Check) -> [f64; 3] {
    let Unknowns { pressure: p, gap: g, penetration, .. } = unknowns;
    let (f, len) = (problem.initial_gap, problem.initial_gap.len());
    let mut again: Vec<f64> = p.iter().map(|p| FACTOR * p).collect();
    problem.displacement(&mut again);
    sums::update(&mut again, |i, w| w / FACTOR + f[i] - penetration - g[i]);
    let [load, work] = sums::of(len, |i| [p[i], p[i] * again[i]]);
    // Under load control δ goes with the gap.
    let mean = if problem.load.is_mean_pressure() && load > 0.0 { work / load } else { 0.0 };
    let [complementarity] = sums::of(len, |i| [p[i] * (again[i] - mean).abs()]);
    let largest = -sums::least(len, |i| -(again[i] - mean).abs());
    Check::criteria_of([
        complementarity / (load * penetration),
        (complementarity + largest * load) / (len as f64 * check.energy),
        largest / penetration,
    ])
}

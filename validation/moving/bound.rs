//! Certificate: the stated bound against the distance from a solution of a much smaller tolerance.

use super::setup::{Stack, friction, moving, paraboloids, solved};
use super::spectrum::spectrum;
use super::strip::Strip;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use ndarray::Array2;
use percoat_core::lattice::Cell;

/// Tolerance of the solution that stands for the exact one.
const EXACT: f64 = 1e-13;
const POINTS: usize = 64;
const MEAN: f64 = 0.02;
/// Energy gap at most of the contact that the certificate solves: 20 times its tolerance.
const SOUGHT: f64 = 20.0 * 1e-14;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data =
        Data::new("bounds", &["ratio", "velocity", "tolerance", "true", "stated", "most", "mu", "mu_stated"]);
    let ratios: &[f64] = if quick { &[10.0, 1000.0] } else { &[2.0, 10.0, 100.0, 1000.0] };
    let stacks: Vec<(f64, Stack)> =
        ratios.iter().flat_map(|&r| [Stack::bare(r), Stack::soft(r), Stack::stiff(r)].map(|s| (r, s))).collect();
    let velocities: &[f64] = if quick { &[0.05] } else { &[0.01, 0.05, 0.3] };
    for (ratio, stack) in &stacks {
        for &velocity in velocities {
            data.rows.extend(rows(*ratio, stack, velocity)?);
        }
    }
    let checks = &mut outcome.checks;
    let pairs = data.rows.iter().map(|row| (row[3] / row[4], 1.0));
    checks.push(Check::worst("error of the pressure, over the stated bound", pairs, Tolerance::AtMost));
    let pairs = data.rows.iter().map(|row| (row[4] / row[5], 1.0));
    checks.push(Check::worst("stated bound, over what the error allows at most", pairs, Tolerance::AtMost));
    let pairs = data.rows.iter().map(|row| (row[6] / row[7], 1.0));
    checks.push(Check::worst("error of friction, over the stated bound", pairs, Tolerance::AtMost));
    outcome.data.push(data);
    Ok(())
}

/// Errors of three tolerances in the norm of the stored energy, over that of the pressure.
fn rows(ratio: f64, stack: &Stack, velocity: f64) -> Result<Vec<Vec<f64>>, StudyError> {
    let solution =
        |tolerance: f64| solved(moving(paraboloids()?, stack.half_space()?, velocity)?, [POINTS; 2], [MEAN, tolerance]);
    let exact = solution(EXACT)?;
    let whole = stored(stack, velocity, &exact.pressure().to_owned())?;
    let row = |tolerance: f64| -> Result<Vec<f64>, StudyError> {
        let step = solution(tolerance)?;
        let lost = stored(stack, velocity, &(&step.pressure() - &exact.pressure()))?;
        let motion = step.motion.as_ref().ok_or("nothing moves")?;
        let tangent = motion.loss_tangent;
        let error = (lost / whole).sqrt();
        // (1 + √(1 + f²)) ‖r‖ with ‖r‖ ≤ (1 + f) ‖e‖, and what the certificate's own contact misses, twice.
        let most = (1.0 + tangent.hypot(1.0)) * ((1.0 + tangent) * error + 2.0 * SOUGHT.sqrt());
        let change = (friction(&step)?.by_energy - friction(&exact)?.by_energy).abs();
        let stated = step.certificate.energy_gap.sqrt();
        Ok(vec![ratio, velocity, tolerance, error, stated, most, change, motion.bound])
    };
    [1e-4, 1e-6, 1e-8].into_iter().map(row).collect()
}

/// Σ Re K̂ |p̂|² of a field, K̂ by the dense system.
fn stored(stack: &Stack, velocity: f64, field: &Array2<f64>) -> Result<f64, StudyError> {
    let waves = spectrum(field.view(), Cell::square(1.0)?);
    let of = |([x, y], size): ([f64; 2], f64)| size * Strip::new(stack, x.hypot(y), -x * velocity).compliance().re;
    Ok(waves.into_iter().map(of).sum())
}

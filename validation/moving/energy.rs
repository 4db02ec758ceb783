//! Energy: the dissipation inside, integrated over the depth, against the power of the friction and the shares of the materials.

use super::setup::{Stack, Stuff, TOLERANCE, friction, moving, paraboloids, solved};
use super::spectrum::spectrum;
use super::strip::Strip;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::ConstantModulus;

/// Waves with less of |p̂|² than this beside the largest are left out.
const FAINT: f64 = 1e-24;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data =
        Data::new("energy", &["constant", "velocity", "inside", "friction", "by_shape", "error", "share", "known"]);
    let velocities: &[f64] = if quick { &[0.05] } else { &[0.005, 0.05, 0.5, 5.0] };
    for &velocity in velocities {
        for constant in [ConstantModulus::Bulk, ConstantModulus::Poisson] {
            data.rows.push(row(velocity, constant)?);
        }
    }
    let checks = &mut outcome.checks;
    let pairs = data.rows.iter().map(|row| (row[2], row[3]));
    checks.push(Check::worst("dissipation inside, against friction by energy", pairs, Tolerance::Relative(1e-8)));
    let pairs = data.rows.iter().map(|row| (row[6], row[7]));
    checks.push(Check::worst("share of the layer in the dissipation", pairs, Tolerance::Absolute(1e-8)));
    let pairs = data.rows.iter().map(|row| ((row[2] - row[4]).abs(), row[5]));
    let name = "dissipation inside less friction by shape, below the stated error";
    checks.push(Check::worst(name, pairs, Tolerance::AtMost));
    outcome.data.push(data);
    Ok(())
}

/// Two materials that relax, a layer at constant K or ν: coefficients from inside, by energy and by shape, and shares of the layer.
fn row(velocity: f64, constant: ConstantModulus) -> Result<Vec<f64>, StudyError> {
    let terms = vec![[6.0, 1.0], [3.0, 0.05]];
    let sheet = Stuff { terms, constant, ..Stuff::elastic(1.0, 0.4) };
    let substrate = Stuff { terms: vec![[40.0, 0.3]], constant, ..Stuff::elastic(20.0, 0.3) };
    let stack = Stack::coated(sheet, 0.05, substrate);
    let step = solved(moving(paraboloids()?, stack.half_space()?, velocity)?, [64; 2], [0.05, TOLERANCE])?;
    let reading = friction(&step)?;
    let waves = spectrum(step.pressure(), step.grid().cell());
    let largest = waves.iter().map(|wave| wave.1).fold(0.0, f64::max);
    let mut lost = [0.0; 2];
    for ([x, y], size) in waves.into_iter().filter(|wave| wave.1 > FAINT * largest && wave.0[0] != 0.0) {
        let inside = Strip::new(&stack, x.hypot(y), -x * velocity).dissipation();
        // A real wave of the amplitude c has |c|²/4 on both of its directions.
        lost.iter_mut().zip(inside).for_each(|(lost, inside)| *lost += 2.0 * size * inside);
    }
    let power = lost[0] + lost[1];
    let mean = step.pressure().mean().unwrap_or(f64::NAN);
    let share = reading.materials.first().map_or(f64::NAN, |material| material.share);
    Ok(vec![
        f64::from(constant == ConstantModulus::Poisson),
        velocity,
        power / (mean * velocity),
        reading.by_energy,
        reading.friction_coefficient,
        reading.error.unwrap_or(f64::NAN),
        share,
        lost[0] / power,
    ])
}

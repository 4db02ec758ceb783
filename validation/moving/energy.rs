//! Energy: the dissipation inside, integrated over the depth, against the power of the friction and the shares of the materials.

use super::setup::{Stack, Stuff, TOLERANCE, friction, moving, paraboloids, solved};
use super::spectrum::spectrum;
use super::strip::Strip;
use super::waves::{POINTS, stack};
use crate::random::Random;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use ndarray::Array2;
use percoat_core::body::ConstantModulus;
use percoat_core::counterbody::GivenPressure;
use percoat_core::lattice::Cell;
use percoat_core::spectral::Step;
use std::f64::consts::{PI, TAU};

/// Waves with less of |p̂|² than this beside the largest are left out.
const FAINT: f64 = 1e-24;
/// Samples along a side of the cell of the paraboloid.
const SAMPLES: usize = 64;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    given(outcome, if quick { 4 } else { 40 })?;
    let columns =
        ["constant", "velocity", "inside", "friction", "by_shape", "error", "share", "share_inside", "at_half"];
    let mut data = Data::new("energy", &columns);
    let velocities: &[f64] = if quick { &[0.05] } else { &[0.005, 0.05, 0.5, 5.0] };
    for &velocity in velocities {
        for constant in [ConstantModulus::Bulk, ConstantModulus::Poisson] {
            data.rows.push(contact(velocity, constant)?);
        }
    }
    let mut worst = |name: &str, pairs: &dyn Fn(&[f64]) -> (f64, f64), tolerance| {
        let pairs: Vec<(f64, f64)> = data.rows.iter().map(|row| pairs(row)).collect();
        outcome.checks.push(Check::worst(name, pairs, tolerance));
    };
    worst("dissipation inside, against friction by energy", &|row| (row[2], row[3]), Tolerance::Relative(1e-8));
    worst(
        "dissipation inside less friction by shape, over the stated error",
        &|row| ((row[2] - row[4]).abs() / row[5], 1.0),
        Tolerance::AtMost,
    );
    worst(
        "share of a layer below a contact, error over the part of the waves at half the samples",
        &|row| ((row[6] - row[7]).abs() / row[8], 1.0),
        Tolerance::AtMost,
    );
    outcome.data.push(data);
    Ok(())
}

/// Dissipation in each material below the pressure of a step, of waves up to the component `most` along the motion, an area's power.
fn inside(step: &Step, stack: &Stack, velocity: f64, most: f64) -> Vec<f64> {
    let waves = spectrum(step.pressure(), step.grid().cell());
    let largest = waves.iter().map(|wave| wave.1).fold(0.0, f64::max);
    let mut lost = vec![0.0; stack.sheets.len() + 1];
    let held = |([x, _], size): &([f64; 2], f64)| *size > FAINT * largest && x.abs() > 0.0 && x.abs() < most;
    for ([x, y], size) in waves.into_iter().filter(held) {
        // A real wave of the amplitude c has |c|²/4 on both of its directions.
        let of_wave = Strip::new(stack, x.hypot(y), -x * velocity).dissipation();
        lost.iter_mut().zip(of_wave).for_each(|(lost, of_wave)| *lost += 2.0 * size * of_wave);
    }
    lost
}

/// A paraboloid on two materials that relax, at constant K or ν: coefficients, shares, and the part of the waves at half the samples.
fn contact(velocity: f64, constant: ConstantModulus) -> Result<Vec<f64>, StudyError> {
    let terms = vec![[6.0, 1.0], [3.0, 0.05]];
    let sheet = Stuff { terms, constant, ..Stuff::elastic(1.0, 0.4) };
    let substrate = Stuff { terms: vec![[40.0, 0.3]], constant, ..Stuff::elastic(20.0, 0.3) };
    let stack = Stack::coated(sheet, 0.05, substrate);
    let step = solved(moving(paraboloids()?, stack.half_space()?, velocity)?, [SAMPLES; 2], [0.05, TOLERANCE])?;
    let reading = friction(&step)?;
    // Waves at half the samples along the motion go both ways: friction by energy has nothing of them.
    let half = PI * SAMPLES as f64;
    let [lost, all] = [half - PI, half + PI].map(|most| inside(&step, &stack, velocity, most));
    let [power, whole] = [&lost, &all].map(|lost| lost.iter().sum::<f64>());
    let mean = step.pressure().mean().unwrap_or(f64::NAN);
    let share = reading.materials.first().map_or(f64::NAN, |material| material.share);
    let error = reading.error.unwrap_or(f64::NAN);
    let coefficients = [power / (mean * velocity), reading.by_energy, reading.friction_coefficient, error];
    let constant = f64::from(constant == ConstantModulus::Poisson);
    Ok([&[constant, velocity], &coefficients[..], &[share, lost[0] / power, whole / power - 1.0]].concat())
}

/// Pressures of a few waves on random stacks: power and all shares.
fn given(outcome: &mut Outcome, count: usize) -> Result<(), StudyError> {
    let mut random = Random::new(5);
    let mut data = Data::new("given", &["materials", "inside", "friction", "share_error"]);
    for _ in 0..count {
        let stack = stack(&mut random);
        let waves: Vec<[f64; 3]> =
            (0..6).map(|_| [random.index(5) as f64, random.index(9) as f64 - 4.0, random.between(0.0, TAU)]).collect();
        let pressure = Array2::from_shape_fn(POINTS, |(i, j)| {
            let [s, t] = [i as f64 / POINTS[0] as f64, j as f64 / POINTS[1] as f64];
            7.0 + waves.iter().map(|[m, n, phase]| (TAU * (m * s + n * t) + phase).cos()).sum::<f64>()
        });
        let (mean, velocity) = (pressure.mean().unwrap_or(f64::NAN), random.logarithmic(0.01, 10.0));
        let given = GivenPressure::field(Cell::new([1.0, 0.0], [0.3, 0.9])?, pressure)?;
        let step = solved(moving(given, stack.half_space()?, velocity)?, POINTS, [mean, TOLERANCE])?;
        let reading = friction(&step)?;
        let lost = inside(&step, &stack, velocity, f64::INFINITY);
        let power: f64 = lost.iter().sum();
        let errors = reading.materials.iter().zip(&lost).map(|(found, lost)| (found.share - lost / power).abs());
        let error = errors.fold(0.0, f64::max);
        data.rows.push(vec![lost.len() as f64, power / (mean * velocity), reading.by_energy, error]);
    }
    let pairs = data.rows.iter().map(|row| (row[1], row[2]));
    let name = "dissipation inside below a given pressure, against friction";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(1e-8)));
    let pairs = data.rows.iter().map(|row| (row[3], 0.0));
    let name = "shares of the materials below a given pressure";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1e-8)));
    outcome.data.push(data);
    Ok(())
}

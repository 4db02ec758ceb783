//! Waves in complete contact: μ p̄ = ½ k_e D² |Im 1/K̂|, for any stack, cell and direction.

use super::setup::{Stack, Stuff, friction, moving, solved};
use super::strip::Strip;
use crate::random::Random;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{Bodies, ConstantModulus};
use percoat_core::friction::Friction;
use percoat_core::lattice::Cell;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

pub const POINTS: [usize; 2] = [24, 30];
/// Amplitude of the wave.
const HEIGHT: f64 = 1e-3;
/// Tolerance of the solver: the bound on the error of μ is near its root, and the error near itself.
const SOLVED: f64 = 1e-13;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut random = Random::new(1961);
    let mut data = Data::new("waves", &["layers", "two", "compliance", "by_shape", "by_energy", "known"]);
    for number in 0..if quick { 8 } else { 120 } {
        data.rows.push(wave(&mut random, number % 3 == 2)?);
    }
    let compliances = data.rows.iter().map(|row| (row[2], 0.0));
    outcome.checks.push(Check::worst(
        "compliance of random stacks, relative error against the dense system",
        compliances,
        Tolerance::Absolute(1e-10),
    ));
    for (column, name) in [(3, "shape"), (4, "energy")] {
        let pairs = data.rows.iter().map(|row| (row[column], row[5]));
        let name = format!("friction of waves in complete contact, by {name}");
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(1e-8)));
    }
    outcome.data.push(data);
    Ok(())
}

/// A wave on a random stack: layers, bodies, relative error of the compliance, both coefficients and the known one.
fn wave(random: &mut Random, two: bool) -> Result<Vec<f64>, StudyError> {
    let cell = Cell::new([1.0, 0.0], [random.between(-0.4, 0.4), random.between(0.7, 1.3)])?;
    let [m, n] = [1.0 + random.index(3) as f64, random.index(7) as f64 - 3.0];
    let surface = crate::steps::topography(cell, POINTS, |s, t| -HEIGHT * (TAU * (m * s + n * t)).cos())?;
    let [b1, b2] = cell.reciprocal();
    let k = [0, 1].map(|axis| m * b1[axis] + n * b2[axis]);
    let (wavenumber, angle) = (k[0].hypot(k[1]), random.between(0.0, TAU));
    let direction = [angle.cos(), angle.sin()];
    let along = k[0] * direction[0] + k[1] * direction[1];
    let velocity = random.logarithmic(1e-3, 10.0);
    let (stack, above) = (stack(random), counterbody(random));
    let mut compliance = Strip::new(&stack, wavenumber, -along * velocity).compliance();
    let mut bodies = Bodies::from(stack.half_space()?);
    if two {
        compliance += Strip::new(&above, wavenumber, 0.0).compliance();
        bodies = Bodies::elastic(stack.half_space()?, above.half_space()?);
    }
    let found = bodies.moving_compliance(k, direction.map(|e| velocity * e), [0.0; 2]);
    let mean = 3.0 * HEIGHT / compliance.norm();
    let problem = moving(surface, bodies, velocity)?.sliding(Friction::new(0.0, direction)?)?;
    let reading = friction(&solved(problem, POINTS, [mean, SOLVED])?)?;
    let known = 0.5 * along.abs() * HEIGHT * HEIGHT * (Complex64::from(1.0) / compliance).im.abs() / mean;
    let error = (found - compliance).norm() / compliance.norm();
    let counts = [stack.sheets.len() as f64, f64::from(two)];
    Ok([counts.to_vec(), vec![error, reading.friction_coefficient, reading.by_energy, known]].concat())
}

/// A material of one to three terms over four decades of time, at constant bulk modulus or Poisson's ratio.
fn stuff(random: &mut Random) -> Stuff {
    let shear = random.logarithmic(0.1, 10.0);
    let terms = (0..1 + random.index(3))
        .map(|_| [shear * random.logarithmic(0.1, 100.0), random.logarithmic(0.01, 100.0)])
        .collect();
    let constant = if random.index(2) == 0 { ConstantModulus::Bulk } else { ConstantModulus::Poisson };
    Stuff { shear, poisson: random.between(0.0, 0.49), terms, constant }
}

/// A body of materials that relax, with two layers at most and interfaces that are bonded or slide freely.
pub fn stack(random: &mut Random) -> Stack {
    let sheets =
        (0..random.index(3)).map(|_| (stuff(random), random.logarithmic(0.05, 0.5), random.index(3) == 0)).collect();
    Stack { sheets, substrate: stuff(random) }
}

fn counterbody(random: &mut Random) -> Stack {
    let stuff = |random: &mut Random| Stuff::elastic(random.logarithmic(0.1, 10.0), random.between(0.0, 0.5));
    Stack::coated(stuff(random), random.logarithmic(0.05, 0.5), stuff(random))
}

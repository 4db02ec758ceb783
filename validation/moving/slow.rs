//! Slow motion over a half-space at constant ν, μ = vτ′ ⟨∂²f/∂x²⟩ₚ with τ′ = Σ gτ/G₀, and both elastic limits in a cell.

use super::setup::{Stack, friction, moving, paraboloids, solved};
use crate::random::Random;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::counterbody::{Indenters, Level, Shape, Topography};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::problem::Problem;
use percoat_core::spectral::Step;
use std::f64::consts::TAU;

/// The law has a next term near ½ rvτ/a, here 3·10⁻⁵.
const VELOCITY: f64 = 1e-6;
const RATIO: f64 = 10.0;
/// Radius of the ball, beside which the contact is no longer small.
const BALL: f64 = 0.75;
/// Shapes and their mean pressures.
const NAMES: [&str; 3] = ["a paraboloid", "a ball", "a rough surface"];
const LOADS: [f64; 3] = [0.02, 0.1, 0.05];
const ROUGH: usize = 2;
/// Ratio of the error of the friction to the stated one at most.
const STATED: f64 = 1.0;
/// A prototype's penetration and peak on 128² samples: relaxed, and fast, glassy with the track relaxed.
const RELAXED: [f64; 2] = [0.02168015, 0.318276];
const FAST: [f64; 2] = [0.01079753, 1.079844];
const GLASSY: [f64; 2] = [0.00564150, 1.468081];

/// A wave of a rough surface: numbers along both sides, amplitude and phase.
type Wave = [f64; 4];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let sizes: &[usize] = if quick { &[64, 128] } else { &[64, 128, 256, 512] };
    let mut data = Data::new("slow", &["shape", "points", "by_shape", "by_energy", "law", "samples", "error"]);
    for shape in 0..NAMES.len() {
        for &points in sizes {
            data.rows.push(row(shape, points, [LOADS[shape], VELOCITY])?);
        }
    }
    for (shape, name) in NAMES.into_iter().enumerate() {
        let rows: Vec<&Vec<f64>> = data.rows.iter().filter(|row| row[0] == shape as f64).collect();
        // Without a symmetry the force by the shape has an error of its own, which does not vanish with the velocity.
        let columns = if shape == ROUGH { 3..4 } else { 2..4 };
        let short = rows.iter().flat_map(|row| columns.clone().map(|k| ((1.0 - row[k] / row[4]) * row[5], 0.5)));
        let label = format!("slow law, {name}: shortfall times the samples of a radius");
        outcome.checks.push(Check::worst(label, short, Tolerance::Absolute(0.5)));
        if !quick {
            let points = rows.iter().map(|row| [row[1].ln(), (1.0 - row[3] / row[4]).ln()]);
            let label = format!("slow law, {name}: order of the shortfall by energy");
            outcome.checks.push(Check::order(label, -slope(&points.collect::<Vec<_>>()), 1.0, 0.35));
        }
    }
    let rough =
        data.rows.iter().filter(|row| row[0] == ROUGH as f64).map(|row| ((row[2] - row[4]).abs() / row[6], 1.0));
    let name = "slow law, a rough surface: error of friction by shape, over the stated one";
    outcome.checks.push(Check::worst(name, rough, Tolerance::AtMost));
    outcome.data.push(data);
    stated(outcome, quick)?;
    limits(outcome)
}

/// Errors of the paraboloid's friction over those that are stated, at a dozen loads on grids of which none is twice another.
fn stated(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("stated", &["mean", "points", "by_shape", "law", "error"]);
    for points in if quick { &[64][..] } else { &[64, 96, 160, 224] } {
        for k in 0..12 {
            let mean = 0.004 * 1.25f64.powi(k);
            let row = row(0, *points, [mean, 10.0 * VELOCITY])?;
            data.rows.push(vec![mean, row[1], row[2], row[4], row[6]]);
        }
    }
    let pairs = data.rows.iter().map(|row| ((row[2] - row[3]).abs() / row[4], STATED));
    let name = "slow law: error of friction by shape, over the stated one";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::AtMost));
    outcome.data.push(data);
    Ok(())
}

/// Coefficients of both kinds, the law, and the samples along the radius of a contact.
fn row(shape: usize, points: usize, [mean, velocity]: [f64; 2]) -> Result<Vec<f64>, StudyError> {
    let body = Stack::bare(RATIO).half_space()?;
    let waves = waves();
    let problem = match shape {
        0 => moving(paraboloids()?, body, velocity)?,
        1 => moving(ball()?, body, velocity)?,
        _ => moving(rough(&waves, points)?, body, velocity)?,
    };
    let step = solved(problem, [points; 2], [mean, 1e-10])?;
    let reading = friction(&step)?;
    let law = velocity * (RATIO - 1.0) * mean_curvature(&step, shape, &waves);
    let samples = step.reading().spot_resolution;
    let error = reading.error.unwrap_or(f64::NAN);
    let shape = shape as f64;
    Ok(vec![shape, points as f64, reading.friction_coefficient, reading.by_energy, law, samples, error])
}

/// A ball in a square of the side 1.
fn ball() -> Result<Indenters, StudyError> {
    Ok(Indenters::new(Lattice::square(1.0, 1)?, vec![Level::new(Shape::Sphere { radius: BALL }, 0.0)?])?)
}

/// Waves of up to four to a side.
fn waves() -> Vec<Wave> {
    let mut random = Random::new(4);
    let numbers = (0..5).flat_map(|m| (-4..=4).map(move |n| [m, n].map(f64::from)));
    let numbers = numbers.filter(|&[m, n]| (m > 0.0 || n > 0.0) && m.hypot(n) <= 4.0);
    numbers.map(|[m, n]| [m, n, 0.01 * m.hypot(n).powf(-1.8), random.between(0.0, TAU)]).collect()
}

fn rough(waves: &[Wave], points: usize) -> Result<Topography, StudyError> {
    let height =
        |s: f64, t: f64| waves.iter().map(|[m, n, size, phase]| size * (TAU * (m * s + n * t) + phase).cos()).sum();
    crate::steps::topography(Cell::square(1.0)?, [points; 2], height)
}

/// ⟨∂²f/∂x²⟩ weighted with the pressure of a step, of the shape in closed form.
fn mean_curvature(step: &Step, shape: usize, waves: &[Wave]) -> f64 {
    let (mut force, mut sum) = (0.0, 0.0);
    let points = step.grid().points();
    for ((i, j), &p) in step.pressure().indexed_iter().filter(|(_, p)| **p > 0.0) {
        let [s, t] = [i as f64 / points[0] as f64, j as f64 / points[1] as f64];
        let [x, y] = [s - s.round(), t - t.round()];
        let curvature = match shape {
            0 => 1.0,
            1 => (BALL * BALL - y * y) / (BALL * BALL - x * x - y * y).powf(1.5),
            _ => {
                let wave =
                    |[m, n, size, phase]: &Wave| size * (TAU * m).powi(2) * (TAU * (m * s + n * t) + phase).cos();
                waves.iter().map(wave).sum()
            }
        };
        (force, sum) = (force + p, sum + p * curvature);
    }
    sum / force
}

/// Slope of a straight line through points.
pub fn slope(points: &[[f64; 2]]) -> f64 {
    let middle = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64);
    let sum = |a: usize| points.iter().map(|point| (point[0] - middle[0]) * (point[a] - middle[a])).sum::<f64>();
    sum(1) / sum(0)
}

/// A paraboloid at rest, slow, fast, and on a glassy body, against a prototype's numbers on the same samples.
fn limits(outcome: &mut Outcome) -> Result<(), StudyError> {
    let read = |problem: Problem| -> Result<[f64; 2], StudyError> {
        let step = solved(problem, [128; 2], [0.02, 1e-10])?;
        Ok([step.penetration(), step.pressure().iter().copied().fold(0.0, f64::max)])
    };
    let body = || Stack::bare(RATIO).half_space();
    let glass = Stack { sheets: Vec::new(), substrate: super::setup::Stuff::elastic(RATIO, 0.3) };
    let slow = read(moving(paraboloids()?, body()?, 1e-9)?)?;
    let fast = read(moving(paraboloids()?, body()?, 1e9)?)?;
    let rest = read(Problem::new(paraboloids()?, body()?))?;
    let glassy = read(Problem::new(paraboloids()?, glass.half_space()?))?;
    let pairs = [(rest, RELAXED), (slow, RELAXED), (fast, FAST), (glassy, GLASSY)];
    for (name, of, digit) in [("penetration", 0, 1e-8), ("peak", 1, 2e-6)] {
        let pairs = pairs.iter().map(|(found, known)| (found[of], known[of]));
        outcome.checks.push(Check::worst(format!("limits of the velocity: {name}"), pairs, Tolerance::Absolute(digit)));
    }
    let pairs = [0, 1].map(|of| (slow[of], rest[of]));
    let name = "slow contact, against the relaxed one at rest";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(1e-7)).of_refinement());
    Ok(())
}

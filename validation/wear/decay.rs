//! A wave of the shape in complete contact on layers: what implicit steps, those of a path and the exponential leave of it.

use crate::alone::{LayerOf, half_space};
use crate::steps::{Steps, topography};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use ndarray::Array2;
use percoat_core::body::HalfSpace;
use percoat_core::body::Interface::Bonded;
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::run::{PathEnd, WearPath};
use percoat_core::spectral::Wear;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2, TAU};
use std::ops::ControlFlow;

const DECAY: &str = include_str!("decay.csv");
pub const NAMES: [&str; 3] = ["hard", "soft", "incompressible"];
const LAYERS: [LayerOf; 3] = [(0.1, 5.0, 0.2, Bonded), (0.2, 0.1, 0.3, Bonded), (0.15, 0.3, 0.5, Bonded)];
/// Waves along both sides of a square cell of side 1, by q/2π squared.
const WAVES: [(f64, [f64; 2]); 3] = [(1.0, [1.0, 0.0]), (2.0, [1.0, 1.0]), (9.0, [3.0, 0.0])];
const POINTS: [usize; 2] = [24, 24];
const AMPLITUDE: f64 = 0.01;
/// Error by rounding and the solver's tolerance, 10⁻¹³, of a factor of at most 1, and of a compliance.
const ROUNDING: f64 = 1e-12;
/// Path and numbers of steps of the orders.
const PATH: f64 = 0.02;
const STEPS: [u32; 4] = [4, 8, 16, 32];
/// Tolerance of a path that is one step: the error of it is a part of 0.04 (ks/nĈ)³ of the depth.
const ONE_STEP: f64 = 1.0;

fn body(number: usize) -> Result<HalfSpace, StudyError> {
    half_space(&[LAYERS[number]], [1.0, 0.3])
}

fn wave(q: f64) -> Result<[f64; 2], StudyError> {
    let square = (q / TAU).powi(2).round();
    WAVES.iter().find(|(known, _)| *known == square).map(|(_, wave)| *wave).ok_or_else(|| "no such wave".into())
}

/// The amplitude of a wave in a field.
fn amplitude(field: &Array2<f64>, [k1, k2]: [f64; 2]) -> f64 {
    let cosine =
        |(i, j): (usize, usize)| (TAU * (k1 * i as f64 / POINTS[0] as f64 + k2 * j as f64 / POINTS[1] as f64)).cos();
    field.indexed_iter().map(|(place, value)| value * cosine(place)).sum::<f64>() * 2.0 / field.len() as f64
}

/// A wave, and twice the mean pressure of complete contact.
fn contact(number: usize, wave: [f64; 2], compliance: f64) -> Result<(Steps, Load), StudyError> {
    let surface = topography(Cell::square(1.0)?, POINTS, |u, v| AMPLITUDE * (TAU * (wave[0] * u + wave[1] * v)).cos())?;
    let steps = Steps::to(Problem::new(surface, body(number)?), POINTS, 1e-13)?;
    Ok((steps, Load::MeanPressure(2.0 * AMPLITUDE / compliance)))
}

/// k = 1 of the counterbody.
fn unit() -> Result<Wear, StudyError> {
    Ok(Wear::new(0.0, 1.0, [1.0, 0.0])?)
}

/// Parts of the wave that n implicit steps over a distance leave in the shape and in the pressure.
fn left(number: usize, q: f64, compliance: f64, path: f64, n: u32) -> Result<[f64; 2], StudyError> {
    let wave = wave(q)?;
    let (mut steps, load) = contact(number, wave, compliance)?;
    let (wear, mut last) = (unit()?, None);
    for _ in 0..n {
        last = Some(steps.solver.wear(load, &wear, path / f64::from(n))?);
    }
    let step = last.filter(|step| step.report.stop.solved()).ok_or("a step was not solved")?;
    let shape = amplitude(&step.surface().initial_gap().to_owned(), wave) / -AMPLITUDE;
    let pressure = amplitude(&step.pressure().to_owned(), wave) / (AMPLITUDE / compliance);
    Ok([shape, pressure])
}

/// Part of the wave that n equal steps of a path leave in the shape.
fn left_by_path(number: usize, q: f64, compliance: f64, path: f64, n: u32) -> Result<f64, StudyError> {
    let wave = wave(q)?;
    let (mut steps, load) = contact(number, wave, compliance)?;
    let wear = unit()?;
    for _ in 0..n {
        let wear_path = WearPath::new(load, wear, path / f64::from(n), ONE_STEP)?;
        let worn = wear_path.slide(&mut steps.solver, &mut |_, _| ControlFlow::Continue(()))?;
        if worn.end != PathEnd::Complete || worn.steps.len() != 1 {
            return Err(format!("not one step: {worn:?}").into());
        }
    }
    Ok(amplitude(&steps.solver.surface().initial_gap().to_owned(), wave) / -AMPLITUDE)
}

/// Part of a wave that a step of a path, TR-BDF2, leaves, in closed form; x = k Δs/Ĉ.
fn of_path(x: f64) -> f64 {
    (1.0 - (SQRT_2 - 1.0) * x) / (1.0 + (1.0 - FRAC_1_SQRT_2) * x).powi(2)
}

/// Every row of the table.
pub fn decay(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new("decay", &["layer", "q", "ks", "n", "shape", "pressure", "implicit", "exponential"]);
    let [mut compliances, mut factors] = [const { Vec::new() }; 2];
    for row in Data::parse_named("decay", DECAY, &NAMES)?.rows {
        let &[number, q, compliance, path, exact, n, implicit] = &row[..] else { return Err("a row too short".into()) };
        compliances.push((body(number as usize)?.response().compliance(q), compliance));
        let [shape, pressure] = left(number as usize, q, compliance, path, n as u32)?;
        factors.extend([(shape, implicit), (pressure, implicit)]);
        data.rows.push(vec![number, q, path, n, shape, pressure, implicit, exact]);
    }
    outcome.checks.extend([
        Check::worst("waves: compliance Ĉ", compliances, Tolerance::Relative(ROUNDING)),
        Check::worst("waves: left of shape and pressure, (1 + ks/nĈ)⁻ⁿ", factors, Tolerance::Absolute(ROUNDING)),
    ]);
    Ok(data)
}

/// Errors of implicit steps and of those of a path against the exponential, and their orders in 1/n.
pub fn orders(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new("orders", &["layer", "n", "error", "error_of_path", "q"]);
    let [mut first, mut second, mut factors] = [const { Vec::new() }; 3];
    for row in Data::parse_named("decay", DECAY, &NAMES)?.rows {
        let &[number, q, compliance, path, exact, n, _] = &row[..] else { return Err("a row too short".into()) };
        // One row of each wave.
        if path != PATH || n != 1.0 {
            continue;
        }
        let mut errors = Vec::new();
        for n in STEPS {
            let implicit = left(number as usize, q, compliance, path, n)?[0];
            let by_path = left_by_path(number as usize, q, compliance, path, n)?;
            factors.push((by_path, of_path(path / compliance / f64::from(n)).powi(n as i32)));
            errors.push([implicit, by_path].map(|left| left / exact - 1.0));
        }
        let order = |k: usize| (errors[2][k] / errors[3][k]).log2();
        first.push((order(0), 1.0));
        second.push((order(1), 2.0));
        if (q - TAU).abs() < 1e-9 {
            data.rows
                .extend(STEPS.iter().zip(&errors).map(|(n, error)| vec![number, f64::from(*n), error[0], error[1], q]));
        }
    }
    // ½ (ks/Ĉ)²/n and 0.04 (ks/Ĉ)³/n², and terms of the next power of 1/n: a tenth with 16 and 32 steps and ks/Ĉ up to 1.
    outcome.checks.extend([
        Check::worst("waves: order toward e^{−ks/Ĉ} in 1/n", first, Tolerance::Order(0.1)),
        Check::worst("waves, steps of a path: left of the shape", factors, Tolerance::Absolute(ROUNDING)),
        Check::worst("waves, steps of a path: order toward e^{−ks/Ĉ} in 1/n", second, Tolerance::Order(0.1)),
    ]);
    Ok(data)
}

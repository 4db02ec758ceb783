//! Closed forms in time: a penetration that is held, and a wave in complete contact.
//!
//! At constant ν the area of a held penetration stays, and the force falls as G(t)/G(0). A wave D cos kx in complete contact has the amplitude
//! kD G(t)/(1 − ν). Both are exact only in the limit of short steps, whose error is of second order.

use super::setup::{POISSON, Stuff, advanced, in_time, solved, surface};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use std::f64::consts::TAU;

/// g and τ beside the relaxed modulus 1.
const TERMS: [[f64; 2]; 2] = [[3.0, 1.0], [2.0, 0.2]];
const TIMES: [f64; 5] = [0.0, 0.1, 0.5, 2.0, 10.0];
const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-4];
const HELD: f64 = 0.01;
const HEIGHT: f64 = 1e-3;

/// G(t)/G(relaxed).
pub fn modulus(time: f64) -> f64 {
    1.0 + TERMS.iter().map(|[g, tau]| g * (-time / tau).exp()).sum::<f64>()
}

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns = ["wave", "tolerance", "time", "value", "exact", "stated"];
    let mut data = Data::new("relaxing", &columns);
    for &tolerance in if quick { &TOLERANCES[..2] } else { &TOLERANCES[..] } {
        data.rows.extend(held(tolerance)?);
        data.rows.extend(wave(tolerance)?);
    }
    // A path of a few steps, each with the tolerance, and a grid whose solver ends at 10⁻⁸.
    let of = |wave: f64| {
        let rows = data.rows.iter().filter(move |row| row[0] == wave);
        rows.map(|row| ((row[3] / row[4] - 1.0) / (10.0 * row[1]), 0.0)).collect::<Vec<_>>()
    };
    let name = "force of a held penetration by G(t), over ten tolerances of a step";
    outcome.checks.push(Check::worst(name, of(0.0), Tolerance::Absolute(1.0)));
    let name = "wave in complete contact by G(t), over ten tolerances of a step";
    outcome.checks.push(Check::worst(name, of(1.0), Tolerance::Absolute(1.0)));
    let stated = data.rows.iter().filter(|row| row[0] == 0.0);
    let stated = stated.map(|row| ((row[3] - row[4]).abs() / (row[5] + 2e-8 * row[4]), 1.0));
    let name = "force of a held penetration, true error over the stated one";
    outcome.checks.push(Check::worst(name, stated, Tolerance::AtMost));
    outcome.data.push(data);
    order(outcome, quick)
}

/// Force over that of the relaxed body; its stated error is that of the pressure over the largest force.
fn held(tolerance: f64) -> Result<Vec<Vec<f64>>, StudyError> {
    let problem = Problem::new(surface(0)?, Stuff::simple(&TERMS).half_space()?);
    let relaxed = solved(problem.clone(), [64; 2], Load::Penetration(HELD))?.reading().force;
    let mut creeps = in_time(&problem, [64; 2], tolerance)?;
    let row = |time: f64| -> Result<Vec<f64>, StudyError> {
        let step = advanced(&mut creeps, time, Load::Penetration(HELD))?;
        let stated = step.error.map_or(f64::NAN, |error| error.pressure) * modulus(0.0);
        Ok(vec![0.0, tolerance, time, step.contact.reading().force / relaxed, modulus(time), stated])
    };
    TIMES.into_iter().map(row).collect()
}

/// Amplitude of the pressure over kD G/(1 − ν) of the relaxed body.
fn wave(tolerance: f64) -> Result<Vec<Vec<f64>>, StudyError> {
    let waves = crate::steps::topography(Cell::square(1.0)?, [32; 2], |s, _| HEIGHT * (TAU * s).cos())?;
    let problem = Problem::new(waves, Stuff::simple(&TERMS).half_space()?);
    let (mut creeps, mean) = (in_time(&problem, [32; 2], tolerance)?, 0.1);
    let row = |time: f64| -> Result<Vec<f64>, StudyError> {
        let step = advanced(&mut creeps, time, Load::MeanPressure(mean))?.contact;
        let amplitude = step.pressure().iter().copied().fold(0.0, f64::max) - mean;
        let relaxed = TAU * HEIGHT / (1.0 - POISSON);
        Ok(vec![1.0, tolerance, time, amplitude / relaxed, modulus(time), f64::NAN])
    };
    TIMES.into_iter().map(row).collect()
}

/// Order of equal steps under a held penetration, against G(t).
fn order(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let problem = Problem::new(surface(0)?, Stuff::simple(&TERMS).half_space()?);
    let relaxed = solved(problem.clone(), [48; 2], Load::Penetration(HELD))?.reading().force;
    let mut data = Data::new("orders", &["steps", "force", "exact"]);
    for steps in if quick { [8, 16, 32] } else { [16, 32, 64] } {
        let mut creeps = in_time(&problem, [48; 2], f64::INFINITY)?;
        let mut force = f64::NAN;
        for n in 0..=steps {
            let step = advanced(&mut creeps, f64::from(n) / f64::from(steps), Load::Penetration(HELD))?;
            force = step.contact.reading().force / relaxed;
        }
        data.rows.push(vec![f64::from(steps), force, modulus(1.0)]);
    }
    let error = |row: usize| (data.rows[row][1] - data.rows[row][2]).abs();
    let orders = [0, 1].map(|row| ((error(row) / error(row + 1)).log2(), 2.0));
    let name = "order of the steps under a held penetration";
    outcome.checks.push(Check::worst(name, orders, Tolerance::Order(0.2)));
    outcome.data.push(data);
    Ok(())
}

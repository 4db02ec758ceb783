//! Steady rolling: waves of a dense solution, Carter's cylinders, and Kalker's balls that do not slip.

use super::setup::{ball, half_space, like, rubbing, solver, wave};
use super::waves::MEAN;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::spectral::{Rolling, RollingDrive, SlipSolver};
use std::f64::consts::{PI, TAU};

const ROLLING: &str = include_str!("rolling.csv");
const POINTS: usize = 1024;
/// Steps of a sixteenth of the contact, and half as long ones: extrapolated, a prototype has them within .25 %.
const ROLLED: Rolling = Rolling { direction: [1.0, 0.0], distance: 3.0, step: 1.0 / 16.0 };
const CREEPAGE: f64 = 2.5e-3;
/// Carter: contact radius over the wavelength, and the points for 82 samples to it.
const CARTER: (f64, usize) = (0.02, 4096);
/// ν, and C₁₁ of a circular contact (Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, 1990).
const KALKER: [(f64, f64); 2] = [(0.0, 3.40), (0.25, 4.12)];

/// Creepage along the way, with its error.
fn creepage(solver: &mut SlipSolver, load: Load, part: f64) -> Result<[f64; 2], StudyError> {
    let step = solver.roll(load, RollingDrive::Part([part, 0.0]), ROLLED)?;
    let found = step.creepage.filter(|_| step.converged).ok_or("it does not roll")?;
    Ok([found.value[0], found.error])
}

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let mut data = Data::new("rolling", &["chi", "nu", "h", "part", "creepage", "creepage_error", "creepage_exact"]);
    for row in Data::parse("rolling", ROLLING)?.rows {
        let [chi, nu, h, part, _, exact] = row[..] else { return Err("a wave that rolls has six numbers".into()) };
        if quick && (part != 0.6 || chi != 4.0) {
            continue;
        }
        let [found, error] = creepage(&mut wave([chi, nu, h], POINTS)?, Load::MeanPressure(MEAN), part)?;
        data.rows.push(vec![chi, nu, h, part, found, error, exact]);
    }
    let pairs = data.column("creepage").into_iter().zip(data.column("creepage_exact"));
    outcome.checks.push(Check::worst("waves that roll: creepage", pairs, Tolerance::Relative(CREEPAGE)));
    let stated = data.rows.iter().map(|row| ((row[4] - row[6]).abs() / row[5], 1.0));
    outcome.checks.push(Check::worst(
        "waves that roll: error of the creepage over the stated one",
        stated,
        Tolerance::AtMost,
    ));
    outcome.data.push(data);
    if quick {
        return Ok(());
    }
    carter(outcome)?;
    kalker(outcome)
}

/// Carter (Proc. R. Soc. A 112 (1926) 151): creepage (μa/R)(1 − √(1 − Q/μP)) of like cylinders, here the crests of a wave, whose curvature is .01 (2π)².
fn carter(outcome: &mut Outcome) -> Result<(), StudyError> {
    let (radius, points) = CARTER;
    // E* = G/(1 − ν) = 1/.7 for the bodies of the waves, p* = πE*Δ, p̄ = p* sin²πa.
    let curvature = 0.01 * TAU * TAU;
    // With Poisson's ratio .3 of the waves: 1/E* = 2(1 − ν)/(2G).
    let load = Load::MeanPressure(PI / 0.7 * 0.01 * (PI * radius).sin().powi(2));
    let mut pairs = Vec::new();
    for part in [0.3, 0.6, 0.9] {
        let [found, _] = creepage(&mut wave([0.0; 3], points)?, load, part)?;
        pairs.push((found, radius * curvature * (1.0 - (1.0f64 - part).sqrt())));
    }
    // The neighbours change it by the order of (πa)² = .4 %.
    let tolerance = CREEPAGE + (PI * radius).powi(2);
    outcome.checks.push(Check::worst("cylinders that roll, Carter: creepage", pairs, Tolerance::Relative(tolerance)));
    Ok(())
}

/// Q = C₁₁Ga²ξ without slip, of the ball of the radius 1 with a = 1. The traction at the trailing end is infinite: steps are of the order ½ instead
/// of 1, and so extrapolated.
fn kalker(outcome: &mut Outcome) -> Result<(), StudyError> {
    const SAMPLES: f64 = 28.0;
    let columns = ["nu", "coarse", "fine", "fine_error", "extrapolated", "exact"];
    let mut data = Data::new("kalker", &columns);
    for (poisson, exact) in KALKER {
        let force = 4.0 / 3.0 / (1.0 - poisson);
        let window = 2.6;
        let points = 2 * (0.5 * window * SAMPLES).round() as usize;
        let problem = rubbing(ball(Cell::window([window; 2])?)?, like(half_space(&[], poisson)?), 100.0)?;
        let creepage = 1e-3;
        let rolled = |step: f64| -> Result<[f64; 2], StudyError> {
            let rolling = Rolling { distance: 2.5, step, ..ROLLED };
            let drive = RollingDrive::Creepage([creepage, 0.0]);
            let force = solver(problem.clone(), [points; 2])?.roll(Load::Force(force), drive, rolling)?.force;
            Ok([force.value[0] / creepage, force.error / creepage])
        };
        let ([coarse, _], [fine, error]) = (rolled(2.0 * ROLLED.step)?, rolled(ROLLED.step)?);
        let extrapolated = fine + (fine - coarse) / (2.0f64.sqrt() - 1.0);
        data.rows.push(vec![poisson, coarse, fine, error, extrapolated, exact]);
    }
    let pairs = |name: &str| data.column(name).into_iter().zip(data.column("exact")).collect::<Vec<_>>();
    // The table has three digits: half of the last one is 1.5e-3, and steps of the next order leave as much.
    outcome.checks.push(Check::worst(
        "balls that do not slip, Kalker: C₁₁ extrapolated",
        pairs("extrapolated"),
        Tolerance::Relative(5e-3),
    ));
    let orders = data.rows.iter().map(|row| (((row[1] - row[5]) / (row[2] - row[5])).log2(), 0.5));
    outcome.checks.push(Check::worst(
        "the same: order of the steps",
        orders.collect::<Vec<_>>(),
        Tolerance::Absolute(0.1),
    ));
    outcome.data.push(data);
    Ok(())
}

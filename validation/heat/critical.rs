//! The state from which on no steady contact is unique: swelling takes all of the compliance of a wave.

use super::depth::Wave;
use super::setup::{Sheet, Stack, Stuff, paraboloid, sliding};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::heating::Heating;
use percoat_core::load::Load;
use percoat_core::reading::TemperatureReading;
use percoat_core::spectral::{Settings, Solver, Stop};
use std::f64::consts::TAU;

/// V = 2λk(1 − ν)/(μαE) of E = λ = α = 1, ν = 0.3, μ = 0.5 in a cell of the side 1: six decimals of another program.
const CRITICAL: f64 = 17.592919;
const FRICTION: f64 = 0.5;
/// A diffusivity at which the motion carries nothing along.
const STILL: f64 = 1e12;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let closed = 2.0 * TAU * 0.7 / FRICTION;
    outcome.checks.push(Check::absolute("closed form of the critical velocity", closed, CRITICAL, 5e-7));
    let mut data = Data::new("critical", &["diffusivity", "points", "part", "taken", "unique"]);
    let (sizes, parts) = (if quick { &[32, 45][..] } else { &[32, 45, 64, 105] }, [0.5, 0.9, 0.99, 1.01, 1.5]);
    for diffusivity in [STILL, 1.0] {
        for &points in sizes {
            for part in parts {
                data.rows.push(row(diffusivity, points, part * closed)?);
                let last = data.rows.len() - 1;
                data.rows[last][2] = part;
            }
        }
    }
    let taken = data.rows.iter().map(|row| (row[3], row[2]));
    outcome.checks.push(Check::worst(
        "part of the compliance that swelling takes, V/V_cr",
        taken,
        Tolerance::Relative(1e-9),
    ));
    let verdicts = data.rows.iter().map(|row| (row[4], f64::from(u8::from(row[2] < 1.0))));
    let name = "solved below V_cr, refused above, from 0.99 to 1.01";
    outcome.checks.push(Check::worst(name, verdicts, Tolerance::Absolute(0.0)));
    outcome.data.push(data);
    layered(outcome, quick)
}

fn solver(stack: &Stack, velocity: f64, points: usize) -> Result<Solver, StudyError> {
    let motion = [FRICTION, velocity];
    let problem = sliding(paraboloid(1.0, 1.0)?, stack.half_space()?, motion, Heating::default())?;
    Ok(Solver::new(problem, [points; 2], Settings::default())?)
}

/// Diffusivity, samples, 0, part taken, and whether the contact is solved.
fn row(diffusivity: f64, points: usize, velocity: f64) -> Result<Vec<f64>, StudyError> {
    let stack = Stack::bare(Stuff::new(1.0, [1.0, diffusivity, 1.0]));
    let mut solver = solver(&stack, velocity, points)?;
    let taken = 1.0 - solver.left_by_heat();
    let step = solver.solve(Load::MeanPressure(0.01));
    let unique = match step.report.stop {
        Stop::NotUnique => 0.0,
        _ if step.report.stop.solved() => {
            let read = TemperatureReading::of(&step).ok_or("nothing heats")?.criticality;
            if (read - taken).abs() < 1e-12 { 1.0 } else { f64::NAN }
        }
        _ => f64::NAN,
    };
    Ok(vec![diffusivity, points as f64, 0.0, taken, unique])
}

/// Stacks: the largest of −μv Re Ŵ/K̂ over the waves of the grid, both by integration through the depth.
fn layered(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let coat = |conductivity, expansion, thickness| Stack {
        sheets: vec![Sheet::bonded(Stuff::new(5.0, [conductivity, 0.3, expansion]), thickness)],
        ..Stack::bare(Stuff::new(1.0, [1.0, 1.0, 1.0]))
    };
    let mut resisting = coat(0.2, 0.5, 0.1);
    resisting.sheets[0].resistance = 0.3;
    let stacks = [coat(20.0, 0.3, 0.05), coat(0.05, 2.0, 0.05), resisting];
    let points = if quick { 9 } else { 17 };
    let mut pairs = Vec::new();
    for (stack, velocity) in stacks.iter().flat_map(|stack| [0.3, 3.0].map(|velocity| (stack, velocity))) {
        let found = 1.0 - solver(stack, velocity, points)?.left_by_heat();
        let half = points as i32 / 2;
        let waves = (-half..=half).flat_map(|m| (-half..=half).map(move |n| [TAU * f64::from(m), TAU * f64::from(n)]));
        let taken = waves.filter(|k| k[0] != 0.0 || k[1] != 0.0).map(|k| {
            let compliance = Wave::new(stack, k, velocity, [1.0, 0.0]).at(1, 0.0)[4].re;
            -FRICTION * velocity * Wave::new(stack, k, velocity, [0.0, 1.0]).at(1, 0.0)[4].re / compliance
        });
        pairs.push((found, taken.fold(f64::NEG_INFINITY, f64::max)));
    }
    let name = "part taken on coated bodies, against integration through the depth";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(1e-9)));
    Ok(())
}

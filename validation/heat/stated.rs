//! Heat and its balance, and stated errors of temperatures against fine grids.

use super::setup::{Sheet, Stack, Stuff, heat, paraboloid, sliding, solved};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::Bodies;
use percoat_core::heating::{Heating, Partition};
use percoat_core::load::Load;
use percoat_core::reading::TemperatureReading;
use percoat_core::spectral::Step;

/// Names of the cases.
const NAMES: [&str; 6] = [
    "bare",
    "thin conducting coat",
    "thin insulating coat",
    "coat with a resistance",
    "two bodies",
    "two coated bodies",
];
const SPEEDS: [f64; 2] = [0.5, 20.0];
/// Sizes of the grids, and the one that counts as exact.
const SIZES: [usize; 9] = [32, 45, 64, 75, 90, 125, 128, 135, 192];
const FINEST: usize = 512;
const FRICTION: f64 = 0.3;
const PRESSURE: f64 = 0.02;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns = ["case", "velocity", "expands", "points", "quantity", "value", "stated", "exact"];
    let mut data = Data::new("stated", &columns);
    let (mut power, mut balance) = (Vec::new(), Vec::new());
    let (cases, finest) = if quick { (&[0, 4][..], 256) } else { (&[0, 1, 2, 3, 4, 5][..], FINEST) };
    let sizes = if quick { &[32, 45, 64][..] } else { &SIZES[..] };
    for (&case, velocity) in cases.iter().flat_map(|case| SPEEDS.map(|velocity| (case, velocity))) {
        for expands in [false, true] {
            let exact = quantities(&step(case, velocity, expands, finest)?)?;
            for &points in sizes {
                let step = step(case, velocity, expands, points)?;
                power.push(powers(&step, velocity)?);
                balance.push((unbalanced(&step)?, 0.0));
                for (number, ([value, error], [exact, _])) in quantities(&step)?.into_iter().zip(&exact).enumerate() {
                    let row = [case as f64, velocity, f64::from(u8::from(expands)), points as f64, number as f64];
                    data.rows.push([&row[..], &[value, error, *exact]].concat());
                }
            }
        }
    }
    outcome.checks.push(Check::worst("heat of a cell, over μPv", power, Tolerance::Relative(1e-12)));
    let name = "heat of both bodies less that of friction, over the largest";
    outcome.checks.push(Check::worst(name, balance, Tolerance::Absolute(1e-12)));
    for (number, name) in ["largest temperature", "mean temperature in contact", "share"].into_iter().enumerate() {
        outcome.checks.push(holding(&data, name, |row| row[4] == number as f64));
    }
    outcome.checks.push(holding(&data, "largest temperature of each material", |row| row[4] >= 3.0));
    outcome.data.push(data);
    Ok(())
}

/// The largest true error over the stated one of all rows.
fn holding(data: &Data, name: &str, is: impl Fn(&[f64]) -> bool) -> Check {
    let rows = data.rows.iter().filter(|row| is(row) && row[5] != row[7]);
    let worst = rows.map(|row| (row[5] - row[7]).abs() / (row[6] + 1e-12 * row[7].abs())).fold(0.0, f64::max);
    Check::at_most(format!("{name}, true error over the stated one, worst row"), worst, 1.0)
}

/// A paraboloid in a square of the side 1 on a body, E = 1, with expansion as it is given.
fn step(case: usize, velocity: f64, expands: bool, points: usize) -> Result<Step, StudyError> {
    let stack = |sheet: Option<([f64; 3], f64, f64)>, substrate: [f64; 3]| Stack {
        sheets: sheet
            .map(|(heat, thickness, resistance)| Sheet {
                resistance,
                ..Sheet::bonded(Stuff::new(3.0, heat), thickness)
            })
            .into_iter()
            .collect(),
        ..Stack::bare(Stuff::new(1.0, substrate))
    };
    let (plain, thin) = ([1.0, 1.0, 0.3], 0.02);
    let below = match case {
        1 => stack(Some(([30.0, 3.0, 0.3], thin, 0.0)), plain),
        2 | 5 => stack(Some(([0.05, 0.3, 0.3], thin, 0.0)), plain),
        3 => stack(Some(([1.0, 1.0, 0.3], thin, 0.2)), plain),
        _ => stack(None, plain),
    };
    let above = match case {
        4 => Some(stack(None, [3.0, 1.0, 0.1])),
        5 => Some(stack(Some(([30.0, 3.0, 0.3], thin, 0.0)), plain)),
        _ => None,
    };
    let body = below.half_space()?;
    let bodies = match above {
        Some(above) => Bodies::elastic(body, above.half_space()?),
        None => body.into(),
    };
    let heating = Heating::new(Partition::Solved, [0.0; 2])?;
    let heating = if expands { heating } else { heating.without_expansion() };
    let problem = sliding(paraboloid(1.0, 1.0)?, bodies, [FRICTION, velocity], heating)?;
    solved(problem, [points; 2], Load::MeanPressure(PRESSURE))
        .map_err(|error| format!("{}, v = {velocity}, {points}² samples: {error}", NAMES[case]).into())
}

/// Values with their stated errors: the largest temperature, the mean one, the share where there are two bodies, then those of the materials.
fn quantities(step: &Step) -> Result<Vec<[f64; 2]>, StudyError> {
    let reading = TemperatureReading::of(step).ok_or("nothing heats")?;
    let stated = |error: Option<f64>| error.unwrap_or(f64::INFINITY);
    let share = if heat(step)?.counterbody.is_some() { reading.counterbody_share } else { 0.0 };
    let whole = [
        [reading.max, stated(reading.max_error)],
        [reading.mean_in_contact, stated(reading.mean_error)],
        [share, stated(reading.share_error)],
    ];
    let materials = reading.materials.iter().map(|of| [of.value, stated(of.error)]);
    Ok(whole.into_iter().chain(materials).collect())
}

/// Heat of a cell by percoat, and μPv with the force of its pressures.
fn powers(step: &Step, velocity: f64) -> Result<(f64, f64), StudyError> {
    let reading = TemperatureReading::of(step).ok_or("nothing heats")?;
    Ok((reading.power, FRICTION * velocity * PRESSURE * step.grid().cell().area()))
}

/// Share of the body and of the counterbody of all flux, less 1, and fluxes where nothing touches.
fn unbalanced(step: &Step) -> Result<f64, StudyError> {
    let heat = heat(step)?;
    let [below, whole] = heat.flux.iter().zip(&heat.friction).fold([0.0; 2], |[b, w], (q, all)| [b + q, w + all]);
    let outside: f64 = heat.flux.iter().zip(&heat.friction).filter(|(_, all)| **all == 0.0).map(|(q, _)| q.abs()).sum();
    Ok((below / whole - heat.share).abs() + outside / whole)
}

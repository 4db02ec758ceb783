//! A wave that adheres, and its loop.

use super::setup::{adhering, advance, solver, unit};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use std::f64::consts::TAU;

/// Samples of a wave along the direction in which nothing changes.
const ROWS: usize = 4;
/// Strength with pull-off over E*: Bilby, Cottrell & Swinden with Westergaard's contact.
const PULL_OFFS: [[f64; 2]; 2] = [[0.2, -0.02234996], [0.4, -0.02243307]];
/// Parts in contact, and with the zone that pulls, at no load for the strength 0.2.
const PARTS: [f64; 2] = [0.36155157, 0.42027861];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let sizes: &[usize] = if quick { &[256] } else { &[256, 512, 1024] };
    let mut data =
        Data::new("waves", &["strength", "points", "contact", "pulls", "force", "force_exact", "iterations"]);
    for [strength, exact] in PULL_OFFS.into_iter().take(if quick { 1 } else { 2 }) {
        for &points in sizes {
            let cell = Cell::new([1.0, 0.0], [0.0, ROWS as f64 / points as f64])?;
            let height = |s: f64, _: f64| 0.05 * ((TAU * s).cos() - 1.0);
            let surface = crate::steps::topography(cell, [points, ROWS], height)?;
            let problem = adhering(surface, unit()?, [0.002, 0.002 / strength])?;
            let mut solver = solver(problem, [points, ROWS])?;
            let area = ROWS as f64 / points as f64;
            let first = advance(&mut solver, Load::MeanPressure(0.0))?;
            let mut iterations = first.contact.report.iterations;
            let mut last = None;
            for k in 0..=80 {
                let load = Load::Grip { position: 0.016 - 0.001 * f64::from(k), stiffness: 2.0 * area };
                let step = advance(&mut solver, load)?;
                if step.jumps.is_empty() {
                    iterations = iterations.max(step.contact.report.iterations);
                }
                last = step.pull_off;
                if last.is_some() {
                    break;
                }
            }
            let found = last.ok_or("the force does not rise again")?;
            let numbers = first.numbers;
            let parts = [numbers.contact_area, numbers.contact_area + numbers.cohesive_area].map(|part| part / area);
            data.rows.push(vec![
                strength,
                points as f64,
                parts[0],
                parts[1],
                found.force / area,
                exact,
                iterations as f64,
            ]);
        }
    }
    let held = data.rows.iter().filter(|row| row[0] == 0.2 && row[1] == 256.0);
    let parts = held.clone().flat_map(|row| [(row[2], PARTS[0]), (row[3], PARTS[1])]);
    outcome.checks.push(Check::worst("parts of a wave that touch and pull", parts, Tolerance::Absolute(2.0 / 256.0)));
    let forces = held.map(|row| (row[4], row[5]));
    outcome.checks.push(Check::worst("pull-off of a wave, 256 points", forces, Tolerance::Relative(2e-3)));
    if !quick {
        let finest = data.rows.iter().filter(|row| row[1] == 1024.0).map(|row| (row[4], row[5]));
        outcome.checks.push(Check::worst("pull-off of waves, 1024 points", finest, Tolerance::Relative(1e-3)));
    }
    outcome.data.push(data);
    Ok(())
}

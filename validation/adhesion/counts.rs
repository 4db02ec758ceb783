//! Iterations of a state on a path, from coarse to fine grids: smooth and rough contacts.

use super::setup::{adhering, advance, ball, layer, solver};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::counterbody::Topography;
use percoat_core::counterbody::roughness::{Rms, SelfAffine};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;

/// Names of the cases.
pub const NAMES: [&str; 4] = ["ball", "ball on a stiff layer", "rough", "rough on a soft layer"];
const SIZES: [usize; 4] = [64, 128, 256, 512];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let sizes = if quick { &SIZES[..1] } else { &SIZES[..] };
    let mut data = Data::new("iterations", &["case", "points", "step", "iterations", "convolutions"]);
    for case in 0..NAMES.len() {
        for &points in sizes {
            let mut solver = solver(problem(case)?, [points; 2])?;
            for step in 0..6 {
                let load = if case < 2 {
                    Load::Penetration(0.02 - 0.006 * f64::from(step))
                } else {
                    Load::MeanPressure(0.006 - 0.002 * f64::from(step))
                };
                let found = advance(&mut solver, load)?;
                // Steps that were halved are of several states.
                if found.jumps.is_empty() && found.contact.report.stop == percoat_core::spectral::Stop::Converged {
                    let counts = [found.contact.report.iterations as f64, found.contact.convolutions]
                        .map(|all| all / found.states as f64);
                    data.rows.push(vec![case as f64, points as f64, f64::from(step), counts[0], counts[1]]);
                }
            }
        }
    }
    let mut most = |what: &str, wanted: &dyn Fn(&[f64]) -> bool, bound: f64| {
        let rows = data.rows.iter().filter(|row| wanted(row)).map(|row| (row[3], bound));
        outcome.checks.push(Check::worst(format!("iterations of a state, {what}"), rows, Tolerance::AtMost));
    };
    most("a ball on a bare body", &|row| row[0] == 0.0, 36.0);
    most("all contacts", &|_| true, 92.0);
    outcome.data.push(data);
    Ok(())
}

/// A case on a periodic cell of the side 1, with eight samples or more across the zone that pulls on 64 points.
fn problem(case: usize) -> Result<Problem, StudyError> {
    let cell = Cell::square(1.0)?;
    let substrate = Material::from_young(0.91, 0.3)?;
    let rough = || -> Result<Topography, StudyError> {
        let surface =
            SelfAffine { hurst: 0.8, longest: 0.5, rolloff: 0.5, shortest: 1.0 / 16.0, rms: Rms::Slope(0.1), seed: 1 };
        Ok(Topography::new(cell, surface.heights(cell, [512; 2])?)?)
    };
    Ok(match case {
        0 => adhering(ball(cell)?, HalfSpace::new(vec![], substrate), [1e-3, 0.014])?,
        1 => adhering(ball(cell)?, HalfSpace::new(vec![layer([10.0, 0.3, 0.02])?], substrate), [1e-3, 0.008])?,
        2 => adhering(rough()?, HalfSpace::new(vec![], substrate), [2e-5, 0.002])?,
        _ => adhering(rough()?, HalfSpace::new(vec![layer([0.3, 0.4, 0.05])?], substrate), [1e-5, 0.002])?,
    })
}

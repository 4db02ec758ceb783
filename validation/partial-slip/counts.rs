//! Iterations of the tractions from nothing, at one load: smooth and rough contacts, soft and stiff layers.

use super::setup::{ball, half_space, like, rubbing, solver, to_part};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::counterbody::roughness::{Rms, SelfAffine};
use percoat_core::counterbody::{Indenters, Level, Shape, Topography};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;

/// Names of the cases.
pub const NAMES: [&str; 7] =
    ["ball", "stiff layer, χ = 10", "χ = 100", "soft layer", "three levels", "rough", "rough to the grid"];
/// The first case of a rough surface.
const ROUGH: usize = 5;
const SIZES: [usize; 5] = [64, 128, 256, 512, 1024];
/// Tangential forces over μP.
const PARTS: [f64; 5] = [0.05, 0.3, 0.6, 0.9, 0.99];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let sizes = if quick { &SIZES[..1] } else { &SIZES[..] };
    let mut data = Data::new("iterations", &["case", "points", "part", "iterations", "convolutions", "normal"]);
    for case in 0..NAMES.len() {
        for &points in sizes {
            let (problem, load) = problem(case, points)?;
            for part in PARTS {
                let step = to_part(&mut solver(problem.clone(), [points; 2])?, load, part)?;
                data.rows.push(vec![
                    case as f64,
                    points as f64,
                    part,
                    step.report.iterations as f64,
                    step.report.convolutions,
                    step.contact.report.iterations as f64,
                ]);
            }
        }
    }
    let of = |is_rough: bool, sizes: std::ops::RangeInclusive<f64>, bound: f64| {
        let rows = data.rows.iter().filter(move |row| (row[0] >= ROUGH as f64) == is_rough && sizes.contains(&row[1]));
        rows.map(move |row| (row[3], bound)).collect::<Vec<_>>()
    };
    let mut most = |what: &str, is_rough: bool, sizes: std::ops::RangeInclusive<f64>, bound: f64| {
        let quantity = format!("iterations of the tractions, {what}");
        outcome.checks.push(Check::worst(quantity, of(is_rough, sizes, bound), Tolerance::AtMost));
    };
    most("smooth contacts", false, 0.0..=1024.0, 20.0);
    most("rough contacts, up to 512² points", true, 0.0..=512.0, 45.0);
    if !quick {
        most("rough contacts, 1024² points", true, 1024.0..=1024.0, 50.0);
    }
    outcome.data.push(data);
    Ok(())
}

/// A case on a periodic cell of the side 1, ν = .3, with its load.
fn problem(case: usize, points: usize) -> Result<(Problem, Load), StudyError> {
    let cell = Cell::square(1.0)?;
    // Contact radius .18 of the bare ball: P = 4E*a³/(3R), E* = 1/1.4 of like bodies of G = 1 and ν = .3.
    let hertz = Load::Force(4.0 / 3.0 / 0.7 * 0.18f64.powi(3));
    let body = |layers: &[[f64; 3]]| half_space(layers, 0.3).map(like);
    let rough = |shortest: f64| -> Result<Topography, StudyError> {
        let surface = SelfAffine { hurst: 0.8, longest: 0.25, rolloff: 0.25, shortest, rms: Rms::Slope(0.1), seed: 1 };
        Ok(Topography::new(cell, surface.heights(cell, [points; 2])?)?)
    };
    let problem = match case {
        0 => rubbing(ball(cell)?, body(&[])?, 1.0)?,
        1 => rubbing(ball(cell)?, body(&[[10.0, 0.3, 0.02]])?, 1.0)?,
        2 => rubbing(ball(cell)?, body(&[[100.0, 0.3, 0.02]])?, 1.0)?,
        3 => rubbing(ball(cell)?, body(&[[0.1, 0.45, 0.05]])?, 1.0)?,
        4 => rubbing(three_levels(cell)?, body(&[[2.0, 0.3, 0.05]])?, 1.0)?,
        5 => return Ok((rubbing(rough(1.0 / 32.0)?, body(&[])?, 1.0)?, Load::MeanPressure(0.01))),
        _ => return Ok((rubbing(rough(2.0 / points as f64)?, body(&[])?, 1.0)?, Load::MeanPressure(0.01))),
    };
    Ok((problem, hertz))
}

/// Four balls at three heights.
fn three_levels(cell: Cell) -> Result<Indenters, StudyError> {
    let sites = vec![vec![[0.25, 0.25]], vec![[0.75, 0.75]], vec![[0.25, 0.75], [0.75, 0.25]]];
    let level = |drop: f64| Level::new(Shape::Paraboloid { radius: 1.0 }, drop);
    let levels = [0.0, 0.001, 0.002].map(level).into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(Indenters::new(Lattice::new(cell, sites)?, levels)?)
}

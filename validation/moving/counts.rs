//! Iterations and convolutions from coarse to fine grids.

use super::setup::{Stack, TOLERANCE, moving, paraboloids, solved};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::counterbody::roughness::{Rms, SelfAffine};
use percoat_core::counterbody::{Indenters, Level, LoadedBy, Shape, Topography};
use percoat_core::lattice::{Cell, Lattice};

/// Names of the bodies below paraboloids, and of the other surfaces on the soft coat.
pub const NAMES: [&str; 5] = ["bare", "soft", "stiff", "levels", "rough"];
const SIZES: [usize; 4] = [64, 128, 256, 512];
const RATIOS: [f64; 4] = [2.0, 10.0, 100.0, 1000.0];
/// Iterations and convolutions at most, as a prototype had them, for each ratio: of paraboloids, and of levels and rough surfaces. At r = 1000
/// it counted other iterations.
const MOST: [[[f64; 2]; 2]; 4] = [
    [[27.0, 67.0], [27.0, 67.0]],
    [[27.0, 73.0], [36.0, 129.0]],
    [[77.0, 848.0], [77.0, 848.0]],
    [[f64::INFINITY, 4800.0], [f64::INFINITY, 4800.0]],
];
/// Convolutions of the certificate, which the prototype had not.
const CERTIFICATE: f64 = 24.0;
/// Growth from 128² to the finest grid.
const GROWTH: f64 = 1.5;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let sizes = if quick { &SIZES[..2] } else { &SIZES[..] };
    let ratios = if quick { &RATIOS[..2] } else { &RATIOS[..] };
    let mut data = Data::new("iterations", &["case", "ratio", "points", "iterations", "convolutions", "loss_tangent"]);
    for case in 0..NAMES.len() {
        for &ratio in ratios {
            for &points in sizes {
                data.rows.push(row(case, ratio, points)?);
            }
        }
    }
    for (&ratio, most) in ratios.iter().zip(MOST) {
        for (surfaces, [iterations, convolutions]) in ["paraboloids", "levels and rough surfaces"].into_iter().zip(most)
        {
            let rows =
                || data.rows.iter().filter(|row| row[1] == ratio && (row[0] < 3.0) == (surfaces == "paraboloids"));
            let mut worst = |name: &str, column: usize, most: f64| {
                let pairs = rows().map(|row| (row[column], most));
                let name = format!("{name}, {surfaces}, r = {ratio}");
                outcome.checks.push(Check::worst(name, pairs, Tolerance::AtMost));
            };
            if iterations.is_finite() {
                worst("iterations", 3, iterations);
            }
            worst("convolutions", 4, convolutions + CERTIFICATE);
        }
    }
    if !quick {
        let of = |points: f64| data.rows.iter().filter(move |row| row[2] == points);
        let growth = of(128.0).zip(of(512.0)).map(|(coarse, fine)| (fine[4] / coarse[4], GROWTH));
        outcome.checks.push(Check::worst("growth of convolutions from 128² to 512²", growth, Tolerance::AtMost));
    }
    outcome.data.push(data);
    Ok(())
}

fn row(case: usize, ratio: f64, points: usize) -> Result<Vec<f64>, StudyError> {
    let stack = match case {
        0 => Stack::bare(ratio),
        2 => Stack::stiff(ratio),
        _ => Stack::soft(ratio),
    };
    // Near the velocity of the largest losses, where a wave of the contact's size passes in the root of τ · rτ.
    let velocity = 0.1 / ratio.sqrt();
    let problem = moving(surface(case)?, stack.half_space()?, velocity)?;
    let step = solved(problem, [points; 2], [if case == 2 { 0.02 } else { 0.05 }, TOLERANCE])?;
    let tangent = step.motion.as_ref().map_or(f64::NAN, |motion| motion.loss_tangent);
    Ok(vec![case as f64, ratio, points as f64, step.report.iterations as f64, step.convolutions, tangent])
}

fn surface(case: usize) -> Result<LoadedBy, StudyError> {
    let level = |height: f64| Level::new(Shape::Sphere { radius: 1.0 }, height);
    Ok(match case {
        3 => Indenters::new(Lattice::hexagonal(1.0, 3)?, vec![level(0.02)?, level(0.01)?, level(0.0)?])?.into(),
        4 => {
            let cell = Cell::square(1.0)?;
            let surface = SelfAffine {
                hurst: 0.8,
                longest: 0.25,
                rolloff: 0.25,
                shortest: 1.0 / 32.0,
                rms: Rms::Slope(0.1),
                seed: 1,
            };
            Topography::new(cell, surface.heights(cell, [512; 2])?)?.into()
        }
        _ => paraboloids()?.into(),
    })
}

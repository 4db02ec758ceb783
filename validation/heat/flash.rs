//! Flash temperatures below a square source that moves: Jaeger's limits, slow and fast, and the integral between them.

use super::setup::{Stack, Stuff, flux, heat, under_flux};
use super::sources::{LATTICE, images, square};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::spectral::Step;
use std::f64::consts::{PI, TAU};

/// Speeds vb/2κ between the limits.
const SPEEDS: [f64; 4] = [0.1, 1.0, 10.0, 100.0];
/// Samples of half a side, and those of the cell.
const GRIDS: [(f64, usize); 3] = [(12.5, 300), (20.5, 625), (40.5, 972)];
/// Places over half a side, on the track.
const PLACES: [f64; 3] = [-0.5, 0.0, 0.5];
/// Fast and slow motion.
const FAST: f64 = 500.0;
const SLOW: f64 = 1e-12;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let grids = if quick { &GRIDS[..1] } else { &GRIDS[..] };
    let mut data = Data::new("flash", &["speed", "across", "x", "temperature", "exact", "jaeger"]);
    for &grid in grids {
        for beta in SPEEDS {
            data.rows.extend(rows(beta, grid)?);
        }
    }
    let parts = |row: &Vec<f64>| ((row[3] / row[4] - 1.0) / allowed(row[0], row[1], row[2]), 0.0);
    let name = "flash temperature of a square, against its integral, over what a grid makes";
    outcome.checks.push(Check::worst(name, data.rows.iter().map(parts), Tolerance::Absolute(1.0)));
    outcome.data.push(data);
    slow(outcome, grids)?;
    fast(outcome, grids)
}

/// Allowed relative error: twice the mean over a cell of a sample, (h²/24)∇²T of the square root that begins at the edge ahead, with the lines to
/// both sides; the skew part of the waves at half the samples, which a grid does not have: h^{3/2}/(4√2 πd√(1 − x)) at the distance d from an edge;
/// the rest of the images.
fn allowed(beta: f64, across: f64, x: f64) -> f64 {
    let h = 1.0 / across;
    let curved = 0.25 / (1.0 - x).powi(2) + 2.0 / (1.0 + beta).sqrt();
    let skew = h.powf(1.5) / (32f64.sqrt() * PI * (1.0 - x).sqrt()) * (1.0 / (1.0 - x) + 1.0 / (1.0 + x));
    2.0 * h * h / 24.0 * curved * 2.0 + skew + 2e-4
}

fn step(beta: f64, (across, points): (f64, usize)) -> Result<(Step, f64), StudyError> {
    let side = points as f64 / across;
    let body = Stack::bare(Stuff::new(1.0, [1.0, 1.0, 0.0]));
    let given = flux([side; 2], [points; 2], |x, y| if x.abs() < 1.0 && y.abs() < 1.0 { 1.0 } else { 0.0 })?;
    Ok((under_flux(given, &body, 2.0 * beta, [points; 2])?, side))
}

/// Temperature at a number of samples ahead of the middle of the track.
fn on_track(step: &Step, samples: i64) -> Result<f64, StudyError> {
    let points = step.grid().points()[0];
    Ok(heat(step)?.body[samples.rem_euclid(points as i64) as usize * points])
}

/// Speed, samples of half a side, place, temperature of one square, its integral, and Jaeger's limit of fast motion.
fn rows(beta: f64, grid: (f64, usize)) -> Result<Vec<Vec<f64>>, StudyError> {
    let (step, side) = step(beta, grid)?;
    let row = |place: f64| -> Result<Vec<f64>, StudyError> {
        let samples = (place * grid.0).round() as i64;
        let x = samples as f64 / grid.0;
        let found = on_track(&step, samples)? - 4.0 * images(beta, side, x);
        Ok(vec![beta, grid.0, x, found, square(beta, [x, 0.0]), root(beta, x)])
    };
    PLACES.into_iter().map(row).collect()
}

/// Fast motion: heat flows into the depth alone for the time since the edge ahead, T = (2q/λ)√(κt/π).
pub fn root(beta: f64, x: f64) -> f64 {
    2.0 * ((1.0 - x) / (TAU * beta)).sqrt()
}

/// At rest T = (4qb/πλ) asinh 1 in the middle, and 0.946 qb/λ in the mean (C. Jaeger's table; in closed form below).
fn slow(outcome: &mut Outcome, grids: &[(f64, usize)]) -> Result<(), StudyError> {
    let mut pairs = Vec::new();
    for &grid in grids {
        let (step, side) = step(SLOW, grid)?;
        let h = 1.0 / grid.0;
        let heat = heat(&step)?;
        let [sum, whole] = heat.body.iter().zip(&heat.flux).fold([0.0; 2], |[s, w], (t, q)| [s + t * q, w + q]);
        let others = |square: f64| 4.0 / TAU * (LATTICE[0] / side + 0.25 * LATTICE[1] * square / side.powi(3));
        let middle = heat.body[0] - others(2.0 / 3.0);
        let mean = sum / whole - others(4.0 / 3.0);
        let root = 2f64.sqrt();
        let known = [4.0 / PI * 1f64.asinh(), (4.0 * 1f64.asinh() + 4.0 / 3.0 * (1.0 - root)) / PI];
        // −∇²T over T in the middle, and twice its mean over the square with the slope a spacing before the edges.
        let middle_part = (middle / known[0] - 1.0) / (2.0 * h * h / 24.0 + 5e-6);
        let mean_part = (mean / known[1] - 1.0) / (2.0 * 8.0 * h * h / 24.0 + 5e-6);
        pairs.extend([(middle_part, 0.0), (mean_part, 0.0)]);
    }
    let name = "square at rest, temperature in the middle and mean, over what a grid makes";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1.0)));
    Ok(())
}

/// Fast motion: temperatures on the track over Jaeger's.
fn fast(outcome: &mut Outcome, grids: &[(f64, usize)]) -> Result<(), StudyError> {
    let mut pairs = Vec::new();
    for &grid in grids {
        let (step, side) = step(FAST, grid)?;
        for place in PLACES {
            let samples = (place * grid.0).round() as i64;
            let x = samples as f64 / grid.0;
            let found = on_track(&step, samples)? - 4.0 * images(FAST, side, x);
            // Heat that flows along counts κ/vd.
            let part = allowed(FAST, grid.0, x) + 0.5 / (FAST * (1.0 - x));
            pairs.push(((found / root(FAST, x) - 1.0) / part, 0.0));
        }
    }
    let name = "square in fast motion, flash temperature, over what a grid and flow along the track make";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1.0)));
    Ok(())
}

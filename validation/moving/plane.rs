//! Coated bodies below cosine waves, plane strain, against a dense solution.

use super::rolling::{edges, line};
use super::setup::{ROWS, Stack, TOLERANCE, cylinder, friction, moving, solved};
use super::slow::slope;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use std::f64::consts::TAU;

const SIZES: [usize; 3] = [128, 256, 512];
/// Mean pressures of S and H.
const MEANS: [f64; 2] = [0.15, 0.05];
/// Errors on 512 samples, as a prototype had them: of δ, relative, and of μ, over the largest one of the body. On fewer they grow as h^1.5.
const DEPTH: f64 = 2e-5;
const FRICTION: f64 = 5e-4;
/// Allowance for another alignment of the samples.
const ALIGNED: f64 = 2.0;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let table = Data::parse("plane", include_str!("plane.csv"))?;
    let columns =
        ["body", "velocity", "points", "trailing", "leading", "delta", "friction", "energy", "error", "peak", "place"];
    let mut data = Data::new("plane", &columns);
    let sizes = if quick { &SIZES[..2] } else { &SIZES[..] };
    for known in &table.rows {
        for &points in sizes {
            data.rows.push(row(known, points)?);
        }
    }
    for (name, value, of) in [("trailing edge", 3, 2), ("leading edge", 4, 3), ("place of the peak", 10, 7)] {
        let pairs = data.rows.iter().map(|row| (row[2] * row[value], row[2] * exact(&table, row)[of]));
        let name = format!("coated, plane strain: {name}, spacings");
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1.0)));
    }
    for (name, value, of, error) in [
        ("penetration", 5, 4, DEPTH),
        ("friction by shape", 6, 5, FRICTION),
        ("friction by energy", 7, 5, FRICTION),
        ("peak", 9, 6, 1.0),
    ] {
        // Over the tolerance of a row on 512 samples.
        let parts = |row: &[f64]| (row[value] - exact(&table, row)[of]) / (error * scale(&table, row, of));
        for &points in sizes {
            let growth = (512.0 / points as f64).powf(if of == 6 { 2.0 } else { 1.5 });
            let pairs = data.rows.iter().filter(|row| row[2] == points as f64).map(|row| (parts(row) / growth, 0.0));
            let name = format!("coated, plane strain: {name}, {points} samples, error over what is expected");
            outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(if of == 6 { 1.0 } else { ALIGNED })));
        }
        if !quick && of != 6 {
            let name = format!("coated, plane strain: order of {name}");
            outcome.checks.push(Check::at_least(name, order(&data.rows, sizes, &parts), 1.5));
        }
    }
    let stated = data.rows.iter().map(|row| ((row[6] - exact(&table, row)[5]).abs() / row[8], 1.0));
    let name = "coated, plane strain: error of friction by shape, over the stated one";
    outcome.checks.push(Check::worst(name, stated, Tolerance::AtMost));
    outcome.data.push(data);
    Ok(())
}

fn row(known: &[f64], points: usize) -> Result<Vec<f64>, StudyError> {
    let body = known[0] as usize;
    let stack = if body == 0 { Stack::soft(10.0) } else { Stack::stiff(10.0) };
    let surface = cylinder(1.0, points, |x| 0.01 * (1.0 - (TAU * x).cos()))?;
    let step = solved(moving(surface, stack.half_space()?, known[1])?, [points, ROWS], [MEANS[body], TOLERANCE])?;
    let reading = friction(&step)?;
    let [trailing, leading] = edges(&step);
    let [place, peak] = crest(&line(&step));
    Ok(vec![
        known[0],
        known[1],
        points as f64,
        trailing,
        leading,
        step.penetration(),
        reading.friction_coefficient,
        reading.by_energy,
        reading.error.unwrap_or(f64::NAN),
        peak,
        place,
    ])
}

/// Place and height of the largest value, by the parabola through it and its neighbours.
fn crest(line: &[[f64; 2]]) -> [f64; 2] {
    let top = (1..line.len() - 1).max_by(|&a, &b| line[a][1].total_cmp(&line[b][1])).unwrap_or(1);
    let [[x, left], [middle, p], [_, right]] = [line[top - 1], line[top], line[top + 1]];
    let (slope, bend) = (0.5 * (right - left), right - 2.0 * p + left);
    [middle - (middle - x) * slope / bend, p - 0.5 * slope * slope / bend]
}

/// The reference of a row.
fn exact<'a>(table: &'a Data, row: &[f64]) -> &'a [f64] {
    table.rows.iter().find(|known| known[..2] == row[..2]).map_or(&[f64::NAN; 8], Vec::as_slice)
}

/// Scale of the errors of a row: δ itself, the largest μ of the body, and of the peak what one spacing beside the crest takes off a half
/// ellipse that ends at the nearer edge, on 512 samples.
fn scale(table: &Data, row: &[f64], of: usize) -> f64 {
    let known = exact(table, row);
    match of {
        4 => known[4],
        5 => table.rows.iter().filter(|other| other[0] == row[0]).map(|other| other[5]).fold(0.0, f64::max),
        _ => {
            let samples = 512.0 * (known[7] - known[2]).min(known[3] - known[7]);
            0.5 * known[6] / (samples * samples)
        }
    }
}

/// Order by which the mean square of errors falls with the samples: a straight line through its logarithms.
fn order(rows: &[Vec<f64>], sizes: &[usize], error: &dyn Fn(&[f64]) -> f64) -> f64 {
    let size = |&points: &usize| {
        let squares = rows.iter().filter(|row| row[2] == points as f64).map(|row| error(row).powi(2));
        [(points as f64).ln(), 0.5 * squares.sum::<f64>().ln()]
    };
    -slope(&sizes.iter().map(size).collect::<Vec<_>>())
}

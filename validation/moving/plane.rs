//! Coated bodies below cosine waves, plane strain, against a dense solution.

use super::rolling::{edges, line};
use super::setup::{ROWS, Stack, TOLERANCE, cylinder, friction, moving, solved};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use std::f64::consts::TAU;

const SIZES: [usize; 3] = [128, 256, 512];
/// Mean pressures of S and H.
const MEANS: [f64; 2] = [0.15, 0.05];
/// Errors of δ, and of μ and the peak, on 512 samples, relative; at second order more on fewer.
const DEPTH: f64 = 2e-5;
const FRICTION: f64 = 5e-4;

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
    let known = |index: usize| &table.rows[index / sizes.len()];
    let all = |value: usize, of: usize| -> Vec<(f64, f64, f64)> {
        data.rows.iter().enumerate().map(|(index, row)| (row[2], row[value], known(index)[of])).collect()
    };
    let checks = &mut outcome.checks;
    for (name, value, of) in [("trailing edge", 3, 2), ("leading edge", 4, 3), ("place of the peak", 10, 7)] {
        let pairs = all(value, of).into_iter().map(|(points, x, exact)| (points * x, points * exact));
        checks.push(Check::worst(format!("coated, plane strain: {name}, spacings"), pairs, Tolerance::Absolute(1.0)));
    }
    let quantities =
        [("penetration", 5, 4, DEPTH), ("friction by shape", 6, 5, FRICTION), ("friction by energy", 7, 5, FRICTION), ("peak", 9, 6, FRICTION)];
    for (name, value, of, error) in quantities {
        for &points in sizes {
            let pairs = all(value, of).into_iter().filter(|all| all.0 == points as f64).map(|(_, x, exact)| (x, exact));
            let tolerance = Tolerance::Relative(error * (512.0 / points as f64).powi(2));
            checks.push(Check::worst(format!("coated, plane strain: {name}, {points} samples"), pairs, tolerance));
        }
        if !quick && of != 6 {
            checks.push(Check::order(format!("coated, plane strain: order of {name}"), order(&all(value, of)), 2.0, 0.5));
        }
    }
    let stated = data.rows.iter().enumerate().map(|(index, row)| ((row[6] - known(index)[5]).abs(), row[8]));
    checks.push(Check::worst("coated, plane strain: error of friction below the stated one", stated, Tolerance::AtMost));
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

/// Order by which the mean square of relative errors falls with the samples: a straight line through its logarithms.
pub fn order(all: &[(f64, f64, f64)]) -> f64 {
    let mut sizes: Vec<f64> = all.iter().map(|of| of.0).collect();
    sizes.dedup();
    sizes.sort_by(f64::total_cmp);
    sizes.dedup();
    let size = |points: f64| {
        let errors = all.iter().filter(|of| of.0 == points).map(|(_, x, exact)| (x / exact - 1.0).powi(2));
        [points.ln(), 0.5 * errors.sum::<f64>().ln()]
    };
    let points: Vec<[f64; 2]> = sizes.into_iter().map(size).collect();
    let middle = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64);
    let sum = |a: usize| points.iter().map(|point| (point[0] - middle[0]) * (point[a] - middle[a])).sum::<f64>();
    -sum(1) / sum(0)
}

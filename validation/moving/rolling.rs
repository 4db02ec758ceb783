//! Hunter's cylinder: his closed form, and percoat's cylinders in cells of growing length.

use super::hunter::Hunter;
use super::setup::{ROWS, Stack, Stuff, TOLERANCE, cylinder, friction, moving, solved};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::spectral::Step;

pub const LOAD: f64 = 0.01;
/// Cell lengths over the first one.
const PERIODS: [f64; 3] = [1.0, 2.0, 4.0];
/// Samples across half of the contact, at least.
const ACROSS: f64 = 60.0;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let table = Data::parse("hunter", include_str!("hunter.csv"))?;
    let closed: Vec<Hunter> = table.rows.iter().map(|row| Hunter::new(row[0], row[1], LOAD)).collect();
    let pairs = closed
        .iter()
        .zip(&table.rows)
        .flat_map(|(hunter, row)| [(hunter.half_width, row[2]), (hunter.shift, row[3]), (hunter.friction, row[4])]);
    outcome.checks.push(Check::worst("closed form of a rolling cylinder", pairs, Tolerance::Absolute(1e-9)));
    let columns = ["ratio", "way", "samples", "friction", "half_width", "shift", "mu_exact", "a_exact", "c_exact"];
    let mut data = Data::new("cylinders", &columns);
    for (row, exact) in table.rows.iter().zip(&closed) {
        let [ratio, way] = [row[0], row[1]];
        if !quick || ratio * way < 0.11 {
            data.rows.push(extrapolated(ratio, way, exact)?);
        }
    }
    let mut worst = |name: &str, [value, known]: [usize; 2], scale: &dyn Fn(&[f64]) -> f64, tolerance| {
        let pairs = data.rows.iter().map(|row| (row[value] / scale(row), row[known] / scale(row)));
        outcome.checks.push(Check::worst(name, pairs, tolerance));
    };
    worst("friction of cylinders, extrapolated to one alone", [3, 6], &|_| 1.0, Tolerance::Relative(1e-3));
    worst("half-width of cylinders, over a spacing", [4, 7], &|row| row[7] / row[2], Tolerance::Absolute(1.0));
    worst("shift of cylinders, over a spacing", [5, 8], &|row| row[7] / row[2], Tolerance::Absolute(1.0));
    outcome.data.push(data);
    Ok(())
}

/// A half-space with E* = 1, relaxed.
fn unit(ratio: f64) -> Stack {
    Stack { sheets: Vec::new(), substrate: Stuff::relaxing(0.35, 0.3, ratio) }
}

/// Friction, half-width and shift in cells of three lengths, extrapolated to an endless one.
fn extrapolated(ratio: f64, way: f64, exact: &Hunter) -> Result<Vec<f64>, StudyError> {
    let relaxed = (4.0 * LOAD / std::f64::consts::PI).sqrt();
    let first = (4.0 * ratio * way).max(8.0 * relaxed);
    let points = (first / exact.half_width * ACROSS).log2().ceil().exp2() as usize;
    let found = PERIODS.map(|times| -> Result<[f64; 3], StudyError> {
        let (period, points) = (first * times, points * times as usize);
        let surface = cylinder(period, points, |x| 0.5 * x * x)?;
        let problem = moving(surface, unit(ratio).half_space()?, way)?;
        let step = solved(problem, [points, ROWS], [LOAD / period, TOLERANCE])?;
        let [from, to] = edges(&step);
        Ok([friction(&step)?.friction_coefficient, 0.5 * (to - from), 0.5 * (to + from)])
    });
    let [one, two, four] = found;
    let (one, two, four) = (one?, two?, four?);
    let ends = [0, 1, 2].map(|k| {
        let [once, again] = [[one[k], two[k]], [two[k], four[k]]].map(|[short, long]| (4.0 * long - short) / 3.0);
        (16.0 * again - once) / 15.0
    });
    let samples = exact.half_width * points as f64 / first;
    let known = [exact.friction, exact.half_width, exact.shift];
    Ok([&[ratio, way, samples], &ends[..], &known[..]].concat())
}

/// Pressures along x with their places, from the middle of the cell on.
pub fn line(step: &Step) -> Vec<[f64; 2]> {
    let (pressure, n) = (step.pressure(), step.grid().points()[0]);
    let period = step.grid().cell().vectors()[0][0];
    let place = |i: usize| (i as f64 - (n / 2) as f64) * period / n as f64;
    (0..n).map(|i| [place(i), pressure[[(i + n - n / 2) % n, 0]]]).collect()
}

/// Edges of a single contact: where p², which is linear there, is 0.
pub fn edges(step: &Step) -> [f64; 2] {
    let line = line(step);
    let touching: Vec<[f64; 2]> = line.iter().copied().filter(|[_, p]| *p > 0.0).collect();
    let beyond = |outer: [f64; 2], inner: [f64; 2]| {
        let [p, q] = [outer[1], inner[1]].map(|p| p * p);
        let share = if q > p { (p / (q - p)).min(1.0) } else { 0.5 };
        outer[0] + share * (outer[0] - inner[0])
    };
    let last = touching.len() - 1;
    [beyond(touching[0], touching[1]), beyond(touching[last], touching[last - 1])]
}

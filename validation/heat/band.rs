//! A band of heat that moves (Jaeger 1942), in cells of growing length.
//!
//! The mean of a cell is left out. What the images add is ζ(½) of their wakes, a constant that falls as L^{−1/2}, and their slopes, which fall as
//! L^{−3/2}: q√(κ/πv)(½ζ(3/2)x + O(1)) L^{−3/2}/λ.

use super::setup::{Stack, Stuff, flux, heat, place, under_flux};
use super::sources::{ZETA, band, band_images};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use std::f64::consts::TAU;

/// Speeds B = vb/2κ.
pub const SPEEDS: [f64; 2] = [1.0, 10.0];
/// Places over the half-width.
pub const PLACES: [f64; 3] = [-0.9, 0.0, 0.9];
/// T at these places: another program's digits of the closed form.
const KNOWN: [[f64; 3]; 2] = [[0.95269, 0.86392, 0.42924], [0.34794, 0.25541, 0.08851]];
/// Samples of the half-width, and those of the lengths of the cells: each four times the one before. Odd ones after these.
const ACROSS: f64 = 40.5;
const LENGTHS: [usize; 4] = [1012, 4048, 16192, 64768];
const ODD: usize = 16875;
const ROWS: usize = 3;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let digits = SPEEDS.iter().zip(KNOWN).flat_map(|(&half, known)| {
        PLACES.iter().zip(known).map(move |(&x, known)| (band(half, x), known)).collect::<Vec<_>>()
    });
    outcome.checks.push(Check::worst("closed form of a moving band", digits, Tolerance::Absolute(5.1e-6)));
    let mut data = Data::new("band", &["speed", "period", "x", "temperature", "exact", "allowed"]);
    let lengths = if quick { &LENGTHS[..3] } else { &LENGTHS[..] };
    for half in SPEEDS {
        for &points in lengths.iter().chain([&ODD]) {
            data.rows.extend(rows(half, points)?);
        }
    }
    let all = data.rows.iter().map(|row| ((row[3] - row[4]) / row[5], 0.0));
    let name = "band that moves, temperatures over what grid and wakes of the images make";
    outcome.checks.push(Check::worst(name, all, Tolerance::Absolute(1.0)));
    let slopes = SPEEDS.iter().map(|&half| (order(&data, half, lengths), -1.5));
    outcome.checks.push(Check::worst("order of the length of the cell", slopes, Tolerance::Order(0.05)));
    outcome.data.push(data);
    Ok(())
}

/// Speed, period, place, temperature without the constant of the images, the closed form, and their allowed difference.
fn rows(half: f64, points: usize) -> Result<Vec<Vec<f64>>, StudyError> {
    let h = 1.0 / ACROSS;
    let sides = [points as f64 * h, ROWS as f64 * h];
    let body = Stack::bare(Stuff::new(1.0, [1.0, 1.0, 0.0]));
    let given = flux(sides, [points, ROWS], |x, _| if x.abs() < 1.0 { 1.0 } else { 0.0 })?;
    let step = under_flux(given, &body, 2.0 * half, [points, ROWS])?;
    let temperatures = &heat(&step)?.body;
    let curved = |x: f64| (band(half, x + h) - 2.0 * band(half, x) + band(half, x - h)).abs() / 24.0;
    let samples = PLACES.map(|x| (x * ACROSS).round() as i64);
    let grid = samples.iter().map(|&i| curved(i as f64 * h)).fold(0.0, f64::max);
    let strength = 2.0 * (1.0 / (TAU * half * sides[0].powi(3))).sqrt() * ZETA[1];
    let row = |i: i64| {
        let i = i.rem_euclid(points as i64) as usize;
        let x = place(i, points, sides[0]);
        let found = temperatures[i * ROWS] - band_images(half, sides[0]);
        // The slopes of the wakes, and their next term 1/8Bd, half as much again for the terms after these.
        let wakes = 1.5 * strength * (0.5 * x.abs() + 0.125 / half);
        vec![half, sides[0], x, found, band(half, x), 2.0 * grid + wakes]
    };
    Ok(samples.into_iter().map(row).collect())
}

/// Exponent of the length of the cell with which T(0.9) − T(−0.9) changes between two lengths; the spacing of the samples is the same in all.
fn order(data: &Data, half: f64, lengths: &[usize]) -> f64 {
    let difference = |points: usize| {
        let of = |ahead: bool| {
            let is = |row: &&Vec<f64>| {
                row[0] == half
                    && (row[1] * ACROSS - points as f64).abs() < 0.5
                    && row[2].abs() > 0.5
                    && (row[2] > 0.0) == ahead
            };
            data.rows.iter().find(is).map_or(f64::NAN, |row| row[3])
        };
        of(true) - of(false)
    };
    let last = &lengths[lengths.len() - 3..];
    let [one, two, three] = [0, 1, 2].map(|n| difference(last[n]));
    ((two - three) / (one - two)).ln() / 4f64.ln()
}

//! A wave with a hardness, in closed form.

use super::bodies::with_hardness;
use crate::alone::half_space;
use crate::steps::{Steps, topography};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::Step;
use std::f64::consts::{PI, TAU};

const WAVE: &str = include_str!("wave.csv");
const PRESSURE: &str = include_str!("wave-pressure.csv");
/// f = D(1 − cos 2πx) on E* = 1; p* = π D.
const AMPLITUDE: f64 = 0.02;
const COMPLETE: f64 = PI * AMPLITUDE;
/// Samples a wave.
const SAMPLES: [usize; 5] = [128, 256, 512, 1024, 2048];
/// The finest grid, and samples from an edge and across the elastic strip with which its pressure is between the samples.
const FINEST: usize = 2048;
const FROM_EDGE: f64 = 5.0;
const STRIP: f64 = 40.0;
/// Error of δ/D of 128 samples: one and a half times the largest of the dense solutions, 6·10⁻⁴.
const COARSEST: f64 = 1e-3;
/// H/p* and p̄/p* of the drawn pressures.
pub const DRAWN: [(f64, f64); 2] = [(1.0, 0.3), (1.3, 0.52)];

/// The wave under H/p* and p̄/p*.
fn solved(hardness: f64, mean: f64, samples: usize) -> Result<Step, StudyError> {
    let points = [samples, 4];
    let cell = Cell::new([1.0, 0.0], [0.0, 0.01])?;
    let surface = topography(cell, points, |s, _| AMPLITUDE * (TAU * s).cos())?;
    let bodies = with_hardness(half_space(&[], [1.0, 0.0])?, hardness * COMPLETE)?;
    Steps::to(Problem::new(surface, bodies), points, 1e-12)?.step(Load::MeanPressure(mean * COMPLETE))
}

/// Approach and strips on all grids.
pub fn wave(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse("wave", WAVE)?;
    let columns =
        ["samples", "H", "mean", "plastic", "plastic_exact", "contact", "contact_exact", "delta", "delta_exact"];
    let mut data = Data::new("wave", &columns);
    for samples in SAMPLES {
        for row in &table.rows {
            let &[hardness, mean, plastic, contact, delta] = &row[..] else { return Err("a row too short".into()) };
            let step = solved(hardness, mean, samples)?;
            let (p, most) = (step.pressure(), step.finest().hardness());
            let part =
                |is: &dyn Fn(f64) -> bool| (0..samples).filter(|&i| is(p[[i, 0]])).count() as f64 / samples as f64;
            let (full, touching) = (part(&|p| p >= most), part(&|p| p > 0.0));
            let found = step.penetration() / AMPLITUDE;
            data.rows.push(vec![samples as f64, hardness, mean, full, plastic, touching, contact, found, delta]);
        }
    }
    let halves = |row: &&Vec<f64>| 2.0 * row[2] == row[1];
    let scaled = data.rows.iter().map(|row| ((row[7] - row[8]) * (row[0] / 128.0).powf(1.5), 0.0));
    let samples = |row: &Vec<f64>| [(row[0] * (row[3] - row[4]), 0.0), (row[0] * (row[5] - row[6]), 0.0)];
    let rms = rms(&data);
    let order = -slope(&rms);
    let checks = [
        Check::worst("wave, error of δ/D times (N/128)^(3/2)", scaled, Tolerance::Absolute(COARSEST)),
        Check::worst(
            "wave, widths at the hardness and in contact, error in samples",
            data.rows.iter().flat_map(samples),
            Tolerance::Absolute(2.0),
        ),
        Check::worst(
            "wave, δ/D at p̄ = H/2",
            data.rows.iter().filter(halves).map(|row| (row[7], 1.0)),
            Tolerance::Absolute(1e-7),
        ),
        Check::order("wave, order of δ", order, 1.75, 0.5),
    ];
    outcome.checks.extend(checks);
    Ok(data)
}

/// Number of samples and root of the mean square of the errors of δ/D, without p̄ = H/2, where symmetry has δ = D.
pub fn rms(data: &Data) -> Vec<[f64; 2]> {
    let of = |samples: f64| {
        let rows = data.rows.iter().filter(|row| row[0] == samples && 2.0 * row[2] != row[1]);
        let squares: Vec<f64> = rows.map(|row| (row[7] - row[8]).powi(2)).collect();
        [samples, (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()]
    };
    SAMPLES.map(|samples| of(samples as f64)).to_vec()
}

/// d ln y/d ln x by least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    let mean = [0, 1].map(|k| logs.iter().map(|point| point[k]).sum::<f64>() / n);
    let product = |k: usize| logs.iter().map(|point| (point[0] - mean[0]) * (point[k] - mean[k])).sum::<f64>();
    product(1) / product(0)
}

/// Pressures of the elastic strip on the finest grid, linear between its samples.
pub fn profiles(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let (table, strips) = (Data::parse("wave-pressure", PRESSURE)?, Data::parse("wave", WAVE)?);
    let mut data = Data::new("wave-pressure", &["H", "mean", "x", "p", "p_exact", "samples"]);
    for strip in &strips.rows {
        let rows: Vec<&Vec<f64>> = table.rows.iter().filter(|row| row[..2] == strip[..2]).collect();
        if rows.is_empty() {
            continue;
        }
        let step = solved(strip[0], strip[1], FINEST)?;
        let (p, most) = (step.pressure(), step.finest().hardness());
        for row in rows {
            // x/π of half a wavelength is x of a cell over a half.
            let place = 0.5 * row[2] * FINEST as f64;
            let (before, part) = (place.floor() as usize, place.fract());
            let found = (1.0 - part) * p[[before, 0]] + part * p[[(before + 1) % FINEST, 0]];
            let spacing = 2.0 / FINEST as f64;
            let outer = if strip[3] < 1.0 { strip[3] } else { f64::INFINITY };
            let away = (row[2] - strip[2]).min(outer - row[2]) / spacing;
            let is_read = away >= FROM_EDGE && (strip[3] - strip[2]) / spacing >= STRIP;
            data.rows.push(vec![row[0], row[1], row[2], found / most, row[3], if is_read { away } else { 0.0 }]);
        }
    }
    let read = data.rows.iter().filter(|row| row[5] > 0.0).map(|row| (row[3], row[4]));
    let name = "wave, p/H of the elastic strip, five samples and more from its edges";
    outcome.checks.push(Check::worst(name, read, Tolerance::Absolute(1e-3)));
    Ok(data)
}

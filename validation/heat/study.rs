//! Frictional heat: sources at rest and moving, waves on stacks, partition, the critical state, energy, stated errors.

mod band;
mod critical;
mod depth;
mod flash;
mod partition;
mod rest;
mod setup;
mod sources;
mod stated;
mod waves;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Style};
use std::f64::consts::PI;

pub const STUDY: Study = Study {
    name: "heat",
    title: "Frictional heat: sources at rest and moving, waves on stacks, partition, critical state, energy, stated errors",
    files: &[
        "band.data.csv",
        "critical.data.csv",
        "figure.png",
        "flash.data.csv",
        "partition.data.csv",
        "rest.data.csv",
        "stated.data.csv",
        "steps.data.csv",
        "waves.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    rest::add(&mut outcome, quick)?;
    band::add(&mut outcome, quick)?;
    flash::add(&mut outcome, quick)?;
    waves::add(&mut outcome, quick)?;
    partition::add(&mut outcome, quick)?;
    critical::add(&mut outcome, quick)?;
    stated::add(&mut outcome, quick)?;
    let caption = "Temperature of a moving square, of a moving band over the length of the cell, shares of two bodies, and errors.";
    outcome.figures.push(("figure", draw::figure(charts(&outcome), caption)));
    Ok(outcome)
}

fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    vec![
        flashes(&find("flash")),
        lengths(&find("band")),
        shares(&find("steps"), &find("partition")),
        errors(&find("stated")),
    ]
}

/// Temperature in the middle of a square over its speed, with Jaeger's limits.
fn flashes(flash: &Data) -> Chart {
    let found = flash.rows.iter().filter(|row| row[2].abs() < 1e-9).map(|row| [row[0], row[3]]);
    let speeds = draw::logarithmic(0.01, 300.0, 120);
    let exact = speeds.iter().map(|&beta| [beta, sources::square(beta, [0.0; 2])]);
    let fast = speeds.iter().filter(|beta| **beta > 0.4).map(|&beta| [beta, flash::root(beta, 0.0)]);
    let slow = speeds.iter().filter(|beta| **beta < 1.0).map(|&beta| [beta, 4.0 / PI * 1f64.asinh()]);
    Chart {
        title: "(a) middle of a square that moves".into(),
        x: Axis::log("speed vb/2κ"),
        y: Axis::log("temperature λT/qb"),
        curves: vec![
            curve("integral", Style::Line, 0, exact),
            curve("Jaeger, fast", Style::Dashed, 1, fast),
            curve("Jaeger, slow", Style::Dashed, 2, slow),
            curve("percoat", Style::Markers, 3, found),
        ],
    }
}

/// Difference from an endless band over the length of the cell.
fn lengths(band: &Data) -> Chart {
    let mut curves = Vec::new();
    for (colour, half) in band::SPEEDS.into_iter().enumerate() {
        let rows = band.rows.iter().filter(|row| row[0] == half && row[2] > 0.5);
        let points: Vec<[f64; 2]> = rows.map(|row| [row[1], (row[3] - row[4]).abs()]).collect();
        curves.push(draw::slope(format!("length⁻³ᐟ², B = {half}"), -1.5, colour, &points));
        curves.push(curve(format!("percoat, B = {half}"), Style::Markers, colour, points));
    }
    Chart {
        title: "(b) a moving band among its images".into(),
        x: Axis::log("length of the cell over b"),
        y: Axis::log("error of λT/qb at x = 0.9 b"),
        curves,
    }
}

/// Share of the moving body over its speed.
fn shares(steps: &Data, table: &Data) -> Chart {
    let mut curves = Vec::new();
    let finest = steps.rows.iter().map(|row| row[2]).fold(0.0, f64::max);
    for (colour, name) in partition::NAMES.into_iter().enumerate() {
        let rows = steps.rows.iter().filter(|row| row[0] == colour as f64 && row[2] == finest && row[1] > 0.1);
        curves.push(curve(name, Style::LineMarkers, colour, rows.map(|row| [row[1], row[4]])));
    }
    let known = table.rows.iter().filter(|row| row[0] > 0.1).map(|row| [row[0], row[2]]);
    curves.push(curve("prototype, bare", Style::Markers, partition::NAMES.len(), known));
    Chart {
        title: "(c) heat into the body that moves".into(),
        x: Axis::log("velocity va/κ"),
        y: Axis::linear("share"),
        curves,
    }
}

/// Stated over true errors of temperatures, each over the value.
fn errors(stated: &Data) -> Chart {
    let of = |number: f64| {
        let rows =
            stated.rows.iter().filter(move |row| row[4] == number && (row[5] - row[7]).abs() > 1e-12 * row[7].abs());
        rows.map(|row| [(row[5] - row[7]).abs() / row[7].abs(), row[6] / row[7].abs()]).collect::<Vec<_>>()
    };
    let ends = [1e-6, 1e-1].map(|x| [x, x]);
    Chart {
        title: "(d) errors of temperatures".into(),
        x: Axis::log("true error"),
        y: Axis::log("stated error"),
        curves: vec![
            curve("largest", Style::Markers, 0, of(0.0)),
            curve("mean in contact", Style::Markers, 1, of(1.0)),
            curve("share", Style::Markers, 2, of(2.0)),
            curve("equal", Style::Dashed, 3, ends),
        ],
    }
}

//! Bodies that creep under loads in time: growing contacts, closed forms, coated bodies from glassy to relaxed, steps and their stated errors.

mod coats;
mod compliance;
mod held;
mod relaxing;
mod setup;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use compliance::Compliance;
use percoat_app::picture::{Axis, Chart, Style};

pub const STUDY: Study = Study {
    name: "creep",
    title: "Creep: growing contacts, held penetrations, coated bodies from glassy to relaxed, steps in time and their errors",
    files: &[
        "divided.data.csv",
        "ends.data.csv",
        "figure.png",
        "held.data.csv",
        "light.data.csv",
        "orders.data.csv",
        "relaxing.data.csv",
        "stated.data.csv",
        "steps.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    held::add(&mut outcome, quick)?;
    relaxing::add(&mut outcome, quick)?;
    coats::add(&mut outcome, quick)?;
    let caption = "Growing contacts under a held load, the force of a held penetration, and errors of steps in time.";
    outcome.figures.push(("figure", draw::figure(charts(&outcome), caption)));
    Ok(outcome)
}

fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    vec![growing(&find("held")), relaxing_force(&find("relaxing")), errors(&find("stated"))]
}

/// Penetration of growing contacts over J(t) at the beginning.
fn growing(held: &Data) -> Chart {
    let mut curves = Vec::new();
    for (number, name) in setup::SURFACES.into_iter().enumerate() {
        let rows = || held.rows.iter().filter(move |row| row[0] == number as f64 && row[1] == 2.0 && row[2] == 0.0);
        let Some(first) = rows().find(|row| row[4] == 0.0).map(|row| row[6]) else { continue };
        let compliance = Compliance::new(1.0, held::SERIES[2]);
        let over = |row: &Vec<f64>| compliance.after(row[4]) / compliance.after(0.0);
        let mut known: Vec<[f64; 2]> =
            rows().filter(|row| row[3] == 40.0).map(|row| [over(row), row[6] / first]).collect();
        known.sort_by(|a, b| a[0].total_cmp(&b[0]));
        curves.push(curve(format!("elastic, {name}"), Style::Line, number, known));
        let found = rows().map(|row| [over(row), row[5] / first]);
        curves.push(curve(format!("percoat, {name}"), Style::Markers, number, found));
    }
    Chart {
        title: "(a) growing contacts under a held load".into(),
        x: Axis::log("compliance J(t)/J(0)"),
        y: Axis::log("penetration over the first one"),
        curves,
    }
}

/// Force of a held penetration in time.
fn relaxing_force(relaxing: &Data) -> Chart {
    let rows =
        |tolerance: f64| relaxing.rows.iter().filter(move |row| row[0] == 0.0 && row[1] == tolerance && row[2] > 0.0);
    let exact = draw::logarithmic(0.05, 12.0, 80).into_iter().map(|time| [time, relaxing::modulus(time)]);
    Chart {
        title: "(b) held penetration".into(),
        x: Axis::log("time"),
        y: Axis::linear("force over the relaxed one"),
        curves: vec![
            curve("G(t)/G(∞)", Style::Line, 0, exact),
            curve("percoat, tolerance 10⁻²", Style::Markers, 1, rows(1e-2).map(|row| [row[2], row[3]])),
            curve("percoat, tolerance 10⁻³", Style::Markers, 2, rows(1e-3).map(|row| [row[2], row[3]])),
        ],
    }
}

/// Stated over true errors in time.
fn errors(stated: &Data) -> Chart {
    let of = |column: usize, scale: f64| {
        let rows = stated.rows.iter().filter(move |row| row[column] > 0.0 && row[column + 1] > 0.0);
        rows.map(move |row| [row[column] / scale, row[column + 1] / scale]).collect::<Vec<_>>()
    };
    let ends = [1e-9, 1e-1].map(|x| [x, x]);
    Chart {
        title: "(c) errors of steps in time".into(),
        x: Axis::log("true error"),
        y: Axis::log("stated error"),
        curves: vec![
            curve("penetration", Style::Markers, 0, of(5, 1.0)),
            curve("pressure", Style::Markers, 1, of(7, 1.0)),
            curve("equal", Style::Dashed, 2, ends),
        ],
    }
}

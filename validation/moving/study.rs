//! Loads that move steadily over bodies that relax: waves, Hunter's cylinder, coated bodies, slow motion, energy, iterations, certificates.

mod bound;
mod counts;
mod energy;
mod hunter;
mod plane;
mod rolling;
pub(crate) mod setup;
mod slow;
mod spectrum;
mod square;
pub(crate) mod strip;
mod waves;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use hunter::Hunter;
use percoat_app::picture::{Axis, Chart, Style};

pub const STUDY: Study = Study {
    name: "moving",
    title: "Moving over bodies that relax: waves, Hunter's cylinder, coated bodies, slow motion, energy, iterations",
    files: &[
        "bounds.data.csv",
        "cylinders.data.csv",
        "energy.data.csv",
        "figure.png",
        "given.data.csv",
        "iterations.data.csv",
        "paraboloids.data.csv",
        "plane.data.csv",
        "slow.data.csv",
        "stated.data.csv",
        "waves.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    waves::add(&mut outcome, quick)?;
    rolling::add(&mut outcome, quick)?;
    plane::add(&mut outcome, quick)?;
    square::add(&mut outcome, quick)?;
    slow::add(&mut outcome, quick)?;
    energy::add(&mut outcome, quick)?;
    counts::add(&mut outcome, quick)?;
    bound::add(&mut outcome, quick)?;
    let caption = "Friction of a cylinder over the velocity, errors of coated bodies, convolutions, and certificates.";
    outcome.figures.push(("figure", draw::figure(charts(&outcome), caption)));
    Ok(outcome)
}

fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    vec![
        over_velocity(&find("cylinders")),
        of_coats(&find("paraboloids")),
        convolutions(&find("iterations")),
        certificates(&find("bounds")),
    ]
}

/// Friction of a cylinder: Hunter's closed form, the slow law and percoat.
fn over_velocity(cylinders: &Data) -> Chart {
    let ways = draw::logarithmic(1e-4, 10.0, 120);
    let mut curves = Vec::new();
    for (colour, ratio) in [2.0, 10.0, 100.0].into_iter().enumerate() {
        let exact = ways.iter().map(|&way| [way, Hunter::new(ratio, way, rolling::LOAD).friction]);
        curves.push(curve(format!("Hunter, r = {ratio}"), Style::Line, colour, exact));
        let found = cylinders.rows.iter().filter(|row| row[0] == ratio).map(|row| [row[1], row[3]]);
        curves.push(curve(format!("percoat, r = {ratio}"), Style::Markers, colour, found));
    }
    let slow = ways.iter().map(|&way| [way, 9.0 * way]).filter(|point| point[1] < 0.1);
    curves.push(curve("slow law, r = 10", Style::Dashed, 3, slow));
    Chart {
        title: "(a) friction of a cylinder".into(),
        x: Axis::log("way in the relaxation time, vτ/R"),
        y: Axis::log("friction by hysteresis μ"),
        curves,
    }
}

/// Errors of the friction of coated bodies below paraboloids over the samples, and the stated ones.
fn of_coats(paraboloids: &Data) -> Chart {
    let errors = paraboloids.rows.iter().map(|row| [row[2], (row[4] - row[8]).abs()]);
    let stated = paraboloids.rows.iter().map(|row| [row[2], row[6]]);
    Chart {
        title: "(b) friction of coated bodies".into(),
        x: Axis::log("samples along a side"),
        y: Axis::log("error of μ"),
        curves: vec![
            curve("true error", Style::Markers, 0, errors.filter(|point| point[1] > 0.0)),
            curve("stated error", Style::Markers, 1, stated),
        ],
    }
}

/// Convolutions over the samples of a side at r = 10 and 1000.
fn convolutions(iterations: &Data) -> Chart {
    let mut curves = Vec::new();
    for (style, ratio) in [(Style::LineMarkers, 10.0), (Style::Dashed, 1000.0)] {
        for (case, name) in counts::NAMES.into_iter().enumerate() {
            let rows = iterations.rows.iter().filter(|row| row[0] == case as f64 && row[1] == ratio);
            let points: Vec<[f64; 2]> = rows.map(|row| [row[2], row[4]]).collect();
            if !points.is_empty() {
                curves.push(curve(format!("{name}, r = {ratio}"), style, case, points));
            }
        }
    }
    Chart {
        title: "(c) convolutions".into(),
        x: Axis::log("samples along a side"),
        y: Axis::log("convolutions"),
        curves,
    }
}

/// Stated bounds over true errors of the pressure.
fn certificates(bounds: &Data) -> Chart {
    let points: Vec<[f64; 2]> = bounds.rows.iter().map(|row| [row[3], row[4]]).collect();
    let ends = [1e-9, 1e-2].map(|x| [x, x]);
    Chart {
        title: "(d) certificate".into(),
        x: Axis::log("error of the pressure"),
        y: Axis::log("stated bound"),
        curves: vec![curve("contacts", Style::Markers, 0, points), curve("equal", Style::Dashed, 1, ends)],
    }
}

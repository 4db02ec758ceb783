//! Statements of the literature on sliding over layers that relax or warm up, each with its numbers and its verdict.

mod base;
mod heat;
mod layers;
mod neighbours;
mod setup;
mod sheet;
mod statement;
mod thin;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Style};
use setup::{HERTZ, POISSON, RADIUS};

pub const STUDY: Study = Study {
    name: "relaxing-layers",
    title: "Sliding over layers that relax or warm up: statements of the literature",
    files: &[
        "bases.data.csv",
        "figure.png",
        "influences.data.csv",
        "maxima.data.csv",
        "mutual.data.csv",
        "neighbours.data.csv",
        "periods.data.csv",
        "temperatures.data.csv",
        "thin.data.csv",
        "velocities.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    layers::add(&mut outcome, quick)?;
    base::add(&mut outcome, quick)?;
    thin::add(&mut outcome, quick)?;
    neighbours::add(&mut outcome, quick)?;
    heat::add(&mut outcome, quick)?;
    let caption = "Friction of layers over the velocity, its largest value over the thickness, springs for a layer, and the mutual effect.";
    outcome.figures.push(("figure", draw::figure(charts(&outcome), caption)));
    Ok(outcome)
}

fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    vec![
        over_velocity(&find("velocities")),
        over_thickness(&find("maxima")),
        springs(&find("thin")),
        mutual(&find("periods")),
    ]
}

/// Friction over the velocity, a curve for each thickness.
fn over_velocity(velocities: &Data) -> Chart {
    let mut curves = Vec::new();
    for (colour, thickness) in layers::THICKNESSES.into_iter().enumerate() {
        let points: Vec<[f64; 2]> =
            layers::curve(velocities, POISSON, thickness).iter().map(|row| [row[2], row[3] * RADIUS / HERTZ]).collect();
        let label = if thickness == 0.0 { "half-space".to_owned() } else { format!("h = {thickness} a₀") };
        if !points.is_empty() {
            curves.push(curve(label, Style::LineMarkers, colour, points));
        }
    }
    Chart {
        title: "(a) layers on a rigid base, ν = 0.3".into(),
        x: Axis::log("way in the relaxation time, vτ/a₀"),
        y: Axis::log("friction μ R/a₀"),
        curves,
    }
}

/// Largest friction over the thickness, over that of the half-space.
fn over_thickness(maxima: &Data) -> Chart {
    let mut curves = Vec::new();
    for (colour, poisson) in [POISSON, 0.45].into_iter().enumerate() {
        let rows = || maxima.rows.iter().filter(|row| row[0] == poisson);
        let bare = rows().find(|row| row[1] == 0.0).map_or(f64::NAN, |row| row[3]);
        let points: Vec<[f64; 2]> = rows().filter(|row| row[1] > 0.0).map(|row| [row[1], row[3] / bare]).collect();
        if !points.is_empty() {
            curves.push(curve(format!("ν = {poisson}"), Style::LineMarkers, colour, points));
        }
    }
    curves.push(curve("half-space", Style::Dashed, 2, [[0.25, 1.0], [4.0, 1.0]]));
    Chart {
        title: "(b) largest friction of a layer over that of the half-space".into(),
        x: Axis::log("thickness h/a₀"),
        y: Axis::linear("ratio"),
        curves,
    }
}

/// Friction and peak over those of springs side by side.
fn springs(thin: &Data) -> Chart {
    let ways = [0.03, 0.1, 0.3];
    let mut curves = Vec::new();
    for (style, column, what) in [(Style::LineMarkers, 3, "friction"), (Style::Dashed, 6, "peak")] {
        for (colour, way) in ways.into_iter().enumerate() {
            let rows = thin.rows.iter().filter(|row| row[0] == POISSON && row[2] == way);
            let points: Vec<[f64; 2]> = rows.map(|row| [row[1], row[column] / row[column + 2]]).collect();
            if !points.is_empty() {
                curves.push(curve(format!("{what}, vτ = {way} a"), style, colour, points));
            }
        }
    }
    Chart {
        title: "(c) a layer over springs side by side, ν = 0.3".into(),
        x: Axis::log("thickness h/a"),
        y: Axis::linear("ratio"),
        curves,
    }
}

/// Friction over the period of the asperities.
fn mutual(periods: &Data) -> Chart {
    let curves = neighbours::CASES.iter().enumerate().map(|(case, (_, [exponent, way, thickness]))| {
        let rows = periods.rows.iter().filter(|row| row[0] == case as f64);
        let profile = if *exponent == 2.0 { "r²" } else { "r⁴" };
        let label = format!("{profile}, vτ = {way} a₀, coat {thickness} a₀");
        curve(label, Style::LineMarkers, case, rows.map(|row| [row[1], row[2] * RADIUS / HERTZ]))
    });
    Chart {
        title: "(d) asperities on a coated half-space".into(),
        x: Axis::log("period over a₀"),
        y: Axis::log("friction μ R/a₀"),
        curves: curves.collect(),
    }
}

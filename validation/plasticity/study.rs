//! Hardness, 0 ≤ p ≤ H: dense solutions, a wave in closed form, and a paraboloid alone on bare and coated bodies.

mod ball;
mod bodies;
mod dense;
mod wave;

use super::draw::{self, curve, slope};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};

pub const STUDY: Study = Study {
    name: "plasticity",
    title: "Hardness: dense solutions, a wave in closed form, a paraboloid alone, unloading, thin layers",
    files: &[
        "balls.data.csv",
        "figure.png",
        "path.data.csv",
        "periodic.data.csv",
        "unloading.data.csv",
        "wave-pressure.data.csv",
        "wave.data.csv",
    ],
    run,
    quick: None,
};

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let periodic = dense::periodic(&mut outcome)?;
    let path = dense::path(&mut outcome)?;
    let wave = wave::wave(&mut outcome)?;
    let profiles = wave::profiles(&mut outcome)?;
    let balls = ball::balls(&mut outcome)?;
    let unloading = ball::unloading(&mut outcome)?;
    outcome.figures.push(("figure", figure(&wave, &profiles, &balls, &unloading)));
    outcome.data = vec![periodic, path, wave, profiles, balls, unloading];
    Ok(outcome)
}

fn figure(wave: &Data, profiles: &Data, balls: &Data, unloading: &Data) -> Figure {
    let mut along = Vec::new();
    for (index, (hardness, mean)) in wave::DRAWN.into_iter().enumerate() {
        let rows = || profiles.rows.iter().filter(move |row| row[0] == hardness && row[1] == mean);
        along.push(curve("", Style::Line, index + 1, rows().map(|row| [row[2], row[4]])));
        let label = format!("H/p* = {hardness}, p̄/p* = {mean}");
        along.push(curve(label, Style::Markers, index + 1, rows().map(|row| [row[2], row[3]])));
    }
    let rms: Vec<[f64; 2]> = wave::rms(wave);
    let orders = vec![
        curve("δ/D, root of the mean square", Style::LineMarkers, 1, rms.iter().copied()),
        slope("N⁻²", -2.0, 0, &rms),
        slope("N^(−3/2)", -1.5, 0, &rms),
    ];
    let bare = || balls.rows.iter().filter(|row| row[0] == ball::BARE);
    let ball = |k: usize| bare().map(move |row| [row[1], row[k]]).collect::<Vec<_>>();
    let mut radii = Vec::new();
    for (colour, (label, [found, exact])) in
        (1..).zip([("a", [8, 3]), ("c", [9, 4]), ("δ", [10, 5]), ("depth", [11, 6])])
    {
        radii.push(curve("", Style::Line, colour, ball(exact)));
        radii.push(curve(label, Style::Markers, colour, ball(found)));
    }
    let mut curves = Vec::new();
    for (index, hardness) in [0.9, 0.7, 0.5, 0.3].into_iter().enumerate() {
        let rows = || unloading.rows.iter().filter(move |row| row[0] == hardness);
        curves.push(curve("", Style::Line, index + 1, rows().map(|row| [row[3], row[1]])));
        curves.push(curve(format!("H/p₀ = {hardness}"), Style::Markers, index + 1, rows().map(|row| [row[5], row[1]])));
    }
    let chart = |title: &str, x: Axis, y: Axis, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("Pressure of a wave", Axis::linear("x/π"), Axis::linear("p/H"), along),
        chart("Error of its approach", Axis::log("N, samples a wave"), Axis::log("error"), orders),
        chart("Paraboloid under one load", Axis::linear("H/p₀"), Axis::linear("over those without hardness"), radii),
        chart("Its unloading", Axis::linear("δ"), Axis::linear("P over the full load"), curves),
    ];
    draw::figure(panels, "Lines: closed forms and independent tables; markers: found.")
}

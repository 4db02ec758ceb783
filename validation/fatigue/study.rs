//! Fatigue under sliding: ranges of τ₁ along the path, endurance limits, coatings and their interfaces, and where damage is largest.

mod coated;
mod lines;
mod places;
mod sliding;
mod wave;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};

pub const STUDY: Study = Study {
    name: "fatigue",
    title: "Fatigue under sliding: ranges of τ₁, endurance limits, coatings, interfaces, where damage is largest",
    files: &[
        "coated.data.csv",
        "contact.data.csv",
        "endurance.data.csv",
        "figure.png",
        "largest.data.csv",
        "places.data.csv",
        "sliding.data.csv",
        "wave.data.csv",
    ],
    run,
    quick: None,
};

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let sliding = sliding::sliding(&mut outcome)?;
    let largest = sliding::largest(&mut outcome)?;
    let endurance = sliding::endurance(&mut outcome)?;
    let wave = wave::wave(&mut outcome)?;
    let coated = coated::given(&mut outcome)?;
    let contact = coated::contact(&mut outcome)?;
    let places = places::places(&mut outcome)?;
    outcome.figures.push(("figure", figure(&sliding, &largest, &wave, &coated)));
    outcome.data = vec![sliding, largest, endurance, wave, coated, contact, places];
    Ok(outcome)
}

fn figure(sliding: &Data, largest: &Data, wave: &Data, coated: &Data) -> Figure {
    let pair = |colour: usize, label: String, rows: Vec<[f64; 3]>| {
        [
            curve("", Style::Line, colour, rows.iter().map(|&[x, _, exact]| [x, exact])),
            curve(label, Style::Markers, colour, rows.iter().map(|&[x, found, _]| [x, found])),
        ]
    };
    let of = |data: &Data, wanted: &dyn Fn(&[f64]) -> bool, columns: [usize; 3]| -> Vec<[f64; 3]> {
        data.rows.iter().filter(|row| wanted(row)).map(|row| columns.map(|k| row[k])).collect()
    };
    let mut depths = Vec::new();
    for (index, mu) in [0.0, 0.1, 0.3, 0.5].into_iter().enumerate() {
        let wanted = |row: &[f64]| row[0] == 0.3 && row[1] == mu && row[2] == 0.0 && row[3] > 0.0;
        depths.extend(pair(index + 1, format!("μ = {mu}"), of(sliding, &wanted, [3, 4, 5])));
    }
    let mut tops = Vec::new();
    for (index, nu) in [0.0, 0.2, 0.3, 0.5].into_iter().enumerate() {
        tops.extend(pair(index + 1, format!("ν = {nu}"), of(largest, &|row| row[0] == nu, [1, 2, 3])));
    }
    let mut layers = Vec::new();
    for (index, (modulus, thickness)) in [(4.0, 1.0), (0.5, 1.0), (4.0, 0.3), (0.5, 0.3)].into_iter().enumerate() {
        let wanted = |row: &[f64]| row[0] == modulus && row[1] == thickness && row[2] == 0.3 && row[3] == 0.0;
        let label = format!("E₁/E₂ = {modulus}, h = {thickness}a");
        layers.extend(pair(index + 1, label, of(coated, &wanted, [4, 6, 7])));
    }
    let mut waves = Vec::new();
    for (index, nu) in [0.0, 0.3].into_iter().enumerate() {
        waves.extend(pair(index + 1, format!("ν = {nu}"), of(wave, &|row| row[0] == nu, [1, 2, 3])));
    }
    let chart = |title: &str, x: Axis, curves| Chart {
        title: title.to_owned(),
        x,
        y: Axis::linear("Δτ₁/p₀").from_to(0.0, f64::NAN),
        curves,
    };
    let panels = vec![
        chart("Sliding paraboloid, y = 0, ν = 0.3", Axis::log("z/a"), depths),
        chart("Largest range", Axis::linear("friction μ"), tops),
        chart("Coated, y = 0, μ = 0.3", Axis::linear("z/a"), layers),
        chart("Wave in complete contact", Axis::linear("kz"), waves),
    ];
    draw::figure(panels, "Lines: independent tables, straight between their places; markers: found.")
}

//! Adhesion: pull-off and jumps of spheres, JKR on layers, waves, lattices, closed paths, and iterations.

mod counts;
mod lattice;
mod layers;
mod loops;
mod setup;
mod spheres;
mod waves;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Style};

pub const STUDY: Study = Study {
    name: "adhesion",
    title: "Adhesion: pull-off of spheres and waves, JKR on layers, lattices, closed paths, and iterations",
    files: &[
        "figure.png",
        "iterations.data.csv",
        "lattice.data.csv",
        "layers.data.csv",
        "loops.data.csv",
        "spheres.data.csv",
        "thin.data.csv",
        "waves.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    spheres::add(&mut outcome, quick)?;
    waves::add(&mut outcome, quick)?;
    loops::add(&mut outcome)?;
    counts::add(&mut outcome, quick)?;
    if !quick {
        lattice::add(&mut outcome)?;
        layers::add(&mut outcome)?;
    }
    outcome.figures.push((
        "figure",
        draw::figure(
            charts(&outcome),
            "Pull-off of spheres by Maugis' theory and on layers by JKR, and iterations of a step.",
        ),
    ));
    Ok(outcome)
}

/// Pull-off of spheres over λ, that on layers over the reference, and iterations over the number of points.
fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    let (spheres, layers, iterations) = (find("spheres"), find("layers"), find("iterations"));
    let of = |data: &Data, x: usize, y: usize| data.rows.iter().map(move |row| [row[x], row[y]]).collect::<Vec<_>>();
    let counted = (0u8..).zip(counts::NAMES).map(|(index, name)| {
        let rows = iterations.rows.iter().filter(|row| row[0] == f64::from(index));
        curve(name, Style::Markers, usize::from(index), rows.map(|row| [row[1], row[3]]))
    });
    vec![
        Chart {
            title: "(a) pull-off of spheres".into(),
            x: Axis::log("Maugis' parameter λ"),
            y: Axis::linear("force over πwR"),
            curves: vec![
                curve("Maugis", Style::Line, 0, of(&spheres, 0, 5)),
                curve("percoat", Style::Markers, 1, of(&spheres, 0, 3)),
            ],
        },
        Chart {
            title: "(b) pull-off on layers".into(),
            x: Axis::linear("layered body"),
            y: Axis::linear("force over πwR"),
            curves: vec![
                curve("JKR", Style::LineMarkers, 0, of(&layers, 0, 4)),
                curve("zone of a fifth of the radius", Style::Markers, 1, of(&layers, 0, 1)),
                curve("a tenth", Style::Markers, 3, of(&layers, 0, 2)),
                curve("extrapolated", Style::Markers, 2, of(&layers, 0, 3)),
            ],
        },
        Chart {
            title: "(c) iterations of a step".into(),
            x: Axis::log("points along a side"),
            y: Axis::linear("iterations"),
            curves: counted.collect(),
        },
    ]
}

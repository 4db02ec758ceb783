//! Wear along a path of sliding: waves in complete contact, three levels, both bodies, and a worn sphere.

mod decay;
mod path;
mod periodic;
mod sphere;

use super::draw::{self, curve, slope};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};

pub const STUDY: Study = Study {
    name: "wear",
    title: "Wear: waves in complete contact, three levels, both bodies swept, a worn sphere",
    files: &[
        "bodies.data.csv",
        "decay.data.csv",
        "figure.png",
        "levels.data.csv",
        "orders.data.csv",
        "sphere.data.csv",
    ],
    run,
    quick: None,
};

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let decay = decay::decay(&mut outcome)?;
    let orders = decay::orders(&mut outcome)?;
    let levels = periodic::levels(&mut outcome)?;
    let bodies = periodic::bodies(&mut outcome)?;
    let sphere = sphere::sphere(&mut outcome)?;
    outcome.figures.push(("figure", figure(&orders, &levels, &bodies, &sphere)));
    outcome.data = vec![decay, orders, levels, bodies, sphere];
    Ok(outcome)
}

fn figure(orders: &Data, levels: &Data, bodies: &Data, sphere: &Data) -> Figure {
    let points = |data: &Data, [x, y]: [usize; 2]| data.rows.iter().map(|row| [row[x], row[y]]).collect::<Vec<_>>();
    let mut errors = Vec::new();
    for (index, name) in decay::NAMES.into_iter().enumerate() {
        let column = |k: usize| {
            let rows = orders.rows.iter().filter(|row| row[0] == index as f64);
            rows.map(|row| [row[1], row[k].abs()]).collect::<Vec<_>>()
        };
        errors.push(curve(name, Style::LineMarkers, index + 1, column(2)));
        errors.push(curve("", Style::Markers, index + 1, column(3)));
        if index == 0 {
            errors.push(slope("1/n", -1.0, 0, &column(2)));
            errors.push(slope("1/n²", -2.0, 0, &column(3)));
        }
    }
    let mut shares = Vec::new();
    for level in 0..3 {
        shares.push(curve("", Style::Line, level + 1, points(levels, [0, 6 + level])));
        shares.push(curve(format!("level {}", level + 1), Style::Markers, level + 1, points(levels, [0, 3 + level])));
    }
    let mut worn = Vec::new();
    for (index, (cell, k1, name)) in [
        (1.0, 1.0, "rectangle, both"),
        (2.0, 1.0, "oblique, both"),
        (1.0, 0.0, "rectangle, body"),
        (2.0, 0.0, "oblique, body"),
    ]
    .into_iter()
    .enumerate()
    {
        let column = |k: usize| {
            let rows = bodies.rows.iter().filter(|row| row[0] == cell && row[1] == k1);
            rows.map(|row| [row[3], row[k]]).collect::<Vec<_>>()
        };
        worn.push(curve("", Style::Line, index + 1, column(5)));
        worn.push(curve(name, Style::Markers, index + 1, column(4)));
    }
    let mut ball = Vec::new();
    for (colour, (name, [found, exact])) in
        (1..).zip([("δ", [1, 5]), ("p on the axis", [2, 6]), ("worn there", [3, 7]), ("a", [4, 8])])
    {
        ball.push(curve("", Style::Line, colour, points(sphere, [0, exact])));
        ball.push(curve(name, Style::Markers, colour, points(sphere, [0, found])));
    }
    let chart = |title: &str, x: Axis, y: Axis, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("A wave in n steps: implicit, of a path", Axis::log("n"), Axis::log("relative error"), errors),
        chart("Loads of three levels", Axis::log("ks"), Axis::linear("share of the load"), shares),
        chart("Both bodies", Axis::linear("s"), Axis::linear("δ"), worn),
        chart("Worn sphere", Axis::log("ks E*/a₀"), Axis::log("value"), ball),
    ];
    draw::figure(panels, "Lines: independent tables; markers: found, twice as many steps extrapolated.")
}

//! One contact in free space: paraboloids and cones on layers, Hertz' ellipse, windows of other sizes, and a sliding sphere.
//!
//! Nothing is periodic here, so that nothing is taken off: what differs from the references is the grid's own error.

mod bodies;
mod shapes;
mod sliding;

use super::alone::{Alone, POINTS, WINDOW, checks};
use super::draw::{self, curve, slope};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use bodies::{BALL, BODIES, INDENTATION, body, rows};
use percoat_app::picture::{Axis, Chart, Figure, Style};

pub const STUDY: Study = Study {
    name: "free-space",
    title: "One contact in free space: layers, cones, an ellipse, windows, a sliding sphere",
    files: &[
        "cones.data.csv",
        "ellipse.data.csv",
        "figure.png",
        "indentation.data.csv",
        "order.data.csv",
        "pressure.data.csv",
        "stress.data.csv",
    ],
    run: || run(&[0, 1, 2, 3, 4, 5, 6], &[64, 128, 256]),
    quick: Some(|| run(&[2, 4], &[])),
};

const PROFILES: &str = include_str!("profiles.csv");

/// Bodies and radii whose error is followed from grid to grid.
const FOLLOWED: [(usize, f64); 3] = [(1, 1.0), (2, 5.0), (3, 2.0)];
/// The radius at which pressures are drawn.
const DRAWN: f64 = 2.0;

/// Distances from the axis, and what may be left of the pressure over its maximum.
const PRESSED: [(&str, [f64; 2], f64); 2] = [("r < 0.7a", [0.0, 0.7], 1e-3), ("0.7a to 0.95a", [0.7, 0.95], 5e-3)];

/// The studied `bodies`, and the numbers of samples from which the order is read.
fn run(bodies: &[usize], grids: &[usize]) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let (indentation, pressure) = indentation(bodies, &mut outcome)?;
    let order = order(grids, &mut outcome)?;
    let cones = shapes::cones(bodies, &mut outcome)?;
    let ellipse = shapes::ellipse(&mut outcome)?;
    shapes::windows(&mut outcome)?;
    let stress = sliding::stresses(&mut outcome)?;
    outcome.figures.push(("figure", figure(&indentation, &pressure, &order, &stress)?));
    outcome.data = vec![indentation, pressure, order, cones, ellipse, stress];
    Ok(outcome)
}

/// Every body and radius, and the pressures where they are in the tables.
fn indentation(bodies: &[usize], outcome: &mut Outcome) -> Result<(Data, Data), StudyError> {
    let table = Data::parse("indentation", INDENTATION)?;
    let profiles = Data::parse("profiles", PROFILES)?;
    let columns = ["body", "a_exact", "P", "delta_exact", "p0_exact", "S_exact", "delta", "p0", "a", "S"];
    let mut data = Data::new("indentation", &columns);
    let mut pressure = Data::new("pressure", &["body", "a", "r", "p", "p_exact"]);
    for &number in bodies {
        for row in rows(&table, number) {
            let (radius, force) = (row[1], row[2]);
            let alone = Alone::new(BALL, body(number)?, [radius, force], POINTS)?;
            data.rows.push([&row[..], &alone.found].concat());
            let of_contact = |row: &&Vec<f64>| row[0] == number as f64 && row[1] == radius;
            let known: Vec<f64> = profiles.rows.iter().filter(of_contact).map(|row| row[3]).collect();
            if !known.is_empty() {
                read_pressure(&mut pressure, number, radius, &alone, &known);
            }
        }
        let (name, is_own) = (BODIES[number].0, |row: &[f64]| row[0] == number as f64);
        outcome.checks.extend(checks(name, &data, is_own));
        for (range, [low, high], tolerance) in PRESSED {
            let within = |row: &&Vec<f64>| is_own(row) && (low..high).contains(&(row[2] / row[1]));
            let pairs = pressure.rows.iter().filter(within).map(|row| {
                let peak = rows(&pressure, number)
                    .filter(|other| other[1] == row[1])
                    .map(|other| other[4])
                    .fold(0.0, f64::max);
                (row[3] / peak, row[4] / peak)
            });
            let name = format!("{name}: p over its maximum, {range}");
            outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(tolerance)));
        }
    }
    Ok((data, pressure))
}

/// The pressure along the row of samples through the axis, beside the tabulated one: p/√(1 − (r/a)²) is a polynomial in r², its
/// nodes those of Chebyshev.
fn read_pressure(data: &mut Data, body: usize, radius: f64, alone: &Alone, known: &[f64]) {
    let count = known.len() as f64;
    let nodes: Vec<(f64, f64)> = (0..known.len())
        .map(|i| {
            let angle = std::f64::consts::PI * (i as f64 + 0.5) / count;
            ((0.5 * angle).sin().powi(2), if i % 2 == 0 { angle.sin() } else { -angle.sin() })
        })
        .collect();
    let spacing = WINDOW * radius / POINTS as f64;
    for i in 0..POINTS / 2 {
        let r = i as f64 * spacing;
        let square = (r / radius).powi(2);
        if square >= 0.95 * 0.95 {
            break;
        }
        let [above, below] = nodes.iter().zip(known).fold([0.0; 2], |[above, below], (&(node, weight), p)| {
            let share = weight / (square - node);
            [above + share * p / (1.0 - node).sqrt(), below + share]
        });
        let found = alone.step.pressure()[[POINTS / 2 + i, POINTS / 2]];
        data.rows.push(vec![body as f64, radius, r, found, (1.0 - square).sqrt() * above / below]);
    }
}

/// Errors of the penetration from grid to grid.
fn order(grids: &[usize], outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse("indentation", INDENTATION)?;
    let mut data = Data::new("order", &["body", "a", "points", "error"]);
    if grids.is_empty() {
        return Ok(data);
    }
    for (number, radius) in FOLLOWED {
        let row = rows(&table, number).find(|row| row[1] == radius).ok_or("no such row")?;
        for &points in grids {
            let alone = Alone::new(BALL, body(number)?, [radius, row[2]], points)?;
            data.rows.push(vec![number as f64, radius, points as f64, alone.found[0] / row[3] - 1.0]);
        }
    }
    let scaled = data.rows.iter().map(|row| (row[3] * (row[2] / POINTS as f64).powi(2), 0.0));
    let name = "64 to 256 samples: error of the penetration times (N/128)²";
    outcome.checks.push(Check::worst(name, scaled, Tolerance::Absolute(3e-4)));
    Ok(data)
}

fn figure(indentation: &Data, pressure: &Data, order: &Data, stress: &Data) -> Result<Figure, StudyError> {
    let mut pressures = Vec::new();
    for (colour, number) in (1..).zip([0, 1, 2, 3]) {
        let mean = rows(indentation, number).find(|row| row[1] == DRAWN);
        let Some(mean) = mean.map(|row| row[2] / (std::f64::consts::PI * DRAWN * DRAWN)) else { continue };
        let drawn = || rows(pressure, number).filter(|row| row[1] == DRAWN);
        pressures.push(curve("", Style::Line, colour, drawn().map(|row| [row[2] / DRAWN, row[4] / mean])));
        let found = drawn().step_by(3).map(|row| [row[2] / DRAWN, row[3] / mean]);
        pressures.push(curve(BODIES[number].0, Style::Markers, colour, found));
    }
    let mut errors = Vec::new();
    for (colour, (number, (name, _))) in (1..).zip(BODIES.into_iter().enumerate()) {
        let points = rows(indentation, number).map(|row| [row[1], (row[6] / row[3] - 1.0).abs()]);
        errors.push(curve(name, Style::LineMarkers, colour, points));
    }
    let mut orders = Vec::new();
    for (colour, (number, radius)) in (1..).zip(FOLLOWED) {
        let points: Vec<[f64; 2]> = rows(order, number).map(|row| [row[2], row[3].abs()]).collect();
        if colour == 1 {
            orders.push(slope("slope −2", -2.0, 0, &points));
        }
        orders.push(curve(format!("{}, a/h = {radius}", BODIES[number].0), Style::LineMarkers, colour, points));
    }
    let chart = |title: &str, x: Axis, y: Axis, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("Pressure, a/h = 2", Axis::linear("r/a"), Axis::linear("p over its mean"), pressures),
        chart("128 samples over 2.7a", Axis::log("a/h"), Axis::log("relative error of δ"), errors),
        chart("Convergence", Axis::log("samples over 2.7a"), Axis::log("relative error of δ"), orders),
        sliding::chart(stress),
    ];
    Ok(draw::figure(panels, "Lines: integral equation and closed form; markers: solved."))
}

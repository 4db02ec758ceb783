//! Two elastic bodies: their compliances add, alone and among images.
//!
//! The periodic reference is the same discrete problem solved densely, so that pressures agree to the tolerance of the solver, not to
//! the error of the grid.

use super::alone::{Alone, POINTS, QUANTITIES, checks, half_space};
use super::draw::{self, curve};
use super::steps::Steps;
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::Hertz;
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::Interface::Bonded;
use percoat_core::body::{Bodies, HalfSpace};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;

pub const STUDY: Study = Study {
    name: "two-bodies",
    title: "Two elastic bodies, both coated: one contact alone, and three levels against a dense solution",
    files: &["diagonal.data.csv", "figure.png", "indentation.data.csv", "periodic.data.csv"],
    run,
    quick: None,
};

const INDENTATION: &str = include_str!("indentation.csv");
const PERIODIC: &str = include_str!("periodic.csv");
const PRESSURES: &str = include_str!("pressures.csv");

/// A ball of unit radius.
const BALL: Shape = Shape::Paraboloid { radius: 1.0 };
/// Samples along the side of the cell.
const SAMPLES: usize = 48;
/// Radius of the paraboloids on the cell.
const RADIUS: f64 = 0.5;
/// Error of pressures over the largest one, and of penetrations: the solver's tolerance is 10⁻¹².
const SOLVED: f64 = 1e-8;
/// Mean pressure of the drawn pressures.
const DRAWN: f64 = 0.03;

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let indentation = indentation(&mut outcome)?;
    composite(&mut outcome)?;
    let (periodic, diagonal) = periodic(&mut outcome)?;
    outcome.figures.push(("figure", figure(&indentation, &diagonal)));
    outcome.data = vec![indentation, periodic, diagonal];
    Ok(outcome)
}

/// One contact alone: body and counterbody are coated.
fn indentation(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let body = half_space(&[(1.0, 2.0, 0.3, Bonded)], [1.0, 0.3])?;
    let counterbody = half_space(&[(0.5, 0.5, 0.45, Bonded)], [3.0, 0.25])?;
    let bodies = Bodies::elastic(body.clone(), counterbody.clone());
    let columns = ["a_exact", "P", "delta_exact", "p0_exact", "S_exact", "delta", "p0", "a", "S"];
    let mut data = Data::new("indentation", &columns);
    for row in Data::parse("indentation", INDENTATION)?.rows {
        let alone = Alone::new(BALL, &bodies, [row[0], row[1]], POINTS)?;
        data.rows.push([&row[..], &alone.found].concat());
    }
    outcome.checks.extend(checks("alone, a/h = 0.02 to 20", &data, |_| true));
    // The other body is the counterbody.
    let row = &data.rows[3];
    let exchanged = Alone::new(BALL, Bodies::elastic(counterbody, body), [row[0], row[1]], POINTS)?;
    let pairs: Vec<(f64, f64)> = exchanged.found.into_iter().zip(row[5..].iter().copied()).collect();
    let name = "alone, a/h = 1, bodies exchanged: δ, p₀, a, dP/dδ";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Relative(SOLVED)).of_refinement());
    Ok(data)
}

/// Two bodies without layers: Hertz with 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂.
fn composite(outcome: &mut Outcome) -> Result<(), StudyError> {
    let modulus = 1.0 / ((1.0 - 0.09) / 2.0 + (1.0 - 0.04) / 0.5);
    let bodies = Bodies::elastic(half_space(&[], [2.0, 0.3])?, half_space(&[], [0.5, 0.2])?);
    let hertz = Hertz::loaded(1.0, 4.0 / 3.0 * modulus, modulus);
    let alone = Alone::new(BALL, bodies, [hertz.radius, hertz.load], POINTS)?;
    let exact = [hertz.penetration, hertz.peak, hertz.radius, 2.0 * modulus * hertz.radius];
    for ((name, tolerance), (found, exact)) in QUANTITIES.into_iter().zip(alone.found.into_iter().zip(exact)) {
        // Without layers the grid leaves a tenth.
        let tolerance = if name == "delta" { 0.1 * tolerance } else { tolerance };
        outcome.checks.push(Check::relative(format!("bare bodies, Hertz: {name}"), found, exact, tolerance));
    }
    Ok(())
}

/// Three levels on a square cell.
fn levels() -> Result<Indenters, StudyError> {
    let sites = vec![vec![[0.0; 2]], vec![[0.5; 2]], vec![[0.5, 0.0], [0.0, 0.5]]];
    let level = |height| Level::new(Shape::Paraboloid { radius: RADIUS }, height);
    let levels = vec![level(0.004)?, level(0.002)?, level(0.0)?];
    Ok(Indenters::new(Lattice::new(Cell::square(1.0)?, sites)?, levels)?)
}

fn coated() -> Result<[HalfSpace; 2], StudyError> {
    Ok([half_space(&[(0.1, 2.0, 0.3, Bonded)], [1.0, 0.3])?, half_space(&[(0.05, 0.5, 0.45, Bonded)], [3.0, 0.25])?])
}

/// The place among the tabulated samples 0 ≤ j ≤ i ≤ 24 of the one that is the same as a sample by symmetry.
fn tabulated(i: usize, j: usize) -> usize {
    let [i, j] = [i, j].map(|k| k.min(SAMPLES - k));
    let (i, j) = (i.max(j), i.min(j));
    i * (i + 1) / 2 + j
}

/// Every sample of the dense solutions, with the elastic counterbody, exchanged, and under a rigid one.
fn periodic(outcome: &mut Outcome) -> Result<(Data, Data), StudyError> {
    let (table, pressures) = (Data::parse("periodic", PERIODIC)?, Data::parse("pressures", PRESSURES)?);
    let columns = ["two", "mean", "delta", "delta_exact", "share0", "share1", "share2", "pressure_error"];
    let mut data = Data::new("periodic", &columns);
    let mut diagonal = Data::new("diagonal", &["two", "mean", "x", "p", "p_exact"]);
    let [body, counterbody] = coated()?;
    let both = Bodies::elastic(body.clone(), counterbody.clone());
    let exchanged = Bodies::elastic(counterbody, body.clone());
    for (name, two, bodies, is_own) in [
        ("rigid counterbody", 0.0, Bodies::from(body), false),
        ("elastic counterbody", 1.0, both, false),
        ("bodies exchanged", 1.0, exchanged, true),
    ] {
        let mut steps = Steps::to(Problem::new(levels()?, bodies), [SAMPLES; 2], 1e-12)?;
        let [mut penetrations, mut shares, mut samples] = [const { Vec::new() }; 3];
        for (index, row) in table.rows.iter().enumerate().filter(|(_, row)| row[0] == two) {
            let &[_, mean, delta, fraction, ref known @ ..] = &row[..] else { return Err("a row too short".into()) };
            let (step, reading) = steps.solve(Load::MeanPressure(mean))?;
            penetrations.push((step.penetration(), delta));
            let found: Vec<f64> = reading.levels.iter().map(|level| level.load_share).collect();
            shares.extend(found.iter().copied().zip(known.iter().copied()));
            let exact = |i: usize, j: usize| pressures.rows[tabulated(i, j)][2 + index];
            let peak = pressures.rows.iter().map(|row| row[2 + index]).fold(0.0, f64::max);
            let pressure = step.pressure();
            let pairs: Vec<(f64, f64)> =
                pressure.indexed_iter().map(|((i, j), p)| (p / peak, exact(i, j) / peak)).collect();
            let touching = pairs.iter().filter(|(p, _)| *p > 0.0).count() as f64 / pairs.len() as f64;
            shares.push((touching, fraction));
            let worst = pairs.iter().map(|(p, exact)| (p - exact).abs()).fold(0.0, f64::max);
            data.rows.push([&[two, mean, step.penetration(), delta], &found[..], &[worst]].concat());
            if !is_own {
                let on_it = (0..=SAMPLES / 2)
                    .map(|i| vec![two, mean, i as f64 / SAMPLES as f64, pressure[[i, i]], exact(i, i)]);
                diagonal.rows.extend(on_it);
            }
            samples.extend(pairs);
        }
        let checks = [
            Check::worst(
                format!("{name}: pressure of every sample over the largest"),
                samples,
                Tolerance::Absolute(SOLVED),
            ),
            Check::worst(format!("{name}: penetration"), penetrations, Tolerance::Relative(SOLVED)),
            Check::worst(
                format!("{name}: shares of the levels, samples in contact"),
                shares,
                Tolerance::Absolute(SOLVED),
            ),
        ];
        outcome.checks.extend(checks.map(|check| if is_own { check.of_refinement() } else { check }));
    }
    Ok((data, diagonal))
}

fn figure(indentation: &Data, diagonal: &Data) -> Figure {
    let mut errors = Vec::new();
    for (colour, (label, [found, exact])) in
        (1..).zip([("δ", [5, 2]), ("p₀", [6, 3]), ("a", [7, 0]), ("dP/dδ", [8, 4])])
    {
        let points = indentation.rows.iter().map(|row| [row[0], (row[found] / row[exact] - 1.0).abs()]);
        errors.push(curve(label, Style::LineMarkers, colour, points));
    }
    let mut along = Vec::new();
    for (colour, (label, two)) in (1..).zip([("rigid counterbody", 0.0), ("elastic counterbody", 1.0)]) {
        let rows = || diagonal.rows.iter().filter(|row| row[0] == two && row[1] == DRAWN);
        along.push(curve("", Style::Line, colour, rows().map(|row| [row[2], row[4]])));
        along.push(curve(label, Style::Markers, colour, rows().map(|row| [row[2], row[3]])));
    }
    let chart = |title: &str, x: Axis, y: Axis, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("Alone", Axis::log("a/h"), Axis::log("relative error"), errors),
        chart("Three levels, on the diagonal", Axis::linear("x = y"), Axis::linear("p"), along),
    ];
    draw::figure(panels, "Right: lines from the dense solution, markers solved; mean pressure 0.03.")
}

//! A sphere that slides on a body like its own: friction does not couple, and the stresses are those of a closed form.

use crate::alone::problem;
use crate::draw::{curve, linear};
use crate::exact::sliding_sphere::{stresses as exact, together};
use crate::steps::Steps;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Style};
use percoat_core::body::{Bodies, Depth, HalfSpace, Material, MeanStress};
use percoat_core::counterbody::Shape;
use percoat_core::friction::Friction;
use percoat_core::load::Load;
use percoat_core::spectral::Step;
use percoat_core::stress::{StressField, StressFields, StressState, SurfaceLine};
use std::f64::consts::PI;

const SLIDING: &str = include_str!("sliding.csv");
const NU: f64 = 0.3;
/// Side of the windows over the contact radius, and samples along it: 39 to the radius, and for the places far away 20.
const WINDOWS: [(f64, usize); 2] = [(4.3, 168), (8.4, 168)];
/// Distances from the axis on the surface, and what may be left of p₀ there.
const SURFACE: [(&str, [f64; 2], f64); 3] =
    [("r < 0.7a", [0.0, 0.7], 3e-4), ("0.8a", [0.7, 0.85], 5e-3), ("from 1.3a on", [1.2, 9.0], 1e-3)];
/// Distances on both sides of the edge, where a section leaves out the root of the pressure.
const AT_EDGE: [f64; 2] = [0.85, 1.2];
/// Depths, whether below the edge, and what may be left of p₀ there; two spacings below the edge e^{−2π} of it.
const INSIDE: [(&str, [f64; 2], bool, f64); 3] = [
    ("z = 0.05a below the edge", [0.0, 0.1], true, 2e-3),
    ("z = 0.05a elsewhere", [0.0, 0.1], false, 2e-4),
    ("z = 0.25a to 3a", [0.1, 9.0], false, 1e-4),
];
const NAMES: [&str; 6] = ["xx", "yy", "zz", "xy", "xz", "yz"];

/// A contact of radius 1 and pressure 1 of like bodies, which slides with friction μ along x.
fn solved(mu: f64, (side, points): (f64, usize)) -> Result<Step, StudyError> {
    // p₀ = 2E*a/(πR) with both moduli in E*.
    let young = 2.0 * (1.0 - NU * NU) * 5.0 * PI;
    let like = || -> Result<HalfSpace, StudyError> { Ok(HalfSpace::new(vec![], Material::from_young(young, NU)?)) };
    let bodies = Bodies::elastic(like()?, like()?);
    let problem = problem(Shape::Paraboloid { radius: 10.0 }, bodies, side)?;
    let problem = problem.sliding(Friction::new(mu, [1.0, 0.0])?)?;
    Steps::to(problem, [points; 2], 1e-10)?.step(Load::Force(2.0 * PI / 3.0))
}

/// Stresses at a place; on the surface read on a line, which has its edges sharp.
fn read(field: &StressField, [x, y, z]: [f64; 3]) -> [f64; 6] {
    let state: StressState = if z > 0.0 {
        field.points(Depth { z, material: 1 }, &[[x, y]])[0]
    } else {
        let line = SurfaceLine { origin: [x, y], direction: [1.0, 0.0], span: [0.0, 1e-3], points: 2 };
        field.section(&line, &[Depth::SURFACE]).states[[0, 0]]
    };
    [state.xx, state.yy, state.zz, state.xy, state.xz, state.yz]
}

pub fn stresses(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse("sliding", SLIDING)?;
    let mut data = Data::new("stress", &["mu", "x", "y", "z"]);
    for side in ["", "_exact", "_counterbody"] {
        data.columns.extend(NAMES.map(|name| format!("{name}{side}")));
    }
    for mu in [1.0, 0.25] {
        for (index, window) in WINDOWS.into_iter().enumerate() {
            let step = solved(mu, window)?;
            let fields = StressFields::new(step.finest(), MeanStress::HalfSpace);
            let counterbody = fields.counterbody().ok_or("the counterbody is elastic")?;
            for row in table.rows.iter().filter(|row| row[0] == mu) {
                let &[_, x, y, z, ..] = &row[..] else { return Err("a row too short".into()) };
                let is_far = x.abs().max(y.abs()) > 0.5 * WINDOWS[0].0;
                if is_far != (index == 1) {
                    continue;
                }
                // The counterbody is dragged the other way.
                let mut other = read(counterbody, [-x, y, z]);
                other[3] = -other[3];
                other[4] = -other[4];
                data.rows.push([&row[..4], &read(fields.body(), [x, y, z]), &row[4..], &other].concat());
            }
        }
    }
    let mut check = |name: &str, first: usize, wanted: &dyn Fn(&[f64]) -> bool, tolerance| {
        let rows = data.rows.iter().filter(|row| wanted(row));
        let pairs: Vec<(f64, f64)> = rows.flat_map(|row| (0..6).map(|k| (row[first + k], row[10 + k]))).collect();
        outcome.checks.push(Check::worst(format!("sliding, {name}"), pairs, Tolerance::Absolute(tolerance)));
    };
    for (name, [low, high], tolerance) in SURFACE {
        let wanted = |row: &[f64]| row[3] == 0.0 && (low..high).contains(&row[1].hypot(row[2]));
        check(&format!("surface, {name}: stresses over p₀"), 4, &wanted, tolerance);
    }
    for (name, [low, high], at_edge, tolerance) in INSIDE {
        let wanted = |row: &[f64]| {
            low < row[3] && row[3] < high && (row[3] > 0.1 || at_edge == ((row[1].hypot(row[2]) - 1.0).abs() < 0.1))
        };
        check(&format!("{name}: stresses over p₀"), 4, &wanted, tolerance);
        check(&format!("{name}: those of the counterbody"), 16, &wanted, tolerance);
    }
    let rows = data.rows.iter().filter(|row| row[3] == 0.0 && (AT_EDGE[0]..AT_EDGE[1]).contains(&row[1].hypot(row[2])));
    let left_out = rows.flat_map(|row| {
        let root = (1.0 + 2.0 * row[0]) * (1.0 - row[1].powi(2) - row[2].powi(2)).abs().sqrt();
        (0..6).map(move |k| ((row[4 + k] - row[10 + k]) / root, 0.0))
    });
    let name = "sliding, surface, 0.9a to 1.01a: error over the root left out";
    outcome.checks.push(Check::worst(name, left_out, Tolerance::Absolute(1.0)));
    Ok(data)
}

/// σ_x on the surface along the sliding, over the closed form of the study `sliding-sphere`.
pub fn chart(stress: &Data) -> Chart {
    let mut curves = Vec::new();
    for (colour, mu) in [(1, 1.0), (2, 0.25)] {
        let exact = linear(-2.0, 2.0, 801).into_iter().map(|x| [x, together(exact(NU, [x, 0.0, 0.0]), mu)[0]]);
        curves.push(curve("", Style::Line, colour, exact));
        let on_line = |row: &&Vec<f64>| row[0] == mu && row[2] == 0.0 && row[3] == 0.0 && row[1].abs() < 2.0;
        let found = stress.rows.iter().filter(on_line).map(|row| [row[1], row[4]]);
        curves.push(curve(format!("μ = {mu}"), Style::Markers, colour, found));
    }
    Chart {
        title: "Sliding sphere, on the surface".to_owned(),
        x: Axis::linear("along the sliding x/a"),
        y: Axis::linear("σ_x over p₀"),
        curves,
    }
}

//! Orders of convergence with the number of points N, against a closed form.
//!
//! The pressure ends like a square root at the edge of a disc; its transform falls as q⁻² there, and so do the errors of
//! sums over a grid: stresses inside are of second order, and the radius, read from the gap outside.
//! Peak pressure and penetration feel the errors of the whole edge together, whose sign changes with where the edge
//! cuts the samples: of O(N) of them O(√N) is left, and the order is 2.5. The largest tension on the surface stands at
//! the edge itself; it is read without the square root ([`percoat_core::stress::Crest`]).
//!
//! A paraboloid with a/l = 0.1 on the hexagonal lattice: what the series of its images leaves out is of the order
//! (a/l)⁷, below every error measured here. Each error is the worst of several places of the site on the grid, so that
//! none is flattered by symmetry; the order is the slope of the straight line through log error against log N.

use super::draw::{self, curve, slope};
use super::steps::{Steps, case};
use super::{Check, Data, Outcome, Study, StudyError};
use crate::exact::galin::{axis_stresses, paraboloid};
use crate::exact::hertz::edge_tension;
use crate::exact::lattice_sums::TRIANGULAR;
use crate::exact::{Sums, System};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{Depth, MeanStress};
use percoat_core::load::Load;
use percoat_core::numeric::search::largest;
use percoat_core::stress::StressField;
use std::f64::consts::PI;

pub const STUDY: Study = Study {
    name: "convergence",
    title: "Orders of convergence with the number of points",
    files: &["errors.data.csv", "figure.png"],
    run,
    quick: None,
};

const CASE: &str = include_str!("case.toml");
const NU: f64 = 0.3;
/// Contact radius over period.
const RADIUS: f64 = 0.1;
const SIZES: [usize; 7] = [64, 96, 128, 192, 256, 384, 512];
/// Places of the site in steps of the grid.
const SHIFTS: [[f64; 2]; 6] = [[0.0, 0.0], [0.37, 0.21], [0.5, 0.5], [0.13, 0.77], [1.0 / 3.0, 1.0 / 3.0], [0.9, 0.45]];
/// Depth z/a on the axis at which stresses are compared.
const DEPTH: f64 = 0.5;

/// Quantities measured: name, order to be seen and how far the fit may be from it, largest error at N = 512.
const QUANTITIES: [(&str, f64, f64, f64); 5] = [
    ("peak pressure", 2.5, 0.3, 2e-5),
    ("contact radius", 2.0, 0.4, 2e-4),
    ("penetration", 2.5, 0.3, 2e-5),
    ("stress on the axis", 2.0, 0.3, 5e-5),
    ("surface tension", 1.2, 0.3, 1e-2),
];

fn run() -> Result<Outcome, StudyError> {
    let mut columns = vec!["points"];
    columns.extend(QUANTITIES.map(|(name, ..)| name));
    let mut data = Data::new("errors", &columns);
    for points in SIZES {
        let mut row = vec![0.0f64; QUANTITIES.len()];
        for shift in SHIFTS {
            for (worst, error) in row.iter_mut().zip(errors(points, shift)?) {
                *worst = largest([*worst, error]);
            }
        }
        row.insert(0, points as f64);
        data.rows.push(row);
    }
    let mut checks = Vec::new();
    for (name, order, slack, finest) in QUANTITIES {
        let errors = data.column(name);
        checks.push(Check::order(
            format!("{name}: order, N = 64 to 512"),
            -fitted(&data.column("points"), &errors),
            order,
            slack,
        ));
        let last = errors.last().copied().unwrap_or(f64::NAN);
        checks.push(Check::absolute(format!("{name}: relative error at N = 512"), last, 0.0, finest));
    }
    Ok(Outcome { checks, figures: vec![("figure", figure(&data))], data: vec![data], ..Outcome::default() })
}

/// Relative errors of the quantities on one grid with the site `shift` steps from a sample.
fn errors(points: usize, shift: [f64; 2]) -> Result<[f64; 5], StudyError> {
    let [s, t] = shift.map(|steps| steps / points as f64);
    let case = case("convergence", CASE, &[format!("levels.0.sites=[[{s}, {t}]]")])?;
    let modulus = case.half_space().surface_material().contact_modulus();
    let system = System::single(modulus, TRIANGULAR, vec![paraboloid(1.0)]);
    let exact = system.contacts(&[RADIUS])[0];
    let mut steps = Steps::of(&case, points)?;
    let cell = case.problem().cell();
    let (step, found) = steps.solve(Load::MeanPressure(exact.load / cell.area()))?;
    let field = StressField::new(step.finest(), MeanStress::HalfSpace);
    let state = field.points(Depth { z: DEPTH * RADIUS, material: 1 }, &[cell.point([s, t])])[0];
    // σ_z − σ_r drives τ₁: that of the contact with its images in the profile, which also press sideways, by the first
    // term −P(1+ν)S₃z/(2π) of theirs.
    let [c2, c4, _] = system.images(0, &[exact]);
    let depth = DEPTH * RADIUS;
    let [axial, lateral] = axis_stresses([0.5 + c2, c4], RADIUS, modulus, NU, depth);
    let Sums([_, s3, _]) = TRIANGULAR;
    let pressed = -exact.load * (1.0 + NU) * s3 * depth / (2.0 * PI);
    let difference = axial - lateral - pressed;
    let tension = field.maxima([RADIUS; 2]).faces[0].tension.value;
    let relative = |found: f64, exact: f64| (found / exact - 1.0).abs();
    Ok([
        relative(found.max_pressure, exact.axis),
        relative(found.levels[0].contact_radius.unwrap_or(f64::NAN), RADIUS),
        relative(found.penetration, exact.penetration),
        relative(state.zz - 0.5 * (state.xx + state.yy), difference),
        relative(tension / exact.axis, edge_tension(NU)),
    ])
}

/// Slope of the straight line through log y against log x.
fn fitted(x: &[f64], y: &[f64]) -> f64 {
    let logs: Vec<[f64; 2]> = x.iter().zip(y).map(|(x, y)| [x.ln(), y.ln()]).collect();
    let count = logs.len() as f64;
    let mean = [0, 1].map(|k| logs.iter().map(|log| log[k]).sum::<f64>() / count);
    let moment = |k: usize| logs.iter().map(|log| (log[0] - mean[0]) * (log[k] - mean[k])).sum::<f64>();
    moment(1) / moment(0)
}

fn figure(data: &Data) -> Figure {
    let mut curves = Vec::new();
    for ((name, order, ..), colour) in QUANTITIES.into_iter().zip(1..) {
        let points: Vec<[f64; 2]> =
            data.column("points").into_iter().zip(data.column(name)).map(|(x, y)| [x, y]).collect();
        curves.push(slope(if colour == 1 { "expected slopes" } else { "" }, -order, colour, &points));
        curves.push(curve(name, Style::Markers, colour, points));
    }
    let chart = Chart {
        title: String::new(),
        x: Axis::log("points along the cell N"),
        y: Axis::log("relative error, worst of six places"),
        curves,
    };
    draw::figure(vec![chart], "A paraboloid, N/10 samples along its contact radius.")
}

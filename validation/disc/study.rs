//! A uniformly loaded disc through the localized method's own kernels: its far field and its squares.
//!
//! Expected: a multiprecision table on a coating, closed forms on a half-space, and the disc again from squares that are
//! loaded by the part of them inside it, at second order in their size.

use super::draw::{self, curve, linear, slope};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{HalfSpace, Interface, Layer, Material};
use percoat_core::localized::disc;
use percoat_core::localized::point::PointKernel;
use percoat_core::localized::square::Squares;
use std::f64::consts::PI;

pub const STUDY: Study = Study {
    name: "disc",
    title: "Disc on a coating through the localized path",
    files: &["disc.data.csv", "figure.png", "squares.data.csv"],
    run,
    quick: None,
};

const REFERENCE: &str = include_str!("reference.csv");

/// Distances to which kernels are tabulated.
const REACH: f64 = 10.0;
/// Squares across the radius of the disc.
const SQUARES: [usize; 4] = [8, 16, 32, 64];

fn run() -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let (bare, coated) = (half_space(1.0, None)?, half_space(1.0, Some(10.0))?);
    let (bare, coated) = (PointKernel::new(&bare, REACH), PointKernel::new(&coated, REACH));
    let reference = Data::parse("reference", REFERENCE)?;
    let places = reference.column("r");

    let mut data = Data::new("disc", &["r", "displacement", "reference"]);
    for row in &reference.rows {
        data.rows.push(vec![row[0], disc::displacement(&coated, 1.0, row[0]), row[1]]);
    }
    let pairs = data.column("displacement").into_iter().zip(data.column("reference"));
    let name = "coating: displacement at r/a = 0, 0.5, 1.5, 3, table";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(2e-8)));
    outcome.checks.extend(closed_forms(&bare));

    let mut squares = Data::new("squares", &["squares", "bare", "coated"]);
    for count in SQUARES {
        let error = |kernel: &PointKernel| {
            let error = |&r: &f64| from_squares(kernel, count, r) / disc::displacement(kernel, 1.0, r) - 1.0;
            places.iter().map(error).map(f64::abs).fold(0.0, f64::max)
        };
        squares.rows.push(vec![count as f64, error(&bare), error(&coated)]);
    }
    for (key, name) in [("bare", "half-space"), ("coated", "coating")] {
        let errors = squares.column(key);
        let [first, .., last] = errors[..] else { return Err("too few sizes".into()) };
        let finest = SQUARES[SQUARES.len() - 1];
        outcome.checks.push(Check::absolute(
            format!("{name}: disc from squares, {finest} to the radius, largest relative error"),
            last,
            0.0,
            1e-4,
        ));
        let order = (first / last).ln() / (finest as f64 / SQUARES[0] as f64).ln();
        outcome.checks.push(Check::order(format!("{name}: disc from squares, order in their size"), order, 2.0, 0.3));
    }
    outcome.figures.push(("figure", figure(&bare, &coated, &data, &squares)?));
    outcome.data = vec![data, squares];
    Ok(outcome)
}

/// Substrate with Young's modulus `substrate`, bare or with a coating of unit thickness; ν = 0.3.
fn half_space(substrate: f64, coating: Option<f64>) -> Result<HalfSpace, StudyError> {
    let layers = match coating {
        Some(young) => vec![Layer::new(Material::from_young(young, 0.3)?, 1.0, Interface::Bonded)?],
        None => Vec::new(),
    };
    Ok(HalfSpace::new(layers, Material::from_young(substrate, 0.3)?))
}

/// Disc and square of half-width b on the half-space, in units of a/E* and b/E*.
fn closed_forms(bare: &PointKernel) -> Vec<Check> {
    // c/(2π) = 1/(πE*).
    let modulus = 1.0 / (PI * bare.factor());
    let at = |r: f64| modulus * disc::displacement(bare, 1.0, r);
    let squares = Squares::new(bare, 1.0);
    let square = |x: f64, y: f64| modulus * squares.coefficient(x, y);
    // The midpoint rule with the nodes gathered at the edge, where the slope is infinite.
    let nodes = || linear(0.5, 199.5, 200).into_iter().map(|k| k / 200.0);
    let disc_mean = nodes().map(|t| (0.5 * PI * t).sin_cos()).map(|(s, c)| PI * s * c * at(s)).sum::<f64>() / 200.0;
    let gathered = |t: f64| (t - (2.0 * PI * t).sin() / (2.0 * PI), 1.0 - (2.0 * PI * t).cos());
    let pairs = nodes().map(gathered).flat_map(|x| nodes().map(gathered).map(move |y| (x, y)));
    let square_mean = pairs.map(|((x, dx), (y, dy))| dx * dy * square(x, y)).sum::<f64>() / 200f64.powi(2);
    let love = (1.0 + 2f64.sqrt()).ln();
    vec![
        Check::relative("half-space: disc, centre", at(0.0), 2.0, 1e-14),
        Check::relative("half-space: disc, edge", at(1.0), 4.0 / PI, 1e-14),
        Check::relative("half-space: disc, mean", disc_mean, 16.0 / (3.0 * PI), 1e-4),
        Check::relative("half-space: square, centre", square(0.0, 0.0), 8.0 / PI * love, 1e-13),
        Check::relative("half-space: square, corner", square(1.0, 1.0), 4.0 / PI * love, 1e-13),
        Check::relative("half-space: square, mean", square_mean, 8.0 / PI * (love + (1.0 - 2f64.sqrt()) / 3.0), 1e-7),
    ]
}

/// Displacement at the distance r from the centre of a disc of unit radius, from squares, `count` to the radius.
fn from_squares(kernel: &PointKernel, count: usize, r: f64) -> f64 {
    let half = 0.5 / count as f64;
    let squares = Squares::new(kernel, half);
    let mut sum = 0.0;
    for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
        let [x, y] = [i, j].map(|k| (2 * k + 1) as f64 * half);
        let part = covered(x, y, half);
        if part > 0.0 {
            let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
            sum += part * signs.map(|(s, t)| squares.coefficient(r - s * x, t * y)).iter().sum::<f64>();
        }
    }
    sum
}

/// Part inside the unit disc of a square around (x, y) in the first quadrant.
fn covered(x: f64, y: f64, half: f64) -> f64 {
    if (x + half).hypot(y + half) <= 1.0 {
        return 1.0;
    }
    const STRIPS: usize = 64;
    let height = |k: usize| {
        let u = x + half * ((2 * k + 1) as f64 / STRIPS as f64 - 1.0);
        ((1.0 - u * u).max(0.0).sqrt() - (y - half)).clamp(0.0, 2.0 * half)
    };
    (0..STRIPS).map(height).sum::<f64>() / STRIPS as f64 / (2.0 * half)
}

fn figure(bare: &PointKernel, coated: &PointKernel, table: &Data, squares: &Data) -> Result<Figure, StudyError> {
    let stiff = PointKernel::new(&half_space(10.0, None)?, REACH);
    let line = |label: &str, kernel: &PointKernel, style, colour| {
        let at = |r: f64| [r, disc::displacement(kernel, 1.0, r)];
        curve(label, style, colour, linear(0.0, 4.0, 161).into_iter().map(at))
    };
    let displacements = vec![
        line("substrate alone", bare, Style::Dashed, 2),
        line("coated", coated, Style::Line, 1),
        line("coating's material alone", &stiff, Style::Dotted, 3),
        curve("multiprecision", Style::Markers, 1, table.rows.iter().map(|row| [row[0], row[2]])),
    ];
    let errors = |key: &str| -> Vec<[f64; 2]> {
        squares.column("squares").into_iter().zip(squares.column(key)).map(|(n, error)| [n, error]).collect()
    };
    let (homogeneous, layered) = (errors("bare"), errors("coated"));
    let convergence = vec![
        slope("second order", -2.0, 0, &homogeneous),
        curve("substrate alone", Style::LineMarkers, 2, homogeneous),
        curve("coated", Style::LineMarkers, 1, layered),
    ];
    let chart = |title: &str, x, y, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("(a) disc", Axis::linear("r/a"), Axis::linear("surface displacement uE₂/(qa)"), displacements),
        chart(
            "(b) disc from squares",
            Axis::log("squares to the radius"),
            Axis::log("largest relative error"),
            convergence,
        ),
    ];
    Ok(draw::figure(panels, "Unit pressure on a disc of radius a on a coating of thickness a, E₁ = 10 E₂, ν = 0.3."))
}

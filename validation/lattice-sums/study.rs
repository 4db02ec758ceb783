//! The operator's response to a localised pressure holds the lattice sums.
//!
//! A Gaussian pressure of load P and width s has the displacement (Taylor series of the periodic Green function
//! averaged over it)
//!
//! πE* w/P = √(π/2)/s + S₁ + S₃ s²/2 + 9 S₅ s⁴/8 + …
//!
//! at its centre, and without the first term at the sites of another sublattice. The polynomial in s² through several
//! widths gives S₁, S₃ and S₅.

use super::draw::{self, curve, linear};
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use crate::exact::lattice_sums::{SQUARE, TRIANGULAR, coated_triangular};
use crate::exact::{Coating, Sums};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::lattice::{Cell, Grid};
use percoat_core::spectral::{LayeredOperator, Workspace};
use std::f64::consts::PI;
use std::sync::Arc;

pub const STUDY: Study = Study {
    name: "lattice-sums",
    title: "What the images of a load do at its place",
    files: &["figure.png", "sums.data.csv"],
    run,
    quick: None,
};

const REFERENCE: &str = include_str!("reference.csv");

/// Responses to Gaussians of several widths at the loaded site and at the site (⅓, ⅓) of the cell.
struct Response {
    /// Widths squared.
    squares: Vec<f64>,
    /// πE*w/P at the loaded site less √(π/2)/s, and at the other one.
    values: [Vec<f64>; 2],
}

impl Response {
    /// Six widths s from `width` to twice `width`.
    fn new(cell: Cell, points: usize, half_space: &HalfSpace, width: f64) -> Result<Self, StudyError> {
        let grid = Arc::new(Grid::new(cell, [points, points])?);
        let (mut operator, mut workspace) = (LayeredOperator::new(&grid, half_space), Workspace::default());
        let modulus = half_space.surface_material().contact_modulus();
        let third = points / 3 * points + points / 3;
        let mut response = Self { squares: Vec::new(), values: [Vec::new(), Vec::new()] };
        for s in linear(width, 2.0 * width, 6) {
            let pressure: Vec<f64> = (0..grid.len()).map(|index| gaussian(&grid, index, s)).collect();
            let mut displacement = pressure;
            operator.displacement(&mut displacement, &mut workspace);
            response.squares.push(s * s);
            response.values[0].push(PI * modulus * displacement[0] - (0.5 * PI).sqrt() / s);
            response.values[1].push(PI * modulus * displacement[third]);
        }
        Ok(response)
    }

    /// Sums seen at the loaded site and at the other one.
    fn sums(&self) -> [Sums; 2] {
        self.values.each_ref().map(|values| {
            let c = polynomial(&self.squares, values);
            Sums([c[0], 2.0 * c[1], 8.0 / 9.0 * c[2]])
        })
    }
}

/// exp(−r²/2s²)/(2πs²) summed over the nearest images of the origin.
fn gaussian(grid: &Grid, index: usize, s: f64) -> f64 {
    let [s1, s2] = grid.fractions(index);
    (-1..=1)
        .flat_map(|i| (-1..=1).map(move |j| (f64::from(i), f64::from(j))))
        .map(|(i, j)| {
            let [x, y] = grid.cell().point([s1 - 0.5 + i, s2 - 0.5 + j]);
            let [ox, oy] = grid.cell().point([0.5, 0.5]);
            (-0.5 * ((x + ox).powi(2) + (y + oy).powi(2)) / (s * s)).exp()
        })
        .sum::<f64>()
        / (2.0 * PI * s * s)
}

/// Coefficients of the polynomial through the points (x, y): divided differences, then Horner's scheme.
fn polynomial(x: &[f64], y: &[f64]) -> Vec<f64> {
    let mut differences = y.to_vec();
    for order in 1..x.len() {
        for i in (order..x.len()).rev() {
            differences[i] = (differences[i] - differences[i - 1]) / (x[i] - x[i - order]);
        }
    }
    let mut coefficients = vec![0.0; x.len()];
    for i in (0..x.len()).rev() {
        for k in (1..x.len()).rev() {
            coefficients[k] = coefficients[k - 1] - x[i] * coefficients[k];
        }
        coefficients[0] = differences[i] - x[i] * coefficients[0];
    }
    coefficients
}

fn run() -> Result<Outcome, StudyError> {
    let names = [
        "thickness",
        "chi",
        "nu1",
        "s1",
        "s3",
        "s5",
        "own_1",
        "other_1",
        "other_3",
        "closed_1",
        "closed_3",
        "closed_5",
    ];
    let reference = Data::parse("reference", REFERENCE)?;
    let mut data = Data::new("sums", &names);
    for row in &reference.rows {
        let &[thickness, chi, nu1, ..] = &row[..] else { return Err("a row too short".into()) };
        let (half_space, closed) = if thickness.is_finite() {
            let coating = Coating::new(chi, [nu1, 0.3], thickness)?;
            (coating.half_space().clone(), coated_triangular(&coating, 1.0))
        } else {
            (HalfSpace::new(vec![], Material::from_young(1.0, nu1)?), TRIANGULAR)
        };
        let (points, width) = if thickness < 0.2 { (288, 0.01) } else { (144, 0.025) };
        let [Sums([s1, s3, s5]), _] = Response::new(Cell::hexagonal(1.0)?, points, &half_space, width)?.sums();
        let cell = Cell::hexagonal(3f64.sqrt())?;
        let [Sums([same, ..]), Sums([other1, other3, _])] =
            Response::new(cell, 5 * points / 3, &half_space, width)?.sums();
        let Sums([closed1, closed3, closed5]) = closed;
        data.rows.push(vec![thickness, chi, nu1, s1, s3, s5, same, other1, other3, closed1, closed3, closed5]);
    }
    let mut checks = Vec::new();
    for (name, quantity, tolerance) in [
        ("s1", "S₁", Tolerance::Absolute(2e-8)),
        ("s3", "S₃", Tolerance::Relative(1e-6)),
        ("s5", "S₅", Tolerance::Relative(1e-4)),
        ("own_1", "three levels: S₁ to the own level", Tolerance::Absolute(2e-8)),
        ("other_1", "three levels: S₁ to another level", Tolerance::Absolute(2e-8)),
        ("other_3", "three levels: S₃ to another level", Tolerance::Relative(1e-7)),
    ] {
        let pairs = data.column(name).into_iter().zip(reference.column(name));
        checks.push(Check::worst(format!("{quantity}, triangular, bare and five coatings"), pairs, tolerance));
    }
    for (closed, name) in [("closed_1", "s1"), ("closed_3", "s3"), ("closed_5", "s5")] {
        let pairs = data.column(closed).into_iter().zip(reference.column(name));
        checks.push(Check::worst(format!("closed form of {name}, five coatings"), pairs, Tolerance::Relative(1e-9)));
    }
    let bare = HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?);
    let square = Response::new(Cell::square(1.0)?, 144, &bare, 0.025)?;
    let [Sums([s1, s3, s5]), _] = square.sums();
    checks.push(Check::absolute("S₁, square", s1, SQUARE.0[0], 1e-9));
    checks.push(Check::relative("S₃, square", s3, SQUARE.0[1], 1e-9));
    checks.push(Check::relative("S₅, square", s5, SQUARE.0[2], 1e-4));
    Ok(Outcome { checks, figures: vec![("figure", figure(&square, &bare)?)], data: vec![data], ..Outcome::default() })
}

/// The response less S₁, whose slope and curvature at s = 0 are the other sums.
fn figure(square: &Response, bare: &HalfSpace) -> Result<Figure, StudyError> {
    let triangular = Response::new(Cell::hexagonal(1.0)?, 144, bare, 0.025)?;
    let coating = Coating::new(2.0, [0.2, 0.3], 0.5)?;
    let coated = Response::new(Cell::hexagonal(1.0)?, 144, coating.half_space(), 0.025)?;
    let mut curves = Vec::new();
    for (name, response, Sums([s1, s3, s5]), colour) in [
        ("triangular", &triangular, TRIANGULAR, 1),
        ("square", square, SQUARE, 2),
        ("triangular, coated", &coated, coated_triangular(&coating, 1.0), 3),
    ] {
        let found = response.squares.iter().zip(&response.values[0]).map(|(&x, &y)| [x, y - s1]);
        let closed = linear(0.0, 0.0026, 50).into_iter().map(|x| [x, 0.5 * s3 * x + 1.125 * s5 * x * x]);
        curves.push(curve(if colour == 1 { "S₃s²/2 + 9S₅s⁴/8" } else { "" }, Style::Line, colour, closed));
        curves.push(curve(name, Style::Markers, colour, found));
    }
    let chart = Chart {
        title: String::new(),
        x: Axis::linear("width of the load s²/l²"),
        y: Axis::linear("πE*wl/P − √(π/2) l/s − S₁l"),
        curves,
    };
    let caption =
        "Displacement at a Gaussian load, less its own part and S₁: lattice sums (lines) and operator (markers).";
    Ok(draw::figure(vec![chart], caption))
}

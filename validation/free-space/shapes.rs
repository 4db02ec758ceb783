//! Cones on layers, Hertz' ellipse in a window that is not square, and windows of other sizes.

use super::bodies::{BALL, BODIES, INDENTATION, body, rows};
use crate::alone::{Alone, POINTS, WINDOW, checks, problem};
use crate::steps::Steps;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use ndarray::Array2;
use percoat_core::body::{HalfSpace, Material};
use percoat_core::counterbody::{Shape, Topography};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::Step;
use std::f64::consts::PI;

const CONES: &str = include_str!("cones.csv");
const ELLIPSE: &str = include_str!("ellipse.csv");

/// Rigid cones of slope 1.
pub fn cones(bodies: &[usize], outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse("cones", CONES)?;
    let mut data = Data::new("cones", &["body", "a_exact", "P", "delta_exact", "S_exact", "delta", "p0", "a", "S"]);
    for &number in bodies {
        for row in rows(&table, number) {
            let alone = Alone::new(Shape::Cone { slope: 1.0 }, body(number)?, [row[1], row[2]], POINTS)?;
            data.rows.push([&row[..], &alone.found].concat());
        }
        if rows(&table, number).next().is_some() {
            let is_own = |row: &[f64]| row[0] == number as f64;
            outcome.checks.extend(checks(&format!("cone, {}", BODIES[number].0), &data, is_own));
        }
    }
    Ok(data)
}

/// The paraboloid x²/(2R₁) + y²/2 as a topography on E* = 1 under the force 1.
pub fn ellipse(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let columns = ["R1", "a", "b", "delta_exact", "p0_exact", "delta", "p0", "area", "S", "area_exact", "S_exact"];
    let mut data = Data::new("ellipse", &columns);
    for row in Data::parse("ellipse", ELLIPSE)?.rows {
        let &[r1, a, b, delta, _] = &row[..] else { return Err("a row too short".into()) };
        let sides = [WINDOW * a, WINDOW * b];
        // The shorter half axis has as many samples as the other radii, the longer one about as many a length.
        let points = [
            if r1 > 5.0 {
                4 * POINTS
            } else if r1 > 1.0 {
                2 * POINTS
            } else {
                POINTS
            },
            POINTS,
        ];
        let place = |axis: usize, index: usize| (index as f64 / points[axis] as f64 - 0.5) * sides[axis];
        let heights =
            Array2::from_shape_fn(points, |(i, j)| -place(0, i).powi(2) / (2.0 * r1) - 0.5 * place(1, j).powi(2));
        let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?);
        let problem = Problem::new(Topography::new(Cell::window(sides)?, heights)?, half_space);
        let mut steps = Steps::to(problem, points, 1e-10)?;
        let (_, reading) = steps.solve(Load::Force(1.0))?;
        let stiffness = steps.solver.tangent().ok_or("no tangent")?.stiffness();
        let found = [reading.penetration, reading.max_pressure, reading.contact_area, stiffness];
        data.rows.push([&row[..], &found, &[PI * a * b, 1.5 / delta]].concat());
    }
    let mut check = |name: &str, [found, exact]: [usize; 2], tolerance| {
        let pairs = data.rows.iter().map(|row| (row[found], row[exact]));
        outcome.checks.push(Check::worst(format!("ellipse: {name}"), pairs, Tolerance::Relative(tolerance)));
    };
    check("penetration δ", [5, 3], 3e-4);
    check("pressure p₀", [6, 4], 1e-3);
    check("area πab", [7, 9], 4e-3);
    check("stiffness dP/dδ", [8, 10], 1.4e-3);
    Ok(data)
}

/// One spacing in windows of which the contact fills 90 and 50 %.
pub fn windows(outcome: &mut Outcome) -> Result<(), StudyError> {
    let table = Data::parse("indentation", INDENTATION)?;
    let (number, radius) = (3, 1.0);
    let row = rows(&table, number).find(|row| row[1] == radius).ok_or("no such row")?;
    let solved = |points: usize| -> Result<Step, StudyError> {
        let side = points as f64 * radius / 40.0;
        Steps::to(problem(BALL, body(number)?, side)?, [points; 2], 1e-14)?.step(Load::Force(row[2]))
    };
    let (narrow, wide) = (solved(90)?, solved(160)?);
    let peak = wide.pressure().iter().copied().fold(0.0, f64::max);
    let (inner, outer) = (narrow.pressure(), wide.pressure());
    let pairs = inner.indexed_iter().map(|((i, j), p)| (p / peak, outer[[i + 35, j + 35]] / peak));
    let name = "contact in 90 and in 50 % of the window";
    outcome.checks.push(
        Check::relative(format!("{name}: penetration"), narrow.penetration(), wide.penetration(), 1e-10)
            .of_refinement(),
    );
    outcome
        .checks
        .push(Check::worst(format!("{name}: p over its maximum"), pairs, Tolerance::Absolute(1e-10)).of_refinement());
    Ok(())
}

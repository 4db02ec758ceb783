//! One level: circles whose neighbours, lattice sums, contact and penetration are known.

use crate::draw::curve;
use crate::exact::lattice_sums::TRIANGULAR;
use crate::exact::{Localization, Sums};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_app::picture::{Curve, Style};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use percoat_core::localized::{CircleRadius, Coupled, Localized, Setup, Stop};
use percoat_core::problem::Problem;

const REFERENCE: &str = include_str!("one-level.csv");

const RADIUS: f64 = 0.8;
/// Mean pressure over E*.
const MEAN_PRESSURE: f64 = 0.01;
const SETUP: Setup = Setup { indenters: 7, elements: 48, rule: CircleRadius::LoadBalanced, mutual_effect: true };

/// Circles around a paraboloid on a bare lattice, E* = 1: checks, data, and curves of the penetration's error.
pub fn one_level(outcome: &mut Outcome) -> Result<Vec<Curve>, StudyError> {
    let lattice = Lattice::hexagonal(1.0, 1)?;
    let indenters = Indenters::new(lattice, vec![Level::new(Shape::Paraboloid { radius: RADIUS }, 0.0)?])?;
    let localized =
        Localized::new(&Problem::new(indenters, HalfSpace::new(vec![], Material::from_young(1.0, 0.0)?)), 91)?;
    let system = localized.system();
    let (prescribed, load) = (Load::MeanPressure(MEAN_PRESSURE), MEAN_PRESSURE * system.cell().area());
    let (mesh, start) = localized.mesh(prescribed, &SETUP);
    let localization = |indenters: usize| {
        let circle = &system.circles(indenters)[0];
        let distances: Vec<f64> = circle.images[0][1..].iter().map(|[x, y]| x.hypot(*y)).collect();
        (circle.indenters(), Localization::new(&distances, system.cell().area()))
    };
    let reference = Data::parse("one-level", REFERENCE)?;
    let mut data =
        Data::new("one-level", &["neighbours", "s3", "s1", "penetration", "penetration_sums", "radius", "radius_sums"]);
    for neighbours in reference.column("neighbours") {
        let (inside, circle) = localization(neighbours as usize + 1);
        let solution = Coupled::new(localized.system(), mesh, inside, true).solve(
            prescribed,
            CircleRadius::LoadBalanced,
            Some(&start),
        );
        if solution.stop != Stop::Converged {
            return Err(format!("{neighbours} neighbours: {}", solution.stop).into());
        }
        let (expected, Sums([s1, s3, _])) = (circle.contact(RADIUS, load, 1.0), circle.sums);
        let radius = solution.levels()[0].contact_radius.unwrap_or(f64::NAN);
        let row = [neighbours, s3, s1, solution.penetration, expected.penetration, radius, expected.radius];
        data.rows.push(row.to_vec());
    }
    for (key, name) in [("s1", "S₁"), ("s3", "S₃")] {
        let pairs = data.column(key).into_iter().zip(reference.column(key));
        let name = format!("one level: {name} of seven circles, table");
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1e-4)));
    }
    for (key, name, whole, change) in
        [("penetration", "penetration", 1e-4, 5e-7), ("radius", "contact radius", 3e-4, 2e-3 * mesh.size)]
    {
        let (found, expected) = (data.column(key), data.column(&format!("{key}_sums")));
        let pairs = || found.iter().copied().zip(expected.iter().copied());
        let check = format!("one level: {name}, 0 to 54 neighbours, lattice sums");
        outcome.checks.push(Check::worst(check, pairs(), Tolerance::Relative(whole)));
        // The mesh errs alike for all circles; of the outline of each some thousandth of an element is its own.
        let last = found.len() - 1;
        let changes = pairs().map(|(a, b)| (a - found[last], b - expected[last]));
        let check = format!("one level: {name} less that with 54 neighbours, lattice sums");
        outcome.checks.push(Check::worst(check, changes, Tolerance::Absolute(change)));
    }
    let whole = Localization::whole(TRIANGULAR).contact(RADIUS, load, 1.0).penetration;
    let error = |penetration: f64| 100.0 * (penetration / whole - 1.0);
    let mut line: Vec<[f64; 2]> = Vec::new();
    for asked in 1..=91 {
        let (inside, circle) = localization(asked);
        if line.last().is_none_or(|last| last[0] < inside as f64) {
            line.push([inside as f64, error(circle.contact(RADIUS, load, 1.0).penetration)]);
        }
    }
    let points = data.rows.iter().map(|row| [row[0] + 1.0, error(row[3])]);
    let curves = vec![
        curve("", Style::Dotted, 0, [[1.0, 0.0], [100.0, 0.0]]),
        curve("lattice sums", Style::Line, 1, line),
        curve("computed", Style::Markers, 1, points),
    ];
    outcome.data.push(data);
    Ok(curves)
}

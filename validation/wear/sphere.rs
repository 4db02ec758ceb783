//! A paraboloid that wears on a bare half-space, alone.

use super::path::{VOLUME, extrapolated};
use crate::alone::{half_space, problem};
use crate::steps::Steps;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::counterbody::Shape;
use percoat_core::load::Load;
use percoat_core::reading::Reading;
use percoat_core::spectral::Wear;
use std::f64::consts::PI;

const SPHERE: &str = include_str!("sphere.csv");
/// E* = 1, R = 1, so that a₀ = δ₀ = 1.
const LOAD: f64 = 4.0 / 3.0;
const SIDE: f64 = 4.6;
const POINTS: usize = 100;
/// Ends of the parts of the path, and the equal steps of each, which are doubled and extrapolated.
const PARTS: [(f64, usize); 5] = [(0.1, 20), (0.3, 20), (1.0, 30), (3.0, 30), (10.0, 40)];
/// Errors by 22 samples a radius, steps and table: of δ, of the pressure on the axis and the depth worn off there.
const APPROACH: f64 = 5e-4;
const AXIS: f64 = 1e-3;

pub fn sphere(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let new = || {
        let alone = problem(Shape::Paraboloid { radius: 1.0 }, half_space(&[], [1.0, 0.0])?, SIDE)?;
        Steps::to(alone, [POINTS; 2], 1e-11)
    };
    let (places, worst) = extrapolated(new, Load::Force(LOAD), &Wear::new(0.0, 1.0, [1.0, 0.0])?, &PARTS, LOAD)?;
    let columns = ["ks", "delta", "p0", "worn0", "a", "delta_exact", "p0_exact", "worn0_exact", "a_exact"];
    let mut data = Data::new("sphere", &columns);
    let table = Data::parse("sphere", SPHERE)?;
    for (place, (end, _)) in places.iter().zip(PARTS) {
        let row = table.rows.iter().find(|row| row[0] == end).ok_or("no such row")?;
        let &[_, a, delta, p0, worn, ..] = &row[..] else { return Err("a row too short".into()) };
        let middle = [POINTS / 2; 2];
        let area = Reading::of(place.step.as_ref().ok_or("no step")?.finest()).contact_area;
        let found = [place.approach, place.pressure[middle], place.worn[1][middle], (area / PI).sqrt()];
        data.rows.push([&[end], &found[..], &[delta, p0, worn, a]].concat());
    }
    let pairs = |k: usize| data.rows.iter().map(move |row| (row[k], row[k + 4]));
    let spacing = SIDE / POINTS as f64;
    let radii = pairs(4).map(|(found, exact)| (found / spacing, exact / spacing));
    outcome.checks.extend([
        Check::worst("worn sphere: penetration δ", pairs(1), Tolerance::Relative(APPROACH)),
        Check::worst("worn sphere: pressure on the axis", pairs(2), Tolerance::Relative(AXIS)),
        Check::worst("worn sphere: depth worn off on the axis", pairs(3), Tolerance::Relative(AXIS)),
        Check::worst("worn sphere: radius of contact over the spacing", radii, Tolerance::Absolute(1.0)),
        Check::absolute("worn sphere: volume over k s P, less 1", worst, 0.0, VOLUME),
    ]);
    Ok(data)
}

//! JKR on layers: zones that pull of two short widths, extrapolated to none.

use super::setup::{adhering, advance, ball, layer, solver};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{HalfSpace, Material};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::numeric::fourier::fast_points;
use std::f64::consts::PI;

const LAYERS: &str = include_str!("layers.csv");
const THIN: &str = include_str!("thin.csv");
/// Widths of the zone over the contact radius at pull-off, and over the thickness of a soft layer that is thinner.
const ZONES: [f64; 2] = [0.2, 0.1];
const OF_THICKNESS: f64 = 2.0;
/// Samples across the zone.
const ACROSS: f64 = 4.0;
/// Side of the window over that radius, penetration above that of pull-off at which the path begins over its square, and the step.
const WINDOW: f64 = 4.6;
const ABOVE: f64 = 0.3;
const STEP: f64 = 0.1;
/// Most steps of a path.
const MOST_STEPS: u32 = 60;

pub fn add(outcome: &mut Outcome) -> Result<(), StudyError> {
    let mut data = Data::new("layers", &["body", "wide", "short", "force", "force_exact"]);
    for (number, row) in (0u8..).zip(Data::parse("layers", LAYERS)?.rows) {
        let [e1, nu1, h1, e2, nu2, h2, work, force, radius, penetration] = row[..] else {
            return Err("a layered body has ten numbers".into());
        };
        let second = if e2 > 0.0 { Some(layer([e2, nu2, h2])?) } else { None };
        let layers = [Some(layer([e1, nu1, h1])?), second].into_iter().flatten().collect();
        let body = HalfSpace::new(layers, Material::from_young(1.0, 0.3)?);
        // On a soft layer that is thinner than the contact the zone has to be short beside the layer too.
        let short = if e1 < 1.0 { (OF_THICKNESS * h1 / radius).min(1.0) } else { 1.0 };
        let mut found = [0.0; 2];
        for (found, zone) in found.iter_mut().zip(ZONES) {
            *found = pull_off(&body, work, [radius, penetration], zone * short)?[0];
        }
        let [wide, short] = found;
        data.rows.push(vec![f64::from(number), wide, short, 2.0 * short - wide, force]);
    }
    let pairs = data.rows.iter().map(|row| (row[3], row[4]));
    outcome.checks.push(Check::worst(
        "pull-off on eleven layered bodies, zones extrapolated",
        pairs,
        Tolerance::Relative(1e-2),
    ));
    outcome.data.push(data);
    thin(outcome)
}

/// Thin compressible layers on a rigid base: toward 2πwR, with zones that pull that are not short beside the layer.
fn thin(outcome: &mut Outcome) -> Result<(), StudyError> {
    let mut data = Data::new("thin", &["poisson", "radius", "force", "force_exact"]);
    for row in Data::parse("thin", THIN)?.rows {
        let [poisson, radius, force] = row[..] else { return Err("a thin layer has three numbers".into()) };
        let thickness = 0.01;
        let body = HalfSpace::on_rigid_base(vec![layer([1.0, poisson, thickness])?])?;
        // A foundation of the stiffness M/h is pulled off at a⁴ = 8whR²/M.
        let modulus = (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson).max(0.02));
        let a = radius * thickness;
        let work = modulus * a.powi(4) / (8.0 * thickness);
        // The force is least near first touch.
        let found = pull_off(&body, work, [a, 0.0], 0.05)?;
        data.rows.push(vec![poisson, found[1] / thickness, found[0], force]);
    }
    let pairs = data.rows.iter().map(|row| (row[2], row[3]));
    outcome.checks.push(Check::worst("pull-off on thin layers on a rigid base", pairs, Tolerance::Relative(2e-2)));
    outcome.data.push(data);
    Ok(())
}

/// Pull-off in πwR, and the contact radius there, of a zone some part of a `radius` wide.
fn pull_off(body: &HalfSpace, work: f64, [radius, penetration]: [f64; 2], zone: f64) -> Result<[f64; 2], StudyError> {
    let modulus = body.surface_material().contact_modulus();
    let range = (4.0 * zone * radius * work / (PI * modulus)).sqrt();
    let side = WINDOW * radius;
    let points = fast_points((side / (zone * radius) * ACROSS).ceil() as usize);
    let problem = adhering(ball(Cell::window([side; 2])?)?, body.clone(), [work, range])?;
    let mut solver = solver(problem, [points; 2])?;
    let square = radius * radius;
    let mut place = (penetration + ABOVE * square).max(0.05 * square);
    for _ in 0..MOST_STEPS {
        let step = advance(&mut solver, Load::Penetration(place))?;
        if let Some(found) = step.pull_off {
            return Ok([found.force / (PI * work), (found.contact_area / PI).sqrt()]);
        }
        place -= STEP * square;
    }
    Err(format!("no least force down to the penetration {place}").into())
}

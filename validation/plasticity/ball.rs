//! A paraboloid alone: bare, coated, on a thin layer on a rigid base, and unloaded.

use super::bodies::with_hardness;
use crate::alone::{LayerOf, POINTS, WINDOW, half_space, problem};
use crate::steps::Steps;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::Interface::Bonded;
use percoat_core::body::{HalfSpace, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::{PlasticReading, Reading};
use percoat_core::spectral::Step;
use std::f64::consts::PI;

const PARABOLOID: &str = include_str!("paraboloid.csv");
const UNLOADING: &str = include_str!("unloading.csv");
const LAYERED: &str = include_str!("coated.csv");
const FOUNDATION: &str = include_str!("foundation.csv");
const BALL: Shape = Shape::Paraboloid { radius: 1.0 };
const TOLERANCE: f64 = 1e-10;
/// The load, and the pressure on the axis without hardness, of the bare body, E* = 1, on which then a = δ = 1.
const LOAD: f64 = 4.0 / 3.0;
const AXIS: f64 = 2.0 / PI;
/// Numbers of the bodies in the data: the bare one, the coated ones by their names, the thin layer.
pub const BARE: f64 = 0.0;
const NAMES: [&str; 4] = ["", "hard", "two", "soft"];
const LAYERS: [&[LayerOf]; 4] = [
    &[],
    &[(0.3, 3.0, 0.22, Bonded)],
    &[(0.2, 4.0, 0.25, Bonded), (0.1, 0.5, 0.45, Bonded)],
    &[(0.25, 0.3, 0.45, Bonded)],
];
const THIN: f64 = 4.0;
/// Side of the periodic cell of the thin layer, beyond which it is at rest, and the samples along it.
const SIDE: f64 = 3.2;
const FINE: usize = 256;
/// Greatest h/a of thin layers.
const THINNEST: f64 = 0.2;
/// Error that the grid may leave of δ, and of depths over δ: the bound of a pressure that bends within a part of the
/// radius.
const LENGTH: f64 = 3e-4;
/// Radii, over the spacing: where the elastic ring has samples, and where it has none.
const RADII: [f64; 2] = [0.1, 0.5];
/// Samples across a ring from which on radii are read between them: the law of each edge is fitted to four.
const RING: f64 = 8.0;
/// Samples across a ring below which the pressure ends with a jump, and what a jump leaves of δ, by the power 3/2 of the spacing, as that
/// of the wave.
const JUMP: f64 = 1.0;
const BY_JUMP: f64 = 1e-3;

const COLUMNS: [&str; 14] = [
    "body",
    "H_or_h",
    "P",
    "a_exact",
    "c_exact",
    "delta_exact",
    "depth_exact",
    "volume_exact",
    "a",
    "c",
    "delta",
    "depth",
    "volume",
    "spacing",
];

/// Radii of contact and of the hardness, δ, largest depth and volume.
fn read(step: &Step) -> Result<[f64; 5], StudyError> {
    let (reading, plastic) = (Reading::of(step.finest()), PlasticReading::of(step).ok_or("no hardness")?);
    let radius = |area: f64| (area / PI).sqrt();
    Ok([radius(reading.contact_area), radius(plastic.area), step.penetration(), plastic.depth, plastic.volume])
}

/// Balls on the bare body and on coatings in free space, on the thin layer in a periodic cell.
pub fn balls(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new("balls", &COLUMNS);
    for row in Data::parse("paraboloid", PARABOLOID)?.rows {
        let bodies = with_hardness(half_space(&[], [1.0, 0.0])?, row[0] * AXIS)?;
        let side = WINDOW * row[1];
        let step = Steps::to(problem(BALL, bodies, side)?, [POINTS; 2], TOLERANCE)?.step(Load::Force(LOAD))?;
        let known = [BARE, row[0], LOAD, row[1], row[2], row[3], row[4], row[5]];
        data.rows.push([&known[..], &read(&step)?, &[side / POINTS as f64]].concat());
    }
    for row in Data::parse_named("coated", LAYERED, &NAMES)?.rows {
        let &[number, c, hardness, load, delta, depth, volume] = &row[..] else { return Err("a row too short".into()) };
        let bodies = with_hardness(half_space(LAYERS[number as usize], [1.0, 0.3])?, hardness)?;
        let step = Steps::to(problem(BALL, bodies, WINDOW)?, [POINTS; 2], TOLERANCE)?.step(Load::Force(load))?;
        let known = [number, hardness, load, 1.0, c, delta, depth, volume];
        data.rows.push([&known[..], &read(&step)?, &[WINDOW / POINTS as f64]].concat());
    }
    for row in Data::parse("foundation", FOUNDATION)?.rows.into_iter().filter(|row| row[0] <= THINNEST) {
        let &[h, c, hardness, load, delta, depth, ..] = &row[..] else { return Err("a row too short".into()) };
        let layer = Layer::new(Material::from_young(0.91, 0.3)?, h, Bonded)?;
        let bodies = with_hardness(HalfSpace::on_rigid_base(vec![layer])?, hardness)?;
        let lattice = Lattice::new(Cell::square(SIDE)?, vec![vec![[0.5; 2]]])?;
        let indenters = Indenters::new(lattice, vec![Level::new(BALL, 0.0)?])?;
        let step = Steps::to(Problem::new(indenters, bodies), [FINE; 2], TOLERANCE)?.step(Load::Force(load))?;
        let known = [THIN, h, load, 1.0, c, delta, depth, f64::NAN];
        data.rows.push([&known[..], &read(&step)?, &[SIDE / FINE as f64]].concat());
    }
    for (name, first, last) in
        [("paraboloid", 0.0, 0.0), ("coated", 1.0, 3.0), ("thin layer on a rigid base", THIN, THIN)]
    {
        let rows: Vec<&Vec<f64>> = data.rows.iter().filter(|row| (first..=last).contains(&row[0])).collect();
        outcome.checks.extend(checks(name, &rows));
    }
    // a² = 2Rδ of independent springs errs in the order of h.
    let thin: Vec<[f64; 2]> = data
        .rows
        .iter()
        .filter(|row| row[0] == THIN)
        .map(|row| [row[1], (2.0 * row[10]).sqrt() / row[8] - 1.0])
        .collect();
    let (first, last) = (thin.first().ok_or("no rows")?, thin.last().ok_or("no rows")?);
    let order = (first[1] / last[1]).ln() / (first[0] / last[0]).ln();
    // The radius of a thin layer is read to a tenth of a spacing, a fifth of what independent springs err by at h/a = 0.05.
    outcome.checks.push(Check::order("thin layer, order of √(2Rδ)/a − 1 in h/a", order, 1.0, 0.2));
    Ok(data)
}

/// Checks of the columns from `a_exact` on.
fn checks(what: &str, rows: &[&Vec<f64>]) -> Vec<Check> {
    let has_ring = |row: &[f64]| row[3] - row[4] >= RING * row[13];
    let worst =
        |name: &str, pairs: Vec<(f64, f64)>, tolerance| Check::worst(format!("{what}: {name}"), pairs, tolerance);
    let over = |[found, exact]: [usize; 2], scale: &dyn Fn(&[f64]) -> f64| {
        rows.iter().map(|row| (row[found] / scale(row), row[exact] / scale(row))).collect::<Vec<_>>()
    };
    let radii = |ring: bool| {
        let rows = rows.iter().filter(move |row| has_ring(row) == ring);
        rows.flat_map(|row| [(row[8] / row[13], row[3] / row[13]), (row[9] / row[13], row[4] / row[13])])
            .collect::<Vec<_>>()
    };
    let mut checks = vec![
        worst("penetration δ", over([10, 5], &|_| 1.0), Tolerance::Relative(LENGTH)),
        worst("permanent depth over δ", over([11, 6], &|row| row[5]), Tolerance::Absolute(LENGTH)),
        worst("radii of contact and of the hardness over the spacing", radii(true), Tolerance::Absolute(RADII[0])),
    ];
    if rows.iter().any(|row| !has_ring(row)) {
        let name = "radii over the spacing, elastic ring of less than eight samples";
        checks.push(worst(name, radii(false), Tolerance::Absolute(RADII[1])));
    }
    if rows.iter().all(|row| row[7].is_finite()) {
        let pairs = over([12, 7], &|row| PI * row[4].powi(2) * row[5]);
        checks.push(worst("volume over πc²δ", pairs, Tolerance::Absolute(LENGTH)));
    }
    checks
}

/// Loaded, and unloaded on the surface that was left.
pub fn unloading(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let columns = ["H", "P", "a_exact", "delta_exact", "a", "delta", "spacing", "delta_full"];
    let mut data = Data::new("unloading", &columns);
    let table = Data::parse("unloading", UNLOADING)?;
    // The loaded contacts whose elastic ring has less than a sample.
    let loaded = Data::parse("paraboloid", PARABOLOID)?.rows;
    let is_thin = |row: &&Vec<f64>| row[1] - row[2] < JUMP * WINDOW * row[1] / POINTS as f64;
    let jumps: Vec<f64> = loaded.iter().filter(is_thin).map(|row| row[0]).collect();
    let has_jump = |hardness: f64| jumps.contains(&hardness);
    let mut steps: Option<(f64, Steps, f64, f64)> = None;
    for row in &table.rows {
        let &[hardness, part, radius, delta] = &row[..] else { return Err("a row too short".into()) };
        if steps.as_ref().is_none_or(|(current, ..)| *current != hardness) {
            let bodies = with_hardness(half_space(&[], [1.0, 0.0])?, hardness * AXIS)?;
            // A tenth more than the radius under nine tenths of the load.
            let side = 1.1 * WINDOW * radius;
            let mut loading = Steps::to(problem(BALL, bodies, side)?, [POINTS; 2], TOLERANCE)?;
            let full = loading.step(Load::Force(LOAD))?;
            loading.solver.keep_indentation();
            steps = Some((hardness, loading, side / POINTS as f64, full.penetration()));
        }
        let Some((_, loading, spacing, full)) = steps.as_mut() else { return Err("no load".into()) };
        let found = if part > 0.0 {
            let [radius, _, penetration, ..] = read(&loading.step(Load::Force(part * LOAD))?)?;
            [radius, penetration]
        } else {
            // The least of what is left of the gap.
            [0.0, loading.solver.surface().initial_gap().iter().copied().fold(f64::INFINITY, f64::min)]
        };
        data.rows.push(vec![hardness, part, radius, delta, found[0], found[1], *spacing, *full]);
    }
    let approaches = |jumps: bool| {
        let rows = data.rows.iter().filter(move |row| has_jump(row[0]) == jumps);
        rows.map(|row| (row[5] / row[7], row[3] / row[7])).collect::<Vec<_>>()
    };
    let radii = data.rows.iter().filter(|row| row[1] > 0.0).map(|row| (row[4] / row[6], row[2] / row[6]));
    outcome.checks.extend([
        Check::worst("unloading: δ over that of the full load", approaches(false), Tolerance::Absolute(LENGTH)),
        Check::worst(
            "unloading of a jump: δ over that of the full load",
            approaches(true),
            Tolerance::Absolute(BY_JUMP),
        ),
        Check::worst("unloading: radius of contact over the spacing", radii, Tolerance::Absolute(RADII[1])),
    ]);
    Ok(data)
}

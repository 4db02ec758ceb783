//! Whether the estimated discretisation errors hold: random cases against their solutions with four times the points.

use super::draw::{self, curve};
use super::random::{Random, half_space, indenters};
use super::{Check, Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Figure, Style};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::reading::{LevelErrors, Reading};
use percoat_core::spectral::{Settings, Solver, Stop};
use std::sync::Arc;

pub const STUDY: Study = Study {
    name: "discretisation",
    title: "Estimated discretisation errors on random cases",
    files: &["errors.data.csv", "figure.png"],
    run,
    quick: None,
};

/// Cases of the study; the laws were read off others.
const CASES: usize = 100;
const SEED: u64 = 2040;
/// Points of the grids, even.
const POINTS: [f64; 2] = [48.0, 80.0];
/// Points of the reference over those of the case.
const FINER: usize = 4;
/// Part that has to hold.
const HELD: f64 = 0.95;

/// Names of the estimated quantities, in the order of [`quantities`].
const QUANTITIES: [&str; 11] = [
    "mean pressure",
    "penetration",
    "contact fraction",
    "largest pressure",
    "load on one",
    "share",
    "peak pressure",
    "contact radius",
    "smallest radius",
    "largest radius",
    "asymmetry",
];

fn run() -> Result<Outcome, StudyError> {
    let mut data = Data::new("errors", &["case", "quantity", "value", "stated", "error"]);
    let mut random = Random::new(SEED);
    let mut case = 0;
    while case < CASES {
        // A penetration that reaches hardly a sample is told as unresolved: no numbers, no errors.
        let Some(rows) = compared(&mut random)? else { continue };
        case += 1;
        data.rows.extend(rows.into_iter().map(|[q, value, stated, error]| vec![case as f64, q, value, stated, error]));
    }
    let mut checks = Vec::new();
    for (number, name) in (0..).zip(QUANTITIES) {
        // A prescribed quantity, and the share of a single level, is exact and said to be.
        let rows = || data.rows.iter().filter(|row| row[1] == f64::from(number) && row[3].max(row[4]) > 0.0);
        let held = rows().filter(|row| row[4] <= row[3]).count() as f64 / rows().count() as f64;
        checks.push(Check::at_least(
            format!("{name}: part of the cases whose error is below the stated one"),
            held,
            HELD,
        ));
        // An estimate a thousand times the error would hold as well and say nothing.
        let mut excess: Vec<f64> = rows().filter(|row| row[4] > 1e-6 * row[2]).map(|row| row[3] / row[4]).collect();
        excess.sort_by(f64::total_cmp);
        let median = excess.get(excess.len() / 2).copied().unwrap_or(f64::NAN);
        checks.push(Check::at_most(format!("{name}: median of stated over true error"), median, 30.0));
    }
    Ok(Outcome { checks, figures: vec![("figure", figure(&data))], data: vec![data], ..Outcome::default() })
}

/// A random case: number of the quantity, value, stated and true error of each; `None` where it is unresolved.
fn compared(random: &mut Random) -> Result<Option<Vec<[f64; 4]>>, StudyError> {
    let problem = Arc::new(Problem::new(indenters(random)?, half_space(random)?));
    let points = 2 * random.between(0.5 * POINTS[0], 0.5 * POINTS[1]) as usize;
    let part = random.logarithmic(0.02, 0.7);
    let by_load = random.index(2) == 0;
    let solve = |points: usize, load: Option<Load>| -> Result<Option<(Load, Reading)>, StudyError> {
        let mut solver = Solver::new(Arc::clone(&problem), [points; 2], Settings::default())?;
        let load = load.unwrap_or(Load::Penetration(part * solver.full_contact_penetration()));
        let step = solver.solve(load);
        if step.report.stop == Stop::Unresolved {
            return Ok(None);
        }
        if !step.report.stop.solved() {
            return Err(format!("{points} points: {}", step.report).into());
        }
        Ok(Some((load, step.reading())))
    };
    let Some((mut load, mut found)) = solve(points, None)? else { return Ok(None) };
    if by_load {
        let mean = found.mean_pressure.ok_or("an isolated contact has no mean pressure")?;
        let Some(by_load) = solve(points, Some(Load::MeanPressure(mean)))? else { return Ok(None) };
        (load, found) = by_load;
    }
    let Some((_, exact)) = solve(FINER * points, Some(load))? else { return Ok(None) };
    let stated = stated(&found);
    let (found, exact) = (quantities(&found), quantities(&exact));
    let rows = found.into_iter().zip(exact).zip(stated);
    let row = |((found, exact), stated): ((Option<f64>, Option<f64>), Option<f64>)| {
        let (found, exact, stated) = (found?, exact?, stated?);
        // The solver's own tolerance.
        let error = ((found - exact).abs() - 1e-8 * found.abs()).max(0.0);
        (found != 0.0).then_some([found, stated, error])
    };
    let kinds = (0..4).chain((4..QUANTITIES.len()).cycle());
    let rows = kinds.zip(rows.map(row)).filter_map(|(kind, row)| row.map(|[v, s, e]| [kind as f64, v, s, e]));
    Ok(Some(rows.collect()))
}

fn quantities(step: &Reading) -> Vec<Option<f64>> {
    let whole = [step.mean_pressure, Some(step.penetration), step.contact_fraction, Some(step.max_pressure)];
    let levels = step.levels.iter().flat_map(|level| {
        let loads = [level.load, level.load_share, level.max_pressure].map(Some);
        loads.into_iter().chain([level.contact_radius, level.radius_min, level.radius_max, level.asymmetry])
    });
    whole.into_iter().chain(levels).collect()
}

fn stated(reading: &Reading) -> Vec<Option<f64>> {
    let errors = reading.errors;
    let whole = [errors.mean_pressure, errors.penetration, errors.contact_fraction, errors.max_pressure];
    let levels = reading.levels.iter().map(|level| level.errors).flat_map(|level: LevelErrors| {
        let loads = [level.load, level.load_share, level.max_pressure];
        loads.into_iter().chain([level.contact_radius, level.radius_min, level.radius_max, level.asymmetry])
    });
    whole.into_iter().chain(levels).collect()
}

fn figure(data: &Data) -> Figure {
    let least = 1e-6;
    let mut curves: Vec<_> = (0..)
        .zip(QUANTITIES)
        .map(|(number, name)| {
            let rows = data.rows.iter().filter(|row| row[1] == f64::from(number) && row[3].max(row[4]) > 0.0);
            let relative = rows.map(|row| [row[3] / row[2], (row[4] / row[2]).max(least)]);
            curve(name, Style::Markers, number as usize + 1, relative.filter(|[x, _]| *x > least))
        })
        .collect();
    curves.push(curve("true = stated", Style::Line, 0, [[least, least], [1.0, 1.0]]));
    let chart = Chart {
        title: String::new(),
        x: Axis::log("stated error, relative"),
        y: Axis::log("true error, relative"),
        curves,
    };
    draw::figure(
        vec![chart],
        "One hundred random cases against four times the points; below the line the estimate holds.",
    )
}

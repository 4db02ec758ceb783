//! Partial slip and rolling against closed forms, dense solutions and converged numbers.

mod counts;
mod coupled;
mod rolling;
mod spheres;
mod waves;

use super::draw::{self, curve};
use super::{Data, Outcome, Study, StudyError};
use percoat_app::picture::{Axis, Chart, Style};
use percoat_core::body::{Bodies, HalfSpace, Interface, Layer, Material};
use percoat_core::counterbody::{Indenters, Level, LoadedBy, Shape, Topography};
use percoat_core::friction::Friction;
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::{Drive, Settings, SlipSettings, SlipSolver, SlipStep};

pub const STUDY: Study = Study {
    name: "partial-slip",
    title: "Partial slip and rolling: shifts, cycles, creepages, a dense coupled contact, and iterations",
    files: &[
        "balls.data.csv",
        "converged.data.csv",
        "coupled.data.csv",
        "cycles.data.csv",
        "figure.png",
        "iterations.data.csv",
        "proportional.data.csv",
        "punch.data.csv",
        "rolling.data.csv",
        "waves.data.csv",
    ],
    run: || run(false),
    quick: Some(|| run(true)),
};

/// Tolerance of the normal contact: below the errors of the grid.
const TOLERANCE: f64 = 1e-10;

fn run(quick: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    spheres::add(&mut outcome, quick)?;
    waves::add(&mut outcome, quick)?;
    rolling::add(&mut outcome, quick)?;
    coupled::add(&mut outcome)?;
    counts::add(&mut outcome, quick)?;
    outcome
        .figures
        .push(("figure", draw::figure(charts(&outcome), "Shifts, creepages and iterations of partial slip.")));
    Ok(outcome)
}

/// Shifts of waves over the force, creepages, and iterations over the number of points.
fn charts(outcome: &Outcome) -> Vec<Chart> {
    let find = |name: &str| outcome.data.iter().find(|data| data.name == name).cloned().unwrap_or(Data::new("", &[]));
    let (waves, rolling, iterations) = (find("waves"), find("rolling"), find("iterations"));
    let against = |data: &Data, found: &str, exact: &str| {
        let parts = data.column("part");
        let points = |name: &str| parts.iter().copied().zip(data.column(name)).map(|(x, y)| [x, y]).collect::<Vec<_>>();
        let finest = data.column("points").into_iter().fold(0.0, f64::max);
        let kept = data.column("points").into_iter().map(|points| points == finest || finest == 0.0);
        let kept: Vec<bool> = kept.collect();
        let all = if kept.is_empty() { vec![true; parts.len()] } else { kept };
        let keep = |all: &[bool], points: Vec<[f64; 2]>| {
            points.into_iter().zip(all.to_vec()).filter(|(_, kept)| *kept).map(|(point, _)| point).collect::<Vec<_>>()
        };
        vec![
            curve("dense solution", Style::Markers, 0, keep(&all, points(exact))),
            curve("percoat", Style::Markers, 1, keep(&all, points(found))),
        ]
    };
    let counted = (0u8..).zip(counts::NAMES).map(|(index, name)| {
        let rows = iterations.rows.iter().filter(|row| row[0] == f64::from(index));
        curve(name, Style::Markers, usize::from(index), rows.map(|row| [row[1], row[3]]))
    });
    vec![
        Chart {
            title: "(a) shift of a wave".into(),
            x: Axis::linear("tangential force Q/μP"),
            y: Axis::linear("shift over μ"),
            curves: against(&waves, "shift", "shift_exact"),
        },
        Chart {
            title: "(b) creepage of a wave that rolls".into(),
            x: Axis::linear("tangential force Q/μP"),
            y: Axis::linear("creepage over μ"),
            curves: against(&rolling, "creepage", "creepage_exact"),
        },
        Chart {
            title: "(c) iterations of the tractions".into(),
            x: Axis::log("points along a side"),
            y: Axis::linear("iterations"),
            curves: counted.collect(),
        },
    ]
}

/// A half-space of the shear modulus 1 below layers of a shear modulus, Poisson's ratio and thickness.
fn half_space(layers: &[[f64; 3]], poisson: f64) -> Result<HalfSpace, StudyError> {
    let layer = |&[shear, poisson, thickness]: &[f64; 3]| -> Result<Layer, StudyError> {
        Ok(Layer::new(Material::from_shear(shear, poisson)?, thickness, Interface::Bonded)?)
    };
    let layers = layers.iter().map(layer).collect::<Result<Vec<_>, _>>()?;
    Ok(HalfSpace::new(layers, Material::from_shear(1.0, poisson)?))
}

/// The same body twice.
fn like(body: HalfSpace) -> Bodies {
    Bodies::elastic(body.clone(), body)
}

/// A ball of the radius 1 over the middle of a cell.
fn ball(cell: Cell) -> Result<Indenters, StudyError> {
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
    Ok(Indenters::new(Lattice::new(cell, vec![vec![[0.5; 2]]])?, vec![level])?)
}

fn rubbing(loaded_by: impl Into<LoadedBy>, bodies: impl Into<Bodies>, friction: f64) -> Result<Problem, StudyError> {
    Ok(Problem::new(loaded_by, bodies).sliding(Friction::new(friction, [1.0, 0.0])?)?)
}

/// Samples of a wave along the direction in which nothing changes.
const ROWS: usize = 4;

/// The wave .01(1 − cos 2πx) between like bodies below a layer, of the shear modulus χ unless that is 0, on so many points.
fn wave([chi, nu, h]: [f64; 3], points: usize) -> Result<SlipSolver, StudyError> {
    let cell = Cell::new([1.0, 0.0], [0.0, ROWS as f64 / points as f64])?;
    let height = |s: f64, _: f64| 0.01 * ((std::f64::consts::TAU * s).cos() - 1.0);
    let surface: Topography = super::steps::topography(cell, [points, ROWS], height)?;
    let layers = if chi > 0.0 { vec![[chi, nu, h]] } else { vec![] };
    solver(rubbing(surface, like(half_space(&layers, 0.3)?), 1.0)?, [points, ROWS])
}

/// Width of a wave, a length.
fn width(points: usize) -> f64 {
    ROWS as f64 / points as f64
}

fn solver(problem: Problem, points: [usize; 2]) -> Result<SlipSolver, StudyError> {
    let settings = Settings { tolerance: TOLERANCE, ..Settings::default() };
    Ok(SlipSolver::new(problem, points, settings, SlipSettings::default())?)
}

/// One step; an error unless it converged.
fn advance(solver: &mut SlipSolver, load: Load, drive: Drive) -> Result<SlipStep, StudyError> {
    let step = solver.advance(load, drive)?;
    if step.converged { Ok(step) } else { Err(format!("{load}: {:?}", step.report).into()) }
}

/// One step to a tangential force along x over μP.
fn to_part(solver: &mut SlipSolver, load: Load, part: f64) -> Result<SlipStep, StudyError> {
    advance(solver, load, Drive::Part([part, 0.0]))
}

//! Unlike bodies, whose pressure and tractions couple: a dense solution sample by sample, and a punch that sticks.

use super::setup::{advance, half_space, rubbing, solver};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::body::{Bodies, HalfSpace, Material};
use percoat_core::lattice::Cell;
use percoat_core::load::Load;
use percoat_core::spectral::{Drive, SlipSettings, SlipSolver};
use std::f64::consts::TAU;

const DENSE: &str = include_str!("coupled.csv");
/// The cell of `generate.py`.
const CELL: ([f64; 2], [f64; 2]) = ([1.0, 0.0], [0.35, 0.9]);
const POINTS: [usize; 2] = [21, 23];
const FRICTION: f64 = 0.4;
const PENETRATION: f64 = 0.022;
const SHIFT: [f64; 2] = [0.0028, -0.0018];
/// Gap of the certificate of the tractions: errors of samples are of the order of its root.
const GAP: f64 = 1e-14;
const SAMPLES: f64 = 1e-6;

pub fn add(outcome: &mut Outcome) -> Result<(), StudyError> {
    dense(outcome)?;
    punch(outcome)
}

fn bare(shear: f64, poisson: f64) -> Result<HalfSpace, StudyError> {
    Ok(HalfSpace::new(vec![], Material::from_shear(shear, poisson)?))
}

/// Pressures and tractions of the same steps, solved densely by relaxation.
fn dense(outcome: &mut Outcome) -> Result<(), StudyError> {
    let gap = |u: f64, v: f64| 0.02 * (2.0 - (TAU * u).cos() - (TAU * v).cos());
    let surface = crate::steps::topography(Cell::new(CELL.0, CELL.1)?, POINTS, |u, v| -gap(u, v))?;
    let bodies = Bodies::elastic(half_space(&[[4.0, 0.2, 0.1]], 0.3)?, bare(2.0, 0.1)?);
    let problem = rubbing(surface, bodies, FRICTION)?;
    let settings = percoat_core::spectral::Settings { tolerance: 1e-14, ..Default::default() };
    let slip = SlipSettings { tolerance: GAP, ..SlipSettings::default() };
    // The parts of the dense steps.
    let mut solver = SlipSolver::new(problem, POINTS, settings, slip)?.with_parts(2);
    let step = advance(&mut solver, Load::Penetration(PENETRATION), Drive::Shift(SHIFT))?;
    let contact = step.contact.finest();
    let shear = contact.shear().ok_or("there is no shear")?;
    let mut data = Data::new("coupled", &["i", "j", "p", "p_dense", "qx", "qx_dense", "qy", "qy_dense"]);
    let (mut touching, mut pairs) = (0, Vec::new());
    let reference = Data::parse("coupled", DENSE)?.rows;
    let most = reference.iter().filter(|row| row[0] >= 0.0).fold(0.0, |most: f64, row| most.max(row[2]));
    for row in reference.iter().filter(|row| row[0] >= 0.0) {
        let index = row[0] as usize * POINTS[1] + row[1] as usize;
        let found = [contact.pressures()[index], shear.traction[0][index], shear.traction[1][index]];
        touching += usize::from(found[0] > 0.0);
        pairs.extend(found.iter().zip(&row[2..]).map(|(found, dense)| (found / most, dense / most)));
        data.rows.push(vec![row[0], row[1], found[0], row[2], found[1], row[3], found[2], row[4]]);
    }
    let all = contact.pressures().iter().filter(|p| **p > 0.0).count();
    outcome.checks.push(Check::worst(
        "coupled cell against a dense solution: p, q_x, q_y over the largest p",
        pairs,
        Tolerance::Absolute(SAMPLES),
    ));
    outcome.checks.push(Check::absolute("the same: samples in contact", all as f64, touching as f64, 0.0));
    outcome.data.push(data);
    Ok(())
}

/// Force of a rigid flat punch that sticks over that of a smooth one, (1 − ν) ln(3 − 4ν)/(1 − 2ν) (Spence, Proc. R. Soc. A 305 (1968) 55).
fn punch(outcome: &mut Outcome) -> Result<(), StudyError> {
    /// Penetration; the surface beside the punch lies lower by twice that.
    const DEPTH: f64 = 0.01;
    let mut data = Data::new("punch", &["points", "nu", "ratio", "ratio_exact"]);
    for points in [48, 96] {
        for poisson in [0.0, 0.3] {
            let side = 2.4;
            let height = |u: f64, v: f64| {
                let [x, y] = [u, v].map(|part| side * (part - 0.5));
                if x.hypot(y) <= 1.0 { 0.0 } else { -2.0 * DEPTH }
            };
            let force = |friction: f64| -> Result<f64, StudyError> {
                let surface = crate::steps::topography(Cell::window([side; 2])?, [points; 2], height)?;
                let mut solver = solver(rubbing(surface, bare(1.0, poisson)?, friction)?, [points; 2])?.with_parts(2);
                let step = advance(&mut solver, Load::Penetration(DEPTH), Drive::Shift([0.0; 2]))?;
                Ok(step.contact.finest().pressures().iter().sum())
            };
            let exact = (1.0 - poisson) * (3.0 - 4.0 * poisson).ln() / (1.0 - 2.0 * poisson);
            data.rows.push(vec![points as f64, poisson, force(20.0)? / force(1e-9)?, exact]);
        }
    }
    let pairs = data.rows.iter().map(|row| (row[2], row[3]));
    // Both forces end at the same rim of samples, a spacing wide; what their ratio keeps of it is of the size of the ratio's excess times the spacing.
    outcome.checks.push(Check::worst(
        "punch that sticks, Spence: force over that without friction",
        pairs,
        Tolerance::Relative(2e-3),
    ));
    outcome.data.push(data);
    Ok(())
}

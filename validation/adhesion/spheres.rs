//! Spheres on a bare half-space, from nearly rigid to soft: Maugis' theory.

use super::setup::{adhering, ball, draw_off, solver, unit};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::adhesion::MaugisState;
use percoat_core::lattice::Cell;
use percoat_core::numeric::fourier::fast_points;
use percoat_core::reading::AdhesionReading;
use std::f64::consts::PI;

const SPHERES: &str = include_str!("spheres.csv");
/// Samples across the zone that pulls, of parameters up to 2, of 3, and of 5.
const ACROSS: [f64; 3] = [6.0, 4.0, 2.0];
/// Work of adhesion in Maugis' units with E* = R = 1: 4/3π.
const WORK: f64 = 4.0 / (3.0 * PI);
/// The unit of force, πwR.
const FORCE: f64 = 4.0 / 3.0;
/// Penetration above that of pull-off at which the path begins, and its step.
const ABOVE: f64 = 0.3;
const STEP: f64 = 0.05;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns = [
        "lambda",
        "points",
        "samples",
        "force",
        "error",
        "force_exact",
        "penetration",
        "penetration_exact",
        "jump",
        "jump_exact",
        "jump_force",
        "jump_force_exact",
        "margin",
        "iterations",
    ];
    let mut data = Data::new("spheres", &columns);
    for row in Data::parse("spheres", SPHERES)?.rows {
        let [lambda, force, penetration, radius, ratio, grip_force, grip] = row[..] else {
            return Err("a sphere has seven numbers".into());
        };
        if quick && lambda != 1.0 {
            continue;
        }
        let strength = lambda / 1.5;
        let begin = at(lambda, penetration + ABOVE, radius);
        // Contact and the zone beside it have room, and the zone so many samples.
        let side = 2.5 * (begin.radius * begin.ratio).max(radius * ratio);
        let across = ACROSS[usize::from(lambda > 2.0) + usize::from(lambda > 3.0)];
        let zone = 0.75 / (lambda * lambda);
        let points = fast_points(((side / zone * across).ceil() as usize).max(96));
        let problem = adhering(ball(Cell::window([side; 2])?)?, unit()?, [WORK, WORK / strength])?;
        let mut solver = solver(problem, [points; 2])?;
        let lowest = if grip < 0.0 { grip - 2.0 * STEP } else { penetration - 4.0 * STEP };
        let from = penetration + ABOVE;
        let steps = draw_off(&mut solver, from, lowest, ((from - lowest) / STEP).ceil() as u32)?;
        let last = steps.last().and_then(AdhesionReading::of).ok_or("a step adheres")?;
        let found = last.pull_off.ok_or("the force does not rise again")?;
        let jump = steps.iter().flat_map(|step| &step.jumps).find(|jump| !jump.is_in);
        let [jumped, jump_force] = jump.map_or([f64::NAN; 2], |jump| {
            [0.5 * jump.penetration.map(|place| place.unwrap_or(f64::NAN)).iter().sum::<f64>(), jump.force[0] / FORCE]
        });
        let margin = steps.iter().filter_map(|step| step.stability).fold(f64::INFINITY, f64::min);
        let iterations = steps.iter().filter(|step| step.jumps.is_empty()).map(|step| step.contact.report.iterations);
        data.rows.push(vec![
            lambda,
            points as f64,
            last.samples,
            found.force / FORCE,
            found.error.unwrap_or(f64::NAN) / FORCE,
            force,
            found.penetration,
            penetration,
            jumped,
            if grip < 0.0 { grip } else { f64::NAN },
            jump_force,
            if grip < 0.0 { grip_force } else { f64::NAN },
            margin,
            iterations.max().unwrap_or(0) as f64,
        ]);
    }
    check(outcome, &data, quick);
    outcome.data.push(data);
    Ok(())
}

/// The state of Maugis' theory at a penetration above that of pull-off with a contact radius.
pub fn at(lambda: f64, penetration: f64, radius: f64) -> MaugisState {
    let [mut low, mut high] = [radius, 4.0];
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if MaugisState::at(middle, lambda).penetration < penetration { low = middle } else { high = middle }
    }
    MaugisState::at(low, lambda)
}

fn check(outcome: &mut Outcome, data: &Data, quick: bool) {
    let pairs = |names: [&str; 2], wanted: &dyn Fn(&[f64]) -> bool| {
        let index = names.map(|name| data.columns.iter().position(|column| column == name).unwrap_or(0));
        let rows = data.rows.iter().filter(|row| wanted(row));
        rows.map(|row| (row[index[0]], row[index[1]])).collect::<Vec<_>>()
    };
    let is_one = |row: &[f64]| row[0] == 1.0;
    let fine = |row: &[f64]| row[2] >= 4.0;
    let mut worst = |what: &str, names, wanted: &dyn Fn(&[f64]) -> bool, tolerance| {
        outcome.checks.push(Check::worst(what, pairs(names, wanted), tolerance));
    };
    worst("pull-off of a sphere, λ = 1", ["force", "force_exact"], &is_one, Tolerance::Relative(3e-3));
    worst("penetration of the jump apart, λ = 1", ["jump", "jump_exact"], &is_one, Tolerance::Absolute(0.02));
    let errors = data.rows.iter().filter(|row| is_one(row)).map(|row| ((row[3] - row[5]).abs(), row[4]));
    outcome.checks.push(Check::worst("error of pull-off below the stated one, λ = 1", errors, Tolerance::AtMost));
    if quick {
        return;
    }
    let mut worst = |what: &str, names, wanted: &dyn Fn(&[f64]) -> bool, tolerance| {
        outcome.checks.push(Check::worst(what, pairs(names, wanted), tolerance));
    };
    worst("pull-off of spheres, λ = 0.1 to 3", ["force", "force_exact"], &fine, Tolerance::Relative(3e-3));
    worst(
        "pull-off of a sphere, λ = 5, two samples across the zone",
        ["force", "force_exact"],
        &|row| row[0] == 5.0,
        Tolerance::Relative(1e-2),
    );
    worst(
        "penetration of the jump apart, λ = 1 to 5",
        ["jump", "jump_exact"],
        &|row| row[0] >= 1.0,
        Tolerance::Absolute(0.02),
    );
    // With two samples across the zone no coarser grid resolves it, and no error is stated.
    let errors = data.rows.iter().filter(|row| row[4].is_finite()).map(|row| ((row[3] - row[5]).abs(), row[4]));
    outcome.checks.push(Check::worst(
        "error of pull-off below the stated one, λ = 0.1 to 3",
        errors,
        Tolerance::AtMost,
    ));
}

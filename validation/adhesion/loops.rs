//! Closed paths: no loss where nothing jumps, and elsewhere that of the jumps.

use super::setup::{adhering, advance, ball, layer, solver, unit};
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::adhesion::MaugisState;
use percoat_core::body::{HalfSpace, Material};
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::{Cell, Lattice};
use percoat_core::load::Load;
use percoat_core::spectral::AdhesiveStep;
use std::f64::consts::PI;

pub fn add(outcome: &mut Outcome) -> Result<(), StudyError> {
    let mut data = Data::new("loops", &["loop", "work", "lost", "missing", "difference"]);
    // Three levels on a coating, in contact all the way.
    let level = |height: f64| Level::new(Shape::Paraboloid { radius: 0.8 }, height);
    let levels = vec![level(0.02)?, level(0.01)?, level(0.0)?];
    let indenters = Indenters::new(Lattice::hexagonal(1.0, 3)?, levels)?;
    let coated = HalfSpace::new(vec![layer([2.0, 0.3, 0.2])?], Material::from_young(1.0, 0.3)?);
    let mut held = solver(adhering(indenters, coated, [2e-4, 0.008])?, [96; 2])?;
    let mut kept = there_and_back(&mut held, 0.05, 0.03, 5)?;
    // A sphere that is drawn off and comes back.
    let work = 4.0 / (3.0 * PI);
    let problem = adhering(ball(Cell::window([5.0; 2])?)?, unit()?, [work, work])?;
    let mut lost = there_and_back(&mut solver(problem, [64; 2])?, 0.2, -1.2, 28)?;
    for (number, steps) in [&mut kept, &mut lost].into_iter().enumerate() {
        let first = steps[0].numbers;
        let last = steps[steps.len() - 1].numbers;
        let sum = |of: &dyn Fn(&AdhesiveStep) -> f64| steps[1..].iter().map(of).sum::<f64>();
        let by_jumps = sum(&|step| step.jumps.iter().filter_map(|jump| jump.loss).sum());
        let (done, missing) = (sum(&|step| step.work[0]), sum(&|step| step.work[1]));
        let difference = (first.force - last.force).abs() / first.adhesive_load;
        data.rows.push(vec![number as f64, done, by_jumps, missing, difference]);
    }
    let jumps: Vec<[Option<f64>; 2]> = lost.iter().flat_map(|step| &step.jumps).map(|jump| jump.penetration).collect();
    let [[Some(out), _], [Some(back), _]] = jumps[..] else {
        return Err(format!("a loop has other jumps than one out and one in: {jumps:?}").into());
    };
    let exact = 4.0 / 3.0 * below_the_axis(1.5, [out, back]);
    let [held, drawn] = [&data.rows[0], &data.rows[1]];
    outcome.checks.push(Check::at_most("force after a loop without a jump, over the tension", held[4], 1e-6));
    outcome.checks.push(Check::at_most(
        "work of a loop without a jump, over the work of adhesion on an area of 1",
        held[1].abs() / 2e-4,
        1e-6,
    ));
    outcome.checks.push(Check::at_most(
        "what trapezoids miss in a loop with two jumps, over what these lose",
        drawn[3] / drawn[2],
        0.03,
    ));
    // Places of jumps are known to 0.02 of the range, 2 % of the loop each, and forces to 1 %.
    outcome.checks.push(Check::worst(
        "loss of a loop with two jumps, against Maugis' force between them",
        [(drawn[2], exact)],
        Tolerance::Relative(0.05),
    ));
    outcome.data.push(data);
    Ok(())
}

/// −∫ P dδ along the branch in contact of a sphere by Maugis, between two penetrations, in his units.
fn below_the_axis(lambda: f64, [from, to]: [f64; 2]) -> f64 {
    let states: Vec<MaugisState> = (0..3000).map(|k| MaugisState::at(3.0 - 1e-3 * f64::from(k), lambda)).collect();
    let falling = states.windows(2).take_while(|pair| pair[1].penetration < pair[0].penetration);
    let part = |pair: &[MaugisState]| {
        let [low, high] = [pair[1].penetration.max(from), pair[0].penetration.min(to)];
        -0.5 * (pair[0].force + pair[1].force) * (high - low).max(0.0)
    };
    falling.map(part).sum()
}

/// The steps from a penetration to another one and back.
fn there_and_back(
    solver: &mut percoat_core::spectral::AdhesiveSolver,
    from: f64,
    to: f64,
    steps: u32,
) -> Result<Vec<AdhesiveStep>, StudyError> {
    let place = |k: u32| from + (to - from) * f64::from(k) / f64::from(steps);
    let way = (0..=steps).chain((0..steps).rev());
    way.map(|k| advance(solver, Load::Penetration(place(k)))).collect()
}

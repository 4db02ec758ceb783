//! Balls of low density on a lattice: each is alone but for the mean displacement by all others.

use super::setup::{adhering, advance, solver, unit};
use super::spheres;
use crate::exact::lattice_sums::TRIANGULAR;
use crate::{Check, Data, Outcome, StudyError, Tolerance};
use percoat_core::adhesion::MaugisState;
use percoat_core::counterbody::{Indenters, Level, Shape};
use percoat_core::lattice::Lattice;
use percoat_core::load::Load;
use std::f64::consts::PI;

/// Period over Maugis' unit of radius, so that a contact is a sixteenth of it.
const PERIOD: f64 = 15.0;
/// Penetrations in Maugis' unit.
const PLACES: [f64; 4] = [0.6, 0.3, 0.0, -0.2];

pub fn add(outcome: &mut Outcome) -> Result<(), StudyError> {
    // λ = 1, R = E* = 1, w = 4/3π: Maugis' units are 1, the force 4/3.
    let (work, lambda) = (4.0 / (3.0 * PI), 1.0);
    let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0)?;
    let indenters = Indenters::new(Lattice::hexagonal(PERIOD, 1)?, vec![level])?;
    let mut solver = solver(adhering(indenters, unit()?, [work, 1.5 * work / lambda])?, [180; 2])?;
    let mut data = Data::new("lattice", &["penetration", "force", "force_exact", "alone"]);
    let [sum, ..] = TRIANGULAR.0;
    for place in PLACES {
        let step = advance(&mut solver, Load::Penetration(place))?;
        // δ of one alone is δ − P S₁/(πE*l).
        let mut alone = MaugisState::pull_off(lambda);
        let [mut low, mut high] = [alone.radius, 3.0];
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            alone = MaugisState::at(middle, lambda);
            let shifted = place - 4.0 / 3.0 * alone.force * sum / (PI * PERIOD);
            if alone.penetration < shifted { low = middle } else { high = middle }
        }
        let free = spheres::at(lambda, place, MaugisState::pull_off(lambda).radius).force;
        data.rows.push(vec![place, step.numbers.force * 0.75, alone.force, free]);
    }
    // The next term of the sum is (a/l)² = 1/250 of it, and the grid has nine samples across the zone that pulls.
    let pairs = data.rows.iter().map(|row| (row[1], row[2]));
    outcome.checks.push(Check::worst("force on a lattice of low density", pairs, Tolerance::Relative(4e-3)));
    outcome.data.push(data);
    Ok(())
}

//! Indenters without mutual effect, each alone on the layered half-space: the dashed curves of the paper.

use super::circle::CircleRadius;
use super::solution::{Solution, Stop};
use super::solver::{Localized, Setup};
use super::spot::Spot;
use crate::body::Bodies;
use crate::counterbody::{Indenters, Level};
use crate::lattice::Lattice;
use crate::load::Load;
use crate::problem::Problem;
use crate::reading::{LevelReading, Reading};

/// Number of elements across the largest contact: radii and pressures err by 1e-3, radii by half an element where the pressure is
/// concentrated at the edge.
const ELEMENTS: usize = 24;
/// Period of the lattice of an isolated indenter, over the size of the system's cell: only the cells have to hold the contacts.
const ISOLATING_PERIOD: f64 = 6.0;

const ISOLATED: Setup =
    Setup { indenters: 1, elements: ELEMENTS, rule: CircleRadius::LoadBalanced, mutual_effect: false };

/// Largest fraction in contact at which indenters are compared with isolated ones: beyond it the isolated contacts would reach far
/// into each other's cells, which has no meaning and takes minutes.
const MAX_CONTACT_FRACTION: f64 = 0.5;

/// Whether the contacts of a step are separate, so that each can be compared with an isolated one.
fn stand_apart(reading: &Reading) -> bool {
    let is_small = reading.contact_fraction.is_some_and(|part| part < MAX_CONTACT_FRACTION);
    is_small && !reading.levels.iter().any(|level| level.merged)
}

/// Outer contact radius of each level without mutual effect (0 without contact), a length, when all have one penetration and carry
/// the mean pressure of a solved step together (Figs 2b, 4b and Table 1). `None` where contacts are not separate, or for a
/// topography.
pub fn radii(problem: &Problem, reading: &Reading) -> Option<Vec<f64>> {
    let localized = Localized::new(problem, 1).ok().filter(|_| stand_apart(reading))?;
    let solution = localized.solve(Load::MeanPressure(reading.mean_pressure?), &ISOLATED);
    // All indenters of a level have the same contact.
    let spot_of = |level: usize| solution.spots.iter().find(|spot| spot.level == level && spot.touches());
    let radii = (1..=reading.levels.len()).map(|level| spot_of(level).map_or(0.0, Spot::outer_radius)).collect();
    (solution.stop == Stop::Converged).then_some(radii)
}

/// Pressure of each level's isolated indenter under the load it carries in a solved step: points (distance from the axis,
/// pressure) from the axis to the edge (Fig. 3), empty without load; `None` where contacts are not separate.
pub fn profiles(problem: &Problem, reading: &Reading) -> Option<Vec<Vec<[f64; 2]>>> {
    let size = problem.cell().reduced().longer_side();
    let levels = problem.levels().iter().zip(&reading.levels);
    let of_level = |(level, loaded): (&Level, &LevelReading)| profile(level, problem.bodies(), loaded.load, size);
    stand_apart(reading).then(|| levels.map(|level| of_level(level).unwrap_or_default()).collect())
}

/// Pressure of a single indenter of `level` under a `force`, as in [`profiles`]; `size` is a length of the order of the contact's
/// or larger. `None` without force or solution.
fn profile(level: &Level, bodies: &Bodies, force: f64, size: f64) -> Option<Vec<[f64; 2]>> {
    let lattice = Lattice::square(ISOLATING_PERIOD * size, 1).ok()?;
    let mean_pressure = Load::MeanPressure(force / lattice.cell().area());
    let alone = Indenters::new(lattice, vec![level.clone()]).ok().filter(|_| force > 0.0)?;
    let alone = Localized::new(&Problem::new(alone, bodies.clone()), 1).ok()?;
    let Solution { spots, stop, .. } = alone.solve(mean_pressure, &ISOLATED);
    let spot = &spots[0];
    let middle = spot.mesh.width / 2;
    let edge = spot.outer_radius();
    let place = |j: usize| spot.mesh.place(middle * spot.mesh.width + j)[1];
    let points = (middle..spot.mesh.width).map(|j| [place(j), spot.pressure[[middle, j]]]);
    let inside = points.filter(|[r, p]| *p > 0.0 && *r < edge).chain([[edge, 0.0]]);
    (stop == Stop::Converged).then(|| inside.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::Shape;

    #[test]
    fn an_isolated_profile_is_hertzian() {
        let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap());
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let a = 0.2f64;
        let points = profile(&level, &half_space.into(), 4.0 / 3.0 * a.powi(3), 1.0).unwrap();
        for [r, p] in points.into_iter().filter(|[r, _]| *r < 0.9 * a) {
            let hertz = 2.0 / std::f64::consts::PI * (a * a - r * r).sqrt();
            assert!((p / hertz - 1.0).abs() < 8e-3, "{r}: {p} {hertz}");
        }
    }
}

//! One indenter of a lattice alone: what the lattice changes.

use crate::counterbody::Indenters;
use crate::lattice::{Cell, Lattice};
use crate::load::Load;
use crate::problem::Problem;
use crate::reading::Reading;
use crate::spectral::{Settings, Solver};

/// Largest fraction in contact at which contacts are nearly alone.
const SPARSE: f64 = 0.1;
/// Side of the window over the contact's diameter.
const ROOM: f64 = 1.5;
/// Samples along the window.
const POINTS: usize = 96;

/// The reading of one indenter alone under the force that it bears in a step of a periodic system with this `reading`; `None` unless
/// the system has one indenter a cell, which covers little of it, rests and does not adhere.
pub fn alone(problem: &Problem, reading: &Reading) -> Option<Reading> {
    let indenters = problem.indenters().filter(|_| problem.adhesion().is_none() && problem.motion().is_none())?;
    let [level] = indenters.levels() else { return None };
    let level_reading = reading.levels.first()?;
    let sites: usize = indenters.lattice().sites().iter().map(Vec::len).sum();
    let is_sparse = sites == 1 && reading.touches() && reading.contact_fraction.is_some_and(|part| part < SPARSE);
    let radius = level_reading.contact_radius.filter(|_| is_sparse)?;
    let window = Cell::window([2.0 * ROOM * radius; 2]).ok()?;
    let lattice = Lattice::new(window, vec![vec![[0.5; 2]]]).ok()?;
    let mut single = Problem::new(Indenters::new(lattice, vec![level.clone()]).ok()?, problem.bodies());
    if let Some(friction) = problem.friction() {
        single = single.sliding(*friction).ok()?;
    }
    let step = Solver::new(single, [POINTS; 2], Settings::default()).ok()?.solve(Load::Force(level_reading.load));
    step.report.stop.solved().then(|| step.reading())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::{Level, Shape};

    /// The images of a square lattice of the side l lower the penetration by 3.9 P/(πE*l): ∑1/r less its mean over the plane.
    #[test]
    fn the_lattice_changes_the_penetration_by_its_lattice_sum() {
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let indenters = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
        let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap());
        let problem = Problem::new(indenters, body);
        let mut solver = Solver::new(problem.clone(), [192; 2], Settings::default()).unwrap();
        let step = solver.solve(Load::MeanPressure(0.002));
        let reading = step.reading();
        let single = alone(&problem, &reading).unwrap();
        let known = -3.900_265 * reading.force / std::f64::consts::PI;
        let found = reading.penetration - single.penetration;
        assert!((found / known - 1.0).abs() < 1e-2, "{found} {known}");
        assert!(
            alone(&problem, &solver.solve(Load::MeanPressure(0.2)).reading()).is_none(),
            "contacts that are not sparse"
        );
    }
}

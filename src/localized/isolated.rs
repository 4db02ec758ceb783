//! Indenters without mutual effect, as the paper draws them dashed: each alone on the layered half-space.

use super::circle::CircleRadius;
use super::solver::{Solution, Stop};
use super::spot::Spot;
use super::system::{Localized, Setup};
use crate::indenter::Level;
use crate::lattice::{Lattice, LatticeError};
use crate::material::HalfSpace;
use crate::solver::Control;

/// Elements across the largest contact: radii and pressures to 1e-3, for pictures.
const ELEMENTS: usize = 24;
/// Period, in those of the system, at which indenters are taken for alone: only their cells have to hold the contacts.
const APART: f64 = 6.0;

const ALONE: Setup =
    Setup { indenters: 1, elements: ELEMENTS, radius: CircleRadius::LoadBalanced, mutual_effect: false };

/// Outer contact radius of each level (0: it does not touch) when all have one penetration and carry the prescribed load
/// together but do not feel each other (Figs 2b, 4b and Table 1). `None` where contacts would meet.
pub fn radii(lattice: &Lattice, levels: &[Level], half_space: &HalfSpace, control: Control) -> Option<Vec<f64>> {
    let system = Localized::new(lattice, levels, half_space, 1);
    let solution = system.solve(control, &ALONE);
    // All indenters of a level are alike.
    let own = |level: usize| solution.spots.iter().find(|spot| spot.level == level && spot.touches());
    let radii = (1..=levels.len()).map(|level| own(level).map_or(0.0, Spot::outer_radius)).collect();
    (solution.stop == Stop::Converged).then_some(radii)
}

/// Pressure of a single indenter of `level` under `load`: points (distance from the axis, pressure) from the axis to
/// the edge (Fig. 3). `None` without load or solution.
///
/// # Errors
/// [`LatticeError`] when `size`, a length of the order of the contact's or larger, is not positive.
pub fn profile(
    level: Level,
    half_space: &HalfSpace,
    load: f64,
    size: f64,
) -> Result<Option<Vec<[f64; 2]>>, LatticeError> {
    let lattice = Lattice::square(APART * size, 1)?;
    if load <= 0.0 {
        return Ok(None);
    }
    let system = Localized::new(&lattice, &[level], half_space, 1);
    let Solution { spots, stop, .. } = system.solve(Control::MeanPressure(load / system.cell_area()), &ALONE);
    let spot = &spots[0];
    let middle = spot.mesh.width / 2;
    let edge = spot.outer_radius();
    let row = (middle..spot.mesh.width).map(|j| middle * spot.mesh.width + j);
    let points = row.map(|index| [spot.mesh.place(index)[1], spot.pressure[index]]);
    let inside = points.filter(|[r, p]| *p > 0.0 && *r < edge).chain([[edge, 0.0]]);
    Ok((stop == Stop::Converged).then(|| inside.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::indenter::Shape;
    use crate::material::Material;

    #[test]
    fn an_isolated_profile_is_hertzian() {
        let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.0).unwrap());
        let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
        let a = 0.2f64;
        let points = profile(level, &half_space, 4.0 / 3.0 * a.powi(3), 1.0).unwrap().unwrap();
        for [r, p] in points.into_iter().filter(|[r, _]| *r < 0.9 * a) {
            let hertz = 2.0 / std::f64::consts::PI * (a * a - r * r).sqrt();
            assert!((p / hertz - 1.0).abs() < 8e-3, "{r}: {p} {hertz}");
        }
    }
}

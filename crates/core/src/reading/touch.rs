//! First touch: the mean pressure at which each level comes into contact.
//!
//! The contact of a level appears at one load and stays, so that bisection on the logarithm of the mean pressure finds
//! it, between a negligible one and that of complete contact: on the grid of a solver and, with the same solutions, on the
//! next coarser one.
//!
//! **Error.** Bisection leaves a bracket. A contact starts with one sample, which may lie beside the apex, lower by s:
//! with p̄ ~ δ^{(n+1)/n} under profiles rⁿ, n ≥ 1, that changes p̄ by at most 2 p̄ s/δ. The contacts that carry the load by then
//! have N samples along the radius of the largest, and p̄ errs at a given δ by the law of [`Errors`](super::Errors). The
//! coarser grid errs about four times as much; the change from it is taken for the error all the same, as it oscillates with
//! the places of the samples. The estimate is half the bracket and 1.5 times the largest of these.

use super::estimate::load_law;
use super::spots::spots;
use crate::load::Load;
use crate::spectral::{Contact, Solver};
use std::f64::consts::PI;

/// Largest ratio of the ends of the bracket of a first touch.
const BRACKET_RATIO: f64 = 1.003;
/// Part of the pressure of complete contact below which a touch counts as immediate.
const NEGLIGIBLE: f64 = 1e-9;
/// Safety factor on the larger of the error by the samples and the change between the grids.
const SAFETY: f64 = 1.5;

/// The load at which a level first touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstTouch {
    /// Mean pressure of the first touch; 0 for a level that touches under any load.
    pub mean_pressure: f64,
    /// Estimated error of the mean pressure by the grid and the bisection; `None` where the level has no contact on the coarser grid.
    pub error: Option<f64>,
}

/// Loads of first touch of all levels; `None` for a level hidden behind others.
pub fn first_touches(solver: &mut Solver) -> Vec<Option<FirstTouch>> {
    let beside: Vec<Option<f64>> =
        (1..=solver.problem().levels().len()).map(|level| beside_apex(solver, level)).collect();
    let mut search = TouchSearch::new(solver, beside.len());
    search.attempt(NEGLIGIBLE * search.complete);
    for (level, _) in beside.iter().enumerate().filter(|(_, beside)| beside.is_some()) {
        for grid in 0..GRIDS {
            while let Some(pressure) = search.brackets[grid][level].middle().filter(|_| search.has(grid)) {
                search.attempt(pressure);
            }
        }
    }
    let touch = |level: usize, beside: f64| {
        let fine = search.brackets[0][level];
        let coarser = Some(search.brackets[1][level]).filter(|coarser| coarser.enough.is_some());
        let mean_pressure = fine.pressure();
        let error = coarser.map(|coarser| {
            let change = (coarser.pressure() - mean_pressure).abs();
            let bracket = if fine.least > 0.0 { 0.5 * (fine.most - fine.least) } else { 0.0 };
            let enough = fine.enough.filter(|_| fine.least > 0.0);
            let open = enough.map_or(0.0, |FirstContact { penetration, resolution }| {
                let apex = 2.0 * beside / penetration;
                mean_pressure * apex.max(load_law(resolution.max(1.0)))
            });
            bracket + SAFETY * change.max(open)
        });
        FirstTouch { mean_pressure, error }
    };
    beside.into_iter().enumerate().map(|(level, beside)| Some(touch(level, beside?))).collect()
}

/// Height by which the highest sample of a level (from 1) lies below its apex, a length; `None` for a level hidden behind others.
fn beside_apex(solver: &Solver, level: usize) -> Option<f64> {
    let surface = solver.surface();
    let owned = surface.owners().iter().zip(surface.gaps());
    let below = owned.filter_map(|(&owner, gap)| {
        let site = &surface.sites()[owner as usize];
        (site.level == level).then_some(gap - site.drop)
    });
    below.reduce(f64::min)
}

/// Number of grids: that of the solver and the next coarser one.
const GRIDS: usize = 2;

/// The bracket of a load of first touch.
#[derive(Debug, Clone, Copy)]
struct Bracket {
    /// Mean pressure without contact of the level.
    least: f64,
    /// Mean pressure with contact of the level.
    most: f64,
    /// The contact under the least pressure known to suffice.
    enough: Option<FirstContact>,
}

/// The contact that carries a load when a level begins to touch.
#[derive(Debug, Clone, Copy)]
struct FirstContact {
    /// Penetration, a length.
    penetration: f64,
    /// Samples along the radius of the largest contact.
    resolution: f64,
}

impl Bracket {
    /// The next mean pressure to solve; `None` once the bracket is narrow, or the touch immediate.
    fn middle(&self) -> Option<f64> {
        (self.least > 0.0 && self.most > BRACKET_RATIO * self.least).then(|| (self.least * self.most).sqrt())
    }

    /// Estimate of the mean pressure of first touch.
    fn pressure(&self) -> f64 {
        (self.least * self.most).sqrt()
    }
}

/// The bisection for all levels on both grids.
struct TouchSearch<'a> {
    solver: &'a mut Solver,
    /// Mean pressure of complete contact.
    complete: f64,
    /// Brackets of each grid and each level.
    brackets: [Vec<Bracket>; GRIDS],
    /// Number of grids that were solved on.
    grids: usize,
}

impl<'a> TouchSearch<'a> {
    fn new(solver: &'a mut Solver, levels: usize) -> Self {
        let complete = solver.full_contact_pressure();
        let all = vec![Bracket { least: 0.0, most: complete, enough: None }; levels];
        Self { solver, complete, brackets: [all.clone(), all], grids: 0 }
    }

    fn has(&self, grid: usize) -> bool {
        grid < self.grids
    }

    /// Solves a mean pressure, and narrows the brackets of all levels on all grids.
    fn attempt(&mut self, pressure: f64) {
        let step = self.solver.solve(Load::MeanPressure(pressure));
        let contacts: Vec<&Contact> = std::iter::once(step.finest()).chain(step.coarser()).take(GRIDS).collect();
        self.grids = contacts.len();
        for (brackets, contact) in self.brackets.iter_mut().zip(contacts) {
            let sites = contact.surface().sites();
            let spots = spots(contact, &contact.touching());
            // Samples in contact under all indenters of each level.
            let mut samples = vec![0.0; brackets.len()];
            let mut indenters = vec![0.0; brackets.len()];
            for (site, spot) in sites.iter().zip(&spots) {
                samples[site.level - 1] += spot.counted / contact.grid().sample_area();
                indenters[site.level - 1] += 1.0;
            }
            let radius = |(samples, indenters): (&f64, &f64)| (samples / indenters / PI).sqrt();
            let resolution = samples.iter().zip(&indenters).map(radius).fold(0.0, f64::max);
            let penetration = contact.penetration();
            for (bracket, samples) in brackets.iter_mut().zip(&samples) {
                if *samples == 0.0 {
                    bracket.least = bracket.least.max(pressure);
                } else if pressure <= bracket.most {
                    (bracket.most, bracket.enough) = (pressure, Some(FirstContact { penetration, resolution }));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::Lattice;
    use crate::problem::Problem;
    use crate::reading::Reading;
    use crate::spectral::Settings;

    /// A case like that of Fig. 2, whose loads of first touch `validation/paper/fig2` has.
    #[test]
    fn a_level_carries_load_above_its_first_touch_and_none_below() {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
        let levels = [0.02, 0.01, 0.0].map(level).to_vec();
        let indenters = Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), levels).unwrap();
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let coating = Material::from_shear(2.0 * substrate.shear(), 0.2).unwrap();
        let half_space = HalfSpace::new(vec![Layer::new(coating, 0.5, Interface::Bonded).unwrap()], substrate);
        let problem = Problem::new(indenters, half_space);
        let mut solver = Solver::new(problem, [96, 96], Settings::default()).unwrap();
        let touches = first_touches(&mut solver);
        let pressures: Vec<f64> = touches.iter().map(|touch| touch.unwrap().mean_pressure).collect();
        assert_eq!((pressures[0], touches[0].unwrap().error), (0.0, Some(0.0)));
        for level in [1, 2] {
            let touch = pressures[level];
            let mut load =
                |pressure| Reading::of(solver.solve(Load::MeanPressure(pressure)).finest()).levels[level].load;
            assert!(
                load(touch / BRACKET_RATIO) == 0.0 && load(touch * BRACKET_RATIO) > 0.0,
                "level {}: {touches:?}",
                level + 1
            );
        }
    }
}

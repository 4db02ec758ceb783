//! First touch: the mean pressure at which each level comes into contact.
//!
//! The contact of a level appears at one load and stays, so that bisection on the logarithm of the mean pressure finds
//! it, between a negligible one and that of complete contact.

use super::Reading;
use crate::load::Load;
use crate::spectral::Solver;

/// The pressure of first touch is enclosed within this ratio.
const RATIO: f64 = 1.01;
/// Fraction of the pressure of complete contact below which a touch counts as immediate.
const NEGLIGIBLE: f64 = 1e-9;

/// Mean pressure of first touch of each level, to about 1 %: 0 for the highest, `None` for a level hidden behind
/// others.
///
/// The grid of `solver` limits the accuracy: a contact starts with one sample.
pub fn first_touches(solver: &mut Solver) -> Vec<Option<f64>> {
    let surface = solver.surface();
    let levels = solver.problem().counterbody().levels().len();
    let owns = |level: usize| surface.owners().iter().any(|&owner| surface.sites()[owner as usize].level == level);
    let visible: Vec<bool> = (1..=levels).map(owns).collect();
    let most = solver.full_contact_pressure();
    // Pressures known not to be enough, and known to be enough.
    let mut bounds = vec![(0.0, most); levels];
    let mut try_pressure = |pressure: f64, bounds: &mut Vec<(f64, f64)>| {
        let reading = Reading::of(solver.solve(Load::MeanPressure(pressure)).finest());
        for (bound, level) in bounds.iter_mut().zip(&reading.levels) {
            if level.load > 0.0 {
                bound.1 = bound.1.min(pressure);
            } else {
                bound.0 = bound.0.max(pressure);
            }
        }
    };
    try_pressure(NEGLIGIBLE * most, &mut bounds);
    for level in 0..levels {
        while visible[level] && bounds[level].0 > 0.0 && bounds[level].1 > RATIO * bounds[level].0 {
            let (least, most) = bounds[level];
            try_pressure((least * most).sqrt(), &mut bounds);
        }
    }
    visible
        .into_iter()
        .zip(bounds)
        .map(|(visible, (least, most))| visible.then_some(if least == 0.0 { 0.0 } else { (least * most).sqrt() }))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::Lattice;
    use crate::problem::Problem;
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
        assert_eq!(touches[0], Some(0.0));
        for level in [1, 2] {
            let touch = touches[level].unwrap();
            let mut load =
                |pressure| Reading::of(solver.solve(Load::MeanPressure(pressure)).finest()).levels[level].load;
            assert!(load(touch / RATIO) == 0.0 && load(touch * RATIO) > 0.0, "level {}: {touches:?}", level + 1);
        }
    }
}

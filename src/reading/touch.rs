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

    /// χ = 2, h/l = 0.5, ν 0.2/0.3, R = 0.8 l, steps 0.01 l: levels 2 and 3 touch at p̄/E₂ = 0.00094 and 0.00365
    /// (converged periodic solution of the case of Fig. 2).
    #[test]
    fn levels_of_the_default_case_touch_at_their_loads() {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
        let levels = [0.02, 0.01, 0.0].map(level).to_vec();
        let indenters = Indenters::new(Lattice::hexagonal(1.0, 3).unwrap(), levels).unwrap();
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let coating = Material::from_shear(2.0 * substrate.shear(), 0.2).unwrap();
        let half_space = HalfSpace::new(vec![Layer::new(coating, 0.5, Interface::Bonded).unwrap()], substrate);
        let problem = Problem::new(indenters, half_space);
        let touches = first_touches(&mut Solver::new(problem, [96, 96], Settings::default()).unwrap());
        assert_eq!(touches[0], Some(0.0));
        assert!((touches[1].unwrap() / 0.00094 - 1.0).abs() < 0.02, "{touches:?}");
        assert!((touches[2].unwrap() / 0.00365 - 1.0).abs() < 0.02, "{touches:?}");
    }
}

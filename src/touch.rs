//! First touch: the mean pressure at which each level comes into contact.
//!
//! The contact of a level appears at one load and stays, so that bisection on the logarithm of the mean pressure finds
//! it, between a negligible one and that of complete contact.

use crate::hierarchy::Hierarchy;
use crate::observables::observe;
use crate::solver::Control;

/// The pressure of first touch is enclosed within this ratio.
const RATIO: f64 = 1.01;
/// Fraction of the pressure of complete contact below which a touch counts as immediate.
const NEGLIGIBLE: f64 = 1e-9;

/// Mean pressure of first touch of each level, to about 1 %: 0 for the highest, `None` for a level hidden behind
/// others.
///
/// The grid of `hierarchy` limits the accuracy: a contact starts with one sample.
pub fn first_touches(hierarchy: &mut Hierarchy) -> Vec<Option<f64>> {
    let texture = hierarchy.texture();
    let levels = hierarchy.levels();
    let owns = |level: usize| texture.owner.iter().any(|&owner| texture.sites[owner as usize].level == level);
    let visible: Vec<bool> = (1..=levels).map(owns).collect();
    let most = hierarchy.full_contact_pressure();
    // Pressures known not to be enough, and known to be enough.
    let mut bounds = vec![(0.0, most); levels];
    let mut try_pressure = |pressure: f64, bounds: &mut Vec<(f64, f64)>| {
        let solution = hierarchy.solve(Control::MeanPressure(pressure), &mut |_| ());
        let observables = observe(hierarchy, &solution);
        for (bound, level) in bounds.iter_mut().zip(&observables.levels) {
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
    use crate::indenter::{Level, Shape};
    use crate::lattice::Lattice;
    use crate::material::{HalfSpace, Interface, Layer, Material};
    use crate::solver::Settings;
    use crate::texture::Surface;

    /// χ = 2, h/l = 0.5, ν 0.2/0.3, R = 0.8 l, steps 0.01 l: levels 2 and 3 touch at p̄/E₂ = 0.00094 and 0.00365
    /// (converged periodic solution of the case of Fig. 2).
    #[test]
    fn levels_of_the_default_case_touch_at_their_loads() {
        let level = |height| Level::new(Shape::Paraboloid { radius: 0.8 }, height).unwrap();
        let surface = Surface::Indenters {
            lattice: Lattice::hexagonal(1.0, 3).unwrap(),
            levels: vec![level(0.02), level(0.01), level(0.0)],
        };
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let coating = Material::from_shear(2.0 * substrate.shear(), 0.2).unwrap();
        let half_space = HalfSpace::new(vec![Layer::new(coating, 0.5, Interface::Bonded).unwrap()], substrate);
        let mut hierarchy = Hierarchy::new(&surface, &half_space, [96, 96], Settings::default()).unwrap();
        let touches = first_touches(&mut hierarchy);
        assert_eq!(touches[0], Some(0.0));
        assert!((touches[1].unwrap() / 0.00094 - 1.0).abs() < 0.02, "{touches:?}");
        assert!((touches[2].unwrap() / 0.00365 - 1.0).abs() < 0.02, "{touches:?}");
    }
}

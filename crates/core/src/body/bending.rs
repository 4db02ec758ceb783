//! Distance to which stiff layers on a softer base carry a load sideways.
//!
//! A plate of the bending stiffness D on a half-space of the modulus E* deflects as ŵ = 1/(½E*q + Dq⁴): like the half-space alone below
//! 1/ℓ, ℓ³ = 2D/E*, and with a steeper slope above. Around a force its deflection, its bending and what lifts it off its base have
//! further extremes up to some 4ℓ away. For any stack the steeper slope of the compliance C shows the same: with q₀ the least wavenumber
//! at which d ln C/d ln q falls below −1.5, which is 0.58/ℓ for that plate, the distance is 2.8/q₀.

use super::HalfSpace;

/// Slope of the compliance, both by their logarithms, below which layers bend, and the distance of their last extremes, times the least
/// wavenumber with that slope. A half-space has −1, a plate −4.
const STEEP: [f64; 2] = [-1.5, 2.8];
/// Ratio of neighbouring wavenumbers at which the slope is looked for.
const RATIO: f64 = 1.1;
/// The least wavenumber looked at, times the thickness of all layers: those a billion times as stiff as their base bend at a larger one.
const LEAST: f64 = 1e-4;
/// The largest wavenumber looked at, times the thickness of the thinnest layer.
const MOST: f64 = 10.0;

impl HalfSpace {
    /// Distance from a load beyond which stresses only decay, a length: some five bending lengths of its stiff layers, zero where none
    /// bend.
    pub fn bending_reach(&self) -> f64 {
        let [steep, reach] = STEEP;
        let thicknesses = || self.layers().iter().map(super::Layer::thickness);
        let (all, thinnest): (f64, f64) = (thicknesses().sum(), thicknesses().fold(f64::INFINITY, f64::min));
        let slope = |q: f64| (self.response().compliance(RATIO * q) / self.response().compliance(q)).ln() / RATIO.ln();
        let count = ((MOST * all) / (LEAST * thinnest)).ln() / RATIO.ln();
        let count = if count.is_finite() { count.ceil() as i32 } else { 0 };
        let bends = (0..count).map(|k| LEAST / all * RATIO.powi(k)).find(|&q| slope(q) < steep);
        bends.map_or(0.0, |q| reach / q)
    }
}

#[cfg(test)]
mod tests {
    use crate::body::{HalfSpace, Interface, Layer, Material};

    fn coated(thickness: f64, ratio: f64) -> HalfSpace {
        let layer = Layer::new(Material::from_young(ratio, 0.3).unwrap(), thickness, Interface::Bonded).unwrap();
        HalfSpace::new(vec![layer], Material::from_young(1.0, 0.3).unwrap())
    }

    /// D = E₁h³/(12(1 − ν²)) and E* = 1/(1 − ν²): ℓ = h (E₁/6)^{1/3}, and 2.8/q₀ = 4.8ℓ; a ratio of the wavenumbers off, and what the
    /// base resists beside its deflection.
    #[test]
    fn a_stiff_plate_reaches_some_five_bending_lengths() {
        for (thickness, ratio) in [(0.5, 1e3), (1e-3, 1e3), (1.0, 1e6)] {
            let bending = thickness * (ratio / 6.0f64).cbrt();
            let reach = coated(thickness, ratio).bending_reach() / bending;
            assert!((4.3..5.5).contains(&reach), "{thickness} {ratio}: {reach}");
        }
    }

    #[test]
    fn soft_layers_and_bare_bodies_do_not_bend() {
        assert_eq!(HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()).bending_reach(), 0.0);
        assert_eq!(coated(0.3, 0.01).bending_reach(), 0.0);
        let thin = [0.1, 0.2].map(|h| coated(h, 100.0).bending_reach());
        assert!((thin[1] / thin[0] - 2.0).abs() < 0.1);
    }
}

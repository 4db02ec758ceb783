//! Amplitudes at any depth under a shear traction cos(qξ) across the wavevector.
//!
//! Across the wavevector the body is in antiplane shear, alone: with the amplitudes v of the displacement u_t = v cos (in
//! units of 1/(Gq)) and s of the traction σ_tz = −s cos, going **up** (ζ = −x, x = qz),
//!
//! dv/dζ = s,  ds/dζ = v,
//!
//! and σ_qt = −v sin. In the substrate v = s; a bonded interface passes both on, a spring lets v jump by its slip, and below
//! a frictionless one nothing is left. One bonded layer has the surface displacement
//! (χ + tanh x)/(1 + χ tanh x) · q_T/(G₁q), x = qh. On a rigid base v = 0. Everything is positive:
//! nothing cancels.

use super::interior::SHIELDING;
use super::minors::MAX_EXPONENT;
use super::strata::Strata;
use super::{Depth, Interface};
use crate::numeric::number::Number;

/// Amplitudes at one depth under a shear traction cos(qξ) on the body across the wavevector, in the direction t with
/// (q, t, z) right-handed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Antiplane<N = f64> {
    /// σ_tz, of cos(qξ), over the traction.
    pub stz: N,
    /// σ_qt, of sin(qξ), over the traction.
    pub sqt: N,
    /// u_t across the wavevector, of cos(qξ), a length per pressure.
    pub ut: N,
}

/// v and s; the true ones are these times e^`exponent`.
#[derive(Debug, Clone, Copy)]
struct ShearState<N = f64> {
    v: N,
    s: N,
    exponent: f64,
}

impl<N: Number> ShearState<N> {
    /// The state at a height `x` = q·(distance) ≥ 0 further up in the same material.
    fn raised(self, x: f64) -> Self {
        let x = x.min(MAX_EXPONENT);
        let [cosh, sinh] = [0.5 * (1.0 + (-2.0 * x).exp()), -0.5 * (-2.0 * x).exp_m1()];
        Self { v: self.v * cosh + self.s * sinh, s: self.s * cosh + self.v * sinh, exponent: self.exponent + x }
            .normalised()
    }

    /// The state scaled to v + s = 1, of complex numbers to the size 1.
    fn normalised(self) -> Self {
        let scale = (self.v + self.s).size();
        Self { v: self.v / scale, s: self.s / scale, exponent: self.exponent + scale.ln() }
    }
}

/// The state at the surface. Calls `face` with the state at the upper face of an elastic substrate, then at the lower face of each
/// layer, seen from inside it, from the substrate up.
fn surface_state<N: Number>(strata: &Strata<N>, wavenumber: f64, mut face: impl FnMut(ShearState<N>)) -> ShearState<N> {
    let of = |v: f64, s: f64| ShearState { v: N::from(v), s: N::from(s), exponent: 0.0 };
    let mut below = strata.substrate.as_ref();
    let mut state = match below {
        Some(_) => of(0.5, 0.5),
        None => of(0.0, 1.0),
    };
    if below.is_some() {
        face(state);
    }
    for layer in strata.layers.iter().rev() {
        let ratio = below.map_or(N::from(0.0), |below| layer.material.shear.over(below.shear));
        let [slip, _] = layer.interface.jumps(layer.material.shear * wavenumber);
        state = match layer.interface {
            Interface::Frictionless => of(1.0, 0.0),
            _ => ShearState { v: ratio * state.v + slip * state.s, ..state }.normalised(),
        };
        face(state);
        state = state.raised(wavenumber * layer.thickness);
        below = Some(&layer.material);
    }
    state
}

/// Compliance û_t/q̂_T at the wavenumber q > 0 (1/length): a length per pressure.
pub(super) fn compliance<N: Number>(strata: &Strata<N>, wavenumber: f64) -> N {
    let ShearState { v, s, .. } = surface_state(strata, wavenumber, |_| ());
    v.over(s).over(strata.surface_material().shear * wavenumber)
}

/// Amplitudes at a depth under a shear traction across the wavevector, of the wavenumber q > 0 (1/length). Depths outside
/// their material are brought back to its faces.
///
/// # Panics
/// When there is no such material.
pub(super) fn amplitudes<N: Number>(strata: &Strata<N>, wavenumber: f64, depth: Depth) -> Antiplane<N> {
    let index = depth.material - 1;
    if index == 0 && is_shielded(strata, wavenumber) {
        return shielded(strata, wavenumber, depth.z.max(0.0));
    }
    if strata.layers[..index].iter().any(|layer| layer.interface == Interface::Frictionless) {
        return Antiplane::default();
    }
    let below = (depth.z - strata.layers[..index].iter().fold(0.0, |top, layer| top + layer.thickness)).max(0.0);
    Wave::new(strata, wavenumber).at(index, below)
}

/// Amplitudes at the upper and the lower face of each material under a shear traction across the wavevector, of the wavenumber q > 0
/// (1/length), from one passage through the layers; zero at the infinite depth of a substrate.
pub(super) fn at_faces<N: Number>(strata: &Strata<N>, wavenumber: f64) -> Vec<[Antiplane<N>; 2]> {
    let (wave, mut is_reached) = (Wave::new(strata, wavenumber), true);
    let of = |index: usize| {
        let layer = strata.layers.get(index);
        let faces = match layer.map(|layer| layer.thickness) {
            _ if !is_reached => [Antiplane::default(); 2],
            Some(h) if index == 0 && is_shielded(strata, wavenumber) => {
                [0.0, h].map(|z| shielded(strata, wavenumber, z))
            }
            Some(h) => [0.0, h].map(|below| wave.at(index, below)),
            None => [wave.at(index, 0.0), Antiplane::default()],
        };
        is_reached &= layer.is_none_or(|layer| layer.interface != Interface::Frictionless);
        faces
    };
    (0..strata.materials().count()).map(of).collect()
}

/// Whether a wave does not reach the lower face of the surface material.
fn is_shielded<N: Number>(strata: &Strata<N>, wavenumber: f64) -> bool {
    strata.layers.first().is_none_or(|layer| wavenumber * layer.thickness > SHIELDING)
}

/// Amplitudes at a depth z in a surface material whose lower face the wave does not reach.
fn shielded<N: Number>(strata: &Strata<N>, wavenumber: f64, z: f64) -> Antiplane<N> {
    let decay = (-(wavenumber * z).min(MAX_EXPONENT)).exp();
    let stress = N::from(-decay);
    Antiplane { stz: stress, sqt: stress, ut: N::from(decay).over(strata.surface_material().shear * wavenumber) }
}

/// One wave in all materials that the traction reaches.
struct Wave<'a, N> {
    strata: &'a Strata<N>,
    wavenumber: f64,
    /// The state at the lower face of each layer, from inside it, then at the upper face of an elastic substrate.
    faces: Vec<ShearState<N>>,
    surface: ShearState<N>,
}

impl<'a, N: Number> Wave<'a, N> {
    fn new(strata: &'a Strata<N>, wavenumber: f64) -> Self {
        let mut faces = Vec::with_capacity(strata.layers.len() + 1);
        let surface = surface_state(strata, wavenumber, |state| faces.push(state));
        faces.reverse();
        Self { strata, wavenumber, faces, surface }
    }

    /// Amplitudes at a distance `below` the upper face of a material, from 0; a length.
    fn at(&self, index: usize, below: f64) -> Antiplane<N> {
        let Self { strata, wavenumber, ref faces, surface } = *self;
        let (shear, state) = match strata.layers.get(index) {
            Some(layer) => {
                let thickness = (wavenumber * layer.thickness).min(MAX_EXPONENT);
                let state = faces[index].raised(thickness - (wavenumber * below).min(thickness));
                (layer.material.shear, state)
            }
            None => {
                let state = faces[index];
                let x = (wavenumber * below).min(MAX_EXPONENT);
                let substrate = strata.substrate.as_ref().expect("a rigid base is no material");
                (substrate.shear, ShearState { exponent: state.exponent - x, ..state })
            }
        };
        let scale = N::from((state.exponent - surface.exponent).exp()).over(surface.s);
        Antiplane { stz: -scale * state.s, sqt: -scale * state.v, ut: (scale * state.v).over(shear * wavenumber) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Layer, LayeredResponse, Material};
    use std::sync::Arc;

    fn response(layers: &[(f64, f64, Interface)]) -> Arc<LayeredResponse> {
        let layer = |&(shear, thickness, interface)| {
            Layer::new(Material::from_shear(shear, 0.2).unwrap(), thickness, interface).unwrap()
        };
        let layers = layers.iter().map(layer).collect();
        Arc::clone(HalfSpace::new(layers, Material::from_shear(1.0, 0.3).unwrap()).response())
    }

    #[test]
    fn one_bonded_layer_has_its_closed_form_at_every_depth() {
        for chi in [1e-6f64, 0.3, 1.0, 7.0, 1e6] {
            for q in [1e-7f64, 0.02, 0.7, 3.0, 44.0, 46.0] {
                let response = response(&[(chi, 1.0, Interface::Bonded)]);
                let tanh = q.tanh();
                let surface = (chi + tanh) / (1.0 + chi * tanh) / (chi * q);
                assert!((response.surface(q).across / surface - 1.0).abs() < 1e-14, "χ {chi}, q {q}");
                // v = cosh(q − x) χ + sinh(q − x) over s at the surface.
                let top = q.cosh() + chi * q.sinh();
                for z in [0.0, 0.25, 1.0] {
                    let up = q * (1.0 - z);
                    let Antiplane { stz, sqt, ut } = response.antiplane(q, Depth { z, material: 1 });
                    let (v, s) = (up.cosh() * chi + up.sinh(), up.cosh() + chi * up.sinh());
                    // The part that comes through a thick layer, e^{−45}, is left out.
                    let near = |found: f64, known: f64| (found - known).abs() < 1e-13 * known + 1e-19;
                    assert!(near(-stz, s / top), "χ {chi}, q {q}, z {z}: {stz}, {}", -s / top);
                    assert!(near(-sqt, v / top) && near(ut * chi * q, v / top), "χ {chi}, q {q}, z {z}: {sqt}, {ut}");
                }
                let below = response.antiplane(q, Depth { z: 1.0 + 0.5 / q, material: 2 });
                assert!((below.stz * top + (-0.5f64).exp()).abs() < 1e-13, "χ {chi}, q {q}: {below:?}");
            }
        }
    }

    #[test]
    fn springs_lie_between_bonded_and_frictionless_below_which_there_is_no_stress() {
        let at = |interface| response(&[(2.0, 0.5, interface), (0.1, 0.3, Interface::Bonded)]);
        let spring = |tangential| at(Interface::Spring { tangential, normal: 3.0 }).surface(1.3).across;
        assert_eq!(spring(f64::INFINITY), at(Interface::Bonded).surface(1.3).across);
        let free = at(Interface::Frictionless);
        assert!((spring(1e-13) / free.surface(1.3).across - 1.0).abs() < 1e-11);
        assert!((free.surface(1.3).across * 2.0 * 1.3 * (1.3f64 * 0.5).tanh() - 1.0).abs() < 1e-14);
        assert_eq!(free.antiplane(1.3, Depth { z: 0.6, material: 2 }), Antiplane::default());
        assert!(free.antiplane(1.3, Depth { z: 0.5, material: 1 }).stz.abs() < 1e-16);
    }
}

//! Amplitudes of stress and displacement at any depth of a layered half-space under a pressure or a shear traction along
//! the wavevector.
//!
//! The state y = (U, w, t, p) at a depth lies in the plane of minors of what is below, and satisfies
//! ℓ·y = 0, where ℓ is the functional "shear at the surface" (under a shear traction "pressure at the surface") expressed
//! in the state at that depth. Both together leave one vector, the contraction
//!
//! y_U = −ℓ_w D + ℓ_t B − ℓ_p A,  y_w = ℓ_U D + ℓ_t C − ℓ_p B,  y_t = −ℓ_U B − ℓ_w C − ℓ_p N,  y_p = ℓ_U A + ℓ_w B +
//! ℓ_t N,
//!
//! divided by the surface's N so that p = 1 there (t = −1: σ_qz = −q is the traction q on the body). The functional
//! is carried down through layers and interfaces (`functional`). A frictionless interface transmits p alone: below it ℓ starts
//! afresh, as "shear at the interface".

use super::functional::Functional;
use super::minors::{MAX_EXPONENT, Minors, PlaneStrain};
use super::strata::Strata;
use super::{Depth, Interface};
use crate::numeric::number::Number;

/// qh of a layer from which on it shields what lies below it: e^{−45} of the pressure comes through.
pub(super) const SHIELDING: f64 = 45.0;

/// A surface traction cos(qξ) that deforms the plane of the wavevector and the depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InPlane {
    /// A pressure.
    Normal,
    /// A shear traction on the body along the wavevector.
    Along,
}

impl InPlane {
    /// −1 under a shear traction: a quarter wave further cos(qξ) is −sin(qξ), and sin(qξ) is cos(qξ).
    #[inline(always)]
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Normal => 1.0,
            Self::Along => -1.0,
        }
    }
}

/// Amplitudes at one depth for a surface traction cos(qξ).
///
/// Under a pressure σ_zz, σ_qq, σ_tt and u_z are of cos(qξ), σ_qz and u_q of sin(qξ); under a shear traction along the
/// wavevector those are of sin(qξ) and these of cos(qξ).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitudes<N = f64> {
    /// σ_zz over the traction.
    pub szz: N,
    /// σ_qz over the traction.
    pub sqz: N,
    /// σ_qq along the wavevector, over the traction.
    pub sqq: N,
    /// σ_tt across the wavevector, over the traction.
    pub stt: N,
    /// u_z into the body, a length per pressure.
    pub uz: N,
    /// u_q along the wavevector, a length per pressure.
    pub uq: N,
}

/// One material with the plane and the functional from which the state at any depth of it follows.
#[derive(Debug, Clone)]
struct Stretch<N = f64> {
    /// Depth of the upper face, a length.
    top: f64,
    material: PlaneStrain<N>,
    /// qh, no more than [`MAX_EXPONENT`]; infinite in the substrate.
    thickness: f64,
    /// The plane at the material's lower face (in the substrate: its upper face).
    below: Minors<N>,
    /// The functional at its upper face.
    above: Functional<N>,
}

/// Interior of a layered half-space under a traction of one wavenumber.
#[derive(Debug, Clone)]
pub struct Interior<N = f64> {
    wavenumber: f64,
    traction: InPlane,
    stretches: Vec<Stretch<N>>,
}

impl<N: Number> Interior<N> {
    /// Interior under a traction of the wavenumber q > 0 (1/length).
    pub(super) fn new(strata: &Strata<N>, traction: InPlane, wavenumber: f64) -> Self {
        let Strata { layers, substrate } = strata;
        let mut planes = Vec::with_capacity(layers.len() + 1);
        let surface = strata.surface_minors(wavenumber, |minors| planes.push(minors));
        planes.reverse();

        let mut functional = match traction {
            InPlane::Normal => Functional::shear(&surface),
            InPlane::Along => Functional::pressure(&surface),
        };
        let mut stretches = Vec::with_capacity(planes.len());
        let mut top = 0.0;
        for (k, layer) in layers.iter().enumerate() {
            let stretch = Stretch {
                top,
                material: layer.material,
                thickness: (wavenumber * layer.thickness).min(MAX_EXPONENT),
                below: planes[k],
                above: functional,
            };
            let lower = layers.get(k + 1).map(|next| &next.material).or(substrate.as_ref());
            functional = match (layer.interface, lower) {
                // Nothing is below a rigid base.
                (_, None) => functional,
                (Interface::Frictionless, Some(_)) => {
                    // The plane at the top of what lies below the interface, in the units there.
                    let top = match layers.get(k + 1) {
                        Some(next) => planes[k + 1].raised(&next.material, wavenumber * next.thickness),
                        None => planes[k + 1],
                    };
                    Functional::shear(&top).times(stretch.state(stretch.thickness)[3])
                }
                (interface, Some(lower)) => functional.lowered(&layer.material, stretch.thickness).below(
                    interface,
                    &layer.material,
                    lower,
                    wavenumber,
                ),
            };
            stretches.push(stretch);
            top += layer.thickness;
        }
        stretches.extend(substrate.map(|material| Stretch {
            top,
            material,
            thickness: f64::INFINITY,
            below: planes[planes.len() - 1],
            above: functional,
        }));
        Self { wavenumber, traction, stretches }
    }

    /// q times the thickness of a material, from 0; infinite in the substrate.
    pub(crate) fn thickness(&self, material: usize) -> f64 {
        self.stretches[material].thickness
    }

    /// F and its first three derivatives at `x` = q · (depth below the upper face) in a material, from 0.
    pub(crate) fn derivatives(&self, material: usize, x: f64) -> [N; 4] {
        let stretch = &self.stretches[material];
        let [u, w, t, p] = stretch.state(x);
        let PlaneStrain { poisson, e, r, .. } = stretch.material;
        [p, t, -e * u - r * p, (w * 2.0 + (N::from(2.0) - poisson) * t).over(N::from(1.0) - poisson)]
    }

    /// Amplitudes at a depth below the surface. Depths outside their material are brought back to its faces.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn at(&self, depth: Depth) -> Amplitudes<N> {
        let stretch = &self.stretches[depth.material - 1];
        let below = (depth.z - stretch.top).max(0.0);
        let [u, w, t, p] = stretch.state((self.wavenumber * below).min(stretch.thickness).min(MAX_EXPONENT));
        let PlaneStrain { shear, poisson, e, r, .. } = stretch.material;
        let sign = self.traction.sign();
        let sqq = -e * u - r * p;
        let per_displacement = N::from(1.0).over(shear * self.wavenumber);
        Amplitudes {
            szz: -p * sign,
            sqz: t,
            sqq: sqq * sign,
            stt: poisson * sign * (sqq - p),
            uz: w * sign * per_displacement,
            uq: -u * per_displacement,
        }
    }
}

/// Amplitudes at a depth under a traction of the wavenumber q > 0 (1/length). Under a surface material that shields what lies
/// below it: in closed form, F = (1 + s)e^{−s} under a pressure, F = se^{−s} under a shear traction, s = qz.
pub(super) fn amplitudes<N: Number>(
    strata: &Strata<N>,
    traction: InPlane,
    wavenumber: f64,
    depth: Depth,
) -> Amplitudes<N> {
    if depth.material > 1 || strata.layers.first().is_some_and(|layer| wavenumber * layer.thickness < SHIELDING) {
        return Interior::new(strata, traction, wavenumber).at(depth);
    }
    let PlaneStrain { shear, poisson, .. } = *strata.surface_material();
    let s = (wavenumber * depth.z.max(0.0)).min(MAX_EXPONENT);
    let decay = (-s).exp();
    let per_displacement = N::from(0.5 * decay).over(shear * wavenumber);
    match traction {
        InPlane::Normal => Amplitudes {
            szz: N::from(-(1.0 + s) * decay),
            sqz: N::from(-s * decay),
            sqq: N::from(-(1.0 - s) * decay),
            stt: poisson * -2.0 * decay,
            uz: ((N::from(1.0) - poisson) * 2.0 + N::from(s)) * per_displacement,
            uq: (N::from(s) - (N::from(1.0) - poisson * 2.0)) * per_displacement,
        },
        InPlane::Along => Amplitudes {
            szz: N::from(-s * decay),
            sqz: N::from(-(1.0 - s) * decay),
            sqq: N::from(-(2.0 - s) * decay),
            stt: poisson * -2.0 * decay,
            uz: (N::from(1.0) - poisson * 2.0 + N::from(s)) * per_displacement,
            uq: ((N::from(1.0) - poisson) * 2.0 - N::from(s)) * per_displacement,
        },
    }
}

impl<N: Number> Stretch<N> {
    /// (U, w, t, p) at `x` = q · (depth below the upper face), displacements in units of 1/(Gq).
    fn state(&self, x: f64) -> [N; 4] {
        let functional = self.above.lowered(&self.material, x);
        let plane = if self.thickness.is_finite() {
            self.below.raised(&self.material, self.thickness - x)
        } else {
            Minors { exponent: self.below.exponent - 2.0 * x, ..self.below }
        };
        let Functional { u, w, t, p, .. } = functional;
        let Minors { n, a, b, c, d, .. } = plane;
        let scale = (functional.exponent + plane.exponent).exp();
        [-w * d + t * b - p * a, u * d + t * c - p * b, -u * b - w * c - p * n, u * a + w * b + t * n]
            .map(|y| y * scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Layer, Material};

    #[test]
    fn amplitudes_are_finite_however_thick_the_layer_and_short_the_wave() {
        let coating = Material::from_shear(2.0, 0.2).unwrap();
        for thickness in [1.0, 1e17, 1e155] {
            let layer = Layer::new(coating, thickness, Interface::Bonded).unwrap();
            let half_space = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
            let response = half_space.response();
            for wavenumber in [1.0, 30.0, 1e17, 1e155, 1e300] {
                assert!(response.compliance(wavenumber).is_finite(), "h = {thickness}, q = {wavenumber}");
                let interior = response.interior(InPlane::Normal, wavenumber);
                let depths = [(1, 0.0), (1, 0.9 * thickness), (1, thickness), (2, thickness), (2, 1e200)];
                for (material, z) in depths {
                    let Amplitudes { szz, sqz, sqq, stt, uz, uq } = interior.at(Depth { z, material });
                    let all = [szz, sqz, sqq, stt, uz, uq];
                    assert!(all.iter().all(|x| x.is_finite()), "h = {thickness}, q = {wavenumber}: {all:?}");
                }
            }
        }
    }

    /// σ at any depth of a layer that hides what lies below it, and of a bare half-space.
    #[test]
    fn what_is_hidden_is_left_out() {
        let coating = Material::from_shear(20.0, 0.2).unwrap();
        let layer = Layer::new(coating, 2.0, Interface::Frictionless).unwrap();
        let tractions = [InPlane::Normal, InPlane::Along];
        for (layers, traction) in [vec![], vec![layer]].into_iter().flat_map(|l| tractions.map(|t| (l.clone(), t))) {
            let half_space = HalfSpace::new(layers, Material::from_shear(1.0, 0.3).unwrap());
            let response = half_space.response();
            for (q, z) in [(22.6, 0.0), (22.6, 0.01), (30.0, 0.3), (25.0, 2.0), (1e3, 1.0)] {
                let depth = Depth { z, material: 1 };
                let long = response.interior(traction, q).at(depth);
                let short = response.amplitudes(traction, q, depth);
                for (a, b) in
                    [(short.szz, long.szz), (short.sqz, long.sqz), (short.sqq, long.sqq), (short.stt, long.stt)]
                {
                    assert!((a - b).abs() < 1e-14, "{traction:?}, q = {q}, z = {z}: {short:?} {long:?}");
                }
                assert!((short.uz - long.uz).abs() < 1e-14 && (short.uq - long.uq).abs() < 1e-14);
            }
        }
    }

    /// Near the surface a layer of any thickness beyond reach is the same half-space.
    #[test]
    fn a_layer_thicker_than_any_wave_is_a_half_space() {
        let coating = Material::from_shear(2.0, 0.2).unwrap();
        let at = |thickness: f64| {
            let layer = Layer::new(coating, thickness, Interface::Bonded).unwrap();
            let half_space = HalfSpace::new(vec![layer], Material::from_shear(1.0, 0.3).unwrap());
            half_space.response().interior(InPlane::Normal, 3.0).at(Depth { z: 0.4, material: 1 })
        };
        let (thick, thickest) = (at(100.0), at(1e14));
        assert!((thick.szz / thickest.szz - 1.0).abs() < 1e-12 && (thick.uq / thickest.uq - 1.0).abs() < 1e-12);
    }
}

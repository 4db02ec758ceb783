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
//! divided by the surface's N so that p = 1 there (t = −1: σ_qz = −q is the traction q on the body). Going down a layer, ℓ
//! is multiplied by exp(d𝒜) from the right, where
//! (𝒜²−1)² = 0 gives exp(d𝒜) = cosh d + ½d sinh d (𝒜²−1) + 𝒜 sinh d + ½(d cosh d − sinh d)(𝒜³−𝒜).
//! A frictionless interface transmits p alone: below it ℓ starts afresh, as "shear at the interface".

use super::minors::{EXTINCT, Minors, PlaneStrain};
use super::transfer::TransferFunction;
use super::{Depth, Interface};

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
    pub(super) fn turn(self) -> f64 {
        match self {
            Self::Normal => 1.0,
            Self::Along => -1.0,
        }
    }
}

/// Amplitudes at one depth for a surface traction cos(qξ).
///
/// Under a pressure σ_zz, σ_qq, σ_tt and u_z are of cos(qξ), σ_qz and u_q of sin(qξ); under a shear traction along the
/// wavevector it is the other way round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitudes {
    /// σ_zz over the traction.
    pub szz: f64,
    /// σ_qz over the traction.
    pub sqz: f64,
    /// σ_qq along the wavevector, over the traction.
    pub sqq: f64,
    /// σ_tt across the wavevector, over the traction.
    pub stt: f64,
    /// u_z into the body, a length per pressure.
    pub uz: f64,
    /// u_q along the wavevector, a length per pressure.
    pub uq: f64,
}

/// The functional ℓ(y) = ℓ_U U + ℓ_w w + ℓ_t t + ℓ_p p; the true one is this times e^`exponent`.
#[derive(Debug, Clone, Copy)]
struct Functional {
    u: f64,
    w: f64,
    t: f64,
    p: f64,
    exponent: f64,
}

/// What the evaluation in one material needs.
#[derive(Debug, Clone)]
struct Body {
    /// Depth of the upper face, a length.
    top: f64,
    material: PlaneStrain,
    /// qh, no more than [`EXTINCT`]; infinite in the substrate.
    thickness: f64,
    /// The plane at the body's lower face (in the substrate: its upper face).
    below: Minors,
    /// The functional at its upper face.
    above: Functional,
}

/// Interior of a layered half-space under a traction of one wavenumber.
#[derive(Debug, Clone)]
pub struct Interior {
    wavenumber: f64,
    traction: InPlane,
    bodies: Vec<Body>,
}

impl Interior {
    /// Interior under a pressure of the wavenumber q > 0 (1/length).
    pub fn new(transfer: &TransferFunction, wavenumber: f64) -> Self {
        Self::under(InPlane::Normal, transfer, wavenumber)
    }

    /// Interior under a traction of the wavenumber q > 0 (1/length).
    pub fn under(traction: InPlane, transfer: &TransferFunction, wavenumber: f64) -> Self {
        let substrate = &transfer.substrate;
        let mut planes = Vec::with_capacity(transfer.strata.len() + 1);
        let surface = transfer.surface(wavenumber, |minors| planes.push(minors));
        planes.reverse();

        let mut functional = match traction {
            InPlane::Normal => Functional::shear(&surface),
            InPlane::Along => Functional::pressure(&surface),
        };
        let mut bodies = Vec::with_capacity(planes.len());
        let mut top = 0.0;
        for (k, layer) in transfer.strata.iter().enumerate() {
            let body = Body {
                top,
                material: layer.material,
                thickness: (wavenumber * layer.thickness).min(EXTINCT),
                below: planes[k],
                above: functional,
            };
            let lower = transfer.strata.get(k + 1).map_or(substrate, |next| &next.material);
            functional = match layer.interface {
                Interface::Frictionless => {
                    // The plane at the top of what lies below the interface, in its own units.
                    let top = match transfer.strata.get(k + 1) {
                        Some(next) => planes[k + 1].raised(&next.material, wavenumber * next.thickness),
                        None => planes[k + 1],
                    };
                    Functional::shear(&top).times(body.state(body.thickness)[3])
                }
                interface => functional.lowered(&layer.material, body.thickness).below(
                    interface,
                    &layer.material,
                    lower,
                    wavenumber,
                ),
            };
            bodies.push(body);
            top += layer.thickness;
        }
        bodies.push(Body {
            top,
            material: *substrate,
            thickness: f64::INFINITY,
            below: planes[planes.len() - 1],
            above: functional,
        });
        Self { wavenumber, traction, bodies }
    }

    /// q times the thickness of a material, from 0; infinite in the substrate.
    pub(super) fn thickness(&self, material: usize) -> f64 {
        self.bodies[material].thickness
    }

    /// F and its first three derivatives at `x` = q · (depth below the upper face) in a material, from 0.
    pub(super) fn derivatives(&self, material: usize, x: f64) -> [f64; 4] {
        let body = &self.bodies[material];
        let [u, w, t, p] = body.state(x);
        let PlaneStrain { poisson, e, r, .. } = body.material;
        [p, t, -e * u - r * p, (2.0 * w + (2.0 - poisson) * t) / (1.0 - poisson)]
    }

    /// Amplitudes at a depth below the surface. Depths outside their material are brought back to its faces.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn at(&self, depth: Depth) -> Amplitudes {
        let body = &self.bodies[depth.material - 1];
        let below = (depth.z - body.top).max(0.0);
        let [u, w, t, p] = body.state((self.wavenumber * below).min(body.thickness).min(EXTINCT));
        let PlaneStrain { shear, poisson, e, r, .. } = body.material;
        let turn = self.traction.turn();
        let sqq = -e * u - r * p;
        let per_displacement = 1.0 / (shear * self.wavenumber);
        Amplitudes {
            szz: turn * -p,
            sqz: t,
            sqq: turn * sqq,
            stt: turn * poisson * (sqq - p),
            uz: turn * w * per_displacement,
            uq: -u * per_displacement,
        }
    }
}

/// Layers thicker than this, over 1/q, hide what is below them: e^{−45} of the pressure comes through.
pub(super) const HIDDEN: f64 = 45.0;

impl TransferFunction {
    /// Amplitudes at a depth under a traction of the wavenumber q > 0 (1/length); those of the surface material, where a
    /// layer of it hides what lies below, in closed form: F = (1 + s)e^{−s} under a pressure, F = se^{−s} under a shear
    /// traction, s = qz.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn amplitudes(&self, traction: InPlane, wavenumber: f64, depth: Depth) -> Amplitudes {
        if depth.material > 1 || self.strata.first().is_some_and(|layer| wavenumber * layer.thickness < HIDDEN) {
            return Interior::under(traction, self, wavenumber).at(depth);
        }
        let PlaneStrain { shear, poisson, .. } = *self.surface_material();
        let s = (wavenumber * depth.z.max(0.0)).min(EXTINCT);
        let decay = (-s).exp();
        let per_displacement = 0.5 * decay / (shear * wavenumber);
        match traction {
            InPlane::Normal => Amplitudes {
                szz: -(1.0 + s) * decay,
                sqz: -s * decay,
                sqq: -(1.0 - s) * decay,
                stt: -2.0 * poisson * decay,
                uz: (2.0 * (1.0 - poisson) + s) * per_displacement,
                uq: (s - (1.0 - 2.0 * poisson)) * per_displacement,
            },
            InPlane::Along => Amplitudes {
                szz: -s * decay,
                sqz: -(1.0 - s) * decay,
                sqq: -(2.0 - s) * decay,
                stt: -2.0 * poisson * decay,
                uz: (1.0 - 2.0 * poisson + s) * per_displacement,
                uq: (2.0 * (1.0 - poisson) - s) * per_displacement,
            },
        }
    }
}

impl Body {
    /// (U, w, t, p) at `x` = q · (depth below the upper face), displacements in units of 1/(Gq).
    fn state(&self, x: f64) -> [f64; 4] {
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

impl Functional {
    /// The shear traction at the top of a plane, scaled so that its contraction with the plane has p = 1.
    fn shear(plane: &Minors) -> Self {
        Self { u: 0.0, w: 0.0, t: 1.0 / plane.n, p: 0.0, exponent: -plane.exponent }
    }

    /// The pressure on the top of a plane, scaled so that its contraction with the plane has t = −1.
    fn pressure(plane: &Minors) -> Self {
        Self { u: 0.0, w: 0.0, t: 0.0, p: 1.0 / plane.n, exponent: -plane.exponent }
    }

    fn times(self, factor: f64) -> Self {
        Self { u: factor * self.u, w: factor * self.w, t: factor * self.t, p: factor * self.p, ..self }
    }

    /// ℓ𝒜, the derivative of ℓ on the way down.
    fn slope(&self, &PlaneStrain { e, r, m, .. }: &PlaneStrain) -> Self {
        Self {
            u: e * self.t - r * self.w,
            w: self.u,
            t: self.u - self.p,
            p: m * self.w + r * self.t,
            exponent: self.exponent,
        }
    }

    /// The functional a distance `d` = q·(distance) further down in the same material.
    fn lowered(&self, material: &PlaneStrain, d: f64) -> Self {
        let (cosh, sinh, bending) = hyperbolic_coefficients(d);
        let l1 = self.slope(material);
        let l2 = l1.slope(material);
        let l3 = l2.slope(material);
        let sum = |l0: f64, l1: f64, l2: f64, l3: f64| {
            cosh * l0 + 0.5 * d * sinh * (l2 - l0) + sinh * l1 + 0.5 * bending * (l3 - l1)
        };
        Self {
            u: sum(self.u, l1.u, l2.u, l3.u),
            w: sum(self.w, l1.w, l2.w, l3.w),
            t: sum(self.t, l1.t, l2.t, l3.t),
            p: sum(self.p, l1.p, l2.p, l3.p),
            exponent: self.exponent + d,
        }
    }

    /// The functional just below an interface that carries shear, in the units of the material below.
    fn below(self, interface: Interface, above: &PlaneStrain, below: &PlaneStrain, wavenumber: f64) -> Self {
        let [slip, closure] = interface.jumps(above.shear * wavenumber);
        let ratio = above.shear / below.shear;
        Self {
            u: ratio * self.u,
            w: ratio * self.w,
            t: self.t + slip * self.u,
            p: self.p + closure * self.w,
            exponent: self.exponent,
        }
    }
}

/// e^{−d} times cosh d, sinh d and d cosh d − sinh d.
fn hyperbolic_coefficients(d: f64) -> (f64, f64, f64) {
    let theta = (-2.0 * d).exp();
    let (cosh, sinh) = (0.5 * (1.0 + theta), -0.5 * (-2.0 * d).exp_m1());
    let bending = if d < 1.0 {
        // d cosh d − sinh d = Σ 2j d^{2j+1}/(2j+1)!
        let (mut power, mut sum, mut j) = (d * d * d / 6.0, 0.0, 1.0);
        while 2.0 * j * power > 1e-17 * sum {
            sum += 2.0 * j * power;
            power *= d * d / ((2.0 * j + 2.0) * (2.0 * j + 3.0));
            j += 1.0;
        }
        (-d).exp() * sum
    } else {
        d * cosh - sinh
    };
    (cosh, sinh, bending)
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
            let transfer = TransferFunction::new(&half_space);
            for wavenumber in [1.0, 30.0, 1e17, 1e155, 1e300] {
                assert!(transfer.compliance(wavenumber).is_finite(), "h = {thickness}, q = {wavenumber}");
                let interior = Interior::new(&transfer, wavenumber);
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
            let transfer = TransferFunction::new(&HalfSpace::new(layers, Material::from_shear(1.0, 0.3).unwrap()));
            for (q, z) in [(22.6, 0.0), (22.6, 0.01), (30.0, 0.3), (25.0, 2.0), (1e3, 1.0)] {
                let depth = Depth { z, material: 1 };
                let long = Interior::under(traction, &transfer, q).at(depth);
                let short = transfer.amplitudes(traction, q, depth);
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
            Interior::new(&TransferFunction::new(&half_space), 3.0).at(Depth { z: 0.4, material: 1 })
        };
        let (thick, thickest) = (at(100.0), at(1e14));
        assert!((thick.szz / thickest.szz - 1.0).abs() < 1e-12 && (thick.uq / thickest.uq - 1.0).abs() < 1e-12);
    }
}

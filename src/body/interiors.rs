//! Amplitudes of many wavenumbers at any depth, from a few numbers that are kept of each: a table of a body on a grid.
//!
//! Along x = q·(depth below the upper face of a material) the stress function F of a wave solves (D² − 1)²F = 0, D = d/dx, and
//! all amplitudes follow from F and its first three derivatives:
//!
//! σ_zz = −F,  σ_qz = F′,  σ_qq = F″,  σ_tt = ν(F″ − F),
//! 2Gq u_z = (1−ν)F‴ − (2−ν)F′,  2Gq u_q = (1−ν)F″ + νF
//!
//! (under a shear traction a quarter wave further, which exchanges the signs of σ_zz, σ_qq, σ_tt and u_z). Four numbers tell F
//! in a layer of thickness h, X = qh, x′ = X − x:
//!
//! - X ≥ 1:  F = (a + bx)e^{−x} + (c + dx′)e^{−x′}, where a and b are read off F at the upper face, which the operator (D − 1)²
//!   frees of the other part, c and d off F at the lower face by (D + 1)²;
//! - X < 1:  F = F₀ cosh x + F₁ sinh x + (F₂ − F₀) ½x sinh x + (F₃ − F₁) ½(x cosh x − sinh x), Fᵢ the derivatives at the upper
//!   face: where the layer bends with a large F₃, what it adds to F falls as x³.
//!
//! In the substrate c = d = 0. Nothing cancels: each number errs by the rounding of F beside it. Across the wavevector two
//! numbers are enough, v = αe^{−x} + βe^{−x′}, s = −v′. All are read off the [`Interior`], which is exact and slow. On the surface
//! and at frictionless faces the traction is known, and stands without rounding: F = 1, F′ = 0 under a pressure, F = 0, F′ = −1
//! under a shear traction; F′ = 0.
//!
//! The table holds the longest waves, as many as fit into 16 MiB; the amplitudes of shorter ones are computed by [`Interior`] at
//! every call.

use super::hyperbolic::hyperbolic;
use super::interior::{HIDDEN, Interior};
use super::minors::EXTINCT;
use super::transfer::{Stratum, TransferFunction};
use super::{Amplitudes, Antiplane, Depth, InPlane, Interface};
use rayon::prelude::*;

/// Largest qz of a wave that still counts at the depth z: its stresses are below (2 + qz)e^{−qz} of the traction, 10⁻¹⁶.
pub(crate) const REACH: f64 = 41.0;
/// Bytes of a table at most.
const MOST: usize = 16 << 20;
/// Layers of X below this are thin.
const THIN: f64 = 1.0;

/// Interiors of a layered half-space under tractions of ascending wavenumbers.
#[derive(Debug)]
pub(crate) struct Interiors {
    transfer: TransferFunction,
    /// From the surface down, the substrate last.
    materials: Vec<Inside>,
}

/// What is kept of the waves in a material, by their number.
#[derive(Debug)]
struct Inside {
    /// Depth of the upper face and thickness, lengths; the substrate's is infinite.
    top: f64,
    thickness: f64,
    /// The upper and the lower face.
    faces: [Face; 2],
    shear: f64,
    poisson: f64,
    /// a, b, c, d of F under a pressure, and under a shear traction along the wavevector.
    normal: Vec<[f64; 4]>,
    along: Vec<[f64; 4]>,
    /// α, β.
    across: Vec<[f64; 2]>,
}

/// F and its derivatives.
type Derivatives = [f64; 4];

/// What a face of a material bears.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Face {
    /// The traction itself.
    Surface,
    /// No shear.
    Frictionless,
    /// What the other side passes on.
    Joined,
}

impl Interiors {
    /// Of the ascending `wavenumbers` q > 0 (1/length), under a pressure and, where the counterbody `slides`, under shear
    /// tractions.
    pub fn new(transfer: TransferFunction, wavenumbers: &[f64], slides: bool) -> Self {
        let mut tops = vec![0.0];
        tops.extend(transfer.strata.iter().scan(0.0, |depth, layer| {
            *depth += layer.thickness;
            Some(*depth)
        }));
        let kept = MOST / bytes(tops.len(), slides);
        let count = |material: usize| {
            let reaches = |&q: &f64| match material {
                // Shorter waves do not see that the surface material ends.
                0 => transfer.strata.first().is_some_and(|layer| q * layer.thickness < HIDDEN),
                _ => q * tops[material] <= REACH,
            };
            wavenumbers.partition_point(reaches).min(kept)
        };
        let counts: Vec<usize> = (0..tops.len()).map(count).collect();
        let of = |traction: InPlane| -> Vec<Vec<[f64; 4]>> {
            let most = counts.iter().copied().max().unwrap_or(0);
            let shell = |number: usize| {
                let interior = Interior::under(traction, &transfer, wavenumbers[number]);
                let reached = (0..tops.len()).map(|material| (number < counts[material]).then_some(material));
                reached.map(|material| material.map(|material| interior.kept(material))).collect()
            };
            let shells: Vec<Vec<Option<[f64; 4]>>> = (0..most).into_par_iter().map(shell).collect();
            (0..tops.len()).map(|material| shells.iter().filter_map(|shell| shell[material]).collect()).collect()
        };
        let across = |material: usize| {
            let (top, bottom) = (tops[material], tops.get(material + 1).copied());
            let shell = |&q: &f64| {
                let at = |z: f64| transfer.antiplane(q, Depth { z, material: material + 1 });
                let upper = at(top);
                let lower = bottom.map_or(Antiplane::default(), at);
                [-0.5 * (upper.sqt + upper.stz), -0.5 * (lower.sqt - lower.stz)]
            };
            wavenumbers[..counts[material]].par_iter().map(shell).collect()
        };
        let normal = of(InPlane::Normal);
        let along = if slides { of(InPlane::Along) } else { vec![Vec::new(); tops.len()] };
        let face = |above: &Stratum| match above.interface {
            Interface::Frictionless => Face::Frictionless,
            _ => Face::Joined,
        };
        let inside = |(material, (normal, along)): (usize, (Vec<_>, Vec<_>))| {
            let stratum = transfer.strata.get(material);
            let own = stratum.map_or(&transfer.substrate, |layer| &layer.material);
            Inside {
                top: tops[material],
                thickness: stratum.map_or(f64::INFINITY, |layer| layer.thickness),
                faces: [
                    if material == 0 { Face::Surface } else { face(&transfer.strata[material - 1]) },
                    stratum.map_or(Face::Joined, face),
                ],
                shear: own.shear,
                poisson: own.poisson,
                normal,
                along,
                across: if slides { across(material) } else { Vec::new() },
            }
        };
        let materials = normal.into_iter().zip(along).enumerate().map(inside).collect();
        Self { transfer, materials }
    }

    /// Bytes of the table of a half-space at most, where `count` tells how many wavenumbers there are up to one.
    #[cfg(any(feature = "cli", test))]
    pub fn bytes(half_space: &super::HalfSpace, slides: bool, count: impl Fn(f64) -> usize) -> usize {
        let layers = half_space.layers();
        layers.first().map_or(0, |top| (bytes(layers.len() + 1, slides) * count(HIDDEN / top.thickness())).min(MOST))
    }

    /// Amplitudes at a depth under a pressure or a shear traction along the wavevector, of the first of the `wavenumbers` that
    /// the table was made for.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn amplitudes(&self, traction: InPlane, wavenumbers: &[f64], depth: Depth) -> Vec<Amplitudes> {
        let inside = &self.materials[depth.material - 1];
        let kept = inside.kept(traction);
        let below = (depth.z - inside.top).clamp(0.0, inside.thickness);
        let of = |number: usize| {
            let q = wavenumbers[number];
            let Some(kept) = kept.get(number) else { return self.transfer.amplitudes(traction, q, depth) };
            Amplitudes::of(traction, inside.functions(traction, kept, below, q), inside.elasticity(), q)
        };
        (0..wavenumbers.len()).into_par_iter().with_min_len(FEW).map(of).collect()
    }

    /// F and its first three derivatives by x at a depth, of the first of the `wavenumbers` that the table was made for. The next
    /// derivative is 2F″ − F.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn functions(&self, traction: InPlane, wavenumbers: &[f64], depth: Depth) -> Vec<Derivatives> {
        let inside = &self.materials[depth.material - 1];
        let kept = inside.kept(traction);
        let below = (depth.z - inside.top).clamp(0.0, inside.thickness);
        let of = |number: usize| {
            let q = wavenumbers[number];
            match kept.get(number) {
                Some(kept) => inside.functions(traction, kept, below, q),
                None => self.transfer.amplitudes(traction, q, depth).derivatives(traction, inside.elasticity(), q),
            }
        };
        (0..wavenumbers.len()).into_par_iter().with_min_len(FEW).map(of).collect()
    }

    /// The same under a shear traction across the wavevector.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn antiplane(&self, wavenumbers: &[f64], depth: Depth) -> Vec<Antiplane> {
        let inside = &self.materials[depth.material - 1];
        let below = (depth.z - inside.top).clamp(0.0, inside.thickness);
        let of = |number: usize| {
            let q = wavenumbers[number];
            let Some(&[down, up]) = inside.across.get(number) else { return self.transfer.antiplane(q, depth) };
            let [down, up] = [down * decay(q * below), up * decay(q * (inside.thickness - below))];
            let stz = match inside.face_at(below) {
                Face::Surface => -1.0,
                Face::Frictionless => 0.0,
                Face::Joined => up - down,
            };
            Antiplane { stz, sqt: -(up + down), ut: (up + down) / (inside.shear * q) }
        };
        (0..wavenumbers.len()).into_par_iter().with_min_len(FEW).map(of).collect()
    }
}

impl Inside {
    fn kept(&self, traction: InPlane) -> &[[f64; 4]] {
        match traction {
            InPlane::Normal => &self.normal,
            InPlane::Along => &self.along,
        }
    }

    /// The face at a distance below the upper one; inside the material what is above passes the traction on.
    #[inline(always)]
    fn face_at(&self, below: f64) -> Face {
        match below {
            0.0 => self.faces[0],
            _ if below == self.thickness => self.faces[1],
            _ => Face::Joined,
        }
    }

    /// F and its derivatives at a distance below the upper face, for the wavenumber of which this is `kept`.
    #[inline(always)]
    fn functions(&self, traction: InPlane, kept: &[f64; 4], below: f64, wavenumber: f64) -> Derivatives {
        let [f0, f1, f2, f3] = derivatives(kept, wavenumber * below, wavenumber * self.thickness);
        match (self.face_at(below), traction) {
            (Face::Surface, InPlane::Normal) => [1.0, 0.0, f2, f3],
            (Face::Surface, InPlane::Along) => [0.0, -1.0, f2, f3],
            (Face::Frictionless, _) => [f0, 0.0, f2, f3],
            (Face::Joined, _) => [f0, f1, f2, f3],
        }
    }

    /// G and ν.
    fn elasticity(&self) -> [f64; 2] {
        [self.shear, self.poisson]
    }
}

/// Wavenumbers whose amplitudes are worth a thread of their own.
const FEW: usize = 512;

/// Bytes of a wavenumber in so many materials.
fn bytes(materials: usize, slides: bool) -> usize {
    materials * 8 * if slides { 4 + 4 + 2 } else { 4 }
}

fn decay(x: f64) -> f64 {
    (-x.min(EXTINCT)).exp()
}

impl Interior {
    /// What is kept of F in a material, from 0.
    fn kept(&self, material: usize) -> [f64; 4] {
        let [f0, f1, f2, f3] = self.derivatives(material, 0.0);
        let thickness = self.thickness(material);
        if thickness.is_infinite() {
            return [f0, f0 + f1, 0.0, 0.0];
        }
        if thickness < THIN {
            return [f0, f1, f2 - f0, f3 - f1];
        }
        let [g0, g1, g2, g3] = self.derivatives(material, thickness);
        let (b, d) = (0.25 * (f3 - f2 - f1 + f0), -0.25 * (g3 + g2 - g1 - g0));
        [0.25 * (f2 - 2.0 * f1 + f0) + b, b, 0.25 * (g2 + 2.0 * g1 + g0) + d, d]
    }
}

/// F and its derivatives at x in a layer of thickness X.
#[inline(always)]
fn derivatives(&[a, b, c, d]: &[f64; 4], x: f64, thickness: f64) -> Derivatives {
    if thickness < THIN {
        // cosh, sinh, ½x sinh and ½(x cosh − sinh).
        let [cosh, sinh, rise, bend] = hyperbolic(x);
        return [
            a * cosh + b * sinh + c * rise + d * bend,
            a * sinh + b * cosh + c * (sinh + bend) + d * rise,
            (a + c) * cosh + b * sinh + c * rise + d * (sinh + bend),
            a * sinh + b * cosh + c * (2.0 * sinh + bend) + d * (cosh + rise),
        ];
    }
    let down = decay(x);
    let [a, b] = [a + b * x, b].map(|part| part * down);
    let mut all = [a, b - a, a - 2.0 * b, 3.0 * b - a];
    if (c, d) != (0.0, 0.0) {
        let rest = thickness - x;
        let up = decay(rest);
        let [c, d] = [c + d * rest, d].map(|part| part * up);
        all = [all[0] + c, all[1] + c - d, all[2] + c - 2.0 * d, all[3] + c - 3.0 * d];
    }
    all
}

impl Amplitudes {
    /// By F and its derivatives, G and ν.
    #[inline(always)]
    fn of(traction: InPlane, [f0, f1, f2, f3]: Derivatives, [shear, poisson]: [f64; 2], wavenumber: f64) -> Self {
        let turn = traction.turn();
        let per_displacement = 0.5 / (shear * wavenumber);
        Self {
            szz: turn * -f0,
            sqz: f1,
            sqq: turn * f2,
            stt: turn * poisson * (f2 - f0),
            uz: turn * ((1.0 - poisson) * f3 - (2.0 - poisson) * f1) * per_displacement,
            uq: ((1.0 - poisson) * f2 + poisson * f0) * per_displacement,
        }
    }

    /// F and its derivatives, the inverse of [`Self::of`].
    #[inline(always)]
    fn derivatives(&self, traction: InPlane, [shear, poisson]: [f64; 2], wavenumber: f64) -> Derivatives {
        let turn = traction.turn();
        let w = turn * self.uz * shear * wavenumber;
        [-turn * self.szz, self.sqz, turn * self.sqq, (2.0 * w + (2.0 - poisson) * self.sqz) / (1.0 - poisson)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Layer, Material};

    /// Bodies whose layers are stiff and soft, thin and thick, and carry shear or none.
    fn bodies() -> impl Iterator<Item = HalfSpace> {
        let material = |shear, poisson| Material::from_shear(shear, poisson).unwrap();
        let spring = Interface::Spring { tangential: 0.3, normal: 40.0 };
        let interfaces = [Interface::Bonded, Interface::Frictionless, spring];
        let moduli = [(1e-3, 0.5), (0.05, 0.45), (3.0, 0.0), (1e3, 0.3)];
        let all = interfaces.into_iter().flat_map(move |interface| moduli.map(|of| (interface, of)));
        all.map(move |(interface, (chi, poisson))| {
            let top = Layer::new(material(chi, poisson), 0.3, interface).unwrap();
            let under = Layer::new(material(2.0, 0.1), 0.02, Interface::Bonded).unwrap();
            HalfSpace::new(vec![top, under], material(1.0, 0.3))
        })
    }

    const WAVENUMBERS: [f64; 8] = [1e-3, 0.1, 1.0, 3.2, 3.4, 20.0, 49.0, 120.0];

    /// At both faces of each material and between them, against the plane and the functional that meet there.
    #[test]
    fn what_is_kept_tells_the_amplitudes_at_any_depth() {
        for half_space in bodies() {
            let transfer = TransferFunction::new(&half_space);
            let interiors = Interiors::new(transfer.clone(), &WAVENUMBERS, true);
            for (material, z) in [(1, 0.0), (1, 0.11), (1, 0.3), (2, 0.3), (2, 0.307), (2, 0.32), (3, 0.32), (3, 0.9)] {
                let depth = Depth { z, material };
                for traction in [InPlane::Normal, InPlane::Along] {
                    let found = interiors.amplitudes(traction, &WAVENUMBERS, depth);
                    let elasticity = interiors.materials[material - 1].elasticity();
                    for (k, functions) in interiors.functions(traction, &WAVENUMBERS, depth).iter().enumerate() {
                        let back = found[k].derivatives(traction, elasticity, WAVENUMBERS[k]);
                        let scale = functions.iter().fold(1e-6f64, |a, f| a.max(f.abs()));
                        assert!(back.iter().zip(functions).all(|(a, b)| (a - b).abs() < 1e-12 * scale), "{back:?}");
                    }
                    for (found, q) in found.iter().zip(WAVENUMBERS) {
                        let exact = Interior::under(traction, &transfer, q).at(depth);
                        // What faces do not bear is exactly nothing.
                        assert!(z > 0.0 || traction == InPlane::Along || (found.sqz, found.szz) == (0.0, -1.0));
                        assert!(z > 0.0 || traction == InPlane::Normal || (found.sqz, found.szz.abs()) == (-1.0, 0.0));
                        let slides = z == 0.3 && half_space.layers()[0].interface() == Interface::Frictionless;
                        assert!(!slides || found.sqz == 0.0);
                        let scale =
                            [exact.szz, exact.sqz, exact.sqq, exact.stt].iter().fold(1e-6f64, |a, s| a.max(s.abs()));
                        for (found, exact) in [
                            (found.szz, exact.szz),
                            (found.sqz, exact.sqz),
                            (found.sqq, exact.sqq),
                            (found.stt, exact.stt),
                        ] {
                            assert!(
                                (found - exact).abs() < 1e-11 * scale,
                                "{half_space}, q {q}, {depth:?}: {found}, {exact}"
                            );
                        }
                        let size = exact.uz.abs().max(exact.uq.abs()).max(1e-6);
                        assert!(
                            (found.uz - exact.uz).abs() < 1e-11 * size && (found.uq - exact.uq).abs() < 1e-11 * size
                        );
                    }
                }
                for (found, q) in interiors.antiplane(&WAVENUMBERS, depth).iter().zip(WAVENUMBERS) {
                    let exact = transfer.antiplane(q, depth);
                    let scale = exact.stz.abs().max(exact.sqt.abs()).max(1e-6);
                    assert!(
                        (found.stz - exact.stz).abs() < 1e-11 * scale && (found.sqt - exact.sqt).abs() < 1e-11 * scale
                    );
                    assert!((found.ut - exact.ut).abs() < 1e-11 * exact.ut.abs().max(1e-6));
                }
            }
        }
    }

    /// Waves beyond what a table holds, on a half-space without layers all of them, are computed one by one.
    #[test]
    fn what_is_not_kept_is_computed() {
        let bare = TransferFunction::new(&HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap()));
        let interiors = Interiors::new(bare.clone(), &WAVENUMBERS, false);
        let depth = Depth { z: 0.2, material: 1 };
        let found = interiors.amplitudes(InPlane::Normal, &WAVENUMBERS, depth);
        assert!(found.iter().zip(WAVENUMBERS).all(|(own, q)| *own == bare.amplitudes(InPlane::Normal, q, depth)));
        let body = bodies().next().unwrap();
        let uncoated = HalfSpace::new(vec![], body.substrate());
        assert_eq!((Interiors::bytes(&uncoated, true, |_| 9), Interiors::bytes(&body, true, |_| 1 << 40)), (0, MOST));
        assert_eq!(Interiors::bytes(&body, false, |q| q as usize), 150 * 96);
        let layered = TransferFunction::new(&body);
        let many: Vec<f64> = (1..=MOST / 96 + 10).map(|k| 1e-4 * k as f64).collect();
        let interiors = Interiors::new(layered.clone(), &many, false);
        assert_eq!(interiors.materials[0].normal.len(), MOST / 96);
        let found = interiors.amplitudes(InPlane::Normal, &many, depth);
        let [last, beyond] = [MOST / 96 - 1, MOST / 96 + 5];
        let exact = [last, beyond].map(|k| layered.amplitudes(InPlane::Normal, many[k], depth));
        assert!((found[last].szz - exact[0].szz).abs() < 1e-12 && found[beyond] == exact[1]);
    }
}

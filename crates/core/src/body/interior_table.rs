//! Amplitudes of many wavenumbers at any depth, from a table of a few coefficients for each.
//!
//! In each material a wave has the coefficients of its stress function (`stress_function`).
//!
//! The table holds the longest waves, as many as fit into 16 MiB; the amplitudes of shorter ones are computed from the
//! layers at every call.

use super::across::at_faces;
use super::interior::SHIELDING;
use super::minors::PlaneStrain;
use super::strata::{Strata, Stratum};
use super::stress_function::{Derivatives, amplitudes_of, coefficients, decay, derivatives, derivatives_of};
use super::{Amplitudes, Antiplane, Depth, InPlane, Interface, LayeredResponse};
use crate::numeric::number::Number;
use crate::numeric::parallel;
use std::sync::Arc;

/// Largest qz of a wave that still counts at the depth z: its stresses are below (2 + qz)e^{−qz} of the traction, 5·10⁻¹³.
pub const REACH: f64 = 32.0;
/// Largest table, bytes.
const MAX_BYTES: usize = 16 << 20;
/// Fewest wavenumbers of a parallel task.
const MIN_PARALLEL: usize = 512;

/// Table of the interior of a layered half-space under tractions of ascending wavenumbers.
#[derive(Debug)]
pub struct InteriorTable {
    response: Arc<LayeredResponse>,
    /// Materials from the surface down, an elastic substrate last.
    materials: Vec<MaterialTable>,
}

/// Coefficients of the waves in one material, by the number of the wavenumber.
#[derive(Debug)]
struct MaterialTable {
    extent: Extent,
    shear: f64,
    poisson: f64,
    /// a, b, c, d of F under a pressure, and under a shear traction along the wavevector.
    normal: Vec<[f64; 4]>,
    along: Vec<[f64; 4]>,
    /// α, β of v under a shear traction across the wavevector.
    across: Vec<[f64; 2]>,
}

/// Where a material lies, and what its faces transmit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Depth of the upper face and thickness, lengths; the substrate's is infinite.
    pub top: f64,
    pub thickness: f64,
    /// The upper and the lower face.
    faces: [Face; 2],
}

/// Traction that a face of a material transmits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Face {
    /// The traction of the surface.
    Surface,
    /// No shear.
    Frictionless,
    /// Any traction.
    Joined,
}

impl InteriorTable {
    /// Table for the ascending `wavenumbers` q > 0 (1/length), under a pressure and, where the counterbody `slides`, under
    /// shear tractions.
    pub fn new(response: Arc<LayeredResponse>, wavenumbers: &[f64], slides: bool) -> Self {
        let strata = response.strata();
        let (tops, reached) = reached(strata, wavenumbers);
        let most = MAX_BYTES / bytes(tops.len(), slides);
        let counts: Vec<usize> = reached.into_iter().map(|count| count.min(most)).collect();
        let normal = in_plane(&response, InPlane::Normal, wavenumbers, &counts);
        let along = if slides {
            in_plane(&response, InPlane::Along, wavenumbers, &counts)
        } else {
            vec![Vec::new(); tops.len()]
        };
        let across = if slides { across(&response, wavenumbers, &counts) } else { vec![Vec::new(); tops.len()] };
        let parts = normal.into_iter().zip(along).zip(across).enumerate();
        let table = |(material, ((normal, along), across)): (usize, ((Vec<_>, Vec<_>), Vec<_>))| {
            MaterialTable::new(strata, material, tops[material], normal, along, across)
        };
        let materials = parts.map(table).collect();
        Self { response, materials }
    }

    /// Bytes of the table of a half-space at most, with `count(q)` wavenumbers up to q.
    pub fn bytes(half_space: &super::HalfSpace, slides: bool, count: impl Fn(f64) -> usize) -> usize {
        let layers = half_space.layers();
        layers.first().map_or(0, |top| {
            (bytes(half_space.material_count(), slides) * count(SHIELDING / top.thickness())).min(MAX_BYTES)
        })
    }

    /// Amplitudes at a depth under a pressure or a shear traction along the wavevector, of the first of the `wavenumbers` that
    /// the table was made for.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn amplitudes(&self, traction: InPlane, wavenumbers: &[f64], depth: Depth) -> Vec<Amplitudes> {
        let material = &self.materials[depth.material - 1];
        let coefficients = material.coefficients(traction);
        let below = material.extent.below(depth);
        let of = |number: usize| {
            let q = wavenumbers[number];
            let Some(row) = coefficients.get(number) else { return self.response.amplitudes(traction, q, depth) };
            amplitudes_of(traction, material.extent.functions(traction, row, below, q), material.elasticity(), q)
        };
        parallel::map_by(MIN_PARALLEL, wavenumbers.len(), of)
    }

    /// F and its first three derivatives by x at a depth, of the first of the `wavenumbers` that the table was made for. The next
    /// derivative is 2F″ − F.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn functions(&self, traction: InPlane, wavenumbers: &[f64], depth: Depth) -> Vec<Derivatives> {
        let material = &self.materials[depth.material - 1];
        let coefficients = material.coefficients(traction);
        let below = material.extent.below(depth);
        let of = |number: usize| {
            let q = wavenumbers[number];
            match coefficients.get(number) {
                Some(row) => material.extent.functions(traction, row, below, q),
                None => {
                    derivatives_of(&self.response.amplitudes(traction, q, depth), traction, material.elasticity(), q)
                }
            }
        };
        parallel::map_by(MIN_PARALLEL, wavenumbers.len(), of)
    }

    /// Amplitudes at a depth under a shear traction across the wavevector, of the first of the `wavenumbers` that the table was
    /// made for.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn antiplane(&self, wavenumbers: &[f64], depth: Depth) -> Vec<Antiplane> {
        let material = &self.materials[depth.material - 1];
        let below = material.extent.below(depth);
        let of = |number: usize| {
            let q = wavenumbers[number];
            let Some(&[down, up]) = material.across.get(number) else { return self.response.antiplane(q, depth) };
            let [down, up] = [down * decay(q * below), up * decay(q * (material.extent.thickness - below))];
            material.extent.antiplane([down, up], below, material.shear * q)
        };
        parallel::map_by(MIN_PARALLEL, wavenumbers.len(), of)
    }
}

/// Depths of the upper faces of all materials, lengths, and how many of the ascending `wavenumbers` count there.
pub(super) fn reached<N: Number>(strata: &Strata<N>, wavenumbers: &[f64]) -> (Vec<f64>, Vec<usize>) {
    let mut tops = vec![0.0];
    tops.extend(strata.layers.iter().scan(0.0, |depth, layer| {
        *depth += layer.thickness;
        Some(*depth)
    }));
    tops.truncate(strata.materials().count());
    let count = |material: usize| {
        let reaches = |&q: &f64| match material {
            // Shorter waves do not reach the lower face of the surface material.
            0 => strata.layers.first().is_some_and(|layer| q * layer.thickness < SHIELDING),
            _ => q * tops[material] <= REACH,
        };
        wavenumbers.partition_point(reaches)
    };
    let counts = (0..tops.len()).map(count).collect();
    (tops, counts)
}

/// a, b, c, d of F under a traction in each material, of as many of the `wavenumbers` as `counts` has for it.
fn in_plane(
    response: &LayeredResponse,
    traction: InPlane,
    wavenumbers: &[f64],
    counts: &[usize],
) -> Vec<Vec<[f64; 4]>> {
    let most = counts.iter().copied().max().unwrap_or(0);
    let of_wave = |number: usize| {
        let interior = response.interior(traction, wavenumbers[number]);
        let reached = counts.iter().enumerate().map(|(material, &count)| (number < count).then_some(material));
        reached.map(|material| material.map(|material| coefficients(&interior, material))).collect()
    };
    let waves: Vec<Vec<Option<[f64; 4]>>> = parallel::map(most, of_wave);
    (0..counts.len()).map(|material| waves.iter().filter_map(|wave| wave[material]).collect()).collect()
}

/// α, β of v in each material, of as many of the `wavenumbers` as `counts` has for it.
fn across(response: &LayeredResponse, wavenumbers: &[f64], counts: &[usize]) -> Vec<Vec<[f64; 2]>> {
    let most = counts.iter().copied().max().unwrap_or(0);
    let faces: Vec<Vec<[Antiplane; 2]>> =
        parallel::map_items(&wavenumbers[..most], |&q| at_faces(response.strata(), q));
    let of = |[upper, lower]: [Antiplane; 2]| [-0.5 * (upper.sqt + upper.stz), -0.5 * (lower.sqt - lower.stz)];
    let table = |(material, &count): (usize, &usize)| faces[..count].iter().map(|wave| of(wave[material])).collect();
    counts.iter().enumerate().map(table).collect()
}

impl Extent {
    /// Extent of a material, from 0, whose upper face lies at a depth, a length.
    pub fn new<N: Number>(strata: &Strata<N>, material: usize, top: f64) -> Self {
        let face = |above: &Stratum<N>| match above.interface {
            Interface::Frictionless => Face::Frictionless,
            _ => Face::Joined,
        };
        let layer = strata.layers.get(material);
        Self {
            top,
            thickness: layer.map_or(f64::INFINITY, |layer| layer.thickness),
            faces: [
                if material == 0 { Face::Surface } else { face(&strata.layers[material - 1]) },
                layer.map_or(Face::Joined, face),
            ],
        }
    }

    /// Distance of a depth below the upper face, a length.
    pub fn below(&self, depth: Depth) -> f64 {
        (depth.z - self.top).clamp(0.0, self.thickness)
    }

    /// The face at a distance below the upper one; a depth inside the material is joined to what is above it.
    #[inline(always)]
    fn face_at(&self, below: f64) -> Face {
        match below {
            0.0 => self.faces[0],
            _ if below == self.thickness => self.faces[1],
            _ => Face::Joined,
        }
    }

    /// F and its derivatives at a distance below the upper face, from the coefficients of the wavenumber.
    #[inline(always)]
    pub fn functions<N: Number>(
        &self,
        traction: InPlane,
        coefficients: &[N; 4],
        below: f64,
        wavenumber: f64,
    ) -> Derivatives<N> {
        let [f0, f1, f2, f3] = derivatives(coefficients, wavenumber * below, wavenumber * self.thickness);
        let of = |x: f64| N::from(x);
        match (self.face_at(below), traction) {
            (Face::Surface, InPlane::Normal) => [of(1.0), of(0.0), f2, f3],
            (Face::Surface, InPlane::Along) => [of(0.0), of(-1.0), f2, f3],
            (Face::Frictionless, _) => [f0, of(0.0), f2, f3],
            (Face::Joined, _) => [f0, f1, f2, f3],
        }
    }

    /// Amplitudes under a traction across the wavevector at a distance below the upper face, from the parts of v that go down and up there,
    /// with Gq.
    #[inline(always)]
    pub fn antiplane<N: Number>(&self, [down, up]: [N; 2], below: f64, stiffness: N) -> Antiplane<N> {
        let stz = match self.face_at(below) {
            Face::Surface => N::from(-1.0),
            Face::Frictionless => N::from(0.0),
            Face::Joined => up - down,
        };
        Antiplane { stz, sqt: -(up + down), ut: (up + down).over(stiffness) }
    }
}

impl MaterialTable {
    fn new(
        strata: &Strata,
        material: usize,
        top: f64,
        normal: Vec<[f64; 4]>,
        along: Vec<[f64; 4]>,
        across: Vec<[f64; 2]>,
    ) -> Self {
        let PlaneStrain { shear, poisson, .. } = *strata.materials().nth(material).expect("a material of the body");
        Self { extent: Extent::new(strata, material, top), shear, poisson, normal, along, across }
    }

    fn coefficients(&self, traction: InPlane) -> &[[f64; 4]] {
        match traction {
            InPlane::Normal => &self.normal,
            InPlane::Along => &self.along,
        }
    }

    /// G and ν.
    fn elasticity(&self) -> [f64; 2] {
        [self.shear, self.poisson]
    }
}

/// Bytes of the coefficients of a wavenumber in all materials.
fn bytes(materials: usize, slides: bool) -> usize {
    materials * 8 * if slides { 4 + 4 + 2 } else { 4 }
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
    fn coefficients_give_the_amplitudes_at_any_depth() {
        for half_space in bodies() {
            let response = half_space.response();
            let table = InteriorTable::new(Arc::clone(response), &WAVENUMBERS, true);
            for (material, z) in [(1, 0.0), (1, 0.11), (1, 0.3), (2, 0.3), (2, 0.307), (2, 0.32), (3, 0.32), (3, 0.9)] {
                let depth = Depth { z, material };
                for traction in [InPlane::Normal, InPlane::Along] {
                    let found = table.amplitudes(traction, &WAVENUMBERS, depth);
                    let elasticity = table.materials[material - 1].elasticity();
                    for (k, functions) in table.functions(traction, &WAVENUMBERS, depth).iter().enumerate() {
                        let back = derivatives_of(&found[k], traction, elasticity, WAVENUMBERS[k]);
                        let scale = functions.iter().fold(1e-6f64, |a, f| a.max(f.abs()));
                        assert!(back.iter().zip(functions).all(|(a, b)| (a - b).abs() < 1e-12 * scale), "{back:?}");
                    }
                    for (found, q) in found.iter().zip(WAVENUMBERS) {
                        let exact = response.interior(traction, q).at(depth);
                        // A traction that a face does not transmit is exactly zero.
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
                for (found, q) in table.antiplane(&WAVENUMBERS, depth).iter().zip(WAVENUMBERS) {
                    let exact = response.antiplane(q, depth);
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
    fn waves_beyond_the_table_are_computed() {
        let bare = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
        let bare = bare.response();
        let table = InteriorTable::new(Arc::clone(bare), &WAVENUMBERS, false);
        let depth = Depth { z: 0.2, material: 1 };
        let found = table.amplitudes(InPlane::Normal, &WAVENUMBERS, depth);
        assert!(
            found
                .iter()
                .zip(WAVENUMBERS)
                .all(|(amplitudes, q)| *amplitudes == bare.amplitudes(InPlane::Normal, q, depth))
        );
        let body = bodies().next().unwrap();
        let uncoated = HalfSpace::new(vec![], body.material(3));
        assert_eq!(
            (InteriorTable::bytes(&uncoated, true, |_| 9), InteriorTable::bytes(&body, true, |_| 1 << 40)),
            (0, MAX_BYTES)
        );
        assert_eq!(InteriorTable::bytes(&body, false, |q| q as usize), 150 * 96);
        let layered = body.response();
        let many: Vec<f64> = (1..=MAX_BYTES / 96 + 10).map(|k| 1e-4 * k as f64).collect();
        let table = InteriorTable::new(Arc::clone(layered), &many, false);
        assert_eq!(table.materials[0].normal.len(), MAX_BYTES / 96);
        let found = table.amplitudes(InPlane::Normal, &many, depth);
        let [last, beyond] = [MAX_BYTES / 96 - 1, MAX_BYTES / 96 + 5];
        let exact = [last, beyond].map(|k| layered.amplitudes(InPlane::Normal, many[k], depth));
        assert!((found[last].szz - exact[0].szz).abs() < 1e-12 && found[beyond] == exact[1]);
    }
}

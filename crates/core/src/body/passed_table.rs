//! Amplitudes at any depth of a body that a load passes steadily, of many waves.
//!
//! A wave e^{i**k**·**x**} of the load has in the material the frequency ω = −**k**·**v**, and its amplitudes are complex: what their imaginary
//! parts say lags behind. The wave −**k** has the conjugate amplitudes. In each material a wave has complex coefficients of its stress
//! function, see [`InteriorTable`](super::InteriorTable): exponents are real, as wavenumbers are.

use super::across::at_faces;
use super::interior_table::{Extent, reached};
use super::stress_function::{amplitudes_of, coefficients, decay};
use super::{Amplitudes, Antiplane, Depth, HalfSpace, InPlane, Material};
use crate::numeric::parallel;
use rustfft::num_complex::Complex64;

/// Fewest waves of a parallel task.
const MIN_PARALLEL: usize = 512;

/// Table of the interior of a body that a load passes.
#[derive(Debug)]
pub struct PassedTable {
    body: HalfSpace,
    /// Wavenumber and frequency of each wave, in ascending wavenumbers.
    waves: Vec<[f64; 2]>,
    materials: Vec<PassedMaterial>,
}

/// Coefficients of the waves in one material.
#[derive(Debug)]
struct PassedMaterial {
    material: Material,
    extent: Extent,
    normal: Vec<[Complex64; 4]>,
    along: Vec<[Complex64; 4]>,
    across: Vec<[Complex64; 2]>,
}

impl PassedTable {
    /// Table of the waves with these `wavenumbers`, ascending, and components `along` the motion, 1/length, below a load of this speed; with
    /// shear tractions where it `slides`.
    pub(crate) fn new(body: &HalfSpace, wavenumbers: &[f64], along: &[f64], (speed, slides): (f64, bool)) -> Self {
        let waves: Vec<[f64; 2]> = wavenumbers.iter().zip(along).map(|(&q, along)| [q, -speed * along]).collect();
        let (tops, counts) = reached(body.response().strata(), wavenumbers);
        let tables = |material: usize| PassedMaterial {
            material: body.material(material + 1),
            extent: Extent::new(body.response().strata(), material, tops[material]),
            normal: Vec::with_capacity(counts[material]),
            along: Vec::new(),
            across: Vec::new(),
        };
        let mut materials: Vec<PassedMaterial> = (0..tops.len()).map(tables).collect();
        let most = counts.iter().copied().max().unwrap_or(0);
        let of_wave = |number: usize| {
            let [q, frequency] = waves[number];
            let response = body.response_at(Complex64::new(0.0, frequency));
            let of = |traction| {
                let interior = response.interior(traction, q);
                let reaches = |(_, count): &(usize, &usize)| number < **count;
                let reached = counts.iter().enumerate().filter(reaches);
                reached.map(|(material, _)| (material, coefficients(&interior, material))).collect::<Vec<_>>()
            };
            let (normal, along) = (of(InPlane::Normal), if slides { of(InPlane::Along) } else { Vec::new() });
            let across = if slides { at_faces(response.strata(), q) } else { Vec::new() };
            (normal, along, across)
        };
        for (number, (normal, along, across)) in parallel::map(most, of_wave).into_iter().enumerate() {
            normal.into_iter().for_each(|(material, row)| materials[material].normal.push(row));
            along.into_iter().for_each(|(material, row)| materials[material].along.push(row));
            for ((material, [upper, lower]), &count) in materials.iter_mut().zip(across).zip(&counts) {
                if number < count {
                    let [down, up] = [upper.sqt + upper.stz, lower.sqt - lower.stz].map(|sum| sum * -0.5);
                    material.across.push([down, up]);
                }
            }
        }
        Self { body: body.clone(), waves, materials }
    }

    /// Amplitudes at a depth under a pressure or a shear traction along the wavevector, of the first `count` waves.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn amplitudes(&self, traction: InPlane, count: usize, depth: Depth) -> Vec<Amplitudes<Complex64>> {
        let table = &self.materials[depth.material - 1];
        let coefficients = if traction == InPlane::Normal { &table.normal } else { &table.along };
        let below = table.extent.below(depth);
        let of = |number: usize| {
            let [q, frequency] = self.waves[number];
            let s = Complex64::new(0.0, frequency);
            let Some(row) = coefficients.get(number) else {
                return self.body.response_at(s).amplitudes(traction, q, depth);
            };
            let moduli = table.material.moduli_at(s);
            amplitudes_of(traction, table.extent.functions(traction, row, below, q), [moduli.shear, moduli.poisson], q)
        };
        parallel::map_by(MIN_PARALLEL, count, of)
    }

    /// Turns amplitudes of [`Self::amplitudes`] into those of stresses that have the same strains by Hooke's law of the relaxed moduli.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn hookean(&self, amplitudes: &mut [Amplitudes<Complex64>], depth: Depth) {
        for (amplitudes, [shear, bulk]) in amplitudes.iter_mut().zip(self.relaxed_over(depth)) {
            let Amplitudes { szz, sqz, sqq, stt, .. } = amplitudes;
            let mean = (*szz + *sqq + *stt) / 3.0;
            for normal in [szz, sqq, stt] {
                *normal = (*normal - mean) * shear + mean * bulk;
            }
            *sqz *= shear;
        }
    }

    /// Turns amplitudes of [`Self::antiplane`] as [`Self::hookean`] does.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn hookean_across(&self, amplitudes: &mut [Antiplane<Complex64>], depth: Depth) {
        for (amplitudes, [shear, _]) in amplitudes.iter_mut().zip(self.relaxed_over(depth)) {
            amplitudes.stz *= shear;
            amplitudes.sqt *= shear;
        }
    }

    /// G₀/G and K₀/K of each wave in the material of a depth.
    fn relaxed_over(&self, depth: Depth) -> impl Iterator<Item = [Complex64; 2]> + '_ {
        let material = self.materials[depth.material - 1].material;
        self.waves.iter().map(move |[_, frequency]| material.relaxed_over(Complex64::new(0.0, *frequency)))
    }

    /// Amplitudes at a depth under a shear traction across the wavevector, of the first `count` waves.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn antiplane(&self, count: usize, depth: Depth) -> Vec<Antiplane<Complex64>> {
        let table = &self.materials[depth.material - 1];
        let below = table.extent.below(depth);
        let of = |number: usize| {
            let [q, frequency] = self.waves[number];
            let s = Complex64::new(0.0, frequency);
            let Some(&[down, up]) = table.across.get(number) else {
                return self.body.response_at(s).antiplane(q, depth);
            };
            let parts = [down * decay(q * below), up * decay(q * (table.extent.thickness - below))];
            table.extent.antiplane(parts, below, table.material.moduli_at(s).shear * q)
        };
        parallel::map_by(MIN_PARALLEL, count, of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Relaxation};

    /// At both faces of each material and between them, against the plane and the functional of the complex moduli that meet there.
    #[test]
    fn coefficients_give_the_amplitudes_at_any_depth() {
        let relaxation = Relaxation::new(&[5.0, 20.0], &[1.0, 0.03]).unwrap();
        let material = |shear, poisson| Material::from_shear(shear, poisson).unwrap();
        let spring = Interface::Spring { tangential: 0.3, normal: 40.0 };
        for interface in [Interface::Bonded, Interface::Frictionless, spring] {
            let rubber = material(0.7, 0.45).with_relaxation(Some(relaxation));
            let top = Layer::new(rubber, 0.3, interface).unwrap();
            let under = Layer::new(material(200.0, 0.1), 0.02, Interface::Bonded).unwrap();
            let body = HalfSpace::new(vec![top, under], material(1.0, 0.3).with_relaxation(Some(relaxation)));
            let (wavenumbers, along) = ([1e-2, 1.0, 1.0, 3.4, 20.0, 160.0], [1e-2, 0.0, 0.6, 3.0, 20.0, 100.0]);
            let table = PassedTable::new(&body, &wavenumbers, &along, (0.5, true));
            for (material, z) in [(1, 0.0), (1, 0.11), (1, 0.3), (2, 0.3), (2, 0.307), (2, 0.32), (3, 0.32), (3, 0.9)] {
                let depth = Depth { z, material };
                for traction in [InPlane::Normal, InPlane::Along] {
                    let found = table.amplitudes(traction, wavenumbers.len(), depth);
                    for ((found, q), along) in found.iter().zip(wavenumbers).zip(along) {
                        let response = body.response_at(Complex64::new(0.0, -0.5 * along));
                        let exact = response.interior(traction, q).at(depth);
                        let all = |a: &Amplitudes<Complex64>| [a.szz, a.sqz, a.sqq, a.stt, a.uz * q, a.uq * q];
                        let scale = all(&exact).iter().fold(1e-6, |most: f64, x| most.max(x.norm()));
                        for (found, exact) in all(found).into_iter().zip(all(&exact)) {
                            assert!((found - exact).norm() < 1e-10 * scale, "{depth:?}, q {q}: {found} {exact}");
                        }
                    }
                }
                for ((found, q), along) in table.antiplane(wavenumbers.len(), depth).iter().zip(wavenumbers).zip(along)
                {
                    let exact = body.response_at(Complex64::new(0.0, -0.5 * along)).antiplane(q, depth);
                    let scale = exact.stz.norm().max(exact.sqt.norm()).max(1e-6);
                    assert!(
                        (found.stz - exact.stz).norm() < 1e-11 * scale
                            && (found.sqt - exact.sqt).norm() < 1e-11 * scale
                    );
                }
            }
        }
    }
}

//! Taylor expansion of the stresses around a point inside a material, to the second order of the distance **d** = (d_x, d_y, d_z):
//!
//! σ(**x** + **d**) ≈ σ + **d**·∇σ + ½ **d**·∇∇σ·**d**.
//!
//! All derivatives are exact sums over the waves: of c e^{i**q**·**x**} those along the surface are i q_α times it, those
//! in depth follow from F of [`crate::body::Interior`], dF/dz = qF′ and F⁗ = 2F″ − F. The stress components are
//! expanded because they are smooth; a measure of them, as a principal stress, need not be.

use super::eight_waves::{EightWaves, STRESSES, TERMS, TaylorTerms};
use super::far_plane::FarPlane;
use super::field::{Interiors, StressField};
use super::phases::Phases;
use super::plane_search::SEARCH_REACH;
use super::series::PARALLEL_WAVES;
use super::taylor::Expansion;
use super::traction::ShearForm;
use crate::body::{Depth, InPlane};
use crate::lattice::waves::WaveRow;
use crate::numeric::lanes::{LANES, splat, total, vectorised};
use crate::numeric::parallel;
use fearless_simd::{f64x8, prelude::*};
use rustfft::num_complex::Complex64;
use std::sync::PoisonError;

/// Number of expansions that a field remembers.
const REMEMBERED: usize = 256;

/// Functions of the depth at one depth, for the waves of each shell.
struct DepthFunctions<'a> {
    field: &'a StressField,
    /// ν of the material.
    poisson: f64,
    /// Coefficients of the waves.
    coefficients: &'a [Complex64],
    /// Wavelengths over 2π.
    lengths: &'a [f64],
    /// F and its derivatives by qz under a pressure.
    normal: &'a [[f64; 4]],
    /// Tangential traction over the pressure.
    ratio: [f64; 2],
    /// F and its derivatives by qz under a traction along the wavevector, v and −v′ under one across it; empty without a traction.
    tangential: &'a [([f64; 4], [f64; 2])],
}

impl StressField {
    /// Expansion of the stresses around the point (x, y) at a depth; one that was made before is remembered, as searches for several
    /// measures begin at the same place.
    ///
    /// # Panics
    /// When the depth names a material that does not exist.
    pub(super) fn expanded(&self, depth: Depth, place: [f64; 2]) -> Expansion {
        let remembered = || self.expansions.lock().unwrap_or_else(PoisonError::into_inner);
        let is_here = |known: &&Expansion| known.depth == depth && known.place == place;
        let known = remembered().iter().find(is_here).cloned();
        known.unwrap_or_else(|| {
            self.tables().work().add_expansion();
            let expansion = self.expand(depth, place);
            let mut all = remembered();
            if all.len() == REMEMBERED {
                all.pop_front();
            }
            all.push_back(expansion.clone());
            expansion
        })
    }

    fn expand(&self, depth: Depth, place: [f64; 2]) -> Expansion {
        let interiors = match self.interiors() {
            Interiors::Resting(interiors) if !self.is_heated() => interiors,
            Interiors::Resting(_) | Interiors::Passed(..) => return self.expand_by_sums(depth, place),
        };
        let waves = &self.series.waves;
        let wavenumbers = self.wavenumbers_within(depth, SEARCH_REACH);
        let tangential = if self.slides() {
            let across = interiors.antiplane(wavenumbers, depth);
            let across = across.iter().map(|shear| [-shear.sqt, -shear.stz]);
            interiors.functions(InPlane::Along, wavenumbers, depth).into_iter().zip(across).collect()
        } else {
            Vec::new()
        };
        let normal = interiors.functions(InPlane::Normal, wavenumbers, depth);
        let lengths: Vec<f64> = wavenumbers.iter().map(|q| 1.0 / q).collect();
        let rows = waves.rows_within(wavenumbers.len());
        let [s, t] = self.series_grid().cell().fractions(place);
        let (along, across) = (Phases::along(&rows, [s]), Phases::across(&rows, [t]));
        let coefficients = self.series.coefficients(self.is_deep(depth));
        let under = |coefficients, normal, tangential, ratio| {
            let (field, poisson, lengths) = (self, self.poisson(depth.material), &lengths[..]);
            let functions = DepthFunctions { field, poisson, coefficients, lengths, normal, ratio, tangential };
            functions.of_rows(&rows, &along, &across)
        };
        let mut sums = match self.form() {
            ShearForm::Coulomb { ratio, .. } => under(&coefficients.pressure, &normal, &tangential, ratio),
            ShearForm::None | ShearForm::Fields => under(&coefficients.pressure, &normal, &[], [0.0; 2]),
        };
        if let Some([x, y]) = &coefficients.shear {
            // Tractions along x and along y, without a pressure.
            let none = vec![[0.0; 4]; normal.len()];
            sums.extend(under(x, &none, &tangential, [1.0, 0.0]));
            sums.extend(under(y, &none, &tangential, [0.0, 1.0]));
        }
        let mut terms = [[0.0; STRESSES]; TERMS];
        for (to, from) in terms.iter_mut().flatten().zip(0..) {
            *to = sums.iter().map(|sum| sum[from / STRESSES][from % STRESSES]).sum();
        }
        let mean = self.mean(depth).components();
        terms[0].iter_mut().zip(mean).for_each(|(term, mean)| *term += mean);
        self.add_far(depth, place, &mut terms);
        Expansion { depth, place, terms }
    }
}

impl StressField {
    /// Adds the terms of what a free field has beside the periodic one: it changes over the window, so that differences over a
    /// hundredth of it, or a quarter of a thin layer in depth, are its derivatives.
    fn add_far(&self, depth: Depth, place: [f64; 2], terms: &mut TaylorTerms) {
        let step = 0.005 * self.series_grid().cell().reduced().longer_side();
        let (top, bottom) = self.half_space().faces(depth.material);
        let rise = step.min(0.25 * (bottom - top));
        let at = |offset: f64| self.far(Depth { z: depth.z + offset, ..depth });
        let [Some(above), Some(here), Some(below)] = [-rise, 0.0, rise].map(at) else { return };
        let cell = self.series_grid().cell();
        let value = |plane: &FarPlane<9>, [x, y]: [f64; 2]| -> [f64; STRESSES] {
            let [stresses @ .., _, _, _] = plane.at(cell.fractions([place[0] + x * step, place[1] + y * step]));
            stresses
        };
        let combined = |parts: &[(f64, [f64; STRESSES])]| -> [f64; STRESSES] {
            std::array::from_fn(|k| parts.iter().map(|(weight, stresses)| weight * stresses[k]).sum())
        };
        let (one, two) = (0.5 / step, 1.0 / (step * step));
        let (one_deep, two_deep, mixed_deep) = (0.5 / rise, 0.5 / (rise * rise), 0.25 / (step * rise));
        let v = |x: f64, y: f64| value(&here, [x, y]);
        let (middle, up, down) = (v(0.0, 0.0), value(&above, [0.0; 2]), value(&below, [0.0; 2]));
        let second =
            |a: [f64; STRESSES], b: [f64; STRESSES]| combined(&[(0.5 * two, a), (-two, middle), (0.5 * two, b)]);
        let mixed = |weight: f64, a, b, c, d| combined(&[(weight, a), (weight, b), (-weight, c), (-weight, d)]);
        let far: TaylorTerms = [
            middle,
            combined(&[(one, v(1.0, 0.0)), (-one, v(-1.0, 0.0))]),
            combined(&[(one, v(0.0, 1.0)), (-one, v(0.0, -1.0))]),
            second(v(1.0, 0.0), v(-1.0, 0.0)),
            mixed(0.25 * two, v(1.0, 1.0), v(-1.0, -1.0), v(1.0, -1.0), v(-1.0, 1.0)),
            second(v(0.0, 1.0), v(0.0, -1.0)),
            combined(&[(one_deep, down), (-one_deep, up)]),
            mixed(
                mixed_deep,
                value(&below, [1.0, 0.0]),
                value(&above, [-1.0, 0.0]),
                value(&below, [-1.0, 0.0]),
                value(&above, [1.0, 0.0]),
            ),
            mixed(
                mixed_deep,
                value(&below, [0.0, 1.0]),
                value(&above, [0.0, -1.0]),
                value(&below, [0.0, -1.0]),
                value(&above, [0.0, 1.0]),
            ),
            combined(&[(two_deep, down), (-2.0 * two_deep, middle), (two_deep, up)]),
        ];
        for (term, far) in terms.iter_mut().flatten().zip(far.iter().flatten()) {
            *term += far;
        }
    }
}

impl DepthFunctions<'_> {
    /// Terms of the expansion by the waves of each row, at the point with these phases.
    fn of_rows(&self, rows: &[WaveRow], along: &Phases<1>, across: &Phases<1>) -> Vec<TaylorTerms> {
        let of_row = |row: &WaveRow| {
            let &[[re], [im]] = across.of(row);
            if self.tangential.is_empty() {
                vectorised!(simd => self.row::<_, false>(simd, row, along.from(row), [re, im]))
            } else {
                vectorised!(simd => self.row::<_, true>(simd, row, along.from(row), [re, im]))
            }
        };
        let count: usize = rows.iter().map(|row| row.len).sum();
        // Rows are added in their order, whatever the threads, so that the sum does not depend on their number.
        parallel::map_by(PARALLEL_WAVES * rows.len() / count.max(1), rows.len(), |number| of_row(&rows[number]))
    }

    /// Terms of the expansion by the waves of a row; `along` are the phases of the point's fraction of a₁, one per wave, `across` that
    /// of its fraction of a₂.
    #[inline(always)]
    fn row<S: Simd, const SLIDES: bool>(
        &self,
        simd: S,
        row: &WaveRow,
        along: &[[[f64; 1]; 2]],
        across: [f64; 2],
    ) -> TaylorTerms {
        let mut sums = [[splat(simd, 0.0); STRESSES]; TERMS];
        for first in (0..row.len).step_by(LANES) {
            let waves = self.eight_waves::<S, SLIDES>(simd, row, first, along, across);
            for order in 0..3 {
                let even = waves.cartesian(waves.stresses(&waves.normal, order));
                let odd = if SLIDES { self.sheared(simd, &waves, order) } else { [splat(simd, 0.0); STRESSES] };
                waves.add::<SLIDES>(&mut sums, &even, &odd, order);
            }
        }
        let mut terms = [[0.0; STRESSES]; TERMS];
        for term in 0..TERMS {
            for k in 0..STRESSES {
                // Squares have the factor ½.
                let part = if matches!(term, 3 | 5 | 9) { 0.5 } else { 1.0 };
                terms[term][k] = part * total(sums[term][k]);
            }
        }
        terms
    }

    /// Eight waves of a row from the number `first` on.
    #[inline(always)]
    fn eight_waves<S: Simd, const SLIDES: bool>(
        &self,
        simd: S,
        row: &WaveRow,
        first: usize,
        along: &[[[f64; 1]; 2]],
        across: [f64; 2],
    ) -> EightWaves<S> {
        let step = self.field.series.waves.step();
        let shells = &self.field.series.waves.shells()[row.start..row.start + row.len];
        let coefficients = &self.coefficients[row.start..row.start + row.len];
        // Lanes beyond the row's end have no coefficient.
        let mut quantities = [[0.0; LANES]; 7];
        let (mut f, mut g, mut v) = ([[0.0; LANES]; 4], [[0.0; LANES]; 4], [[0.0; LANES]; 2]);
        for lane in 0..LANES.min(row.len - first) {
            let number = first + lane;
            let (shell, c, [[re], [im]]) = (shells[number] as usize, coefficients[number], along[number]);
            let [x, y] = row.at(number, step);
            let all = [c.re, c.im, re, im, x, y, self.lengths[shell]];
            put(&mut quantities, lane, &all);
            put(&mut f, lane, &self.normal[shell]);
            if SLIDES {
                let (along, across) = &self.tangential[shell];
                put(&mut g, lane, along);
                put(&mut v, lane, across);
            }
        }
        let [c_re, c_im, re, im, x, y, length] = loaded(simd, &quantities);
        let (across_re, across_im) = (splat(simd, across[0]), splat(simd, across[1]));
        let (re, im) = (re * across_re - im * across_im, re * across_im + im * across_re);
        let (nx, ny) = (x * length, y * length);
        EightWaves {
            value: [c_re * re - c_im * im, c_re * im + c_im * re],
            q: [x, y],
            n: [nx, ny],
            nn: [nx * nx, nx * ny, ny * ny],
            wavenumber: x * nx + y * ny,
            nu: splat(simd, self.poisson),
            normal: loaded(simd, &f),
            along: loaded(simd, &g),
            across: loaded(simd, &v),
        }
    }

    /// xx, yy, zz, xy, xz, yz under the traction, or their derivatives in depth.
    #[inline(always)]
    fn sheared<S: Simd>(&self, simd: S, waves: &EightWaves<S>, order: usize) -> [f64x8<S>; STRESSES] {
        let [ex, ey] = self.ratio.map(|e| splat(simd, e));
        let ([nx, ny], [nxx, nxy, nyy], [v, s]) = (waves.n, waves.nn, waves.across);
        let (by_along, by_across) = (ex * nx + ey * ny, ey * nx - ex * ny);
        let (two, minus, wavenumber) = (splat(simd, 2.0), splat(simd, -1.0), waves.wavenumber);
        // Under a shear traction σ_zz, σ_qq and σ_tt have the other sign.
        let [zz, qz, qq, tt] = waves.stresses(&waves.along, order);
        let along = waves.cartesian([zz * minus, qz, qq * minus, tt * minus]);
        let (stz, sqt) = match order {
            0 => (s * minus, v * minus),
            1 => (v * wavenumber, s * wavenumber),
            _ => (s * minus * wavenumber * wavenumber, v * minus * wavenumber * wavenumber),
        };
        let shear = two * nxy * sqt;
        let across = [shear * minus, shear, splat(simd, 0.0), (nxx - nyy) * sqt, ny * minus * stz, nx * stz];
        let mut odd = [splat(simd, 0.0); STRESSES];
        for k in 0..STRESSES {
            odd[k] = by_along * along[k] + by_across * across[k];
        }
        odd
    }
}

/// N quantities of eight waves as vectors.
#[inline(always)]
fn loaded<S: Simd, const N: usize>(simd: S, all: &[[f64; LANES]; N]) -> [f64x8<S>; N] {
    let mut vectors = [splat(simd, 0.0); N];
    for k in 0..N {
        vectors[k] = f64x8::from_slice(simd, &all[k]);
    }
    vectors
}

/// Stores N quantities of one wave in its lane.
#[inline(always)]
fn put<const N: usize>(all: &mut [[f64; LANES]; N], lane: usize, quantities: &[f64; N]) {
    for k in 0..N {
        all[k][lane] = quantities[k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material, MeanStress};
    use crate::friction::Friction;
    use crate::lattice::{Cell, Grid};
    use ndarray::Array2;
    use std::sync::Arc;

    /// In each material, with a traction and without, on a cell that is oblique: the sum itself beside the place errs from the
    /// expansion by the third power of the distance.
    #[test]
    fn the_sum_beside_the_place_is_that_of_the_expansion_to_the_third_order() {
        let material = |shear, poisson| Material::from_shear(shear, poisson).unwrap();
        let layer = Layer::new(material(3.0, 0.2), 0.2, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer], material(1.0, 0.3));
        let grid = Arc::new(Grid::new(Cell::new([1.0, 0.1], [0.3, 0.9]).unwrap(), [18, 20]).unwrap());
        let pressure = Array2::from_shape_fn([18, 20], |(i, j)| ((i * 7 + j * j * 3) % 11) as f64 / 11.0);
        for friction in [None, Some(Friction::new(0.4, [1.0, 0.5]).unwrap())] {
            let mean = MeanStress::Confined;
            let field = StressField::under(&grid, pressure.view(), &half_space, friction.as_ref(), mean).unwrap();
            for (z, material) in [(0.1, 1), (0.31, 2)] {
                let (depth, place) = (Depth { z, material }, [0.31, 0.17]);
                let expansion = field.expanded(depth, place);
                let direct = field.points(depth, &[place])[0].components();
                let middle = expansion.state().components();
                assert!((0..6).all(|k| (direct[k] - middle[k]).abs() < 1e-11), "{direct:?}, {middle:?}");
                let error = |by: f64| {
                    let [x, y, dz] = [0.6 * by, -0.8 * by, 0.5 * by];
                    let beside = Depth { z: z + dz, material };
                    let exact = field.points(beside, &[[place[0] + x, place[1] + y]])[0].components();
                    let found = expansion.at([x, y, dz]).components();
                    (0..6).map(|k| (exact[k] - found[k]).abs()).fold(0.0, f64::max)
                };
                let (far, near) = (error(0.01), error(0.001));
                assert!(near < 2e-3 * far && near > 5e-4 * far, "{friction:?}, {depth:?}: {far}, {near}");
            }
        }
    }
}

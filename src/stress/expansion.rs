//! The stresses around a place inside a material, to the second order of the distance **d** = (d_x, d_y, d_z):
//!
//! σ(**x** + **d**) ≈ σ + **d**·∇σ + ½ **d**·∇∇σ·**d**.
//!
//! All derivatives are sums over the waves themselves: of c e^{i**q**·**x**} those along the surface are i q_α times it, those
//! in depth follow from F of [`crate::body::Interior`], dF/dz = qF′ and F⁗ = 2F″ − F. The stress
//! components are smooth; a quantity made of them (a principal stress) need not be, so that they are expanded and it is not.

use super::field::StressField;
use super::search::SEARCH_REACH;
use super::series::{MANY, Phases};
use super::tensor::State;
use crate::body::{Depth, InPlane};
use crate::lattice::waves::Row;
use crate::numeric::lanes::{LANES, splat, total, vectorised};
use fearless_simd::{f64x8, prelude::*};
use rayon::prelude::*;

/// Components of the stress: xx, yy, zz, xy, xz, yz.
const STRESSES: usize = 6;
/// Terms 1, d_x, d_y, d_x², d_x d_y, d_y² of an expansion at one depth, then d_z, d_x d_z, d_y d_z, d_z².
const TERMS: usize = 10;

type Terms = [[f64; STRESSES]; TERMS];

/// The stresses around a place.
#[derive(Debug, Clone)]
pub(super) struct Expansion {
    pub depth: Depth,
    /// x, y; lengths.
    pub place: [f64; 2],
    terms: Terms,
}

impl Expansion {
    /// The state in its middle, displacements left out.
    pub fn state(&self) -> State {
        State::from_stresses(self.terms[0])
    }

    /// The same at a distance.
    pub fn at(&self, [x, y, z]: [f64; 3]) -> State {
        let powers = [1.0, x, y, x * x, x * y, y * y, z, x * z, y * z, z * z];
        let mut stresses = [0.0; STRESSES];
        for (power, term) in powers.iter().zip(&self.terms) {
            for k in 0..STRESSES {
                stresses[k] += power * term[k];
            }
        }
        State::from_stresses(stresses)
    }
}

/// What the waves of a depth cause, by shell.
struct Waving<'a> {
    field: &'a StressField,
    poisson: f64,
    lengths: Vec<f64>,
    normal: Vec<[f64; 4]>,
    /// Under the traction along the wavevector F, across it v and −v′.
    tangential: Vec<([f64; 4], [f64; 2])>,
}

impl StressField {
    /// The stresses around the place (x, y) at a depth.
    ///
    /// # Panics
    /// When the depth is in a material that is not there.
    pub(super) fn expanded(&self, depth: Depth, place: [f64; 2]) -> Expansion {
        let waves = &self.series.waves;
        let wavenumbers = self.reached(depth, SEARCH_REACH);
        let interiors = self.interiors();
        let tangential = if self.slides() {
            let across = interiors.antiplane(wavenumbers, depth);
            let across = across.iter().map(|own| [-own.sqt, -own.stz]);
            interiors.functions(InPlane::Along, wavenumbers, depth).into_iter().zip(across).collect()
        } else {
            Vec::new()
        };
        let waving = Waving {
            field: self,
            poisson: self.poisson(depth.material),
            lengths: wavenumbers.iter().map(|q| 1.0 / q).collect(),
            normal: interiors.functions(InPlane::Normal, wavenumbers, depth),
            tangential,
        };
        let rows = waves.rows_within(wavenumbers.len());
        let [s, t] = self.grid().cell().fractions(place);
        let (along, across) = (Phases::along(&rows, [s]), Phases::across(&rows, [t]));
        let of_row = |row: &Row| {
            let &[[re], [im]] = across.of(row);
            if self.slides() {
                vectorised!(simd => waving.row::<_, true>(simd, row, along.from(row), [re, im]))
            } else {
                vectorised!(simd => waving.row::<_, false>(simd, row, along.from(row), [re, im]))
            }
        };
        let count: usize = rows.iter().map(|row| row.len).sum();
        // Rows are added in their order, whoever has summed them.
        let sums: Vec<Terms> = rows.par_iter().with_min_len(MANY * rows.len() / count.max(1)).map(of_row).collect();
        let mut terms = [[0.0; STRESSES]; TERMS];
        for (to, from) in terms.iter_mut().flatten().zip(0..) {
            *to = sums.iter().map(|own| own[from / STRESSES][from % STRESSES]).sum();
        }
        let mean = self.mean(depth).components();
        terms[0].iter_mut().zip(mean).for_each(|(term, mean)| *term += mean);
        Expansion { depth, place, terms }
    }
}

impl Waving<'_> {
    /// The terms of a row's waves: `along` are the phases of their fractions of a₁, `across` that of a₂.
    #[inline(always)]
    fn row<S: Simd, const SLIDES: bool>(&self, simd: S, row: &Row, along: &[[[f64; 1]; 2]], across: [f64; 2]) -> Terms {
        let step = self.field.series.waves.step();
        let shells = &self.field.series.waves.shells()[row.start..row.start + row.len];
        let coefficients = &self.field.series.coefficients[row.start..row.start + row.len];
        let [ex, ey] = self.field.traction();
        let (ex, ey) = (splat(simd, ex), splat(simd, ey));
        let (turn_re, turn_im) = (splat(simd, across[0]), splat(simd, across[1]));
        let nu = splat(simd, self.poisson);
        let mut sums = [[splat(simd, 0.0); STRESSES]; TERMS];
        for first in (0..row.len).step_by(LANES) {
            // What lies beyond the row's end has no coefficient.
            let mut own = [[0.0; LANES]; 7];
            let (mut f, mut g, mut v) = ([[0.0; LANES]; 4], [[0.0; LANES]; 4], [[0.0; LANES]; 2]);
            for lane in 0..LANES.min(row.len - first) {
                let number = first + lane;
                let (shell, c, [[re], [im]]) = (shells[number] as usize, coefficients[number], along[number]);
                let [x, y] = row.at(number, step);
                let all = [c.re, c.im, re, im, x, y, self.lengths[shell]];
                put(&mut own, lane, &all);
                put(&mut f, lane, &self.normal[shell]);
                if SLIDES {
                    let (along, across) = &self.tangential[shell];
                    put(&mut g, lane, along);
                    put(&mut v, lane, across);
                }
            }
            let [c_re, c_im, re, im, x, y, length] = loaded(simd, &own);
            let (f, g, [v, s]) = (loaded(simd, &f), loaded(simd, &g), loaded(simd, &v));
            let (re, im) = (re * turn_re - im * turn_im, re * turn_im + im * turn_re);
            let (p, q) = (c_re * re - c_im * im, c_re * im + c_im * re);
            let (nx, ny) = (x * length, y * length);
            let (nxx, nyy, nxy) = (nx * nx, ny * ny, nx * ny);
            let wavenumber = x * nx + y * ny;
            let (by_along, by_across) = (ex * nx + ey * ny, ey * nx - ex * ny);
            let (two, minus) = (splat(simd, 2.0), splat(simd, -1.0));
            let turn = Turn { n: [nx, ny], nn: [nxx, nxy, nyy], nu, wavenumber };
            let xx = [x * x, x * y, y * y];
            // By derivatives in depth.
            for order in 0..3 {
                let even = turn.turned(turn.stresses(&f, order));
                let mut odd = [splat(simd, 0.0); STRESSES];
                if SLIDES {
                    // Under a shear traction σ_zz, σ_qq and σ_tt have the other sign.
                    let [zz, qz, qq, tt] = turn.stresses(&g, order);
                    let own = turn.turned([zz * minus, qz, qq * minus, tt * minus]);
                    let (stz, sqt) = match order {
                        0 => (s * minus, v * minus),
                        1 => (v * wavenumber, s * wavenumber),
                        _ => (s * minus * wavenumber * wavenumber, v * minus * wavenumber * wavenumber),
                    };
                    let shear = two * nxy * sqt;
                    let across =
                        [shear * minus, shear, splat(simd, 0.0), (nxx - nyy) * sqt, ny * minus * stz, nx * stz];
                    for k in 0..STRESSES {
                        odd[k] = by_along * own[k] + by_across * across[k];
                    }
                }
                for k in 0..STRESSES {
                    // c(E − iT) where a pressure's stress is even, c(T − iE) where it is odd.
                    let (e, t) = if k < 4 { (even[k], odd[k]) } else { (odd[k], even[k]) };
                    let (re, im) = if SLIDES || k >= 4 { (p * e + q * t, q * e - p * t) } else { (p * e, q * e) };
                    match order {
                        0 => {
                            sums[0][k] += re;
                            sums[1][k] -= x * im;
                            sums[2][k] -= y * im;
                            for term in 0..3 {
                                sums[3 + term][k] -= xx[term] * re;
                            }
                        }
                        1 => {
                            sums[6][k] += re;
                            sums[7][k] -= x * im;
                            sums[8][k] -= y * im;
                        }
                        _ => sums[9][k] += re,
                    }
                }
            }
        }
        let mut terms = [[0.0; STRESSES]; TERMS];
        for term in 0..TERMS {
            for k in 0..STRESSES {
                // ½ of the squares.
                let part = if matches!(term, 3 | 5 | 9) { 0.5 } else { 1.0 };
                terms[term][k] = part * total(sums[term][k]);
            }
        }
        terms
    }
}

/// Numbers of eight waves as vectors.
#[inline(always)]
fn loaded<S: Simd, const N: usize>(simd: S, all: &[[f64; LANES]; N]) -> [f64x8<S>; N] {
    let mut vectors = [splat(simd, 0.0); N];
    for k in 0..N {
        vectors[k] = f64x8::from_slice(simd, &all[k]);
    }
    vectors
}

/// Puts numbers of one wave beside those of others.
#[inline(always)]
fn put<const N: usize>(all: &mut [[f64; LANES]; N], lane: usize, own: &[f64; N]) {
    for k in 0..N {
        all[k][lane] = own[k];
    }
}

/// Eight waves: **n**, n n, ν and q.
struct Turn<S: Simd> {
    n: [f64x8<S>; 2],
    nn: [f64x8<S>; 3],
    nu: f64x8<S>,
    wavenumber: f64x8<S>,
}

impl<S: Simd> Turn<S> {
    /// xx, yy, zz, xy, xz, yz of σ_zz, σ_qz, σ_qq, σ_tt.
    #[inline(always)]
    fn turned(&self, [zz, qz, qq, tt]: [f64x8<S>; 4]) -> [f64x8<S>; STRESSES] {
        let ([nx, ny], [nxx, nxy, nyy]) = (self.n, self.nn);
        [nxx * qq + nyy * tt, nyy * qq + nxx * tt, zz, nxy * (qq - tt), nx * qz, ny * qz]
    }

    /// σ_zz, σ_qz, σ_qq, σ_tt of F, or their derivatives in depth.
    #[inline(always)]
    fn stresses(&self, &[f0, f1, f2, f3]: &[f64x8<S>; 4], order: usize) -> [f64x8<S>; 4] {
        let (nu, q) = (self.nu, self.wavenumber);
        match order {
            0 => [-f0, f1, f2, nu * (f2 - f0)],
            1 => [-f1 * q, f2 * q, f3 * q, nu * (f3 - f1) * q],
            _ => {
                let square = q * q;
                [-f2 * square, f3 * square, (f2 + f2 - f0) * square, nu * (f2 - f0) * square]
            }
        }
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
                let own = field.points(depth, &[place])[0].components();
                let middle = expansion.state().components();
                assert!((0..6).all(|k| (own[k] - middle[k]).abs() < 1e-11), "{own:?}, {middle:?}");
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

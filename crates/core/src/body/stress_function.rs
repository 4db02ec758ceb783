//! The stress function F of a wave in one material: four coefficients, derivatives at any depth, amplitudes.
//!
//! Along x = q·(depth below the upper face of a material) the stress function F of a wave solves (D² − 1)²F = 0, D = d/dx, and
//! all amplitudes follow from F and its first three derivatives:
//!
//! σ_zz = −F,  σ_qz = F′,  σ_qq = F″,  σ_tt = ν(F″ − F),
//! 2Gq u_z = (1−ν)F‴ − (2−ν)F′,  2Gq u_q = (1−ν)F″ + νF
//!
//! (under a shear traction a quarter wave further, which exchanges the signs of σ_zz, σ_qq, σ_tt and u_z). Four numbers hold F
//! in a layer of thickness h, X = qh, x′ = X − x:
//!
//! - X ≥ 1:  F = (a + bx)e^{−x} + (c + dx′)e^{−x′}, a and b from F at the upper face, where the operator (D − 1)² removes the
//!   other part, c and d from F at the lower face by (D + 1)²;
//! - X < 1:  F = F₀ cosh x + F₁ sinh x + (F₂ − F₀) ½x sinh x + (F₃ − F₁) ½(x cosh x − sinh x), Fᵢ the derivatives at the upper
//!   face: where the layer bends with a large F₃, what it adds to F falls as x³.
//!
//! In the substrate c = d = 0. Nothing cancels: each number errs by the rounding of F beside it. Across the wavevector two
//! numbers are enough, v = αe^{−x} + βe^{−x′}, s = −v′. All come from the [`Interior`], which is exact and slow. On the surface
//! and at frictionless faces the traction is known, and is set without rounding: F = 1, F′ = 0 under a pressure, F = 0, F′ = −1
//! under a shear traction; F′ = 0.

use super::interior::Interior;
use super::minors::MAX_EXPONENT;
use super::{Amplitudes, InPlane};
use crate::numeric::number::Number;

/// qh below which a layer is thin, and F is held by its derivatives at the upper face.
const THIN_LAYER: f64 = 1.0;

/// F and its first three derivatives by x.
pub(crate) type Derivatives<N = f64> = [N; 4];

/// e^{−x}.
pub(super) fn decay(x: f64) -> f64 {
    (-x.min(MAX_EXPONENT)).exp()
}

/// a, b, c, d of F in a material, from 0.
pub(super) fn coefficients<N: Number>(interior: &Interior<N>, material: usize) -> [N; 4] {
    let [f0, f1, f2, f3] = interior.derivatives(material, 0.0);
    let thickness = interior.thickness(material);
    if thickness.is_infinite() {
        return [f0, f0 + f1, N::from(0.0), N::from(0.0)];
    }
    if thickness < THIN_LAYER {
        return [f0, f1, f2 - f0, f3 - f1];
    }
    let [g0, g1, g2, g3] = interior.derivatives(material, thickness);
    let (b, d) = ((f3 - f2 - f1 + f0) * 0.25, (g3 + g2 - g1 - g0) * -0.25);
    [(f2 - f1 * 2.0 + f0) * 0.25 + b, b, (g2 + g1 * 2.0 + g0) * 0.25 + d, d]
}

/// F and its derivatives at x in a layer of thickness X.
#[inline(always)]
pub(crate) fn derivatives<N: Number>(&[a, b, c, d]: &[N; 4], x: f64, thickness: f64) -> Derivatives<N> {
    if thickness < THIN_LAYER {
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
    let mut all = [a, b - a, a - b * 2.0, b * 3.0 - a];
    if (c, d) != (N::from(0.0), N::from(0.0)) {
        let rest = thickness - x;
        let up = decay(rest);
        let [c, d] = [c + d * rest, d].map(|part| part * up);
        all = [all[0] + c, all[1] + c - d, all[2] + c - d * 2.0, all[3] + c - d * 3.0];
    }
    all
}

/// Amplitudes from F and its derivatives, G and ν.
#[inline(always)]
pub(super) fn amplitudes_of<N: Number>(
    traction: InPlane,
    [f0, f1, f2, f3]: Derivatives<N>,
    [shear, poisson]: [N; 2],
    wavenumber: f64,
) -> Amplitudes<N> {
    let (sign, one) = (traction.sign(), N::from(1.0));
    let per_displacement = N::from(0.5).over(shear * wavenumber);
    Amplitudes {
        szz: -f0 * sign,
        sqz: f1,
        sqq: f2 * sign,
        stt: poisson * sign * (f2 - f0),
        uz: ((one - poisson) * f3 - (N::from(2.0) - poisson) * f1) * sign * per_displacement,
        uq: ((one - poisson) * f2 + poisson * f0) * per_displacement,
    }
}

/// F and its derivatives from amplitudes: the inverse of [`amplitudes_of`].
#[inline(always)]
pub(super) fn derivatives_of(
    &Amplitudes { szz, sqz, sqq, uz, .. }: &Amplitudes,
    traction: InPlane,
    [shear, poisson]: [f64; 2],
    wavenumber: f64,
) -> Derivatives {
    let sign = traction.sign();
    let w = sign * uz * shear * wavenumber;
    [-sign * szz, sqz, sign * sqq, (2.0 * w + (2.0 - poisson) * sqz) / (1.0 - poisson)]
}

/// cosh x, sinh x, ½x sinh x and ½(x cosh x − sinh x), 0 ≤ x < 1, by their series: the last one is Σ j x^{2j+1}/(2j+1)!.
#[inline(always)]
fn hyperbolic(x: f64) -> [f64; 4] {
    let square = x * x;
    let (mut cosh, mut sinh, mut bend) = (0.0, 0.0, 0.0);
    for j in (0..TERMS).rev() {
        cosh = cosh * square + EVEN[j];
        sinh = sinh * square + ODD[j];
        bend = bend * square + j as f64 * ODD[j];
    }
    [cosh, x * sinh, 0.5 * square * sinh, x * bend]
}

/// Terms of a series in x² < 1: the next one is below 10⁻¹⁷.
const TERMS: usize = 10;
/// 1/(2j)! and 1/(2j+1)!.
const EVEN: [f64; TERMS] = reciprocals(0);
const ODD: [f64; TERMS] = reciprocals(1);

const fn reciprocals(first: usize) -> [f64; TERMS] {
    let mut all = [1.0; TERMS];
    let mut j = 1;
    while j < TERMS {
        let n = (2 * j + first) as f64;
        all[j] = all[j - 1] / (n * (n - 1.0));
        j += 1;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_are_the_functions() {
        for x in [0.0, 1e-3, 0.3, 0.999f64] {
            let [cosh, sinh, rise, bend] = hyperbolic(x);
            assert!((cosh - x.cosh()).abs() < 1e-15 && (sinh - x.sinh()).abs() < 1e-15);
            assert!((rise - 0.5 * x * x.sinh()).abs() < 1e-15);
            // x³/6 + x⁵/60 + …, where the difference itself cancels.
            assert!((bend - 0.5 * (x * x.cosh() - x.sinh())).abs() < 1e-15);
            assert!((bend - x.powi(3) / 6.0 * (1.0 + 0.1 * x * x)).abs() <= 7e-4 * x.powi(7));
        }
    }
}

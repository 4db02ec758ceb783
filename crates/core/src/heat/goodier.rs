//! The part of the thermal stress that Goodier's potential gives in one material.
//!
//! With M = 2G(1+ν)/(1−ν) αT, the stress under which a heated plane keeps its size, the stress function F of a wave (x = kz, D = d/dx)
//! obeys (D² − 1)²F = −(D² − 1)M. One solution is that of (D² − 1)F = −M, F = −2Gk²φ with the potential φ of the displacements,
//!
//! u = ∇φ,  ∇²φ = (1+ν)/(1−ν) αT
//!
//! (J. N. Goodier, Phil. Mag. 23, 1017 (1937)): σ_zz = −F, σ_qz = F′, σ_qq = F − M, σ_tt = −M, 2Gk u_z = −F′, 2Gk u_q = F. For the parts
//! M_A e^{−sz} and, mirrored, M_B e^{−s(h−z)} of M
//!
//! F = M_A k²(e^{−kz} − e^{−sz})/(s² − k²) = M_A k²z e^{−kz} m((s−k)z)/(s + k),  m(x) = (1 − e^{−x})/x,
//!
//! no 0/0 at s = k. In layers thin against |1/s| M is held by cosh(sy) and sinh(sy), y above the lower face, and F by
//! −k²(cosh sy − cosh ky)/(s² − k²) and −k²(sinh(sy) − (s/k) sinh(ky))/(s² − k²), from their series.

use super::conducting_material::ConductingMaterial;
use super::exponentials::{decay, mean_decay};
use rustfft::num_complex::Complex64;

/// Terms of the series in (sy)² ≤ 1: the next ones are below 10⁻¹⁷.
const TERMS: u32 = 10;

/// F, F′ = dF/dx and M of Goodier's potential at one depth, pressures per flux.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Goodier {
    pub function: Complex64,
    pub slope: Complex64,
    pub membrane: Complex64,
}

impl Goodier {
    /// Potential in a `material` at a distance below its upper face; `modulus` is M/T, a pressure per temperature.
    pub fn at(material: &ConductingMaterial, modulus: f64, below: f64) -> Self {
        let membrane = material.temperature(below) * modulus;
        let [function, slope] = if material.is_thin() { thin(material, below) } else { thick(material, below) };
        Self { function: function * modulus, slope: slope * modulus, membrane }
    }
}

/// F and F′ for M = T from the exponentials of both faces.
fn thick(material: &ConductingMaterial, below: f64) -> [Complex64; 2] {
    let k = material.rate.wavenumber;
    let [a, b] = material.exponentials();
    let part = |z: f64| {
        let bulge = decay(Complex64::from(k * z)) * mean_decay(material.rate.excess * z) * (k * z);
        [bulge, decay(material.rate.rate * z) - bulge].map(|part| part * k / material.rate.sum())
    };
    let down = part(below);
    if material.thickness.is_infinite() {
        return down.map(|part| part * a);
    }
    let up = part(material.thickness - below);
    [down[0] * a + up[0] * b, down[1] * a - up[1] * b]
}

/// F and F′ for M = T by series in y. With r = (sy)², p = (ky)² and hⱼ = Σ rⁿp^{j−n}, n ≤ j, cosh sy − cosh ky = (r − p) Σ hⱼ/(2j+2)!.
fn thin(material: &ConductingMaterial, below: f64) -> [Complex64; 2] {
    let (s, k) = (material.rate.rate, material.rate.wavenumber);
    let y = material.thickness - below;
    let unit = (decay(s * (2.0 * material.thickness)) + 1.0).inv() * decay(s * material.thickness) * 2.0;
    let [a, b] = material.lower.map(|part| part * unit);
    let (r, p) = ((s * y) * (s * y), (k * y) * (k * y));
    let (mut symmetric, mut power, mut factorial) = (Complex64::from(1.0), 1.0, 1.0);
    // y⁻² and y⁻³ times the integrals of cosh and sinh(s ·)/s, y⁻¹ times the slope of the former.
    let [mut even, mut odd, mut slope] = [Complex64::default(); 3];
    for j in 0..TERMS {
        let first = f64::from(2 * j + 1);
        slope += symmetric / (factorial * first);
        even += symmetric / (factorial * first * (first + 1.0));
        odd += symmetric / (factorial * first * (first + 1.0) * (first + 2.0));
        factorial *= first * (first + 1.0);
        power *= p;
        symmetric = symmetric * r + power;
    }
    let (even, odd, slope) = (even * (y * y), odd * s * (y * y * y), slope * y);
    [(a * even + b * odd) * -(k * k), (a * slope + b * s * even) * k]
}

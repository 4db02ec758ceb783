//! Far field: displacement under a uniformly loaded disc on the layered surface.
//!
//! A unit pressure on the disc r ≤ R displaces the surface at the distance s from its centre by
//!
//! D(s) = c R ∫₀^∞ T(q) J₁(qR) J₀(qs)/q dq,
//!
//! the part without layers in closed form (K, E: complete elliptic integrals of the modulus k; Johnson, *Contact
//! Mechanics*, 1985, §3.4(a)):
//!
//! s ≤ R: (2c/π) R E(s/R),  s ≥ R: (2c/π) s [E(R/s) − (1 − R²/s²) K(R/s)].
//!
//! The pressure p̄ outside the disc alone is p̄ everywhere, which only moves the mean plane, minus p̄ on the disc.

use super::point::{PointKernel, QUADRATURE};
use super::quadrature::{Bessel, hankel};
use crate::numeric::chebyshev::Chebyshev;
use crate::numeric::parallel;
use std::f64::consts::{FRAC_PI_2, PI};

/// Displacement at the distance `s` ≥ 0 from the centre of a disc of `radius` under unit pressure: a length per
/// pressure.
pub fn displacement(kernel: &PointKernel, radius: f64, s: f64) -> f64 {
    homogeneous(kernel, radius, s) + correction(kernel, radius, s)
}

/// D on a bare half-space of the surface material, a length per pressure.
pub fn homogeneous(kernel: &PointKernel, radius: f64, s: f64) -> f64 {
    // c/(2π) times 4 is 2c/π.
    let factor = 4.0 * kernel.factor();
    if radius == 0.0 {
        // A circle without load: s/R is not defined in its centre.
        return 0.0;
    }
    if s <= radius {
        return factor * radius * elliptic(s / radius).1;
    }
    let k = radius / s;
    let (first, second) = elliptic(k);
    factor * s * (second - (1.0 - k) * (1.0 + k) * first)
}

/// Difference of D on the layered half-space and on the bare one, a length per pressure.
pub fn correction(kernel: &PointKernel, radius: f64, s: f64) -> f64 {
    if kernel.thickness().is_none() || radius == 0.0 {
        return 0.0;
    }
    let compliance = 2.0 * PI * kernel.factor();
    let part = |oscillating: Bessel, distance: f64, f: &dyn Fn(f64) -> f64| {
        hankel(oscillating, distance, kernel.layer_cutoff(), QUADRATURE, |q| kernel.excess(q) / q * f(q)).value
    };
    // The faster oscillation sets the zeros.
    let integral = if s <= radius {
        part(Bessel::One, radius, &|q| Bessel::Zero.at(q * s))
    } else {
        part(Bessel::Zero, s, &|q| Bessel::One.at(q * radius))
    };
    compliance * radius * integral
}

/// D of one disc, as a Chebyshev series for many points near its centre.
#[derive(Debug, Clone)]
pub struct FarField<'a> {
    kernel: &'a PointKernel,
    /// Radius R of the disc, a length.
    pub radius: f64,
    reach: f64,
    /// Chebyshev series of the layers' part in the square of the distance.
    series: Chebyshev<TERMS>,
}

/// Number of terms of the series: the layers' part is smooth and even in the distance.
const TERMS: usize = 14;

impl<'a> FarField<'a> {
    /// Disc of `radius`, for distances up to `reach` from its centre; lengths.
    pub fn new(kernel: &'a PointKernel, radius: f64, reach: f64) -> Self {
        let nodes = Chebyshev::<TERMS>::nodes();
        let distance = |x: f64| reach * (0.5 * (1.0 + x)).sqrt();
        let values: Vec<f64> = parallel::map_items(&nodes, |&x| correction(kernel, radius, distance(x)));
        let series = Chebyshev::through(&std::array::from_fn(|k| values[k]));
        Self { kernel, radius, reach, series }
    }

    /// D at the distance `s` from the centre: a length per pressure.
    pub fn at(&self, s: f64) -> f64 {
        let layers = self.series.at((2.0 * (s / self.reach).powi(2) - 1.0).clamp(-1.0, 1.0));
        homogeneous(self.kernel, self.radius, s) + layers
    }
}

/// Complete elliptic integrals K(k) and E(k) by the arithmetic–geometric mean.
fn elliptic(k: f64) -> (f64, f64) {
    if k >= 1.0 {
        return (f64::INFINITY, 1.0);
    }
    let (mut a, mut b, mut c) = (1.0, ((1.0 - k) * (1.0 + k)).sqrt(), k);
    let (mut sum, mut power) = (0.5 * c * c, 0.5);
    while c.abs() > 1e-9 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
        sum += power * c * c;
    }
    let first = FRAC_PI_2 / a;
    (first, first * (1.0 - sum))
}

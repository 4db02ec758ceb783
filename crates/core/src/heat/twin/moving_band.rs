//! Temperature under a moving band of heat in closed form, against the sum of its waves.

use crate::body::Conduction;
use crate::body::{HalfSpace, Material};
use crate::heat::HeatedBody;
use crate::numeric::quadrature::gauss;
use rustfft::num_complex::Complex64;
use std::f64::consts::PI;

/// K₀ and K₁ by ∫₀^∞ e^{−y cosh t} cosh nt dt: the trapezoidal rule converges exponentially.
fn bessel(y: f64) -> [f64; 2] {
    let step = 0.02;
    let terms = (1..600).map(|j| step * f64::from(j)).map(|t| (-y * t.cosh()).exp() * step);
    let ends = 0.5 * step * (-y).exp();
    [
        terms.clone().sum::<f64>() + ends,
        terms.zip(1..).map(|(term, j)| term * (step * f64::from(j)).cosh()).sum::<f64>() + ends,
    ]
}

/// T of a band of the half-width 1 that moves over λ = κ = 1 with v = 2B, J. C. Jaeger, J. Proc. R. Soc. N.S.W. 76, 203 (1942):
/// (2/πv)[F(X + B) − F(X − B)], X = xB, F(y) = ye^{−y}(K₀ − K₁) + 1 and F(−y) = 1 − ye^y(K₀ + K₁).
fn moving_band(half: f64, x: f64) -> f64 {
    let f = |y: f64| {
        let [k0, k1] = bessel(y.abs());
        if y > 0.0 { y * (-y).exp() * (k0 - k1) + 1.0 } else { 1.0 + y * (-y).exp() * (k0 + k1) }
    };
    (f(half * (x + 1.0)) - f(half * (x - 1.0))) / (PI * half)
}

/// The inverse transform of 2 sin k/k over Z, by Gauss' rule on panels in √k, then in k, to k = K; the rest is below
/// 2/(πK²)·Σ1/|x ± 1| = 1.7e-8.
#[test]
fn a_moving_band_has_its_closed_form() {
    let known = [(1.0, [0.95269, 0.86392, 0.42924]), (10.0, [0.34794, 0.25541, 0.08851])];
    let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
    let (rule, places) = (gauss(16), [-0.9, 0.0, 0.9]);
    let mut worst = 0.0f64;
    for (half, known) in known {
        let bare =
            HeatedBody::new(half_space.clone(), vec![Conduction::new(1.0, 1.0, 0.0).unwrap()], vec![], 2.0 * half)
                .unwrap();
        let mut sums = [0.0; 3];
        let mut add = |k: f64, weight: f64| {
            let wave = bare.surface_temperature([k, 0.0]) * (2.0 * k.sin() / k * weight / PI);
            for (sum, x) in sums.iter_mut().zip(places) {
                *sum += (wave * Complex64::from_polar(1.0, k * x)).re;
            }
        };
        for panel in 0..20_000 {
            for [x, weight] in &rule {
                let k = f64::from(panel) + 0.5 * (1.0 + x);
                if panel == 0 { add(k * k, k * weight) } else { add(k, 0.5 * weight) }
            }
        }
        for ((sum, x), known) in sums.into_iter().zip(places).zip(known) {
            let closed = moving_band(half, x);
            worst = worst.max((sum - closed).abs());
            assert!((closed - known).abs() < 5.1e-6, "B {half}, x {x}: {closed}");
            assert!((sum - closed).abs() < 1.7e-8, "B {half}, x {x}: {sum} {closed}");
        }
    }
}

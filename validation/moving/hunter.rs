//! Hunter's rolling cylinder (1961): a half-space of one relaxation time at constant ν, plane strain, rederived.
//!
//! C(ω) = C₀(1 + iωτ)/(1 + iωrτ) with ω = −kv, r = E∞/E₀ and C₀ of the relaxed E₀*, R = 1, f = x²/2. With q = p − vτp′,
//!
//! (1 − rvτ ∂ₓ) w′ = −(2/πE₀*) ∫ q/(x − s) ds,
//!
//! which on the contact c ± a is −x + rvτ. So q = (αξ² + βξ + γ)/√(a² − ξ²), ξ = x − c, with α = −E₀*/2, β = E₀*(rvτ − c)/2 and
//! γ = P/π + E₀*a²/4. Two conditions are left. p = 0 at both ends, with z = a/vτ:
//!
//! αa²(I₀ − I₁/z) − βaI₁ + γI₀ = 0;
//!
//! w′ of the leading edge from ahead, where (1 − ℓ ∂ₓ) w′ is known and w′ vanishes far away, with ℓ = rvτ and y = a/ℓ:
//!
//! a + c = (2e^y/(E₀*ℓ)) [αa²(K₀ + K₁/y) + βaK₁ + γK₀] − (2/E₀*) [α(a + ℓ) + β].
//!
//! The friction is −∫ p w′ over the load: μ = c + (πβa²/2 − vτP)/P.

use std::f64::consts::PI;

/// Contact of the cylinder.
#[derive(Debug, Clone, Copy)]
pub struct Hunter {
    /// Half of the width in contact.
    pub half_width: f64,
    /// Place of its middle, ahead of the axis.
    pub shift: f64,
    /// Coefficient of friction.
    pub friction: f64,
}

impl Hunter {
    /// Contact for r, the way vτ and the load P of a length, with R = 1 and E₀* = 1: by bisection between the glassy half-width and the relaxed one.
    pub fn new(ratio: f64, way: f64, load: f64) -> Self {
        let relaxed = (4.0 * load / PI).sqrt();
        let [mut low, mut high] = [relaxed / ratio.sqrt(), relaxed];
        let sign = missing(high, [ratio, way, load]).1.signum();
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if missing(middle, [ratio, way, load]).1.signum() == sign {
                high = middle;
            } else {
                low = middle;
            }
        }
        let half_width = 0.5 * (low + high);
        let beta = missing(half_width, [ratio, way, load]).0;
        let shift = ratio * way - 2.0 * beta;
        let friction = shift + (0.5 * PI * beta * half_width * half_width - way * load) / load;
        Self { half_width, shift, friction }
    }
}

/// β of the first condition, and what the second one misses, at a half-width.
fn missing(a: f64, [ratio, way, load]: [f64; 3]) -> (f64, f64) {
    let (alpha, gamma) = (-0.5, load / PI + 0.25 * a * a);
    let z = a / way;
    let [i0, i1] = [0.0, 1.0].map(|n| bessel_i(n, z));
    let beta = (alpha * a * a * (i0 - i1 / z) + gamma * i0) / (a * i1);
    let length = ratio * way;
    let y = a / length;
    let [k0, k1] = [0.0, 1.0].map(|n| bessel_k(n, y));
    let ahead = 2.0 / length * (alpha * a * a * (k0 + k1 / y) + beta * a * k1 + gamma * k0)
        - 2.0 * (alpha * (a + length) + beta);
    (beta, ahead - (a + length - 2.0 * beta))
}

/// e^{−z} I_n(z) = (1/π) ∫ e^{z(cos θ − 1)} cos nθ dθ: trapezoids of a periodic function.
fn bessel_i(n: f64, z: f64) -> f64 {
    const STEPS: usize = 400;
    let value = |k: usize| {
        let angle = PI * (k as f64 + 0.5) / STEPS as f64;
        (z * (angle.cos() - 1.0)).exp() * (n * angle).cos()
    };
    (0..STEPS).map(value).sum::<f64>() / STEPS as f64
}

/// e^{y} K_n(y) = ∫ e^{−y(cosh t − 1)} cosh nt dt: trapezoids of what falls doubly exponentially.
fn bessel_k(n: f64, y: f64) -> f64 {
    const STEP: f64 = 1.0 / 64.0;
    let value = |k: i32| {
        let t = f64::from(k) * STEP;
        (-2.0 * y * (0.5 * t).sinh().powi(2)).exp() * (n * t).cosh()
    };
    STEP * (0.5 * value(0) + (1..1600).map(value).sum::<f64>())
}

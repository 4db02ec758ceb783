//! Temperatures below sources of heat on a half-space, in closed form or by one integral, and what their images in a periodic cell add.
//!
//! A point of the power Q that moves along +x with v warms the surface at (ξ, y) from it by Q e^{−β(r + ξ)}/(2πλr), β = v/2κ (Rosenthal 1946;
//! Carslaw & Jaeger § 10.7). In polar coordinates around the warmed point one integral of a patch of uniform flux is closed:
//!
//! T = (q/2πλ) ∫ (1 − e^{−βρ(1 − cos φ)})/(β(1 − cos φ)) dφ,  ρ(φ) the way to the edge, φ from +x.
//!
//! A row of points across the motion, W apart, is a series: (Q/πλW) e^{−βξ} Σⱼ cos(kⱼy) K₀(|ξ|√(β² + kⱼ²)), kⱼ = 2πj/W with j = 0 half as much as
//! the pairs ±j.

use crate::moving::strip::gauss;
use std::f64::consts::{PI, TAU};

/// ζ(½) and ζ(3/2).
pub const ZETA: [f64; 2] = [-1.460_354_508_809_586_8, 2.612_375_348_685_488];
/// Σ′ R⁻¹ (continued) and Σ′ R⁻³ of the square lattice.
pub const LATTICE: [f64; 2] = [-3.900_264_920_001_956, 9.033_621_683_100_95];

/// e^{y} K_n(y), n = 0 and 1: trapezoids of ∫ e^{−y(cosh t − 1)} cosh nt dt, which falls doubly exponentially.
pub fn bessel_k(y: f64) -> [f64; 2] {
    // Steps are fine against the width 1/√y of the integrand.
    let step = (1.0 / 64.0f64).min(0.5 / y.sqrt());
    let (mut sums, mut t) = ([0.5; 2], step);
    loop {
        let value = (-2.0 * y * (0.5 * t).sinh().powi(2)).exp();
        sums[0] += value;
        sums[1] += value * t.cosh();
        t += step;
        if value * t.cosh() < 1e-18 || t > 700.0 {
            return sums.map(|sum| step * sum);
        }
    }
}

/// Temperature at x below a band |x| < 1 of the flux 1 that moves over λ = κ = 1 with v = 2B (Jaeger 1942).
pub fn band(half: f64, x: f64) -> f64 {
    let f = |y: f64| {
        if y == 0.0 {
            return 0.0;
        }
        let [k0, k1] = bessel_k(y.abs());
        if y > 0.0 { y * (-2.0 * y).exp() * (k0 - k1) + 1.0 } else { 1.0 + y * (k0 + k1) }
    };
    (f(half * (x + 1.0)) - f(half * (x - 1.0))) / (PI * half)
}

/// Temperature that the images of a band of the flux 1, half-width 1, add at x in a cell of a length, the mean left out: ζ(½) of the wakes.
pub fn band_images(half: f64, period: f64) -> f64 {
    2.0 * (1.0 / (TAU * half * period)).sqrt() * ZETA[0]
}

/// Temperature below a square |x|, |y| < 1 of the flux 1 that moves over λ = 1 with β = v/2κ, at a point within it.
pub fn square(beta: f64, [x, y]: [f64; 2]) -> f64 {
    let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].map(|[a, b]: [f64; 2]| (b - y).atan2(a - x));
    let way = |angle: f64| {
        let to = |edge: f64, part: f64| if part.abs() < 1e-300 { f64::INFINITY } else { edge / part.abs() };
        let (sine, cosine) = angle.sin_cos();
        to(1.0 - x * cosine.signum(), cosine).min(to(1.0 - y * sine.signum(), sine))
    };
    // A point is warmed by what lies ahead of it, in the direction φ: the source is at +ρ(cos φ, sin φ), so that ξ = −ρ cos φ.
    let ahead = |angle: f64| {
        let rate = beta * 2.0 * (0.5 * angle).sin().powi(2);
        let exponent = rate * way(angle);
        if exponent < 1e-12 { way(angle) } else { -(-exponent).exp_m1() / rate }
    };
    let mut edges = vec![-PI, 0.0, PI];
    edges.extend(corners);
    edges.sort_by(f64::total_cmp);
    // Panels that halve towards φ = 0, where the exponent passes 1 within √(1/β).
    let panels = edges.windows(2).flat_map(|pair| graded(pair[0], pair[1]));
    panels.map(|[from, length]| gauss(ahead, from, length)).sum::<f64>() / TAU
}

/// Panels of an interval that does not contain 0 inside, half as long at each step towards 0 where it ends there.
fn graded(from: f64, to: f64) -> Vec<[f64; 2]> {
    const HALVINGS: i32 = 24;
    let length = to - from;
    if length < 1e-14 {
        return Vec::new();
    }
    let at = |part: f64| if to.abs() < from.abs() { to - length * part } else { from + length * part };
    let parts: Vec<f64> = (0..=HALVINGS).rev().map(|n| 0.5f64.powi(n)).collect();
    let all = std::iter::once(0.0).chain(parts).collect::<Vec<_>>();
    all.windows(2).map(|pair| [at(pair[0]).min(at(pair[1])), (at(pair[1]) - at(pair[0])).abs()]).collect()
}

/// Temperature that the images of a source of the power 1, |y| < 1, in a square cell add at x behind (below 0) or ahead of it, on its track, λ = 1, the mean
/// left out.
///
/// Rows across the motion at the distances nL by their series, the own row point by point, and the mean by the integral over the uniform part
/// of all rows.
pub fn images(beta: f64, side: f64, x: f64) -> f64 {
    let wave = TAU / side;
    let uniform = |xi: f64| {
        let [k0, _] = bessel_k(beta * xi.abs());
        k0 * if xi > 0.0 { (-2.0 * beta * xi).exp() } else { 1.0 } / (PI * side)
    };
    let row = |xi: f64| {
        let of = |j: f64| {
            let rate = beta.hypot(wave * j);
            // √(β² + k²) − β without cancellation.
            let exponent = (wave * j).powi(2) / (rate + beta) * xi.abs() + if xi > 0.0 { 2.0 * beta * xi } else { 0.0 };
            if exponent > 45.0 { 0.0 } else { 2.0 * bessel_k(rate * xi.abs())[0] * (-exponent).exp() / (PI * side) }
        };
        let all = (1..).map(f64::from).map(|j| (j, of(j))).take_while(|(_, value)| *value > 1e-18);
        // The mean over |y| < 1 damps a wave by sin k/k.
        uniform(xi) + all.map(|(j, value)| value * (wave * j).sin() / (wave * j)).sum::<f64>()
    };
    // The images that are ahead of x lie at ξ = x − nL < 0, as far as their tracks have not become one.
    let count = (90.0 * beta / (wave * wave * side)).max(400.0).ceil();
    let rows: f64 = (1..=count as i32).map(|n| row(x - f64::from(n) * side)).sum();
    let behind: f64 = (1..=3).map(|n| row(x + f64::from(n) * side)).sum();
    let own = |m: f64| {
        let r = x.hypot(m * side);
        2.0 * (-beta * (r + x)).exp() / (TAU * r)
    };
    let own: f64 = (1..).map(|m| own(f64::from(m))).take_while(|value| *value > 1e-18).sum();
    rows + behind + own - mean(beta, side, count + 0.5) + tail(beta, side, x, count + 0.5)
}

/// (1/L) ∫ of the uniform part of a row, from far behind to `end` rows ahead: ∫₀^y e^{t}K₀ dt = ye^{y}(K₀ + K₁) − 1, ∫₀^∞ e^{−t}K₀ dt = 1.
fn mean(beta: f64, side: f64, end: f64) -> f64 {
    let y = beta * end * side;
    let [k0, k1] = bessel_k(y);
    y * (k0 + k1) / (PI * side * side * beta)
}

/// Rows beyond `end` less their integral by the midpoint rule, fx/L + f′L/24 of f ≈ cξ^{−1/2}.
fn tail(beta: f64, side: f64, x: f64, end: f64) -> f64 {
    let far = end * side;
    let value = (PI / (2.0 * beta * far)).sqrt() / (PI * side);
    value * x / side - 0.5 * value / far * side / 24.0
}

//! Adaptive quadrature, and integrals with a Bessel function under the integral sign.
//!
//! Each interval has its Gauss–Kronrod estimate (7, 15 points) and is halved where both rules differ. An integral
//!
//! ∫₀^∞ f(q) J(qr) dq,  J = J₀, J₁ or J₂,
//!
//! of a function that is negligible beyond a known q is divided geometrically up to the first zero of J and at its zeros
//! beyond. Where there are many of them the partial sums alternate about the integral, and Wynn's ε-algorithm finds
//! the limit from a few (Lucas & Stone, J. Comput. Appl. Math. 64 (1995) 217–231).

use std::f64::consts::PI;

/// A value with its estimated error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Estimate {
    /// Value of the integral.
    pub value: f64,
    /// Estimated absolute error.
    pub error: f64,
}

impl Estimate {
    fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, error: self.error + other.error }
    }
}

/// Abscissae of the 15-point Kronrod rule from the outermost to the centre; every second one belongs to Gauss' rule.
const ABSCISSAE: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Weights of the Kronrod rule.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];
/// Weights of the Gauss rule.
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// Largest number of halvings of an interval.
const MAX_HALVINGS: u32 = 16;

/// ∫ f from a to b, its error held below `tolerance` times the integral of |f| or `scale`, whichever is larger.
pub fn integrate(f: &impl Fn(f64) -> f64, [a, b]: [f64; 2], scale: f64, tolerance: f64) -> Estimate {
    halved(f, [a, b], scale, tolerance, MAX_HALVINGS)
}

fn halved(f: &impl Fn(f64) -> f64, [a, b]: [f64; 2], scale: f64, tolerance: f64, depth: u32) -> Estimate {
    let (centre, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut kronrod, mut gauss, mut size) = (0.0, 0.0, 0.0);
    for (i, (x, weight)) in ABSCISSAE.iter().zip(KRONROD).enumerate() {
        let values = if i == 7 { [f(centre), 0.0] } else { [f(centre - half * x), f(centre + half * x)] };
        let sum = values[0] + values[1];
        kronrod += weight * sum;
        size += weight * (values[0].abs() + values[1].abs());
        if i % 2 == 1 {
            gauss += GAUSS[i / 2] * sum;
        }
    }
    // Piessens' estimate: the Kronrod rule is far more accurate than the difference of both rules.
    let difference = (kronrod - gauss).abs();
    let ratio = 200.0 * difference / size.max(f64::MIN_POSITIVE);
    let error = half * if ratio < 1.0 { difference.min(size * ratio.powf(1.5)) } else { difference };
    let whole = Estimate { value: half * kronrod, error };
    if depth == 0 || error <= tolerance * (half * size).max(scale) {
        return whole;
    }
    let part = |ends| halved(f, ends, scale, tolerance, depth - 1);
    part([a, centre]).plus(part([centre, b]))
}

/// Bessel function under an integral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bessel {
    /// J₀.
    Zero,
    /// J₁.
    One,
    /// J₂.
    Two,
}

impl Bessel {
    /// J(x).
    pub fn at(self, x: f64) -> f64 {
        match self {
            Self::Zero => libm::j0(x),
            Self::One => libm::j1(x),
            Self::Two => libm::jn(2, x),
        }
    }

    /// Approximate k-th positive zero, k ≥ 1 (McMahon).
    fn zero(self, k: usize) -> f64 {
        let beta = match self {
            Self::Zero => k as f64 - 0.25,
            Self::One => k as f64 + 0.25,
            Self::Two => k as f64 + 0.75,
        };
        beta * PI
    }
}

/// Ratio of successive intervals from q = 0.
const INTERVAL_RATIO: f64 = 0.25;
/// Number of intervals from q = 0 to the first zero.
const INTERVALS: i32 = 18;
/// Least number of zeros below the end for which the sum is extrapolated.
const MIN_EXTRAPOLATED_ZEROS: usize = 40;
/// Number of successive extrapolations that must agree to a third of the tolerance, relative to the largest partial sum.
const MIN_AGREEMENTS: usize = 3;

/// ∫₀^`end` f(q) J(qr) dq, f negligible beyond `end`, to the relative `tolerance`, which must exceed the rounding noise of f.
pub fn hankel(bessel: Bessel, r: f64, end: f64, tolerance: f64, f: impl Fn(f64) -> f64) -> Estimate {
    let integrand = |q: f64| f(q) * bessel.at(q * r);
    let first = if r > 0.0 { end.min(bessel.zero(1) / r) } else { end };
    let ends = |k: i32| {
        [if k == INTERVALS { 0.0 } else { first * INTERVAL_RATIO.powi(k) }, first * INTERVAL_RATIO.powi(k - 1)]
    };
    // A nearly zero f is rounding noise, which has to be judged by the size of the whole integral.
    let scale = (1..=INTERVALS).map(|k| integrate(&integrand, ends(k), f64::INFINITY, tolerance).value.abs());
    let scale = scale.fold(0.0, f64::max);
    let mut sum = Estimate::default();
    for k in (1..=INTERVALS).rev() {
        sum = sum.plus(integrate(&integrand, ends(k), scale, tolerance));
    }
    if first == end {
        return sum;
    }
    let few = bessel.zero(MIN_EXTRAPOLATED_ZEROS) / r >= end;
    let mut partial = Wynn::default();
    partial.add(sum.value);
    let (mut last, mut agreed, mut k) = (f64::NAN, 0, 1);
    let mut largest = sum.value.abs();
    loop {
        let (lower, upper) = (bessel.zero(k) / r, bessel.zero(k + 1) / r);
        sum = sum.plus(integrate(&integrand, [lower, upper.min(end)], scale, tolerance));
        if upper >= end {
            return sum;
        }
        if !few {
            let limit = partial.add(sum.value);
            let change = (limit - last).abs();
            largest = largest.max(sum.value.abs());
            agreed = if change <= 0.3 * tolerance * largest { agreed + 1 } else { 0 };
            if agreed == MIN_AGREEMENTS {
                return Estimate { value: limit, error: sum.error + change.max(0.3 * tolerance * largest) };
            }
            last = limit;
        }
        k += 1;
    }
}

/// Wynn's ε-algorithm over the latest partial sums.
#[derive(Debug, Default)]
struct Wynn {
    /// Latest ascending diagonal of the ε-table.
    diagonal: Vec<f64>,
}

/// Largest number of columns of the ε-table.
const WYNN_COLUMNS: usize = 24;

impl Wynn {
    /// Adds a partial sum; returns the extrapolated limit.
    fn add(&mut self, sum: f64) -> f64 {
        let mut diagonal = vec![sum];
        for (k, &before) in self.diagonal.iter().take(WYNN_COLUMNS).enumerate() {
            let difference = diagonal[k] - before;
            if difference == 0.0 {
                break;
            }
            let older = if k == 0 { 0.0 } else { self.diagonal[k - 1] };
            diagonal.push(older + 1.0 / difference);
        }
        self.diagonal = diagonal;
        let even = (self.diagonal.len() - 1) / 2 * 2;
        self.diagonal[even]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_and_sharp_integrands_are_integrated_within_the_error_shown() {
        let smooth = integrate(&|x: f64| x.exp(), [0.0, 1.0], 0.0, 1e-13);
        assert!((smooth.value - (1f64.exp() - 1.0)).abs() < 1e-15);
        let sharp = integrate(&|x: f64| 1e-3 / (1e-6 + x * x), [-1.0, 2.0], 0.0, 1e-13);
        let exact = 2e3f64.atan() + 1e3f64.atan();
        assert!((sharp.value - exact).abs() < 1e-12 && sharp.error < 1e-11, "{sharp:?}");
    }

    /// ∫ e^{−cq} J₀(qr) dq = 1/√(c²+r²), ∫ e^{−cq} J₁(qr) dq = (1 − c/√(c²+r²))/r.
    #[test]
    fn transforms_of_the_exponential_have_their_closed_forms_near_and_far() {
        for r in [0.0, 0.1, 1.0, 7.0, 50.0, 1e3, 1e5] {
            let c = 1.0;
            let root = f64::hypot(c, r);
            let zero = hankel(Bessel::Zero, r, 40.0, 1e-13, |q| (-c * q).exp());
            assert!((zero.value * root - 1.0).abs() < 1e-12, "J0 at {r}: {zero:?} {}", 1.0 / root);
            assert!(zero.error * root < 1e-10, "{zero:?}");
            if r > 0.0 {
                let one = hankel(Bessel::One, r, 40.0, 1e-13, |q| (-c * q).exp());
                let exact = r / (root * (root + c));
                assert!((one.value / exact - 1.0).abs() < 1e-12, "J1 at {r}: {one:?} {exact}");
            }
        }
    }

    #[test]
    fn structure_at_a_small_wavenumber_is_found() {
        // ∫ b/(b²+q²)… has no closed form with J₀; its counterpart ∫ q/(q²+b²)^{3/2} J₀(qr) dq = e^{−br}/b has.
        let b = 1e-3;
        for r in [1.0, 30.0, 400.0] {
            let found = hankel(Bessel::Zero, r, 1e4, 1e-13, |q| q / (q * q + b * b).powf(1.5));
            let exact = (-b * r).exp() / b;
            assert!((found.value / exact - 1.0).abs() < 1e-8, "{r}: {found:?} {exact}");
        }
    }
}

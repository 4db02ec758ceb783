//! States of a body that creeps at few frequencies, and the few of them that span all.
//!
//! f(s) = Σ Aⱼ/(1 + sθⱼ) = **b**ᵀ(s + Λ)⁻¹**b** with Λ = diag 1/θⱼ and bⱼ² = Aⱼ/θⱼ. The states **x**ᵢ = (sᵢ + Λ)⁻¹**b** at places sᵢ = iωᵢ are not
//! known, but values and slopes of f are all that their products need (Löwner's matrices),
//!
//! **x**ᵢᵀ**x**ₖ = −(fᵢ − fₖ)/(sᵢ − sₖ),  **x**ᵢᵀΛ**x**ₖ = (sᵢfᵢ − sₖfₖ)/(sᵢ − sₖ),  **b**ᵀ**x**ᵢ = fᵢ,
//!
//! −f′ and (sf)′ for i = k, and with s̄ᵢ, f̄ᵢ for **x̄**ᵢ. Cholesky's decomposition with pivots chooses real and imaginary parts of states until
//! what is left of all others is rounding.

use rustfft::num_complex::Complex64;

/// Square of what is left of a state outside the span, below which it counts as rounding; no state is much longer than one.
const LEFT: f64 = 1e-12;
/// Frequency, over the least one, below which states are measured as at it: they are then those of a load held for long.
const SLOW: f64 = 10.0;

/// Compliance at one place, and its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Laplace variable s = iω, one over a time, ω > 0.
    pub place: Complex64,
    /// C(s), a length per pressure.
    pub value: Complex64,
    /// dC/ds, a length times a time per pressure.
    pub slope: Complex64,
}

/// Real or imaginary part of the state at a sample, in a unit in which it is not much longer than one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct State {
    sample: Sample,
    is_imaginary: bool,
    unit: f64,
}

impl State {
    /// Both parts of the states at samples of ascending frequencies.
    fn all(samples: &[Sample]) -> Vec<Self> {
        let slow = samples.first().map_or(0.0, |sample| SLOW * sample.place.norm());
        let unit = |sample: &Sample| (sample.value.norm() / sample.place.norm().max(slow)).sqrt();
        let both =
            |&sample: &Sample| [false, true].map(|is_imaginary| Self { sample, is_imaginary, unit: unit(&sample) });
        samples.iter().flat_map(both).collect()
    }

    /// **b**ᵀ**x**.
    pub fn load(&self, glassy: f64) -> f64 {
        let Complex64 { re, im } = self.sample.value - glassy;
        if self.is_imaginary { im / self.unit } else { re / self.unit }
    }

    /// **x**ᵀ**y**.
    fn product(&self, other: &Self) -> f64 {
        let of = |sample: &Sample| -sample.value;
        self.parts(other, of, -self.sample.slope)
    }

    /// **x**ᵀΛ**y**.
    pub fn weighted(&self, other: &Self, glassy: f64) -> f64 {
        let of = |sample: &Sample| sample.place * (sample.value - glassy);
        let Sample { place, value, slope } = self.sample;
        self.parts(other, of, value - glassy + place * slope)
    }

    /// Product of the parts of states of which the whole have (gᵢ − gₖ)/(sᵢ − sₖ) with a function g of the samples, of given slope here.
    fn parts(&self, other: &Self, of: impl Fn(&Sample) -> Complex64, slope: Complex64) -> f64 {
        let [x, y] = [self, other].map(|state| state.sample.place);
        let [g, h] = [self, other].map(|state| of(&state.sample));
        let plain = if x == y { slope } else { (g - h) / (x - y) };
        let conjugate = (g.conj() - h) / (x.conj() - y);
        let product = match (self.is_imaginary, other.is_imaginary) {
            (false, false) => plain.re + conjugate.re,
            (false, true) => plain.im + conjugate.im,
            (true, false) => plain.im - conjugate.im,
            (true, true) => conjugate.re - plain.re,
        };
        0.5 * product / (self.unit * other.unit)
    }
}

/// States that span all others, by ascending frequencies.
#[derive(Debug)]
pub(super) struct Span {
    pub states: Vec<State>,
    /// Rows of the lower triangle T of XᵀX = TTᵀ. By ascending frequencies T⁻¹ XᵀΛX T⁻ᵀ has small elements where rates are small.
    triangle: Vec<Vec<f64>>,
}

impl Span {
    /// Span of the states at samples of ascending frequencies.
    pub fn of(samples: &[Sample]) -> Self {
        let mut span = Self { states: Vec::new(), triangle: Vec::new() };
        for state in chosen(&State::all(samples)) {
            let mut row = span.forward(span.states.iter().map(|other| state.product(other)));
            let rest = state.product(&state) - row.iter().map(|x| x * x).sum::<f64>();
            if rest > 0.0 {
                row.push(rest.sqrt());
                span.triangle.push(row);
                span.states.push(state);
            }
        }
        span
    }

    /// Solution of T**y** = **r**.
    pub fn forward(&self, right: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut solution: Vec<f64> = Vec::with_capacity(self.triangle.len() + 1);
        for (row, value) in self.triangle.iter().zip(right) {
            let known: f64 = row.iter().zip(&solution).map(|(x, y)| x * y).sum();
            solution.push((value - known) / row[solution.len()]);
        }
        solution
    }
}

/// States of which, next to those chosen before, most was left; in the order of all.
fn chosen(states: &[State]) -> Vec<State> {
    let mut left: Vec<f64> = states.iter().map(|state| state.product(state)).collect();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut indices = Vec::new();
    while let Some((index, pivot)) = left.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) {
        if pivot.is_nan() || pivot < LEFT {
            break;
        }
        let mut column: Vec<f64> = states.iter().map(|state| states[index].product(state)).collect();
        for other in &columns {
            let factor = other[index];
            column.iter_mut().zip(other).for_each(|(x, y)| *x -= factor * y);
        }
        let scale = pivot.sqrt().recip();
        column.iter_mut().for_each(|x| *x *= scale);
        left.iter_mut().zip(&column).for_each(|(left, x)| *left -= x * x);
        left[index] = 0.0;
        columns.push(column);
        indices.push(index);
    }
    indices.sort_unstable();
    indices.into_iter().map(|index| states[index]).collect()
}

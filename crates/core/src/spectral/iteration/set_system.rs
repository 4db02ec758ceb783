//! Linear equations on a set of samples: A x = r + const in the set, x = 0 elsewhere, Σ x = 0, A not symmetric; or A x = r with any Σ x.
//!
//! Generalised conjugate residuals (Eisenstat, Elman & Schultz, SIAM J. Numer. Anal. 20 (1983) 345), preconditioned from the right by P A⁻¹ P,
//! P the restriction to the set: with the residual r, freed of its mean in the set,
//!
//! z = P A⁻¹ r − c P A⁻¹ P 1, c so that Σ z = 0;  v = P A z, freed of its mean;
//! z, v are made orthogonal to the v before; x += z ⟨r, v⟩/⟨v, v⟩, r −= v ⟨r, v⟩/⟨v, v⟩.
//!
//! The residual falls at every step. Vectors hold the samples of the set alone.

use crate::numeric::sums;

/// Most steps.
const MAX_STEPS: usize = 12;

/// Operators of the equations: A and A⁻¹ on fields of all samples, in place.
pub trait Invertible {
    /// x → A x.
    fn apply(&mut self, field: &mut [f64]);
    /// y → A⁻¹ y, of any mean.
    fn invert(&mut self, field: &mut [f64]);
}

/// A set of samples.
#[derive(Debug, Clone)]
pub struct SampleSet {
    /// Numbers of the samples, ascending.
    samples: Vec<u32>,
    /// Number of all samples.
    whole: usize,
}

/// Solution of the equations.
#[derive(Debug)]
pub struct SetSolution {
    /// x in the set.
    pub change: Vec<f64>,
    /// Steps taken.
    pub steps: usize,
}

impl SampleSet {
    /// The samples, of a number of them, that a condition holds for.
    pub fn of(whole: usize, is_inside: impl Fn(usize) -> bool) -> Self {
        Self { samples: (0..whole).filter(|&i| is_inside(i)).map(|i| i as u32).collect(), whole }
    }

    /// Number of samples in the set.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Values of a field in the set.
    pub fn gathered(&self, field: &[f64]) -> Vec<f64> {
        self.samples.iter().map(|&i| field[i as usize]).collect()
    }

    /// Number of each sample of the set, in the order of [gathered](Self::gathered) values.
    pub fn samples(&self) -> impl Iterator<Item = usize> {
        self.samples.iter().map(|&i| i as usize)
    }

    /// The field with these values in the set, zero elsewhere.
    fn spread(&self, values: &[f64]) -> Vec<f64> {
        let mut field = vec![0.0; self.whole];
        self.samples().zip(values).for_each(|(i, &value)| field[i] = value);
        field
    }

    /// Values in the set of what a step makes of a field that is zero outside of it.
    fn through(&self, values: &[f64], step: impl FnOnce(&mut [f64])) -> Vec<f64> {
        let mut field = self.spread(values);
        step(&mut field);
        self.gathered(&field)
    }

    /// Solves A x = r + const in the set with Σ x = 0 from the values r, until |r| has fallen to a `part`; `None` where a step gains nothing.
    pub fn solve(&self, right: Vec<f64>, part: f64, operator: &mut impl Invertible) -> Option<SetSolution> {
        let uniform = self.through(&vec![1.0; self.len()], |field| operator.invert(field));
        let sum = total(&uniform);
        let balanced = |z: &mut Vec<f64>| {
            let excess = total(z) / sum;
            sums::update(z, |i, z| z - excess * uniform[i]);
        };
        let (found, is_met) = self.residuals(without_mean(right), part, operator, balanced, without_mean);
        is_met.then_some(found)
    }

    /// Solves A x = r in the set with any Σ x from the values r, until |r| has fallen to a `part`, or as far as a number of steps goes.
    pub fn solve_freely(&self, right: Vec<f64>, part: f64, operator: &mut impl Invertible) -> SetSolution {
        self.residuals(right, part, operator, |_| (), |v| v).0
    }

    /// Conjugate residuals, with what makes a direction and its image admissible; whether the part was met.
    fn residuals(
        &self,
        mut residual: Vec<f64>,
        part: f64,
        operator: &mut impl Invertible,
        balanced: impl Fn(&mut Vec<f64>),
        freed: impl Fn(Vec<f64>) -> Vec<f64>,
    ) -> (SetSolution, bool) {
        let least = part * norm(&residual);
        let mut change = vec![0.0; self.len()];
        let mut before: Vec<[Vec<f64>; 2]> = Vec::new();
        while norm(&residual) > least {
            let mut z = self.through(&residual, |field| operator.invert(field));
            balanced(&mut z);
            let mut v = freed(self.through(&z, |field| operator.apply(field)));
            for [z1, v1] in &before {
                let overlap = dot(&v, v1);
                sums::update(&mut v, |i, x| x - overlap * v1[i]);
                sums::update(&mut z, |i, x| x - overlap * z1[i]);
            }
            let scale = norm(&v).recip();
            let length = dot(&residual, &v) * scale * scale;
            if !length.is_finite() || before.len() == MAX_STEPS {
                return (SetSolution { change, steps: before.len() }, false);
            }
            sums::update(&mut change, |i, x| x + length * z[i]);
            sums::update(&mut residual, |i, r| r - length * v[i]);
            for vector in [&mut z, &mut v] {
                sums::update(vector, |_, x| scale * x);
            }
            before.push([z, v]);
        }
        (SetSolution { change, steps: before.len() }, true)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let [sum] = sums::of(a.len(), |i| [a[i] * b[i]]);
    sum
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn total(a: &[f64]) -> f64 {
    let [sum] = sums::of(a.len(), |i| [a[i]]);
    sum
}

fn without_mean(mut a: Vec<f64>) -> Vec<f64> {
    let mean = sums::mean(&a);
    sums::update(&mut a, |_, x| x - mean);
    a
}

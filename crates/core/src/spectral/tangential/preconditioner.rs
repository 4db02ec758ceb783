//! The preconditioner by levels of the curvature λ of slipping samples.
//!
//! Where a sample slips the Hessian is A + λ on the tangent of its circle, and λ = |**s**|/m grows without bound toward the edge of contact:
//! A⁻¹ alone would be far from it there. With a partition of unity Σ χ_j² = 1 in ln λ,
//!
//! M = Σ_j χ_j (A + λ_j)⁻¹ χ_j + χ_∞² /λ,
//!
//! λ₀ = 0 for samples that stick or slip little, λ_j = 4A_min·4^{j−1} up to ¼A_max, and beyond it the diagonal. A_min and A_max are the least
//! and the largest of the compliances on the grid. M is symmetric and positive.

use super::disc::{State, Vector, add, scale};
use super::operator::TangentialOperator;
use crate::numeric::sums;
use crate::spectral::convolution::ShearMultiplier;

/// Ratio of neighbouring levels of λ.
const RATIO: f64 = 4.0;

/// (A + λ_j)⁻¹ at each level.
#[derive(Debug)]
pub(super) struct Preconditioner {
    levels: Vec<ShearMultiplier>,
    /// λ₁.
    first: f64,
}

impl Preconditioner {
    /// Levels for an operator.
    pub fn new(operator: &TangentialOperator) -> Self {
        let [least, largest] = operator.range();
        let first = RATIO * least;
        let slipping =
            std::iter::successors(Some(first), |lambda| Some(RATIO * lambda)).take_while(|l| *l <= 0.25 * largest);
        let levels = std::iter::once(0.0).chain(slipping).map(|lambda| operator.inverse(lambda)).collect();
        Self { levels, first }
    }

    /// Weight of a sample in sums over all that may change, 1 where it sticks and λ₁/(λ₁ + λ) where it slips: near the edge of contact a
    /// traction changes far less than its slip, and would shift all others.
    pub fn share(&self, state: State) -> f64 {
        self.first / (self.first + state.curvature())
    }

    /// M **r**, projected onto what the tractions may change by.
    pub fn apply(
        &self,
        operator: &mut TangentialOperator,
        residual: &[Vector],
        sample: impl Fn(usize) -> (State, Vector) + Sync,
        rows: impl Fn(usize) -> bool + Sync,
    ) -> Vec<Vector> {
        let len = residual.len();
        let mut sum = vec![[0.0; 2]; len];
        sums::update(&mut sum, |i, _| {
            let (state, _) = sample(i);
            let lambda = state.curvature();
            let weight = self.weight(self.levels.len(), state);
            if weight > 0.0 { scale(weight * weight / lambda, residual[i]) } else { [0.0; 2] }
        });
        for (level, inverse) in self.levels.iter().enumerate() {
            let mut part = vec![[0.0; 2]; len];
            sums::update(&mut part, |i, _| {
                let weight = self.weight(level, sample(i).0);
                if weight > 0.0 { scale(weight, residual[i]) } else { [0.0; 2] }
            });
            let [any] = sums::of(len, |i| [f64::from(u8::from(part[i] != [0.0; 2]))]);
            if any == 0.0 {
                continue;
            }
            operator.invert(inverse, &mut part, &rows);
            sums::update(&mut sum, |i, sum| add(sum, scale(self.weight(level, sample(i).0), part[i])));
        }
        sums::update(&mut sum, |i, z| {
            let (state, q) = sample(i);
            state.tangent(z, q)
        });
        sum
    }

    /// χ_j of a level, χ_∞ of the number after the last.
    fn weight(&self, level: usize, state: State) -> f64 {
        let place = match state {
            State::Apart => return 0.0,
            State::Sticks => 0.0,
            State::Slips(lambda) => {
                (1.0 + (lambda / self.first).ln() / RATIO.ln()).clamp(0.0, self.levels.len() as f64)
            }
        };
        (1.0 - (place - level as f64).abs()).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Bodies, HalfSpace, Material};
    use crate::lattice::{Cell, Grid};

    fn operator(n: usize) -> TangentialOperator {
        let body = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
        let grid = Grid::new(Cell::square(1.0).unwrap(), [n, n]).unwrap();
        TangentialOperator::new(&grid, &Bodies::elastic(body.clone(), body), true)
    }

    #[test]
    fn weights_are_a_partition_of_unity_on_few_levels() {
        for (n, count) in [(64, 3), (128, 3), (256, 4), (512, 4)] {
            let preconditioner = Preconditioner::new(&operator(n));
            assert_eq!(preconditioner.levels.len(), count, "N = {n}, with that of λ = 0");
            let lambdas = (0..60).map(|k| State::Slips(1e-6 * 2f64.powi(k)));
            for state in lambdas.chain([State::Sticks]) {
                let sum: f64 = (0..=count).map(|level| preconditioner.weight(level, state).powi(2)).sum();
                assert!((sum - 1.0).abs() < 1e-15, "{state:?}: {sum}");
            }
            assert_eq!(preconditioner.weight(count, State::Sticks), 0.0);
        }
    }

    /// On random residuals: ⟨a, Mb⟩ = ⟨b, Ma⟩ and ⟨a, Ma⟩ > 0.
    #[test]
    fn the_preconditioner_is_symmetric_and_positive() {
        let mut operator = operator(24);
        let preconditioner = Preconditioner::new(&operator);
        let number = |k: usize| ((k * 7919 + k * k * 131) % 1009) as f64 / 1009.0 - 0.4;
        let sample = |i: usize| {
            let state = match i % 4 {
                0 => State::Apart,
                1 => State::Sticks,
                _ => State::Slips(1e-3 * 1.05f64.powi((i % 200) as i32)),
            };
            (state, [number(3 * i), number(5 * i) + 1.0])
        };
        let field = |seed: usize| -> Vec<Vector> {
            (0..576).map(|i| sample(i).0.tangent([number(i + seed), number(2 * i + seed)], sample(i).1)).collect()
        };
        let (a, b) = (field(1), field(500));
        let [ma, mb] = [&a, &b].map(|r| preconditioner.apply(&mut operator, r, sample, |_| true));
        let product =
            |u: &[Vector], v: &[Vector]| -> f64 { u.iter().zip(v).map(|(u, v)| super::super::disc::dot(*u, *v)).sum() };
        let scale = (product(&a, &ma) * product(&b, &mb)).sqrt();
        assert!(product(&a, &ma) > 0.0 && product(&b, &mb) > 0.0);
        assert!((product(&a, &mb) - product(&b, &ma)).abs() < 1e-13 * scale);
    }
}

//! One step of partial slip on a grid: the tractions that stick or slip by Coulomb's law under a given pressure.
//!
//! With m = μp, **u**₀ the tangential displacement of the step before and **b** = **u**₀ − Bp, the tractions minimise
//!
//! ½⟨**q**, A**q**⟩ − ⟨**b** + **d**, **q**⟩ on the discs |**q**| ≤ m,
//!
//! with the rise **d** of the shift given, or as the multiplier of a given force. The slip of the step is **s** = **d** + **b** − A**q**: zero where
//! |**q**| < m, along **q** where |**q**| = m, which is Coulomb's law by an implicit Euler step.
//!
//! Conjugate gradients projected onto the discs: on slipping samples the direction keeps its part along the circle, whose curvature λ stands in
//! the step and in the [preconditioner](super::preconditioner). Under a given force **d** leaves no resultant of the residual, and the
//! direction has none: both by the same weights, so that the projection is symmetric. Each iteration takes two convolutions of A and as many of
//! the preconditioner as it has levels.

use super::disc::{State, Vector, add, dot, length, projected, scale, solve, sub};
use super::operator::TangentialOperator;
use super::preconditioner::Preconditioner;
use crate::numeric::{parallel, sums};

/// Passes in which the multiplier of the force and the slipping samples are found together.
const MULTIPLIER_PASSES: usize = 3;
/// Most passes to the multiplier with the least gap, the change that ends them and the least slip in them, both over the mean slip.
const GAP_PASSES: usize = 24;
const GAP_TOLERANCE: f64 = 1e-4;
const LEAST_SLIP: f64 = 1e-9;
/// Ratio of the gaps of both multipliers from which on the one with the least gap is taken.
const GAP_RATIO: f64 = 4.0;
/// Passes that bring the tractions to their force, and the part of all friction that is left of it.
const BALANCE_PASSES: usize = 200;
const BALANCE_TOLERANCE: f64 = 1e-14;

/// Tangential force or shift of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShearControl {
    /// Tangential force on the body, on the cell or on the isolated contact, in the unit of pressure times length².
    Force(Vector),
    /// Rise of the shift of the counterbody against the body since the step before, a length.
    Shift(Vector),
}

/// When the iteration of a step ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipSettings {
    /// Largest gap of the certificate, over Σm max|**d** + **b**|.
    pub tolerance: f64,
    /// Largest number of iterations.
    pub max_iterations: usize,
}

impl Default for SlipSettings {
    fn default() -> Self {
        Self { tolerance: 1e-8, max_iterations: 400 }
    }
}

/// How the iteration of a step has ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipReport {
    /// Whether the gap is below the tolerance.
    pub converged: bool,
    /// Iterations.
    pub iterations: usize,
    /// Convolutions of pairs of fields.
    pub convolutions: f64,
    /// Gap 𝒢 = Σ(m|**s**| − **q**·**s**)ΔA ≥ 0, an energy: what Coulomb's law would dissipate in this slip less what the tractions did.
    pub gap: f64,
    /// The gap over Σm max|**d** + **b**| ΔA.
    pub relative_gap: f64,
}

/// A step on a grid of samples.
pub(in crate::spectral) struct StickSlip<'a> {
    pub operator: &'a mut TangentialOperator,
    pub preconditioner: &'a Preconditioner,
    /// m = μp, a pressure, one value per sample.
    pub bound: &'a [f64],
    /// **b**, a length, one vector per sample.
    pub before: &'a [Vector],
    pub control: ShearControl,
    /// A value near **d** of a given force, where one is known.
    pub near: Option<Vector>,
    /// Area of a sample.
    pub area: f64,
    pub settings: SlipSettings,
}

/// Tractions and slip of a step.
#[derive(Debug, Clone)]
pub(in crate::spectral) struct Slipped {
    /// **q** on the body, a pressure.
    pub traction: Vec<Vector>,
    /// A**q**, a length, on all samples.
    pub displacement: Vec<Vector>,
    /// **s** where there is pressure, a length; zero elsewhere.
    pub slip: Vec<Vector>,
    /// **d**, a length.
    pub rise: Vector,
    pub report: SlipReport,
}

/// Direction of the last iteration with its residual and preconditioned residual.
struct Last {
    direction: Vec<Vector>,
    residual: Vec<Vector>,
    product: f64,
}

impl StickSlip<'_> {
    /// The tractions, from a start that may be any: of the step before, or zero.
    pub fn solve(mut self, start: &[Vector]) -> Slipped {
        let before = self.operator.convolutions();
        let mut traction = self.admissible(start);
        let mut gradient = self.gradient(&traction);
        let (mut last, mut iterations, mut near) = (None, 0, self.near);
        let (rise, [gap, scale]) = loop {
            let (rise, gap) = self.rise(&traction, &gradient, near);
            near = Some(rise);
            let [gap_sum, scale] = gap;
            if gap_sum <= self.settings.tolerance * scale || iterations == self.settings.max_iterations {
                break (rise, gap);
            }
            last = Some(self.advance(&mut traction, &gradient, rise, last));
            gradient = self.gradient(&traction);
            iterations += 1;
        };
        let slip = (0..traction.len()).map(|i| self.slip(i, &gradient, rise)).collect();
        let mut displacement = traction.clone();
        self.operator.displace(&mut displacement, |_| true);
        let report = SlipReport {
            converged: gap <= self.settings.tolerance * scale,
            iterations,
            convolutions: self.operator.convolutions() - before,
            gap: gap * self.area,
            relative_gap: if scale > 0.0 { gap / scale } else { 0.0 },
        };
        Slipped { traction, displacement, slip, rise, report }
    }

    /// Number of samples.
    fn len(&self) -> usize {
        self.bound.len()
    }

    /// **s** = **d** − **g** on a sample under pressure.
    fn slip(&self, i: usize, gradient: &[Vector], rise: Vector) -> Vector {
        if self.bound[i] > 0.0 { sub(rise, gradient[i]) } else { [0.0; 2] }
    }

    fn state(&self, i: usize, traction: &[Vector], gradient: &[Vector], rise: Vector) -> State {
        State::of(traction[i], self.bound[i], sub(rise, gradient[i]))
    }

    /// Whether a row of the grid has pressure anywhere.
    fn rows(&self) -> impl Fn(usize) -> bool + Sync + use<> {
        let columns = self.operator.columns();
        let pressed: Vec<bool> = self.bound.chunks(columns).map(|row| row.iter().any(|m| *m > 0.0)).collect();
        move |row| pressed[row]
    }

    /// **g** = A**q** − **b** where there is pressure.
    fn gradient(&mut self, traction: &[Vector]) -> Vec<Vector> {
        let (mut gradient, rows) = (traction.to_vec(), self.rows());
        self.operator.displace(&mut gradient, rows);
        sums::update(&mut gradient, |i, u| if self.bound[i] > 0.0 { sub(u, self.before[i]) } else { [0.0; 2] });
        gradient
    }

    /// A start on the discs, with the force where that is given.
    fn admissible(&self, start: &[Vector]) -> Vec<Vector> {
        let mut traction = start.to_vec();
        sums::update(&mut traction, |i, q| projected(q, self.bound[i]));
        if let ShearControl::Force(force) = self.control {
            if traction.iter().all(|q| *q == [0.0; 2]) {
                let [friction] = sums::of(self.len(), |i| [self.bound[i]]);
                if friction > 0.0 {
                    let share = scale(1.0 / (friction * self.area), force);
                    sums::update(&mut traction, |i, _| scale(self.bound[i], share));
                }
            }
            self.balance(&mut traction, force);
        }
        traction
    }

    /// Adds the same to all samples within their discs until the tractions have their force.
    fn balance(&self, traction: &mut [Vector], force: Vector) {
        let total = scale(1.0 / self.area, force);
        let is_free = |i: usize, q: Vector| self.bound[i] > 0.0 && length(q) < self.bound[i] * (1.0 - 1e-12);
        for _ in 0..BALANCE_PASSES {
            let [x, y, friction, free] = sums::of(self.len(), |i| {
                let q = traction[i];
                [q[0], q[1], self.bound[i], f64::from(u8::from(is_free(i, q)))]
            });
            let missing = sub(total, [x, y]);
            if length(missing) <= BALANCE_TOLERANCE * friction {
                return;
            }
            // Where all slip, each in proportion to its bound.
            sums::update(traction, |i, q| {
                let share =
                    if free > 0.0 { f64::from(u8::from(is_free(i, q))) / free } else { self.bound[i] / friction };
                if share > 0.0 { projected(add(q, scale(share, missing)), self.bound[i]) } else { q }
            });
        }
    }

    /// **d**, with the gap and its scale: given, or that which leaves no resultant of what the tractions may change by, or the one with the
    /// least gap where that is far less.
    fn rise(&self, traction: &[Vector], gradient: &[Vector], near: Option<Vector>) -> (Vector, [f64; 2]) {
        if let ShearControl::Shift(rise) = self.control {
            return (rise, self.gap(traction, gradient, rise));
        }
        let mean = |weight: &(dyn Fn(usize) -> f64 + Sync)| {
            let [x, y, sum] = sums::of(self.len(), |i| {
                let w = weight(i);
                [w * gradient[i][0], w * gradient[i][1], w]
            });
            (sum > 0.0).then(|| [x / sum, y / sum])
        };
        let sticking = || mean(&|i| (self.bound[i] * self.bound[i] - dot(traction[i], traction[i])).max(0.0));
        let start = near.or_else(sticking).or_else(|| mean(&|i| self.bound[i])).unwrap_or_default();
        let mut balanced = start;
        for _ in 0..MULTIPLIER_PASSES {
            let of = |i: usize| self.state(i, traction, gradient, balanced);
            let share = |i: usize| self.preconditioner.share(of(i));
            let Some(better) = self.common(traction, of, |i| scale(share(i), gradient[i])) else { break };
            balanced = better;
        }
        let least = self.least_gap(traction, gradient, balanced);
        let [of_balanced, of_least] = [balanced, least].map(|rise| self.gap(traction, gradient, rise));
        if of_balanced[0] <= GAP_RATIO * of_least[0] { (balanced, of_balanced) } else { (least, of_least) }
    }

    /// **d** with the least gap, near a value of it: Σ(m**s**/|**s**| − **q**) = 0, by Weiszfeld's iteration.
    fn least_gap(&self, traction: &[Vector], gradient: &[Vector], near: Vector) -> Vector {
        let (mut rise, mut least) = (near, 0.0);
        for _ in 0..GAP_PASSES {
            let [x, y, sum, slip, friction] = sums::of(self.len(), |i| {
                let (m, slip) = (self.bound[i], length(self.slip(i, gradient, rise)));
                let weight = if m > 0.0 { m / slip.max(least).max(f64::MIN_POSITIVE) } else { 0.0 };
                let pull = add(scale(weight, gradient[i]), traction[i]);
                [pull[0], pull[1], weight, m * slip, m]
            });
            let (mean, next) = (slip / friction, [x / sum, y / sum]);
            if !(mean > 0.0 && next.iter().all(|part| part.is_finite())) {
                break;
            }
            let change = length(sub(next, rise));
            (rise, least) = (next, LEAST_SLIP * mean);
            if change < GAP_TOLERANCE * mean {
                break;
            }
        }
        rise
    }

    /// **d** with ΣP(**v** − w**d**) = 0, w the share of each sample.
    fn common(
        &self,
        traction: &[Vector],
        state: impl Fn(usize) -> State + Sync,
        value: impl Fn(usize) -> Vector + Sync,
    ) -> Option<Vector> {
        let [xx, yy, xy, x, y] = sums::of(self.len(), |i| {
            let (state, q) = (state(i), traction[i]);
            let share = self.preconditioner.share(state);
            let ([xx, yy, xy], [x, y]) = (state.projection(q), state.tangent(value(i), q));
            [share * xx, share * yy, share * xy, x, y]
        });
        solve([xx, yy, xy], [x, y])
    }

    /// Σ(m|**s**| − **q**·**s**) and Σm max|**d** + **b**|.
    fn gap(&self, traction: &[Vector], gradient: &[Vector], rise: Vector) -> [f64; 2] {
        let [gap, friction] = sums::of(self.len(), |i| {
            let (m, s) = (self.bound[i], self.slip(i, gradient, rise));
            [(m * length(s) - dot(traction[i], s)).max(0.0), m]
        });
        let pressed = |i: usize| if self.bound[i] > 0.0 { -length(add(rise, self.before[i])) } else { 0.0 };
        [gap, friction * -sums::least(self.len(), pressed).min(0.0)]
    }

    /// One iteration: the direction, the step along it, back onto the discs.
    fn advance(&mut self, traction: &mut [Vector], gradient: &[Vector], rise: Vector, last: Option<Last>) -> Last {
        let len = self.len();
        let states = parallel::map_by(sums::BLOCK, len, |i| self.state(i, traction, gradient, rise));
        let share = |i: usize| self.preconditioner.share(states[i]);
        let resultant = match self.control {
            ShearControl::Shift(rise) => rise,
            ShearControl::Force(_) => {
                self.common(traction, |i| states[i], |i| scale(share(i), gradient[i])).unwrap_or(rise)
            }
        };
        let mut residual = gradient.to_vec();
        sums::update(&mut residual, |i, g| states[i].tangent(sub(g, resultant), traction[i]));
        let rows = self.rows();
        let mut preconditioned =
            self.preconditioner.apply(self.operator, &residual, |i| (states[i], traction[i]), &rows);
        if let ShearControl::Force(_) = self.control
            && let Some(common) = self.common(traction, |i| states[i], |i| preconditioned[i])
        {
            sums::update(&mut preconditioned, |i, z| states[i].tangent(sub(z, scale(share(i), common)), traction[i]));
        }
        let [product] = sums::of(len, |i| [dot(preconditioned[i], residual[i])]);
        let mut direction = preconditioned;
        if let Some(last) = last.filter(|last| last.product > 0.0) {
            // Polak and Ribière.
            let [change] = sums::of(len, |i| [dot(direction[i], sub(residual[i], last.residual[i]))]);
            let beta = (change / last.product).max(0.0);
            sums::update(&mut direction, |i, z| add(z, scale(beta, states[i].tangent(last.direction[i], traction[i]))));
        }
        let mut image = direction.clone();
        self.operator.displace(&mut image, rows);
        let [slope, curvature] = sums::of(len, |i| {
            let t = direction[i];
            [dot(residual[i], t), dot(t, image[i]) + states[i].curvature() * dot(t, t)]
        });
        let step = if curvature > 0.0 { slope / curvature } else { 0.0 };
        sums::update(traction, |i, q| projected(sub(q, scale(step, direction[i])), self.bound[i]));
        if let ShearControl::Force(force) = self.control {
            self.balance(traction, force);
        }
        Last { direction, residual, product }
    }
}

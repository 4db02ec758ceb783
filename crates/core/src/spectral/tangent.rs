//! The tangent of a solved contact: how pressure and force change with the penetration, and the penetration with the problem.
//!
//! In contact w = δ − f. While the same samples touch, a change of δ changes the pressure by p′ = ∂p/∂δ with
//!
//! C p′ = 1 in contact, p′ = 0 elsewhere;  S = ∂P/∂δ = ∫ p′ d²x,
//!
//! the contact stiffness. Where the pressure is that of the hardness the surface yields under more load and springs back under less:
//! S is then that of unloading. Without it, what joins at the edge of contact has no pressure yet, so that this is the derivative of the
//! whole curve P(δ), here that of its next piece. Under a constant load a change of the problem, of C by dC and of f by df, changes the
//! penetration by
//!
//! dδ = ⟨p′, dC p + df⟩ / ⟨p′, 1⟩,  as ⟨p′, C dp⟩ = ⟨1, dp⟩ = 0.

use super::operator::{ElasticOperator, Workspace};
use super::{Contact, LayeredOperator};
use crate::body::Bodies;
use crate::counterbody::Surface;
use crate::notation::number;
use crate::numeric::sums;
use crate::problem::Problem;
use std::fmt;

/// Least residual of C p′ = 1 relative to the first one, in the norm of C⁻¹.
const TOLERANCE: f64 = 1e-8;
/// Largest number of iterations.
const ITERATIONS: usize = 200;

/// The tangent of a solved contact.
#[derive(Debug, Clone)]
pub struct Tangent {
    /// p′ = ∂p/∂δ, a pressure per length, sample by sample, a₂ fastest.
    rate: Vec<f64>,
    /// S = ∂P/∂δ, a force per length.
    stiffness: f64,
    /// Step of S where samples join the contact, a force per length.
    step: f64,
    iterations: usize,
}

impl Tangent {
    /// The tangent for the operator of a contact without friction that couples; `None` without contact, and where the iteration
    /// does not converge.
    pub(super) fn new(operator: &mut LayeredOperator, contact: &Contact) -> Option<Self> {
        let (rate, iterations) = rate(operator, contact.pressures())?;
        let [sum, samples] = sums::of(rate.len(), |i| [rate[i], f64::from(u8::from(rate[i] != 0.0))]);
        let joining = if contact.grid().cell().is_rectangular() { 8.0 } else { 12.0 };
        let stiffness = sum * contact.grid().sample_area();
        Some(Self { stiffness, step: stiffness.abs() * (joining / samples).min(1.0), rate, iterations })
    }

    /// Contact stiffness S = ∂P/∂δ of the cell, or of the isolated contact: a force per length.
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Part of the error of the stiffness that lies in the samples, a force per length: those that are equal by symmetry, eight or twelve,
    /// join a contact of N at a time, between which P(δ) is a straight line. [`Solver::stiffness`](super::Solver::stiffness) has the whole.
    pub fn stiffness_error(&self) -> f64 {
        self.step
    }

    /// Σ wᵢ δᵢ of problems like that of the `contact`, δᵢ the penetration under the same load to first order, a length. With weights of a
    /// difference quotient it is the derivative of the penetration by a parameter of the problem.
    ///
    /// # Panics
    /// When a problem has another cell.
    pub fn penetration(&self, contact: &Contact, problems: &[(f64, &Problem)]) -> f64 {
        let (grid, p) = (contact.grid(), contact.pressures());
        assert!(problems.iter().all(|(_, other)| other.cell() == grid.cell()), "problems on other cells");
        let bodies: Vec<(f64, &Bodies)> =
            problems.iter().map(|&(weight, problem)| (weight, problem.bodies())).collect();
        let mut displaced = p.to_vec();
        LayeredOperator::of_bodies(grid, &bodies).displace(&mut displaced, &mut Workspace::default());
        let gaps = |&(weight, problem): &(f64, &Problem)| {
            let surface = problem.loaded_by().surface(grid.points()).expect("the grid of a contact has samples");
            (weight, surface)
        };
        let gaps: Vec<(f64, Surface)> = problems.iter().map(gaps).collect();
        let [changed, whole] = sums::of(p.len(), |i| {
            let f: f64 = gaps.iter().map(|(weight, surface)| weight * surface.gaps()[i]).sum();
            [self.rate[i] * (displaced[i] + f), self.rate[i]]
        });
        changed / whole
    }
}

/// p′ by conjugate gradients on the samples in contact, and the number of iterations.
fn rate<O: ElasticOperator>(operator: &mut O, pressure: &[f64]) -> Option<(Vec<f64>, usize)> {
    let touches = |i: usize| pressure[i] > 0.0;
    let mut workspace = Workspace::default();
    let len = pressure.len();
    let dot = |a: &[f64], b: &[f64]| sums::of(len, |i| [a[i] * b[i]])[0];
    let confine = |field: &mut Vec<f64>| sums::update(field, |i, x| if touches(i) { x } else { 0.0 });
    let mut rate = vec![0.0; len];
    let mut residual: Vec<f64> = (0..len).map(|i| f64::from(u8::from(touches(i)))).collect();
    let mut direction: Vec<f64> = Vec::new();
    let (mut first, mut before) = (None, 0.0);
    for iteration in 0..ITERATIONS {
        let mut steepest = residual.clone();
        operator.symmetric_pressure(&mut steepest, &mut workspace);
        confine(&mut steepest);
        let square = dot(&residual, &steepest);
        let first = *first.get_or_insert(square);
        if !(square.is_finite() && first > 0.0) {
            return None;
        }
        if square <= TOLERANCE * TOLERANCE * first {
            return Some((rate, iteration));
        }
        let part = if iteration == 0 { 0.0 } else { square / before };
        before = square;
        if direction.is_empty() {
            direction.clone_from(&steepest);
        } else {
            sums::update(&mut direction, |i, d| steepest[i] + part * d);
        }
        let mut displaced = direction.clone();
        operator.displace(&mut displaced, &mut workspace);
        let step = square / dot(&direction, &displaced);
        sums::update(&mut rate, |i, x| x + step * direction[i]);
        sums::update(&mut residual, |i, r| if touches(i) { r - step * displaced[i] } else { 0.0 });
    }
    None
}

impl fmt::Display for Tangent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "contact stiffness ∂P/∂δ {} after {} iterations", number(self.stiffness), self.iterations)
    }
}

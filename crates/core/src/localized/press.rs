//! Contact of one spot whose surface is pressed to given displacements.
//!
//! A p ≥ b, p ≥ 0, p (A p − b) = 0: b = δ − f − u is the displacement required of the spot's own pressures (with their images in
//! the circle). A is symmetric; Polonsky & Keer's (1999) conjugate gradients without their constraint on the load.
//!
//! Under the lattice sum A measures displacements from the mean plane, so that a uniform pressure over the whole cell
//! displaces nothing: A is positive definite only where a part of the cell is open. A spot pressed beyond complete
//! contact has no solution. The conjugate gradients then find a direction along which tᵀA t ≤ 0, and end.

use super::mesh::Influence;
use crate::numeric::search::largest;

/// Largest number of iterations.
const MAX_ITERATIONS: usize = 400;

/// How the iteration of one spot ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpotEnd {
    /// The gap vanishes in contact, to the tolerance.
    Met,
    /// The gap does not vanish after the largest number of iterations.
    Unmet,
    /// A direction without stiffness was found: the surface is pressed beyond complete contact.
    Unbounded,
}

/// The gap of a spot after its iteration.
#[derive(Debug, Clone)]
pub struct SpotSolution {
    /// Gap A p − b, a length, one value per element.
    pub gap: Vec<f64>,
    /// How the iteration ended.
    pub end: SpotEnd,
    /// Number of products with A.
    pub iterations: usize,
}

/// Conjugate directions on the active elements.
struct Conjugate {
    direction: Vec<f64>,
    /// A t of the direction t, lengths.
    image: Vec<f64>,
    /// Gap of the last step, and the sum of its squares.
    before: Option<(Vec<f64>, f64)>,
}

impl Conjugate {
    fn new(len: usize) -> Self {
        Self { direction: vec![0.0; len], image: vec![0.0; len], before: None }
    }

    /// Length of the step along the next direction against `gap` on the `active` elements (Polak–Ribière β ≥ 0, β = 0 where
    /// `afresh`). `None` along a direction without stiffness.
    fn step(&mut self, influence: &Influence, gap: &[f64], active: &[usize], afresh: bool) -> Option<f64> {
        let square: f64 = active.iter().map(|&i| gap[i] * gap[i]).sum();
        let beta = match &self.before {
            Some((last, last_square)) if !afresh => {
                let change: f64 = active.iter().map(|&i| gap[i] * (gap[i] - last[i])).sum();
                (change / last_square).max(0.0)
            }
            _ => 0.0,
        };
        let last = std::mem::replace(&mut self.direction, vec![0.0; gap.len()]);
        active.iter().for_each(|&i| self.direction[i] = gap[i] + beta * last[i]);
        self.image.fill(0.0);
        influence.add(&self.direction, &mut self.image);
        self.before = Some((gap.to_vec(), square));
        let dot = |a: &[f64]| active.iter().map(|&i| a[i] * self.direction[i]).sum::<f64>();
        let stiffness = dot(&self.image);
        (stiffness > 0.0).then(|| dot(gap) / stiffness)
    }
}

/// Solves for the `pressure` that displaces the elements by b = `wanted`, from the pressure given; `tolerance` of the gap is
/// relative to the largest displacement.
pub fn press(influence: &Influence, wanted: &[f64], tolerance: f64, pressure: &mut [f64]) -> SpotSolution {
    let len = wanted.len();
    let scale = largest(wanted.iter().copied());
    if scale == 0.0 {
        // No displacement is required: nothing touches.
        pressure.fill(0.0);
        return SpotSolution { gap: wanted.iter().map(|b| -b).collect(), end: SpotEnd::Met, iterations: 0 };
    }
    let residual = |pressure: &[f64]| {
        let mut gap: Vec<f64> = wanted.iter().map(|b| -b).collect();
        influence.add(pressure, &mut gap);
        gap
    };
    let mut gap = residual(pressure);
    let mut conjugate = Conjugate::new(len);
    for iterations in 0..MAX_ITERATIONS {
        // Gaps that are not numbers do not count as closed.
        let moves = |&i: &usize| pressure[i] > 0.0 || gap[i] < 0.0 || gap[i].is_nan();
        let active: Vec<usize> = (0..len).filter(moves).collect();
        let counts = |&&i: &&usize| pressure[i] > 0.0 || gap[i] < -tolerance * scale || gap[i].is_nan();
        let worst = largest(active.iter().filter(counts).map(|&i| gap[i].abs()));
        if worst <= tolerance * scale {
            return SpotSolution { gap, end: SpotEnd::Met, iterations };
        }
        // A penetrated element without pressure joins the contact: a new start.
        let grown = active.iter().any(|&i| pressure[i] == 0.0);
        let Some(step) = conjugate.step(influence, &gap, &active, grown) else {
            return SpotSolution { gap, end: SpotEnd::Unbounded, iterations: iterations + 1 };
        };
        let mut clipped = false;
        for &i in &active {
            pressure[i] -= step * conjugate.direction[i];
            if pressure[i] < 0.0 {
                pressure[i] = 0.0;
                clipped = true;
            }
        }
        if clipped {
            gap = residual(pressure);
        } else {
            gap.iter_mut().zip(&conjugate.image).for_each(|(g, u)| *g -= step * u);
        }
    }
    SpotSolution { gap, end: SpotEnd::Unmet, iterations: MAX_ITERATIONS }
}

/// Pressures on the elements in contact that displace all of them by one unit, as a flat punch does: their sum times the area of
/// an element is the contact stiffness dP/dδ. `start` is the initial guess.
pub fn punch(influence: &Influence, pressure: &[f64], tolerance: f64, mut start: Vec<f64>) -> Vec<f64> {
    let len = pressure.len();
    let active: Vec<usize> = (0..len).filter(|&i| pressure[i] > 0.0).collect();
    (0..len).filter(|&i| pressure[i] == 0.0).for_each(|i| start[i] = 0.0);
    let mut rest = vec![-1.0; len];
    influence.add(&start, &mut rest);
    let mut conjugate = Conjugate::new(len);
    for _ in 0..MAX_ITERATIONS {
        let square: f64 = active.iter().map(|&i| rest[i] * rest[i]).sum();
        if square <= tolerance * tolerance * active.len() as f64 {
            break;
        }
        let Some(step) = conjugate.step(influence, &rest, &active, false) else { break };
        active.iter().for_each(|&i| start[i] -= step * conjugate.direction[i]);
        rest.iter_mut().zip(&conjugate.image).for_each(|(r, u)| *r -= step * u);
    }
    start
}

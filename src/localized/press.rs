//! Contact of one spot whose surface is pressed to given displacements.
//!
//! A p ≥ b, p ≥ 0, p (A p − b) = 0: b = δ − f − u is what the spot's own pressures (with their images in the circle)
//! must displace. A is symmetric and positive; Polonsky & Keer's (1999) conjugate gradients without their constraint on
//! the load.

use super::mesh::Influence;
use crate::numeric::search::largest;

/// Iterations at most.
const ITERATIONS: usize = 400;

/// Conjugate directions on the elements that may change.
struct Conjugate {
    direction: Vec<f64>,
    /// A t of the direction t.
    image: Vec<f64>,
    /// Gap of the last step, and its square.
    before: Option<(Vec<f64>, f64)>,
}

impl Conjugate {
    fn new(len: usize) -> Self {
        Self { direction: vec![0.0; len], image: vec![0.0; len], before: None }
    }

    /// Step along the next direction against `gap` on the `active` elements (Polak–Ribière β ≥ 0); `afresh` after they
    /// have grown.
    fn step(&mut self, influence: &Influence, gap: &[f64], active: &[usize], afresh: bool) -> f64 {
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
        dot(gap) / dot(&self.image)
    }
}

/// Brings `pressure` to the solution for the wanted displacements b = `wanted`; `tolerance` is relative to the largest
/// of them. Gives back A p − b, the gap, and whether it is reached.
pub fn press(influence: &Influence, wanted: &[f64], tolerance: f64, pressure: &mut [f64]) -> (Vec<f64>, bool) {
    let len = wanted.len();
    let scale = largest(wanted.iter().copied());
    if scale == 0.0 {
        // Nothing is displaced far enough to touch.
        pressure.fill(0.0);
        return (wanted.iter().map(|b| -b).collect(), true);
    }
    let residual = |pressure: &[f64]| {
        let mut gap: Vec<f64> = wanted.iter().map(|b| -b).collect();
        influence.add(pressure, &mut gap);
        gap
    };
    let mut gap = residual(pressure);
    let mut conjugate = Conjugate::new(len);
    for _ in 0..ITERATIONS {
        // What is not a number is not reached.
        let moves = |&i: &usize| pressure[i] > 0.0 || gap[i] < 0.0 || gap[i].is_nan();
        let active: Vec<usize> = (0..len).filter(moves).collect();
        let counts = |&&i: &&usize| pressure[i] > 0.0 || gap[i] < -tolerance * scale || gap[i].is_nan();
        let worst = largest(active.iter().filter(counts).map(|&i| gap[i].abs()));
        if worst <= tolerance * scale {
            return (gap, true);
        }
        // An element that is penetrated but carries nothing yet joins the contact: a new start.
        let grown = active.iter().any(|&i| pressure[i] == 0.0);
        let step = conjugate.step(influence, &gap, &active, grown);
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
    (gap, false)
}

/// Pressures on the elements in contact that displace all of them by one unit: their sum times the area of an element
/// is the stiffness dP/dδ. `start` is a first guess.
pub fn punch(influence: &Influence, pressure: &[f64], tolerance: f64, mut start: Vec<f64>) -> Vec<f64> {
    let len = pressure.len();
    let active: Vec<usize> = (0..len).filter(|&i| pressure[i] > 0.0).collect();
    (0..len).filter(|&i| pressure[i] == 0.0).for_each(|i| start[i] = 0.0);
    let mut rest = vec![-1.0; len];
    influence.add(&start, &mut rest);
    let mut conjugate = Conjugate::new(len);
    for _ in 0..ITERATIONS {
        let square: f64 = active.iter().map(|&i| rest[i] * rest[i]).sum();
        if square <= tolerance * tolerance * active.len() as f64 {
            break;
        }
        let step = conjugate.step(influence, &rest, &active, false);
        active.iter().for_each(|&i| start[i] -= step * conjugate.direction[i]);
        rest.iter_mut().zip(&conjugate.image).for_each(|(r, u)| *r -= step * u);
    }
    start
}

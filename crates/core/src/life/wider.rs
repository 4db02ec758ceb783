//! Growing windows of an isolated contact, as wear flattens the surfaces.

use super::state::LifeState;
use super::task::LifeTask;
use crate::body::{HalfSpace, Side};
use crate::lattice::Cell;
use crate::problem::Problem;

/// Most times that a window is doubled: its contact grows by two decades.
const DOUBLED: u32 = 6;

impl LifeTask {
    /// The problem of a state, in its window, on a body.
    pub(super) fn problem_of(&self, state: &LifeState, body: HalfSpace) -> Problem {
        let problem = self.problem.on_body(body);
        problem.widened(factor(state.doubled)).filter(|_| state.doubled > 0).unwrap_or(problem)
    }

    /// The window of a state, or the cell.
    pub(super) fn window(&self, state: &LifeState) -> Cell {
        let wider = self.problem.widened(factor(state.doubled)).filter(|_| state.doubled > 0);
        wider.map_or(self.problem.cell(), |problem| problem.cell())
    }

    /// The state in a window twice as large on as many samples; `None` in a periodic cell, and where it has been doubled often.
    pub(super) fn in_wider_window(&self, state: LifeState) -> Option<LifeState> {
        self.problem.cell().widened(2.0).filter(|_| state.doubled < DOUBLED)?;
        let direction = self.problem.direction();
        let (along, is_swept) = (usize::from(direction[0].abs() <= direction[1].abs()), self.motions.is_none());
        let wider = |depths: &[f64], goes_on: Option<usize>| spread(depths, state.points, goes_on);
        let worn = [wider(state.of(Side::Body), is_swept.then_some(along)), wider(state.of(Side::Counterbody), None)];
        let indented = wider(&state.indented, None);
        Some(LifeState { worn, indented, doubled: state.doubled + 1, ..state })
    }
}

fn factor(doubled: u32) -> f64 {
    f64::from(1 << doubled)
}

/// Depths on the samples of a window twice as large with the same middle: none beyond the first one, but along the axis on which they go
/// on.
fn spread(depths: &[f64], [n1, n2]: [usize; 2], goes_on: Option<usize>) -> Vec<f64> {
    if depths.is_empty() {
        return Vec::new();
    }
    // Samples of the window about a place of the larger one, with their parts.
    let beside = |k: usize, n: usize, axis: usize| -> [(Option<usize>, f64); 2] {
        let place = 2.0 * k as f64 - 0.5 * n as f64;
        let within = |sample: f64| match goes_on == Some(axis) {
            true => Some(sample.clamp(0.0, (n - 1) as f64) as usize),
            false => (sample >= 0.0 && sample < n as f64).then_some(sample as usize),
        };
        let part = place - place.floor();
        [(within(place.floor()), 1.0 - part), (within(place.floor() + 1.0), part)]
    };
    let value = |i: usize, j: usize| {
        let of = |(row, of_row): (Option<usize>, f64)| {
            let of = |(column, part): (Option<usize>, f64)| {
                row.zip(column).map_or(0.0, |(row, column)| of_row * part * depths[row * n2 + column])
            };
            beside(j, n2, 1).into_iter().map(of).sum::<f64>()
        };
        beside(i, n1, 0).into_iter().map(of).sum::<f64>()
    };
    (0..n1).flat_map(|i| (0..n2).map(move |j| (i, j))).map(|(i, j)| value(i, j)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_keep_their_places_in_a_window_twice_as_large() {
        for n in [8usize, 9] {
            let of = |n: usize, side: f64| {
                let place = move |k: usize| side * (k as f64 / n as f64 - 0.5);
                move |i: usize, j: usize| (place(i), place(j))
            };
            let (small, large) = (of(n, 1.0), of(n, 2.0));
            let linear = |(x, y): (f64, f64)| 2.0 + x - 0.5 * y;
            let depths: Vec<f64> = (0..n * n).map(|k| linear(small(k / n, k % n))).collect();
            let wide = spread(&depths, [n; 2], None);
            let groove: Vec<f64> = (0..n * n).map(|k| linear((0.0, small(k / n, k % n).1))).collect();
            let longer = spread(&groove, [n; 2], Some(0));
            for (k, (wide, longer)) in wide.iter().zip(&longer).enumerate() {
                let (x, y) = large(k / n, k % n);
                let is_inner = |fraction: f64| fraction > -0.5 && fraction < 0.5 - 1.0 / n as f64;
                if is_inner(x) && is_inner(y) {
                    assert!((wide - linear((x, y))).abs() < 1e-12, "{n}: {x}, {y}");
                }
                if is_inner(y) {
                    assert!((longer - linear((0.0, y))).abs() < 1e-12, "{n}: {x}, {y}");
                }
                if x.abs() > 0.5 + 1.0 / n as f64 {
                    assert_eq!(*wide, 0.0);
                }
            }
        }
    }
}

//! Depths that sliding has worn off both surfaces of a solver.

use crate::body::Side;
use crate::lattice::Grid;
use crate::numeric::sums;
use ndarray::{Array2, ArrayView2};
use std::sync::Arc;

/// Depths worn off body and counterbody on the finest grid of a [`Solver`](super::Solver), since it was made. A clone shares them.
#[derive(Debug, Clone)]
pub struct Worn {
    grid: Arc<Grid>,
    body: Arc<Array2<f64>>,
    counterbody: Arc<Array2<f64>>,
    distance: f64,
    recession: f64,
}

impl Worn {
    /// Nothing worn on a grid.
    pub(super) fn none(grid: &Arc<Grid>) -> Self {
        let zero = Arc::new(Array2::zeros(grid.points()));
        Self { grid: Arc::clone(grid), body: Arc::clone(&zero), counterbody: zero, distance: 0.0, recession: 0.0 }
    }

    /// Adds the depths of a step, those of the body first.
    pub(super) fn add(&mut self, [body, counterbody]: [Option<Array2<f64>>; 2], distance: f64, recession: f64) {
        for (worn, depth) in [(&mut self.body, body), (&mut self.counterbody, counterbody)] {
            if let Some(depth) = depth {
                *Arc::make_mut(worn) += &depth;
            }
        }
        self.distance += distance;
        self.recession += recession;
    }

    /// Depth worn off one surface, lengths, axes along a₁ and a₂. That of the body is constant along the direction of sliding.
    pub fn depth(&self, side: Side) -> ArrayView2<'_, f64> {
        self.of(side).view()
    }

    /// Volume worn off one surface, a cubed length, on one cell or by an isolated contact: k s P after a path s under the force P. Of the
    /// body under an isolated contact it is that of the groove on the width of the window.
    pub fn volume(&self, side: Side) -> f64 {
        let depth = self.of(side).as_slice().expect("fields are stored row by row");
        sums::of(depth.len(), |i| [depth[i]])[0] * self.grid.sample_area()
    }

    /// Largest depth worn off one surface, a length.
    pub fn largest(&self, side: Side) -> f64 {
        self.of(side).iter().copied().fold(0.0, f64::max)
    }

    /// Distance of sliding s, a length.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Approach of the bodies until their worn surfaces touch first, a length.
    pub fn recession(&self) -> f64 {
        self.recession
    }

    fn of(&self, side: Side) -> &Array2<f64> {
        match side {
            Side::Body => &self.body,
            Side::Counterbody => &self.counterbody,
        }
    }
}

//! The windows in which a search solves its loads.
//!
//! The results of an isolated contact depend on its window by the spacing of the samples alone. Where contact has no room any more,
//! higher loads are solved in a window twice as large on as many samples, as long as these resolve the zone in which surfaces that adhere pull.

use crate::lattice::Grid;
use crate::problem::Problem;
use crate::spectral::check_adhesive_grid;
use std::sync::Arc;

/// Largest number of windows: contact of a ball fills the last one under some 10⁵ times the load that fills the first.
const WINDOWS: usize = 7;

/// The problem in one window or more, each twice as large as the one before; one cell of a periodic system.
#[derive(Debug)]
pub(super) struct Windows {
    /// The problem in each window, with the largest load in which contact has room, and none is complete.
    problems: Vec<(Arc<Problem>, f64)>,
    points: [usize; 2],
}

impl Windows {
    /// The first window or the cell on a grid of `points`, for loads up to `largest`.
    pub fn new(problem: Arc<Problem>, largest: f64, points: [usize; 2]) -> Self {
        Self { problems: vec![(problem, largest)], points }
    }

    /// The largest load that is solved; infinite while none is known.
    pub fn largest(&self) -> f64 {
        self.problems[self.problems.len() - 1].1
    }

    /// Contact has no room under loads above `largest`: adds a larger window for these; returns whether there is one.
    pub fn end_at(&mut self, largest: f64) -> bool {
        let count = self.problems.len();
        let (problem, most) = &mut self.problems[count - 1];
        let infinite = std::mem::replace(most, largest);
        let resolves = |wider: &Problem| {
            Grid::new(wider.cell(), self.points).is_ok_and(|grid| check_adhesive_grid(wider, &grid).is_ok())
        };
        let wider = problem.widened(2.0).filter(|wider| count < WINDOWS && resolves(wider));
        let Some(wider) = wider else { return false };
        self.problems.push((Arc::new(wider), infinite));
        true
    }

    /// Number of the window of a load.
    pub fn of(&self, load: f64) -> usize {
        // Rounding of a load does not change its window.
        let has_room = |(_, largest): &(Arc<Problem>, f64)| load <= largest * (1.0 + 1e-9);
        self.problems.iter().position(has_room).unwrap_or(self.problems.len() - 1)
    }

    /// The problem in a window.
    pub fn problem(&self, number: usize) -> &Arc<Problem> {
        &self.problems[number].0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cell, HalfSpace, Indenters, Lattice, Level, Material, Shape};

    #[test]
    fn a_load_has_the_smallest_window_with_room() {
        let problem = |cell: Cell| {
            let lattice = Lattice::new(cell, vec![vec![[0.5; 2], [0.75, 0.5]]]).unwrap();
            let level = Level::new(Shape::Paraboloid { radius: 1.0 }, 0.0).unwrap();
            let body = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
            Arc::new(Problem::new(Indenters::new(lattice, vec![level]).unwrap(), body))
        };
        let mut windows = Windows::new(problem(Cell::window([1.0, 2.0]).unwrap()), f64::INFINITY, [16; 2]);
        assert!(windows.largest().is_infinite() && windows.end_at(3.0) && windows.largest().is_infinite());
        assert!(windows.end_at(20.0));
        assert_eq!([1.0, 3.0, 3.1, 20.0, 30.0].map(|load| windows.of(load)), [0, 0, 1, 1, 2]);
        let wide = windows.problem(2);
        // The indenters keep their distance.
        let sites = wide.indenters().unwrap().sites();
        assert_eq!(wide.cell().vectors(), [[4.0, 0.0], [0.0, 8.0]]);
        assert_eq!(wide.cell().point(sites[1].place), [0.25, 0.0]);
        let more = (0..20).take_while(|_| windows.end_at(50.0)).count();
        assert!(more == WINDOWS - 3 && windows.largest() == 50.0);
        // A periodic system has one cell.
        let mut cell = Windows::new(problem(Cell::square(1.0).unwrap()), 7.0, [16; 2]);
        assert!(!cell.end_at(5.0) && cell.largest() == 5.0 && cell.of(9.0) == 0);
    }
}

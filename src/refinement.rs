//! How much the answer changes from one grid to the next finer one.

use crate::fourier::fast_points;
use crate::hierarchy::Hierarchy;
use crate::lattice::Cell;
use crate::material::HalfSpace;
use crate::observables::{Observables, observe};
use crate::solver::{Control, Settings};
use crate::texture::Surface;

/// Points along the shorter cell vector at which a refinement starts.
pub const FIRST_POINTS: usize = 96;
/// Points along the longer cell vector beyond which it gives up.
pub const MOST_POINTS: usize = 4096;
/// Points along the shorter cell vector of the first grid, at least.
const LEAST_POINTS: usize = 12;
/// A change above this part of the one before is no progress.
const STAGNATION: f64 = 0.8;

/// `points` along the shorter cell vector, and as dense along the longer one.
pub fn balanced_points(cell: &Cell, points: usize) -> [usize; 2] {
    let lengths = cell.vectors().map(|a| a[0].hypot(a[1]));
    let shorter = lengths[0].min(lengths[1]);
    lengths.map(|length| fast_points((points as f64 * length / shorter).round() as usize))
}

/// Largest relative change between the load steps on two grids: of peak pressures (over the largest one), load shares,
/// mean pressure and penetration. The pressure under a tip is infinite: it is left out.
pub fn change(coarse: &[Observables], fine: &[Observables]) -> f64 {
    coarse.iter().zip(fine).map(|(coarse, fine)| step_change(coarse, fine)).fold(0.0, f64::max)
}

/// A cell too oblong for any grid of the refinement.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the cell is {0:.0} times as long as wide: no grid of at most {MOST_POINTS} points along a side has {LEAST_POINTS} along the other; \
     give grid.points instead of grid.accuracy"
)]
pub struct TooOblong(f64);

/// Finer and finer grids until results change by less than an accuracy.
///
/// It ends when a change is below the accuracy, when the next grid would be too fine, and when changes **stagnate**:
/// two in a row that are not below 0.8 of the one before (order ⅓), so that no grid in reach would help.
#[derive(Debug, Clone)]
pub struct Refinement {
    cell: Cell,
    accuracy: f64,
    points: usize,
    changes: Vec<f64>,
}

impl Refinement {
    /// Refinement on a cell, to changes below `accuracy`.
    ///
    /// # Errors
    /// [`TooOblong`] when not even the first grid is allowed.
    pub fn new(cell: Cell, accuracy: f64) -> Result<Self, TooOblong> {
        let lengths = cell.vectors().map(|a| a[0].hypot(a[1]));
        let ratio = lengths[0].max(lengths[1]) / lengths[0].min(lengths[1]);
        let first = FIRST_POINTS.min((MOST_POINTS as f64 / ratio) as usize);
        if first < LEAST_POINTS {
            return Err(TooOblong(ratio));
        }
        Ok(Self { cell, accuracy, points: first, changes: Vec::new() })
    }

    /// The present grid.
    pub fn points(&self) -> [usize; 2] {
        balanced_points(&self.cell, self.points)
    }

    /// Goes on to the next grid, after the change that the present one brought (none on the first); false when it ends.
    pub fn refine(&mut self, change: Option<f64>) -> bool {
        self.changes.extend(change);
        let finer = balanced_points(&self.cell, 2 * self.points);
        if self.reached() || self.stagnates() || finer.iter().any(|&n| n > MOST_POINTS) {
            return false;
        }
        self.points *= 2;
        true
    }

    /// The last change.
    pub fn change(&self) -> Option<f64> {
        self.changes.last().copied()
    }

    /// Whether the accuracy is reached.
    pub fn reached(&self) -> bool {
        self.change().is_some_and(|change| change < self.accuracy)
    }

    /// Whether finer grids have stopped to help.
    pub fn stagnates(&self) -> bool {
        let slow = |pair: &[f64]| pair[1].partial_cmp(&(STAGNATION * pair[0])) != Some(std::cmp::Ordering::Less);
        self.changes.len() >= 3 && self.changes[self.changes.len() - 3..].windows(2).all(slow)
    }
}

/// Points of the first grid from which one load step changes by less than `accuracy` to the next; the last grid tried
/// where none does.
///
/// # Errors
/// When the cell has no grid.
pub fn sufficient_points(
    surface: &Surface,
    half_space: &HalfSpace,
    settings: Settings,
    control: Control,
    accuracy: f64,
) -> Result<[usize; 2], Box<dyn std::error::Error + Send + Sync>> {
    let mut refinement = Refinement::new(surface.cell(), accuracy)?;
    let mut coarse: Option<[Observables; 1]> = None;
    loop {
        let points = refinement.points();
        let mut hierarchy = Hierarchy::new(surface, half_space, points, settings)?;
        let solution = hierarchy.solve(control, &mut |_| ());
        let fine = [observe(&hierarchy, &solution)];
        let change = coarse.as_ref().map(|coarse| change(coarse, &fine));
        if !refinement.refine(change) {
            return Ok(points);
        }
        coarse = Some(fine);
    }
}

fn step_change(coarse: &Observables, fine: &Observables) -> f64 {
    if fine.max_pressure <= 0.0 {
        return 0.0;
    }
    let peak = if fine.singular_peak() { 0.0 } else { (fine.max_pressure - coarse.max_pressure).abs() };
    let peak = peak / fine.max_pressure;
    let penetration = ((fine.penetration - coarse.penetration) / fine.penetration).abs();
    let load = (fine.mean_pressure - coarse.mean_pressure).abs() / fine.mean_pressure;
    let levels = coarse.levels.iter().zip(&fine.levels).map(|(coarse, fine_level)| {
        let change = (fine_level.max_pressure - coarse.max_pressure).abs() / fine.max_pressure;
        let peak = if fine_level.singular_peak { 0.0 } else { change };
        peak.max((fine_level.load_share - coarse.load_share).abs())
    });
    levels.fold(peak.max(penetration).max(load), f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_as_dense_along_both_vectors_and_fast() {
        let oblong = Cell::new([10.0, 0.0], [0.0, 1.0]).unwrap();
        assert_eq!(balanced_points(&oblong, 96), [960, 96]);
        let odd = Cell::new([1.0, 0.0], [0.5, 1.1]).unwrap();
        assert_eq!(balanced_points(&odd, 96), [96, 120]);
    }

    #[test]
    fn a_refinement_ends_where_changes_stagnate_and_says_whether_it_is_there() {
        let square = Cell::square(1.0).unwrap();
        let run = |changes: &[f64]| {
            let mut refinement = Refinement::new(square, 1e-3).unwrap();
            let mut rest = changes.iter().copied();
            let mut change = None;
            while refinement.refine(change) {
                change = rest.next();
            }
            (refinement.points()[0], refinement.reached())
        };
        assert_eq!(run(&[1e-2, 3e-3, 9e-4, 1e-9]), (768, true));
        // A logarithm changes as much from grid to grid.
        assert_eq!(run(&[1e-2, 9.9e-3, 9.8e-3, 9.7e-3]), (768, false));
        assert_eq!(run(&[1e-2, 5e-3, 2.5e-3, 1.3e-3, 1.1e-3, 1e-3]), (3072, false));
    }

    #[test]
    fn the_first_grid_is_bounded_and_a_needle_refused() {
        let oblong = |ratio: f64| Refinement::new(Cell::new([ratio, 0.0], [0.0, 1.0]).unwrap(), 1e-3);
        assert_eq!(oblong(4.0).unwrap().points(), [384, 96]);
        assert!(oblong(100.0).unwrap().points().iter().all(|&n| n <= MOST_POINTS));
        assert!(oblong(1000.0).is_err());
    }
}

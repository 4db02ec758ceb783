//! How much the answer changes from one grid to the next finer one.

use crate::fourier::fast_points;
use crate::hierarchy::Hierarchy;
use crate::lattice::{Cell, LatticeError};
use crate::material::HalfSpace;
use crate::observables::{Observables, observe};
use crate::solver::{Control, Settings};
use crate::texture::Surface;

/// Points along the shorter cell vector at which a refinement starts.
pub const FIRST_POINTS: usize = 96;
/// Points along the longer cell vector beyond which it gives up.
pub const MOST_POINTS: usize = 4096;

/// `points` along the shorter cell vector, and as dense along the longer one.
pub fn balanced_points(cell: &Cell, points: usize) -> [usize; 2] {
    let lengths = cell.vectors().map(|a| a[0].hypot(a[1]));
    let shorter = lengths[0].min(lengths[1]);
    lengths.map(|length| fast_points((points as f64 * length / shorter).round() as usize))
}

/// Largest relative change between the load steps on two grids: of peak pressures (over the largest one), load shares
/// and penetration.
pub fn change(coarse: &[Observables], fine: &[Observables]) -> f64 {
    coarse.iter().zip(fine).map(|(coarse, fine)| step_change(coarse, fine)).fold(0.0, f64::max)
}

/// Points of the first grid from which one load step changes by less than `accuracy` to the next; the finest grid
/// allowed where none does.
///
/// # Errors
/// [`LatticeError`] when the cell has no grid.
pub fn sufficient_points(
    surface: &Surface,
    half_space: &HalfSpace,
    settings: Settings,
    control: Control,
    accuracy: f64,
) -> Result<[usize; 2], LatticeError> {
    let (mut points, mut coarse): (usize, Option<[Observables; 1]>) = (FIRST_POINTS, None);
    loop {
        let grid = balanced_points(&surface.cell(), points);
        let finer = balanced_points(&surface.cell(), 2 * points);
        let mut hierarchy = Hierarchy::new(surface, half_space, grid, settings)?;
        let solution = hierarchy.solve(control, &mut |_| ());
        let fine = [observe(&hierarchy, &solution)];
        let sufficient = coarse.as_ref().is_some_and(|coarse| change(coarse, &fine) < accuracy);
        if sufficient || finer.iter().any(|&n| n > MOST_POINTS) {
            return Ok(grid);
        }
        (points, coarse) = (2 * points, Some(fine));
    }
}

fn step_change(coarse: &Observables, fine: &Observables) -> f64 {
    if fine.max_pressure <= 0.0 {
        return 0.0;
    }
    let peak = (fine.max_pressure - coarse.max_pressure).abs() / fine.max_pressure;
    let penetration = ((fine.penetration - coarse.penetration) / fine.penetration).abs();
    let load = (fine.mean_pressure - coarse.mean_pressure).abs() / fine.mean_pressure;
    let levels = coarse.levels.iter().zip(&fine.levels).map(|(coarse, fine_level)| {
        let peak = (fine_level.max_pressure - coarse.max_pressure).abs() / fine.max_pressure;
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
}

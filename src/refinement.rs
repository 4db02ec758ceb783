//! How much the answer changes from one grid to the next finer one.

use crate::observables::Observables;

/// Points along a cell vector at which a refinement starts, and beyond which it gives up.
pub const FIRST_POINTS: usize = 96;
/// See [`FIRST_POINTS`].
pub const MOST_POINTS: usize = 4096;

/// Largest relative change between the load steps on two grids: of peak pressures (over the largest one), load shares and penetration.
pub fn change(coarse: &[Observables], fine: &[Observables]) -> f64 {
    coarse.iter().zip(fine).map(|(coarse, fine)| step_change(coarse, fine)).fold(0.0, f64::max)
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

//! Memory of the cases and results of combinations until the table is made.
//!
//! Measured: a row of one step with three levels, 115 scalars, takes 28.5 kB at the peak, when the table is made; rows with
//! strengths take as much per scalar. All rows stay until the sweep ends.

use super::task::Task;
use crate::case::Case;
use crate::reading::Criterion;

/// Bytes of a scalar of a result, with its name.
const SCALAR: u64 = 256;
/// Scalars of a load step, of each level, and of each largest stress or utilisation.
const STEP: usize = 32;
const LEVEL: usize = 28;
const PEAK: usize = 11;

/// Bytes of a case between reading and solving, and of each of its layers and levels. Measured: 3.7 kB with one layer and three
/// levels, 22 kB with a hundred sublayers.
const CASE: u64 = 4 << 10;
const PART: u64 = 256;

/// Estimated memory of the case and the results of a combination, bytes.
pub(super) fn of_results(case: &Case, task: Task) -> u64 {
    let half_space = case.half_space();
    let criteria = Criterion::all(half_space).len();
    let scalars = match task {
        Task::Limit => STEP + PEAK * (criteria + 1),
        Task::Solve => {
            let layers = half_space.layers().len();
            // τ₁, tension and von Mises of each material and face, normal and shear of each interface.
            let has_stress = case.stress.is_some() || criteria > 0;
            let stress = if has_stress { PEAK * (3 * (3 * layers + 2) + 2 * layers + criteria) } else { 0 };
            case.load.values().len() * (STEP + LEVEL * case.counterbody().levels().len() + stress)
        }
    };
    let parts = half_space.layers().len() + case.counterbody().levels().len();
    CASE + PART * parts as u64 + SCALAR * scalars as u64
}

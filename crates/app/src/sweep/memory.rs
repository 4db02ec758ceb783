//! Memory of the cases and results of combinations until the table is made.
//!
//! Measured: rows of one step of three levels, 115 scalars, take 28.5 kB each at the peak, when the table is made, and rows of
//! layers with strengths as much for each scalar. All rows stay until the sweep ends.

use super::task::Task;
use percoat_case::case::Case;
use percoat_core::reading::Criterion;

/// Bytes of a scalar of a result, with its name.
const SCALAR: u64 = 256;
/// Scalars of a load step, of each of its levels, and of each place where a stress or utilisation is largest.
const STEP: usize = 32;
const LEVEL: usize = 28;
const PEAK: usize = 13;

/// Bytes of a case that is kept until the sweep ends, and of each of its layers and levels. Measured: 3.7 kB with one layer and
/// three levels, 22 kB with a hundred sublayers.
const CASE: u64 = 4 << 10;
const PART: u64 = 256;
/// Bytes of a number in a list of a case, in its section and where it is used.
const LISTED: u64 = 16;

/// Estimated bytes of the case and the results of a combination.
pub(super) fn of_results(case: &Case, task: Task) -> u64 {
    let bodies = case.problem().bodies();
    let criteria = Criterion::all(bodies).len();
    let layers: usize = bodies.each().map(|body| body.layers().len()).sum();
    let scalars = match task {
        Task::Limit => STEP + PEAK * (criteria + 1),
        Task::Solve => {
            // τ₁, tension and von Mises of each material and face, normal and shear of each interface; three strains beside the former.
            let has_stress = case.stress.is_some() || criteria > 0;
            let has_strains = case.stress.as_ref().is_some_and(|stress| stress.strain) || bodies.last_by_strain();
            let measures = if has_strains { 6 } else { 3 };
            let stress = if has_stress {
                PEAK * (measures * (3 * layers + 2 * bodies.each().count()) + 2 * layers + criteria)
            } else {
                0
            };
            case.step_count() * (STEP + LEVEL * case.problem().levels().len() + stress)
        }
    };
    let sites: usize = case.levels.iter().flat_map(|level| &level.sites).map(Vec::len).sum();
    let stress = case.stress.as_ref().map_or(0, |request| 3 * request.points.len() + request.planes.len());
    let listed = 2 * sites + stress + case.step_count();
    CASE + PART * (layers + case.levels.len()) as u64 + LISTED * listed as u64 + SCALAR * scalars as u64
}

//! The fingerprint of a run: one word of all that decides about its result, equal for two runs with the same result.

use super::checksum;
use percoat_case::case::Case;
use std::io::Read;

/// Fingerprint of a run, equal for two runs with equal results: length and checksum of the whole case with its surface, of the task,
/// and of this version of percoat.
pub fn fingerprint(case: &Case, task: &str) -> String {
    // The numbers of a file: of a surface, or of a given pressure.
    let heights = case.problem().loaded_by().samples();
    let points = heights.as_ref().map(|heights| heights.dim());
    let heights = heights.as_ref().map(|heights| heights.as_standard_layout());
    let samples = heights.as_ref().and_then(|heights| heights.as_slice()).unwrap_or_default();
    let text = format!("{} {task} {points:?}\n{}", env!("CARGO_PKG_VERSION"), case.to_toml());
    let (length, checksum) =
        checksum(&mut text.as_bytes().chain(bytemuck::cast_slice(samples))).expect("what is in memory can be read");
    format!("{length:x}-{checksum:016x}")
}

//! What decides about a result, as one word: equal for two runs that end the same.

use super::checksum;
use crate::case::Case;
use std::io::Read;

/// Of a whole case with its surface, what is done with it, and this version of percoat.
pub fn fingerprint(case: &Case, task: &str) -> String {
    let text = format!("{} {task}\n{}", env!("CARGO_PKG_VERSION"), case.to_toml());
    let heights = case.counterbody().topography().map(|own| own.heights().to_owned().into_raw_vec_and_offset().0);
    let heights = heights.unwrap_or_default();
    let (length, checksum) =
        checksum(&mut text.as_bytes().chain(bytemuck::cast_slice(&heights))).expect("what is in memory can be read");
    format!("{length:x}-{checksum:016x}")
}

//! A picture as a file: PNG, SVG or PDF.

use crate::output::{OutputError, write_file};
use percoat_draw::{Canvas, Format};
use std::io::Write;
use std::path::Path;

/// Writes a sheet as `<folder>/<name>.png`, `.svg` or `.pdf`, completely or not at all.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write(canvas: &Canvas, folder: &Path, name: &str, format: Format) -> Result<(), OutputError> {
    let picture = canvas.encoded(format);
    write_file(&folder.join(format!("{name}.{}", format.extension())), |writer| writer.write_all(&picture))
}

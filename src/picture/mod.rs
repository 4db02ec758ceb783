//! Pictures as a journal prints them: charts and fields, as PNG or SVG files.
//!
//! A picture is one column (85 mm) or two columns wide, its letters 6 to 8 points high, its typeface embedded. What is
//! drawn goes on a sheet measured in points ([`canvas`]), which becomes pixels or an SVG file.

mod axis;
mod canvas;
pub mod chart;
mod colour;
mod legend;
mod raster;
mod sheet;
mod text;
mod vector;

pub use axis::{Axis, Scale};
pub use chart::{Chart, Curve, Figure, Style};
pub use colour::{Colour, ColourMap};

use crate::output::{OutputError, write_file};
use std::io::Write;
use std::path::{Path, PathBuf};

/// File format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// Pixels, 300 dots per inch.
    #[default]
    Png,
    /// Lines, texts and, for fields, embedded pixels.
    Svg,
}

impl Format {
    /// Ending of a file name.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
        }
    }
}

/// Writes a picture as `<folder>/<name>.png` or `.svg`, whole or not at all; returns its path.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write_picture(folder: &Path, name: &str, format: Format, picture: &[u8]) -> Result<PathBuf, OutputError> {
    let path = folder.join(format!("{name}.{}", format.extension()));
    write_file(&path, |writer| writer.write_all(picture))?;
    Ok(path)
}

//! A picture as a file: PNG or SVG.

use super::canvas::Canvas;
use super::{raster, vector};
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

impl Canvas {
    /// The file of this sheet.
    pub fn file(&self, format: Format) -> Vec<u8> {
        match format {
            Format::Png => raster::png(self),
            Format::Svg => vector::svg(self).into_bytes(),
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

//! A picture as a file: PNG, SVG or PDF.

use super::canvas::Canvas;
use super::{paper, raster, vector};

/// File format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// Pixels, 300 dots per inch.
    #[default]
    Png,
    /// Lines, letters as outlines and, for fields, embedded pixels.
    Svg,
    /// A page with lines, letters as outlines and embedded pixels.
    Pdf,
}

impl Format {
    /// Extension of file names.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Svg => "svg",
            Self::Pdf => "pdf",
        }
    }
}

impl Canvas {
    /// The sheet as the content of a file.
    pub fn encoded(&self, format: Format) -> Vec<u8> {
        match format {
            Format::Png => raster::png(self),
            Format::Svg => vector::svg(self, raster::OF_FILE).into_bytes(),
            Format::Pdf => paper::pdf(self),
        }
    }

    /// The sheet as SVG for a screen: made quickly, its images of more bytes than those of a file.
    pub fn for_screen(&self) -> String {
        vector::svg(self, raster::ON_SCREEN)
    }
}

//! Options on the pictures of the commands.

use super::ending::Failure;
use clap::Args;
use percoat_app::picture::{self};
use percoat_app::picture::{Canvas, Format};
use std::path::Path;

/// Options of the commands that draw.
#[derive(Debug, Clone, Args)]
pub struct PictureOptions {
    /// Draw no pictures
    #[arg(long, conflicts_with = "pictures")]
    no_pictures: bool,
    /// Formats of the pictures: png, svg, pdf or several
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', value_parser = format, default_value = "png,svg")]
    pictures: Vec<Format>,
}

const FORMATS: [Format; 3] = [Format::Png, Format::Svg, Format::Pdf];

fn format(ending: &str) -> Result<Format, &'static str> {
    FORMATS.into_iter().find(|format| format.extension() == ending).ok_or("must be png, svg or pdf")
}

impl PictureOptions {
    /// Whether pictures are drawn.
    pub fn wanted(&self) -> bool {
        !self.no_pictures
    }

    /// File names of a picture in the chosen formats; none without pictures.
    pub fn files(&self, name: &str) -> Vec<String> {
        self.formats().into_iter().map(|format| format!("{name}.{}", format.extension())).collect()
    }

    /// The chosen formats; none without pictures.
    fn formats(&self) -> Vec<Format> {
        FORMATS.into_iter().filter(|format| self.wanted() && self.pictures.contains(format)).collect()
    }

    /// Writes one picture in the chosen formats, if there is one and pictures are drawn.
    pub fn write(&self, folder: &Path, name: &str, draw: impl FnOnce() -> Option<Canvas>) -> Result<(), Failure> {
        let Some(canvas) = self.wanted().then(draw).flatten() else { return Ok(()) };
        for format in self.formats() {
            picture::write(&canvas, folder, name, format)?;
        }
        Ok(())
    }
}

//! The pictures of the commands, and the options on them.

use super::ending::Failure;
use clap::Args;
use percoat_app::picture::{self, Canvas, Format, Snapshot};
use percoat_core::VerticalSection;
use percoat_core::localized::isolated;
use percoat_core::run::StepRecord;
use rayon::prelude::*;
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

    /// File names of pictures with these names, in all formats.
    pub fn files(&self, names: &[&str]) -> Vec<String> {
        let file = |format: Format| move |name: &&str| format!("{name}.{}", format.extension());
        self.formats().into_iter().flat_map(|format| names.iter().map(file(format))).collect()
    }

    /// The chosen formats; none without pictures.
    fn formats(&self) -> Vec<Format> {
        FORMATS.into_iter().filter(|format| self.wanted() && self.pictures.contains(format)).collect()
    }

    /// Draws the pictures of a solved step, of the sections of its stresses if there are any, and of all steps.
    pub fn draw(
        &self,
        folder: &Path,
        last: &Snapshot,
        sections: &[VerticalSection],
        steps: &[StepRecord],
    ) -> Result<(), Failure> {
        if !self.wanted() {
            return Ok(());
        }
        type Draw<'a> = &'a (dyn Fn() -> Option<Canvas> + Sync);
        let touching = last.reading.touches();
        let sections = Some(sections).filter(|sections| touching && !sections.is_empty());
        let pictures: [(&str, Draw); 7] = [
            ("pressure", &|| touching.then(|| picture::pressure(last))),
            ("contact", &|| {
                touching
                    .then(|| picture::contact(last, isolated::radii(last.step.problem(), &last.reading).as_deref()))?
            }),
            ("profiles", &|| {
                picture::profiles(last, isolated::profiles(last.step.problem(), &last.reading).as_deref())
            }),
            ("indentation", &|| picture::indentation(last)),
            ("section", &|| Some(picture::section(last, sections?))),
            ("lines", &|| Some(picture::lines(last, sections?))),
            ("curve", &|| picture::load_curves(&last.title, last.step.problem(), &last.units, steps)),
        ];
        pictures.par_iter().try_for_each(|(name, draw)| self.write(folder, name, draw))
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

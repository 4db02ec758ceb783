//! The pictures of the commands, and the options on them.

use super::declared::Declared::{self, Picture};
use super::ending::Failure;
use clap::Args;
use percoat_app::picture::{self, Canvas, Format, Snapshot};
use percoat_case::case::Case;
use percoat_core::VerticalSection;
use percoat_core::localized::isolated;
use percoat_core::run::StepRecord;
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

/// The last step of a solved case with the sections of its stresses, if there are any, and all steps.
#[derive(Debug)]
pub struct Solved {
    pub last: Snapshot,
    pub sections: Vec<VerticalSection>,
    pub steps: Vec<StepRecord>,
}

impl Solved {
    fn touches(&self) -> bool {
        self.last.reading.touches()
    }

    fn cut(&self) -> Option<&[VerticalSection]> {
        Some(&self.sections[..]).filter(|sections| self.touches() && !sections.is_empty())
    }

    fn contact(&self) -> Option<Canvas> {
        let radii = isolated::radii(self.last.step.problem(), &self.last.reading);
        if self.touches() { picture::contact(&self.last, radii.as_deref()) } else { None }
    }

    fn profiles(&self) -> Option<Canvas> {
        let profiles = isolated::profiles(self.last.step.problem(), &self.last.reading);
        picture::profiles(&self.last, profiles.as_deref())
    }

    fn curve(&self) -> Option<Canvas> {
        picture::load_curves(&self.last.title, self.last.step.problem(), &self.last.units, &self.steps)
    }
}

/// The pictures of a case with so many load steps.
pub fn of_case(case: &Case, steps: usize) -> Vec<Declared<Solved>> {
    let is_cut = case.stress.as_ref().is_some_and(|stress| stress.section.is_some());
    let is_indented = case.problem().bodies().hardness().is_some();
    let pictures: [(bool, Declared<Solved>); 7] = [
        (true, Picture("pressure", |solved| solved.touches().then(|| picture::pressure(&solved.last)))),
        (true, Picture("contact", Solved::contact)),
        (true, Picture("profiles", Solved::profiles)),
        (is_indented, Picture("indentation", |solved| picture::indentation(&solved.last))),
        (is_cut, Picture("section", |solved| Some(picture::section(&solved.last, solved.cut()?)))),
        (is_cut, Picture("lines", |solved| Some(picture::lines(&solved.last, solved.cut()?)))),
        (steps > 1, Picture("curve", Solved::curve)),
    ];
    pictures.into_iter().filter_map(|(is_drawn, picture)| is_drawn.then_some(picture)).collect()
}

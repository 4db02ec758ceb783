//! The files of a command's result. Each is declared once, by its name and its content; the names that the command may write, known
//! before anything is solved, follow from that.

use super::ending::Failure;
use super::pictures::PictureOptions;
use percoat_app::output::{OutputError, Plan, Writer, write_text};
use percoat_app::picture::Canvas;
use std::path::Path;

/// A file of a result `R`.
#[derive(Debug)]
pub enum Declared<R> {
    /// A text by its name; `None` where the result has none.
    Text(&'static str, fn(&R) -> Option<String>),
    /// A file by its name, which is written to a path.
    File(&'static str, fn(&R, &Path) -> Result<(), OutputError>),
    /// A picture in the chosen formats by its name without their endings; `None` where the result has none.
    Picture(&'static str, fn(&R) -> Option<Canvas>),
}

impl<R> Declared<R> {
    /// Writes the file of a result into a folder.
    pub fn write(&self, result: &R, folder: &Path, pictures: &PictureOptions) -> Result<(), Failure> {
        match self {
            Self::Text(name, text) => text(result).map_or(Ok(()), |text| write_text(&folder.join(name), &text))?,
            Self::File(name, write) => write(result, &folder.join(name))?,
            Self::Picture(name, draw) => pictures.write(folder, name, || draw(result))?,
        }
        Ok(())
    }
}

/// The names of declared files.
pub fn names<R>(files: &[Declared<R>], pictures: &PictureOptions) -> Vec<String> {
    let names = files.iter().map(|file| match file {
        Declared::Text(name, _) | Declared::File(name, _) => vec![(*name).to_owned()],
        Declared::Picture(name, _) => pictures.files(name),
    });
    names.flatten().collect()
}

/// The plan of a command that writes declared files and no others.
pub fn plan<R>(writer: Writer, files: &[Declared<R>], pictures: &PictureOptions) -> Plan {
    Plan { names: names(files, pictures), ..Plan::new(writer) }
}

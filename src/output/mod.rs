//! The output folder: what a run leaves behind.
//!
//! Every file is written under a temporary name and renamed when it is complete. `summary.json` and `curve.csv` are
//! renewed after each load step and the fields of a step stand as `.npy` files in `contact.partial/` until
//! `contact.npz` is made of them, so that what a long run has finished survives its end.

mod comparison;
mod fields;
mod npz;
mod steps;
mod stress;
pub mod summary;
pub mod table;
mod volume;

pub use comparison::CompareFile;
pub use fields::Fields;
pub use steps::StepArrays;
pub use stress::{Section, Stresses, Volume, Wanted};
pub use volume::write_volume;

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Why an output could not be written: which path, and what the system says.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {error}", path.display())]
pub struct OutputError {
    path: PathBuf,
    error: io::Error,
}

impl OutputError {
    fn new(path: &Path, error: io::Error) -> Self {
        Self { path: path.to_owned(), error }
    }
}

/// Makes `folder` and what leads to it.
///
/// # Errors
/// [`OutputError`] with the path that cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(folder).map_err(|error| OutputError::new(folder, error))
}

/// What a run writes into its folder.
const FILES: [&str; 5] = ["summary.json", "curve.csv", "case.toml", "contact.npz", "stress.npz"];

/// What a run draws, as PNG or SVG files.
const PICTURES: [&str; 6] = ["pressure", "contact", "profiles", "section", "lines", "curve"];

/// Removes the picture `name` that an earlier run left in `folder`, in every format.
///
/// # Errors
/// [`OutputError`] with the path that cannot be removed.
pub fn clear_picture(folder: &Path, name: &str) -> Result<(), OutputError> {
    for format in ["png", "svg"] {
        let path = folder.join(format!("{name}.{format}"));
        if path.is_file() {
            fs::remove_file(&path).map_err(|error| OutputError::new(&path, error))?;
        }
    }
    Ok(())
}

/// Removes what an earlier run left in `folder` and this one has not made yet: its files, and what waits or is
/// temporary if it was killed.
///
/// # Errors
/// [`OutputError`] with the path that cannot be read or removed.
pub fn clear(folder: &Path) -> Result<(), OutputError> {
    let entries = fs::read_dir(folder).map_err(|error| OutputError::new(folder, error))?;
    for entry in entries {
        let path = entry.map_err(|error| OutputError::new(folder, error))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let volume = name.starts_with("stress.") && name.ends_with(".vts");
        let pictures =
            || PICTURES.iter().flat_map(|picture| ["png", "svg"].map(|format| format!("{picture}.{format}")));
        let picture = pictures().any(|file| name == file);
        let files = FILES.iter().map(|&file| file.to_owned()).chain(pictures());
        let temporary = name.ends_with(".tmp")
            && (name.starts_with(".stress.") || files.into_iter().any(|file| name.starts_with(&format!(".{file}."))));
        if name == "contact.partial" || name == "stress.partial" {
            fs::remove_dir_all(&path).map_err(|error| OutputError::new(&path, error))?;
            continue;
        }
        // The case may be the one that is running.
        if temporary || volume || picture || (name != "case.toml" && FILES.contains(&&*name)) {
            fs::remove_file(&path).map_err(|error| OutputError::new(&path, error))?;
        }
    }
    Ok(())
}

/// Writes a file under a temporary name in its folder, then renames it: it is there whole or not at all.
///
/// # Errors
/// [`OutputError`] with the path; nothing is left behind.
pub fn write_file(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<fs::File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
    let write = || -> io::Result<()> {
        let mut writer = BufWriter::new(fs::File::create(&temporary)?);
        content(&mut writer)?;
        writer.flush()?;
        drop(writer);
        fs::rename(&temporary, path)
    };
    write().map_err(|error| {
        // The first error is the one to report; a leftover that cannot be removed changes nothing about it.
        let _ = fs::remove_file(&temporary);
        OutputError::new(path, error)
    })
}

/// Writes a text file as [`write_file`] does.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    write_file(path, |writer| writer.write_all(text.as_bytes()))
}

//! A log of lines, `steps.jsonl` or `sweep.jsonl`: an object of JSON a line, with its [checksum](super::trailer), appended when
//! its step or combination is done.
//!
//! The first lines and the name of the file appear in one move; each later line is on the disk when `add` returns. After a kill
//! every terminated line is whole; an unterminated one is cut off before the log is used again.

use super::disk;
use super::error::AtPath;
use super::{OutputError, write_file, write_text};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

/// A log to which lines are added.
#[derive(Debug)]
pub(crate) struct LineLog {
    path: PathBuf,
    /// The lines before the first one that is added; with it they replace the file.
    known: String,
    /// Open from the first line on.
    file: Option<File>,
}

impl LineLog {
    /// A log that continues after the `known` lines.
    pub(crate) fn new(path: PathBuf, known: String) -> Self {
        Self { path, known, file: None }
    }

    /// Adds whole lines.
    ///
    /// # Errors
    /// [`OutputError`] with the path.
    pub(crate) fn add(&mut self, lines: &str) -> Result<(), OutputError> {
        if let Some(file) = &mut self.file {
            return disk::append(file, lines.as_bytes()).at(&self.path);
        }
        write_text(&self.path, &(std::mem::take(&mut self.known) + lines))?;
        self.file = Some(disk::open_to_append(&self.path).at(&self.path)?);
        self.path.parent().map_or(Ok(()), disk::sync_folder).at(&self.path)
    }
}

/// Whether a log exists and has a whole line.
pub(super) fn has_whole_line(path: &Path) -> bool {
    let line = disk::open(path).and_then(|file| {
        let mut line = Vec::new();
        BufReader::new(file).read_until(b'\n', &mut line)?;
        Ok(line)
    });
    line.is_ok_and(|line| line.ends_with(b"\n"))
}

/// Cuts off an unterminated line, which a kill or a full disk leaves; removes a log without a whole line.
pub(super) fn cut(path: &Path) -> Result<(), OutputError> {
    if !disk::is_file(path) {
        return Ok(());
    }
    let bytes = disk::read(path).at(path)?;
    match bytes.iter().rposition(|byte| *byte == b'\n') {
        None => disk::remove(path).at(path),
        // The file may have a second name elsewhere, whose content must stay.
        Some(end) if end + 1 < bytes.len() => write_file(path, |writer| writer.write_all(&bytes[..=end])),
        Some(_) => Ok(()),
    }
}

/// The whole lines of a log, without an unterminated one. Bytes that are not UTF-8 become U+FFFD, so that the checksum of their
/// line no longer fits.
///
/// # Errors
/// When it cannot be read.
pub fn whole_lines(path: &Path) -> io::Result<Vec<String>> {
    let mut bytes = disk::read(path)?;
    bytes.truncate(bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1));
    Ok(String::from_utf8_lossy(&bytes).lines().map(str::to_owned).collect())
}

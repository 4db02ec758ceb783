//! Sources of cases: files, standard input, values in memory.

use ndarray::ArrayD;
use percoat_common::plain;
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::{CaseError, Refusal};
use super::keys::Keys;
use super::named_pipes::{Pipes, is_pipe};
use super::node::Table;
use super::overrides;
use super::span::Span;

/// Sizes of an array of heights in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct PhysicalSizes {
    /// Sides along a₁ and a₂, lengths in `unit`.
    pub sides: [f64; 2],
    /// Unit of the sides and heights; none for that of the case.
    pub unit: Option<String>,
}

/// Text of a case with its name and its files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Source {
    /// Name shown in errors, such as the path of the file.
    pub name: String,
    /// The TOML; empty with `values`.
    pub text: String,
    /// The case as values without a text, such as those of a dict of Python.
    pub values: Option<toml::Table>,
    /// Values that replace those of the case, by their dotted keys, in their order and before any override.
    pub set: Vec<(String, toml::Value)>,
    /// Folder to which the path of a surface's file is relative.
    pub folder: PathBuf,
    /// Files in memory by their names in the case; they take precedence over those of the folder.
    pub files: BTreeMap<String, Arc<[u8]>>,
    /// Arrays of heights in memory, axis 0 along a₁, by their names in the case.
    pub arrays: BTreeMap<String, Arc<ArrayD<f64>>>,
    /// Sizes of those arrays that have them.
    pub sizes: BTreeMap<String, PhysicalSizes>,
    /// Content of pipes among its files, which can be read only once.
    pub pipes: Pipes,
}

/// Largest case file, bytes: a case of ten thousand loads and sites has a tenth of it.
const LONGEST: u64 = 16 << 20;

impl Source {
    /// Reads the case file at `path`; for a pipe a surface's file is relative to the working folder.
    ///
    /// # Errors
    /// When the file cannot be read; [`io::ErrorKind::InvalidData`] when it is longer than 16 MiB or not UTF-8.
    pub fn file(path: &Path) -> io::Result<Self> {
        let folder = path.parent().filter(|_| !is_pipe(path)).map(Path::to_path_buf).unwrap_or_default();
        Self::of(plain::path(path), folder, fs::File::open(path)?)
    }

    /// Reads a case from standard input; a surface's file is relative to the working folder.
    ///
    /// # Errors
    /// The errors of [`Source::file`].
    pub fn standard_input() -> io::Result<Self> {
        Self::of("standard input".to_owned(), PathBuf::new(), io::stdin().lock())
    }

    /// The text of another file of the case, by its name there.
    pub(super) fn text_of(&self, name: &str) -> io::Result<Self> {
        let shown = self.path(name).map_or_else(|| name.to_owned(), |path| plain::path(&path));
        Self::of(shown, PathBuf::new(), self.open(name)?.0)
    }

    fn is_in_memory(&self, name: &str) -> bool {
        self.files.contains_key(name) || self.arrays.contains_key(name)
    }

    /// The tree of the case, which has these `keys`, with the values that are set.
    pub(super) fn tree(&self, keys: &'static Keys) -> Result<Table, Refusal> {
        let mut tree = match &self.values {
            Some(values) => Table::of(values, Span::NOWHERE),
            None => Table::parse(&self.text)?,
        };
        for (number, (key, value)) in (1..).zip(&self.set) {
            overrides::replace(key, value, number, &mut tree, keys)?;
        }
        Ok(tree)
    }

    /// Result of `read` on the source, or its refusal with the text in which it stands.
    pub(super) fn read<T>(
        &self,
        overrides: &[String],
        read: impl Fn(&Self) -> Result<T, Refusal>,
    ) -> Result<T, CaseError> {
        read(self).map_err(|refusal| self.error_of(refusal, overrides, read))
    }

    /// The error of a refusal by `read`, with the text in which it stands.
    pub(super) fn error_of<T>(
        &self,
        refusal: Refusal,
        overrides: &[String],
        read: impl Fn(&Self) -> Result<T, Refusal>,
    ) -> CaseError {
        match self.as_text() {
            // Values have no lines to show: the text of them is made, and refused in turn, where they are.
            Some(text) => text.error(overrides, read(&text).err().unwrap_or(refusal)),
            None => self.error(overrides, refusal),
        }
    }

    /// A case of values as text; `None` of one that is text.
    fn as_text(&self) -> Option<Self> {
        let text = toml::to_string(self.values.as_ref()?).ok()?;
        Some(Self { text, values: None, ..self.clone() })
    }

    /// The error of a refusal, with the text into which its span points: of the case, of what is set as `KEY=VALUE`, or of an override.
    fn error(&self, overrides: &[String], refusal: Refusal) -> CaseError {
        let Some(index) = refusal.span.source.checked_sub(1) else {
            return CaseError::new(&self.name, &self.text, refusal);
        };
        match self.set.get(index) {
            Some((key, value)) => CaseError::new("--set", &format!("{key}={value}"), refusal),
            None => CaseError::new("--set", &overrides[index - self.set.len()], refusal),
        }
    }

    /// Path of the file `name` of the case; `None` for one in memory.
    pub(super) fn path(&self, name: &str) -> Option<PathBuf> {
        let path = || self.folder.join(name);
        (!self.is_in_memory(name)).then(|| std::path::absolute(path()).unwrap_or_else(|_| path()))
    }

    /// Opens the file `name` of the case; returns its length in bytes too. A pipe is read whole, once for all readers.
    pub(super) fn open(&self, name: &str) -> io::Result<(Box<dyn BufRead + '_>, u64)> {
        if let Some(bytes) = self.files.get(name) {
            return Ok((Box::new(&bytes[..]), bytes.len() as u64));
        }
        let path = self.folder.join(name);
        if is_pipe(&path) {
            let bytes = self.pipes.read(&path)?;
            let length = bytes.len() as u64;
            return Ok((Box::new(io::Cursor::new(bytes)), length));
        }
        let file = fs::File::open(path)?;
        let length = file.metadata()?.len();
        Ok((Box::new(BufReader::new(file)), length))
    }

    /// Whether the file `name` of the case is a pipe, which has no ending of a format.
    pub(super) fn is_pipe(&self, name: &str) -> bool {
        !self.is_in_memory(name) && is_pipe(&self.folder.join(name))
    }

    fn of(name: String, folder: PathBuf, file: impl Read) -> io::Result<Self> {
        let mut bytes = Vec::new();
        file.take(LONGEST + 1).read_to_end(&mut bytes)?;
        let refused = |what: String| io::Error::new(io::ErrorKind::InvalidData, what);
        if bytes.len() as u64 > LONGEST {
            return Err(refused(format!("{name} is longer than 16 MiB: it is no case file")));
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self { name, text, folder, ..Self::default() }),
            Err(error) => Err(refused(not_utf8(&name, error.as_bytes(), error.utf8_error().valid_up_to()))),
        }
    }
}

/// Message on the first byte of a file that is not UTF-8.
fn not_utf8(name: &str, bytes: &[u8], at: usize) -> String {
    let (before, byte) = (&bytes[..at], bytes[at]);
    let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
    let start = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    let column = 1 + String::from_utf8_lossy(&before[start..]).chars().count();
    let guess = match bytes {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "it looks like UTF-16",
        _ => "it may be in Latin-1 or another old encoding",
    };
    format!("{name}:{line}:{column}: the case is not UTF-8 text (byte {byte:#04x}): {guess}; save it as UTF-8")
}

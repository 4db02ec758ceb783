//! Heights as a file holds them, and what can be wrong with any of them.

use std::io::BufRead;

use super::super::keys::CARRIED;
use super::super::node::plain;
use super::super::resources::bytes;
use super::super::room::available_memory;

/// Most samples along a cell vector.
pub(super) const MOST: usize = 32_768;

/// Heights of one period of a surface.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::case) struct Heights {
    /// Samples along a₁ and a₂.
    pub(in crate::case) points: [usize; 2],
    /// Protrusion upward at each sample, n₁ × n₂ values, a₂ fastest.
    pub(in crate::case) values: Vec<f64>,
}

/// Why a file is refused, without its name and that of the key.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::case) struct Fault {
    pub(super) what: String,
    /// Stands at the excerpt of the case.
    pub(super) label: String,
    pub(super) help: Option<String>,
}

impl Fault {
    pub(super) fn new(what: impl Into<String>, label: impl Into<String>) -> Self {
        Self { what: what.into(), label: label.into(), help: None }
    }

    /// What to do about it.
    pub(super) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// What stands at the excerpt.
    pub(super) fn label(self) -> String {
        self.label
    }

    fn unreadable(error: &std::io::Error) -> Self {
        Self::new(format!("cannot be read: {error}"), "this file")
    }
}

impl Heights {
    /// Of n₁ × n₂ samples, each a number that double precision carries.
    pub(super) fn new(points: [usize; 2], values: Vec<f64>) -> Result<Self, Fault> {
        let [n1, n2] = points;
        if points.iter().any(|n| !(2..=MOST).contains(n)) {
            let what = format!("holds {n1} × {n2} heights; there must be between 2 and {MOST} along either direction");
            return Err(Fault::new(what, format!("{n1} × {n2} heights")));
        }
        match values.iter().position(|height| height.is_nan() || height.abs() > *CARRIED.end()) {
            None => Ok(Self { points, values }),
            Some(k) => Err(Fault::new(
                format!("holds {} at [{}, {}]", plain(values[k]), k / n2, k % n2),
                "every height must be finite and at most 1e60",
            )
            .help("fill what was not measured before, as from its neighbours")),
        }
    }
}

/// Refuses what takes more memory than there is.
pub(in crate::case) fn fits(needed: u64) -> Result<(), Fault> {
    let room = available_memory();
    if needed <= room {
        return Ok(());
    }
    let what = format!("takes about {} of memory to read, and {} are available", bytes(needed), bytes(room));
    Err(Fault::new(what, "too large"))
}

/// Lines of a text that hold anything, with their numbers from 1.
#[derive(Debug)]
pub(super) struct Lines<R> {
    reader: R,
    number: usize,
    bytes: Vec<u8>,
}

/// Bytes of the longest line that is read: 32768 numbers of 32 digits.
const LONGEST: usize = 1 << 20;

impl<R: BufRead> Lines<R> {
    pub(super) fn new(reader: R) -> Self {
        Self { reader, number: 0, bytes: Vec::new() }
    }

    /// The next line that is neither empty nor a comment, without blanks around it.
    pub(super) fn next_line(&mut self) -> Result<Option<(usize, String)>, Fault> {
        loop {
            self.bytes.clear();
            let limit = LONGEST as u64 + 1;
            let mut limited = std::io::Read::take(&mut self.reader, limit);
            let read = limited.read_until(b'\n', &mut self.bytes).map_err(|error| Fault::unreadable(&error))?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
            if self.bytes.len() > LONGEST {
                return Err(Fault::new(format!("line {} has more than a mebibyte", self.number), "no text of numbers"));
            }
            // What is no number is refused by the line; comments may be in any encoding.
            let text = String::from_utf8_lossy(&self.bytes);
            let text = text.trim_start_matches('\u{feff}').trim_matches(|c: char| c.is_whitespace() && c != '\t');
            let text = text.trim_end();
            if !text.trim().is_empty() && !text.starts_with(['#', '%']) {
                return Ok(Some((self.number, text.to_owned())));
            }
        }
    }
}

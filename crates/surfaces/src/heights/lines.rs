//! Lines of a text of heights: those with numbers one by one, the comments between them in a [`Header`].

use super::fault::Fault;
use super::header::Header;
use std::io::BufRead;

/// Longest line, bytes: 32768 numbers of 32 digits.
const LONGEST: usize = 1 << 20;

/// A line that is not empty and not a comment.
#[derive(Debug)]
pub struct Line {
    /// Number in the file, from 1.
    pub number: usize,
    /// Text without blanks around it.
    pub text: String,
    /// Whether an empty line or a comment precedes it.
    pub is_apart: bool,
}

/// Reader of the lines of a text, without empty ones and comments.
#[derive(Debug)]
pub struct Lines<R> {
    reader: R,
    number: usize,
    begun: bool,
    bytes: Vec<u8>,
    /// Header from the comments so far.
    pub header: Header,
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Self {
        Self { reader, number: 0, begun: false, bytes: Vec::new(), header: Header::default() }
    }

    /// The next line that is neither empty nor a comment.
    pub fn next_line(&mut self) -> Result<Option<Line>, Fault> {
        let mut is_apart = false;
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
            if self.number == 1 && (self.bytes.starts_with(&[0xff, 0xfe]) || self.bytes.starts_with(&[0xfe, 0xff])) {
                return Err(Fault::new("looks like UTF-16", "which encoding?").help("save it as UTF-8 or plain ASCII"));
            }
            // Comments may be in any encoding; a number that cannot be read is refused later.
            let text = String::from_utf8_lossy(&self.bytes);
            let text = text.trim_start_matches('\u{feff}').trim_matches(|c: char| c.is_whitespace() && c != '\t');
            let text = text.trim_end();
            if let Some(comment) = text.trim_start().strip_prefix(['#', '%']) {
                self.header.note(self.number, comment, self.begun)?;
            } else if !text.trim().is_empty() {
                self.begun = true;
                return Ok(Some(Line { number: self.number, text: text.to_owned(), is_apart }));
            }
            is_apart = true;
        }
    }
}

//! A checksum trailer: the end of a text holds the length and checksum of all before it. Flipped bits, edited numbers and cut
//! texts are detected; a deliberate forgery with a new checksum is not.
//!
//! A line of a log is an object of JSON whose last key is the trailer: `{"step":1,…}` is written as
//! `{"step":1,…,"seal":"1234-0123456789abcdef"}`, which is JSON too.

use super::checksum::checksum;

/// The texts before and after the length and checksum.
#[derive(Debug)]
pub(crate) struct Trailer {
    /// Text before them.
    pub(crate) before: &'static str,
    /// Text after them, to the end.
    pub(crate) after: &'static str,
}

/// The trailer of a line of a log.
const LINE: Trailer = Trailer { before: ",\"seal\":\"", after: "\"}" };

/// Why a text is not accepted as unchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum TrailerError {
    /// No checksum.
    #[error("it has no checksum, as lines of earlier versions have none")]
    Missing,
    /// The checksum is that of another text.
    #[error("its checksum is not that of its content, which has been changed or damaged since it was written")]
    Different,
}

impl Trailer {
    /// The text with its trailer.
    pub(crate) fn added(&self, text: &str) -> String {
        format!("{text}{}{}{}", self.before, digest(text), self.after)
    }

    /// Removes the trailer of a text.
    ///
    /// # Errors
    /// [`TrailerError`] where the text was changed since it was written.
    pub(crate) fn removed<'a>(&self, text: &'a str) -> Result<&'a str, TrailerError> {
        let (content, end) = text.rsplit_once(self.before).ok_or(TrailerError::Missing)?;
        let is_same = end.strip_suffix(self.after) == Some(&digest(content));
        if is_same { Ok(content) } else { Err(TrailerError::Different) }
    }
}

/// Length and checksum of a text in the form of a trailer.
pub fn digest(text: &str) -> String {
    let (length, sum) = checksum(&mut text.as_bytes()).expect("memory can be read");
    format!("{length}-{sum:016x}")
}

/// An object of JSON in one line, with its checksum as the last key.
pub fn with_checksum(object: &str) -> String {
    LINE.added(object.strip_suffix('}').expect("an object ends with a brace"))
}

/// The object of JSON to which a checksum was added.
///
/// # Errors
/// [`TrailerError`] where the line was changed since it was written.
pub fn without_checksum(line: &str) -> Result<String, TrailerError> {
    Ok(LINE.removed(line)?.to_owned() + "}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_letter_of_a_line_with_a_checksum_can_be_changed_left_out_or_doubled() {
        let object = r#"{"step":1,"title":"µ,\"seal\":\"1-2\"","load":0.1}"#;
        let line = with_checksum(object);
        assert_eq!(without_checksum(&line).unwrap(), object);
        assert!(serde_json::from_str::<serde_json::Value>(&line).is_ok());
        let letters: Vec<char> = line.chars().collect();
        for at in 0..letters.len() {
            let with =
                |new: &[char]| [&letters[..at], new, &letters[at + 1..]].concat().into_iter().collect::<String>();
            for other in [with(&[]), with(&[letters[at], letters[at]]), with(&['7', '8']), with(&['\u{fffd}'])] {
                assert!(other == line || without_checksum(&other).is_err(), "{other}");
            }
        }
        assert_eq!(without_checksum(object), Err(TrailerError::Missing), "a title that looks like a trailer is none");
        assert_eq!(without_checksum("{\"step\":1}"), Err(TrailerError::Missing));
    }
}

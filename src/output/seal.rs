//! Texts that tell whether they are as they were written: a line of a log ends with its own length and checksum.
//!
//! `{"step":1,…}` is written as `{"step":1,…,"seal":"1234-0123456789abcdef"}`, which is JSON too. A bit that is flipped, a
//! number that is edited and a line that is cut are noticed; the sums are no secret and keep out nobody who computes them anew.

use super::checksum::checksum;

const BEFORE: &str = ",\"seal\":\"";
const AFTER: &str = "\"}";

/// Why a line is not believed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum Unsealed {
    /// It has no checksum.
    #[error("it has no checksum, as lines of earlier versions have none")]
    Absent,
    /// It has another one.
    #[error("its checksum is not that of its content, which has been changed or damaged since it was written")]
    Unlike,
}

/// Length and checksum of a text, as a seal tells them.
pub fn seal(text: &str) -> String {
    let (length, sum) = checksum(&mut text.as_bytes()).expect("memory can be read");
    format!("{length}-{sum:016x}")
}

/// An object of JSON in one line, with its seal as the last key.
pub fn sealed(object: &str) -> String {
    let content = object.strip_suffix('}').expect("an object ends with a brace");
    format!("{content}{BEFORE}{}{AFTER}", seal(content))
}

/// The object that was sealed.
///
/// # Errors
/// [`Unsealed`] when the line is not as it was written.
pub fn unsealed(line: &str) -> Result<String, Unsealed> {
    let (content, end) = line.rsplit_once(BEFORE).ok_or(Unsealed::Absent)?;
    if end.strip_suffix(AFTER) == Some(&seal(content)) { Ok(format!("{content}}}")) } else { Err(Unsealed::Unlike) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_letter_of_a_sealed_line_can_be_changed_left_out_or_doubled() {
        let object = r#"{"step":1,"title":"µ,\"seal\":\"1-2\"","load":0.1}"#;
        let line = sealed(object);
        assert_eq!(unsealed(&line).unwrap(), object);
        assert!(serde_json::from_str::<serde_json::Value>(&line).is_ok());
        let letters: Vec<char> = line.chars().collect();
        for at in 0..letters.len() {
            let with =
                |new: &[char]| [&letters[..at], new, &letters[at + 1..]].concat().into_iter().collect::<String>();
            for other in [with(&[]), with(&[letters[at], letters[at]]), with(&['7', '8']), with(&['\u{fffd}'])] {
                assert!(other == line || unsealed(&other).is_err(), "{other}");
            }
        }
        assert_eq!(unsealed(object), Err(Unsealed::Absent), "a title that looks like a seal is none");
        assert_eq!(unsealed("{\"step\":1}"), Err(Unsealed::Absent));
    }
}

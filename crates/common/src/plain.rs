//! Texts of users, made safe for a terminal, a picture or a page.
//!
//! Titles, keys, values, paths and the content of files may have invisible characters with effects: escape sequences that move the
//! cursor or rename the window, marks that turn the direction of writing (U+202E), letters without width. Each is replaced by its
//! escape `\u202E`, which JSON and TOML read back. All other text is unchanged.

use std::borrow::Cow;
use std::path::Path;

/// Whether a character is invisible: control characters, marks of direction, letters without width, and the code points that are
/// not characters and that XML forbids.
pub fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c,
            // Soft hyphen, joiners and fillers of several scripts.
            '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}'..='\u{1160}' | '\u{17b4}'..='\u{17b5}' | '\u{180e}' | '\u{3164}' | '\u{ffa0}'
            // Spaces without width, directions, separators of lines, invisible operators.
            | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            // Byte order, annotations, shorthand, music, tags.
            | '\u{feff}' | '\u{fff0}'..='\u{fffb}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}' | '\u{e0000}'..='\u{e0fff}'
            | '\u{fdd0}'..='\u{fdef}')
        || u32::from(c) & 0xfffe == 0xfffe
}

/// A text of one line: ends of lines and tabs are replaced too.
pub fn line(text: &str) -> Cow<'_, str> {
    replaced(text, |_, _| true)
}

/// A text of several lines, which keeps their ends and its tabs.
pub fn lines(text: &str) -> Cow<'_, str> {
    replaced(text, |c, rest| !(matches!(c, '\n' | '\t') || c == '\r' && rest.starts_with('\n')))
}

/// A path in a sentence.
pub fn path(path: &Path) -> String {
    line(&path.to_string_lossy()).into_owned()
}

/// A number in short form: decimal, or with an exponent where it is very small or large.
pub fn float(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() || (1e-3..1e6).contains(&size) {
        value.to_string().replace("NaN", "nan")
    } else {
        format!("{value:e}")
    }
}

/// The text with the hidden characters that are `unwanted`, given what follows them, replaced by their escapes.
fn replaced(text: &str, unwanted: impl Fn(char, &str) -> bool) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::with_capacity(text.len() + 16);
    for (at, c) in text.char_indices() {
        if is_hidden(c) && unwanted(c, &text[at + c.len_utf8()..]) {
            // Escapes as in JSON: two of them make a character beyond U+FFFF.
            c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| plain += &format!("\\u{unit:04X}"));
        } else {
            plain.push(c);
        }
    }
    Cow::Owned(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_as_itself_stays() {
        for text in ["", "a title", "p̄/E₂ in % – µm, Å, °, ≤", "Стали и покрытия", "日本語", "a\u{a0}b", "❤\u{fe0f}"]
        {
            assert!(matches!(line(text), Cow::Borrowed(borrowed) if borrowed == text), "{text}");
        }
        assert_eq!(lines("a\tb\r\nc\n"), "a\tb\r\nc\n");
    }

    #[test]
    fn what_acts_is_seen() {
        for (text, one, several) in [
            ("\u{1b}[2J\u{7}", "\\u001B[2J\\u0007", "\\u001B[2J\\u0007"),
            ("\u{9b}31m", "\\u009B31m", "\\u009B31m"),
            ("a\u{202e}b\u{2066}c\u{200b}", "a\\u202Eb\\u2066c\\u200B", "a\\u202Eb\\u2066c\\u200B"),
            ("a\nb\rc\td", "a\\u000Ab\\u000Dc\\u0009d", "a\nb\\u000Dc\td"),
            ("\u{2028}\u{85}\u{b}", "\\u2028\\u0085\\u000B", "\\u2028\\u0085\\u000B"),
            ("\u{0}\u{ffff}\u{feff}", "\\u0000\\uFFFF\\uFEFF", "\\u0000\\uFFFF\\uFEFF"),
            ("\u{e0067}", "\\uDB40\\uDC67", "\\uDB40\\uDC67"),
        ] {
            assert_eq!((&*line(text), &*lines(text)), (one, several), "{text:?}");
        }
    }
}

//! Encodings of text files of instruments and spreadsheets.

use std::borrow::Cow;

/// A text in UTF-8, or else in Latin-1, whose bytes are the first 256 characters of Unicode.
pub fn utf8_or_latin1(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_utf8_is_latin1() {
        assert!(matches!(utf8_or_latin1("Höhe in µm".as_bytes()), Cow::Borrowed("Höhe in µm")));
        assert_eq!(utf8_or_latin1(b"H\xf6he in \xb5m"), "Höhe in µm");
        let all: Vec<u8> = (0..=255).collect();
        assert!(utf8_or_latin1(&all).chars().eq((0..256).filter_map(char::from_u32)));
    }
}

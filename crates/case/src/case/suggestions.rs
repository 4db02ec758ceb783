//! The nearest known word to a misspelt one, and lists joined in words.

use std::fmt::Write as _;

/// The known word nearest to a misspelt one, and their similarity, at most 1.
pub(super) fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<(&'a str, f64)> {
    let word = word.to_lowercase().replace('_', "-");
    known
        .iter()
        .map(|known| (*known, strsim::jaro_winkler(&word, &known.replace('_', "-"))))
        .filter(|(_, likeness)| *likeness > 0.8)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Names in quotes, joined by commas and "or".
pub(super) fn alternatives(names: &[impl AsRef<str>], quote: char) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("{quote}{}{quote}", name.as_ref())).collect();
    joined(&quoted, "or")
}

/// Names joined by commas, with `word` before the last one.
pub fn joined(names: &[impl AsRef<str>], word: &str) -> String {
    let mut text = String::new();
    for (index, name) in names.iter().enumerate() {
        let joint = match index {
            0 => String::new(),
            _ if index + 1 == names.len() => format!(" {word} "),
            _ => ", ".to_owned(),
        };
        // Writing into a String cannot fail.
        let _ = write!(text, "{joint}{}", name.as_ref());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_similar_words_are_suggested() {
        let nearest = |word, known| nearest(word, known).map(|(known, _)| known);
        let known = ["thickness", "shear_ratio", "young", "poisson", "interface"];
        assert_eq!(nearest("thicknes", &known), Some("thickness"));
        assert_eq!(nearest("Poison", &known), Some("poisson"));
        assert_eq!(nearest("shear-ratio", &known), Some("shear_ratio"));
        assert_eq!(nearest("colour", &known), None);
    }

    #[test]
    fn the_last_of_a_list_follows_an_or() {
        assert_eq!(alternatives(&["a", "b", "c"], '"'), "\"a\", \"b\" or \"c\"");
        assert_eq!((joined(&["a", "b"], "and"), alternatives(&["a"], '`')), ("a and b".to_owned(), "`a`".to_owned()));
    }
}

//! HTML that is well-formed by the way it is made: texts are escaped, every element that is opened is closed.

use percoat_common::plain;

/// A piece of a page.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Markup(String);

impl Markup {
    pub(super) fn as_str(&self) -> &str {
        &self.0
    }

    /// HTML that is not escaped: percoat's own stylesheet, never a text of a result.
    pub(super) fn unescaped(text: &str) -> Self {
        Self(text.to_owned())
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl From<&str> for Markup {
    fn from(text: &str) -> Self {
        Self(escaped(text))
    }
}

impl From<String> for Markup {
    fn from(text: String) -> Self {
        Self(escaped(&text))
    }
}

impl From<Vec<Markup>> for Markup {
    fn from(parts: Vec<Markup>) -> Self {
        parts.into_iter().collect()
    }
}

impl FromIterator<Markup> for Markup {
    fn from_iter<T: IntoIterator<Item = Markup>>(parts: T) -> Self {
        Self(parts.into_iter().map(|part| part.0).collect())
    }
}

/// A text whose numbers stay with their errors and units on one line.
pub(super) fn numbers(text: &str) -> Markup {
    text.replace(" ± ", "\u{a0}±\u{a0}").replace(" %", "\u{a0}%").replace(" = ", "\u{a0}=\u{a0}").as_str().into()
}

/// An element.
pub(super) fn tag(name: &str, content: impl Into<Markup>) -> Markup {
    with(name, &[], content)
}

/// An element with attributes.
pub(super) fn with(name: &str, attributes: &[(&str, &str)], content: impl Into<Markup>) -> Markup {
    let content = content.into().0;
    let line = if BLOCKS.contains(&name) { "\n" } else { "" };
    Markup(format!("{}{content}</{name}>{line}", opening(name, attributes)))
}

/// An element that has no content and no end.
pub(super) fn void(name: &str, attributes: &[(&str, &str)]) -> Markup {
    Markup(opening(name, attributes))
}

fn opening(name: &str, attributes: &[(&str, &str)]) -> String {
    let attributes = attributes.iter().map(|(name, value)| format!(" {name}=\"{}\"", escaped(value)));
    format!("<{name}{}>", attributes.collect::<String>())
}

/// Elements that end a line of the file.
const BLOCKS: [&str; 16] = [
    "head", "body", "header", "main", "article", "section", "footer", "h1", "h2", "h3", "p", "table", "tr", "figure",
    "ul", "pre",
];

/// A text for use between tags and within quotes, control characters made visible.
fn escaped(text: &str) -> String {
    let letter = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        '\'' => "&#39;".to_owned(),
        c => c.to_string(),
    };
    plain::lines(text).chars().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_texts_wherever_they_stand() {
        let text = "<script>alert('a & \"b\"')</script>\u{0}\u{202e}";
        let markup = with("p", &[("title", text)], text);
        let escaped = "&lt;script&gt;alert(&#39;a &amp; &quot;b&quot;&#39;)&lt;/script&gt;\\u0000\\u202E";
        assert_eq!(markup.as_str(), format!("<p title=\"{escaped}\">{escaped}</p>\n"));
    }
}

//! A case as a tree of values with their places in the text.
//!
//! The tree is converted once from that of the TOML parser, or from values without a text; then overrides change it and the reader
//! reads it.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::Refusal;
use super::span::Span;
use percoat_common::plain;

/// A value and its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) span: Span,
}

/// A TOML value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    /// A 64-bit integer; a larger one becomes the nearest float, in hexadecimal, octal or binary infinity.
    Integer(i64),
    /// Any float; the reader refuses those that are not finite.
    Float(f64),
    Boolean(bool),
    Date(String),
    List(Vec<Node>),
    Table(Table),
}

/// Keys and their values, in the order in which they were written.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Table {
    pub(super) entries: Vec<Entry>,
}

/// A key and its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) key_span: Span,
    pub(super) node: Node,
}

impl Table {
    /// Parses a whole document, source number 0.
    pub(super) fn parse(text: &str) -> Result<Self, Refusal> {
        match DeTable::parse(text) {
            Ok(table) => Ok(SourceOffset { source: 0, offset: 0 }.table(table.get_ref())),
            Err(error) => Err(syntax(&error, Span::new(0, 0..0), text)),
        }
    }

    pub(super) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The value of a key.
    pub(super) fn get_mut(&mut self, key: &str) -> Option<&mut Node> {
        self.entries.iter_mut().find(|entry| entry.key == key).map(|entry| &mut entry.node)
    }

    /// Adds an entry, or replaces the one with its key.
    pub(super) fn insert(&mut self, entry: Entry) {
        self.remove(&entry.key);
        self.entries.push(entry);
    }

    /// Removes the entry of a key, if any.
    pub(super) fn remove(&mut self, key: &str) {
        self.entries.retain(|entry| entry.key != key);
    }
}

impl Node {
    /// Parses the single value `text` at the byte `offset` of source number `source`.
    pub(super) fn parse(text: &str, source: usize, offset: usize) -> Result<Self, Refusal> {
        match DeValue::parse(text) {
            Ok(value) => Ok(SourceOffset { source, offset }.node(&value)),
            Err(error) => Err(syntax(&error, Span::new(source, offset..offset + text.len()), text)),
        }
    }
}

impl Value {
    /// Description of the value for "not …" in an error.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Text(text) => format!("the text {text:?}"),
            Self::Integer(value) => value.to_string(),
            Self::Float(value) => plain::float(*value),
            Self::Boolean(value) => value.to_string(),
            Self::Date(date) => format!("the date {date}"),
            Self::List(items) if items.is_empty() => "an empty list".to_owned(),
            Self::List(items) if items.len() == 1 => "a list of one item".to_owned(),
            Self::List(items) => format!("a list of {} items", items.len()),
            Self::Table(table) if table.entries.is_empty() => "an empty table".to_owned(),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

impl Table {
    /// The tree of values that stand in no text; an error of each shows `span`.
    pub(super) fn of(values: &toml::Table, span: Span) -> Self {
        let entry = |(key, value): (&String, &toml::Value)| Entry {
            key: key.clone(),
            key_span: span,
            node: Node::of(value, span),
        };
        Self { entries: values.iter().map(entry).collect() }
    }
}

impl Node {
    /// A value that stands in no text, of which an error shows `span`.
    pub(super) fn of(value: &toml::Value, span: Span) -> Self {
        let value = match value {
            toml::Value::String(text) => Value::Text(text.clone()),
            toml::Value::Integer(value) => Value::Integer(*value),
            toml::Value::Float(value) => Value::Float(*value),
            toml::Value::Boolean(value) => Value::Boolean(*value),
            toml::Value::Datetime(date) => Value::Date(date.to_string()),
            toml::Value::Array(items) => Value::List(items.iter().map(|item| Self::of(item, span)).collect()),
            toml::Value::Table(table) => Value::Table(Table::of(table, span)),
        };
        Self { value, span }
    }
}

/// Source of a parsed text, and the byte at which it begins there.
struct SourceOffset {
    source: usize,
    offset: usize,
}

impl SourceOffset {
    fn span<T>(&self, spanned: &Spanned<T>) -> Span {
        let span = spanned.span();
        Span::new(self.source, span.start + self.offset..span.end + self.offset)
    }

    fn node(&self, value: &Spanned<DeValue<'_>>) -> Node {
        Node { value: self.value(value.get_ref()), span: self.span(value) }
    }

    fn value(&self, value: &DeValue<'_>) -> Value {
        match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(value) => Value::Integer(value),
                Err(_) if integer.radix() == 10 => Value::Float(integer.as_str().parse().unwrap_or(f64::INFINITY)),
                Err(_) => Value::Float(f64::INFINITY),
            },
            // The parser admits only numbers.
            DeValue::Float(float) => Value::Float(float.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(value) => Value::Boolean(*value),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(items) => Value::List(items.iter().map(|item| self.node(item)).collect()),
            DeValue::Table(table) => Value::Table(self.table(table)),
        }
    }

    fn table(&self, table: &DeTable<'_>) -> Table {
        let mut entries: Vec<Entry> = table
            .iter()
            .map(|(key, value)| Entry {
                key: key.get_ref().to_string(),
                key_span: self.span(key),
                node: self.node(value),
            })
            .collect();
        entries.sort_by_key(|entry| entry.key_span.start);
        Table { entries }
    }
}

/// Refusal of a text that is not TOML; `whole` is the span of the text.
fn syntax(error: &toml::de::Error, whole: Span, text: &str) -> Refusal {
    let within = error.span().unwrap_or(0..text.len());
    let span = Span::new(whole.source, whole.start + within.start..whole.start + within.end);
    let rest = text.get(within.start..).unwrap_or_default();
    let word: String = rest.chars().take_while(|c| !c.is_whitespace() && !",]}#".contains(*c)).collect();
    let message = match error.message() {
        unquoted if unquoted.contains("string values must be quoted") => {
            if word.starts_with(char::is_alphabetic) {
                "text must be in quotes"
            } else {
                "this is not one value"
            }
        }
        message => message.trim_end_matches(", expected nothing"),
    };
    let refusal = Refusal::new(span, format!("not valid TOML: {message}"), message);
    match message {
        "text must be in quotes" => refusal.help(format!("write \"{word}\"")),
        "duplicate key" => refusal.help("each key is allowed once in a table: remove one of them"),
        _ => refusal,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_know_where_they_stand() {
        let text = "[lattice]\nkind = \"square\"\nperiod = 2\n[[levels]]\nradius = 1_0.5\n";
        let root = Table::parse(text).unwrap();
        let shown = |span: Span| &text[span.start..span.end];
        let lattice = root.get("lattice").unwrap();
        assert_eq!(shown(lattice.node.span), "[lattice]");
        let Value::Table(lattice) = &lattice.node.value else { panic!("a table") };
        let keys: Vec<&str> = lattice.entries.iter().map(|entry| entry.key.as_str()).collect();
        assert_eq!(keys, ["kind", "period"]);
        let period = lattice.get("period").unwrap();
        assert_eq!((shown(period.key_span), shown(period.node.span)), ("period", "2"));
        let Value::List(levels) = &root.get("levels").unwrap().node.value else { panic!("a list") };
        assert_eq!(shown(levels[0].span), "[[levels]]");
        let Value::Table(level) = &levels[0].value else { panic!("a table") };
        assert_eq!(level.get("radius").unwrap().node.value, Value::Float(10.5));
    }

    #[test]
    fn numbers_of_any_notation_are_understood() {
        let value = |text: &str| Node::parse(text, 0, 0).unwrap().value;
        assert_eq!(value("0x10"), Value::Integer(16));
        assert_eq!(value("210e9"), Value::Float(210e9));
        assert_eq!(value("100000000000000000000"), Value::Float(1e20));
        assert_eq!(value("0x10000000000000000"), Value::Float(f64::INFINITY));
        assert_eq!(value("-inf"), Value::Float(f64::NEG_INFINITY));
        assert!(matches!(value("+nan"), Value::Float(x) if x.is_nan()));
    }
}

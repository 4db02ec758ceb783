//! A case as a tree of values that know where they were written.
//!
//! The tree is converted once from the TOML parser's, or made of values that stand in no text; afterwards overrides change it and
//! the reader reads it.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::Refusal;
use super::place::Place;
use crate::plain;

/// A value and where it was written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) place: Place,
}

/// A TOML value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    /// An integer that fits; a larger one is kept as the nearest float, in hexadecimal, octal or binary as an infinite one.
    Integer(i64),
    /// Also the not finite ones: refusing them is the reader's task.
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
    pub(super) key_place: Place,
    pub(super) node: Node,
}

impl Table {
    /// The table of a whole document, source number 0.
    pub(super) fn parse(text: &str) -> Result<Self, Refusal> {
        match DeTable::parse(text) {
            Ok(table) => Ok(Origin { source: 0, offset: 0 }.table(table.get_ref())),
            Err(error) => Err(syntax(&error, Place::new(0, 0..0), text)),
        }
    }

    /// The entry of a key.
    pub(super) fn get(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The value of a key.
    pub(super) fn get_mut(&mut self, key: &str) -> Option<&mut Node> {
        self.entries.iter_mut().find(|entry| entry.key == key).map(|entry| &mut entry.node)
    }

    /// Add an entry in place of the one with its key, if any.
    pub(super) fn insert(&mut self, entry: Entry) {
        self.remove(&entry.key);
        self.entries.push(entry);
    }

    /// Remove the entry of a key, if any.
    pub(super) fn remove(&mut self, key: &str) {
        self.entries.retain(|entry| entry.key != key);
    }
}

impl Node {
    /// The single value `text`, which stands at the byte `offset` of source number `source`.
    pub(super) fn parse(text: &str, source: usize, offset: usize) -> Result<Self, Refusal> {
        match DeValue::parse(text) {
            Ok(value) => Ok(Origin { source, offset }.node(&value)),
            Err(error) => Err(syntax(&error, Place::new(source, offset..offset + text.len()), text)),
        }
    }
}

impl Value {
    /// What the value is, for "not …" in an error.
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
    /// The tree of values that stand in no text; each is shown at `place` where it is refused.
    pub(super) fn of(values: &toml::Table, place: Place) -> Self {
        let entry = |(key, value): (&String, &toml::Value)| Entry {
            key: key.clone(),
            key_place: place,
            node: Node::of(value, place),
        };
        Self { entries: values.iter().map(entry).collect() }
    }
}

impl Node {
    /// A value that stands in no text, shown at `place` where it is refused.
    pub(super) fn of(value: &toml::Value, place: Place) -> Self {
        let value = match value {
            toml::Value::String(text) => Value::Text(text.clone()),
            toml::Value::Integer(value) => Value::Integer(*value),
            toml::Value::Float(value) => Value::Float(*value),
            toml::Value::Boolean(value) => Value::Boolean(*value),
            toml::Value::Datetime(date) => Value::Date(date.to_string()),
            toml::Value::Array(items) => Value::List(items.iter().map(|item| Self::of(item, place)).collect()),
            toml::Value::Table(table) => Value::Table(Table::of(table, place)),
        };
        Self { value, place }
    }
}

/// Which source a parsed value comes from, and from which byte on.
struct Origin {
    source: usize,
    offset: usize,
}

impl Origin {
    fn place<T>(&self, spanned: &Spanned<T>) -> Place {
        let span = spanned.span();
        Place::new(self.source, span.start + self.offset..span.end + self.offset)
    }

    fn node(&self, value: &Spanned<DeValue<'_>>) -> Node {
        Node { value: self.value(value.get_ref()), place: self.place(value) }
    }

    fn value(&self, value: &DeValue<'_>) -> Value {
        match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(value) => Value::Integer(value),
                Err(_) if integer.radix() == 10 => Value::Float(integer.as_str().parse().unwrap_or(f64::INFINITY)),
                Err(_) => Value::Float(f64::INFINITY),
            },
            // The parser lets only numbers through.
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
                key_place: self.place(key),
                node: self.node(value),
            })
            .collect();
        entries.sort_by_key(|entry| entry.key_place.start);
        Table { entries }
    }
}

/// Refusal of a text that is not TOML; `whole` is where the text stands.
fn syntax(error: &toml::de::Error, whole: Place, text: &str) -> Refusal {
    let span = error.span().unwrap_or(0..text.len());
    let place = Place::new(whole.source, whole.start + span.start..whole.start + span.end);
    let rest = text.get(span.start..).unwrap_or_default();
    let word: String = rest.chars().take_while(|c| !c.is_whitespace() && !",]}#".contains(*c)).collect();
    let message = match error.message() {
        unquoted if unquoted.contains("string values must be quoted") => {
            if word.starts_with(char::is_alphabetic) {
                "text must stand in quotes"
            } else {
                "this is not one value"
            }
        }
        message => message.trim_end_matches(", expected nothing"),
    };
    let refusal = Refusal::new(place, format!("not valid TOML: {message}"), message);
    match message {
        "text must stand in quotes" => refusal.help(format!("write \"{word}\"")),
        "duplicate key" => refusal.help("each key may stand once in a table: remove one of them"),
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
        let shown = |place: Place| &text[place.start..place.end];
        let lattice = root.get("lattice").unwrap();
        assert_eq!(shown(lattice.node.place), "[lattice]");
        let Value::Table(lattice) = &lattice.node.value else { panic!("a table") };
        let keys: Vec<&str> = lattice.entries.iter().map(|entry| entry.key.as_str()).collect();
        assert_eq!(keys, ["kind", "period"]);
        let period = lattice.get("period").unwrap();
        assert_eq!((shown(period.key_place), shown(period.node.place)), ("period", "2"));
        let Value::List(levels) = &root.get("levels").unwrap().node.value else { panic!("a list") };
        assert_eq!(shown(levels[0].place), "[[levels]]");
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

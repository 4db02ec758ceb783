//! Strict reading of a table by its [`Keys`]: unknown, misspelt and missing keys are refused, defaults are filled in.

use std::borrow::Cow;

use super::error::Refusal;
use super::keys::{Absent, Form, Key, Keys};
use super::node::{Entry, Node, Table, Value};
use super::span::Span;
use super::suggestions::{alternatives, joined, nearest};
use super::value::ValueAt;

/// An empty table for an absent section.
static EMPTY: Table = Table { entries: Vec::new() };

/// A table of the case with its keys and its path (empty for the whole case).
#[derive(Debug, Clone)]
pub(super) struct TableAt<'a> {
    pub(super) table: &'a Table,
    keys: &'static Keys,
    /// The keys of the whole case.
    all: &'static Keys,
    /// Place of the table in the text.
    pub(super) span: Span,
    path: String,
}

impl<'a> TableAt<'a> {
    /// A table that is not inside another, such as the whole case; `end` is the end of its text.
    pub(super) fn root(table: &'a Table, keys: &'static Keys, end: Span) -> Self {
        Self { table, keys, all: keys, span: end, path: String::new() }
    }

    /// Full path of a key of this table.
    pub(super) fn path(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// The value of a key; `None` where it is absent.
    pub(super) fn optional(&self, key: &str) -> Option<ValueAt<'a>> {
        let entry = self.table.get(key)?;
        Some(ValueAt::new(Cow::Borrowed(&entry.node), self.keys.get(key)?, self.all, self.path(key)))
    }

    /// The value of a key or its default; a refusal where it has none.
    pub(super) fn value(&self, key: &str) -> Result<ValueAt<'a>, Refusal> {
        if let Some(value) = self.optional(key) {
            return Ok(value);
        }
        let known = self.keys.get(key);
        if let Some(known) = known
            && let Absent::Value(text) = known.absent
        {
            let node = Node { span: self.span, ..Node::parse(text, 0, 0)? };
            return Ok(ValueAt::new(Cow::Owned(node), known, self.all, self.path(key)));
        }
        Err(self.missing(key))
    }

    /// Refusal of a table in which a key is missing.
    pub(super) fn missing(&self, key: &str) -> Refusal {
        let (path, told) = (self.path(key), self.keys.get(key).map_or(String::new(), Key::description));
        Refusal::new(self.span, format!("`{path}` is missing"), format!("`{key}` is missing here"))
            .help(format!("add `{key}`: {told}"))
    }

    /// A section of the case; `None` where it is absent.
    pub(super) fn section(&self, key: &str) -> Result<Option<TableAt<'a>>, Refusal> {
        self.optional(key).map(|value| value.table_or(&format!("write it as a section, [{key}]"))).transpose()
    }

    /// A section of the case; an empty one where it is absent.
    pub(super) fn section_or_empty(&self, key: &str) -> Result<TableAt<'a>, Refusal> {
        let (all, keys) = (self.all, self.keys.within(key));
        let empty = || TableAt { table: &EMPTY, keys, all, span: self.span, path: self.path(key) };
        Ok(self.section(key)?.unwrap_or_else(empty))
    }

    /// A required section of the case.
    pub(super) fn required_section(&self, key: &str) -> Result<TableAt<'a>, Refusal> {
        self.section(key)?.ok_or_else(|| {
            Refusal::new(self.span, format!("the section [{key}] is missing"), format!("no [{key}] up to here"))
                .help(format!("add it, for example\n{}", self.example(key)))
        })
    }

    /// Example lines of a key.
    pub(super) fn example(&self, key: &str) -> String {
        self.keys.get(key).map_or(String::new(), Key::example_lines)
    }

    /// The tables of a list, [[key]]; none where it is absent; more than the key admits are refused.
    pub(super) fn sections(&self, key: &str) -> Result<Vec<TableAt<'a>>, Refusal> {
        let Some(value) = self.optional(key) else { return Ok(Vec::new()) };
        let help = format!("write each one as a section of its own, [[{key}]] in double brackets");
        let (Some((keys, most)), Value::List(items)) = (value.sections(), &value.node.value) else {
            return Err(value.refuse_form().help(help));
        };
        if let Some(item) = items.get(most) {
            let message = format!("`{key}` must be at most {most} sections, not {}", items.len());
            return Err(Refusal::new(item.span, message, "one too many"));
        }
        value.each(value.forms).map(|item| item.table_of(keys, &help)).collect()
    }

    /// Refuses keys that the table or its kind does not have, and a table without a key that its kind demands.
    pub(super) fn only(&self) -> Result<(), Refusal> {
        let kind = self.kind()?;
        let is_of_kind = |key: &&Key| key.kinds.is_empty() || kind.is_some_and(|kind| key.kinds.contains(&kind));
        let known: Vec<&str> = self.keys.all.iter().filter(is_of_kind).map(|key| key.name).collect();
        if let Some(entry) = self.table.entries.iter().find(|entry| !known.contains(&entry.key.as_str())) {
            return Err(self.unknown(entry, &known));
        }
        let of_kind = self.keys.all.iter().filter(|key| !key.kinds.is_empty()).filter(is_of_kind);
        let mut demanded = of_kind.filter(|key| key.absent == Absent::Refused);
        demanded.find(|key| self.table.get(key.name).is_none()).map_or(Ok(()), |key| Err(self.missing(key.name)))
    }

    /// The kind of the table, the word of its first key; `None` where its keys do not depend on it.
    fn kind(&self) -> Result<Option<&'static str>, Refusal> {
        match self.keys.all.first() {
            Some(first) if self.keys.all.iter().any(|key| !key.kinds.is_empty()) => {
                self.value(first.name)?.word().map(Some)
            }
            _ => Ok(None),
        }
    }

    /// Refusal of an entry that is not among the `known` keys.
    fn unknown(&self, entry: &Entry, known: &[&str]) -> Refusal {
        let (key, path) = (entry.key.as_str(), self.path(&entry.key));
        if let Some((_, why)) = self.keys.misplaced.iter().find(|(misplaced, _)| *misplaced == key) {
            return Refusal::new(entry.key_span, format!("`{path}` has no place here: {why}"), "not used here")
                .help(format!("remove it; allowed here: {}", known.join(", ")));
        }
        let refusal = Refusal::new(entry.key_span, format!("unknown key `{path}`"), "unknown key");
        let homes = self.all.homes(key);
        match nearest(key, known) {
            // `heights` in [[levels]] is a slip, `mean` in [load] a key of another section.
            Some((near, likeness)) if homes.is_empty() || likeness > 0.95 => {
                refusal.help(format!("did you mean `{near}`?"))
            }
            _ if homes.is_empty() => refusal.help(format!("allowed here: {}", known.join(", "))),
            _ => refusal.help(format!("`{key}` belongs to {}", alternatives(&homes, '`'))),
        }
    }

    /// Index and value of the one of two keys that is given; refused where both are, or none.
    pub(super) fn one_of<const N: usize>(&self, keys: [&str; N]) -> Result<(usize, ValueAt<'a>), Refusal> {
        let mut given = keys.iter().enumerate().filter_map(|(index, key)| Some((index, self.optional(key)?)));
        match (given.next(), given.next()) {
            (Some(only), None) => Ok(only),
            (Some((first, _)), Some((second, value))) => Err(self.both([keys[first], keys[second]], value.node.span)),
            (None, _) => {
                let paths: Vec<String> = keys.iter().map(|key| format!("`{}`", self.path(key))).collect();
                let names: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
                let (message, either) = (joined(&paths, "or"), joined(&names, "or"));
                let label = format!("either {either} is missing here");
                let told = keys.map(|key| format!("`{key}` ({})", self.keys.get(key).map_or("", |key| key.what)));
                let refusal = Refusal::new(self.span, format!("{message} is missing"), label);
                Err(refusal.help(format!("add {}", joined(&told, "or"))))
            }
        }
    }

    /// Refusal of two keys that exclude each other.
    pub(super) fn both(&self, [a, b]: [&str; 2], span: Span) -> Refusal {
        let message = format!("`{}` and `{}` exclude each other", self.path(a), self.path(b));
        Refusal::new(span, message, format!("`{a}` is given too")).help("remove one of them")
    }
}

impl<'a> ValueAt<'a> {
    /// The table of the value.
    pub(super) fn table(&self) -> Result<TableAt<'a>, Refusal> {
        self.table_or(&self.example())
    }

    /// The table of the value; `help` says how to write it.
    pub(super) fn table_or(&self, help: &str) -> Result<TableAt<'a>, Refusal> {
        let form = self.forms.iter().find_map(|form| if let Form::Table(keys) = form { Some(*keys) } else { None });
        self.table_of(form.ok_or_else(|| self.refuse_form())?, help)
    }

    fn table_of(&self, keys: &'static Keys, help: &str) -> Result<TableAt<'a>, Refusal> {
        match &self.node {
            Cow::Borrowed(Node { value: Value::Table(table), span }) => {
                Ok(TableAt { table, keys, all: self.all, span: *span, path: self.path.clone() })
            }
            // No default is a table.
            _ => Err(self.refuse("a table").help(help)),
        }
    }

    fn sections(&self) -> Option<(&'static Keys, usize)> {
        self.forms
            .iter()
            .find_map(|form| if let Form::Sections(keys, most) = form { Some((*keys, *most)) } else { None })
    }
}

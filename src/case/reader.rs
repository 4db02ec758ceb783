//! Strict reading of a table: keys that are known, missing or misspelt, and values of the right type and range.
//!
//! Which forms and ranges are right, and what holds where a key is absent, the table of [`keys`] says: a value that it
//! does not know is refused, whatever the section's reader asks for.

use std::borrow::Cow;

use super::error::Refusal;
use super::keys::{self, Absent, Form, Key, Keys};
use super::node::{Node, Table, Value};
use super::place::Place;
use super::words::{alternatives, nearest};

/// A table without entries, for a section that is not there.
static EMPTY: Table = Table { entries: Vec::new() };

/// A table of the case with its keys and its path (empty for the whole case).
#[derive(Debug, Clone)]
pub(super) struct TableAt<'a> {
    table: &'a Table,
    keys: &'static Keys,
    /// Where it begins.
    pub(super) place: Place,
    path: String,
}

/// A value of the case with its path, such as `layers[0].poisson`, its key and the forms it may have.
#[derive(Debug)]
pub(super) struct ValueAt<'a> {
    pub(super) node: Cow<'a, Node>,
    key: &'static Key,
    forms: &'static [Form],
    pub(super) path: String,
}

impl<'a> TableAt<'a> {
    /// A table that stands in no other, such as the whole case; `end` is where its text ends.
    pub(super) fn root(table: &'a Table, keys: &'static Keys, end: Place) -> Self {
        Self { table, keys, place: end, path: String::new() }
    }

    /// Full path of a key of this table.
    pub(super) fn path(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// The value of a key, if it is there.
    pub(super) fn optional(&self, key: &str) -> Option<ValueAt<'a>> {
        let entry = self.table.get(key)?;
        Some(ValueAt::new(Cow::Borrowed(&entry.node), self.keys.get(key)?, self.path(key)))
    }

    /// The value of a key, that which it has when not given, or the refusal that says what it is.
    pub(super) fn value(&self, key: &str) -> Result<ValueAt<'a>, Refusal> {
        if let Some(value) = self.optional(key) {
            return Ok(value);
        }
        let known = self.keys.get(key);
        if let Some(known) = known
            && let Absent::Value(text) = known.absent
        {
            let node = Node { place: self.place, ..Node::parse(text, 0, 0)? };
            return Ok(ValueAt::new(Cow::Owned(node), known, self.path(key)));
        }
        Err(self.missing(key))
    }

    /// Refusal of a table without a key.
    pub(super) fn missing(&self, key: &str) -> Refusal {
        let (path, told) = (self.path(key), self.keys.get(key).map_or(String::new(), Key::told));
        Refusal::new(self.place, format!("`{path}` is missing"), format!("`{key}` is missing here"))
            .help(format!("add `{key}`: {told}"))
    }

    /// A section of the case, if it is there.
    pub(super) fn section(&self, key: &str) -> Result<Option<TableAt<'a>>, Refusal> {
        self.optional(key).map(|value| value.table_or(&format!("write it as a section, [{key}]"))).transpose()
    }

    /// A section of the case, empty where it is not there.
    pub(super) fn section_or_empty(&self, key: &str) -> Result<TableAt<'a>, Refusal> {
        let empty = || TableAt { table: &EMPTY, keys: self.keys.within(key), place: self.place, path: self.path(key) };
        Ok(self.section(key)?.unwrap_or_else(empty))
    }

    /// A section of the case that must be there.
    pub(super) fn required_section(&self, key: &str) -> Result<TableAt<'a>, Refusal> {
        self.section(key)?.ok_or_else(|| {
            Refusal::new(self.place, format!("the section [{key}] is missing"), format!("no [{key}] up to here"))
                .help(format!("add it, for example\n{}", self.example(key)))
        })
    }

    /// A key as it may stand in a case.
    pub(super) fn example(&self, key: &str) -> String {
        self.keys.get(key).map_or(String::new(), Key::written)
    }

    /// The tables of a list, [[key]], none if it is not there; more than the key admits are refused.
    pub(super) fn sections(&self, key: &str) -> Result<Vec<TableAt<'a>>, Refusal> {
        let Some(value) = self.optional(key) else { return Ok(Vec::new()) };
        let help = format!("write each one as a section of its own, [[{key}]] in double brackets");
        let (Some((keys, most)), Value::List(items)) = (value.sections(), &value.node.value) else {
            return Err(value.refuse_form().help(help));
        };
        if let Some(item) = items.get(most) {
            let message = format!("`{key}` must be at most {most} sections, not {}", items.len());
            return Err(Refusal::new(item.place, message, "one too many"));
        }
        value.each(value.forms).map(|item| item.table_of(keys, &help)).collect()
    }

    /// Refuse keys that the table does not have, or not for its kind.
    pub(super) fn only(&self) -> Result<(), Refusal> {
        let kind = self.keys.all.first().and_then(|key| self.table.get(key.name)).map(|entry| &entry.node.value);
        let has = |key: &&Key| {
            key.kinds.is_empty() || matches!(kind, Some(Value::Text(kind)) if key.kinds.contains(&&kind[..]))
        };
        let known: Vec<&str> = self.keys.all.iter().filter(has).map(|key| key.name).collect();
        let Some(entry) = self.table.entries.iter().find(|entry| !known.contains(&entry.key.as_str())) else {
            return Ok(());
        };
        let (key, path) = (entry.key.as_str(), self.path(&entry.key));
        if let Some((_, why)) = self.keys.misplaced.iter().find(|(misplaced, _)| *misplaced == key) {
            return Err(Refusal::new(entry.key_place, format!("`{path}` has no place here: {why}"), "not used here")
                .help(format!("remove it; allowed here: {}", known.join(", "))));
        }
        let refusal = Refusal::new(entry.key_place, format!("unknown key `{path}`"), "unknown key");
        let homes = keys::homes(key);
        Err(match nearest(key, &known) {
            // `heights` in [[levels]] is a slip, `mean` in [load] a key of another section.
            Some((near, likeness)) if homes.is_empty() || likeness > 0.95 => {
                refusal.help(format!("did you mean `{near}`?"))
            }
            _ if homes.is_empty() => refusal.help(format!("allowed here: {}", known.join(", "))),
            _ => refusal.help(format!("`{key}` belongs to {}", alternatives(&homes, '`'))),
        })
    }

    /// The value of the one key of two that is there: refused when both are, or none.
    pub(super) fn one_of(&self, keys: [&str; 2]) -> Result<(usize, ValueAt<'a>), Refusal> {
        let [a, b] = keys;
        match (self.optional(a), self.optional(b)) {
            (Some(value), None) => Ok((0, value)),
            (None, Some(value)) => Ok((1, value)),
            (Some(_), Some(second)) => Err(self.both(keys, second.node.place)),
            (None, None) => {
                let message = format!("`{}` or `{}` is missing", self.path(a), self.path(b));
                let label = format!("either `{a}` or `{b}` is missing here");
                let told = keys.map(|key| format!("`{key}` ({})", self.keys.get(key).map_or("", |key| key.what)));
                Err(Refusal::new(self.place, message, label).help(format!("add {}", told.join(" or "))))
            }
        }
    }

    /// Refusal of two keys that exclude each other.
    pub(super) fn both(&self, [a, b]: [&str; 2], place: Place) -> Refusal {
        let message = format!("`{}` and `{}` exclude each other", self.path(a), self.path(b));
        Refusal::new(place, message, format!("`{a}` is given too")).help("remove one of them")
    }
}

impl<'a> ValueAt<'a> {
    fn new(node: Cow<'a, Node>, key: &'static Key, path: String) -> Self {
        Self { node, key, forms: key.forms, path }
    }

    /// Refusal of the value: "`path` must be `wanted`, not …".
    pub(super) fn refuse(&self, wanted: impl std::fmt::Display) -> Refusal {
        let received = self.node.value.describe();
        let message = format!("`{}` must be {wanted}, not {received}", self.path);
        Refusal::new(self.node.place, message, format!("received {received}"))
    }

    /// Refusal of a value that has none of its forms.
    pub(super) fn refuse_form(&self) -> Refusal {
        self.refuse(keys::told(self.forms))
    }

    /// The same, with an example of what can be written.
    fn refuse_with_example(&self) -> Refusal {
        self.refuse_form().help(self.example())
    }

    /// "for example planes = [0.0, 0.5]".
    pub(super) fn example(&self) -> String {
        format!("for example {} = {}", self.key.name, self.key.example)
    }

    /// A number that the key admits; integers count as numbers.
    pub(super) fn number(&self) -> Result<f64, Refusal> {
        let value = match self.node.value {
            // Up to 2⁵³ exactly; beyond, the nearest float as for any decimal.
            Value::Integer(value) => value as f64,
            Value::Float(value) => value,
            _ => return Err(self.refuse_form()),
        };
        let range = self.forms.iter().find_map(|form| if let Form::Number(range) = form { Some(range) } else { None });
        range.ok_or_else(|| self.refuse_form())?.admit(value).map_err(|beyond| {
            let refusal = self.refuse(beyond.wanted);
            beyond.help.into_iter().fold(refusal, Refusal::help)
        })
    }

    /// An integer that the key admits.
    pub(super) fn integer(&self) -> Result<usize, Refusal> {
        let form = self.forms.iter().find(|form| matches!(form, Form::Integer(..)));
        let Some(Form::Integer(low, high)) = form else { return Err(self.refuse_form()) };
        if let Value::Integer(value) = self.node.value
            && let Ok(value) = usize::try_from(value)
            && (low..=high).contains(&&value)
        {
            return Ok(value);
        }
        Err(self.refuse(keys::told(&[Form::Integer(*low, *high)])))
    }

    /// True or false.
    pub(super) fn boolean(&self) -> Result<bool, Refusal> {
        match self.node.value {
            Value::Boolean(value) if self.forms.iter().any(|form| matches!(form, Form::Boolean)) => Ok(value),
            _ => Err(self.refuse_form()),
        }
    }

    /// A text, where the key has one.
    pub(super) fn text(&self) -> Result<&str, Refusal> {
        let known = self.forms.iter().any(|form| matches!(form, Form::Text(_)));
        match &self.node.value {
            Value::Text(text) if known => Ok(text),
            _ => Err(self.refuse_form()),
        }
    }

    /// A name of no more letters than the key admits.
    pub(super) fn name(&self) -> Result<&str, Refusal> {
        let most = self.forms.iter().find_map(|form| if let Form::Name(_, most) = form { Some(*most) } else { None });
        let fits = |text: &str| {
            most.is_some_and(|most| (1..=most).contains(&text.chars().count()))
                && text.trim() == text
                && !text.contains(char::is_control)
        };
        match &self.node.value {
            Value::Text(text) if fits(text) => Ok(text),
            _ => Err(self.refuse(format!("{}, such as {}", keys::told(self.forms), self.key.example))),
        }
    }

    /// One of the key's words.
    pub(super) fn word(&self) -> Result<&'static str, Refusal> {
        let words = self.forms.iter().find_map(|form| if let Form::Word(words) = form { Some(*words) } else { None });
        let (Value::Text(text), Some(words)) = (&self.node.value, words) else { return Err(self.refuse_form()) };
        words.iter().find(|word| *word == text).copied().ok_or_else(|| {
            let refusal = self.refuse(alternatives(words, '"'));
            match nearest(text, words) {
                Some((near, _)) => refusal.help(format!("did you mean \"{near}\"?")),
                None => refusal,
            }
        })
    }

    /// So many items in brackets.
    pub(super) fn tuple<const N: usize>(&self) -> Result<[ValueAt<'a>; N], Refusal> {
        let known = |form: &&'static Form| matches!(form, Form::Tuple(_, items) if items.len() == N);
        let form = self.forms.iter().find(known);
        let (Value::List(_), Some(Form::Tuple(called, forms))) = (&self.node.value, form) else {
            return Err(self.refuse_with_example());
        };
        let items: Vec<ValueAt<'a>> = self.each(forms).collect();
        items.try_into().map_err(|_| self.refuse(called).help(self.example()))
    }

    /// So many numbers in brackets.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f64; N], Refusal> {
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(self.tuple::<N>()?) {
            *number = item.number()?;
        }
        Ok(numbers)
    }

    /// The items of a list, no fewer and no more than the key admits.
    pub(super) fn list(&self) -> Result<Vec<ValueAt<'a>>, Refusal> {
        let form = self.forms.iter().find(|form| matches!(form, Form::List { .. }));
        let (Value::List(items), Some(form @ Form::List { of, count: [least, most] })) = (&self.node.value, form)
        else {
            return Err(self.refuse_with_example());
        };
        if items.len() < *least {
            return Err(self.refuse(keys::told(std::slice::from_ref(form))).help(self.example()));
        }
        if items.len() > *most {
            return Err(self.refuse(format!("a list of at most {most} items")));
        }
        Ok(self.each(std::slice::from_ref(*of)).collect())
    }

    /// The items of what is a list: of one form, or each of its own.
    fn each(&self, forms: &'static [Form]) -> impl Iterator<Item = ValueAt<'a>> {
        let nodes: Vec<Cow<'a, Node>> = match &self.node {
            Cow::Borrowed(Node { value: Value::List(items), .. }) => items.iter().map(Cow::Borrowed).collect(),
            Cow::Owned(Node { value: Value::List(items), .. }) => items.iter().cloned().map(Cow::Owned).collect(),
            _ => Vec::new(),
        };
        nodes.into_iter().enumerate().map(|(index, node)| {
            let own = if forms.len() > 1 { index.min(forms.len() - 1) } else { 0 };
            ValueAt { node, key: self.key, forms: &forms[own..=own], path: format!("{}[{index}]", self.path) }
        })
    }

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
            Cow::Borrowed(Node { value: Value::Table(table), place }) => {
                Ok(TableAt { table, keys, place: *place, path: self.path.clone() })
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

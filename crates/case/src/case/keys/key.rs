//! A key, the forms of its value, and the keys of a table.

use super::range::Range;
use super::unit::Unit;

/// The keys of a table: of the whole case, of a section, or of a table inside one.
#[derive(Debug)]
pub(in crate::case) struct Keys {
    /// Every key, in the order of the output.
    pub(in crate::case) all: &'static [Key],
    /// Keys of other tables that are often written here by mistake, with the reason.
    pub(in crate::case) misplaced: &'static [(&'static str, &'static str)],
}

/// A key of a table.
#[derive(Debug, Clone, Copy)]
pub(in crate::case) struct Key {
    pub(in crate::case) name: &'static str,
    /// Meaning, a few words.
    pub(in crate::case) what: &'static str,
    /// Allowed forms of its value.
    pub(in crate::case) forms: &'static [Form],
    /// Unit of its numbers.
    pub(in crate::case) unit: Unit,
    /// Meaning of its absence.
    pub(in crate::case) absent: Absent,
    /// An example of its value, in TOML.
    pub(in crate::case) example: &'static str,
    /// Rules beyond its bounds, such as relations to other keys.
    pub(in crate::case) rule: Option<&'static str>,
    /// Kinds of table that have it, by the value of the table's first key; empty: all. Keys of other kinds exclude it.
    pub(in crate::case) kinds: &'static [&'static str],
    /// The key to which it is an alternative.
    pub(in crate::case) instead_of: Option<&'static str>,
    /// Further keys that it excludes.
    pub(in crate::case) and_of: &'static [&'static str],
    /// Keys of its table that it gives where they are absent; an override with it removes those of the case.
    pub(in crate::case) fills: &'static [&'static str],
    pub(in crate::case) written: Written,
}

/// Whether a case that is written with its defaults has a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Written {
    /// Unless it is absent.
    WhereGiven,
    /// Unless it is absent, 0, false or an empty list.
    UnlessNothing,
    /// Never: the case is written with other keys of the same meaning.
    Never,
}

/// Meaning of the absence of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Absent {
    /// The table is refused, unless it has an alternative key or is of a kind without this key.
    Refused,
    /// A default value, in TOML.
    Value(&'static str),
    /// A sentence.
    Means(&'static str),
}

/// A form of a value.
#[derive(Debug, Clone, Copy)]
pub(in crate::case) enum Form {
    /// A number; integers count as numbers.
    Number(Range),
    /// An integer between two bounds, both included.
    Integer(usize, usize),
    /// True or false.
    Boolean,
    /// One of a few words.
    Word(&'static [&'static str]),
    /// Any text, with its description, such as "the path of a file".
    Text(&'static str),
    /// A name, with its description and its largest number of letters.
    Name(&'static str, usize),
    /// A fixed number of items in brackets, with a description such as "a vector [x, y]".
    Tuple(&'static str, &'static [Form]),
    List {
        /// The form of each item.
        of: &'static Form,
        /// Fewest and most items.
        count: [usize; 2],
    },
    /// A table with these keys.
    Table(&'static Keys),
    /// Sections of one name with these keys, and their largest number.
    Sections(&'static Keys, usize),
}

impl Form {
    /// The keys of the tables in it; none where it has no table.
    pub(in crate::case) fn keys(&self) -> Option<&'static Keys> {
        match self {
            Self::Table(keys) | Self::Sections(keys, _) => Some(keys),
            _ => None,
        }
    }

    /// The range of a number in it at a dotted path, items counted from 0; `None` where no number stands.
    fn range(&'static self, path: &str) -> Option<Range> {
        let (item, rest) = path.split_once('.').unwrap_or((path, ""));
        let index = || item.parse::<usize>().ok();
        match self {
            Self::Number(range) => path.is_empty().then_some(*range),
            Self::Table(keys) => keys.range(path),
            Self::Sections(keys, _) => index().and_then(|_| keys.range(rest)),
            Self::List { of, .. } => index().and_then(|_| of.range(rest)),
            Self::Tuple(_, items) => items.get(index()?)?.range(rest),
            _ => None,
        }
    }
}

impl Key {
    /// A key that must be given, by the forms of its value and an example in TOML. Its name and meaning are taken from its field.
    pub(in crate::case) const fn new(forms: &'static [Form], example: &'static str) -> Self {
        Self {
            name: "",
            what: "",
            forms,
            unit: Unit::Pure,
            absent: Absent::Refused,
            example,
            rule: None,
            kinds: &[],
            instead_of: None,
            and_of: &[],
            fills: &[],
            written: Written::WhereGiven,
        }
    }

    /// The key is left out of a written case where its value is 0, false or an empty list.
    pub(in crate::case) const fn omitted_as_nothing(self) -> Self {
        Self { written: Written::UnlessNothing, ..self }
    }

    /// The key is never written: a case is written with other keys that have the same meaning.
    pub(in crate::case) const fn never_written(self) -> Self {
        Self { written: Written::Never, ..self }
    }

    pub(in crate::case) const fn unit(self, unit: Unit) -> Self {
        Self { unit, ..self }
    }

    /// Sets the default value, in TOML.
    pub(in crate::case) const fn default(self, value: &'static str) -> Self {
        Self { absent: Absent::Value(value), ..self }
    }

    /// Sets the meaning of its absence, a sentence.
    pub(in crate::case) const fn otherwise(self, means: &'static str) -> Self {
        Self { absent: Absent::Means(means), ..self }
    }

    pub(in crate::case) const fn rule(self, rule: &'static str) -> Self {
        Self { rule: Some(rule), ..self }
    }

    pub(in crate::case) const fn of(self, kinds: &'static [&'static str]) -> Self {
        Self { kinds, ..self }
    }

    pub(in crate::case) const fn instead_of(self, other: &'static str) -> Self {
        Self { instead_of: Some(other), ..self }
    }

    pub(in crate::case) const fn and_of(self, others: &'static [&'static str]) -> Self {
        Self { and_of: others, ..self }
    }

    pub(in crate::case) const fn fills(self, others: &'static [&'static str]) -> Self {
        Self { fills: others, ..self }
    }

    /// Keys of its table, or of each table of its list; empty for other values.
    pub(in crate::case) fn holds(&self) -> &'static Keys {
        self.forms.iter().find_map(Form::keys).unwrap_or(&Keys::NONE)
    }

    pub(in crate::case) fn excludes(&self, other: &Self) -> bool {
        let kinds = !self.kinds.is_empty()
            && !other.kinds.is_empty()
            && self.kinds.iter().all(|kind| !other.kinds.contains(kind));
        let one = |a: &Self, b: &Self| a.instead_of == Some(b.name) || a.and_of.contains(&b.name);
        kinds || one(self, other) || one(other, self)
    }
}

/// `keys` with their numbers in `unit`.
pub(in crate::case) const fn measured_in<const N: usize>(keys: &[Key], unit: Unit) -> [Key; N] {
    let mut measured = [keys[0]; N];
    let mut index = 0;
    while index < N {
        measured[index] = keys[index].unit(unit);
        index += 1;
    }
    measured
}

impl Keys {
    pub(in crate::case) const NONE: Self = Self::new(&[]);

    pub(in crate::case) const fn new(all: &'static [Key]) -> Self {
        Self { all, misplaced: &[] }
    }

    /// Paths of the tables within this one that have a key.
    pub(in crate::case) fn homes(&'static self, name: &str) -> Vec<String> {
        let tables = self.tables("").into_iter().skip(1);
        tables.filter(|(_, keys)| keys.get(name).is_some()).map(|(path, _)| path).collect()
    }

    pub(in crate::case) fn get(&self, name: &str) -> Option<&'static Key> {
        self.all.iter().find(|key| key.name == name)
    }

    /// The range of the number at a dotted path, items counted from 0, as `layers.0.young`; `None` where no number stands.
    pub(in crate::case) fn range(&'static self, path: &str) -> Option<Range> {
        let (name, rest) = path.split_once('.').unwrap_or((path, ""));
        self.get(name)?.forms.iter().find_map(|form| form.range(rest))
    }

    /// The keys of the tables inside one of its keys; none for an unknown key.
    pub(in crate::case) fn within(&self, name: &str) -> &'static Self {
        self.get(name).map_or(&Self::NONE, Key::holds)
    }

    /// Keys that the key `name` excludes.
    pub(in crate::case) fn excluded(&self, name: &str) -> Vec<&'static str> {
        let Some(key) = self.get(name) else { return Vec::new() };
        self.all.iter().filter(|other| key.excludes(other)).map(|other| other.name).collect()
    }

    /// Keys that an override with the key `name` removes: those that it excludes, those that it fills, and what these exclude.
    pub(in crate::case) fn replaced(&self, name: &str) -> Vec<&'static str> {
        let fills = self.get(name).map_or(&[][..], |key| key.fills);
        let filled = fills.iter().flat_map(|other| std::iter::once(*other).chain(self.excluded(other)));
        self.excluded(name).into_iter().chain(filled).collect()
    }

    /// Alternatives to the key `name`, the one that fills it included; without any of them it is required.
    pub(in crate::case) fn instead(&self, name: &str) -> Vec<&'static str> {
        let root = |mut key: &'static Key| {
            while let Some(other) = key.instead_of.and_then(|other| self.get(other)) {
                key = other;
            }
            key.name
        };
        let Some(key) = self.get(name).filter(|key| key.kinds.is_empty()) else { return Vec::new() };
        let is = |other: &&Key| other.excludes(key);
        let stands = |other: &&'static Key| root(other) == root(key) || other.and_of.contains(&key.name);
        let mut names: Vec<&'static str> = self.all.iter().filter(is).filter(stands).map(|other| other.name).collect();
        let fills = |other: &&Key| other.fills.iter().any(|filled| *filled == name || names.contains(filled));
        names.extend(self.all.iter().filter(fills).map(|other| other.name).collect::<Vec<_>>());
        names
    }

    /// The required keys, of alternatives the first; all keys where none is required.
    pub(in crate::case) fn shown(&self) -> impl Iterator<Item = &'static Key> {
        let needs = self.all.iter().any(|key| key.absent == Absent::Refused);
        let mut shown: Vec<&'static Key> = Vec::new();
        for key in self.all {
            if (!needs || key.absent == Absent::Refused) && !shown.iter().any(|before| before.excludes(key)) {
                shown.push(key);
            }
        }
        shown.into_iter()
    }

    /// The table and all inside it, each with its path.
    pub(in crate::case) fn tables(&'static self, path: &str) -> Vec<(String, &'static Self)> {
        let inside = self.all.iter().flat_map(|key| match path {
            _ if key.holds().all.is_empty() => Vec::new(),
            "" => key.holds().tables(key.name),
            _ => key.holds().tables(&format!("{path}.{}", key.name)),
        });
        std::iter::once((path.to_owned(), self)).chain(inside).collect()
    }
}

//! A key, the forms of its value, and the keys of a table.

use super::range::Range;
use super::unit::Unit;

/// The keys of a table: of the whole case, of a section, or of a table inside one.
#[derive(Debug)]
pub(in crate::case) struct Keys {
    /// Every key, in the order in which they are told.
    pub(in crate::case) all: &'static [Key],
    /// Keys that one may look for here, and why they have no place.
    pub(in crate::case) misplaced: &'static [(&'static str, &'static str)],
}

/// A key of a table.
#[derive(Debug, Clone, Copy)]
pub(in crate::case) struct Key {
    /// Its name.
    pub(in crate::case) name: &'static str,
    /// What it is.
    pub(in crate::case) what: &'static str,
    /// The forms in which its value may be written.
    pub(in crate::case) forms: &'static [Form],
    /// What its numbers are measured in.
    pub(in crate::case) unit: Unit,
    /// What holds where it is not given.
    pub(in crate::case) absent: Absent,
    /// A value that it may have, in TOML.
    pub(in crate::case) example: &'static str,
    /// What bounds alone do not say: relations to other keys, and others.
    pub(in crate::case) rule: Option<&'static str>,
    /// Kinds of table that have it, by the text of the table's first key; empty: all. Keys of other kinds exclude it.
    pub(in crate::case) kinds: &'static [&'static str],
    /// The other key in whose place it stands.
    pub(in crate::case) instead_of: Option<&'static str>,
    /// Further keys that it excludes.
    pub(in crate::case) and_of: &'static [&'static str],
    /// Whether it stands in a case that is written.
    pub(in crate::case) written: Written,
}

/// Whether a key stands in a case that is written with its defaults.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Written {
    /// Unless it is absent.
    WhereGiven,
    /// Unless it is absent, 0 or an empty list.
    UnlessNothing,
    /// Other keys take its place when the case is read.
    Never,
}

/// What holds where a key is not given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::case) enum Absent {
    /// The table is refused, unless another key stands in its place or its kind does without.
    Refused,
    /// This value, in TOML.
    Value(&'static str),
    /// What is said.
    Means(&'static str),
}

/// A form of a value.
#[derive(Debug, Clone, Copy)]
pub(in crate::case) enum Form {
    /// A number; integers count as numbers.
    Number(Range),
    /// An integer between two, both of them included.
    Integer(usize, usize),
    /// True or false.
    Boolean,
    /// One of a few words.
    Word(&'static [&'static str]),
    /// Any text; what it is, such as "the path of a file".
    Text(&'static str),
    /// A name; what it is, and of how many letters at most.
    Name(&'static str, usize),
    /// So many items in brackets, which is called such as "a vector [x, y]".
    Tuple(&'static str, &'static [Form]),
    /// A list.
    List {
        /// The form of each item.
        of: &'static Form,
        /// Fewest and most items.
        count: [usize; 2],
    },
    /// A table with these keys.
    Table(&'static Keys),
    /// Sections of one name, at most so many, each with these keys.
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
}

impl Key {
    /// A key that must be given, by the forms of its value and an example in TOML. Its name and what it is are those of the
    /// field that it is declared for.
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
            written: Written::WhereGiven,
        }
    }

    /// The key is left out of a written case where its value is 0 or an empty list.
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

    /// The value that it has where it is not given.
    pub(in crate::case) const fn default(self, value: &'static str) -> Self {
        Self { absent: Absent::Value(value), ..self }
    }

    /// What holds where it is not given.
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

    /// Keys of the table, or of each table of the list, that it holds or may hold.
    pub(in crate::case) fn holds(&self) -> &'static Keys {
        self.forms.iter().find_map(Form::keys).unwrap_or(&Keys::NONE)
    }

    pub(in crate::case) fn excludes(&self, other: &Self) -> bool {
        let kinds = !self.kinds.is_empty() && !other.kinds.is_empty() && self.kinds != other.kinds;
        let one = |a: &Self, b: &Self| a.instead_of == Some(b.name) || a.and_of.contains(&b.name);
        kinds || one(self, other) || one(other, self)
    }
}

/// Keys with their numbers in a unit.
pub(in crate::case) const fn measured_in<const N: usize>(keys: &[Key], unit: Unit) -> [Key; N] {
    let mut own = [keys[0]; N];
    let mut index = 0;
    while index < N {
        own[index] = keys[index].unit(unit);
        index += 1;
    }
    own
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

    /// A key by its name.
    pub(in crate::case) fn get(&self, name: &str) -> Option<&'static Key> {
        self.all.iter().find(|key| key.name == name)
    }

    /// The keys of the tables inside one of its keys; none for a key it does not know.
    pub(in crate::case) fn within(&self, name: &str) -> &'static Self {
        self.get(name).map_or(&Self::NONE, Key::holds)
    }

    /// Keys that cannot stand beside this one in the table.
    pub(in crate::case) fn excluded(&self, name: &str) -> Vec<&'static str> {
        let Some(key) = self.get(name) else { return Vec::new() };
        self.all.iter().filter(|other| key.excludes(other)).map(|other| other.name).collect()
    }

    /// Keys one of which stands in the place of this one; where none of them does, it is needed.
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
        self.all.iter().filter(is).filter(stands).map(|other| other.name).collect()
    }

    /// The keys that a table needs, where one of several is needed the first; all of a table that needs none.
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

    /// This table and all inside it, each with its path.
    pub(in crate::case) fn tables(&'static self, path: &str) -> Vec<(String, &'static Self)> {
        let inside = self.all.iter().flat_map(|key| match path {
            _ if key.holds().all.is_empty() => Vec::new(),
            "" => key.holds().tables(key.name),
            _ => key.holds().tables(&format!("{path}.{}", key.name)),
        });
        std::iter::once((path.to_owned(), self)).chain(inside).collect()
    }
}

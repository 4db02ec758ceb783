//! Explanations of keys: `percoat explain layers.poisson`.

use serde::Serialize;

use super::super::suggestions::{alternatives, nearest};
use super::key::{Absent, Form, Key, Keys};
use crate::case::model::CASE;

/// The explanation of a key. Displayed in lines of at most 80 letters.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// Path of the key in a case, such as `layers.poisson`.
    pub path: String,
    /// Meaning, a few words.
    pub what: String,
    /// Kind and bounds of its value in a few words: "length > 0".
    pub value: String,
    /// Forms of its value: "integer or [n1, n2]".
    pub forms: String,
    /// Bounds of its numbers and of the length of its lists.
    pub range: Option<String>,
    /// Unit of its numbers; none: it has no numbers.
    pub unit: Option<String>,
    /// Value in TOML, or a sentence, where it is not given; none: it must be given.
    pub default: Option<String>,
    /// Rules beyond its bounds.
    pub rule: Option<String>,
    /// Kinds of table that have it, by the value of the table's first key; empty: all.
    pub kinds: Vec<String>,
    /// Alternative keys.
    pub instead: Vec<String>,
    /// Keys that it excludes.
    pub excludes: Vec<String>,
    /// Example lines of a case.
    pub example: String,
    /// Example as an override `KEY=VALUE`; none for a section.
    pub set: Option<String>,
    /// Keys of its table; empty for other values.
    pub keys: Vec<Explanation>,
}

/// The error for a key that no case has.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no key `{path}`{}", if .near.is_empty() {
    "; `percoat explain` lists the sections".to_owned()
} else {
    format!("; did you mean {}?", alternatives(.near, '`'))
})]
pub struct UnknownKey {
    /// The unknown key.
    pub path: String,
    /// Similar paths.
    pub near: Vec<String>,
}

/// Every key whose path ends with `path`, such as `layers.poisson`, `layers.0.poisson` or `layers[0].poisson`; `points` are
/// several.
///
/// # Errors
/// [`UnknownKey`] with similar paths.
pub fn explain(path: &str) -> Result<Vec<Explanation>, UnknownKey> {
    let parts = parts(path);
    let all = all();
    let ends = |whole: &str| whole.split('.').collect::<Vec<_>>().ends_with(&parts);
    // A whole path names one key, a part of it every key whose path ends so.
    let whole = parts.join(".");
    let is_whole = |at: &&PlacedKey| at.path == whole;
    let is_meant = |at: &&PlacedKey| {
        if all.iter().any(|at| is_whole(&at)) { is_whole(at) } else { !parts.is_empty() && ends(&at.path) }
    };
    let found: Vec<_> = all.iter().filter(is_meant).map(PlacedKey::explanation).collect();
    if found.is_empty() { Err(unknown(path, &parts, &all)) } else { Ok(found) }
}

/// Every key and section of the case itself.
pub(super) fn sections() -> Vec<Explanation> {
    all().iter().filter(|at| !at.path.contains('.')).map(PlacedKey::explanation).collect()
}

/// The names of a path, without the numbers of items.
fn parts(path: &str) -> Vec<&str> {
    let parts = path.split(['.', '[']).map(|part| part.trim_end_matches(']').trim());
    parts.filter(|part| !part.is_empty() && part.parse::<usize>().is_err()).collect()
}

fn unknown(path: &str, parts: &[&str], all: &[PlacedKey]) -> UnknownKey {
    let word = parts.last().copied().unwrap_or_default();
    let within = &parts[..parts.len().saturating_sub(1)];
    let home =
        |at: &&PlacedKey| at.path.split('.').collect::<Vec<_>>().split_last().is_some_and(|(_, of)| of == within);
    let inside: Vec<&str> = all.iter().filter(home).map(|at| at.key.name).collect();
    let names: Vec<&str> = all.iter().map(|at| at.key.name).collect();
    let of = |name: &str| all.iter().filter(|at| at.key.name == name).map(|at| at.path.clone()).collect();
    // In a known section the key is misspelt, else either of both.
    let near = match nearest(word, &inside).filter(|_| !within.is_empty()) {
        Some((name, _)) => vec![format!("{}.{name}", within.join("."))],
        None => nearest(word, &names).map_or(Vec::new(), |(name, _)| of(name)),
    };
    UnknownKey { path: path.to_owned(), near }
}

/// Most letters of a table of a list in one line.
const LONGEST: usize = 68;

/// A key with its path and table.
struct PlacedKey {
    path: String,
    key: &'static Key,
    table: &'static Keys,
}

/// Every key of a case, a table before its keys.
fn all() -> Vec<PlacedKey> {
    fn below(table: &'static Keys, path: &str) -> Vec<PlacedKey> {
        let at = |key: &'static Key| {
            let path = format!("{path}.{}", key.name).trim_start_matches('.').to_owned();
            let inside = below(key.holds(), &path);
            std::iter::once(PlacedKey { path, key, table }).chain(inside)
        };
        table.all.iter().flat_map(at).collect()
    }
    below(&CASE, "")
}

impl PlacedKey {
    fn explanation(&self) -> Explanation {
        let Self { path, key, table } = self;
        let owned = |texts: &[&str]| texts.iter().map(|text| (*text).to_owned()).collect();
        let inside = |key: &'static Key| {
            PlacedKey { path: format!("{path}.{}", key.name), key, table: self.key.holds() }.explanation()
        };
        Explanation {
            path: path.clone(),
            what: key.what.to_owned(),
            value: key.value(),
            forms: key.kind_of_value(),
            range: key.range(),
            unit: key.has_numbers().then(|| key.unit.name().to_owned()),
            default: match key.absent {
                Absent::Refused => None,
                Absent::Value(value) => Some(value.to_owned()),
                Absent::Means(means) => Some(means.to_owned()),
            },
            rule: key.rule.map(str::to_owned),
            kinds: owned(key.kinds),
            instead: owned(&table.instead(key.name)),
            excludes: owned(&table.excluded(key.name)),
            example: self.example(),
            set: self.set(),
            keys: key.holds().all.iter().map(inside).collect(),
        }
    }

    /// Lines of a case with the key.
    fn example(&self) -> String {
        if !self.path.contains('.') {
            return self.key.example_lines();
        }
        let (section, rest) = self.section();
        let brackets = |name: &str| match is_list(section) {
            true => format!("[[{name}]]"),
            false => format!("[{name}]"),
        };
        let line = format!("{rest} = {}", self.key.example);
        if let [Form::Table(_)] = self.key.forms
            && (!is_list(section) || line.chars().count() > LONGEST)
        {
            let lines = self.key.example_lines();
            let table = lines.replacen(&format!("[{}]", self.key.name), &format!("[{}]", self.path), 1);
            return if is_list(section) { format!("{}\n{table}", brackets(section)) } else { table };
        }
        if let [Form::Sections(..)] = self.key.forms {
            return self.key.example_lines().replacen(
                &format!("[[{}]]", self.key.name),
                &format!("[[{}]]", self.path),
                1,
            );
        }
        let kind = self.key.kinds.first().map(|kind| format!("{} = \"{kind}\"\n", self.table.all[0].name));
        format!("{}\n{}{line}", brackets(section), kind.unwrap_or_default())
    }

    /// The path of the innermost section around the key that can stand in brackets, a list if there is one, and the rest.
    fn section(&self) -> (&str, &str) {
        let dots: Vec<usize> = self.path.match_indices('.').map(|(at, _)| at).collect();
        let list = dots.iter().rev().find(|&&at| is_list(&self.path[..at]));
        let at = *list.or(dots.first()).unwrap_or(&self.path.len());
        (&self.path[..at], self.path.get(at + 1..).unwrap_or(""))
    }

    /// `layers.0.poisson=0.25`, as a shell takes it.
    fn set(&self) -> Option<String> {
        if !self.path.contains('.') && !self.key.holds().all.is_empty() {
            return None;
        }
        let mut key = String::new();
        for name in self.path.split('.') {
            let is_item = is_list(key.trim_start_matches('.').replace(".0", "").as_str());
            key += &format!("{}.{name}", if is_item { ".0" } else { "" });
        }
        let key = key.trim_start_matches('.').to_owned();
        let example = self.key.example;
        let bare = example.trim_matches('"');
        let is_plain = |text: &str| text.chars().all(|c| c.is_ascii_alphanumeric() || "._-+".contains(c));
        Some(if is_plain(bare) { format!("{key}={bare}") } else { format!("'{key}={example}'") })
    }
}

/// Whether the section at a path may be repeated.
fn is_list(path: &str) -> bool {
    let (within, name) = path.rsplit_once('.').unwrap_or(("", path));
    let keys = within.split('.').filter(|part| !part.is_empty()).fold(&CASE, |keys, part| keys.within(part));
    keys.get(name).is_some_and(|key| matches!(key.forms, [Form::Sections(..)]))
}

//! Strict reading of a table: keys that are known, missing or misspelt, and values of the right type and range.

use std::fmt::Write as _;
use std::ops::{Bound, RangeBounds, RangeInclusive};

use super::error::Refusal;
use super::keys::{self, Key, Keys};
use super::node::{Node, Table, Value, plain};
use super::place::Place;

/// Numbers greater than zero.
pub(super) const POSITIVE: (Bound<f64>, Bound<f64>) = (Bound::Excluded(0.0), Bound::Unbounded);

/// A table of the case with its keys and its path (empty for the whole case).
#[derive(Debug, Clone)]
pub(super) struct TableAt<'a> {
    table: &'a Table,
    keys: &'static Keys,
    /// Where it begins.
    pub(super) place: Place,
    path: String,
}

/// A value of the case with its path, such as `layers[0].poisson`, and the keys of the tables it may hold.
#[derive(Debug)]
pub(super) struct ValueAt<'a> {
    pub(super) node: &'a Node,
    keys: &'static Keys,
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
        Some(ValueAt { node: &entry.node, keys: self.keys.get(key)?.holds, path: self.path(key) })
    }

    /// The value of a key, or the refusal that says what it is.
    pub(super) fn required(&self, key: &str) -> Result<ValueAt<'a>, Refusal> {
        self.optional(key).ok_or_else(|| {
            let (path, what) = (self.path(key), self.keys.get(key).map_or("", |key| key.what));
            Refusal::new(self.place, format!("`{path}` is missing"), format!("`{key}` is missing here"))
                .help(format!("add `{key}`: {what}"))
        })
    }

    /// A section of the case, if it is there.
    pub(super) fn section(&self, key: &str) -> Result<Option<TableAt<'a>>, Refusal> {
        self.optional(key).map(|value| value.table(&format!("write it as a section, [{key}]"))).transpose()
    }

    /// A section of the case; `example` is written where it is missing.
    pub(super) fn required_section(&self, key: &str, example: &str) -> Result<TableAt<'a>, Refusal> {
        self.section(key)?.ok_or_else(|| {
            Refusal::new(self.place, format!("the section [{key}] is missing"), format!("no [{key}] up to here"))
                .help(format!("add it, for example\n{example}"))
        })
    }

    /// The tables of a list, [[key]], none if it is not there; more than `most` are refused.
    pub(super) fn sections(&self, key: &str, most: usize) -> Result<Vec<TableAt<'a>>, Refusal> {
        let Some(value) = self.optional(key) else { return Ok(Vec::new()) };
        let help = format!("write each one as a section of its own, [[{key}]] in double brackets");
        let sections = value.list("a list of tables", &help)?;
        let sections: Vec<Self> = sections.iter().map(|item| item.table(&help)).collect::<Result<_, _>>()?;
        let Some(section) = sections.get(most) else { return Ok(sections) };
        let message = format!("`{key}` must be at most {most} sections, not {}", sections.len());
        Err(Refusal::new(section.place, message, "one too many"))
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
    pub(super) fn one_of(&self, keys: [&str; 2], what: &str) -> Result<(usize, ValueAt<'a>), Refusal> {
        let [a, b] = keys;
        match (self.optional(a), self.optional(b)) {
            (Some(value), None) => Ok((0, value)),
            (None, Some(value)) => Ok((1, value)),
            (Some(_), Some(second)) => Err(self.both(keys, second.node.place)),
            (None, None) => {
                let message = format!("`{}` or `{}` is missing", self.path(a), self.path(b));
                let label = format!("either `{a}` or `{b}` is missing here");
                Err(Refusal::new(self.place, message, label).help(format!("add {what}")))
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
    /// Refusal of the value: "`path` must be `wanted`, not …".
    pub(super) fn refuse(&self, wanted: impl std::fmt::Display) -> Refusal {
        let received = self.node.value.describe();
        let message = format!("`{}` must be {wanted}, not {received}", self.path);
        Refusal::new(self.node.place, message, format!("received {received}"))
    }

    /// A finite number within `allowed`; integers count as numbers.
    pub(super) fn number(&self, allowed: impl RangeBounds<f64>) -> Result<f64, Refusal> {
        let value = match self.node.value {
            // Up to 2⁵³ exactly; beyond, the nearest float as for any decimal.
            Value::Integer(value) => value as f64,
            Value::Float(value) => value,
            _ => return Err(self.refuse(describe(&allowed))),
        };
        if value.is_finite() && allowed.contains(&value) { Ok(value) } else { Err(self.refuse(describe(&allowed))) }
    }

    /// An integer within `allowed`.
    pub(super) fn integer(&self, allowed: RangeInclusive<usize>) -> Result<usize, Refusal> {
        if let Value::Integer(value) = self.node.value
            && let Ok(value) = usize::try_from(value)
            && allowed.contains(&value)
        {
            return Ok(value);
        }
        Err(self.refuse(match (*allowed.start(), *allowed.end()) {
            (low, usize::MAX) => format!("an integer of at least {low}"),
            (low, high) => format!("an integer between {low} and {high}"),
        }))
    }

    /// True or false.
    pub(super) fn boolean(&self) -> Result<bool, Refusal> {
        match self.node.value {
            Value::Boolean(value) => Ok(value),
            _ => Err(self.refuse("true or false")),
        }
    }

    /// A text; `wanted` says which one.
    pub(super) fn text(&self, wanted: &str) -> Result<&'a str, Refusal> {
        match &self.node.value {
            Value::Text(text) => Ok(text),
            _ => Err(self.refuse(wanted)),
        }
    }

    /// One of a few words and what each stands for.
    pub(super) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, Refusal> {
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        let wanted = alternatives(&names, '"');
        let text = self.text(&wanted)?;
        choices.iter().find(|(name, _)| *name == text).map(|(_, choice)| *choice).ok_or_else(|| {
            let refusal = self.refuse(&wanted);
            match nearest(text, &names) {
                Some((near, _)) => refusal.help(format!("did you mean \"{near}\"?")),
                None => refusal,
            }
        })
    }

    /// The items of a list; `wanted` says of what, `help` how to write it.
    pub(super) fn list(&self, wanted: &str, help: &str) -> Result<Vec<ValueAt<'a>>, Refusal> {
        let Value::List(items) = &self.node.value else { return Err(self.refuse(wanted).help(help)) };
        let item = |(index, node)| ValueAt { node, keys: self.keys, path: format!("{}[{index}]", self.path) };
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// The items of a list of at most `most`, each as `read` has it; `wanted` and `help` as of a [list](Self::list).
    pub(super) fn items<T>(
        &self,
        wanted: &str,
        help: &str,
        most: usize,
        read: impl FnMut(&Self) -> Result<T, Refusal>,
    ) -> Result<Vec<T>, Refusal> {
        let items = self.list(wanted, help)?;
        if items.len() > most {
            return Err(self.refuse(format!("a list of at most {most} items")));
        }
        items.iter().map(read).collect()
    }

    /// The table of the value; `help` says how to write it.
    pub(super) fn table(&self, help: &str) -> Result<TableAt<'a>, Refusal> {
        match &self.node.value {
            Value::Table(table) => {
                Ok(TableAt { table, keys: self.keys, place: self.node.place, path: self.path.clone() })
            }
            _ => Err(self.refuse("a table").help(help)),
        }
    }
}

/// The known word nearest to a misspelt one, and how like they are, at most 1.
fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<(&'a str, f64)> {
    let word = word.to_lowercase().replace('_', "-");
    known
        .iter()
        .map(|known| (*known, strsim::jaro_winkler(&word, &known.replace('_', "-"))))
        .filter(|(_, likeness)| *likeness > 0.8)
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// "a", "a" or "b", "a", "b" or "c", each in this kind of quotes.
fn alternatives(names: &[impl AsRef<str>], quote: char) -> String {
    let mut text = String::new();
    for (index, name) in names.iter().enumerate() {
        let joint = match index {
            0 => "",
            _ if index + 1 == names.len() => " or ",
            _ => ", ",
        };
        // Writing into a String cannot fail.
        let _ = write!(text, "{joint}{quote}{}{quote}", name.as_ref());
    }
    text
}

/// "a number greater than 0 and at most 0.1".
fn describe(range: &impl RangeBounds<f64>) -> String {
    let told = |bound: Bound<&f64>, included, excluded| match bound {
        Bound::Included(x) => Some((included, plain(*x))),
        Bound::Excluded(x) => Some((excluded, plain(*x))),
        Bound::Unbounded => None,
    };
    let low = told(range.start_bound(), "at least", "greater than");
    let high = told(range.end_bound(), "at most", "less than");
    match (low, high) {
        (Some(("at least", low)), Some(("at most", high))) => format!("a number between {low} and {high}"),
        (Some((above, low)), Some((below, high))) => format!("a number {above} {low} and {below} {high}"),
        (Some(("at least", low)), None) => format!("a finite number of at least {low}"),
        (Some((word, bound)), None) | (None, Some((word, bound))) => format!("a finite number {word} {bound}"),
        (None, None) => "a finite number".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_read_like_sentences() {
        assert_eq!(describe(&POSITIVE), "a finite number greater than 0");
        assert_eq!(describe(&(0.0..=0.5)), "a number between 0 and 0.5");
        let accuracy = (Bound::Excluded(0.0), Bound::Included(0.1));
        assert_eq!(describe(&accuracy), "a number greater than 0 and at most 0.1");
        assert_eq!(describe(&..), "a finite number");
        assert_eq!(alternatives(&["a", "b", "c"], '"'), "\"a\", \"b\" or \"c\"");
    }

    #[test]
    fn only_similar_words_are_suggested() {
        let nearest = |word, known| nearest(word, known).map(|(known, _)| known);
        let known = ["thickness", "shear_ratio", "young", "poisson", "interface"];
        assert_eq!(nearest("thicknes", &known), Some("thickness"));
        assert_eq!(nearest("Poison", &known), Some("poisson"));
        assert_eq!(nearest("shear-ratio", &known), Some("shear_ratio"));
        assert_eq!(nearest("colour", &known), None);
    }
}

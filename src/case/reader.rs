//! Strict reading of a table: keys that are known, missing or misspelt, and values of the right type and range.

use std::fmt::Write as _;
use std::ops::{Bound, RangeBounds, RangeInclusive};

use super::error::Refusal;
use super::limits;
use super::node::{Node, Place, Table, Value, plain};

/// Numbers greater than zero.
pub(super) const POSITIVE: (Bound<f64>, Bound<f64>) = (Bound::Excluded(0.0), Bound::Unbounded);

/// Keys that belong to one section only, for those that were put into another.
const HOMES: [(&str, &[&str]); 8] = [
    ("lattice", &["kind", "period", "a1", "a2"]),
    ("levels", &["shape", "height", "sites", "slope", "coefficient", "exponent"]),
    ("layers", &["thickness", "shear_ratio", "interface"]),
    ("load", &["mean_pressure", "penetration"]),
    ("grid", &["points", "accuracy"]),
    ("solver", &["method", "tolerance", "max_iterations"]),
    ("stress", &["planes", "mean", "section"]),
    ("localized", &["indenters", "elements", "mutual_effect"]),
];

/// A table of the case with its path (empty for the whole case).
#[derive(Debug)]
pub(super) struct Section<'a> {
    table: &'a Table,
    place: Place,
    path: String,
}

/// A value of the case with its path, such as `layers[0].poisson`.
#[derive(Debug)]
pub(super) struct Field<'a> {
    node: &'a Node,
    path: String,
}

impl<'a> Section<'a> {
    /// The whole case; `end` is where its text ends.
    pub(super) fn root(table: &'a Table, end: Place) -> Self {
        Self { table, place: end, path: String::new() }
    }

    /// Where the table begins.
    pub(super) fn place(&self) -> Place {
        self.place
    }

    /// Full path of a key of this table.
    pub(super) fn path(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// The value of a key, if it is there.
    pub(super) fn optional(&self, key: &str) -> Option<Field<'a>> {
        self.table.get(key).map(|entry| Field { node: &entry.node, path: self.path(key) })
    }

    /// The value of a key; `what` says what it is where it is missing.
    pub(super) fn required(&self, key: &str, what: &str) -> Result<Field<'a>, Refusal> {
        self.optional(key).ok_or_else(|| {
            let path = self.path(key);
            Refusal::new(self.place, format!("`{path}` is missing"), format!("`{key}` is missing here"))
                .help(format!("add `{key}`: {what}"))
        })
    }

    /// A section of the case, if it is there.
    pub(super) fn section(&self, key: &str) -> Result<Option<Section<'a>>, Refusal> {
        self.optional(key).map(|field| field.table(&format!("write it as a section, [{key}]"))).transpose()
    }

    /// A section of the case; `example` is written where it is missing.
    pub(super) fn required_section(&self, key: &str, example: &str) -> Result<Section<'a>, Refusal> {
        self.section(key)?.ok_or_else(|| {
            Refusal::new(self.place, format!("the section [{key}] is missing"), format!("no [{key}] up to here"))
                .help(format!("add it, for example\n{example}"))
        })
    }

    /// The tables of a list, [[key]], none if it is not there.
    pub(super) fn sections(&self, key: &str) -> Result<Vec<Section<'a>>, Refusal> {
        let Some(field) = self.optional(key) else { return Ok(Vec::new()) };
        let help = format!("write each one as a section of its own, [[{key}]] in double brackets");
        field.list("a list of tables", &help)?.iter().map(|item| item.table(&help)).collect()
    }

    /// Refuse keys that are not among `known`. `foreign` explains those that have their place, but not here.
    pub(super) fn only(&self, known: &[&str], foreign: &[(&str, &str)]) -> Result<(), Refusal> {
        let Some(entry) = self.table.entries.iter().find(|entry| !known.contains(&entry.key.as_str())) else {
            return Ok(());
        };
        let (key, path) = (entry.key.as_str(), self.path(&entry.key));
        if let Some((_, why)) = foreign.iter().find(|(foreign, _)| *foreign == key) {
            return Err(Refusal::new(entry.key_place, format!("`{path}` has no place here: {why}"), "not used here")
                .help(format!("remove it; allowed here: {}", known.join(", "))));
        }
        let refusal = Refusal::new(entry.key_place, format!("unknown key `{path}`"), "unknown key");
        let home = HOMES.iter().find(|(home, keys)| *home != self.path && keys.contains(&key));
        Err(match (nearest(key, known), home) {
            (_, Some((home, _))) => refusal.help(format!("`{key}` belongs to `{home}`")),
            (Some(near), None) => refusal.help(format!("did you mean `{near}`?")),
            (None, None) => refusal.help(format!("allowed here: {}", known.join(", "))),
        })
    }

    /// The value of the one key of two that is there: refused when both are, or none.
    pub(super) fn one_of(&self, keys: [&str; 2], what: &str) -> Result<(usize, Field<'a>), Refusal> {
        let [a, b] = keys;
        match (self.optional(a), self.optional(b)) {
            (Some(field), None) => Ok((0, field)),
            (None, Some(field)) => Ok((1, field)),
            (Some(_), Some(second)) => Err(self.both(keys, second.place())),
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

impl<'a> Field<'a> {
    /// Where the value stands.
    pub(super) fn place(&self) -> Place {
        self.node.place
    }

    /// Full path of the value, such as `layers[0].poisson`.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// The bare value.
    pub(super) fn value(&self) -> &'a Value {
        &self.node.value
    }

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
        let wanted = alternatives(&names);
        let text = self.text(&wanted)?;
        choices.iter().find(|(name, _)| *name == text).map(|(_, choice)| *choice).ok_or_else(|| {
            let refusal = self.refuse(&wanted);
            match nearest(text, &names) {
                Some(near) => refusal.help(format!("did you mean \"{near}\"?")),
                None => refusal,
            }
        })
    }

    /// The items of a list; `wanted` says of what, `help` how to write it.
    pub(super) fn list(&self, wanted: &str, help: &str) -> Result<Vec<Field<'a>>, Refusal> {
        let Value::List(items) = &self.node.value else { return Err(self.refuse(wanted).help(help)) };
        let item = |(index, node)| Field { node, path: format!("{}[{index}]", self.path) };
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// The table of the value; `help` says how to write it.
    pub(super) fn table(&self, help: &str) -> Result<Section<'a>, Refusal> {
        match &self.node.value {
            Value::Table(table) => Ok(Section { table, place: self.node.place, path: self.path.clone() }),
            _ => Err(self.refuse("a table").help(help)),
        }
    }

    /// Two finite numbers, `wanted` such as "a vector [x, y]".
    pub(super) fn pair(&self, wanted: &str) -> Result<[f64; 2], Refusal> {
        match &self.list(wanted, "two numbers in brackets")?[..] {
            [x, y] => Ok([limits::place(x)?, limits::place(y)?]),
            _ => Err(self.refuse(wanted).help("two numbers in brackets")),
        }
    }
}

/// The known word nearest to a misspelt one.
fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let word = word.to_lowercase().replace('_', "-");
    known
        .iter()
        .map(|known| (strsim::jaro_winkler(&word, &known.replace('_', "-")), *known))
        .filter(|(likeness, _)| *likeness > 0.8)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, known)| known)
}

/// "a", "a" or "b", "a", "b" or "c", each in quotes.
fn alternatives(names: &[&str]) -> String {
    let mut text = String::new();
    for (index, name) in names.iter().enumerate() {
        let joint = match index {
            0 => "",
            _ if index + 1 == names.len() => " or ",
            _ => ", ",
        };
        // Writing into a String cannot fail.
        let _ = write!(text, "{joint}\"{name}\"");
    }
    text
}

/// "a number greater than 0 and at most 0.1".
fn describe(range: &impl RangeBounds<f64>) -> String {
    let low = match range.start_bound() {
        Bound::Included(low) => Some(format!("at least {}", plain(*low))),
        Bound::Excluded(low) => Some(format!("greater than {}", plain(*low))),
        Bound::Unbounded => None,
    };
    let high = match range.end_bound() {
        Bound::Included(high) => Some(format!("at most {}", plain(*high))),
        Bound::Excluded(high) => Some(format!("less than {}", plain(*high))),
        Bound::Unbounded => None,
    };
    match (range.start_bound(), range.end_bound(), low, high) {
        (Bound::Included(low), Bound::Included(high), ..) => {
            format!("a number between {} and {}", plain(*low), plain(*high))
        }
        (_, _, Some(low), Some(high)) => format!("a number {low} and {high}"),
        (Bound::Included(low), ..) => format!("a finite number of at least {}", plain(*low)),
        (_, _, Some(bound), None) | (_, _, None, Some(bound)) => format!("a finite number {bound}"),
        (_, _, None, None) => "a finite number".to_owned(),
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
        assert_eq!(alternatives(&["a", "b", "c"]), "\"a\", \"b\" or \"c\"");
    }

    #[test]
    fn only_similar_words_are_suggested() {
        let known = ["thickness", "shear_ratio", "young", "poisson", "interface"];
        assert_eq!(nearest("thicknes", &known), Some("thickness"));
        assert_eq!(nearest("Poison", &known), Some("poisson"));
        assert_eq!(nearest("shear-ratio", &known), Some("shear_ratio"));
        assert_eq!(nearest("colour", &known), None);
    }
}

//! What the keys of a sweep are given, as a reader wants it.

use super::rows::Line;
use crate::output::number;
use crate::sweep::column;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeSet;

/// Numbers of more letters are shortened.
const LONG: usize = 8;

/// A key with its values.
#[derive(Debug, Deserialize)]
pub(super) struct Key {
    pub key: String,
    values: Vec<Value>,
}

impl Key {
    /// How many values it has.
    pub(super) fn count(&self) -> usize {
        self.values.len()
    }

    /// Its values in a line.
    pub(super) fn values(&self) -> String {
        let is_short = self.is_short();
        listed(&self.texts().iter().map(|text| shown(text, is_short)).collect::<Vec<_>>())
    }

    /// Its value in a row.
    pub(super) fn of(&self, line: Line<'_>) -> Option<String> {
        line.text(&column(&self.key)).map(|text| shown(text, self.is_short()))
    }

    fn texts(&self) -> Vec<String> {
        let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        self.values.iter().map(text).collect()
    }

    /// Whether its values stay apart when they are shortened.
    fn is_short(&self) -> bool {
        let texts = self.texts();
        let short: BTreeSet<String> = texts.iter().map(|text| shown(text, true)).collect();
        short.len() == texts.iter().collect::<BTreeSet<_>>().len()
    }
}

/// What a row sets, in words.
pub(super) fn settings(keys: &[Key], line: Line<'_>) -> String {
    let equal = |key: &Key| Some(format!("{} = {}", key.key, key.of(line)?));
    keys.iter().filter_map(equal).collect::<Vec<_>>().join(", ")
}

/// A list; of a long one its ends.
pub(super) fn listed(texts: &[String]) -> String {
    match texts {
        [first, second, .., last] if texts.len() > 12 => format!("{first}, {second}, … {last}"),
        _ => texts.join(", "),
    }
}

/// A value as it was given; of a long number five digits.
fn shown(text: &str, is_short: bool) -> String {
    let long = Some(text).filter(|text| is_short && text.len() > LONG && text.contains(['.', 'e']));
    long.and_then(|text| text.parse().ok()).map_or_else(|| text.to_owned(), number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn long_numbers_are_shortened_unless_two_become_one() {
        let key = |values: Value| Key::deserialize(json!({ "key": "a", "values": values })).unwrap().values();
        assert_eq!(key(json!(["0.5", "0.645774832507442", 5, "bonded"])), "0.5, 0.64577, 5, bonded");
        assert_eq!(key(json!(["1.000000001", "1.000000002"])), "1.000000001, 1.000000002");
    }
}

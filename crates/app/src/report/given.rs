//! Values of the keys of a sweep, shortened for the page.

use crate::output::number;
use crate::sweep::{Row, SweptKey};
use std::collections::BTreeSet;

/// Most letters of a number that is not shortened.
const LONG: usize = 8;

/// The values of a key in a line.
pub(super) fn values(key: &SweptKey) -> String {
    let is_short = is_short(key);
    listed(&key.values.iter().map(|text| shown(text, is_short)).collect::<Vec<_>>())
}

pub(super) fn value(key: &SweptKey, row: &Row) -> Option<String> {
    let (_, text) = row.settings.iter().find(|(name, _)| *name == key.key)?;
    Some(shown(text, is_short(key)))
}

/// Whether the values of a key still differ when they are shortened.
fn is_short(key: &SweptKey) -> bool {
    let short: BTreeSet<String> = key.values.iter().map(|text| shown(text, true)).collect();
    short.len() == key.values.iter().collect::<BTreeSet<_>>().len()
}

/// The settings of a row, `key = value` each.
pub(super) fn settings(keys: &[SweptKey], row: &Row) -> String {
    let equal = |key: &SweptKey| Some(format!("{} = {}", key.key, value(key, row)?));
    keys.iter().filter_map(equal).collect::<Vec<_>>().join(", ")
}

/// A list in one line; of more than twelve items the first two and the last.
pub(super) fn listed(texts: &[String]) -> String {
    match texts {
        [first, second, .., last] if texts.len() > 12 => format!("{first}, {second}, … {last}"),
        _ => texts.join(", "),
    }
}

/// A value as typed; of a long number five digits.
fn shown(text: &str, is_short: bool) -> String {
    let long = Some(text).filter(|text| is_short && text.len() > LONG && text.contains(['.', 'e']));
    long.and_then(|text| text.parse().ok()).map_or_else(|| text.to_owned(), number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_are_shortened_unless_two_become_one() {
        let key = |texts: &[&str]| {
            values(&SweptKey { key: "a".to_owned(), values: texts.iter().map(|text| (*text).to_owned()).collect() })
        };
        assert_eq!(key(&["0.5", "0.645774832507442", "5", "bonded"]), "0.5, 0.64577, 5, bonded");
        assert_eq!(key(&["1.000000001", "1.000000002"]), "1.000000001, 1.000000002");
    }
}

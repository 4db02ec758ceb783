//! The table of all keys, as Markdown.

use super::super::model::CASE;
use super::super::suggestions::joined;
use super::key::{Absent, Key, Keys};

/// Head of every table.
const HEAD: &str = "| key | is | value | when not given |\n|---|---|---|---|\n";

/// A table of the sections and of the keys beside them, then one of each section under its name: what a key is, its values, and
/// what holds without it.
pub fn table() -> String {
    let whole = |key: &Key| row(&CASE, key, key.name);
    let is_section = |key: &&Key| !key.holds().all.is_empty();
    let section = |key: &Key| format!("\n## `{}`\n\n{HEAD}{}", key.name, rows(key.holds(), ""));
    let sections: String = CASE.all.iter().filter(is_section).map(section).collect();
    format!("{HEAD}{}{sections}", CASE.all.iter().map(whole).collect::<String>())
}

/// The row of a key of a table under a name.
fn row(keys: &Keys, key: &Key, name: &str) -> String {
    format!("| `{name}` | {} | {} | {} |\n", is(key), key.value(), default(keys, key))
}

/// "instead of `a`: what it is; a note".
fn is(key: &Key) -> String {
    let rule = key.rule.map_or(String::new(), |rule| format!("; {rule}"));
    match key.instead_of {
        Some(other) => format!("instead of `{other}`: {}{rule}", key.what),
        None if key.kinds.is_empty() => format!("{}{rule}", key.what),
        None => format!("{}: {}{rule}", key.kinds.join(", "), key.what),
    }
}

/// One row a key; those of a range are listed under the first key that admits one, those of a layer under `layers`.
fn rows(keys: &Keys, path: &str) -> String {
    let is_of_case = |key: &Key| CASE.all.iter().any(|section| std::ptr::eq(section.holds(), key.holds()));
    let names = |key: &Key| key.holds().all.iter().map(|key| key.name).collect::<Vec<_>>();
    let with_inside = |(index, key): (usize, &Key)| {
        let name = format!("{path}{}", key.name);
        let told = keys.all[..index].iter().any(|before| !names(key).is_empty() && names(before) == names(key));
        let inside = if told || is_of_case(key) && !key.holds().all.is_empty() {
            String::new()
        } else {
            rows(key.holds(), &format!("{name}."))
        };
        row(keys, key, &name) + &inside
    };
    keys.all.iter().enumerate().map(with_inside).collect()
}

fn default(keys: &Keys, key: &Key) -> String {
    let others: Vec<String> = keys.instead(key.name).iter().map(|name| format!("`{name}`")).collect();
    match key.absent {
        Absent::Value(value) => format!("`{value}`"),
        Absent::Means(means) => means.to_owned(),
        Absent::Refused if others.is_empty() || !key.kinds.is_empty() => "required".to_owned(),
        Absent::Refused => format!("required, or {}", joined(&others, "or")),
    }
}

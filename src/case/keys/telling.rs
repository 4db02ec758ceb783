//! What a key is, in words and as it may stand in a case.

use super::form;
use super::key::{Form, Key};

impl Key {
    /// What it is and what it must be.
    pub(in crate::case) fn told(&self) -> String {
        match self.holds().all {
            [] => format!("{}; {}", self.what, form::told(self.forms)),
            _ => self.what.to_owned(),
        }
    }

    /// As it may stand in a case: a section with its keys, or a line.
    pub(in crate::case) fn example_lines(&self) -> String {
        let line = format!("{} = {}", self.name, self.example);
        let parsed = line.parse::<toml::Table>().ok().and_then(|mut table| table.remove(self.name));
        let keys = |table: &toml::Table| {
            let held = self.holds().all.iter().filter_map(|key| Some((key.name, table.get(key.name)?)));
            held.map(|(name, value)| format!("\n{name} = {value}")).collect::<String>()
        };
        match (self.forms, &parsed) {
            ([Form::Table(_)], Some(toml::Value::Table(table))) => format!("[{}]{}", self.name, keys(table)),
            ([Form::Sections(..)], Some(toml::Value::Array(items))) => {
                let tables = items.iter().filter_map(toml::Value::as_table);
                tables.map(|table| format!("[[{}]]{}", self.name, keys(table))).collect::<Vec<_>>().join("\n")
            }
            _ => line,
        }
    }

    /// Which forms its value may have: "integer or [n1, n2]".
    pub(super) fn kind_of_value(&self) -> String {
        form::forms_as(self.forms, Form::kind)
    }

    /// Bounds of its numbers and lists; none where it has neither.
    pub(super) fn range(&self) -> Option<String> {
        let mut ranges: Vec<String> = Vec::new();
        for range in self.forms.iter().flat_map(Form::ranges) {
            if !ranges.contains(&range) {
                ranges.push(range);
            }
        }
        (!ranges.is_empty()).then(|| ranges.join("; "))
    }

    /// Whether it has numbers, beside those in tables.
    pub(super) fn has_numbers(&self) -> bool {
        self.forms.iter().any(Form::has_numbers)
    }

    /// What kind of value it has, in a few words: "length > 0".
    pub(super) fn value(&self) -> String {
        let quantity = self.unit.quantity();
        if let [form @ Form::Tuple(..)] = self.forms {
            return form.with_items(quantity);
        }
        form::forms_as(self.forms, |form| form.short(quantity))
    }
}

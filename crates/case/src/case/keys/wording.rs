//! Descriptions of keys and of the forms of their values, in errors and by `percoat explain`.

use super::super::suggestions::{alternatives, joined};
use super::key::{Form, Key};

impl Form {
    /// The requirement on a value, as in "must be …".
    pub(in crate::case) fn requirement(&self) -> String {
        match self {
            Self::Number(range) => range.requirement(),
            Self::Integer(low, usize::MAX) => format!("an integer of at least {low}"),
            Self::Integer(low, high) => format!("an integer between {low} and {high}"),
            Self::Boolean => "true or false".to_owned(),
            Self::Word(words) => alternatives(words, '"'),
            Self::Text(what) => (*what).to_owned(),
            Self::Name(what, most) => format!("{what} of 1 to {most} characters without spaces at its ends"),
            Self::Tuple(called, _) => (*called).to_owned(),
            Self::List { of, count: [0, _] } => format!("a list of {}", of.plural()),
            Self::List { of, count: [least, _] } => format!("a list of at least {} {}", counted(*least), of.singular()),
            Self::Table(keys) => {
                let entries: Vec<String> = keys.shown().map(|key| format!("{} = …", key.name)).collect();
                format!("{{ {} }}", entries.join(", "))
            }
            Self::Sections(..) => "a list of tables".to_owned(),
        }
    }

    /// The kind of value in a few words: "list of lengths ≥ 0" for the quantity "length".
    pub(super) fn short(&self, quantity: &str) -> String {
        match self {
            Self::Number(range) => format!("{quantity} {}", range.short()).trim_end().to_owned(),
            Self::Integer(low, most) if *most >= i64::MAX as usize => format!("integer ≥ {low}"),
            Self::Integer(low, high) => format!("integer {low} to {high}"),
            Self::Boolean => "true or false".to_owned(),
            Self::Word(words) => alternatives(words, '"'),
            Self::Text(what) => bare(what).to_owned(),
            Self::Name(what, most) => format!("{}, at most {most} letters", bare(what)),
            Self::Tuple(called, _) => bracket(called).to_owned(),
            Self::List { of, count: [least, most] } => {
                let items = match of {
                    Self::Number(range) => format!("{quantity}s {}", range.short()).trim_end().to_owned(),
                    Self::Integer(low, high) => format!("integers {low} to {high}"),
                    other => other.plural(),
                };
                let count = if *least > 0 { format!("{least} to {most}") } else { format!("at most {most}") };
                format!("list of {count} {items}")
            }
            Self::Table(_) => "table".to_owned(),
            Self::Sections(_, most) => format!("at most {most} sections"),
        }
    }

    /// The kind of value, with the items of brackets: "[upper, lower] of pressures > 0".
    pub(super) fn with_items(&self, quantity: &str) -> String {
        let short = self.short(quantity);
        match self {
            Self::Tuple(_, [Self::Number(range), rest @ ..])
                if rest.iter().all(|form| form.ranges() == [range.full()]) =>
            {
                let items = format!("{quantity}s {}", range.short());
                if items == "numbers " { short } else { format!("{short} of {}", items.trim_end()) }
            }
            _ => short,
        }
    }

    /// Type of the values.
    pub(super) fn kind(&self) -> String {
        match self {
            Self::Number(_) | Self::Integer(..) => self.singular(),
            Self::List { of, .. } => format!("list of {}", of.plural()),
            Self::Name(..) => "text".to_owned(),
            Self::Sections(..) => "sections".to_owned(),
            other => other.short("number"),
        }
    }

    /// Bounds of its numbers and lists.
    pub(super) fn ranges(&self) -> Vec<String> {
        match self {
            Self::Number(range) => vec![range.full()],
            Self::Integer(low, most) if *most >= i64::MAX as usize => vec![format!("at least {low}")],
            Self::Integer(low, high) => vec![format!("{low} to {high}")],
            Self::Name(_, most) => vec![format!("1 to {most} characters without spaces at its ends")],
            Self::Tuple(called, items) => {
                let each: Vec<String> = items.iter().flat_map(Self::ranges).collect();
                if each.iter().all(|range| *range == each[0]) {
                    return each.into_iter().take(1).collect();
                }
                let names = bracket(called).trim_matches(['[', ']']).split(", ");
                names.zip(each).map(|(name, range)| format!("{name}: {range}")).collect()
            }
            Self::List { of, count: [0, most] } => [of.ranges(), vec![format!("at most {most} items")]].concat(),
            Self::List { of, count: [least, most] } => [of.ranges(), vec![format!("{least} to {most} items")]].concat(),
            Self::Sections(_, most) => vec![format!("at most {most}")],
            Self::Boolean | Self::Word(_) | Self::Text(_) | Self::Table(_) => Vec::new(),
        }
    }

    pub(super) fn has_numbers(&self) -> bool {
        match self {
            Self::Number(_) => true,
            Self::Tuple(_, items) => items.iter().any(Self::has_numbers),
            Self::List { of, .. } => of.has_numbers(),
            _ => false,
        }
    }

    fn singular(&self) -> String {
        match self {
            Self::Number(_) => "number".to_owned(),
            Self::Integer(..) => "integer".to_owned(),
            Self::Tuple(called, _) => bare(called).to_owned(),
            other => other.requirement(),
        }
    }

    fn plural(&self) -> String {
        match self {
            Self::Number(_) => "numbers".to_owned(),
            Self::Integer(..) => "integers".to_owned(),
            Self::Tuple(called, _) => bracket(called).to_owned(),
            other => other.requirement(),
        }
    }
}

impl Key {
    /// Meaning of the key and the requirement on its value.
    pub(in crate::case) fn description(&self) -> String {
        match self.holds().all {
            [] => format!("{}; {}", self.what, requirement(self.forms)),
            _ => self.what.to_owned(),
        }
    }

    /// An example: a section with its keys, or a line.
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

    /// Forms of its value: "integer or [n1, n2]".
    pub(super) fn kind_of_value(&self) -> String {
        forms_as(self.forms, Form::kind)
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

    /// Whether its value has numbers, tables not counted.
    pub(super) fn has_numbers(&self) -> bool {
        self.forms.iter().any(Form::has_numbers)
    }

    /// The kind of its value in a few words: "length > 0".
    pub(super) fn value(&self) -> String {
        let quantity = self.unit.quantity();
        if let [form @ Form::Tuple(..)] = self.forms {
            return form.with_items(quantity);
        }
        forms_as(self.forms, |form| form.short(quantity))
    }
}

/// The requirement on a value that may have any of `forms`.
pub(in crate::case) fn requirement(forms: &[Form]) -> String {
    forms_as(forms, Form::requirement)
}

/// `forms` in words, joined by "or", each word of a list by itself.
pub(super) fn forms_as(forms: &[Form], words: impl Fn(&Form) -> String) -> String {
    let forms = forms.iter().flat_map(|form| match form {
        Form::Boolean => vec!["true".to_owned(), "false".to_owned()],
        Form::Word(words) => words.iter().map(|word| format!("\"{word}\"")).collect(),
        form => vec![words(form)],
    });
    joined(&forms.collect::<Vec<_>>(), "or")
}

fn counted(count: usize) -> String {
    if count == 1 { "one".to_owned() } else { count.to_string() }
}

/// The text without its article.
fn bare(what: &str) -> &str {
    ["a ", "an ", "the "].iter().find_map(|article| what.strip_prefix(article)).unwrap_or(what)
}

/// The part of the text in brackets, brackets included.
pub(super) fn bracket(called: &str) -> &str {
    let end = called.find(']').map_or(called.len(), |end| end + 1);
    &called[called.find('[').unwrap_or(0)..end]
}

//! Tables of the page; a table wider than the page scrolls by itself.

use super::markup::{Markup, numbers, tag, with};
use crate::output::is_interval;
use crate::output::table::{INTERVALS, Table};

/// Most columns of a table in letters of ordinary size.
const MANY: usize = 9;

pub(super) fn table(caption: &str, table: &Table) -> Markup {
    let head = |(index, name): (usize, &String)| {
        with("th", &[("scope", "col"), ("class", class(index, table.words))], numbers(name))
    };
    let cell = |(index, text): (usize, &String)| with("td", &[("class", class(index, table.words))], numbers(text));
    let row = |row: &Vec<String>| {
        // An empty leading cell repeats the one above it.
        let name = if row.first().is_some_and(String::is_empty) { "follows" } else { "leads" };
        with("tr", &[("class", name)], row.iter().enumerate().map(cell).collect::<Markup>())
    };
    let head = tag("tr", table.head.iter().enumerate().map(head).collect::<Markup>());
    let body: Markup = table.rows.iter().map(row).collect();
    let name = if table.head.len() > MANY { "many" } else { "few" };
    scrolling(caption, name, vec![captioned(caption, table.has_intervals()), tag("thead", head), tag("tbody", body)])
}

fn class(index: usize, words: usize) -> &'static str {
    if index < words { "word" } else { "number" }
}

/// A table of names and values, a row each.
pub(super) fn pairs(caption: &str, rows: &[(&str, Markup)]) -> Markup {
    let row = |(name, value): &(&str, Markup)| {
        tag("tr", vec![with("th", &[("scope", "row")], *name), with("td", &[("class", "word")], value.clone())])
    };
    let has_intervals = rows.iter().any(|(_, value)| is_interval(value.as_str()));
    let body = tag("tbody", rows.iter().map(row).collect::<Markup>());
    scrolling(caption, "few", vec![captioned(caption, has_intervals), body])
}

/// A caption, with a note where numbers have intervals.
fn captioned(caption: &str, has_intervals: bool) -> Markup {
    let note = if has_intervals { format!("; {INTERVALS}") } else { String::new() };
    tag("caption", format!("{caption}{note}"))
}

/// A table in a region that scrolls, which the keyboard reaches too.
fn scrolling(caption: &str, name: &str, content: Vec<Markup>) -> Markup {
    let region = [("class", "scroll"), ("role", "region"), ("aria-label", caption), ("tabindex", "0")];
    with("div", &region, with("table", &[("class", name)], content))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_explained_in_the_caption_of_its_table() {
        let told = |cell: &str| {
            let rows = Table::new(&["what", "value"], vec![vec!["a".to_owned(), cell.to_owned()]], 1);
            let all = [table("A table", &rows), pairs("A table", &[("a", numbers(cell))])];
            all.map(|markup| markup.as_str().matches(INTERVALS).count())
        };
        assert_eq!([told("0.06 to 0.16 %"), told("0.11 ± 0.02")], [[1; 2], [0; 2]]);
    }
}

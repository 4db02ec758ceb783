//! Tables of scalars as CSV, made so that NumPy's `genfromtxt(…, names=True, delimiter=",")` reads them as they are: names
//! of letters, digits and underscores, no quotes, no commas or `#` within a cell, an empty cell where there is no value.

use serde_json::Value;
use std::collections::{HashMap, HashSet};

/// The cells of a row, each with the name of its column; a cell is a scalar of JSON, null where there is no value.
pub type Cells = Vec<(String, Value)>;

/// The scalars of a value under names joined by underscores (`levels_1_load`), items of lists counted from 1; texts of a list are
/// one cell, with semicolons between them.
pub fn scalars(value: &Value) -> Cells {
    let mut cells = Vec::new();
    flatten("", value, &mut cells);
    cells
}

fn flatten(name: &str, value: &Value, cells: &mut Cells) {
    let join = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}_{key}") };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| flatten(&join(key), value, cells)),
        // A list of texts is one cell.
        Value::Array(items) if !items.is_empty() && items.iter().all(Value::is_string) => {
            let texts: Vec<&str> = items.iter().filter_map(Value::as_str).collect();
            cells.push((name.to_owned(), texts.join("; ").into()));
        }
        Value::Array(items) => {
            (1..).zip(items).for_each(|(number, value): (usize, _)| flatten(&join(&number.to_string()), value, cells));
        }
        scalar => cells.push((name.to_owned(), scalar.clone())),
    }
}

/// A text as a cell: one line, commas as semicolons, nothing that begins a comment or a quotation.
pub fn plain(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").replace(',', ";").replace(['#', '"'], "'")
}

/// The names of the columns of rows in their order of appearance; a name that first appears in a later row is inserted behind
/// its predecessor in that row.
pub fn names(rows: impl Iterator<Item = Cells>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut known: HashSet<String> = HashSet::new();
    for row in rows {
        let mut after = 0;
        for (name, _) in row {
            if names.get(after) == Some(&name) {
                after += 1;
            } else if known.contains(&name) {
                after = 1 + names.iter().position(|listed| *listed == name).unwrap_or(after);
            } else {
                known.insert(name.clone());
                names.insert(after, name);
                after += 1;
            }
        }
    }
    names
}

/// Rows under one head as CSV. `rows` is called twice, so that the cells of all rows are never in memory at once.
pub fn csv<I: Iterator<Item = Cells>>(rows: impl Fn() -> I) -> String {
    let names = names(rows());
    let mut text = names.join(",") + "\n";
    for row in rows() {
        let cells: HashMap<String, Value> = row.into_iter().collect();
        let line: Vec<String> = names.iter().map(|name| cells.get(name).map_or(String::new(), cell)).collect();
        text += &(line.join(",") + "\n");
    }
    text
}

/// A cell of a table.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => plain(text),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn names_and_cells_need_no_quotes() {
        let cells = scalars(&json!({"a": {"b": [1.5, null]}, "why": "x, \"y\" #\n z", "c": true}));
        let text = csv(|| [cells.clone()].into_iter());
        assert_eq!(text, "a_b_1,a_b_2,why,c\n1.5,,x; 'y' ' z,true\n");
        let cells = scalars(&json!({"rivals": ["yield of material 1", "cracking of material 2"], "none": []}));
        assert_eq!(csv(|| [cells.clone()].into_iter()), "rivals\nyield of material 1; cracking of material 2\n");
    }

    #[test]
    fn a_row_may_have_columns_that_others_have_not() {
        let row = |cells: &[(&str, u32)]| cells.iter().map(|(n, c)| ((*n).to_owned(), json!(c))).collect();
        let rows: [Cells; 3] =
            [row(&[("a", 1), ("z", 2)]), row(&[("a", 3), ("b", 4), ("z", 5), ("y", 6)]), row(&[("z", 7)])];
        assert_eq!(csv(|| rows.iter().cloned()), "a,b,z,y\n1,,2,\n3,4,5,6\n,,7,\n");
    }
}

//! A table as a person reads it in a terminal.

use comfy_table::{CellAlignment, ContentArrangement, presets};
use std::fmt;

/// Blanks around a cell.
const BLANKS: usize = 2;

/// Texts in rows under a head. It prints itself without a line break at its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Names of the columns.
    pub head: Vec<String>,
    /// Cells, row by row. Leading cells that are empty say what those above them do.
    pub rows: Vec<Vec<String>>,
    /// Number of first columns that are words, aligned left; the others are aligned right.
    pub words: usize,
    /// Columns that say what a row is about: they stand in every part of a table that is too wide to stand in one.
    pub keys: Vec<usize>,
}

/// A table, and in words what it comes to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Worded {
    /// A line.
    pub words: String,
    /// What it is read off.
    pub table: Table,
}

impl Table {
    /// Texts in rows under a head, of which the first columns are words.
    pub fn new(head: &[impl ToString], rows: Vec<Vec<String>>, words: usize) -> Self {
        Self { head: head.iter().map(ToString::to_string).collect(), rows, words, keys: vec![0] }
    }

    /// With other columns that say what a row is about.
    pub(super) fn keyed(self, keys: &[usize]) -> Self {
        Self { keys: keys.to_vec(), ..self }
    }

    /// With its first column, of sentences, broken into rows, so that all stands in so many columns of letters if it can.
    pub fn wrapped(self, width: usize) -> Self {
        /// Letters that a line has at least.
        const LEAST: usize = 32;
        let others: usize = (1..self.head.len()).map(|index| self.wide(index)).sum();
        let most = (width + 1).saturating_sub(others + BLANKS).max(LEAST);
        let mut rows = Vec::new();
        for row in self.rows {
            let mut lines = vec![String::new()];
            for word in row[0].split(' ') {
                let line = lines.last_mut().expect("there is a line from the beginning");
                if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > most {
                    lines.push(word.to_owned());
                } else {
                    *line += if line.is_empty() { "" } else { " " };
                    *line += word;
                }
            }
            let rest = lines.split_off(1);
            rows.push([&lines[..], &row[1..]].concat());
            rows.extend(rest.into_iter().map(|line| [vec![line], vec![String::new(); row.len() - 1]].concat()));
        }
        Self { rows, ..self }
    }

    /// Letters that a column takes, with the blanks beside it.
    fn wide(&self, index: usize) -> usize {
        let cells = self.rows.iter().map(|row| &row[index]).chain([&self.head[index]]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0) + BLANKS
    }

    /// As it prints itself, in as many parts one below the other as it takes to fit into so many columns of letters. A
    /// part has one column beside the keys at least.
    pub fn fitted(&self, width: usize) -> String {
        // The last blank is not printed.
        let fits = |columns: &[usize]| columns.iter().map(|&index| self.wide(index)).sum::<usize>() <= width + 1;
        let mut parts: Vec<Vec<usize>> = vec![self.keys.clone()];
        for index in (0..self.head.len()).filter(|index| !self.keys.contains(index)) {
            let own = parts.last_mut().expect("there is a part from the beginning");
            own.push(index);
            if !fits(own) && own.len() > self.keys.len() + 1 {
                own.pop();
                parts.push([&self.keys[..], &[index]].concat());
            }
        }
        if parts.len() == 1 {
            return self.to_string();
        }
        parts.iter().map(|columns| self.part(columns).to_string()).collect::<Vec<_>>().join("\n\n")
    }

    /// Some of its columns; words come first.
    fn part(&self, columns: &[usize]) -> Self {
        let pick = |row: &Vec<String>| columns.iter().map(|&index| row[index].clone()).collect();
        let words = columns.iter().take_while(|index| **index < self.words).count();
        Self { head: pick(&self.head), rows: self.rows.iter().map(pick).collect(), words, keys: Vec::new() }
    }
}

impl Worded {
    /// The words, and the table as it [fits](Table::fitted).
    pub fn fitted(&self, width: usize) -> String {
        format!("{}\n\n{}", self.words, self.table.fitted(width))
    }
}

impl fmt::Display for Worded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n\n{}", self.words, self.table)
    }
}

/// Under a rule.
impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = comfy_table::Table::new();
        table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(&self.head);
        table.add_rows(&self.rows);
        for (index, column) in table.column_iter_mut().enumerate() {
            column.set_cell_alignment(if index < self.words { CellAlignment::Left } else { CellAlignment::Right });
        }
        let text = table.trim_fmt();
        let width = text.lines().map(|line| line.chars().count()).max().unwrap_or(0);
        let mut lines: Vec<&str> = text.lines().collect();
        let rule = "─".repeat(width);
        lines.insert(1.min(lines.len()), &rule);
        f.write_str(&lines.join("\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let rows = vec![
            vec!["a".into(), "1".into(), "22222".into(), "3".into()],
            vec!["".into(), "4".into(), "5".into(), "6".into()],
        ];
        Table::new(&["name", "one", "two", "three"], rows, 1)
    }

    #[test]
    fn a_table_that_fits_stands_in_one_part_and_a_wider_one_in_several_with_their_keys() {
        let whole = table().to_string();
        assert_eq!(
            whole,
            " name  one    two  three\n────────────────────────\n a       1  22222      3\n         4      5      6"
        );
        let widest = |text: &str| text.lines().map(|line| line.chars().count()).max().unwrap();
        for width in 0..40 {
            let fitted = table().fitted(width);
            assert_eq!(fitted == whole, width >= widest(&whole), "{width}");
            // Two columns at least, however narrow.
            assert!(widest(&fitted) <= width.max(13), "{width}:\n{fitted}");
            for cell in ["one", "22222", "three", "6"] {
                assert_eq!(fitted.matches(cell).count(), 1, "{width}: {cell}");
            }
        }
        assert_eq!(table().fitted(20).matches("name").count(), 2);
        assert_eq!(table().keyed(&[0, 2]).fitted(20).matches("22222").count(), 2);
    }

    #[test]
    fn a_sentence_is_broken_so_that_its_numbers_stand_beside_it() {
        let sentence = "a very long sentence of many words that says what is counted here and what is not";
        let table = Table::new(&["what", "value"], vec![vec![sentence.into(), "1".into()]], 1);
        assert_eq!(table.clone().wrapped(120), table);
        let narrow = table.wrapped(48);
        assert_eq!(narrow.rows[0], ["a very long sentence of many words that", "1"]);
        let words: Vec<&str> = narrow.rows.iter().map(|row| &row[0][..]).collect();
        assert_eq!(words.join(" "), sentence);
        assert!(narrow.fitted(48).lines().all(|line| line.chars().count() <= 48), "{}", narrow.fitted(48));
    }
}

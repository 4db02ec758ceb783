//! A table as a person reads it in a terminal.

use crate::output::number::is_interval;
use comfy_table::{CellAlignment, ContentArrangement, presets};
use std::fmt;

/// Blanks between two columns.
const BLANKS: usize = 2;

/// A table of texts under a head; displayed without a line break at its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Names of the columns.
    pub head: Vec<String>,
    /// Cells, row by row. An empty leading cell repeats the one above it.
    pub rows: Vec<Vec<String>>,
    /// Number of first columns that are words, aligned left; the others are aligned right.
    pub words: usize,
    /// Columns that name a row: repeated in every part of a table that is split because of its width.
    pub keys: Vec<usize>,
}

/// Note on the numbers of a table that [has intervals](Table::has_intervals).
pub const INTERVALS: &str = "an error beyond 30 % is given as an interval, a to b";

/// A table, and its result in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Worded {
    /// The result, in a line.
    pub words: String,
    /// The table.
    pub table: Table,
}

/// A sentence in lines of at most `width` letters, each with its end: broken at blanks, but not between a number and its error.
pub(in crate::output) fn lines(sentence: &str, width: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in sentence.replace(" ± ", "\u{a0}±\u{a0}").split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => *line += &format!(" {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines.into_iter().map(|line| line.replace("\u{a0}±\u{a0}", " ± ") + "\n").collect()
}

/// A sentence in lines of at most `width` letters, each with its end, indented by two letters and from the second line on by four.
pub(in crate::output) fn indented(sentence: &str, width: usize) -> String {
    let lines = lines(sentence, width - 4);
    lines
        .lines()
        .zip(std::iter::once("  ").chain(std::iter::repeat("    ")))
        .map(|(line, by)| format!("{by}{line}\n"))
        .collect()
}

impl Table {
    /// A table of `rows` under `head`, the first `words` columns aligned left.
    pub fn new(head: &[impl ToString], rows: Vec<Vec<String>>, words: usize) -> Self {
        Self { head: head.iter().map(ToString::to_string).collect(), rows, words, keys: vec![0] }
    }

    /// Whether the error of any number is shown by an interval.
    pub fn has_intervals(&self) -> bool {
        self.rows.iter().flat_map(|row| row.iter().skip(self.words)).any(|cell| is_interval(cell))
    }

    /// The table with other columns that name a row.
    pub(super) fn keyed(self, keys: &[usize]) -> Self {
        Self { keys: keys.to_vec(), ..self }
    }

    /// The table with the sentences of the first column broken into rows: at most `width` letters wide if possible.
    pub fn wrapped(self, width: usize) -> Self {
        /// Fewest letters of a broken line.
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

    /// Width of a column with its blanks, letters.
    fn wide(&self, index: usize) -> usize {
        let cells = self.rows.iter().map(|row| &row[index]).chain([&self.head[index]]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0) + BLANKS
    }

    /// The table as text, split into parts one below the other of at most `width` letters. A part has at least one column beside
    /// the keys.
    pub fn fitted(&self, width: usize) -> String {
        // Blanks at the end of a line are not printed.
        let fits = |columns: &[usize]| columns.iter().map(|&index| self.wide(index)).sum::<usize>() <= width + 1;
        let mut parts: Vec<Vec<usize>> = vec![self.keys.clone()];
        for index in (0..self.head.len()).filter(|index| !self.keys.contains(index)) {
            let part = parts.last_mut().expect("there is a part from the beginning");
            part.push(index);
            if !fits(part) && part.len() > self.keys.len() + 1 {
                part.pop();
                parts.push([&self.keys[..], &[index]].concat());
            }
        }
        if parts.len() == 1 {
            return self.to_string();
        }
        parts.iter().map(|columns| self.part(columns).to_string()).collect::<Vec<_>>().join("\n\n")
    }

    /// A table of some of the columns, those of words first.
    fn part(&self, columns: &[usize]) -> Self {
        let pick = |row: &Vec<String>| columns.iter().map(|&index| row[index].clone()).collect();
        let words = columns.iter().take_while(|index| **index < self.words).count();
        Self { head: pick(&self.head), rows: self.rows.iter().map(pick).collect(), words, keys: Vec::new() }
    }
}

impl Worded {
    /// The words in lines of at most `width` letters, and the [fitted](Table::fitted) table.
    pub fn fitted(&self, width: usize) -> String {
        format!("{}\n{}", lines(&self.words, width), self.table.fitted(width))
    }
}

impl fmt::Display for Worded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n\n{}", self.words, self.table)
    }
}

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
    fn a_table_with_a_wide_error_has_an_interval() {
        let with = |cell: &str| Table::new(&["1 to 2", "value"], vec![vec!["3 to 4".into(), cell.into()]], 1);
        assert!(with("0.06 to 0.16 %").has_intervals());
        assert!(!with("0.06 ± 0.01").has_intervals());
    }

    #[test]
    fn a_sentence_is_broken_at_blanks_and_a_number_stays_beside_its_error() {
        let sentence = "yield has the utilisation 0.32 ± 0.01 here";
        assert_eq!(lines(sentence, 80), format!("{sentence}\n"));
        assert_eq!(lines(sentence, 32), "yield has the utilisation\n0.32 ± 0.01 here\n");
        assert_eq!(lines(sentence, 37), "yield has the utilisation 0.32 ± 0.01\nhere\n");
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

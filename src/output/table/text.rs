//! A table as a person reads it in a terminal.

use comfy_table::{CellAlignment, ContentArrangement, presets};
use std::fmt;

/// Texts in rows under a head. It prints itself without a line break at its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    /// Names of the columns.
    pub head: Vec<String>,
    /// Cells, row by row. Leading cells that are empty say what those above them do.
    pub rows: Vec<Vec<String>>,
    /// Number of first columns that are words, aligned left; the others are aligned right.
    pub words: usize,
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
    pub(super) fn new(head: &[impl ToString], rows: Vec<Vec<String>>, words: usize) -> Self {
        Self { head: head.iter().map(ToString::to_string).collect(), rows, words }
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

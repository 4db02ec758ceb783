//! Answers: the content that the page shows.

use percoat_app::output::table::{Table, Worded};
use serde::Serialize;

/// A solved case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    /// The case as TOML, complete with its defaults.
    pub case: String,
    /// Whether the step has converged.
    pub converged: bool,
    /// The numbers that are shown first, in an order that is the same for all bodies.
    pub numbers: Vec<CaseNumber>,
    /// The criterion that fails first, or is nearest to failing, in words; `None` without strengths.
    pub verdict: Option<String>,
    /// The tables of `percoat solve`, or of `percoat limit`.
    pub tables: Vec<TableText>,
    /// The materials without a strength, in a sentence.
    pub without_strength: Option<String>,
    /// Assumptions behind stresses and strengths, a sentence each.
    pub assumptions: Vec<String>,
    /// Warnings, a sentence each.
    pub warnings: Vec<String>,
    /// Pictures by their names, SVG; empty where none are drawn.
    pub pictures: Vec<(String, String)>,
    /// Scalars of the step, as in `summary.json`; `None` of limits.
    pub step: Option<serde_json::Value>,
}

/// A number with its error.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CaseNumber {
    /// Name of the number, the same for all bodies.
    pub name: String,
    /// The number with its error and unit, as it is printed.
    pub text: String,
    /// The number, in the unit of the case.
    pub value: Option<f64>,
    /// Error of the number, in the unit of the case; `None` where it is not known.
    pub error: Option<f64>,
}

/// A table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TableText {
    /// Name of the table.
    pub name: String,
    /// Names of the columns.
    pub head: Vec<String>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
    /// Number of first columns that are words.
    pub words: usize,
}

impl TableText {
    /// A table under a name.
    pub fn new(name: &str, Table { head, rows, words, .. }: Table) -> Self {
        Self { name: name.to_owned(), head, rows, words }
    }

    /// A table under a name, and its result in words.
    pub fn worded(name: &str, Worded { words, table }: Worded) -> (String, Self) {
        (words, Self::new(name, table))
    }
}

//! Why a table is no measured curve, or no area function.

use percoat_core::counterbody::TipError;
use percoat_core::identification::{MeasurementError, RetractionError, UnloadingError};

/// Why a table is no measured curve, or no area function.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// No line names columns.
    #[error("no line names the columns: one must, as {0}")]
    Empty(&'static str),
    /// A column that is needed is missing.
    #[error(
        "{}no column `{name}` among {found}; name it, with a unit if it is another than the case's: `{name}_{unit}`",
        at(*.line)
    )]
    Missing {
        /// Line of the names, from 1; `None` where columns stand in no table.
        line: Option<usize>,
        /// The column.
        name: &'static str,
        /// The columns that are there.
        found: String,
        /// A unit as an example.
        unit: &'static str,
    },
    /// A column that is there twice.
    #[error("{}`{}` is there twice, in different units or not: keep one", at(*.0), .1)]
    Twice(Option<usize>, String),
    /// A unit that is not known.
    #[error("{}`{unit}` is no unit of {quantity}: use SI units with a prefix, as {example}", at(*.line))]
    Unit {
        /// Line of the names.
        line: Option<usize>,
        /// The unit.
        unit: String,
        /// The quantity.
        quantity: &'static str,
        /// An example.
        example: &'static str,
    },
    /// A unit of one of two columns that belong together.
    #[error("{}a column has a unit and the other one none: name the units of both, or of none", at(*.0))]
    OneUnit(Option<usize>),
    /// The case does not name its units.
    #[error(
        "{}the case does not name SI units, so that `{}` cannot be converted: add [units], or give the column in the case's unit as `{}`",
        at(*.0),
        .1,
        .2
    )]
    Unnamed(Option<usize>, String, &'static str),
    /// A line with another number of cells.
    #[error("line {line}: {found} cells, but {expected} columns are named")]
    Cells {
        /// The line, from 1.
        line: usize,
        /// Number of cells of the line.
        found: usize,
        /// Number of columns.
        expected: usize,
    },
    /// A cell that is no number.
    #[error("line {line}, column {column}: {text} is no number")]
    Number {
        /// The line, from 1.
        line: usize,
        /// The column.
        column: String,
        /// The cell.
        text: String,
    },
    /// Values that are no curve.
    #[error("{}{}{}", .1.map_or(String::new(), |line| format!("line {line}, ")), .0, .2)]
    Values(MeasurementError, Option<usize>, &'static str),
    /// A test that has no stiffness of unloading.
    #[error("{}{}", .1.map_or(String::new(), |line| format!("line {line}, ")), .0)]
    Unloading(UnloadingError, Option<usize>),
    /// Points that are no curve of drawing off.
    #[error("{}{}", .1.map_or(String::new(), |line| format!("line {line}, ")), .0)]
    Retraction(RetractionError, Option<usize>),
    /// Several curves of drawing off.
    #[error("one curve of drawing off is fitted at a time, and here are {0}")]
    SeveralRetractions(usize),
    /// Depths and areas that are none of a tip.
    #[error("{}{}", at(*.1), .0)]
    Tip(TipError, Option<usize>),
}

/// Why a table is no measured curve, with the name of the curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}{fault}", if .name.is_empty() { String::new() } else { format!("{name}: ") })]
pub struct CurveFault {
    /// Name of its file, or its number; empty of columns in memory that stand alone.
    pub name: String,
    /// The fault.
    pub fault: Fault,
}

fn at(line: Option<usize>) -> String {
    line.map_or(String::new(), |line| format!("line {line}: "))
}

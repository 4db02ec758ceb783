//! The tables of the command line as lists, for pages of HTML.

use crate::case::Case;
use crate::record::from_python;
use percoat::output::table::{self, Table, Worded};
use percoat::output::{ComparisonFile, LifeFile, LimitFile, Summary};
use percoat::run::StepRecord;
use percoat::units::Units;
use pyo3::prelude::*;

/// A caption, the names of the columns, the rows, and the number of first columns that are words.
pub type Shown = (String, Vec<String>, Vec<Vec<String>>, usize);

fn shown(caption: &str, Table { head, rows, words, .. }: Table) -> Shown {
    (caption.to_owned(), head, rows, words)
}

fn worded(Worded { words, table }: Worded) -> Shown {
    shown(&words, table)
}

/// The tables of a run with this summary.
#[pyfunction]
pub fn outcome_tables(case: &Bound<'_, Case>, summary: &Bound<'_, PyAny>) -> PyResult<Vec<Shown>> {
    let (summary, case): (Summary, _) = (from_python(summary)?, &case.get().case);
    let (steps, units) = (&summary.steps, case.units());
    let mut tables = vec![solved(steps, &units)];
    tables.extend(
        table::largest_stresses(steps, &units).map(|stresses| shown("Largest stresses and their places", stresses)),
    );
    tables.extend(
        table::largest_strains(steps, &units).map(|strains| shown("Largest strains and their places", strains)),
    );
    tables.extend(table::utilisations(steps, Some(case.problem().bodies()), &units).map(worded));
    tables.extend(table::lives(steps, &units).map(worded));
    Ok(tables)
}

fn solved(steps: &[StepRecord], units: &Units) -> Shown {
    shown(&table::solved(steps), table::steps(steps, units))
}

/// The table of these limit loads.
#[pyfunction]
pub fn limit_tables(case: &Bound<'_, Case>, limits: &Bound<'_, PyAny>) -> PyResult<Vec<Shown>> {
    let file: LimitFile = from_python(limits)?;
    Ok(vec![worded(table::limits(&file.limits(), &case.get().case.units()))])
}

/// The tables of this life: what tires, and what happens.
#[pyfunction]
pub fn life_tables(case: &Bound<'_, Case>, life: &Bound<'_, PyAny>) -> PyResult<Vec<Shown>> {
    let (file, units): (LifeFile, _) = (from_python(life)?, case.get().case.units());
    let mut tables: Vec<Shown> = table::lives(&file.steps, &units).map(worded).into_iter().collect();
    let events = table::events(&file.events, &units).filter(|_| file.end.is_some());
    tables.extend(events.map(|events| shown("What fails and comes off, pass after pass", events)));
    Ok(tables)
}

/// The tables of a comparison of both methods.
pub fn compared(comparison: &ComparisonFile, units: &Units) -> Vec<Shown> {
    vec![
        shown("Both methods", table::readings(comparison, units)),
        shown("Largest relative differences", table::differences(comparison)),
    ]
}

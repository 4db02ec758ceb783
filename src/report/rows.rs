//! The table of a sweep read back: its numbers with their errors, and limits of which a bound alone is known.

use crate::output::{number, with_error};
use crate::reading::within_the_errors;
use std::collections::HashMap;

/// The table of a sweep.
#[derive(Debug)]
pub(super) struct Rows<'a> {
    /// Columns by their names.
    columns: HashMap<String, usize>,
    names: Vec<String>,
    rows: Vec<Vec<&'a str>>,
}

/// A row: a combination and load step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    columns: &'a HashMap<String, usize>,
    cells: &'a [&'a str],
}

/// What is known of a limit, a pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Limit {
    /// It with its error.
    At(f64, Option<f64>),
    /// It is less.
    Below(f64),
    /// It is not reached up to here.
    Above(f64),
    /// By its error it may be reached or not.
    Undecided,
}

impl<'a> Rows<'a> {
    pub(super) fn read(text: &'a str) -> Result<Self, String> {
        let mut lines = text.lines();
        let names: Vec<String> =
            lines.next().unwrap_or_default().split(',').map(|name| name.trim().replace('.', "_")).collect();
        for wanted in ["combination", "status", "step"] {
            if !names.iter().any(|name| name == wanted) {
                return Err(format!("it has no column {wanted}"));
            }
        }
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').map(str::trim).collect()).collect();
        if let Some((line, row)) = (2..).zip(&rows).find(|(_, row)| row.len() != names.len()) {
            return Err(format!("line {line} has {} cells, the head {}", row.len(), names.len()));
        }
        let rows = Self { columns: names.iter().cloned().zip(0..).collect(), names, rows };
        (2..).zip(rows.lines()).try_for_each(|(number, line)| rows.checked(number, line))?;
        Ok(rows)
    }

    /// Refuses a row in which something else than a number stands where one is due, or nothing: which.
    fn checked(&self, number: usize, line: Line<'_>) -> Result<(), String> {
        let refused = |name: &str, text: &str, due: &str| Err(format!("line {number}: {name} is {text:?}, {due}"));
        for (name, text) in self.names.iter().zip(line.cells) {
            let is_number = text.parse().is_ok_and(f64::is_finite);
            if is_numeric(name) && !text.is_empty() && !is_number {
                return refused(name, text, "not a number");
            }
        }
        let combination = line.text("combination").unwrap_or_default();
        if !combination.parse::<usize>().is_ok_and(|combination| combination > 0) {
            return refused("combination", combination, "not a number from 1");
        }
        let status = line.text("status").unwrap_or_default();
        if !["done", "not_converged", "failed"].contains(&status) {
            return refused("status", status, "not one of done, not_converged and failed");
        }
        for name in ["mean_pressure", "penetration", "contact_fraction"] {
            let stops = line.text("stop_reason") == Some("not a number");
            if status == "done" && !stops && self.has(name) && line.text(name).is_none() {
                return refused(name, "", "not a number");
            }
        }
        for name in ["mean_pressure", "contact_fraction", "max_pressure"] {
            if line.float(name).is_some_and(|value| value < 0.0) {
                return refused(name, line.text(name).unwrap_or_default(), "below zero");
            }
        }
        Ok(())
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.columns.contains_key(name)
    }

    pub(super) fn lines(&self) -> impl ExactSizeIterator<Item = Line<'_>> {
        self.rows.iter().map(|cells| Line { columns: &self.columns, cells })
    }

    /// The last load step of each combination, or its limits.
    pub(super) fn last(&self) -> impl Iterator<Item = Line<'_>> {
        let lines: Vec<Line<'_>> = self.lines().collect();
        let next = |at: usize| lines.get(at + 1).map(|next| next.text("combination"));
        let ends = |at: &usize| next(*at) != Some(lines[*at].text("combination"));
        (0..lines.len()).filter(ends).map(|at| lines[at]).collect::<Vec<_>>().into_iter()
    }

    /// Names of the limits but the first, as columns begin with them; none where loads were solved.
    pub(super) fn limits(&self) -> Vec<&str> {
        let limits = self.names.iter().filter_map(|name| name.strip_suffix("_reached"));
        limits.filter(|name| *name != "first" && !name.starts_with("set_")).collect()
    }
}

/// Whether the cells of a column are numbers, or empty: those that a page shows as such.
fn is_numeric(name: &str) -> bool {
    let is_set = name.starts_with("set_");
    let named = ["step", "mean_pressure", "penetration", "contact_fraction", "max_pressure"].contains(&name);
    let ends = ["_value", "_error", "_mean_pressure", "_below", "_up_to", "_load_share"];
    !is_set
        && (named
            || name.starts_with("errors_")
            || name.contains("_errors_")
            || ends.iter().any(|end| name.ends_with(end)))
}

impl<'a> Line<'a> {
    /// A cell; `None` where it or its column is empty.
    pub(super) fn text(self, name: &str) -> Option<&'a str> {
        self.cells.get(*self.columns.get(name)?).copied().filter(|text| !text.is_empty())
    }

    fn float(self, name: &str) -> Option<f64> {
        self.text(name)?.parse().ok()
    }

    /// A number with its error, where one is known.
    pub(super) fn measured(self, name: &str) -> Option<(f64, Option<f64>)> {
        let level = name.strip_prefix("levels_").and_then(|rest| rest.split_once('_'));
        let error = match (name.strip_suffix("_value"), level) {
            (Some(stress), _) => format!("{stress}_error"),
            (None, Some((level, rest))) => format!("levels_{level}_errors_{rest}"),
            (None, None) => format!("errors_{name}"),
        };
        Some((self.float(name)?, self.float(&error)))
    }

    /// What is known of a limit.
    pub(super) fn limit(self, name: &str) -> Option<Limit> {
        let part = |part: &str| self.float(&format!("{name}_{part}"));
        let number = part("mean_pressure").map(|load| Limit::At(load, part("error")));
        let is_undecided = self.text(&format!("{name}_reached")) == Some("undecided");
        let undecided = || is_undecided.then_some(Limit::Undecided);
        number
            .or_else(|| part("below").map(Limit::Below))
            .or_else(undecided)
            .or_else(|| part("up_to").map(Limit::Above))
    }

    /// Which criterion comes first.
    pub(super) fn first(self) -> Option<String> {
        self.criterion("first")
    }

    /// What else may come first within the errors.
    pub(super) fn rivals(self, head: &str) -> Vec<String> {
        let texts = self.text(&format!("{head}_rivals"));
        texts.into_iter().flat_map(|texts| texts.split(';')).map(|text| text.trim().to_owned()).collect()
    }

    /// The criterion that comes first (`first`) or governs (`governing`), with its rivals.
    pub(super) fn with_rivals(self, head: &str) -> Option<String> {
        Some(self.criterion(head)? + &within_the_errors(&self.rivals(head)))
    }

    fn criterion(self, head: &str) -> Option<String> {
        let of = |of: &str| Some(format!(" of {of} {}", self.text(&format!("{head}_{of}"))?));
        let criterion = self.text(&format!("{head}_criterion"))?;
        Some(format!("{criterion}{}", of("material").or_else(|| of("interface")).unwrap_or_default()))
    }
}

impl Limit {
    /// As a table has it: 0.007 ± 0.003, < 0.01 or > 2.
    pub(super) fn told(self) -> String {
        match self {
            Self::At(0.0, _) => "0".to_owned(),
            Self::At(load, error) => with_error(load, error),
            Self::Below(load) => format!("< {}", number(load)),
            Self::Above(load) => format!("> {}", number(load)),
            Self::Undecided => "undecided".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_have_their_errors_or_a_bound() {
        let text = "combination,status,step,first_criterion,first_interface,first_mean_pressure,first_error,first_reached,\
                    first_below,a_mean_pressure,a_error,a_reached,a_up_to\n\
                    1,done,1,delamination,2,0.0066461,0.0025,under load,,,,not up to complete contact,3.5\n\
                    2,done,1,delamination,2,0.047299,0.116,under load,,0.0,0.0,by residual stress alone,\n\
                    3,done,1,delamination,2,,,by a contact of a few samples,0.0012,,,,\n";
        let rows = Rows::read(text).unwrap();
        let told = |name: &str| -> Vec<String> {
            rows.lines().map(|line| line.limit(name).map_or("–".to_owned(), Limit::told)).collect()
        };
        assert_eq!(told("first"), ["0.007 ± 0.003", "0.05 ± 0.20", "< 0.0012000"]);
        assert_eq!(told("a"), ["> 3.5000", "0", "–"]);
        assert_eq!(rows.limits(), ["a"]);
        let text = "combination,status,step,governing_criterion,governing_material,governing_rivals\n\
                    1,done,1,yield,2,cracking of material 1; yield of material 3\n2,done,1,yield,2,\n";
        let governs: Vec<Option<String>> =
            Rows::read(text).unwrap().lines().map(|line| line.with_rivals("governing")).collect();
        let words = "yield of material 2, or cracking of material 1 or yield of material 3 within the errors";
        assert_eq!(governs, [Some(words.to_owned()), Some("yield of material 2".to_owned())]);
        assert!(rows.lines().all(|line| line.first().as_deref() == Some("delamination of interface 2")));
    }

    #[test]
    fn numbers_find_their_errors_and_combinations_their_last_step() {
        let text = "combination,status,step,max_pressure,errors_max_pressure,levels_1_load_share,\
                    levels_1_errors_load_share,stress_max_tau1_value,stress_max_tau1_error\n\
                    1,done,1,1.0,0.1,0.5,0.01,0.3,0.03\n1,done,2,2.0,0.2,0.5,0.01,0.3,0.03\n2,done,1,,,,,,\n";
        let rows = Rows::read(text).unwrap();
        let last: Vec<Line<'_>> = rows.last().collect();
        let names = ["max_pressure", "levels_1_load_share", "stress_max_tau1_value"];
        let all = names.map(|name| last[0].measured(name).unwrap());
        assert_eq!(all, [(2.0, Some(0.2)), (0.5, Some(0.01)), (0.3, Some(0.03))]);
        assert!(last.len() == 2 && last[1].measured("max_pressure").is_none());
    }
}

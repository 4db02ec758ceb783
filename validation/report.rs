//! The verdicts of a run, as a table for the terminal and as Markdown for the repository.
//!
//! References, own refinement and findings are counted separately ([`Evidence`]). [`differences`] compares two reports by their
//! studies, quantities, evidence and verdicts. Values may differ in their digits: their tolerances judge them, not the report.

use super::{Check, Evidence, Outcome, Study, StudyError};
use percoat_app::output::table::Table;
use percoat_core::notation::number;
use std::collections::BTreeMap;

/// Columns of a row; Markdown leaves out the first one.
const COLUMNS: [&str; 8] = ["study", "quantity", "value", "reference", "error", "tolerance", "evidence", "verdict"];

/// The studies that were run, with their outcomes.
#[derive(Debug, Default)]
pub struct Report {
    results: Vec<(&'static Study, Result<Outcome, StudyError>)>,
}

impl Report {
    /// Adds the outcome of a study.
    pub fn add(&mut self, study: &'static Study, result: Result<Outcome, StudyError>) {
        self.results.push((study, result));
    }

    /// Whether every study ran and every check holds.
    pub fn holds(&self) -> bool {
        self.results.iter().all(|(_, result)| result.as_ref().is_ok_and(Outcome::holds))
    }

    /// Checks of one kind of evidence, over all studies.
    pub fn count(&self, evidence: Evidence) -> usize {
        self.results.iter().map(|(_, result)| count(result, evidence)).sum()
    }

    /// Checks that fail; a study that could not be run, or has none, counts as one.
    pub fn failures(&self) -> usize {
        self.results.iter().flat_map(|(study, result)| rows(study, result)).filter(|row| row[7] == FAILS).count()
    }

    /// Number of checks of each kind, and the verdict, in words.
    pub fn summary(&self) -> String {
        let [references, refined, findings] = Evidence::ALL.map(|evidence| self.count(evidence));
        let verdict = match self.failures() {
            0 => "all hold".to_owned(),
            1 => "1 fails".to_owned(),
            failures => format!("{failures} fail"),
        };
        format!(
            "{references} independent references, {refined} of own refinement, {findings} findings pinned: {verdict}"
        )
    }

    /// The checks of each study as a table of at most `width` letters.
    pub fn tables(&self, width: usize) -> String {
        let of = |(study, result): &(&'static Study, Result<Outcome, StudyError>)| {
            let rows = rows(study, result).into_iter().map(|row| row[1..].to_vec()).collect();
            format!("study {}\n\n{}", study.name, Table::new(&COLUMNS[1..], rows, 1).wrapped(width).fitted(width))
        };
        self.results.iter().map(of).collect::<Vec<_>>().join("\n\n")
    }

    /// Rows of the paper's table of statements, study by study.
    pub fn statements(&self) -> Vec<(&'static str, Vec<String>)> {
        let judged = |(study, result): &(&'static Study, Result<Outcome, StudyError>)| {
            let claims = result.as_ref().ok().filter(|outcome| !outcome.claims.is_empty())?;
            Some((study.name, claims.claims.iter().map(|claim| claim.row(study.name)).collect()))
        };
        self.results.iter().filter_map(judged).collect()
    }

    /// Why studies could not be run, one line each.
    pub fn errors(&self) -> Vec<String> {
        let failed = |(study, result): &(&Study, Result<Outcome, StudyError>)| {
            result.as_ref().err().map(|error| format!("{}: {error}", study.name))
        };
        self.results.iter().filter_map(failed).collect()
    }

    /// The report as Markdown: an overview, then each study with its figures and checks.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "# Validation report\n\npercoat {}: {}. `percoat validate -o validation` makes this report again.\n\n\
             | study | shows | references | refinement | findings | verdict |\n|---|---|---|---|---|---|\n",
            env!("CARGO_PKG_VERSION"),
            self.summary()
        );
        for (study, result) in &self.results {
            let [references, refined, findings] = Evidence::ALL.map(|evidence| count(result, evidence));
            let verdict = if result.as_ref().is_ok_and(Outcome::holds) { HOLDS } else { FAILS };
            text += &format!(
                "| [{0}]({0}/README.md) | {1} | {references} | {refined} | {findings} | {verdict} |\n",
                study.name, study.title
            );
        }
        for (study, result) in &self.results {
            text += &format!("\n## {}\n\n{}.\n\n", study.name, study.title);
            for (name, _) in result.iter().flat_map(|outcome| &outcome.figures) {
                text += &format!("![{0}, {name}]({0}/{name}.png)\n\n", study.name);
            }
            text += &format!("| {} |\n|{}\n", COLUMNS[1..].join(" | "), "---|".repeat(7));
            for row in rows(study, result) {
                text += &format!("| {} |\n", row[1..].join(" | "));
            }
        }
        text
    }
}

const HOLDS: &str = "holds";
const FAILS: &str = "fails";

/// Checks of one kind of evidence.
fn count(result: &Result<Outcome, StudyError>, evidence: Evidence) -> usize {
    result.iter().flat_map(|outcome| &outcome.checks).filter(|check| check.evidence == evidence).count()
}

/// The rows of a study.
fn rows(study: &Study, result: &Result<Outcome, StudyError>) -> Vec<Vec<String>> {
    let row = |check: &Check| -> Vec<String> {
        let bound = matches!(check.tolerance, super::Tolerance::AtMost | super::Tolerance::AtLeast);
        let error = if bound { "–".to_owned() } else { format!("{:.1e}", check.error()) };
        [
            study.name,
            &check.quantity,
            &number(check.value),
            &number(check.reference),
            &error,
            &check.tolerance.to_string(),
            &check.evidence.to_string(),
            check.verdict(),
        ]
        .map(str::to_owned)
        .to_vec()
    };
    let broken = |what: &str| vec![[study.name, what, "–", "–", "–", "–", "–", FAILS].map(str::to_owned).to_vec()];
    match result {
        Ok(outcome) if outcome.checks.is_empty() => broken("has checks"),
        Ok(outcome) => outcome.checks.iter().map(row).collect(),
        Err(_) => broken("runs to its end"),
    }
}

/// Differences of two Markdown reports in evidence or verdict: rows that changed, are missing or are new; of these
/// `studies` alone where given.
pub fn differences(expected: &str, found: &str, studies: Option<&[&str]>) -> Vec<String> {
    let known = verdicts(found);
    let missing = verdicts(expected).into_iter().filter(|(row, _)| is_of(studies, row) && !known.contains_key(row));
    let missing =
        missing.map(|((study, quantity), verdict)| format!("{study}: {quantity}: missing, expected {verdict}"));
    missing.chain(contradictions(expected, found, studies)).collect()
}

/// Differences from a report that need not have all rows: rows that changed or are new.
pub fn contradictions(expected: &str, found: &str, studies: Option<&[&str]>) -> Vec<String> {
    let known = verdicts(expected);
    let contradiction = |(row, now): (Row, String)| {
        let (study, quantity) = &row;
        match known.get(&row) {
            None => Some(format!("{study}: {quantity}: {now}, but not expected at all")),
            Some(verdict) if *verdict != now => Some(format!("{study}: {quantity}: {now}, expected {verdict}")),
            Some(_) => None,
        }
    };
    verdicts(found).into_iter().filter(|(row, _)| is_of(studies, row)).filter_map(contradiction).collect()
}

/// A study and one of its quantities.
type Row = (String, String);

fn is_of(studies: Option<&[&str]>, (study, _): &Row) -> bool {
    studies.is_none_or(|studies| studies.contains(&study.as_str()))
}

/// Verdict, with its evidence unless that is independent, by study and quantity, from the sections of a Markdown report.
/// Rows of the same name count one by one.
fn verdicts(markdown: &str) -> BTreeMap<Row, String> {
    let mut verdicts = BTreeMap::new();
    let mut study = None;
    for line in markdown.lines() {
        if let Some(name) = line.strip_prefix("## ") {
            study = Some(name.trim().to_owned());
        }
        let Some(study) = &study else { continue };
        let cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
        let &[quantity, _, _, _, _, evidence, verdict] = &cells[..] else { continue };
        if quantity == COLUMNS[1] || quantity.starts_with("--") {
            continue;
        }
        let mut key = (study.clone(), quantity.to_owned());
        while verdicts.contains_key(&key) {
            key.1 += " (again)";
        }
        let independent = evidence == Evidence::Reference.to_string();
        verdicts.insert(key, if independent { verdict.to_owned() } else { format!("{verdict} as {evidence}") });
    }
    verdicts
}

#[cfg(test)]
mod tests {
    use super::*;

    static ONE: Study =
        Study { name: "one", title: "One thing", files: &[], run: || Ok(Outcome::default()), quick: None };
    static TWO: Study =
        Study { name: "two", title: "Another", files: &[], run: || Ok(Outcome::default()), quick: None };

    fn report(values: &[f64]) -> Report {
        let checks = values.iter().map(|&x| Check::relative(format!("quantity {x:.0}"), x, x.round(), 1e-2)).collect();
        let mut report = Report::default();
        report.add(&ONE, Ok(Outcome { checks, ..Outcome::default() }));
        report.add(&TWO, Ok(Outcome { checks: vec![Check::at_most("bound", 1.0, 2.0)], ..Outcome::default() }));
        report
    }

    #[test]
    fn digits_may_change_and_verdicts_may_not() {
        let [a, digits, failed] = [&[1.0, 2.0], &[1.001, 2.003], &[1.0, 2.2]].map(|values| report(values));
        assert!(a.holds() && digits.holds() && !failed.holds());
        assert_eq!(a.summary(), "2 independent references, 1 of own refinement, 0 findings pinned: all hold");
        assert_eq!(failed.summary(), "2 independent references, 1 of own refinement, 0 findings pinned: 1 fails");
        assert!(a.markdown().contains("| One thing | 2 | 0 | 0 | holds |"));
        assert_eq!(differences(&a.markdown(), &digits.markdown(), None), Vec::<String>::new());
        let changed = differences(&a.markdown(), &failed.markdown(), None);
        assert_eq!(changed, ["one: quantity 2: fails, expected holds"]);
        assert!(differences(&a.markdown(), &failed.markdown(), Some(&["two"])).is_empty());
    }

    #[test]
    fn another_kind_of_evidence_is_a_difference() {
        let of = |check: Check| {
            let mut report = Report::default();
            report.add(&ONE, Ok(Outcome { checks: vec![check], ..Outcome::default() }));
            report.markdown()
        };
        let check = Check::relative("peak", 1.0, 1.0, 1e-2);
        let [reference, finding] = [check.clone(), check.as_finding()].map(of);
        assert_eq!(differences(&reference, &finding, None), ["one: peak: holds as finding, expected holds"]);
    }

    #[test]
    fn missing_and_added_rows_are_differences() {
        let [a, fewer, twice] = [&[1.0, 2.0][..], &[1.0], &[1.0, 1.0, 2.0]].map(|values| report(values).markdown());
        assert_eq!(differences(&a, &fewer, None), ["one: quantity 2: missing, expected holds"]);
        assert_eq!(differences(&fewer, &a, None), ["one: quantity 2: holds, but not expected at all"]);
        assert_eq!(differences(&a, &twice, None).len(), 1);
        assert_eq!(differences(&a, "", None).len(), 3);
        assert_eq!(differences("", &a, None).len(), 3);
        // A quick form may lack rows.
        assert_eq!(contradictions(&a, &fewer, None), Vec::<String>::new());
        assert_eq!(contradictions(&fewer, &a, None), ["one: quantity 2: holds, but not expected at all"]);
        let failed = report(&[1.2]).markdown();
        assert_eq!(contradictions(&a, &failed, None), ["one: quantity 1: fails, expected holds"]);
    }

    #[test]
    fn a_study_that_breaks_or_checks_nothing_fails_and_is_a_row() {
        let mut report = report(&[1.0]);
        report.add(&ONE, Err("no memory".into()));
        report.add(&TWO, Ok(Outcome::default()));
        assert!(!report.holds());
        assert_eq!(report.failures(), 2);
        assert_eq!(report.errors(), ["one: no memory"]);
        let table = report.tables(80);
        assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
        assert!(table.contains("runs to its end") && table.contains("has checks"), "{table}");
    }
}

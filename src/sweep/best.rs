//! The best and the worst combination of a sweep, for each result by which a designer ranks them.
//!
//! Best is the highest limit load and the most passes until damage, and the least utilisation, tension and pressure. Combinations that
//! failed or did not converge are not ranked, and counted; of several load steps the last one counts.

use super::result::{Measured, SCALARS, SweepResult};
use super::row::{Row, Status};
use crate::output::table::{Table, Worded};
use crate::output::{number, with_error};
use crate::units::{Unit, Units};
use std::collections::BTreeSet;

/// Results that are ranked, at most: each has two lines.
const MOST: usize = 3;

/// A result by which combinations are ranked.
struct Merit {
    name: String,
    /// Whether more of it is better.
    more: bool,
    unit: Unit,
    of: fn(&SweepResult) -> Option<Measured>,
}

/// A value of a merit with its row.
type Ranked<'a> = (Measured, &'a Row);

/// The results in the order of their weight: what fails, then what strains.
fn merits(units: &Units) -> [Merit; 6] {
    fn scalar(result: &SweepResult, name: &str) -> Option<Measured> {
        let scalar = SCALARS.iter().find(|scalar| scalar.name == name)?;
        (scalar.of)(result.step()?)
    }
    let merit = |name: &str, more: bool, unit: Unit, of: fn(&SweepResult) -> Option<Measured>| Merit {
        name: name.to_owned(),
        more,
        unit,
        of,
    };
    let pressure = || units.pressure().clone();
    let first = format!("first limit, {}", units.quantity().name());
    [
        merit(&first, true, units.load(), |own| own.limit_value(None)?.measured()),
        merit("passes to damage", true, Unit::None, |own| scalar(own, "passes to damage")),
        merit("largest utilisation", false, Unit::None, SweepResult::largest_utilisation),
        merit("largest tension", false, pressure(), |own| scalar(own, "largest tension")),
        merit("peak pressure", false, pressure(), |own| scalar(own, "peak pressure")),
        merit("largest von Mises", false, pressure(), |own| scalar(own, "largest von Mises")),
    ]
}

/// The table of the best and the worst combination; `None` where less than two combinations that are done have a result. The load is
/// in the quantity of `units`.
pub fn best_and_worst(rows: &[Row], units: &Units) -> Option<Worded> {
    let done: Vec<&Row> = rows.iter().filter(|row| row.status == Status::Done).collect();
    let ranked = merits(units).into_iter().filter_map(|merit| Some((ends(&done, &merit)?, merit)));
    let lines = ranked.take(MOST).flat_map(|([best, worst], merit)| {
        let line = |name: &str, word: &str, (measured, row): Ranked<'_>, open: &str| {
            vec![name.to_owned(), word.to_owned(), text(&merit, measured) + open, settings(row)]
        };
        let open = if is_open(best.0, worst.0) { ", within the errors" } else { "" };
        [line(&merit.name, "best", best, ""), line("", "worst", worst, open)]
    });
    let lines: Vec<Vec<String>> = lines.collect();
    let head = ["result", "", "value", "combination"];
    (!lines.is_empty()).then(|| Worded { words: words(rows, done.len()), table: Table::new(&head, lines, 4) })
}

/// How many combinations are ranked, and how many are not.
fn words(rows: &[Row], done: usize) -> String {
    let count = |status: Status, what: &str| {
        let count = rows.iter().filter(|row| row.status == status).count();
        (count > 0).then(|| format!("{count} {what}"))
    };
    let left_out: Vec<String> =
        [count(Status::NotConverged, "not converged"), count(Status::Failed, "failed")].into_iter().flatten().collect();
    let left_out = if left_out.is_empty() { String::new() } else { format!("; left out: {}", left_out.join(", ")) };
    let steps = if rows.iter().any(|row| row.results.len() > 1) { ", last load steps" } else { "" };
    format!("best and worst of {done} combinations{steps}{left_out}")
}

/// The best and the worst of the rows; `None` for less than two.
fn ends<'a>(rows: &[&'a Row], merit: &Merit) -> Option<[Ranked<'a>; 2]> {
    let values = rows.iter().filter_map(|row| Some(((merit.of)(row.results.last()?)?, *row)));
    let mut values: Vec<Ranked<'_>> = values.filter(|((value, _), _)| value.is_finite()).collect();
    values.sort_by(|(a, _), (b, _)| if merit.more { b.0.total_cmp(&a.0) } else { a.0.total_cmp(&b.0) });
    match values[..] {
        [best, .., worst] => Some([best, worst]),
        _ => None,
    }
}

/// Whether two values differ by less than their errors, so that either may be the better one.
fn is_open(best: Measured, worst: Measured) -> bool {
    (best.0 - worst.0).abs() < best.1.unwrap_or(0.0) + worst.1.unwrap_or(0.0)
}

fn text(merit: &Merit, (value, error): Measured) -> String {
    let unit = merit.unit.prefixed(value);
    unit.behind(&with_error(unit.shown(value), error.map(|error| unit.shown(error))))
}

/// Number and settings of a row: of long numbers five digits, of keys the last part where no two have the same.
fn settings(row: &Row) -> String {
    const LONG: usize = 8;
    let short = |value: &str| match value.parse::<f64>() {
        Ok(x) if value.len() > LONG => number(x),
        _ => value.to_owned(),
    };
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    let distinct: BTreeSet<String> = row.settings.iter().map(|(key, _)| last(key)).collect();
    let name = |key: &str| if distinct.len() == row.settings.len() { last(key) } else { key.to_owned() };
    let settings = row.settings.iter().map(|(key, value)| format!("{} = {}", name(key), short(value)));
    format!("{}: {}", row.combination, settings.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::super::examples::{below, reached, row, step, strained};
    use super::*;
    use crate::reading::{Criterion, Utilisation};

    fn lines(rows: &[Row]) -> Vec<String> {
        let units = Units::unknown().named(Some("µm"), Some("GPa"));
        let worded = best_and_worst(rows, &units).expect("results");
        let text = worded.table.to_string().replace('\u{a0}', " ");
        let squeezed = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        [worded.words].into_iter().chain(text.lines().skip(2).map(squeezed)).collect()
    }

    #[test]
    fn the_best_has_the_least_pressure_and_what_is_not_done_is_counted() {
        let one = |n: usize, peak: f64| {
            row(
                n,
                &[("layers.0.thickness", format!("{n}"))],
                vec![SweepResult::Step(Box::new(step(peak, Some(0.1), 0.5)))],
            )
        };
        let mut rows = vec![one(1, 3.0), one(2, 1.0), one(3, 2.0), one(4, 0.5), one(5, 9.0)];
        rows[3].status = Status::NotConverged;
        (rows[4].status, rows[4].results) = (Status::Failed, Vec::new());
        let expected = [
            "best and worst of 3 combinations; left out: 1 not converged, 1 failed",
            "peak pressure best 1.0 ± 0.1 GPa 2: thickness = 2",
            "worst 3.0 ± 0.1 GPa 1: thickness = 1",
        ];
        assert_eq!(lines(&rows), expected);
        assert!(best_and_worst(&rows[..1], &Units::unknown()).is_none());
    }

    #[test]
    fn the_best_limit_is_the_highest_and_a_bound_is_not_ranked() {
        let yields = Criterion::yield_of(1);
        let limits = [reached(yields, 0.2, 0.01), reached(yields, 0.7, 0.01), below(yields, 0.1)];
        let rows: Vec<Row> = (1..)
            .zip(limits)
            .map(|(n, limit)| row(n, &[("a", format!("{n}.000000001"))], vec![SweepResult::Limits(vec![limit])]))
            .collect();
        let lines = lines(&rows);
        assert_eq!(lines[1], "first limit, mean pressure best 0.70 ± 0.01 GPa 2: a = 2.0000");
        assert_eq!(lines[2], "worst 0.20 ± 0.01 GPa 1: a = 1.0000");
    }

    #[test]
    fn utilisations_come_before_stresses_and_no_more_than_three_results_are_ranked() {
        let one = |n: usize| {
            let own = Utilisation::new(Criterion::yield_of(1), 0.1 * n as f64, Some(0.01), [0.0; 3]);
            row(n, &[("a", n.to_string())], vec![strained(vec![own])])
        };
        let lines = lines(&[one(1), one(2)]);
        assert_eq!(lines[1], "largest utilisation best 0.10 ± 0.01 1: a = 1");
        assert!(lines.len() <= 2 * MOST + 1, "{lines:?}");
    }

    #[test]
    fn a_difference_within_the_errors_is_said_to_be_one() {
        let yields = Criterion::yield_of(1);
        let limits = [reached(yields, 0.5, 0.3), reached(yields, 0.7, 0.2)];
        let rows: Vec<Row> = (1..)
            .zip(limits)
            .map(|(n, limit)| row(n, &[("a", n.to_string())], vec![SweepResult::Limits(vec![limit])]))
            .collect();
        assert_eq!(lines(&rows)[2], "worst 0.5 ± 0.3 GPa, within the errors 1: a = 1");
    }

    #[test]
    fn keys_of_one_name_are_told_apart() {
        let row = row(7, &[("layers.0.young", "2".to_owned()), ("substrate.young", "1".to_owned())], Vec::new());
        assert_eq!(settings(&row), "7: layers.0.young = 2, substrate.young = 1");
    }
}

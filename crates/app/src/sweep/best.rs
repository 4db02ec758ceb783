//! The best and the worst combination of a sweep, for each result by which a designer ranks them.
//!
//! Best is the highest limit load and the most passes until damage, and the least utilisation, friction by hysteresis, tension and pressure. A combination
//! that reaches no limit is better than one that does, if it was loaded at least as far. Combinations that failed or did not converge
//! are not ranked, and counted; of several load steps the last one counts.

use super::result::{LimitValue, SweepResult, stated};
use super::row::{Row, Status};
use crate::output::table::{Table, Worded};
use crate::output::{in_unit, number, passes_with_error};
use percoat_case::units::Units;
use percoat_core::load::LoadQuantity;
use percoat_core::measured::Measured;
use percoat_core::quantity::Kind;
use percoat_core::reading::{HYSTERESIS, LIFE, READING, TEMPERATURE, UTILISATION};
use percoat_core::run::OfStep;
use percoat_core::stress::maxima::EXTREMES;
use std::collections::BTreeSet;

/// Results that are ranked, at most: each has two lines.
const MOST: usize = 3;

/// A result by which combinations are ranked.
struct Merit {
    name: String,
    /// Whether more of it is better.
    more: bool,
    kind: Kind,
    of: Box<Weighed>,
}

/// The value of a merit in a result; `None` where it does not apply.
type Weighed = dyn Fn(&SweepResult) -> Option<LimitValue>;

/// A value of a merit with its row.
type Ranked<'a> = (LimitValue, &'a Row);

/// The combinations at both ends of a ranking.
struct Ends<'a> {
    best: Ranked<'a>,
    worst: Ranked<'a>,
    /// Number of others that reach no limit up to a load below that of the best: one of them may be better.
    unlimited: usize,
}

/// The results in the order of their weight: what fails, then what strains.
fn merits(load: LoadQuantity) -> [Merit; 8] {
    let known = |found: Measured| LimitValue::At(found.value, found.error);
    let merit = |quantity: &'static dyn OfStep, more: bool| {
        let of = move |result: &SweepResult| stated(quantity, result.step()?).map(known);
        Merit { name: quantity.named().name.to_owned(), more, kind: quantity.named().kind, of: Box::new(of) }
    };
    let kind = READING.load(load).named.kind;
    let first = format!("first limit, {}", load.name());
    let largest = move |result: &SweepResult| result.largest_utilisation().map(known);
    [
        Merit { name: first, more: true, kind, of: Box::new(first_limit) },
        merit(&LIFE.passes, true),
        Merit {
            name: format!("largest {}", UTILISATION.value.named.name),
            more: false,
            kind: UTILISATION.value.named.kind,
            of: Box::new(largest),
        },
        merit(&HYSTERESIS.friction_coefficient, false),
        merit(&TEMPERATURE.max, false),
        merit(&EXTREMES.tension, false),
        merit(&READING.max_pressure, false),
        merit(&EXTREMES.mises, false),
    ]
}

/// The first limit; where nothing fails, the least load up to which a criterion was followed, as a bound.
pub(super) fn first_limit(result: &SweepResult) -> Option<LimitValue> {
    result.limit_value(None).or_else(|| {
        let loads = result.limits()?.iter().filter_map(|limit| match limit.into() {
            LimitValue::Above(load) => Some(load),
            _ => None,
        });
        loads.min_by(f64::total_cmp).map(LimitValue::Above)
    })
}

/// The table of the best and the worst combination; `None` where less than two combinations that are done have a result. The load is
/// in the quantity of `units`.
pub fn best_and_worst(rows: &[Row], units: &Units) -> Option<Worded> {
    let done: Vec<&Row> = rows.iter().filter(|row| row.status == Status::Done).collect();
    let ranked = merits(units.quantity()).into_iter().filter_map(|merit| Some((ends(&done, &merit)?, merit)));
    let lines = ranked.take(MOST).flat_map(|(Ends { best, worst, unlimited }, merit)| {
        let line = |name: &str, word: &str, (value, row): Ranked<'_>, open: &str| {
            vec![name.to_owned(), word.to_owned(), text(units, &merit, value) + open, settings(row)]
        };
        let or_another = match unlimited {
            0 => String::new(),
            1 => ", or another that reaches no limit".to_owned(),
            count => format!(", or one of {count} that reach no limit"),
        };
        let open = if is_open(best.0, worst.0) { ", within the errors" } else { "" };
        [line(&merit.name, "best", best, &or_another), line("", "worst", worst, open)]
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

/// The best and the worst of the rows; `None` for less than two that can be told apart.
fn ends<'a>(rows: &[&'a Row], merit: &Merit) -> Option<Ends<'a>> {
    let values = rows.iter().filter_map(|row| Some(((merit.of)(row.results.last()?)?, *row)));
    let mut values: Vec<Ranked<'_>> = values.filter(|(value, _)| load(*value).is_some_and(f64::is_finite)).collect();
    values.sort_by(|(a, _), (b, _)| {
        let order = load(*a).unwrap_or(0.0).total_cmp(&load(*b).unwrap_or(0.0));
        if merit.more { order.reverse() } else { order }
    });
    let is_unlimited = |ranked: &Ranked<'_>| matches!(ranked.0, LimitValue::Above(_));
    // Loads of one size: what reaches no limit up to there bears more.
    let mut best = *values.iter().find(|ranked| !matches!(ranked.0, LimitValue::Below(_)))?;
    if let Some(ranked) = values.iter().find(|ranked| is_unlimited(ranked) && load(ranked.0) >= load(best.0)) {
        best = *ranked;
    }
    let worst = *values.iter().rfind(|ranked| !is_unlimited(ranked))?;
    let unlimited =
        values.iter().filter(|ranked| is_unlimited(ranked) && ranked.1.combination != best.1.combination).count();
    (best.1.combination != worst.1.combination).then_some(Ends { best, worst, unlimited })
}

/// The value, or the bound of one that is not known.
fn load(value: LimitValue) -> Option<f64> {
    match value {
        LimitValue::At(load, _) | LimitValue::Below(load) | LimitValue::Above(load) => Some(load),
        LimitValue::Undecided => None,
    }
}

/// Whether two values differ by less than their errors, so that either may be the better one.
fn is_open(best: LimitValue, worst: LimitValue) -> bool {
    let (Some(best), Some(worst)) = (best.measured(), worst.measured()) else { return false };
    (best.value - worst.value).abs() < best.error.unwrap_or(0.0) + worst.error.unwrap_or(0.0)
}

fn text(units: &Units, merit: &Merit, value: LimitValue) -> String {
    let unit = units.unit(merit.kind).prefixed(load(value).unwrap_or_default());
    let bound = |sign: &str, load: f64| unit.behind(&format!("{sign} {}", number(unit.shown(load))));
    match value {
        LimitValue::At(passes, error) if merit.kind == Kind::Passes => passes_with_error(Measured::new(passes, error)),
        LimitValue::At(load, error) => unit.behind(&in_unit(&unit, Measured::new(load, error))),
        LimitValue::Below(load) => bound("<", load),
        LimitValue::Above(load) => bound(">", load),
        LimitValue::Undecided => String::new(),
    }
}

/// Number and settings of a row: of long numbers five digits, of keys the last part where no two have the same.
fn settings(row: &Row) -> String {
    const LONG: usize = 8;
    let short = |value: &str| match value.parse::<f64>() {
        Ok(x) if value.len() > LONG => number(x),
        _ => value.to_owned(),
    };
    let keys: Vec<&str> = row.settings.iter().map(|(key, _)| &key[..]).collect();
    let settings = short_keys(&keys).into_iter().zip(&row.settings);
    let settings = settings.map(|(name, (_, value))| format!("{name} = {}", short(value)));
    format!("{}: {}", row.combination, settings.collect::<Vec<_>>().join(", "))
}

/// Dotted keys, each shortened to its last part if these all differ, else whole.
pub(super) fn short_keys(keys: &[&str]) -> Vec<String> {
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    let short: Vec<String> = keys.iter().map(|key| last(key)).collect();
    let is_distinct = short.iter().collect::<BTreeSet<_>>().len() == keys.len();
    if is_distinct { short } else { keys.iter().map(|&key| key.to_owned()).collect() }
}

#[cfg(test)]
mod tests {
    use super::super::examples::{below, never, reached, row, step, strained};
    use super::*;
    use percoat_core::reading::{Criterion, Utilisation};
    use percoat_core::run::Limit;

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

    fn limits(limits: &[Limit]) -> Vec<Row> {
        let result = |limit: &Limit| vec![SweepResult::Limits(vec![*limit])];
        (1..).zip(limits).map(|(n, limit)| row(n, &[("a", format!("{n}.000000001"))], result(limit))).collect()
    }

    #[test]
    fn the_best_limit_is_the_highest_and_one_below_the_grid_the_worst() {
        let yields = Criterion::yield_of(1);
        let limit_loads = [reached(yields, 0.2, 0.01), reached(yields, 0.7, 0.01), below(yields, 0.1)];
        let lines = lines(&limits(&limit_loads));
        assert_eq!(lines[1], "first limit, mean pressure best 0.70 ± 0.01 GPa 2: a = 2.0000");
        assert_eq!(lines[2], "worst < 0.10000 GPa 3: a = 3.0000");
    }

    #[test]
    fn what_reaches_no_limit_is_the_best_where_it_was_loaded_as_far() {
        let yields = Criterion::yield_of(1);
        let [least, most] = [reached(yields, 0.2, 0.01), reached(yields, 0.7, 0.01)];
        let best = |each: &[Limit]| lines(&limits(each))[1].clone();
        assert_eq!(
            best(&[least, most, never(yields, 2.0)]),
            "first limit, mean pressure best > 2.0000 GPa 3: a = 3.0000"
        );
        let open = "first limit, mean pressure best 0.70 ± 0.01 GPa, or another that reaches no limit 2: a = 2.0000";
        assert_eq!(best(&[least, most, never(yields, 0.5)]), open);
        // Nothing can be said of these two.
        let rows = limits(&[most, never(yields, 0.5)]);
        assert!(best_and_worst(&rows, &Units::unknown()).is_none());
    }

    #[test]
    fn utilisations_come_before_stresses_and_no_more_than_three_results_are_ranked() {
        let one = |n: usize| {
            let utilisation = Utilisation::new(Criterion::yield_of(1), 0.1 * n as f64, Some(0.01), [0.0; 3]);
            row(n, &[("a", n.to_string())], vec![strained(vec![utilisation])])
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
        assert_eq!(lines(&rows)[2], "worst 0.20 to 0.80 GPa, within the errors 1: a = 1");
    }

    #[test]
    fn keys_of_one_name_are_told_apart() {
        let row = row(7, &[("layers.0.young", "2".to_owned()), ("substrate.young", "1".to_owned())], Vec::new());
        assert_eq!(settings(&row), "7: layers.0.young = 2, substrate.young = 1");
    }
}

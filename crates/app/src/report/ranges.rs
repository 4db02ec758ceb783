//! Summary of a sweep: how often each criterion is first, and the least and largest value of every result.

use super::given::settings;
use super::markup::{Markup, numbers, with};
use super::table::table;
use crate::output::table::Table;
use crate::output::{in_unit, percent_with_error, with_unit};
use crate::sweep::{Foremost, LimitValue, Row, SweepResult, SweptKey, shown_with, stated};
use percoat_case::units::Units;
use percoat_core::measured::Measured;
use percoat_core::notation::WIDE;
use percoat_core::quantity::{Kind, Named};
use percoat_core::reading::{Criterion, READING};
use percoat_core::run::OfStep;

/// The least and the largest value of a result.
struct ValueRange {
    name: String,
    /// Least and largest value, each with the settings of its combination.
    ends: [(String, String); 2],
}

/// The answer of a sweep in sentences; nothing where no combination has results.
pub(super) fn sentences(rows: &[Row], keys: &[SweptKey], units: &Units) -> Vec<Markup> {
    let sentence = |text: String| with("p", &[("class", "answer")], numbers(&text));
    let between = |ValueRange { name, ends: [least, most] }: ValueRange| {
        if least.0 == most.0 {
            return format!("The {name} is {}", least.0);
        }
        format!("The {name} lies between {} ({}) and {} ({})", least.0, least.1, most.0, most.1)
    };
    if !are_limits(rows) {
        let peak = quantity_range(rows, keys, &READING.max_pressure, units);
        return peak.map(|peak| sentence(format!("{}{}.", between(peak), of_last(rows)))).into_iter().collect();
    }
    let mut sentences: Vec<Markup> = firsts(rows).map(sentence).into_iter().collect();
    let first = limit_range(rows, keys, &format!("first limit (a {})", units.quantity().name()), None, units);
    let below = last(rows).filter_map(|(_, result)| match result.limit_value(None) {
        Some(LimitValue::Below(load)) => Some(load),
        _ => None,
    });
    let below: Vec<f64> = below.collect();
    let below = below.iter().copied().reduce(f64::max).map(|most| {
        let most = with_unit(&units.load(), Measured::exact(most));
        format!("in {} the first limit is known only to lie below {most}", combinations(below.len()))
    });
    let parts: Vec<String> = first.map(between).into_iter().chain(below).collect();
    if !parts.is_empty() {
        let text = parts.join("; ");
        let (first, rest) = text.split_at(text.chars().next().map_or(0, char::len_utf8));
        sentences.push(sentence(format!("{}{rest}.", first.to_uppercase())));
    }
    sentences
}

/// The least and the largest of every result over the combinations.
pub(super) fn ranges(rows: &[Row], keys: &[SweptKey], units: &Units) -> Markup {
    let limits = criteria(rows).into_iter().map(|criterion| {
        let name = criterion.map_or("first limit".to_owned(), |criterion| criterion.to_string());
        limit_range(rows, keys, &name, criterion, units)
    });
    // The load is prescribed.
    let load = &READING.load(units.quantity()).named;
    let others = shown_with(units.quantity()).filter(|quantity| quantity.named() != load);
    let others = others.map(|quantity| quantity_range(rows, keys, quantity, units));
    let row = |ValueRange { name, ends: [least, most] }: ValueRange| vec![name, least.0, least.1, most.0, most.1];
    let all: Vec<Vec<String>> = limits.chain(others).flatten().map(row).collect();
    if all.is_empty() || rows.len() < 2 {
        return Markup::default();
    }
    let head = ["result", "least", "where", "largest", "where"].map(str::to_owned);
    let steps = if of_last(rows).is_empty() { "" } else { ", last load steps" };
    table(
        &format!("Least and largest of all combinations{steps}; ± is the estimated error of the grid"),
        &Table::new(&head, all, 5),
    )
}

/// The last result of each combination that has any.
fn last(rows: &[Row]) -> impl DoubleEndedIterator<Item = (&Row, &SweepResult)> {
    rows.iter().filter_map(|row| Some((row, row.results.last()?)))
}

/// The end of a sentence that names the load step of the results; empty where each combination has one.
fn of_last(rows: &[Row]) -> &'static str {
    if rows.iter().any(|row| row.results.len() > 1) { " in the last load step of each combination" } else { "" }
}

/// The first limit and that of each criterion; nothing where load steps were solved.
pub(super) fn criteria(rows: &[Row]) -> Vec<Option<Criterion>> {
    let criteria = SweepResult::criteria(last(rows).map(|(_, result)| result)).into_iter().map(Some);
    are_limits(rows).then_some(None).into_iter().chain(criteria).collect()
}

/// Whether limit loads were searched for.
pub(super) fn are_limits(rows: &[Row]) -> bool {
    last(rows).next().is_some_and(|(_, result)| result.limits().is_some())
}

/// The least and the largest of a quantity of load steps.
fn quantity_range(rows: &[Row], keys: &[SweptKey], quantity: &'static dyn OfStep, units: &Units) -> Option<ValueRange> {
    let Named { name, kind, .. } = *quantity.named();
    range(rows, keys, name, |result| stated(quantity, result.step()?), (kind, units))
}

/// The least and the largest of the first limit, or of that of a criterion.
fn limit_range(
    rows: &[Row],
    keys: &[SweptKey],
    name: &str,
    of: Option<Criterion>,
    units: &Units,
) -> Option<ValueRange> {
    let kind = READING.load(units.quantity()).named.kind;
    range(rows, keys, name, |result| result.limit_value(of)?.measured(), (kind, units))
}

/// The least and the largest of a value of a kind over the combinations that have it.
fn range(
    rows: &[Row],
    keys: &[SweptKey],
    name: &str,
    value: impl Fn(&SweepResult) -> Option<Measured>,
    (kind, units): (Kind, &Units),
) -> Option<ValueRange> {
    let found: Vec<(Measured, &Row)> = last(rows).filter_map(|(row, result)| Some((value(result)?, row))).collect();
    let least = found.iter().min_by(|a, b| a.0.value.total_cmp(&b.0.value))?;
    let most = found.iter().rev().max_by(|a, b| a.0.value.total_cmp(&b.0.value))?;
    // Both in one unit.
    let unit = units.unit(kind).prefixed(most.0.value);
    // An interval would not read between two words.
    let is_wide = |found: Measured| found.relative().is_some_and(|relative| relative > WIDE);
    let text = |found: Measured| match kind {
        _ if is_wide(found) => unit.behind(&in_unit(&unit, Measured::exact(found.value))),
        Kind::Fraction => percent_with_error(found),
        _ => unit.behind(&in_unit(&unit, found)),
    };
    let end = |(found, row): &(Measured, &Row)| (text(*found), settings(keys, row));
    Some(ValueRange { name: name.to_owned(), ends: [end(least), end(most)] })
}

/// How often each criterion is first, in a sentence.
fn firsts(rows: &[Row]) -> Option<String> {
    let counts = Foremost::counted(last(rows).map(|(_, result)| result));
    let all: usize = counts.iter().map(|(_, count)| count).sum();
    let text = |(at, (first, count)): (usize, &(Foremost, usize))| {
        let name = if *first == Foremost::Nothing { "nothing".to_owned() } else { first.to_string() };
        match at {
            0 if *count == all => format!("{name} in all of them"),
            0 => format!("{name} in {count} of {}", combinations(all)),
            _ => format!("{name} in {count}"),
        }
    };
    let text: Vec<String> = counts.iter().enumerate().map(text).collect();
    let open = last(rows).filter(|(_, result)| !result.rivals().is_empty()).count();
    let open = match open {
        0 => String::new(),
        _ => format!("; in {} the errors leave open which", combinations(open)),
    };
    (!text.is_empty()).then(|| format!("What fails first: {}{open}.", text.join(", ")))
}

fn combinations(count: usize) -> String {
    if count == 1 { "1 combination".to_owned() } else { format!("{count} combinations") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::examples::{below, isolated, never, reached, row, step};
    use percoat_core::load::LoadQuantity;
    use percoat_core::run::Limit;

    const YIELDS: Criterion = Criterion::yield_of(1);
    const CRACKS: Criterion = Criterion::cracking_of(1);
    const PARTS: Criterion = Criterion::delamination_of(1);

    /// The sentences and the table of these results, one a combination that sets `a` to its number; without results it has
    /// failed.
    fn said(results: &[Vec<SweepResult>]) -> String {
        let values = (1..=results.len()).map(|n| n.to_string()).collect();
        let keys = [SweptKey { key: "a".to_owned(), values }];
        let rows: Vec<Row> =
            (1..).zip(results).map(|(n, results)| row(n, &[("a", n.to_string())], results.clone())).collect();
        let units = Units::unknown().named(Some("mm"), Some("MPa"));
        let quantity = results.iter().flatten().find_map(SweepResult::quantity).unwrap_or_default();
        let units = units.with_loads_in(quantity);
        let markup: Markup =
            [sentences(&rows, &keys, &units).into(), ranges(&rows, &keys, &units)].into_iter().collect();
        markup.as_str().replace('\u{a0}', " ")
    }

    #[test]
    fn limits_are_summed_up_by_what_comes_first_and_by_the_range_of_the_first() {
        let limits = |limits: [Limit; 2]| vec![SweepResult::Limits(limits.to_vec())];
        let page = said(&[
            limits([reached(YIELDS, 20.0, 2.0), never(PARTS, 100.0)]),
            limits([reached(YIELDS, 30.0, 0.3), reached(PARTS, 7.0, 0.5)]),
            limits([never(YIELDS, 100.0), below(PARTS, 3.0)]),
            Vec::new(),
        ]);
        for words in [
            "delamination of interface 1 in 2 of 3 combinations, yield of material 1 in 1.",
            "The first limit (a mean pressure) lies between 7.0 ± 0.5 MPa (a = 2) and 20 ± 2 MPa (a = 1); in 1 combination the \
             first limit is known only to lie below 3.0000 MPa.",
            ">30.0 ± 0.3 MPa<",
        ] {
            assert!(page.contains(words), "no {words}: {page}");
        }
    }

    #[test]
    fn limits_in_force_are_forces() {
        let limit = |limit: Limit| vec![SweepResult::Limits(vec![Limit { quantity: LoadQuantity::Force, ..limit }])];
        let page =
            said(&[limit(reached(YIELDS, 20.0, 2.0)), limit(reached(YIELDS, 40.0, 2.0)), limit(below(YIELDS, 3.0))]);
        assert!(
            page.contains("The first limit (a force) lies between 20 ± 2 N (a = 1) and 40 ± 2 N (a = 2)"),
            "{page}"
        );
        assert!(page.contains("only to lie below 3.0000 N") && !page.contains("MPa"), "{page}");
        let step = |force: f64| vec![SweepResult::Step(Box::new(isolated(force, 100.0 * force)))];
        let page = said(&[step(1.0), step(2.0)]);
        assert!(page.contains("contact area") && page.contains("mm²") && !page.contains("NaN"), "{page}");
    }

    #[test]
    fn undecided_combinations_are_counted() {
        let limits = |crack: f64| {
            vec![SweepResult::Limits(vec![reached(YIELDS, 20.0, 2.0), reached(CRACKS, crack, 0.1 * crack)])]
        };
        let page = said(&[limits(23.0), limits(40.0)]);
        assert!(
            page.contains("yield of material 1 in all of them; in 1 combination the errors leave open which."),
            "{page}"
        );
    }

    #[test]
    fn loads_are_summed_up_by_the_last_peak_pressures() {
        let step = |peak: f64, error: f64, part: f64| SweepResult::Step(Box::new(step(peak, Some(error), part)));
        let page = said(&[
            vec![step(900.0, 1.0, 0.1), step(100.0, 1.0, 0.2)],
            vec![step(90.0, 1.0, 0.1), step(200.0, 20.0, 0.25)],
            Vec::new(),
        ]);
        let words = "The peak pressure lies between 100 ± 1 MPa (a = 1) and 200 ± 20 MPa (a = 2) in the last load step";
        assert!(page.contains(words) && page.contains(">25.00 %<"), "{page}");
    }
}

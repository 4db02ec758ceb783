//! What a sweep comes to: which criterion comes first how often, and the least and the largest of every result.

use super::given::{Key, settings};
use super::markup::{Markup, numbers, with};
use super::rows::{Limit, Line, Rows};
use super::table::table;
use super::units::told;
use crate::output::table::{Table, percent_with_error};
use crate::output::with_error;
use crate::units::{Unit, Units};
use std::collections::BTreeMap;

/// A result in its least and in its largest.
struct Range {
    name: String,
    /// Each with the settings of its combination.
    ends: [(String, String); 2],
}

/// The answer of a sweep in sentences; nothing where no combination has results.
pub(super) fn sentences(rows: &Rows<'_>, keys: &[Key], units: &Units) -> Vec<Markup> {
    let sentence = |text: String| with("p", &[("class", "answer")], numbers(&text));
    let between = |Range { name, ends: [least, most] }: Range| {
        if least.0 == most.0 {
            return format!("The {name} is {}", least.0);
        }
        format!("The {name} lies between {} ({}) and {} ({})", least.0, least.1, most.0, most.1)
    };
    let pressure = Some(units.pressure());
    if rows.limits().is_empty() {
        let peak = range(rows, keys, "peak pressure", |line| line.measured("max_pressure"), pressure);
        let steps = rows.last().count() < rows.lines().len();
        let of = if steps { " in the last load step of each combination" } else { "" };
        return peak.map(|peak| sentence(format!("{}{of}.", between(peak)))).into_iter().collect();
    }
    let mut sentences: Vec<Markup> = firsts(rows).map(sentence).into_iter().collect();
    let first = range(rows, keys, "first limit (a mean pressure)", |line| number_of(line.limit("first")), pressure);
    let below = rows.last().filter_map(|line| match line.limit("first") {
        Some(Limit::Below(load)) => Some(load),
        _ => None,
    });
    let below: Vec<f64> = below.collect();
    let below = below.iter().copied().reduce(f64::max).map(|most| {
        let most = told(units.pressure(), most, None);
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
pub(super) fn ranges(rows: &Rows<'_>, keys: &[Key], units: &Units) -> Markup {
    let [pressure, length] = [units.pressure(), units.length()].map(Some);
    let limits = rows.limits();
    let mut all: Vec<Option<Range>> = Vec::new();
    let firsts = Some("first").filter(|_| !limits.is_empty());
    for name in firsts.into_iter().chain(limits) {
        let words = if name == "first" { "first limit".to_owned() } else { name.replace('_', " ") };
        all.push(range(rows, keys, &words, |line| number_of(line.limit(name)), pressure));
    }
    for (name, words, unit) in [
        ("max_pressure", "peak pressure", pressure),
        ("penetration", "penetration", length),
        ("contact_fraction", "contact", None),
        ("stress_max_tau1_value", "largest τ₁", pressure),
        ("stress_max_tension_value", "largest tension", pressure),
        ("stress_max_mises_value", "largest von Mises", pressure),
    ] {
        all.push(range(rows, keys, words, |line| line.measured(name), unit));
    }
    let row = |Range { name, ends: [least, most] }: Range| vec![name, least.0, least.1, most.0, most.1];
    let all: Vec<Vec<String>> = all.into_iter().flatten().map(row).collect();
    if all.is_empty() || rows.last().nth(1).is_none() {
        return Markup::default();
    }
    let head = ["result", "least", "where", "largest", "where"].map(str::to_owned);
    let steps = if rows.last().count() < rows.lines().len() { ", last load steps" } else { "" };
    table(
        &format!("Least and largest of all combinations{steps}; ± is the estimated error of the grid"),
        &Table::new(&head, all, 5),
    )
}

fn number_of(limit: Option<Limit>) -> Option<(f64, Option<f64>)> {
    if let Limit::At(load, error) = limit? { Some((load, error)) } else { None }
}

/// The least and the largest of what the combinations have.
fn range(
    rows: &Rows<'_>,
    keys: &[Key],
    name: &str,
    value: impl Fn(Line<'_>) -> Option<(f64, Option<f64>)>,
    unit: Option<&Unit>,
) -> Option<Range> {
    let found: Vec<(f64, Option<f64>, Line<'_>)> =
        rows.last().filter_map(|line| value(line).map(|(x, error)| (x, error, line))).collect();
    let least = found.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let most = found.iter().rev().max_by(|a, b| a.0.total_cmp(&b.0))?;
    // Both in one unit; what has none is a part.
    let unit = unit.map(|unit| unit.prefixed(most.0));
    let told = |x: f64, error: Option<f64>| match &unit {
        Some(unit) => unit.behind(&with_error(unit.shown(x), error.map(|error| unit.shown(error)))),
        None => percent_with_error(x, error),
    };
    let end = |(x, error, line): &(f64, Option<f64>, Line<'_>)| (told(*x, *error), settings(keys, *line));
    Some(Range { name: name.to_owned(), ends: [end(least), end(most)] })
}

/// Which criterion comes first in how many combinations.
fn firsts(rows: &Rows<'_>) -> Option<String> {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let limits = rows.limits();
    let searched = |line: &Line<'_>| limits.iter().any(|name| line.text(&format!("{name}_reached")).is_some());
    for line in rows.last().filter(searched) {
        let none = || if line.rivals("first").is_empty() { "nothing" } else { "undecided" }.to_owned();
        *counts.entry(line.first().unwrap_or_else(none)).or_default() += 1;
    }
    let all: usize = counts.values().sum();
    let mut counts: Vec<(String, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| usize::MAX - count);
    let told = |(at, (name, count)): (usize, &(String, usize))| match at {
        0 if *count == all => format!("{name} in all of them"),
        0 => format!("{name} in {count} of {}", combinations(all)),
        _ => format!("{name} in {count}"),
    };
    let told: Vec<String> = counts.iter().enumerate().map(told).collect();
    let open = rows.last().filter(|line| !line.rivals("first").is_empty()).count();
    let open = match open {
        0 => String::new(),
        _ => format!("; in {} the errors leave open which", combinations(open)),
    };
    (!told.is_empty()).then(|| format!("What fails first: {}{open}.", told.join(", ")))
}

fn combinations(count: usize) -> String {
    if count == 1 { "1 combination".to_owned() } else { format!("{count} combinations") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;
    use serde_json::json;

    fn said(table: &str) -> String {
        let keys = [Key::deserialize(json!({ "key": "a", "values": ["1", "2", "3", "4"] })).unwrap()];
        let (rows, units) = (Rows::read(table).unwrap(), Units::unknown().named(Some("mm"), Some("MPa")));
        let markup: Markup =
            [sentences(&rows, &keys, &units).into(), ranges(&rows, &keys, &units)].into_iter().collect();
        markup.as_str().replace('\u{a0}', " ")
    }

    #[test]
    fn limits_are_summed_up_by_what_comes_first_and_by_the_range_of_the_first() {
        let head = "combination,set_a,status,step,first_criterion,first_material,first_interface,first_mean_pressure,first_error,first_reached,first_below";
        let page = said(&format!(
            "{head},yield_of_material_1_mean_pressure,yield_of_material_1_error,yield_of_material_1_reached\n\
             1,1,done,1,yield,1,,20,2,under load,,20,2,under load\n\
             2,2,done,1,delamination,,1,7,0.5,under load,,30,,under load\n\
             3,3,done,1,delamination,,1,,,by a contact of a few samples,3,,,under load\n\
             4,4,failed,,,,,,,,,,,\n"
        ));
        for words in [
            "delamination of interface 1 in 2 of 3 combinations, yield of material 1 in 1.",
            "The first limit (a mean pressure) lies between 7.0 ± 0.5 MPa (a = 2) and 20 ± 2 MPa (a = 1); in 1 combination the \
             first limit is known only to lie below 3.0000 MPa.",
            ">30.000 MPa<",
        ] {
            assert!(page.contains(words), "no {words}: {page}");
        }
    }

    #[test]
    fn what_the_errors_leave_open_is_told() {
        let head = "combination,set_a,status,step,first_criterion,first_material,first_mean_pressure,first_error,first_reached,first_rivals,yield_of_material_1_reached";
        let page = said(&format!(
            "{head}\n1,1,done,1,yield,1,20,2,under load,cracking of material 1; yield of material 2,under load\n\
             2,2,done,1,yield,1,7,0.5,under load,,under load\n"
        ));
        assert!(
            page.contains("yield of material 1 in all of them; in 1 combination the errors leave open which."),
            "{page}"
        );
    }

    #[test]
    fn loads_are_summed_up_by_the_last_peak_pressures() {
        let page = said(
            "combination,set_a,status,step,max_pressure,errors_max_pressure,contact_fraction\n\
             1,1,done,1,900,1,0.1\n1,1,done,2,100,1,0.2\n2,2,done,1,90,1,0.1\n2,2,done,2,200,20,0.25\n3,3,failed,,,,\n",
        );
        let words = "The peak pressure lies between 100 ± 1 MPa (a = 1) and 200 ± 20 MPa (a = 2) in the last load step";
        assert!(page.contains(words) && page.contains(">25.00 %<"), "{page}");
    }
}

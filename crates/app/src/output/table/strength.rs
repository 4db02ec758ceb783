//! Tables of the utilisations of load steps, and of limit loads.

use super::by_step::{Quantity, QuantityInStep, by_step, place};
use super::{Table, Worded};
use crate::output::number::{in_unit, number, with_error};
use percoat_case::units::{Prefixed, Unit, Units};
use percoat_core::body::Bodies;
use percoat_core::measured::Measured;
use percoat_core::reading::{Criterion, UTILISATION, Utilisation, Verdict};
use percoat_core::run::{At, Limit, Limits, StepRecord};

/// Table of the utilisations, one row a criterion, the one that governs the last step first; `None` without strengths. With a
/// half-space the words name a criterion that residual stress alone reaches.
pub fn utilisations(steps: &[StepRecord], bodies: Option<&Bodies>, units: &Units) -> Option<Worded> {
    let last = steps.iter().rev().find(|step| !step.strength.is_empty())?;
    let mut governing: Vec<&Utilisation> = last.strength.iter().collect();
    governing.sort_by(|a, b| b.value.total_cmp(&a.value));
    let row = |&Utilisation { criterion, .. }: &Utilisation| {
        let of = |step: &StepRecord| {
            let taken = step.utilisation(criterion)?;
            Some(QuantityInStep {
                measured: UTILISATION.value.of(taken)?,
                position: taken.position,
                rival: taken.rival,
            })
        };
        Quantity { name: criterion.to_string(), found: steps.iter().map(of).collect() }
    };
    let rows: Vec<Quantity> = governing.into_iter().map(row).collect();
    let table = by_step(UTILISATION.value.named.name, (&Unit::None, in_unit), units, steps, &rows)?;
    Some(Worded { words: in_words(steps, bodies, units)?, table })
}

/// The criterion that fails first, within the load steps and errors, else the one nearest to failing. Its load lies between the
/// last step in which nothing fails for certain and the first in which one fails by more than its error; without the former,
/// at or below the latter.
fn in_words(steps: &[StepRecord], bodies: Option<&Bodies>, units: &Units) -> Option<String> {
    let (quantity, symbol) = (units.quantity(), units.quantity().symbol());
    let at_rest = |bodies| Criterion::all(bodies).into_iter().find(|criterion| criterion.at_rest(bodies) >= 1.0);
    if let Some(criterion) = bodies.and_then(at_rest) {
        return Some(format!("first: {criterion}, without load, by residual stress alone"));
    }
    let taken = || {
        steps
            .iter()
            .flat_map(|step| step.strength.iter().map(move |utilisation| (step.reading.load(quantity), utilisation)))
    };
    // One prefix for all loads of the sentence.
    let unit = units.load().suited(steps.iter().map(|step| step.reading.load(quantity)));
    let told = |load: f64| unit.with_unit(load, number);
    let least = |loads: &mut dyn Iterator<Item = f64>| loads.min_by(f64::total_cmp);
    let fails =
        least(&mut taken().filter(|(_, utilisation)| utilisation.verdict == Verdict::Fails).map(|(load, _)| load));
    let Some(above) = fails else {
        let open = taken().any(|(_, utilisation)| utilisation.verdict == Verdict::Undecided);
        // The step with the largest utilisation.
        let reach = |step: &&StepRecord| step.strength.iter().map(Utilisation::most).fold(0.0, f64::max);
        let with_strength = steps.iter().filter(|step| !step.strength.is_empty());
        let step = with_strength.max_by(|a, b| reach(a).total_cmp(&reach(b)))?;
        let words = step.governing_in_words(with_error)?;
        let begins = if open { "undecided by the errors whether anything fails" } else { "nothing fails" };
        return Some(format!("{begins}: at {symbol} = {} {words}", told(step.reading.load(quantity))));
    };
    // Every criterion that may fail up to there may be the first, also between the steps; the one of least load, and at that
    // load of largest value, is named first.
    let may = |load: f64, utilisation: &Utilisation| load <= above && utilisation.verdict != Verdict::Holds;
    let mut first: Vec<(f64, &Utilisation)> = taken().filter(|(load, utilisation)| may(*load, utilisation)).collect();
    let open = least(&mut first.iter().map(|(load, _)| *load)).unwrap_or(above);
    let rank = |(load, utilisation): &(f64, &Utilisation)| {
        (if utilisation.value >= 1.0 { *load } else { f64::INFINITY }, -utilisation.value)
    };
    first.sort_by(|a, b| rank(a).0.total_cmp(&rank(b).0).then(rank(a).1.total_cmp(&rank(b).1)));
    let mut names: Vec<String> = Vec::new();
    for (_, utilisation) in first {
        let name = utilisation.criterion.to_string();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let undecided = if names.len() > 1 { ", undecided which," } else { "" };
    // No step of a lesser load fails.
    let loads = steps.iter().map(|step| step.reading.load(quantity));
    let below = loads.filter(|&load| 0.0 < load && load < open).max_by(f64::total_cmp);
    let first = format!("first: {}{undecided}", names.join(" or "));
    Some(match below {
        Some(below) => format!("{first} between {symbol} = {} and {}", told(below), told(above)),
        None => format!("{first} at or below {symbol} = {}", told(above)),
    })
}

/// The interval of a limit; open at an unknown end.
fn range(unit: &Prefixed, [from, to]: [f64; 2]) -> String {
    let shown = |load: f64| number(unit.shown(load));
    match (from > 0.0, to.is_finite()) {
        (true, true) => format!("{} … {}", shown(from), shown(to)),
        (true, false) => format!("from {}", shown(from)),
        (false, true) => format!("up to {}", shown(to)),
        (false, false) => "any load".to_owned(),
    }
}

/// Table of the limit loads, the first limit in the first row.
pub fn limits(limits: &Limits, units: &Units) -> Worded {
    let loads = limits.limits.iter().map(|limit| match limit.at {
        At::Never { up_to, .. } | At::Undecided { up_to, .. } => up_to,
        _ => limit.load(),
    });
    let places = limits.limits.iter().filter_map(Limit::position).flatten();
    let (load_unit, length) = (units.load().suited(loads), units.length().suited(places));
    let place = |position: [f64; 3]| place(&length, position);
    let most = |utilisation: f64, error: Option<f64>, at: f64| {
        let utilisation = with_error(utilisation, error);
        format!(
            "has the utilisation {utilisation} at {} = {}",
            limits.quantity.symbol(),
            load_unit.with_unit(at, number)
        )
    };
    let row = |limit: &&Limit| {
        let (load, place) = match limit.at {
            At::Rest => ("0".to_owned(), "by residual stress alone".to_owned()),
            At::Tip { position } => ("0".to_owned(), format!("{}, a tip", place(position))),
            At::Load { load, error, interval: [from, to], position } => {
                let range = || format!("{} ({})", number(load_unit.shown(load)), range(&load_unit, [from, to]));
                let shown = if limit.is_sharp() { in_unit(&load_unit, Measured::new(load, error)) } else { range() };
                (shown, place(position))
            }
            At::Below { load, position, .. } => (
                format!("< {}", number(load_unit.shown(load))),
                format!("{}, a contact of a few samples", place(position)),
            ),
            At::Never { up_to, utilisation, error, at, .. } => {
                (format!("> {}", number(load_unit.shown(up_to))), most(utilisation, error, at))
            }
            At::Undecided { from, utilisation, error, at, .. } => {
                let range = range(&load_unit, [from, f64::INFINITY]);
                (format!("undecided ({range})"), most(utilisation, error, at))
            }
        };
        vec![limit.criterion.to_string(), load, place]
    };
    let rows = limits.ordered().iter().map(row).collect();
    let header = ["criterion".to_owned(), load_unit.headed(limits.quantity.name()), length.headed("place (x, y, z)")];
    let words = limits.in_words(|load| load_unit.with_unit(load, number));
    Worded { words, table: Table::new(&header, rows, 1) }
}

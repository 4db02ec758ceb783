//! What materials and interfaces bear: utilisations of the load steps, and limit loads.

use super::by_step::{Found, Row, by_step, place};
use super::{Table, Worded, in_unit};
use crate::body::HalfSpace;
use crate::output::number::number;
use crate::reading::{Criterion, Utilisation};
use crate::run::{At, Limit, Limits, StepRecord};
use crate::units::{Unit, Units};

/// The utilisations of the load steps, one row a criterion, what governs the last one first; `None` without any. What
/// residual stress alone breaks is told where the half-space is known.
pub fn utilisations(steps: &[StepRecord], half_space: Option<&HalfSpace>, units: &Units) -> Option<Worded> {
    let last = steps.iter().rev().find(|step| !step.strength.is_empty())?;
    let mut governing: Vec<&Utilisation> = last.strength.iter().collect();
    governing.sort_by(|a, b| b.value.total_cmp(&a.value));
    let row = |&Utilisation { criterion, .. }: &Utilisation| {
        let of = |step: &StepRecord| {
            let &Utilisation { value, error, position, rival, .. } = step.utilisation(criterion)?;
            Some(Found { value, error, position, rival })
        };
        Row { name: criterion.to_string(), found: steps.iter().map(of).collect() }
    };
    let rows: Vec<Row> = governing.into_iter().map(row).collect();
    let table = by_step("utilisation", &Unit::None, units, steps, &rows)?;
    Some(Worded { words: in_words(steps, half_space, units)?, table })
}

/// What fails first as far as the load steps tell, else what comes nearest at any. The load at which it does lies between them.
fn in_words(steps: &[StepRecord], half_space: Option<&HalfSpace>, units: &Units) -> Option<String> {
    let at_rest = |body| Criterion::all(body).into_iter().find(|own| own.at_rest(body) >= 1.0);
    if let Some(criterion) = half_space.and_then(at_rest) {
        return Some(format!("first: {criterion}, without load, by residual stress alone"));
    }
    let taken = || steps.iter().flat_map(|step| step.strength.iter().map(move |own| (step.reading.mean_pressure, own)));
    let fails = taken()
        .filter(|(_, own)| own.value >= 1.0)
        .min_by(|(p, a), (q, b)| p.total_cmp(q).then(b.value.total_cmp(&a.value)));
    let Some((above, Utilisation { criterion, .. })) = fails else {
        let (_, Utilisation { criterion, .. }) = taken().max_by(|(_, a), (_, b)| a.value.total_cmp(&b.value))?;
        return Some(format!("{criterion} governs"));
    };
    // Every step of a lesser load holds.
    let loads = steps.iter().map(|step| step.reading.mean_pressure);
    let below = loads.filter(|&load| 0.0 < load && load < above).max_by(f64::total_cmp);
    let told = |pressure: f64| units.pressure().told(pressure, number);
    Some(match below {
        Some(below) => format!("first: {criterion} between p̄ = {} and {}", told(below), told(above)),
        None => format!("first: {criterion} at or below p̄ = {}", told(above)),
    })
}

/// The limit loads, the first of them first.
pub fn limits(limits: &Limits, units: &Units) -> Worded {
    let pressures = limits.limits.iter().map(|limit| match limit.at {
        At::Never { up_to, .. } => up_to,
        _ => limit.mean_pressure(),
    });
    let places = limits.limits.iter().filter_map(Limit::position).flatten();
    let (pressure, length) = (units.pressure().suited(pressures), units.length().suited(places));
    let place = |position: [f64; 3]| place(&length, position);
    let row = |limit: &&Limit| {
        let (pressure, place) = match limit.at {
            At::Rest => ("0".to_owned(), "by residual stress alone".to_owned()),
            At::Tip { position } => ("0".to_owned(), format!("{}, a tip", place(position))),
            At::Load { mean_pressure, error, position } => (in_unit(&pressure, mean_pressure, error), place(position)),
            At::Below { mean_pressure, position, .. } => (
                format!("< {}", number(pressure.shown(mean_pressure))),
                format!("{}, a contact of a few samples", place(position)),
            ),
            At::Never { up_to, utilisation, at } => {
                let most = format!("takes up {} at p̄ = {}", number(utilisation), units.pressure().told(at, number));
                (format!("> {}", number(pressure.shown(up_to))), most)
            }
        };
        vec![limit.criterion.to_string(), pressure, place]
    };
    let rows = limits.ordered().iter().map(row).collect();
    let header = ["criterion".to_owned(), pressure.headed("mean pressure"), length.headed("place (x, y, z)")];
    let words = limits.in_words(|x| units.pressure().told(x, number));
    Worded { words, table: Table::new(&header, rows, 1) }
}

//! What materials and interfaces bear: utilisations of the load steps, and limit loads.

use super::render;
use crate::output::number::{number, with_error};
use crate::reading::Utilisation;
use crate::run::{At, Limit, Limits, StepRecord};

/// The utilisations of the load steps, one row a criterion, what governs first; `None` without any.
pub fn utilisations(steps: &[StepRecord]) -> Option<String> {
    let last = steps.iter().rev().find(|step| !step.strength.is_empty())?;
    let mut governing: Vec<&Utilisation> = last.strength.iter().collect();
    governing.sort_by(|a, b| b.value.total_cmp(&a.value));
    let shown: Vec<&StepRecord> = if steps.len() <= super::DETAILED { steps.iter().collect() } else { vec![last] };
    let mut header = vec!["utilisation".to_owned()];
    header.extend(shown.iter().map(|step| format!("p̄ = {}", number(step.reading.mean_pressure))));
    let place_of = if shown.len() > 1 { "place (x, y, z) in the last" } else { "place (x, y, z)" };
    header.push(place_of.to_owned());
    let row = |utilisation: &&Utilisation| {
        let of = |step: &&StepRecord| {
            let own = step.strength.iter().find(|own| own.criterion == utilisation.criterion);
            own.map_or("–".to_owned(), |own| value(own.value, own.error))
        };
        let mut row = vec![utilisation.criterion.to_string()];
        row.extend(shown.iter().map(of));
        row.push(place(utilisation.position));
        row
    };
    let rows: Vec<Vec<String>> = governing.iter().map(row).collect();
    let taken = || steps.iter().flat_map(|step| step.strength.iter().map(move |own| (step.reading.mean_pressure, own)));
    // The least load at which anything fails, else what comes nearest at any.
    let fails = taken()
        .filter(|(_, own)| own.value >= 1.0)
        .min_by(|(p, a), (q, b)| p.total_cmp(q).then(b.value.total_cmp(&a.value)));
    let words = match fails {
        Some((pressure, own)) => format!("{} fails at p̄ = {}", own.criterion, number(pressure)),
        None => format!("{} governs", taken().max_by(|(_, a), (_, b)| a.value.total_cmp(&b.value))?.1.criterion),
    };
    Some(format!("{words}\n\n{}", render(&header, &rows, 1)))
}

/// The limit loads, the first of them first.
pub fn limits(limits: &Limits) -> String {
    let row = |limit: &&Limit| {
        let (pressure, place) = match limit.at {
            At::Rest => ("0".to_owned(), "by residual stress alone".to_owned()),
            At::Tip { position } => ("0".to_owned(), format!("{}, a tip", place(position))),
            At::Load { mean_pressure, error, position } => (with_error(mean_pressure, error), place(position)),
            At::Below { mean_pressure, position, .. } => {
                (format!("< {}", number(mean_pressure)), format!("{}, a contact of a few samples", place(position)))
            }
            At::Never { up_to, utilisation } => {
                (format!("> {}", number(up_to)), format!("takes up {} there", number(utilisation)))
            }
        };
        vec![limit.criterion.to_string(), pressure, place]
    };
    let rows: Vec<Vec<String>> = limits.ordered().iter().map(row).collect();
    format!("{limits}\n\n{}", render(&["criterion", "mean pressure", "place (x, y, z)"], &rows, 1))
}

fn value(value: f64, error: Option<f64>) -> String {
    if value.is_infinite() { "singular".to_owned() } else { with_error(value, error) }
}

fn place([x, y, z]: [f64; 3]) -> String {
    // A place is not known to a millionth of itself.
    let size = x.abs().max(y.abs()).max(z.abs());
    let plain = |v: f64| if v.abs() < 1e-6 * size { "0".to_owned() } else { number(v) };
    format!("({}, {}, {})", plain(x), plain(y), plain(z))
}

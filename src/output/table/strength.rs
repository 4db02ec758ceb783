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
    header.push("place (x, y, z)".to_owned());
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
    let worst = governing.first()?;
    let words = if worst.value >= 1.0 { "fails" } else { "governs" };
    Some(format!("{} {words}\n\n{}", worst.criterion, render(&header, &rows, 1)))
}

/// The limit loads, the first of them first.
pub fn limits(limits: &Limits) -> String {
    let mut ordered: Vec<&Limit> = limits.limits.iter().collect();
    ordered.sort_by(|a, b| a.mean_pressure().total_cmp(&b.mean_pressure()));
    let row = |limit: &&Limit| {
        let (pressure, place) = match limit.at {
            At::Rest => ("0".to_owned(), "by residual stress alone".to_owned()),
            At::Tip { position } => ("0".to_owned(), format!("{}, a tip", place(position))),
            At::Load { mean_pressure, error, position } => (with_error(mean_pressure, error), place(position)),
            At::Below { mean_pressure, position } => {
                (format!("< {}", number(mean_pressure)), format!("{}, a contact of a few samples", place(position)))
            }
            At::Never { up_to, utilisation } => {
                ("never".to_owned(), format!("utilisation {} at {}", number(utilisation), number(up_to)))
            }
        };
        vec![limit.criterion.to_string(), pressure, place]
    };
    let rows: Vec<Vec<String>> = ordered.iter().map(row).collect();
    format!("{limits}\n\n{}", render(&["criterion", "mean pressure", "place (x, y, z)"], &rows, 1))
}

fn value(value: f64, error: Option<f64>) -> String {
    if value.is_infinite() { "singular".to_owned() } else { with_error(value, error) }
}

fn place([x, y, z]: [f64; 3]) -> String {
    // Beside a cell a part of 1e-9 of it is zero.
    let size = x.abs().max(y.abs()).max(z.abs());
    let plain = |v: f64| if v.abs() < 1e-9 * size { "0".to_owned() } else { number(v) };
    format!("({}, {}, {})", plain(x), plain(y), plain(z))
}

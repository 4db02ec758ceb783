//! How finely a run was resolved, and what that leaves open.

use super::markup::{Markup, tag, with};
use super::table::pairs;
use crate::output::table::{largest_errors, solved};
use percoat_case::words::Words;
use percoat_core::numeric::search::largest;
use percoat_core::reading::FEW_SAMPLES;
use percoat_core::run::StepRecord;

/// Grid, samples along a contact radius and estimated errors; `change`: relative change from the next coarser grid.
pub(super) fn resolution(steps: &[StepRecord], change: Option<f64>) -> Markup {
    let mut rows: Vec<(&str, Markup)> = Vec::new();
    if let Some(step) = steps.last() {
        let [n1, n2] = step.points;
        let of = Words::of(step.kind()).around.samples;
        rows.push((of, format!("{n1} × {n2}").into()));
    }
    let touching = |index: usize| {
        let levels = steps.iter().filter_map(move |step| step.reading.levels.get(index));
        levels.filter(|level| level.touches()).map(|level| level.resolution)
    };
    let levels = steps.iter().map(|step| step.reading.levels.len()).max().unwrap_or(0);
    let mut texts: Vec<String> = (0..levels)
        .filter_map(|index| {
            let least = touching(index).reduce(f64::min)?;
            let most = largest(touching(index));
            let range = if least < most { format!("{least:.1} to {most:.1}") } else { format!("{most:.1}") };
            Some(if levels > 1 { format!("level {}: {range}", index + 1) } else { range })
        })
        .collect();
    if levels == 0 {
        let spots = steps.iter().map(|step| step.reading.spot_resolution).filter(|&samples| samples > 0.0);
        texts.extend(spots.reduce(f64::min).map(|least| format!("typical spot: {least:.1} at least")));
    }
    if !texts.is_empty() {
        let items: Markup = texts.into_iter().map(|text| tag("li", text)).collect();
        let few = tag("li", format!("below {FEW_SAMPLES} radii and peak pressures are rough"));
        rows.push(("samples along a contact radius", with("ul", &[("class", "plain")], vec![items, few])));
    }
    if let Some(change) = change {
        rows.push(("change from the next coarser grid", format!("{change:.1e}").into()));
    }
    let mut parts = vec![pairs("The grid", &rows), tag("p", upper(&solved(steps)))];
    parts.extend(largest_errors(steps).map(|errors| tag("p", upper(&errors))));
    parts.into()
}

/// A text as a sentence: capital letter, full stop.
pub(super) fn upper(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

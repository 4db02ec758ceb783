//! Utilisations over the load.

use super::snapshot::caption;
use crate::picture::labels::Labels;
use percoat_case::units::Units;
use percoat_core::load::LoadQuantity;
use percoat_core::problem::Problem;
use percoat_core::reading::{Criterion, Utilisation};
use percoat_core::run::{At, Limit, Limits, StepRecord};
use percoat_draw::axis::Axis;
use percoat_draw::canvas::Canvas;
use percoat_draw::chart::{Chart, plots};
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::error_bars::MOST_MARKERS;
use percoat_draw::number::short;

/// Text of captions on the error bars of curves.
pub(super) const BARS: &str = "Bars and bands: estimated errors of the grid; open: the error exceeds half of the value; no line leads \
                               through points that differ by less than their errors.";
/// Number of colours of numbered lines.
const COLOURS: usize = 6;

/// The picture; `None` where less than two loads were solved.
pub fn utilisations(title: &str, problem: &Problem, units: &Units, limits: &Limits) -> Option<Canvas> {
    let loads = || limits.steps.iter().map(|step| step.reading.load(limits.quantity));
    let (least, most) = (loads().next()?, loads().next_back()?);
    if least == most {
        return None;
    }
    let criteria: Vec<Criterion> = limits.limits.iter().map(|limit| limit.criterion).collect();
    let mut curves = utilisation_curves(&limits.steps, limits.quantity, criteria.iter().copied());
    for (index, limit) in limits.limits.iter().enumerate() {
        curves.extend(limit_marks(limit, drawn(limit.criterion, index, &criteria).1, most));
    }
    let x = Axis::log(units.load_of("")).from_to(least / 1.1, most * 1.1);
    let chart = Chart { title: String::new(), x, y: utilisation_axis(&limits.steps), curves };
    let [n1, n2] = limits.steps[0].points;
    let more = [limits.in_words(|load| units.load().with_unit(load, short)), format!("{n1}\u{a0}×\u{a0}{n2} samples")];
    let marks = "On the line of failure: the limit loads and the loads between which they lie by their errors.";
    Some(plots(&format!("{} {BARS} {marks}", caption(title, problem, units, &more)), &[chart]))
}

/// A limit load on the line of failure, with the loads between which it lies by its error, at most up to `most`.
fn limit_marks(limit: &Limit, colour: Ink, most: f64) -> Vec<Curve> {
    let At::Load { load, interval: [from, to], .. } = limit.at else { return Vec::new() };
    let curve =
        |points: Vec<[f64; 2]>, style: Style| Curve { label: String::new(), points, errors: Vec::new(), style, colour };
    let from = if from > 0.0 { from } else { 1e-3 * load };
    vec![curve(vec![[from, 1.0], [to.min(1.1 * most), 1.0]], Style::Line), curve(vec![[load, 1.0]], Style::Markers)]
}

/// Axis of utilisations, from a hundredth on at least, since smaller ones do not matter. Error bars extend it up to ten times the
/// largest value.
pub(super) fn utilisation_axis(steps: &[StepRecord]) -> Axis {
    let all = || steps.iter().flat_map(|step| &step.strength);
    let values = all().map(|utilisation| utilisation.value).filter(|value| value.is_finite() && *value > 0.0);
    let (least, most) = values.fold((1.0f64, 1.0f64), |(least, most), value| (least.min(value), most.max(value)));
    let reach = all().map(Utilisation::most).filter(|most| most.is_finite()).fold(most, f64::max);
    Axis::log("utilisation").from_to(least.max(0.01) / 1.2, reach.min(10.0 * most) * 1.2)
}

/// A curve for each criterion with its errors, and the line of failure. Utilisations that are zero or infinite have no place on a
/// logarithmic axis.
pub(super) fn utilisation_curves(
    steps: &[StepRecord],
    quantity: LoadQuantity,
    criteria: impl IntoIterator<Item = Criterion>,
) -> Vec<Curve> {
    let curve = |criterion: Criterion| {
        let point = |step: &StepRecord| {
            let value = step.utilisation(criterion).map(|utilisation| utilisation.value);
            [step.reading.load(quantity), value.filter(|value| value.is_finite()).unwrap_or(f64::NAN)]
        };
        let error = |step: &StepRecord| {
            step.utilisation(criterion).and_then(|utilisation| utilisation.error).unwrap_or(f64::NAN)
        };
        (steps.iter().map(point).collect(), steps.iter().map(error).collect())
    };
    let criteria: Vec<Criterion> = criteria.into_iter().collect();
    let curves = criteria.iter().enumerate().map(|(index, &criterion)| {
        let (style, colour) = drawn(criterion, index, &criteria);
        let (points, errors) = curve(criterion);
        // Markers show the steps of short paths.
        let is_short = style == Style::Line && steps.len() <= MOST_MARKERS;
        let style = if is_short { Style::LineMarkers } else { style };
        Curve { label: criterion.to_string(), points, errors, style, colour }
    });
    let loads = steps.iter().map(|step| step.reading.load(quantity)).filter(|load| *load > 0.0);
    let (least, most) = loads.fold((f64::INFINITY, 0.0f64), |(least, most), p| (least.min(p), most.max(p)));
    let failure = Curve {
        label: "failure".to_owned(),
        points: vec![[least / 1.1, 1.0], [most * 1.1, 1.0]],
        errors: Vec::new(),
        style: Style::Dashed,
        colour: 0.into(),
    };
    curves.chain([failure]).collect()
}

/// Style and colour of a criterion: solid lines in the order of the criteria, or, for more criteria than colours, styles by the kind
/// of failure and colours by depth, those of the counterbody behind those of the body.
fn drawn(criterion: Criterion, index: usize, all: &[Criterion]) -> (Style, Ink) {
    let place = |criterion: &Criterion| match *criterion {
        Criterion::Yield(material)
        | Criterion::Cracking(material)
        | Criterion::StrainLife(material)
        | Criterion::Crossland(material)
        | Criterion::DangVan(material) => (material.is_counterbody(), material.number),
        Criterion::Delamination(interface) => (interface.is_counterbody(), interface.number),
    };
    let body = all.iter().map(place).filter(|(above, _)| !above).map(|(_, number)| number).max().unwrap_or(0);
    let depth = |criterion: &Criterion| match place(criterion) {
        (false, number) => number,
        (true, number) => body + number,
    };
    if all.len() <= COLOURS {
        return (Style::Line, Ink::Number(index + 1));
    }
    let style = match criterion {
        Criterion::Yield(_) | Criterion::StrainLife(_) => Style::Line,
        Criterion::Cracking(_) | Criterion::Crossland(_) => Style::Thin,
        Criterion::Delamination(_) | Criterion::DangVan(_) => Style::Dotted,
    };
    let deepest = all.iter().map(depth).max().unwrap_or(1);
    (style, Ink::by_depth(depth(&criterion) - 1, deepest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_core::body::{MaterialId, Side};

    #[test]
    fn no_two_of_many_criteria_of_two_bodies_are_drawn_alike() {
        let ids = [Side::Body, Side::Counterbody].into_iter().flat_map(|side| {
            (1..=3).map(move |number| MaterialId { side: Some(side), ..MaterialId::numbered(number) })
        });
        let all: Vec<Criterion> = ids.flat_map(|id| [Criterion::Yield(id), Criterion::Cracking(id)]).collect();
        let drawn: Vec<(Style, Ink)> =
            all.iter().enumerate().map(|(index, &criterion)| drawn(criterion, index, &all)).collect();
        for (index, pair) in drawn.iter().enumerate() {
            assert!(!drawn[..index].contains(pair), "{}: {pair:?}", all[index]);
        }
    }
}

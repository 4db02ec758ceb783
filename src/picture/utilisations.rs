//! Utilisation against load: what fails first.

use super::axis::Axis;
use super::canvas::Canvas;
use super::chart::{Chart, plots};
use super::curve::{Curve, Style};
use super::number::short;
use super::snapshot::caption;
use crate::problem::Problem;
use crate::reading::Criterion;
use crate::run::{Limits, StepRecord};
use crate::units::Units;

/// The picture; `None` where less than two loads were solved.
pub fn utilisations(title: &str, problem: &Problem, units: &Units, limits: &Limits) -> Option<Canvas> {
    let loads = || limits.steps.iter().map(|step| step.reading.mean_pressure);
    let (least, most) = (loads().next()?, loads().next_back()?);
    if least == most {
        return None;
    }
    let curves = utilisation_curves(&limits.steps, limits.limits.iter().map(|limit| limit.criterion));
    let x = Axis::log(units.pressure_of("mean pressure", "p̄")).from_to(least / 1.1, most * 1.1);
    let chart = Chart { title: String::new(), x, y: utilisation_axis(&limits.steps), curves };
    let [n1, n2] = limits.steps[0].points;
    let more =
        [limits.in_words(|pressure| units.pressure().told(pressure, short)), format!("{n1}\u{a0}×\u{a0}{n2} samples")];
    Some(plots(&caption(title, problem, units, &more), &[chart]))
}

/// From a hundredth on at least: what takes up less is as good as nothing.
pub(super) fn utilisation_axis(steps: &[StepRecord]) -> Axis {
    let values = steps.iter().flat_map(|step| &step.strength).map(|own| own.value);
    let values = values.filter(|value| value.is_finite() && *value > 0.0);
    let (least, most) = values.fold((1.0f64, 1.0f64), |(least, most), value| (least.min(value), most.max(value)));
    Axis::log("utilisation").from_to(least.max(0.01) / 1.2, most * 1.2)
}

/// A curve for each criterion, and where it fails. What is zero or infinite has no place on a logarithmic axis.
pub(super) fn utilisation_curves(steps: &[StepRecord], criteria: impl IntoIterator<Item = Criterion>) -> Vec<Curve> {
    let curve = |criterion: Criterion| {
        let point = |step: &StepRecord| {
            let own = step.utilisation(criterion).map(|own| own.value);
            [step.reading.mean_pressure, own.filter(|value| value.is_finite() && *value > 0.0).unwrap_or(f64::NAN)]
        };
        steps.iter().map(point).collect()
    };
    let own = (1..).zip(criteria).map(|(colour, criterion)| Curve {
        label: criterion.to_string(),
        points: curve(criterion),
        style: Style::Line,
        colour,
    });
    let loads = steps.iter().map(|step| step.reading.mean_pressure).filter(|pressure| *pressure > 0.0);
    let (least, most) = loads.fold((f64::INFINITY, 0.0f64), |(least, most), p| (least.min(p), most.max(p)));
    let failure = Curve {
        label: "failure".to_owned(),
        points: vec![[least / 1.1, 1.0], [most * 1.1, 1.0]],
        style: Style::Dashed,
        colour: 0,
    };
    own.chain([failure]).collect()
}

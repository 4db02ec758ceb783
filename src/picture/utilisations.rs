//! Utilisation against load: what fails first.

use super::axis::Axis;
use super::canvas::Canvas;
use super::chart::{Chart, plots};
use super::curve::{Curve, Style};
use super::snapshot::caption;
use super::units::Units;
use crate::problem::Problem;
use crate::reading::Criterion;
use crate::run::{Limits, StepRecord};

/// The picture; `None` where less than two loads were solved.
pub fn utilisations(title: &str, problem: &Problem, limits: &Limits) -> Option<Canvas> {
    let loads = || limits.steps.iter().map(|step| step.reading.mean_pressure);
    let (least, most) = (loads().next()?, loads().last()?);
    if limits.steps.len() < 2 {
        return None;
    }
    let units = Units::of(problem);
    let value = |criterion: Criterion| {
        move |step: &StepRecord| {
            let own = step.strength.iter().find(|own| own.criterion == criterion).map(|own| own.value);
            [step.reading.mean_pressure, own.filter(|value| value.is_finite() && *value > 0.0).unwrap_or(f64::NAN)]
        }
    };
    let mut curves: Vec<Curve> = (1..)
        .zip(&limits.limits)
        .map(|(colour, limit)| Curve {
            label: limit.criterion.to_string(),
            points: limits.steps.iter().map(value(limit.criterion)).collect(),
            style: Style::LineMarkers,
            colour,
        })
        .collect();
    curves.push(Curve {
        label: "failure".to_owned(),
        points: vec![[least / 1.1, 1.0], [most * 1.1, 1.0]],
        style: Style::Dashed,
        colour: 0,
    });
    let x = Axis::log(units.pressure("mean pressure", "p̄")).from_to(least / 1.1, most * 1.1);
    let chart = Chart { title: String::new(), x, y: Axis::log("utilisation"), curves };
    let [n1, n2] = limits.steps[0].points;
    let more = [limits.to_string(), format!("{n1}\u{a0}×\u{a0}{n2} samples")];
    Some(plots(&caption(title, problem, &more), &[chart]))
}

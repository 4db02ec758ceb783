//! Curves over one key of a sweep.

use super::keys::{Keys, number, scale};
use super::numbers::Number;
use crate::picture::labels::Labels;
use crate::sweep::Row;
use percoat_case::units::Units;
use percoat_core::measured::Measured;
use percoat_core::run::StepRecord;
use percoat_draw::axis::Axis;
use percoat_draw::chart::Chart;
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::error_bars::MOST_MARKERS;
use percoat_draw::label::Label;
use std::collections::{BTreeMap, HashMap};

/// Curves in a chart, at most.
const CURVES: usize = 12;
/// Curves that have colours of their own; more are coloured in their order.
const COLOURS: usize = 6;

/// A curve that is being gathered.
struct SweepCurve {
    label: String,
    /// The load of all its points with its unit, where it is one within the digits shown.
    load: Option<String>,
    /// Points (x, y) and the error of y.
    points: Vec<([f64; 2], f64)>,
}

impl Keys {
    /// A curve for each set of the other keys, or for each load step where there are no others, as many as are distinguishable; and
    /// the number of all.
    pub fn chart(&self, rows: &[Row], shown: &Number, units: &Units) -> (Chart, usize) {
        let (index, values) = &self.along;
        let mut curves: BTreeMap<usize, SweepCurve> = BTreeMap::new();
        let mut order: HashMap<String, usize> = HashMap::new();
        for row in rows {
            let others = row.settings.iter().zip(&self.names).enumerate().filter(|(at, _)| at != index);
            let setting = |(_, ((_, value), name)): (usize, (&(String, String), &Label))| match value.parse() {
                Ok(number) => name.equals(number),
                Err(_) => format!("{}\u{a0}=\u{a0}{value}", name.text()),
            };
            let label = others.map(setting).collect::<Vec<_>>().join(", ");
            let next = order.len();
            let at = *order.entry(label.clone()).or_insert(next);
            let Some(x) = number(row, *index) else { continue };
            // Load steps have curves of their own where nothing else has.
            let steps = if self.names.len() == 1 { row.results.len() } else { 1 };
            for (step, result) in row.results.iter().enumerate().skip(row.results.len() - steps.min(row.results.len()))
            {
                let load = |step: &StepRecord| units.load_equals(&[step.reading.load(units.quantity())]);
                let load = result.step().filter(|_| steps > 1).map(load);
                let (place, label) = if steps > 1 { (step, format!("step {}", step + 1)) } else { (at, label.clone()) };
                let begun = || SweepCurve { label, load: load.clone(), points: Vec::new() };
                let curve = curves.entry(place).or_insert_with(begun);
                // A step whose load differs between rows is labelled by its number.
                curve.load.take_if(|common| Some(&*common) != load.as_ref());
                let found = shown.measured(result).unwrap_or(Measured::exact(f64::NAN));
                curve.points.push(([x, found.value], found.error.unwrap_or(f64::NAN)));
            }
        }
        let all = curves.len();
        let drawn: Vec<_> = curves.into_iter().step_by(one_in(all)).collect();
        let count = drawn.len();
        let colour = |index: usize| match count {
            0..=COLOURS => Ink::Number(index + 1),
            _ => Ink::Depth(index as f64 / (count - 1) as f64),
        };
        let curves = drawn.into_iter().enumerate().map(|(index, (_, SweepCurve { label, load, mut points }))| {
            let label = load.unwrap_or(label);
            points.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
            let style = if points.len() <= MOST_MARKERS { Style::LineMarkers } else { Style::Line };
            let (points, errors) = points.into_iter().unzip();
            Curve { label, points, errors, style, colour: colour(index) }
        });
        let x = Axis { scale: scale(values), ..Axis::linear(self.names[*index].clone()) };
        let label = shown.quantity.clone();
        let y = if shown.is_passes() { Axis::log(label) } else { Axis::linear(label) };
        (Chart { title: String::new(), x, y, curves: curves.collect() }, all)
    }
}

/// Step of the curves that are drawn, so that at most [`CURVES`] are.
pub fn one_in(curves: usize) -> usize {
    curves.div_ceil(CURVES).max(1)
}

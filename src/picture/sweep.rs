//! What changes with the settings of a sweep: curves over one key, or maps over two.

use super::axis::{Axis, Scale, log_spaced};
use super::bar::Bar;
use super::canvas::Canvas;
use super::chart::{Chart, plots};
use super::colour::ColourMap;
use super::curve::{Curve, Ink, Style};
use super::map::{Fill, Map};
use super::number::short;
use super::quantity::Quantity;
use super::sheet::{Panel, sheet};
use crate::sweep::Row;
use crate::units::Units;
use serde_json::Value;
use std::collections::BTreeMap;

/// Curves in a chart, at most.
const CURVES: usize = 6;
/// Maps in a picture, at most.
const MAPS: usize = 4;
/// Values of a key from which on two of them make a map.
const SIDE: usize = 3;

/// The picture; `None` where no key has several numbers, or nothing came out.
pub fn sweep(title: &str, units: &Units, rows: &[Row]) -> Option<Canvas> {
    let keys = Keys::of(rows)?;
    let numbers = numbers(units, rows);
    if numbers.is_empty() {
        return None;
    }
    let failed = rows.iter().filter(|row| row.results.is_empty()).count();
    let steps = rows.iter().map(|row| row.results.len()).max().unwrap_or(0);
    let mut words = vec![title.trim_end_matches('.').to_owned(), format!("{} combinations", rows.len())];
    words.retain(|words| !words.is_empty());
    if failed > 0 {
        words.push(format!("{failed} failed"));
    }
    if keys.pair.is_some() {
        words.extend((steps > 1).then(|| "the last load step of each".to_owned()));
        let caption = words.join("; ") + ".";
        return keys.maps(rows, &numbers, &caption);
    }
    let charts: Vec<Chart> = numbers.iter().map(|own| keys.chart(rows, own)).collect();
    Some(plots(&(words.join("; ") + "."), &charts))
}

/// Where a number of a result stands.
type Place = Box<dyn Fn(&Value) -> Option<f64> + Sync>;

/// A number of a result.
struct Number {
    quantity: Quantity,
    value: Place,
}

impl Number {
    fn at(quantity: impl Into<Quantity>, pointer: &'static str) -> Self {
        Self { quantity: quantity.into(), value: Box::new(move |result| result.pointer(pointer)?.as_f64()) }
    }

    /// The largest of a list.
    fn largest(quantity: impl Into<Quantity>, list: &'static str, pointer: &'static str) -> Self {
        let value = move |result: &Value| {
            let items = result.pointer(list)?.as_array()?.iter();
            items.filter_map(|item| item.pointer(pointer)?.as_f64()).reduce(f64::max)
        };
        Self { quantity: quantity.into(), value: Box::new(value) }
    }
}

/// The numbers that the rows have.
fn numbers(units: &Units, rows: &[Row]) -> Vec<Number> {
    let limits = |result: &Value| -> Vec<String> {
        let names = result.as_object().into_iter().flatten().map(|(name, _)| name.clone());
        names.filter(|name| result.get("first").is_some() && name != "first").collect()
    };
    let mut all = vec![
        Number::at(units.pressure_of("first limit, mean pressure", "p̄"), "/first/mean_pressure"),
        Number::at(units.pressure_of("peak pressure", "p"), "/max_pressure"),
        Number::at(units.length_of("penetration", "δ"), "/penetration"),
        Number::at("fraction in contact", "/contact_fraction"),
        Number::largest("largest utilisation", "/strength", "/utilisation"),
        Number::largest(units.pressure_of("largest shear stress", "τ₁"), "/stress/materials", "/max_tau1/value"),
    ];
    for name in rows.iter().flat_map(|row| &row.results).next().map(limits).unwrap_or_default() {
        let quantity = units.pressure_of(&format!("{}, mean pressure", name.replace('_', " ")), "p̄");
        let value = move |result: &Value| result.get(&name)?.get("mean_pressure")?.as_f64();
        all.push(Number { quantity, value: Box::new(value) });
    }
    let is_there = |number: &Number| {
        rows.iter().filter_map(|row| row.results.last()).any(|result| (number.value)(result).is_some())
    };
    all.retain(is_there);
    all
}

/// The keys of a sweep as a picture has them.
struct Keys {
    /// Index and values of the one with most numbers.
    along: (usize, Vec<f64>),
    /// Those of a second one, where both are all that changes and every pair is there.
    pair: Option<(usize, Vec<f64>)>,
    names: Vec<String>,
}

impl Keys {
    fn of(rows: &[Row]) -> Option<Self> {
        let names: Vec<String> = rows.first()?.settings.iter().map(|(key, _)| key.clone()).collect();
        let numbers = |index: usize| -> Vec<f64> {
            let values = rows.iter().map(|row| number(row, index)).collect::<Option<Vec<f64>>>();
            let mut values = values.unwrap_or_default();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        };
        let mut all: Vec<(usize, Vec<f64>)> = (0..names.len()).map(|index| (index, numbers(index))).collect();
        let is_pair = all.len() == 2 && all.iter().all(|(_, values)| values.len() >= SIDE);
        let is_full = is_pair && all.iter().map(|(_, values)| values.len()).product::<usize>() == rows.len();
        all.retain(|(_, values)| values.len() > 1);
        // The first of those with most values goes along.
        let longest = (0..all.len()).rev().max_by_key(|&at| all[at].1.len())?;
        let along = all.swap_remove(longest);
        let pair = all.pop().filter(|_| is_full);
        Some(Self { along, pair, names })
    }

    /// A curve for each set of the other keys, or for each load step where there are no others.
    fn chart(&self, rows: &[Row], shown: &Number) -> Chart {
        let (index, values) = &self.along;
        let mut curves: BTreeMap<(usize, String), Vec<[f64; 2]>> = BTreeMap::new();
        let mut order: Vec<String> = Vec::new();
        for row in rows {
            let others = row.settings.iter().enumerate().filter(|(at, _)| at != index);
            let label = others.map(|(_, (key, value))| format!("{} {value}", last(key))).collect::<Vec<_>>().join(", ");
            let at = order.iter().position(|own| *own == label).unwrap_or_else(|| {
                order.push(label.clone());
                order.len() - 1
            });
            let Some(x) = number(row, *index) else { continue };
            // Load steps have curves of their own where nothing else has.
            let steps = if self.names.len() == 1 { row.results.len() } else { 1 };
            for (step, result) in row.results.iter().enumerate().skip(row.results.len() - steps.min(row.results.len()))
            {
                let load = result.get("mean_pressure").and_then(Value::as_f64);
                let own = match load {
                    Some(load) if steps > 1 => (step, format!("p̄ = {}", short(load))),
                    _ => (at, label.clone()),
                };
                let value = (shown.value)(result).unwrap_or(f64::NAN);
                curves.entry(own).or_default().push([x, value]);
            }
        }
        let every = curves.len().div_ceil(CURVES).max(1);
        let curves = (1..).zip(curves.into_iter().step_by(every)).map(|(colour, ((_, label), mut points))| {
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let style = if points.len() <= 25 { Style::LineMarkers } else { Style::Line };
            Curve { label, points, style, colour: Ink::Number(colour) }
        });
        let x = Axis { scale: scale(values), ..Axis::linear(&self.names[*index][..]) };
        Chart { title: String::new(), x, y: Axis::linear(shown.quantity.clone()), curves: curves.collect() }
    }

    /// A map for each of the first numbers.
    fn maps(&self, rows: &[Row], numbers: &[Number], caption: &str) -> Option<Canvas> {
        let (along, up) = (&self.along, self.pair.as_ref()?);
        let fields: Vec<Vec<Option<f64>>> = numbers
            .iter()
            .take(MAPS)
            .map(|shown| {
                let mut field = vec![None; along.1.len() * up.1.len()];
                for row in rows {
                    let place = |(index, values): &(usize, Vec<f64>)| {
                        let own = number(row, *index)?;
                        values.iter().position(|value| *value == own)
                    };
                    if let (Some(i), Some(j)) = (place(along), place(up)) {
                        let value = row.results.last().and_then(|result| (shown.value)(result));
                        field[j * along.1.len() + i] = value.filter(|value| value.is_finite());
                    }
                }
                field
            })
            .collect();
        let [x, y] = [along, up].map(|(_, values)| Cells::new(values));
        let lookups: Vec<_> = fields
            .iter()
            .map(|field| {
                let columns = along.1.len();
                let (x, y) = (&x, &y);
                move |[u, v]: [f64; 2]| field[y.at(v) * columns + x.at(u)]
            })
            .collect();
        let maps: Vec<Map> = numbers
            .iter()
            .zip(&fields)
            .zip(&lookups)
            .map(|((shown, field), value)| {
                let values = || field.iter().copied().flatten();
                let span = [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)];
                let span = if span[0] < span[1] { span } else { [0.0, span[1].abs().max(1e-300)] };
                let bar = Bar { label: shown.quantity.clone(), colours: ColourMap::Sequential, span, apart: false };
                Map {
                    title: String::new(),
                    x: x.axis(&self.names[along.0]),
                    y: y.axis(&self.names[up.0]),
                    aspect: 0.8,
                    fill: Fill::Values(bar, value),
                    over: Vec::new(),
                }
            })
            .collect();
        let panels: Vec<&dyn Panel> = maps.iter().map(|map| map as &dyn Panel).collect();
        Some(sheet(caption, &panels))
    }
}

/// The cells of an axis around its values.
struct Cells {
    /// Borders, one more than values.
    borders: Vec<f64>,
    scale: Scale,
}

impl Cells {
    fn new(values: &[f64]) -> Self {
        let scale = scale(values);
        let is_log = scale == Scale::Log;
        let back = |place: f64| if is_log { place.exp() } else { place };
        let spread: Vec<f64> = values.iter().map(|&value| if is_log { value.ln() } else { value }).collect();
        let inner = spread.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let (n, half) = (spread.len(), |a: usize, b: usize| 0.5 * (spread[b] - spread[a]));
        let (first, last) = (spread[0] - half(0, 1), spread[n - 1] + half(n - 2, n - 1));
        Self { borders: [first].into_iter().chain(inner).chain([last]).map(back).collect(), scale }
    }

    fn at(&self, place: f64) -> usize {
        self.borders[1..].partition_point(|border| *border < place).min(self.borders.len() - 2)
    }

    fn axis(&self, label: &str) -> Axis {
        let range = Some([self.borders[0], self.borders[self.borders.len() - 1]]);
        Axis { range, scale: self.scale, ..Axis::linear(label) }
    }
}

fn scale(values: &[f64]) -> Scale {
    if log_spaced(values) { Scale::Log } else { Scale::Linear }
}

/// The value of a key, if it is a number.
fn number(row: &Row, index: usize) -> Option<f64> {
    row.settings.get(index)?.1.parse::<f64>().ok().filter(|value| value.is_finite())
}

/// The last part of a key.
fn last(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

#[cfg(test)]
mod tests {
    use super::super::vector::svg;
    use super::*;
    use crate::sweep::Status;
    use serde_json::json;

    fn row(combination: usize, settings: &[(&str, String)], results: Vec<Value>) -> Row {
        Row {
            combination,
            settings: settings.iter().map(|(key, value)| ((*key).to_owned(), value.clone())).collect(),
            fingerprint: String::new(),
            status: Status::Done,
            reason: None,
            warnings: Vec::new(),
            results,
            seconds: 0.0,
        }
    }

    fn step(value: f64) -> Value {
        json!({ "mean_pressure": 0.1, "max_pressure": value, "penetration": value, "contact_fraction": 0.5 })
    }

    #[test]
    fn one_key_has_curves_two_have_maps_and_a_text_has_none() {
        let values = [0.1, 0.2, 0.3];
        let one: Vec<Row> =
            (1..).zip(values).map(|(n, x)| row(n, &[("layers.0.thickness", x.to_string())], vec![step(x)])).collect();
        let keys = Keys::of(&one).unwrap();
        assert!(keys.pair.is_none());
        assert_eq!(
            keys.chart(&one, &numbers(&Units::unknown(), &one)[0]).curves[0].points,
            [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]
        );
        let pairs = values.iter().flat_map(|x| values.map(|y| [*x, y]));
        let two: Vec<Row> = (1..)
            .zip(pairs)
            .map(|(n, [x, y])| row(n, &[("a", x.to_string()), ("b", y.to_string())], vec![step(x + y)]))
            .collect();
        assert!(Keys::of(&two).unwrap().pair.is_some());
        assert!(Keys::of(&two[1..]).unwrap().pair.is_none(), "a pair is missing");
        let text = svg(&sweep("A title", &Units::unknown(), &two).unwrap());
        assert!(text.contains("peak pressure") && text.contains("9 combinations"));
        let words = [row(1, &[("a", "bonded".into())], vec![step(1.0)]), row(2, &[("a", "x".into())], vec![step(2.0)])];
        assert!(sweep("", &Units::unknown(), &words).is_none());
    }

    #[test]
    fn what_failed_leaves_a_gap_and_others_have_curves_of_their_own() {
        let mut rows: Vec<Row> = (0..8)
            .map(|n| {
                let settings = [("x", (n / 2).to_string()), ("kind", ["soft", "hard"][n % 2].to_owned())];
                row(n + 1, &settings, vec![step(n as f64)])
            })
            .collect();
        rows[2].results.clear();
        let keys = Keys::of(&rows).unwrap();
        let chart = keys.chart(&rows, &numbers(&Units::unknown(), &rows)[0]);
        let labels: Vec<&str> = chart.curves.iter().map(|curve| &curve.label[..]).collect();
        assert_eq!(labels, ["kind soft", "kind hard"]);
        assert_eq!(chart.curves[0].points, [[0.0, 0.0], [2.0, 4.0], [3.0, 6.0]]);
    }

    #[test]
    fn a_map_over_a_logarithmic_key_has_cells_of_one_width() {
        let cells = Cells::new(&[0.01, 0.1, 1.0, 10.0]);
        let [low, high] = cells.axis("").range.unwrap();
        let quarter = |part: f64| cells.at(cells.scale.between(low, high, part));
        assert_eq!([0.01, 0.24, 0.26, 0.49, 0.51, 0.74, 0.76, 0.99].map(quarter), [0, 0, 1, 1, 2, 2, 3, 3]);
    }

    #[test]
    fn cells_reach_half_way_to_their_neighbours() {
        let cells = Cells::new(&[1.0, 10.0, 100.0]);
        assert_eq!(cells.scale, Scale::Log);
        assert_eq!([0.5, 2.0, 4.0, 30.0, 1e4].map(|x| cells.at(x)), [0, 0, 1, 1, 2]);
        let cells = Cells::new(&[0.0, 1.0, 3.0]);
        assert_eq!([cells.at(0.4), cells.at(0.6), cells.at(1.9), cells.at(2.1)], [0, 1, 1, 2]);
    }
}

//! Maps over two keys of a sweep.

use super::first::{NamedMap, colour};
use super::keys::{Keys, number, scale};
use super::numbers::{Bound, Number};
use crate::sweep::{Foremost, Row, SweepResult};
use percoat_draw::axis::Axis;
use percoat_draw::bar::Bar;
use percoat_draw::canvas::{Canvas, Dash, Stroke};
use percoat_draw::colour::Colour;
use percoat_draw::label::Label;
use percoat_draw::map::{Fill, Map, Over};
use percoat_draw::scale::Scale;
use percoat_draw::sheet::{Panel, sheet};
use std::collections::BTreeMap;

/// Numbers of more than this ratio have a logarithmic bar.
const WIDE: f64 = 20.0;

/// Lines over a cell in which nothing fails, in parts of its sides: one pattern with those of its neighbours.
const DIAGONALS: [[[f64; 2]; 2]; 3] = [[[0.0, 0.0], [1.0, 1.0]], [[0.0, 0.5], [0.5, 1.0]], [[0.5, 0.0], [1.0, 0.5]]];
/// Width of such a line, and of that between what fails and what does not, points.
const HATCH: f64 = 0.4;
const FRONTIER: f64 = 1.4;

/// A value of each cell, the first key fastest; `None` where a combination has none.
type MapValues<T> = Vec<Option<T>>;

/// Words over the cells of a map, with their colours.
type Signs = MapValues<(&'static str, Colour)>;

impl Keys {
    /// A map of what comes first where limits are searched for, and one for each number.
    pub fn maps(&self, rows: &[Row], numbers: &[Number], caption: &str) -> Option<Canvas> {
        let plane = Plane::new(self)?;
        let counted = Foremost::counted(rows.iter().filter_map(|row| row.results.last()));
        let coloured = |(index, (first, _)): (usize, &(Foremost, usize))| (*first, colour(*first, index));
        let colours: BTreeMap<Foremost, Colour> = counted.iter().enumerate().map(coloured).collect();
        let firsts = self.field(rows, |result| colours.get(&result.foremost()?).copied());
        let first = |place: [f64; 2]| firsts[plane.cell(place)].unwrap_or(Colour::PALE);
        let undecided = self.field(rows, |result| (!result.rivals().is_empty()).then_some("?"));
        let question = |(word, first): (Option<_>, &Option<_>)| Some((word?, ink(first.unwrap_or(Colour::PALE))));
        let questions = undecided.into_iter().zip(&firsts).map(question).collect();
        let holds = self.field(rows, SweepResult::holds);
        let of_loads = rows.iter().filter_map(|row| row.results.last()).all(|result| result.step().is_some());
        let what = if of_loads { "what governs" } else { "what comes first" };
        let names = counted.iter().map(|(first, count)| (colours[first], format!("{first} ({count})")));
        let first = (!counted.is_empty()).then(|| NamedMap {
            map: plane
                .map(format!("{what} (in how many combinations)"), Fill::Colours(&first), questions)
                .under(plane.holding(&holds)),
            names: names.collect(),
        });
        let finite = |shown: &Number| self.field(rows, |result| shown.value(result).filter(|value| value.is_finite()));
        let fields: Vec<MapValues<f64>> = numbers.iter().map(finite).collect();
        let lookups: Vec<_> = fields.iter().map(|field| |place: [f64; 2]| field[plane.cell(place)]).collect();
        let maps = numbers.iter().zip(&fields).zip(&lookups).map(|((shown, field), value)| {
            let bar = bar(shown, &field.iter().copied().flatten().collect::<Vec<_>>());
            let signs = self.signs(rows, shown, field, &bar);
            plane.map(shown.quantity.text().to_owned(), Fill::Values(bar, value), signs)
        });
        let maps: Vec<Map> = maps.collect();
        let panels = first.iter().map(|first| first as &dyn Panel).chain(maps.iter().map(|map| map as &dyn Panel));
        let hatched = if holds.contains(&Some(true)) { " Hatched: nothing fails." } else { "" };
        Some(sheet(&format!("{caption}{hatched}"), &panels.collect::<Vec<_>>()))
    }

    /// The words over a map of numbers: the bound where there is no number, 0 where a logarithmic bar has no place for it, and a
    /// question mark where the errors leave it open.
    fn signs(&self, rows: &[Row], shown: &Number, field: &[Option<f64>], bar: &Bar) -> Signs {
        let bounds = self.field(rows, |result| shown.bound(result));
        let doubts = self.field(rows, |result| shown.is_undecided(result).then_some(()));
        let table = bar.colours.table();
        let sign = |((value, bound), doubt): ((&Option<f64>, Option<Bound>), Option<()>)| match (value, bound) {
            (None, Some(Bound::Below)) => Some(("<", Colour::BLACK)),
            (None, Some(Bound::Above)) => Some((">", Colour::BLACK)),
            (None, Some(Bound::Undecided)) => Some(("?", Colour::BLACK)),
            (Some(0.0), _) if bar.scale == Scale::Log => Some(("0", Colour::WHITE)),
            (Some(value), _) => doubt.map(|()| ("?", ink(bar.colour(&table, *value)))),
            _ => None,
        };
        field.iter().zip(bounds).zip(doubts).map(sign).collect()
    }

    /// Values of the last results of the rows, cell by cell: first the lowest row.
    fn field<T: Copy>(&self, rows: &[Row], value: impl Fn(&SweepResult) -> Option<T>) -> MapValues<T> {
        let Some(up) = &self.pair else { return Vec::new() };
        let mut field = vec![None; self.along.1.len() * up.1.len()];
        for row in rows {
            let place = |(index, values): &(usize, Vec<f64>)| {
                let given = number(row, *index)?;
                values.iter().position(|value| *value == given)
            };
            if let (Some(i), Some(j)) = (place(&self.along), place(up)) {
                field[j * self.along.1.len() + i] = row.results.last().and_then(&value);
            }
        }
        field
    }
}

/// Black or white, whichever is seen on a colour.
fn ink(ground: Colour) -> Colour {
    if ground.lightness() > 0.6 { Colour::BLACK } else { Colour::WHITE }
}

/// The bar of a map whose title has the words: logarithmic where most of a linear one would be of one colour.
fn bar(shown: &Number, values: &[f64]) -> Bar {
    let least = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::INFINITY, f64::min);
    let low = least(&mut values.iter().copied());
    let positive = least(&mut values.iter().copied().filter(|value| *value > 0.0));
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let label = shown.quantity.wordless();
    // A value of 0 has the colour of the least that is not, and a word.
    if low >= 0.0 && high > WIDE * positive {
        return Bar {
            span: [positive, high],
            scale: Scale::Log,
            without: Colour::PALE,
            ..Bar::sequential(label, high)
        };
    }
    let span = if low < high { [low, high] } else { [0.0, high.abs().max(1e-300)] };
    Bar { span, without: Colour::PALE, ..Bar::sequential(label, high) }
}

/// The cells over two keys.
struct Plane<'a> {
    axes: [AxisCells; 2],
    names: [&'a Label; 2],
}

impl<'a> Plane<'a> {
    fn new(keys: &'a Keys) -> Option<Self> {
        let both = [&keys.along, keys.pair.as_ref()?];
        Some(Self {
            axes: both.map(|(_, values)| AxisCells::new(values)),
            names: both.map(|(index, _)| &keys.names[*index]),
        })
    }

    /// Index of the cell around a place, the first key fastest.
    fn cell(&self, [u, v]: [f64; 2]) -> usize {
        let [x, y] = &self.axes;
        y.at(v) * x.values.len() + x.at(u)
    }

    /// Hatches over the cells in which nothing fails, and lines of utilisation 1 between them and the others.
    fn holding(&self, holds: &[Option<bool>]) -> Vec<Over> {
        let [x, y] = &self.axes;
        let columns = x.values.len();
        let is = |i: usize, j: usize| holds.get(j * columns + i).copied().flatten();
        let line = |points: Vec<[f64; 2]>, width: f64| {
            Over::Line(Stroke { points, width, dash: Dash::Solid, colour: Colour::BLACK })
        };
        let mut over = Vec::new();
        for (j, i) in (0..y.values.len()).flat_map(|j| (0..columns).map(move |i| (j, i))) {
            let [(left, right), (low, high)] = [x.ends(i), y.ends(j)];
            if is(i, j) == Some(true) {
                let place = |[s, t]: [f64; 2]| [x.scale.between(left, right, s), y.scale.between(low, high, t)];
                over.extend(DIAGONALS.map(|ends| line(ends.map(place).to_vec(), HATCH)));
            }
            let differs = |other: Option<bool>| is(i, j).zip(other).is_some_and(|(here, there)| here != there);
            if i + 1 < columns && differs(is(i + 1, j)) {
                over.push(line(vec![[right, low], [right, high]], FRONTIER));
            }
            if differs(is(i, j + 1)) {
                over.push(line(vec![[left, high], [right, high]], FRONTIER));
            }
        }
        over
    }

    /// A map with words over its cells.
    fn map<'b>(&self, title: String, fill: Fill<'b>, signs: Signs) -> Map<'b> {
        let ([x, y], [along, up]) = (&self.axes, self.names);
        let word = |(at, sign): (usize, Option<(&str, Colour)>)| {
            let (word, colour) = sign?;
            let at = [x.values[at % x.values.len()], y.values[at / x.values.len()]];
            Some(Over::Word { word: word.to_owned(), at, colour })
        };
        let over = signs.into_iter().enumerate().filter_map(word).collect();
        Map { title, x: x.axis(along.clone()), y: y.axis(up.clone()), aspect: 0.8, fill, over }
    }
}

/// The cells of an axis around its values.
struct AxisCells {
    /// Values of the key, one in each cell.
    values: Vec<f64>,
    /// Borders, one more than values.
    borders: Vec<f64>,
    scale: Scale,
}

impl AxisCells {
    fn new(values: &[f64]) -> Self {
        let scale = scale(values);
        let is_log = scale == Scale::Log;
        let back = |place: f64| if is_log { place.exp() } else { place };
        let spread: Vec<f64> = values.iter().map(|&value| if is_log { value.ln() } else { value }).collect();
        let inner = spread.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let (n, half) = (spread.len(), |a: usize, b: usize| 0.5 * (spread[b] - spread[a]));
        let (first, last) = (spread[0] - half(0, 1), spread[n - 1] + half(n - 2, n - 1));
        Self {
            borders: [first].into_iter().chain(inner).chain([last]).map(back).collect(),
            scale,
            values: values.to_vec(),
        }
    }

    /// Borders of a cell.
    fn ends(&self, cell: usize) -> (f64, f64) {
        (self.borders[cell], self.borders[cell + 1])
    }

    fn at(&self, place: f64) -> usize {
        self.borders[1..].partition_point(|border| *border < place).min(self.borders.len() - 2)
    }

    fn axis(&self, label: impl Into<Label>) -> Axis {
        let range = Some([self.borders[0], self.borders[self.borders.len() - 1]]);
        Axis { range, scale: self.scale, ..Axis::linear(label) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_over_a_logarithmic_key_has_cells_of_one_width() {
        let cells = AxisCells::new(&[0.01, 0.1, 1.0, 10.0]);
        let [low, high] = cells.axis("").range.unwrap();
        let quarter = |part: f64| cells.at(cells.scale.between(low, high, part));
        assert_eq!([0.01, 0.24, 0.26, 0.49, 0.51, 0.74, 0.76, 0.99].map(quarter), [0, 0, 1, 1, 2, 2, 3, 3]);
    }

    #[test]
    fn what_holds_is_hatched_and_parted_by_lines_from_what_fails() {
        let label = Label::from("");
        let plane = Plane { axes: [0, 1].map(|_| AxisCells::new(&[1.0, 2.0])), names: [&label, &label] };
        let over = plane.holding(&[Some(true), Some(false), Some(false), None]);
        let lines = |width: f64| -> Vec<Vec<[f64; 2]>> {
            let of = |over: &Over| match over {
                Over::Line(stroke) if stroke.width == width => Some(stroke.points.clone()),
                _ => None,
            };
            over.iter().filter_map(of).collect()
        };
        // The cell from 0.5 to 1.5 along both.
        assert_eq!(lines(HATCH)[0], [[0.5, 0.5], [1.5, 1.5]]);
        assert_eq!(lines(FRONTIER), [[[1.5, 0.5], [1.5, 1.5]], [[0.5, 1.5], [1.5, 1.5]]]);
        assert_eq!(over.len(), 5);
        assert!(plane.holding(&[None; 4]).is_empty());
    }

    #[test]
    fn cells_reach_half_way_to_their_neighbours() {
        let cells = AxisCells::new(&[1.0, 10.0, 100.0]);
        assert_eq!(cells.scale, Scale::Log);
        assert_eq!([0.5, 2.0, 4.0, 30.0, 1e4].map(|x| cells.at(x)), [0, 0, 1, 1, 2]);
        let cells = AxisCells::new(&[0.0, 1.0, 3.0]);
        assert_eq!([cells.at(0.4), cells.at(0.6), cells.at(1.9), cells.at(2.1)], [0, 1, 1, 2]);
    }
}

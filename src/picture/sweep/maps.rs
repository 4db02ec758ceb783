//! Maps over two keys of a sweep.

use super::super::axis::Axis;
use super::super::bar::Bar;
use super::super::canvas::Canvas;
use super::super::colour::ColourMap;
use super::super::map::{Fill, Map};
use super::super::scale::Scale;
use super::super::sheet::{Panel, sheet};
use super::keys::{Keys, number, scale};
use super::numbers::Number;
use crate::sweep::Row;

impl Keys {
    /// A map for each number.
    pub fn maps(&self, rows: &[Row], numbers: &[Number], caption: &str) -> Option<Canvas> {
        let (along, up) = (&self.along, self.pair.as_ref()?);
        let fields: Vec<Vec<Option<f64>>> = numbers
            .iter()
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

#[cfg(test)]
mod tests {
    use super::*;

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

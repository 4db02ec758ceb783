//! Colour bars: the values of the colours of a field.

use super::canvas::{Anchor, Canvas, PIXELS};
use super::colour::{Colour, ColourMap};
use super::frame::{all, factor, tick, widest};
use super::label::Label;
use super::number::short;
use super::scale::Scale;
use super::sheet::{HAIR, LABELS, NUMBERS};
use super::text;
use super::ticks::{Ticks, ticks};
use percoat_common::unit::Prefixed;

/// A colour bar.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// Label with the unit.
    pub label: Label,
    /// Colours from the least to the largest value.
    pub colours: ColourMap,
    /// Least and largest value shown. A diverging map is white at zero and as dark at −x as at x, unless the signs are
    /// apart.
    pub span: [f64; 2],
    /// Spacing of the values along the bar.
    pub scale: Scale,
    /// Whether both signs have scales of their own, each on half of the bar: see [`Bar::signed`].
    pub apart: bool,
    /// Colour of places without a value.
    pub without: Colour,
}

/// Width of a colour bar, points.
const BAR: f64 = 7.0;
/// Distance of a colour bar from the plot, points.
pub const GAP: f64 = 6.0;
/// Ratios of the extremes of both signs between which each has a scale of its own: the lesser one would be pale on a common scale.
const PALE: [f64; 2] = [0.01, 0.4];

impl Bar {
    /// Bar of values from zero to `most`.
    pub fn sequential(label: Label, most: f64) -> Self {
        Self {
            label,
            colours: ColourMap::Sequential,
            span: [0.0, most],
            scale: Scale::Linear,
            apart: false,
            without: Colour::WHITE,
        }
    }

    /// Bar of tension and compression, each with a scale of its own where one would be pale beside the other.
    pub fn signed(label: Label, [low, high]: [f64; 2]) -> Self {
        let ratio = (high / -low).min(-low / high);
        Self {
            label,
            colours: ColourMap::Diverging,
            span: [low, high],
            scale: Scale::Linear,
            apart: (PALE[0]..PALE[1]).contains(&ratio),
            without: Colour::WHITE,
        }
    }

    /// Place of a value on the bar, from 0 at the bottom to 1.
    fn place(&self, value: f64) -> f64 {
        let [low, high] = self.span;
        match (self.apart, value < 0.0) {
            (false, _) if self.scale == Scale::Log => (value / low).ln() / (high / low).ln(),
            (false, _) => (value - low) / (high - low),
            (true, true) => 0.5 - 0.5 * value / low,
            (true, false) => 0.5 + 0.5 * value / high,
        }
    }

    /// Value at a place from 0 to 1.
    fn value(&self, place: f64) -> f64 {
        let [low, high] = self.span;
        match (self.apart, place < 0.5) {
            (false, _) => self.scale.between(low, high, place),
            (true, true) => low * (1.0 - 2.0 * place),
            (true, false) => high * (2.0 * place - 1.0),
        }
    }

    /// Colour of a value, of a `table` of colours.
    pub fn colour(&self, table: &[Colour], value: f64) -> Colour {
        let [low, high] = self.span;
        let part = match self.colours {
            ColourMap::Diverging if !self.apart => 0.5 + 0.5 * value / low.abs().max(high.abs()),
            _ => self.place(value),
        };
        table[(part * 255.0).round().clamp(0.0, 255.0) as usize]
    }

    /// Ticks on a bar of a height in points, whose numbers do not overlap.
    pub fn ticks(&self, height: f64) -> Ticks {
        let span = |value: f64, _: &str| {
            let half = 0.5 * (text::CAPITALS + 0.25) * NUMBERS;
            Some([height * self.place(value) - half, height * self.place(value) + half])
        };
        let most = (2..=6).rev().map(|most| self.ticks_of(most));
        let fits = |ticks: &Ticks| ticks.clone().apart(span).numbered.len() == ticks.numbered.len();
        most.into_iter().find(fits).unwrap_or_else(|| self.ticks_of(2).apart(span))
    }

    fn unit(&self) -> Prefixed {
        let [low, high] = self.span.map(f64::abs);
        // The same number decides as on an axis.
        self.label.unit(if self.scale == Scale::Log { (low * high).sqrt() } else { low.max(high) })
    }

    fn ticks_of(&self, most: usize) -> Ticks {
        let unit = self.unit();
        let [low, high] = self.span.map(|end| unit.shown(end));
        if !self.apart {
            return ticks([low, high], self.scale, most).in_unit(&unit);
        }
        let halves = [[low, 0.0], [0.0, high]].map(|half| ticks(half, Scale::Linear, most.saturating_sub(1)));
        let mut numbered: Vec<(f64, String)> = halves.iter().flat_map(|half| half.numbered.clone()).collect();
        numbered.dedup_by(|a, b| a.0 == 0.0 && b.0 == 0.0);
        let exponent = halves[0].exponent.max(halves[1].exponent);
        for (value, number) in &mut numbered {
            *number = short(*value / 10f64.powi(exponent));
        }
        Ticks { numbered, plain: halves.into_iter().flat_map(|half| half.plain).collect(), exponent }.in_unit(&unit)
    }

    /// Width with its numbers, however many there are, and its quantity.
    pub fn width(&self) -> f64 {
        GAP + BAR + 4.0 + self.widest() + if self.name().is_empty() { 0.0 } else { 1.6 * LABELS }
    }

    /// Label with the unit.
    fn name(&self) -> String {
        self.label.label(&self.unit())
    }

    fn widest(&self) -> f64 {
        (2..=6).map(|most| widest(&self.ticks_of(most))).fold(0.0, f64::max)
    }

    /// The power of ten over the bar.
    pub fn factor(&self) -> Option<String> {
        factor(&self.ticks_of(6))
    }

    /// Draws the bar with its numbers to the right of a place.
    pub fn draw(&self, canvas: &mut Canvas, [x, top]: [f64; 2], height: f64) {
        let rows = (height * PIXELS).round() as usize;
        let columns = (BAR * PIXELS).round() as usize;
        let table = self.colours.table();
        let colour = |row: usize| self.colour(&table, self.value(1.0 - (row as f64 + 0.5) / rows as f64));
        let pixels = (0..rows).flat_map(|row| colour(row).0.repeat(columns)).collect();
        canvas.image([x, top], [BAR, height], [columns, rows], pixels);
        canvas.outline(&[[x, top], [x + BAR, top], [x + BAR, top + height], [x, top + height]], HAIR, Colour::BLACK);
        let ticks = self.ticks(height);
        for (value, number) in all(&ticks) {
            let y = top + height * (1.0 - self.place(value));
            tick(canvas, [x + BAR, y], [2.2, 0.0], number.is_some());
            if let Some(number) = number {
                canvas.label(number, [x + BAR + 4.0, y], Anchor::Left, NUMBERS, Colour::BLACK);
            }
        }
        if let Some(factor) = self.factor() {
            canvas.text(&factor, [x, top - 3.0], Anchor::Left, NUMBERS, Colour::BLACK);
        }
        let right = x + BAR + 4.0 + self.widest() + 1.35 * LABELS;
        canvas.upward(&self.name(), [right, top + 0.5 * height], LABELS, Colour::BLACK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_stand_apart_where_one_would_be_pale_and_places_lead_back_to_values() {
        let bar = |span: [f64; 2]| Bar::signed("".into(), span);
        for (span, apart) in [
            ([-1.0, 0.9], false),
            ([-1.0, 0.1], true),
            ([-0.1, 3.0], true),
            ([-1.0, 1e-4], false),
            ([-1.0, 0.0], false),
        ] {
            let bar = bar(span);
            assert_eq!(bar.apart, apart, "{span:?}");
            for place in [0.0, 0.2, 0.5, 0.9, 1.0] {
                assert!((bar.place(bar.value(place)) - place).abs() < 1e-12, "{span:?} {place}");
            }
            assert!(bar.ticks(150.0).numbered.len() > 3, "{span:?}: {:?}", bar.ticks(150.0));
            let zeros = bar.ticks(150.0).numbered.iter().filter(|(value, _)| *value == 0.0).count();
            assert_eq!(zeros, 1, "{span:?}");
        }
        let log = Bar { scale: Scale::Log, span: [1e-3, 0.1], ..Bar::sequential("".into(), 0.1) };
        assert!((log.place(1e-2) - 0.5).abs() < 1e-12 && (log.value(0.5) / 1e-2 - 1.0).abs() < 1e-12);
        let table = ColourMap::Diverging.table();
        let apart = bar([-10.0, 1.0]);
        assert_eq!([apart.colour(&table, 1.0), apart.colour(&table, -10.0)], [table[255], table[0]]);
    }
}

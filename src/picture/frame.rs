//! The frame of a plot: two axes with their ranges, numbers and quantities, and where a point stands between them.

use super::axis::{Axis, Scale, Ticks, power, ticks};
use super::canvas::{Anchor, Canvas};
use super::colour::Colour;
use super::sheet::{HAIR, LABELS, Margins, NUMBERS};
use super::text::{self, wrapped};

/// Length of a numbered tick, points.
const TICK: f64 = 3.0;
/// How far numbers stand away from a plot with outward ticks.
const BEYOND: f64 = 0.7 * TICK;
/// Most numbers on a vertical axis.
const MOST: usize = 6;

/// A frame, laid out relative to the upper left corner of its panel.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Quantities, line by line.
    labels: [Vec<String>; 2],
    scales: [Scale; 2],
    ranges: [[f64; 2]; 2],
    ticks: [Ticks; 2],
    /// Whether ticks point away from the plot, as over a field.
    outward: bool,
    /// Upper left corner of the plot.
    pub corner: [f64; 2],
    /// Width and height of the plot.
    pub size: [f64; 2],
    /// Height with numbers and quantities.
    pub height: f64,
}

impl Frame {
    /// Room that the axes x and y need over their ranges in a panel of the given width with `right` points beside the
    /// plot, which is `aspect` times as high as wide; `outward`: see the field.
    pub fn margins(
        axes: [&Axis; 2],
        ranges: [[f64; 2]; 2],
        [width, right]: [f64; 2],
        aspect: f64,
        outward: bool,
    ) -> Margins {
        let ticks = ticks(ranges[1], axes[1].scale, MOST);
        let beyond = if outward { BEYOND } else { 0.0 };
        let numbers = widest(&ticks) + 3.5 + beyond;
        let high = aspect * (width - 1.35 * LABELS - numbers - right);
        let lines = wrapped(&axes[1].label, LABELS, high).len().max(1) as f64;
        let top = if factor(&ticks).is_some() { 1.5 * NUMBERS } else { 0.6 * NUMBERS };
        Margins { left: (0.1 + 1.25 * lines) * LABELS + numbers, right, top }
    }

    /// A frame of the axes x and y over their ranges in a panel of the given width and margins.
    pub fn new(
        axes: [&Axis; 2],
        ranges: [[f64; 2]; 2],
        width: f64,
        Margins { left, right, top }: Margins,
        aspect: f64,
        outward: bool,
    ) -> Self {
        let wide = width - left - right;
        let x_ticks = {
            // As many numbers as stand apart.
            let fits = |most: &usize| {
                let numbers = ticks(ranges[0], axes[0].scale, *most).numbered;
                let all: f64 = numbers.iter().map(|(_, number)| text::width(number, NUMBERS) + NUMBERS).sum();
                all <= wide + NUMBERS
            };
            ticks(ranges[0], axes[0].scale, (2..=7).rev().find(fits).unwrap_or(2))
        };
        let high = aspect * wide;
        let beyond = if outward { BEYOND } else { 0.0 };
        Self {
            labels: [vec![axes[0].label.clone()], wrapped(&axes[1].label, LABELS, high)],
            scales: axes.map(|axis| axis.scale),
            ranges,
            ticks: [x_ticks, ticks(ranges[1], axes[1].scale, MOST)],
            outward,
            corner: [left, top],
            size: [wide, high],
            height: top + high + beyond + NUMBERS * 1.45 + LABELS * 1.5,
        }
    }

    /// Place of a point of the plot, if it has one.
    pub fn place(&self, point: [f64; 2]) -> Option<[f64; 2]> {
        let part = |k: usize| {
            let [first, last] = self.ranges[k];
            match self.scales[k] {
                Scale::Linear | Scale::Degrees => (point[k] - first) / (last - first),
                Scale::Log => (point[k] / first).ln() / (last / first).ln(),
            }
        };
        let place = [self.corner[0] + part(0) * self.size[0], self.corner[1] + (1.0 - part(1)) * self.size[1]];
        place.iter().all(|c| c.is_finite()).then_some(place)
    }

    /// Upper left and lower right corner of the plot when the panel's corner is at `origin`.
    pub fn bounds(&self, [ox, oy]: [f64; 2]) -> [[f64; 2]; 2] {
        let [left, top] = [ox + self.corner[0], oy + self.corner[1]];
        [[left, top], [left + self.size[0], top + self.size[1]]]
    }

    /// Draws the frame of a panel whose corner is at `origin`.
    pub fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2]) {
        let [[left, top], [right, bottom]] = self.bounds([ox, oy]);
        canvas.outline(&[[left, top], [right, top], [right, bottom], [left, bottom]], HAIR, Colour::BLACK);
        let at = |x: f64, y: f64| self.place([x, y]).map(|[x, y]| [ox + x, oy + y]);
        let [x_ticks, y_ticks] = &self.ticks;
        let [[x0, _], [y0, _]] = self.ranges;
        let sign = if self.outward { -1.0 } else { 1.0 };
        let (beyond, length) = (if self.outward { BEYOND } else { 0.0 }, sign * TICK);
        for (value, number) in all(x_ticks) {
            let Some([x, _]) = at(value, y0) else { continue };
            tick(canvas, [x, bottom], [0.0, -length], number.is_some());
            if !self.outward {
                tick(canvas, [x, top], [0.0, length], number.is_some());
            }
            if let Some(number) = number {
                canvas.text(number, [x, bottom + beyond + 1.25 * NUMBERS], Anchor::Centre, NUMBERS, Colour::BLACK);
            }
        }
        for (value, number) in all(y_ticks) {
            let Some([_, y]) = at(x0, value) else { continue };
            tick(canvas, [left, y], [length, 0.0], number.is_some());
            if !self.outward {
                tick(canvas, [right, y], [-length, 0.0], number.is_some());
            }
            if let Some(number) = number {
                canvas.label(number, [left - beyond - 3.0, y], Anchor::Right, NUMBERS, Colour::BLACK);
            }
        }
        let below = bottom + beyond + 1.45 * NUMBERS + 1.05 * LABELS;
        for label in &self.labels[0] {
            canvas.text(label, [0.5 * (left + right), below], Anchor::Centre, LABELS, Colour::BLACK);
        }
        // Next to the widest number of this axis.
        let nearest = left - beyond - 3.0 - widest(y_ticks) - 0.45 * LABELS;
        for (number, label) in (1..).zip(self.labels[1].iter().rev()) {
            let x = nearest - 1.2 * LABELS * f64::from(number - 1);
            canvas.upward(label, [x, 0.5 * (top + bottom)], LABELS, Colour::BLACK);
        }
        if let Some(factor) = factor(y_ticks) {
            canvas.text(&factor, [left - beyond - 1.0, top - 3.5], Anchor::Right, NUMBERS, Colour::BLACK);
        }
        if let Some(factor) = factor(x_ticks) {
            canvas.text(&factor, [right, below], Anchor::Right, NUMBERS, Colour::BLACK);
        }
    }

    /// Draws the line y = 0 across a plot that has values of both signs.
    pub fn draw_zero(&self, canvas: &mut Canvas, origin: [f64; 2]) {
        let [[left, _], [right, _]] = self.bounds(origin);
        let [first, last] = self.ranges[1];
        let crosses = self.scales[1] == Scale::Linear && first.min(last) < 0.0 && first.max(last) > 0.0;
        if let Some([_, y]) = self.place([self.ranges[0][0], 0.0]).filter(|_| crosses) {
            let y = origin[1] + y;
            canvas.line(&[[left, y], [right, y]], 0.6 * HAIR, Colour::GREY);
        }
    }
}

/// Draws a tick from a place on a border along `way`, a shorter one where it has no number.
pub fn tick(canvas: &mut Canvas, [x, y]: [f64; 2], [dx, dy]: [f64; 2], numbered: bool) {
    let part = if numbered { 1.0 } else { 0.55 };
    canvas.line(&[[x, y], [x + part * dx, y + part * dy]], HAIR, Colour::BLACK);
}

/// Numbered and plain ticks in one list.
pub fn all(ticks: &Ticks) -> impl Iterator<Item = (f64, Option<&str>)> {
    let numbered = ticks.numbered.iter().map(|(value, number)| (*value, Some(number.as_str())));
    numbered.chain(ticks.plain.iter().map(|&value| (value, None)))
}

/// Width of the widest number.
pub fn widest(ticks: &Ticks) -> f64 {
    ticks.numbered.iter().map(|(_, number)| text::width(number, NUMBERS)).fold(0.0, f64::max)
}

/// The power of ten that the numbers are to be multiplied by, if it is not one.
pub fn factor(ticks: &Ticks) -> Option<String> {
    (ticks.exponent != 0).then(|| format!("×{}", power(ticks.exponent)))
}

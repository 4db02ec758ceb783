//! The frame of a plot: two axes with their ranges, numbers and labels, and the place of a point between them.

use super::axis::Axis;
use super::canvas::{Anchor, Canvas, Dash};
use super::colour::Colour;
use super::number;
use super::scale::Scale;
use super::sheet::{HAIR, LABELS, Margins, NUMBERS};
use super::text::{self, wrapped};
use super::ticks::Ticks;

/// Length of a numbered tick, points.
const TICK: f64 = 3.0;
/// Distance of the numbers from a plot with outward ticks, points.
const BEYOND: f64 = 0.7 * TICK;
/// Largest number of numbers on a horizontal and on a vertical axis.
const MOST_NUMBERS: [usize; 2] = [7, 6];
/// Least distance of numbers beside and above each other, over their size.
const APART: [f64; 2] = [0.6, 0.25];

/// A frame, laid out relative to the upper left corner of its panel.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Labels, line by line.
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
    /// Height with numbers and labels, points.
    pub height: f64,
}

impl Frame {
    /// Margins that the axes x and y need over their ranges in a panel of a width with `right` points beside the plot, which is
    /// `aspect` times as high as wide, with ticks `outward` as over a field or inward.
    pub fn margins(
        axes: [&Axis; 2],
        ranges: [[f64; 2]; 2],
        [width, right]: [f64; 2],
        aspect: f64,
        outward: bool,
    ) -> Margins {
        // The widest number of all divisions: the height of the plot is not known yet.
        let all = |most: usize| axes[1].ticks(ranges[1], most);
        let widest = (2..=MOST_NUMBERS[1]).map(|most| widest(&all(most))).fold(0.0, f64::max);
        let beyond = if outward { BEYOND } else { 0.0 };
        let numbers = widest + 3.5 + beyond;
        let high = aspect * (width - 1.35 * LABELS - numbers - right);
        let lines = wrapped(&label(axes[1], ranges[1]), LABELS, high).len().max(1) as f64;
        let above = factor(&all(MOST_NUMBERS[1])).is_some() || !axes[0].marks.is_empty();
        let top = if above { 1.5 * NUMBERS } else { 0.6 * NUMBERS };
        Margins { left: (0.1 + 1.25 * lines) * LABELS + numbers, right, top }
    }

    /// Frame of the axes x and y over their ranges in a panel of a width and margins.
    pub fn new(
        axes: [&Axis; 2],
        ranges: [[f64; 2]; 2],
        width: f64,
        Margins { left, right, top }: Margins,
        aspect: f64,
        outward: bool,
    ) -> Self {
        let size = [width - left - right, aspect * (width - left - right)];
        let beyond = if outward { BEYOND } else { 0.0 };
        let mut frame = Self {
            labels: [vec![label(axes[0], ranges[0])], wrapped(&label(axes[1], ranges[1]), LABELS, size[1])],
            scales: axes.map(|axis| axis.scale),
            ranges,
            ticks: [0, 1].map(|k| axes[k].ticks(ranges[k], MOST_NUMBERS[k])),
            outward,
            corner: [left, top],
            size,
            height: top + size[1] + beyond + NUMBERS * 1.45 + LABELS * 1.5,
        };
        for k in 0..2 {
            // The most numbers that do not overlap; of two that overlap, one.
            let span = |value: f64, number: &str| frame.span(k, value, number);
            let ticks = (2..=MOST_NUMBERS[k]).rev().map(|most| axes[k].ticks(ranges[k], most));
            let fits = |ticks: &Ticks| ticks.clone().apart(span).numbered.len() == ticks.numbered.len();
            let ticks = ticks.into_iter().find(fits).unwrap_or_else(|| axes[k].ticks(ranges[k], 2).apart(span));
            frame.ticks[k] = ticks;
        }
        frame
    }

    /// Extent of a number along its axis (0: x, 1: y), with half of the least distance to the next on both sides; points.
    fn span(&self, axis: usize, value: f64, number: &str) -> Option<[f64; 2]> {
        let place = self.place([0, 1].map(|k| if k == axis { value } else { self.ranges[k][0] }))?;
        let extent = if axis == 0 { text::width(number, NUMBERS) } else { text::CAPITALS * NUMBERS };
        let half = 0.5 * (extent + APART[axis] * NUMBERS);
        Some([place[axis] - half, place[axis] + half])
    }

    /// Place of a point, relative to the panel; `None` for a point without a place, as a negative one on a logarithmic axis.
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
        let beside = factor(x_ticks).map_or(0.0, |factor| text::width(&factor, NUMBERS) + NUMBERS);
        for label in &self.labels[0] {
            let most = right - beside - 0.5 * text::width(label, LABELS);
            canvas.text(label, [most.min(0.5 * (left + right)), below], Anchor::Centre, LABELS, Colour::BLACK);
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

    /// Places of the marks of the horizontal axis within the plot.
    pub fn marks<'a>(&self, axis: &'a Axis) -> Vec<(f64, &'a str)> {
        let (left, right, y) = (self.corner[0], self.corner[0] + self.size[0], self.ranges[1][0]);
        let places = axis.marks.iter().filter_map(|(x, word)| Some((self.place([*x, y])?[0], word.as_str())));
        let mut places: Vec<(f64, &str)> = places.filter(|(x, _)| (left..=right).contains(x)).collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        places
    }

    /// Draws the marks of the horizontal axis with their words above the plot; the words of marks near each other are joined.
    pub fn draw_marks(&self, canvas: &mut Canvas, axis: &Axis, origin: [f64; 2]) {
        let [[left, top], [right, bottom]] = self.bounds(origin);
        let mut words: Vec<([f64; 2], String)> = Vec::new();
        for (x, word) in self.marks(axis) {
            canvas.dashed(&[[origin[0] + x, top], [origin[0] + x, bottom]], 0.7, Dash::Dotted, Colour::GREY);
            let width = text::width(word, NUMBERS) + NUMBERS;
            match words.last_mut() {
                Some(([_, last], joined)) if x - *last < width => {
                    *last = x;
                    joined.push_str(&format!(", {word}"));
                }
                _ => words.push(([x, x], word.to_owned())),
            }
        }
        for ([first, last], word) in words {
            // Not beyond the plot.
            let half = (0.5 * text::width(&word, NUMBERS)).min(0.49 * (right - left));
            let at = [(origin[0] + 0.5 * (first + last)).clamp(left + half, right - half), top - 2.5];
            canvas.text(&word, at, Anchor::Centre, NUMBERS, Colour::GREY);
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

/// Draws a tick from a place on a border along a vector, shorter where it has no number.
pub fn tick(canvas: &mut Canvas, [x, y]: [f64; 2], [dx, dy]: [f64; 2], numbered: bool) {
    let part = if numbered { 1.0 } else { 0.55 };
    canvas.line(&[[x, y], [x + part * dx, y + part * dy]], HAIR, Colour::BLACK);
}

/// All ticks, with the numbers of the numbered ones.
pub fn all(ticks: &Ticks) -> impl Iterator<Item = (f64, Option<&str>)> {
    let numbered = ticks.numbered.iter().map(|(value, number)| (*value, Some(number.as_str())));
    numbered.chain(ticks.plain.iter().map(|&value| (value, None)))
}

/// Width of the widest number, points.
pub fn widest(ticks: &Ticks) -> f64 {
    ticks.numbered.iter().map(|(_, number)| text::width(number, NUMBERS)).fold(0.0, f64::max)
}

/// The power of ten by which the numbers are multiplied; `None` for 1.
pub fn factor(ticks: &Ticks) -> Option<String> {
    (ticks.exponent != 0).then(|| number::factor(ticks.exponent))
}

/// Label of an axis over a range, with its unit.
fn label(axis: &Axis, range: [f64; 2]) -> String {
    axis.label.label(&axis.unit(range))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ranges of all lengths, from a tenth of a per cent to twelve decades, on plots of all shapes.
    #[test]
    fn no_two_numbers_of_an_axis_collide_and_most_axes_have_two() {
        for scale in [Scale::Linear, Scale::Log] {
            for (k, width) in (0..120).flat_map(|k| [90.0, 140.0, 230.0].map(|width| (k, width))) {
                let first = 10f64.powf(-9.0 + 0.37 * f64::from(k) % 17.0);
                let ratio = 10f64.powf(0.001 * 1.08f64.powi(k));
                let range = [first, first * ratio];
                let axis = Axis { scale, ..Axis::linear("p") };
                let aspect = 0.3 + 0.01 * f64::from(k);
                let margins = Frame::margins([&axis, &axis], [range; 2], [width, 6.0], aspect, false);
                let frame = Frame::new([&axis, &axis], [range; 2], width, margins, aspect, false);
                for (k, ticks) in frame.ticks.iter().enumerate() {
                    let mut spans: Vec<[f64; 2]> =
                        ticks.numbered.iter().filter_map(|(value, number)| frame.span(k, *value, number)).collect();
                    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
                    assert!(spans.windows(2).all(|pair| pair[0][1] <= pair[1][0]), "{range:?} {width}: {ticks:?}");
                    assert!(spans.len() > 1 || width < 200.0, "{range:?} {width}: {ticks:?}");
                }
            }
        }
    }
}

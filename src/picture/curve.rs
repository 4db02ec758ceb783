//! Curves of charts: points, errors, style and marker.

use super::canvas::{Anchor, Canvas, Dash};
use super::colour::Colour;
use super::sheet::NUMBERS;

/// A curve of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name in the legend; empty for a curve without an entry.
    pub label: String,
    /// Points (x, y); one that is not finite, or not positive on a logarithmic axis, interrupts the curve.
    pub points: Vec<[f64; 2]>,
    /// Error of y at each point, in its unit, drawn as a bar; NaN where none is known. Empty: the curve has none.
    ///
    /// The line is interrupted where it falls from one point to the next by less than both errors together: the numbers do not show
    /// such a fall. A point whose error exceeds half of its value has an open marker.
    pub errors: Vec<f64>,
    /// Style of line and markers.
    pub style: Style,
    /// Colour.
    pub colour: Ink,
}

/// The colour of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ink {
    /// By its index: 0 black, then 1 blue, 2 vermilion, 3 green, 4 purple, 5 orange, 6 sky blue, and again from 1.
    Number(usize),
    /// By depth, from 0 at the surface (dark) to 1 (light): for more curves than numbered colours.
    Depth(f64),
}

impl From<usize> for Ink {
    fn from(number: usize) -> Self {
        Self::Number(number)
    }
}

impl Ink {
    /// Colour of the `index`-th of `count` layers or interfaces from the surface down (from 0): by number while there are colours for
    /// all.
    pub(super) fn by_depth(index: usize, count: usize) -> Self {
        match count {
            0..=NUMBERED_COLOURS => Self::Number(index + 1),
            _ => Self::Depth(index as f64 / (count - 1) as f64),
        }
    }

    fn colour(self) -> Colour {
        match self {
            Self::Number(number) => Colour::line(number),
            Self::Depth(part) => Colour::deep(part),
        }
    }
}

/// Largest number of layers or interfaces with numbered colours: four layers on a substrate.
pub(super) const NUMBERED_COLOURS: usize = 5;

/// The style of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// Open markers without a line.
    Markers,
    /// Filled markers on a line.
    LineMarkers,
}

/// Width of curves, points.
const STROKE: f64 = 1.1;
/// Half the size of a marker, points.
const MARKER: f64 = 1.9;
/// Distance between a piece of line in a legend and its text, points.
pub(super) const TEXT_GAP: f64 = 3.5;

/// Half the length of the ends of an error bar, points.
const CAP: f64 = 1.6;
/// Width of an error bar, points.
const BAR: f64 = 0.6;

impl Curve {
    /// Error at a point, 0 where none is known.
    fn error(&self, index: usize) -> f64 {
        self.errors.get(index).copied().filter(|error| *error > 0.0).unwrap_or(0.0)
    }

    /// Whether the line leads from a point (by its index) to the next: it does not where it would fall by less than the
    /// errors of both.
    pub(super) fn leads_on(&self, index: usize) -> bool {
        let (Some([_, y]), Some([_, next])) = (self.points.get(index), self.points.get(index + 1)) else {
            return false;
        };
        *next >= *y || y - next > self.error(index) + self.error(index + 1)
    }

    /// Whether the error of a point exceeds half of its value.
    fn is_rough(&self, index: usize) -> bool {
        self.error(index) > 0.5 * self.points[index][1].abs()
    }

    /// Error bars of the points that have errors: x, and least and largest y.
    pub(super) fn bars(&self) -> impl Iterator<Item = (f64, [f64; 2])> {
        let known = self.points.iter().enumerate().filter(|(index, _)| self.error(*index) > 0.0);
        known.map(|(index, [x, y])| (*x, [y - self.error(index), y + self.error(index)]))
    }

    /// Draws a bar given by its ends on the sheet, the upper one first, within a rectangle. An end beyond it has no cap.
    pub(super) fn draw_bar(&self, canvas: &mut Canvas, [top, end]: [[f64; 2]; 2], bounds: [[f64; 2]; 2]) {
        let colour = self.colour.colour();
        for piece in clipped(&[top, end], bounds) {
            canvas.line(&piece, BAR, colour);
        }
        let [low, high] = bounds;
        for [x, y] in [top, end] {
            if y > low[1] && y < high[1] && x >= low[0] && x <= high[0] {
                canvas.line(&[[x - CAP, y], [x + CAP, y]], BAR, colour);
            }
        }
    }

    /// Draws a point of a curve with errors, within a rectangle: an open marker where its error exceeds half of its value, else a dot
    /// where no line leads to it or from it and the curve has no markers.
    pub(super) fn draw_point(&self, canvas: &mut Canvas, index: usize, [x, y]: [f64; 2], bounds: [[f64; 2]; 2]) {
        let [low, high] = bounds;
        if !(x >= low[0] - 0.1 && x <= high[0] + 0.1 && y >= low[1] - 0.1 && y <= high[1] + 0.1) {
            return;
        }
        let has_line = self.leads_on(index) || index > 0 && self.leads_on(index - 1);
        let has_marker = matches!(self.style, Style::Markers | Style::LineMarkers);
        if self.is_rough(index) {
            canvas.disc([x, y], MARKER, self.colour.colour());
            canvas.disc([x, y], MARKER - 0.7, Colour::WHITE);
        } else if !has_line && !has_marker {
            canvas.disc([x, y], 0.6 * MARKER, self.colour.colour());
        }
    }

    /// Draws an uninterrupted piece of the curve, given by its places on the sheet, within a rectangle.
    pub(super) fn draw(&self, canvas: &mut Canvas, run: &[[f64; 2]], bounds: [[f64; 2]; 2]) {
        if let Some(dash) = self.style.dash() {
            for piece in clipped(run, bounds) {
                canvas.dashed(&piece, STROKE, dash, self.colour.colour());
            }
        }
        let [low, high] = bounds;
        let within = |place: &&[f64; 2]| (0..2).all(|k| place[k] >= low[k] - 0.1 && place[k] <= high[k] + 0.1);
        for &place in run.iter().filter(within) {
            self.mark(canvas, place);
        }
    }

    /// Draws the curve's entry in a legend: a piece of it, then its name.
    pub(super) fn entry(&self, text: &str, canvas: &mut Canvas, [x, y]: [f64; 2], length: f64) {
        if let Some(dash) = self.style.dash() {
            canvas.dashed(&[[x, y], [x + length, y]], STROKE, dash, self.colour.colour());
        }
        self.mark(canvas, [x + 0.5 * length, y]);
        canvas.label(text, [x + length + TEXT_GAP, y], Anchor::Left, NUMBERS, Colour::BLACK);
    }

    /// Draws the marker, if the style has one: shapes alternate with the colours.
    fn mark(&self, canvas: &mut Canvas, [x, y]: [f64; 2]) {
        let open = match self.style {
            Style::Markers => true,
            Style::LineMarkers => false,
            _ => return,
        };
        let colour = self.colour.colour();
        let number = if let Ink::Number(number) = self.colour { number % 4 } else { 0 };
        let corners: &[[f64; 2]] = match number {
            1 => &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
            2 => &[[0.0, -1.35], [1.35, 0.0], [0.0, 1.35], [-1.35, 0.0]],
            _ => &[[0.0, -1.3], [1.25, 1.0], [-1.25, 1.0]],
        };
        let shape: Vec<[f64; 2]> = corners.iter().map(|[u, v]| [x + MARKER * u, y + MARKER * v]).collect();
        if number == 0 {
            canvas.disc([x, y], MARKER + if open { 0.35 } else { 0.0 }, colour);
            if open {
                canvas.disc([x, y], MARKER - 0.45, Colour::WHITE);
            }
        } else if open {
            canvas.area(&shape, Colour::WHITE);
            canvas.outline(&shape, 0.8, colour);
        } else {
            canvas.area(&shape, colour);
        }
    }
}

impl Style {
    fn dash(self) -> Option<Dash> {
        match self {
            Self::Line | Self::LineMarkers => Some(Dash::Solid),
            Self::Dashed => Some(Dash::Dashed),
            Self::Dotted => Some(Dash::Dotted),
            Self::Markers => None,
        }
    }
}

/// The pieces of a line within a rectangle (Liang–Barsky).
pub(super) fn clipped(points: &[[f64; 2]], [low, high]: [[f64; 2]; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    for pair in points.windows(2) {
        let (a, d) = (pair[0], [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]]);
        let (mut from, mut to) = (0.0f64, 1.0f64);
        for k in 0..2 {
            if d[k] == 0.0 {
                if a[k] < low[k] || a[k] > high[k] {
                    to = -1.0;
                }
                continue;
            }
            let (s, t) = ((low[k] - a[k]) / d[k], (high[k] - a[k]) / d[k]);
            from = from.max(s.min(t));
            to = to.min(s.max(t));
        }
        if from > to {
            continue;
        }
        let at = |t: f64| [a[0] + t * d[0], a[1] + t * d[1]];
        match pieces.last_mut() {
            Some(piece) if from == 0.0 && piece.last() == Some(&a) => piece.push(at(to)),
            _ => pieces.push(vec![at(from), at(to)]),
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_does_not_fall_by_less_than_the_errors() {
        let points = [1.0, 2.0, 1.5, 1.9, 1.0].iter().enumerate().map(|(k, y)| [k as f64, *y]).collect();
        let curve =
            |errors: Vec<f64>| Curve { label: String::new(), points, errors, style: Style::Line, colour: 1.into() };
        let curve = curve(vec![0.2, 0.3, 0.3, 0.1, f64::NAN]);
        // Up; down by 0.5 with 0.6 of errors; up; down by 0.9 with 0.1.
        assert_eq!([0, 1, 2, 3, 4].map(|index| curve.leads_on(index)), [true, false, true, true, false]);
        assert_eq!(curve.bars().map(|(x, _)| x).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0]);
    }

    #[test]
    fn lines_end_at_the_frame() {
        let pieces = clipped(&[[-1.0, 0.5], [0.5, 0.5], [0.5, 3.0], [0.7, 3.0], [0.7, 0.0]], [[0.0; 2], [1.0; 2]]);
        assert_eq!(pieces, [vec![[0.0, 0.5], [0.5, 0.5], [0.5, 1.0]], vec![[0.7, 1.0], [0.7, 0.0]]]);
    }
}

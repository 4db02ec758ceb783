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
    /// Error of y at each point, in its unit, drawn as a bar or a band; NaN where none is known. Empty: the curve has none.
    pub errors: Vec<f64>,
    /// Style of line and markers.
    pub style: Style,
    /// Colour.
    pub colour: Ink,
}

/// The colour of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ink {
    /// Colour by the index of the curve: 0 black, then 1 blue, 2 vermilion, 3 green, 4 purple, 5 orange, 6 sky blue, and again from 1.
    Number(usize),
    /// Colour by depth, from 0 at the surface (dark) to 1 (light): for more curves than numbered colours.
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
    pub fn by_depth(index: usize, count: usize) -> Self {
        match count {
            0..=NUMBERED_COLOURS => Self::Number(index + 1),
            _ => Self::Depth(index as f64 / (count - 1) as f64),
        }
    }

    /// Colour of the ink.
    pub fn colour(self) -> Colour {
        match self {
            Self::Number(number) => Colour::line(number),
            Self::Depth(part) => Colour::deep(part),
        }
    }
}

/// Largest number of layers or interfaces with numbered colours: four layers on a substrate.
pub const NUMBERED_COLOURS: usize = 5;

/// The style of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// A solid line.
    Line,
    /// A dashed line: what the results are compared with.
    Dashed,
    /// A dotted line.
    Dotted,
    /// A thin solid line without markers.
    Thin,
    /// Open markers without a line.
    Markers,
    /// Filled markers on a line.
    LineMarkers,
}

/// Width of curves, points.
const STROKE: f64 = 1.1;
/// Half the size of a marker, points.
pub const MARKER: f64 = 1.9;
/// Distance between a piece of line in a legend and its text, points.
pub const TEXT_GAP: f64 = 3.5;

impl Curve {
    /// Draws an uninterrupted piece of the curve, given by its places on the sheet, within a rectangle.
    pub fn draw(&self, canvas: &mut Canvas, run: &[[f64; 2]], bounds: [[f64; 2]; 2]) {
        if let Some(dash) = self.style.dash() {
            for piece in clipped(run, bounds) {
                canvas.dashed(&piece, self.style.width(), dash, self.colour.colour());
            }
        }
        let [low, high] = bounds;
        let within = |place: &&[f64; 2]| (0..2).all(|k| place[k] >= low[k] - 0.1 && place[k] <= high[k] + 0.1);
        for &place in run.iter().filter(within) {
            self.mark(canvas, place);
        }
    }

    /// Draws the curve's entry in a legend: a piece of it, then its name.
    pub fn entry(&self, text: &str, canvas: &mut Canvas, [x, y]: [f64; 2], length: f64) {
        if let Some(dash) = self.style.dash() {
            canvas.dashed(&[[x, y], [x + length, y]], self.style.width(), dash, self.colour.colour());
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
            Self::Line | Self::LineMarkers | Self::Thin => Some(Dash::Solid),
            Self::Dashed => Some(Dash::Dashed),
            Self::Dotted => Some(Dash::Dotted),
            Self::Markers => None,
        }
    }

    fn width(self) -> f64 {
        if self == Self::Thin { 0.5 * STROKE } else { STROKE }
    }
}

/// The pieces of a line within a rectangle (Liang–Barsky).
pub fn clipped(points: &[[f64; 2]], [low, high]: [[f64; 2]; 2]) -> Vec<Vec<[f64; 2]>> {
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
    fn lines_end_at_the_frame() {
        let pieces = clipped(&[[-1.0, 0.5], [0.5, 0.5], [0.5, 3.0], [0.7, 3.0], [0.7, 0.0]], [[0.0; 2], [1.0; 2]]);
        assert_eq!(pieces, [vec![[0.0, 0.5], [0.5, 0.5], [0.5, 1.0]], vec![[0.7, 1.0], [0.7, 0.0]]]);
    }
}

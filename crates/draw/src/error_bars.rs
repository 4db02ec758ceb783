//! Errors of the points of a curve, and where its line leads. The rule of all charts:
//!
//! - Curves with markers have error bars, a line alone has a band.
//! - **No line leads through noise.** A line leads along a stretch on which the values rise, or fall, only if they do so by more than the
//!   largest error on that stretch: a zigzag within the errors is points with their bars, or the band with its points, without a line.
//! - A constant is no zigzag, and errors no larger than half a marker cannot be seen: neither interrupts a line.
//! - A marker of a point whose error exceeds half of its value is open.
//! - An error bar that goes on beyond the frame ends there with an arrow head. One that would cross the whole plot is two short arrows from
//!   its point: the error is larger than the axis, and how much says nothing.
//!
//! Python's `percoat.plot.curve` interrupts its lines by the same rule.

use super::canvas::Canvas;
use super::colour::Colour;
use super::curve::{Curve, MARKER, Style, clipped};

/// Largest number of points of a curve with markers.
pub const MOST_MARKERS: usize = 25;

/// Half the length of the ends of an error bar, points.
const CAP: f64 = 1.6;
/// Length of the arrow head of a bar that goes on, points.
const HEAD: f64 = 3.0;
/// Length of the arrows of a bar that is larger than the axis, points.
const ARROW: f64 = 5.0 * MARKER;
/// Width of an error bar and of the edges of a band, points.
const BAR: f64 = 0.6;
/// Part of white in the colour of a band.
const BAND: f64 = 0.75;

impl Curve {
    /// Error at a point, 0 where none is known.
    pub fn error(&self, index: usize) -> f64 {
        self.errors.get(index).copied().filter(|error| *error > 0.0).unwrap_or(0.0)
    }

    /// Whether its errors are drawn as a band.
    pub fn has_band(&self) -> bool {
        !matches!(self.style, Style::Markers | Style::LineMarkers)
    }

    /// Whether the error of a point exceeds half of its value.
    fn is_rough(&self, index: usize) -> bool {
        self.error(index) > 0.5 * self.points[index][1].abs()
    }

    /// Least and largest y of the error of a point; `None` where it has none.
    pub fn bar(&self, index: usize) -> Option<[f64; 2]> {
        let (y, error) = (self.points[index][1], self.error(index));
        (error > 0.0).then_some([y - error, y + error])
    }

    /// Whether any point has an error.
    pub fn has_errors(&self) -> bool {
        (0..self.points.len()).any(|index| self.error(index) > 0.0)
    }

    /// Whether the line leads from each point to the next one, `is_seen` saying by the index of a point whether its error can be seen.
    pub fn leads(&self, is_seen: impl Fn(usize) -> bool) -> Vec<bool> {
        let y = |index: usize| self.points[index][1];
        let pairs = self.points.len().saturating_sub(1);
        let mut leads = vec![true; pairs];
        let mut first = 0;
        while first < pairs {
            // The stretch goes on while no value goes back, and none is missing.
            let (mut last, mut sign) = (first + 1, y(first + 1) - y(first));
            while last < pairs && (y(last + 1) - y(last)) * sign >= 0.0 {
                let step = y(last + 1) - y(last);
                sign = if sign == 0.0 { step } else { sign };
                last += 1;
            }
            let error = (first..=last).map(|index| self.error(index)).fold(0.0, f64::max);
            let change = (y(last) - y(first)).abs();
            if change > 0.0 && change <= error {
                for (lead, index) in leads[first..last].iter_mut().zip(first..) {
                    *lead = !is_seen(index) && !is_seen(index + 1);
                }
            }
            first = last;
        }
        leads
    }

    /// Draws the bar of a point given by its ends on the sheet, the upper one first, within a rectangle. An end beyond it is an arrow head.
    pub fn draw_bar(&self, canvas: &mut Canvas, [x, y]: [f64; 2], ends: [[f64; 2]; 2], [low, high]: [[f64; 2]; 2]) {
        let colour = self.colour.colour();
        let [top, end] = ends.map(|[_, y]| y);
        let is_larger_than_the_axis = top < low[1] && end > high[1];
        if x < low[0] || x > high[0] || is_larger_than_the_axis && !(low[1]..=high[1]).contains(&y) {
            return;
        }
        let [from, to] = if is_larger_than_the_axis { [y - ARROW, y + ARROW] } else { [top, end] };
        let shown = [from.max(low[1]), to.min(high[1])];
        if shown[0] > shown[1] {
            return;
        }
        canvas.line(&[[x, shown[0]], [x, shown[1]]], BAR, colour);
        for (shown, goes_on, inward) in [(shown[0], top < low[1], 1.0), (shown[1], end > high[1], -1.0)] {
            if goes_on {
                let back = shown + inward * HEAD;
                canvas.area(&[[x, shown], [x - CAP, back], [x + CAP, back]], colour);
            } else {
                canvas.line(&[[x - CAP, shown], [x + CAP, shown]], BAR, colour);
            }
        }
    }

    /// Draws a band through the ends of its errors on the sheet, the upper ones first, within a rectangle.
    pub fn draw_band(&self, canvas: &mut Canvas, ends: &[[[f64; 2]; 2]], bounds: [[f64; 2]; 2]) {
        if ends.len() < 2 {
            return;
        }
        let [low, high] = bounds;
        let inside = |[x, y]: [f64; 2]| [x.clamp(low[0], high[0]), y.clamp(low[1], high[1])];
        let edges = [0, 1].map(|k| ends.iter().map(|pair| pair[k]).collect::<Vec<[f64; 2]>>());
        let corners = edges[0].iter().chain(edges[1].iter().rev()).map(|&place| inside(place));
        let colour = self.colour.colour().lighter(BAND);
        canvas.area(&corners.collect::<Vec<[f64; 2]>>(), colour);
        for piece in edges.iter().flat_map(|edge| clipped(edge, bounds)) {
            canvas.line(&piece, BAR, self.colour.colour().lighter(0.5 * BAND));
        }
    }

    /// Draws a point of a curve with errors, within a rectangle: an open marker where its error exceeds half of its value, or for a
    /// curve with a band a dot where no line leads to it or from it.
    pub fn draw_point(
        &self,
        canvas: &mut Canvas,
        index: usize,
        [x, y]: [f64; 2],
        has_line: bool,
        bounds: [[f64; 2]; 2],
    ) {
        let [low, high] = bounds;
        if !(x >= low[0] - 0.1 && x <= high[0] + 0.1 && y >= low[1] - 0.1 && y <= high[1] + 0.1) {
            return;
        }
        if self.has_band() && !has_line {
            canvas.disc([x, y], 0.6 * MARKER, self.colour.colour());
        } else if !self.has_band() && self.is_rough(index) {
            canvas.disc([x, y], MARKER, self.colour.colour());
            canvas.disc([x, y], MARKER - 0.7, Colour::WHITE);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::canvas::{Mark, Stroke};
    use super::*;

    fn curve(values: &[f64], errors: &[f64]) -> Curve {
        let points = values.iter().enumerate().map(|(k, y)| [k as f64, *y]).collect();
        Curve { label: String::new(), points, errors: errors.to_vec(), style: Style::Line, colour: 1.into() }
    }

    #[test]
    fn no_line_leads_through_a_zigzag_within_the_errors() {
        // Up by 1 with 0.3; down by 0.5 with 0.6; up by 0.4 with 0.6; down by 0.9 with 0.1.
        let zigzag = curve(&[1.0, 2.0, 1.5, 1.9, 1.0], &[0.2, 0.3, 0.6, 0.1, f64::NAN]);
        assert_eq!(zigzag.leads(|_| true), [true, false, false, true]);
        // Hidden points interrupt nothing.
        assert_eq!(zigzag.leads(|_| false), [true; 4]);
        assert_eq!(zigzag.leads(|index| index == 3), [true, true, false, true]);
        assert_eq!(
            (0..5).map(|index| zigzag.bar(index).is_some()).collect::<Vec<_>>(),
            [true, true, true, true, false]
        );
        let asymmetry = curve(&[0.010, 0.012, 0.009, 0.011], &[0.004; 4]);
        assert_eq!(asymmetry.leads(|_| true), [false; 3]);
    }

    /// Lengths of the vertical lines and number of the arrow heads of a bar about y = 50 in a frame from 0 to 100.
    fn drawn(top: f64, end: f64) -> (Vec<f64>, usize) {
        let mut canvas = Canvas::new([100.0; 2]);
        curve(&[1.0], &[1.0]).draw_bar(&mut canvas, [50.0; 2], [[50.0, top], [50.0, end]], [[0.0; 2], [100.0; 2]]);
        let upright = |mark: &Mark| match mark {
            Mark::Line(Stroke { points, .. }) if points[0][0] == points[1][0] => Some(points[1][1] - points[0][1]),
            _ => None,
        };
        let heads = canvas.marks.iter().filter(|mark| matches!(mark, Mark::Area { .. })).count();
        (canvas.marks.iter().filter_map(upright).collect(), heads)
    }

    #[test]
    fn a_bar_larger_than_the_axis_does_not_cross_the_plot() {
        assert_eq!(drawn(30.0, 70.0), (vec![40.0], 0));
        // One end goes on.
        assert_eq!(drawn(-20.0, 70.0), (vec![70.0], 1));
        assert_eq!(drawn(-20.0, 120.0), (vec![2.0 * ARROW], 2));
        // Nothing of it lies in the frame.
        assert_eq!(drawn(-20.0, -10.0), (vec![], 0));
    }

    #[test]
    fn a_rise_that_several_points_make_together_is_no_noise() {
        let rising = curve(&[1.0, 1.1, 1.1, 1.2, 1.3], &[0.2; 5]);
        assert_eq!(rising.leads(|_| true), [true; 4]);
        let hidden = curve(&[1.0, 1.05, 1.1], &[0.2; 3]);
        assert_eq!(hidden.leads(|_| true), [false; 2]);
        let constant = curve(&[3.0, 3.0, 3.0], &[0.1; 3]);
        assert_eq!(constant.leads(|_| true), [true; 2]);
    }

    #[test]
    fn a_missing_value_ends_a_stretch() {
        let interrupted = curve(&[1.0, 1.1, f64::NAN, 1.15, 2.0], &[0.2; 5]);
        let leads = interrupted.leads(|_| true);
        assert!(!leads[0] && leads[3], "{leads:?}");
    }
}

//! Curves over a pair of axes: a chart, and figures of several charts side by side.

use super::Format;
use super::axis::{Axis, Scale, Ticks, power, ticks};
use super::canvas::{Anchor, Canvas, Dash};
use super::colour::Colour;
use super::legend::{Legend, TEXT_GAP};
use super::sheet::{HAIR, LABELS, NUMBERS, Panel, sheet};
use super::text;

/// A chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What stands over it.
    pub title: String,
    /// What stands under it, line by line; long lines are broken.
    pub caption: Vec<String>,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Curves, the first one lowest.
    pub curves: Vec<Curve>,
}

/// A curve of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend; empty: it is not there.
    pub label: String,
    /// Points (x, y); one that is not finite, or not positive on a logarithmic axis, interrupts the curve.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: Style,
    /// Index of its colour: 0 black, then 1 blue, 2 vermilion, 3 green, 4 purple, 5 orange, 6 sky blue.
    pub colour: usize,
}

/// How a curve is drawn.
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

/// Charts side by side in one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What stands over all; may be empty.
    pub title: String,
    /// What stands under all, line by line.
    pub caption: Vec<String>,
    /// The charts, row by row.
    pub panels: Vec<Chart>,
    /// Charts in a row, each as wide as a column of a journal.
    pub columns: usize,
}

impl Chart {
    /// The picture as a file.
    pub fn draw(&self, format: Format) -> Vec<u8> {
        sheet("", &[], &[self], 1).file(format)
    }
}

impl Figure {
    /// The picture as a file.
    pub fn draw(&self, format: Format) -> Vec<u8> {
        let panels: Vec<&dyn Panel> = self.panels.iter().map(|chart| chart as &dyn Panel).collect();
        sheet(&self.title, &self.caption, &panels, self.columns).file(format)
    }
}

/// Width of curves, points.
const STROKE: f64 = 1.1;
/// Half the size of a marker.
const MARKER: f64 = 1.9;
/// Length of a numbered tick.
const TICK: f64 = 3.0;
/// Height of a plot over its width.
const ASPECT: f64 = 0.68;

/// Where everything of a chart stands, relative to its upper left corner.
struct Layout {
    /// Plot: corner and size.
    corner: [f64; 2],
    size: [f64; 2],
    ranges: [[f64; 2]; 2],
    ticks: [Ticks; 2],
    /// The legend and its corner.
    legend: Option<(Legend, [f64; 2])>,
    height: f64,
}

impl Chart {
    fn layout(&self, width: f64) -> Layout {
        let values = |axis: usize| self.curves.iter().flat_map(move |curve| curve.points.iter().map(move |p| p[axis]));
        let dots = self.curves.iter().any(|curve| matches!(curve.style, Style::Markers | Style::LineMarkers));
        let ranges = [self.x.reach(values(0), if dots { 0.03 } else { 0.0 }), self.y.reach(values(1), 0.05)];
        let y_ticks = ticks(ranges[1], self.y.scale, 6);
        let widest = y_ticks.numbered.iter().map(|(_, number)| text::width(number, NUMBERS)).fold(0.0, f64::max);
        let left = LABELS * 1.35 + widest + 3.0;
        let right = 6.0;
        let plot = [width - left - right, ASPECT * (width - left - right)];
        let x_ticks = {
            // As many numbers as stand apart.
            let fits = |most: &usize| {
                let numbers = ticks(ranges[0], self.x.scale, *most).numbered;
                let all: f64 = numbers.iter().map(|(_, number)| text::width(number, NUMBERS) + NUMBERS).sum();
                all <= plot[0] + NUMBERS
            };
            ticks(ranges[0], self.x.scale, (2..=7).rev().find(fits).unwrap_or(2))
        };
        let top = if y_ticks.exponent == 0 { 0.6 * NUMBERS } else { 1.5 * NUMBERS };
        let bottom = top + plot[1] + NUMBERS * 1.45 + LABELS * 1.5;
        let mut layout =
            Layout { corner: [left, top], size: plot, ranges, ticks: [x_ticks, y_ticks], legend: None, height: bottom };
        let inside = Legend::stacked(&self.curves)
            .and_then(|legend| Some((legend.free_place(layout.corner, plot, &self.taken(&layout))?, legend)));
        layout.legend = match inside {
            Some((corner, legend)) => Some((legend, corner)),
            None => Legend::spread(&self.curves, plot[0]).map(|legend| {
                layout.height += legend.size[1] + 2.0;
                (legend, [left, bottom + 2.0])
            }),
        };
        layout
    }

    /// Points that the legend must keep clear of.
    fn taken(&self, layout: &Layout) -> Vec<[f64; 2]> {
        let mut taken = Vec::new();
        for curve in &self.curves {
            for run in self.runs(curve, layout) {
                for pair in run.windows(2) {
                    let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
                    let steps = ((x1 - x0).hypot(y1 - y0) / 3.0).ceil().clamp(1.0, 400.0);
                    let part = |k: f64| [x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps];
                    taken.extend((0..=steps as u32).map(|k| part(f64::from(k))));
                }
                taken.extend(run.first());
            }
        }
        taken
    }

    /// Place of a point on the sheet, if it has one.
    fn place(&self, [x, y]: [f64; 2], layout: &Layout) -> Option<[f64; 2]> {
        let part = |value: f64, axis: &Axis, [first, last]: [f64; 2]| match axis.scale {
            Scale::Linear => (value - first) / (last - first),
            Scale::Log => (value / first).ln() / (last / first).ln(),
        };
        let across = part(x, &self.x, layout.ranges[0]);
        let up = part(y, &self.y, layout.ranges[1]);
        let place = [layout.corner[0] + across * layout.size[0], layout.corner[1] + (1.0 - up) * layout.size[1]];
        place.iter().all(|c| c.is_finite()).then_some(place)
    }

    /// Uninterrupted pieces of a curve on the sheet.
    fn runs(&self, curve: &Curve, layout: &Layout) -> Vec<Vec<[f64; 2]>> {
        let mut runs: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
        for &point in &curve.points {
            match (self.place(point, layout), runs.last_mut()) {
                (Some(place), Some(run)) => run.push(place),
                _ => runs.push(Vec::new()),
            }
        }
        runs.retain(|run| !run.is_empty());
        runs
    }

    fn draw_axes(&self, canvas: &mut Canvas, layout: &Layout, [ox, oy]: [f64; 2]) {
        let ([left, top], [width, height]) = ([ox + layout.corner[0], oy + layout.corner[1]], layout.size);
        let (right, bottom) = (left + width, top + height);
        canvas.outline(&[[left, top], [right, top], [right, bottom], [left, bottom]], HAIR, Colour::BLACK);
        let at = |x: f64, y: f64| self.place([x, y], layout).map(|[x, y]| [ox + x, oy + y]);
        let [x_ticks, y_ticks] = &layout.ticks;
        let [[x0, _], [y0, _]] = layout.ranges;
        let plain = |ticks: &Ticks| ticks.plain.iter().map(|&value| (value, None)).collect::<Vec<_>>();
        let all = |ticks: &Ticks| {
            let numbered = ticks.numbered.iter().map(|(value, number)| (*value, Some(number.clone())));
            numbered.chain(plain(ticks)).collect::<Vec<_>>()
        };
        for (value, number) in all(x_ticks) {
            let Some([x, _]) = at(value, y0) else { continue };
            let length = if number.is_some() { TICK } else { 0.55 * TICK };
            canvas.line(&[[x, bottom], [x, bottom - length]], HAIR, Colour::BLACK);
            canvas.line(&[[x, top], [x, top + length]], HAIR, Colour::BLACK);
            if let Some(number) = number {
                canvas.text(&number, [x, bottom + 1.25 * NUMBERS], Anchor::Centre, NUMBERS, Colour::BLACK);
            }
        }
        for (value, number) in all(y_ticks) {
            let Some([_, y]) = at(x0, value) else { continue };
            let length = if number.is_some() { TICK } else { 0.55 * TICK };
            canvas.line(&[[left, y], [left + length, y]], HAIR, Colour::BLACK);
            canvas.line(&[[right, y], [right - length, y]], HAIR, Colour::BLACK);
            if let Some(number) = number {
                canvas.label(&number, [left - 3.0, y], Anchor::Right, NUMBERS, Colour::BLACK);
            }
        }
        let below = bottom + 1.45 * NUMBERS + 1.05 * LABELS;
        canvas.text(&self.x.label, [left + 0.5 * width, below], Anchor::Centre, LABELS, Colour::BLACK);
        canvas.upward(&self.y.label, [ox + LABELS, top + 0.5 * height], LABELS, Colour::BLACK);
        let factor = |exponent: i32| format!("×{}", power(exponent));
        if y_ticks.exponent != 0 {
            canvas.text(&factor(y_ticks.exponent), [left, top - 3.0], Anchor::Left, NUMBERS, Colour::BLACK);
        }
        if x_ticks.exponent != 0 {
            canvas.text(&factor(x_ticks.exponent), [right, below], Anchor::Right, NUMBERS, Colour::BLACK);
        }
        // Zero within a range of both signs.
        let crosses = |[first, last]: [f64; 2]| first.min(last) < 0.0 && first.max(last) > 0.0;
        if self.y.scale == Scale::Linear
            && crosses(layout.ranges[1])
            && let Some([_, y]) = at(x0, 0.0)
        {
            canvas.line(&[[left, y], [right, y]], 0.6 * HAIR, Colour::GREY);
        }
    }
}

impl Panel for Chart {
    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &[String] {
        &self.caption
    }

    fn height(&self, width: f64) -> f64 {
        self.layout(width).height
    }

    fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2], width: f64) {
        let layout = self.layout(width);
        self.draw_axes(canvas, &layout, [ox, oy]);
        let ([left, top], [width, height]) = ([ox + layout.corner[0], oy + layout.corner[1]], layout.size);
        let frame = [[left, top], [left + width, top + height]];
        for curve in &self.curves {
            for run in self.runs(curve, &layout) {
                let run: Vec<[f64; 2]> = run.into_iter().map(|[x, y]| [ox + x, oy + y]).collect();
                if let Some(dash) = curve.style.dash() {
                    for piece in clipped(&run, frame) {
                        canvas.dashed(&piece, STROKE, dash, Colour::line(curve.colour));
                    }
                }
                let within = |&&[x, y]: &&[f64; 2]| {
                    x >= frame[0][0] - 0.1 && x <= frame[1][0] + 0.1 && y >= frame[0][1] - 0.1 && y <= frame[1][1] + 0.1
                };
                for &place in run.iter().filter(within) {
                    marker(canvas, place, curve);
                }
            }
        }
        if let Some((legend, [x, y])) = &layout.legend {
            legend.draw(canvas, [ox + x, oy + y], &self.curves);
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

/// Draws a legend's entry for a curve: a piece of it, then its name.
pub(super) fn sample(canvas: &mut Canvas, [x, y]: [f64; 2], length: f64, curve: &Curve) {
    if let Some(dash) = curve.style.dash() {
        canvas.dashed(&[[x, y], [x + length, y]], STROKE, dash, Colour::line(curve.colour));
    }
    marker(canvas, [x + 0.5 * length, y], curve);
    canvas.label(&curve.label, [x + length + TEXT_GAP, y], Anchor::Left, NUMBERS, Colour::BLACK);
}

/// Draws a curve's marker, if it has one: shapes alternate with the colours.
fn marker(canvas: &mut Canvas, [x, y]: [f64; 2], curve: &Curve) {
    let open = match curve.style {
        Style::Markers => true,
        Style::LineMarkers => false,
        _ => return,
    };
    let colour = Colour::line(curve.colour);
    let shape = |radius: f64| -> Vec<[f64; 2]> {
        match curve.colour % 4 {
            1 => vec![
                [x - radius, y - radius],
                [x + radius, y - radius],
                [x + radius, y + radius],
                [x - radius, y + radius],
            ],
            2 => vec![[x, y - 1.35 * radius], [x + 1.35 * radius, y], [x, y + 1.35 * radius], [x - 1.35 * radius, y]],
            _ => vec![[x, y - 1.3 * radius], [x + 1.25 * radius, y + radius], [x - 1.25 * radius, y + radius]],
        }
    };
    if curve.colour.is_multiple_of(4) {
        canvas.disc([x, y], MARKER + if open { 0.35 } else { 0.0 }, colour);
        if open {
            canvas.disc([x, y], MARKER - 0.45, Colour::WHITE);
        }
    } else if open {
        canvas.area(&shape(MARKER), Colour::WHITE);
        canvas.outline(&shape(MARKER), 0.8, colour);
    } else {
        canvas.area(&shape(MARKER), colour);
    }
}

/// The pieces of a line within a rectangle (Liang–Barsky).
fn clipped(points: &[[f64; 2]], [low, high]: [[f64; 2]; 2]) -> Vec<Vec<[f64; 2]>> {
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

    fn chart(curves: Vec<Curve>) -> Chart {
        Chart { title: "Test".into(), caption: vec![], x: Axis::linear("x"), y: Axis::log("error"), curves }
    }

    fn line(points: Vec<[f64; 2]>) -> Curve {
        Curve { label: "a curve".into(), points, style: Style::Line, colour: 1 }
    }

    #[test]
    fn points_without_a_place_interrupt_a_curve() {
        let chart =
            chart(vec![line(vec![[0.0, 1.0], [1.0, 0.1], [2.0, f64::NAN], [3.0, 0.1], [4.0, -1.0], [5.0, 2.0]])]);
        let runs = chart.runs(&chart.curves[0], &chart.layout(230.0));
        assert_eq!(runs.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1, 1]);
    }

    #[test]
    fn lines_end_at_the_frame() {
        let pieces = clipped(&[[-1.0, 0.5], [0.5, 0.5], [0.5, 3.0], [0.7, 3.0], [0.7, 0.0]], [[0.0; 2], [1.0; 2]]);
        assert_eq!(pieces, [vec![[0.0, 0.5], [0.5, 0.5], [0.5, 1.0]], vec![[0.7, 1.0], [0.7, 0.0]]]);
    }

    #[test]
    fn the_legend_keeps_clear_of_the_curves() {
        let rising = chart(vec![line((1..50).map(|k| [f64::from(k), 10f64.powi(k / 10)]).collect())]);
        let layout = rising.layout(230.0);
        let (legend, [x, y]) = layout.legend.clone().unwrap();
        let covered = |p: &[f64; 2]| p[0] > x && p[0] < x + legend.size[0] && p[1] > y && p[1] < y + legend.size[1];
        assert!(!rising.taken(&layout).iter().any(covered) && y < layout.corner[1] + layout.size[1]);
        // No room: below.
        let zigzag = chart(vec![line((0..200).map(|k| [f64::from(k), if k % 2 == 0 { 1.0 } else { 10.0 }]).collect())]);
        let layout = zigzag.layout(230.0);
        assert!(layout.legend.unwrap().1[1] > layout.corner[1] + layout.size[1]);
    }

    #[test]
    fn a_chart_without_points_is_drawn_all_the_same() {
        let picture = chart(vec![]).draw(Format::Png);
        assert_eq!(&picture[1..4], b"PNG");
    }
}

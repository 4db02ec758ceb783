//! Curves over a pair of axes: a chart, and figures of several charts side by side.

use super::axis::Axis;
use super::canvas::Canvas;
use super::curve::{Curve, MARKER, Style};
use super::frame::Frame;
use super::legend::{self, Legend};
use super::scale::Scale;
use super::sheet::{Margins, Panel, sheet};

/// A chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Title above the plot.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Curves, the first one lowest.
    pub curves: Vec<Curve>,
}

/// Charts in one picture, two in a row, each as wide as a column of a journal.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Caption below all charts; long lines are broken.
    pub caption: String,
    /// The charts, row by row.
    pub panels: Vec<Chart>,
}

impl Figure {
    /// The picture.
    pub fn draw(&self) -> Canvas {
        plots(&self.caption, &self.panels)
    }
}

/// Charts on a sheet.
pub fn plots(caption: &str, charts: &[Chart]) -> Canvas {
    let plots: Vec<Plot> = charts.iter().map(Plot::new).collect();
    let panels: Vec<&dyn Panel> = plots.iter().map(|plot| plot as &dyn Panel).collect();
    sheet(caption, &panels)
}

/// A chart of given proportions.
#[derive(Debug)]
pub struct Plot<'a> {
    /// The chart.
    pub chart: &'a Chart,
    /// Height over width.
    pub aspect: f64,
}

/// Margin to the right of a plot, points.
const RIGHT: f64 = 6.0;

/// A chart laid out.
struct Layout {
    frame: Frame,
    /// The legend and its corner relative to the chart's.
    legend: Option<(Legend, [f64; 2])>,
    height: f64,
}

impl<'a> Plot<'a> {
    fn new(chart: &'a Chart) -> Self {
        Self { chart, aspect: 0.68 }
    }

    fn ranges(&self) -> [[f64; 2]; 2] {
        let Chart { x, y, curves, .. } = self.chart;
        let values = |axis: usize| curves.iter().flat_map(move |curve| curve.points.iter().map(move |p| p[axis]));
        let ends = shown_ends(curves, y.scale);
        let dots = curves.iter().any(|curve| matches!(curve.style, Style::Markers | Style::LineMarkers));
        [x.reach(values(0), if dots { 0.03 } else { 0.0 }), y.reach(values(1).chain(ends), 0.05)]
    }

    fn layout(&self, width: f64, margins: Margins) -> Layout {
        let Chart { x, y, curves, .. } = self.chart;
        let frame = Frame::new([x, y], self.ranges(), width, margins, self.aspect, false);
        let inside = Legend::new(curves, frame.size[0], 1).and_then(|legend| {
            let place = legend.free_place(frame.corner, frame.size, &self.taken(&frame))?;
            Some((legend, place))
        });
        let mut height = frame.height;
        let legend = inside.or_else(|| {
            let legend = Legend::new(curves, frame.size[0], usize::MAX)?;
            let place = [frame.corner[0] - legend::GAP, height + 2.0 - 0.5 * legend::GAP];
            height += legend.size[1] + 2.0;
            Some((legend, place))
        });
        Layout { frame, legend, height }
    }

    /// Points of the curves, bars and marks, which the legend must not cover.
    fn taken(&self, frame: &Frame) -> Vec<[f64; 2]> {
        let mut taken = Vec::new();
        for run in self.chart.curves.iter().flat_map(|curve| runs(curve, frame)) {
            for pair in run.windows(2) {
                let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
                let steps = ((x1 - x0).hypot(y1 - y0) / 3.0).ceil().clamp(1.0, 400.0);
                let part = |k: f64| [x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps];
                taken.extend((0..=steps as u32).map(|k| part(f64::from(k))));
            }
            taken.extend(run.first());
        }
        for [[x, top], [_, bottom]] in self.chart.curves.iter().flat_map(|curve| bars(curve, frame)) {
            taken.extend((0..=20).map(|k| [x, top + (bottom - top) * f64::from(k) / 20.0]));
        }
        let [top, height] = [frame.corner[1], frame.size[1]];
        for (x, _) in frame.marks(&self.chart.x) {
            taken.extend((0..=60).map(|k| [x, top + height * f64::from(k) / 60.0]));
        }
        taken
    }
}

/// Ends of error bars that extend the vertical axis, up to zero where they have another sign than their value: on a linear axis those of
/// errors up to the largest value, on a logarithmic one those of errors up to half of their own.
fn shown_ends(curves: &[Curve], scale: Scale) -> impl Iterator<Item = f64> {
    let points = || curves.iter().flat_map(|curve| (0..curve.points.len()).map(move |index| (curve, index)));
    let value = |(curve, index): (&Curve, usize)| curve.points[index][1].abs();
    let largest = points().map(value).filter(|y| y.is_finite()).fold(0.0, f64::max);
    let is_shown = move |point: &(&Curve, usize)| {
        let most = if scale == Scale::Log { 0.5 * value(*point) } else { largest };
        point.0.error(point.1) <= most
    };
    let ends = |(curve, index): (&Curve, usize)| {
        let [low, high] = curve.bar(index)?;
        Some(if curve.points[index][1] < 0.0 { [low, high.min(0.0)] } else { [low.max(0.0), high] })
    };
    points().filter(is_shown).filter_map(ends).flatten().collect::<Vec<f64>>().into_iter()
}

/// Upper and lower end of the error of a point. One that reaches zero on a logarithmic axis ends below the plot.
fn bar(curve: &Curve, frame: &Frame, index: usize) -> Option<[[f64; 2]; 2]> {
    let ([x, _], [low, high]) = (curve.points[index], curve.bar(index)?);
    let top = frame.place([x, high])?;
    let below = frame.corner[1] + frame.size[1] + 2.0;
    Some([top, frame.place([x, low]).unwrap_or([top[0], below])])
}

/// Error bars of all points of a curve that have one.
fn bars(curve: &Curve, frame: &Frame) -> Vec<[[f64; 2]; 2]> {
    (0..curve.points.len()).filter_map(|index| bar(curve, frame, index)).collect()
}

/// Whether the line of a curve leads from each point to the next one.
fn leads(curve: &Curve, frame: &Frame) -> Vec<bool> {
    let half = |[[_, top], [_, low]]: [[f64; 2]; 2]| 0.5 * (low - top);
    curve.leads(|index| bar(curve, frame, index).is_some_and(|ends| half(ends) > 0.5 * MARKER))
}

/// Uninterrupted pieces of a curve within its panel.
fn runs(curve: &Curve, frame: &Frame) -> Vec<Vec<[f64; 2]>> {
    let leads = leads(curve, frame);
    let mut runs: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    for (index, &point) in curve.points.iter().enumerate() {
        match (frame.place(point), runs.last_mut()) {
            (Some(place), Some(run)) => run.push(place),
            _ => runs.push(Vec::new()),
        }
        if leads.get(index) == Some(&false) {
            runs.push(Vec::new());
        }
    }
    runs.retain(|run| !run.is_empty());
    runs
}

impl Panel for Plot<'_> {
    fn title(&self) -> &str {
        &self.chart.title
    }

    fn margins(&self, width: f64) -> Margins {
        Frame::margins([&self.chart.x, &self.chart.y], self.ranges(), [width, RIGHT], self.aspect, false)
    }

    fn height(&self, width: f64, margins: Margins) -> f64 {
        self.layout(width, margins).height
    }

    fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2], width: f64, margins: Margins) {
        let Layout { frame, legend, .. } = self.layout(width, margins);
        frame.draw(canvas, [ox, oy]);
        frame.draw_zero(canvas, [ox, oy]);
        frame.draw_marks(canvas, &self.chart.x, [ox, oy]);
        let bounds = frame.bounds([ox, oy]);
        let on_sheet = |[x, y]: [f64; 2]| [ox + x, oy + y];
        for curve in self.chart.curves.iter().filter(|curve| curve.has_band()) {
            let ends: Vec<_> = (0..curve.points.len()).map(|index| bar(curve, &frame, index)).collect();
            for run in ends.chunk_by(|a, b| a.is_some() && b.is_some()) {
                let run: Vec<_> = run.iter().flatten().map(|ends| ends.map(on_sheet)).collect();
                curve.draw_band(canvas, &run, bounds);
            }
        }
        for curve in self.chart.curves.iter().filter(|curve| !curve.has_band()) {
            for (index, &point) in curve.points.iter().enumerate() {
                if let Some((place, ends)) = frame.place(point).zip(bar(curve, &frame, index)) {
                    curve.draw_bar(canvas, on_sheet(place), ends.map(on_sheet), bounds);
                }
            }
        }
        for curve in &self.chart.curves {
            for run in runs(curve, &frame) {
                let run: Vec<[f64; 2]> = run.into_iter().map(on_sheet).collect();
                curve.draw(canvas, &run, bounds);
            }
            if curve.has_errors() {
                let leads = leads(curve, &frame);
                let places = curve.points.iter().map(|&point| frame.place(point));
                for (index, place) in places.enumerate().filter_map(|(index, place)| Some((index, place?))) {
                    let before = index.checked_sub(1).is_some_and(|before| leads[before]);
                    let has_line = before || leads.get(index) == Some(&true);
                    curve.draw_point(canvas, index, on_sheet(place), has_line, bounds);
                }
            }
        }
        if let Some((legend, [x, y])) = &legend {
            legend.draw(canvas, [ox + x, oy + y], &self.chart.curves);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::raster::png;
    use super::*;

    fn chart(curves: Vec<Curve>) -> Chart {
        Chart { title: "Test".into(), x: Axis::linear("x"), y: Axis::log("error"), curves }
    }

    fn laid_out(chart: &Chart) -> Layout {
        let plot = Plot::new(chart);
        plot.layout(230.0, plot.margins(230.0))
    }

    fn line(points: Vec<[f64; 2]>) -> Curve {
        Curve { label: "a curve".into(), points, errors: Vec::new(), style: Style::Line, colour: 1.into() }
    }

    #[test]
    fn points_without_a_place_interrupt_a_curve() {
        let chart =
            chart(vec![line(vec![[0.0, 1.0], [1.0, 0.1], [2.0, f64::NAN], [3.0, 0.1], [4.0, -1.0], [5.0, 2.0]])]);
        let runs = runs(&chart.curves[0], &laid_out(&chart).frame);
        assert_eq!(runs.iter().map(Vec::len).collect::<Vec<_>>(), [2, 1, 1]);
    }

    #[test]
    fn the_legend_keeps_clear_of_the_curves() {
        let rising = chart(vec![line((1..50).map(|k| [f64::from(k), 10f64.powi(k / 10)]).collect())]);
        let layout = laid_out(&rising);
        let (legend, [x, y]) = layout.legend.clone().unwrap();
        let covered = |p: &[f64; 2]| p[0] > x && p[0] < x + legend.size[0] && p[1] > y && p[1] < y + legend.size[1];
        assert!(
            !Plot::new(&rising).taken(&layout.frame).iter().any(covered)
                && y < layout.frame.corner[1] + layout.frame.size[1]
        );
        // No room: below.
        let zigzag = chart(vec![line((0..200).map(|k| [f64::from(k), if k % 2 == 0 { 1.0 } else { 10.0 }]).collect())]);
        let layout = laid_out(&zigzag);
        assert!(layout.legend.unwrap().1[1] > layout.frame.corner[1] + layout.frame.size[1]);
    }

    #[test]
    fn a_chart_without_points_is_drawn_all_the_same() {
        let picture = png(&Figure { caption: String::new(), panels: vec![chart(vec![])] }.draw());
        assert_eq!(&picture[1..4], b"PNG");
    }
}

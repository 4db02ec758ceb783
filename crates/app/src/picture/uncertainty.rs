//! What uncertain keys do to the results of a sweep: for each result its distribution, and bars of the indices of the keys.

use super::labels::Labels;
use crate::sweep::{Estimate, Spread, Uncertainty, What};
use percoat_case::case::NamedKey;
use percoat_case::units::Units;
use percoat_core::quantity::Kind;
use percoat_draw::Label;
use percoat_draw::axis::Axis;
use percoat_draw::canvas::{Anchor, Canvas};
use percoat_draw::chart::{Chart, Plot};
use percoat_draw::colour::Colour;
use percoat_draw::curve::{Curve, Ink, Style};
use percoat_draw::number::short;
use percoat_draw::sheet::{HAIR, LABELS, Margins, NUMBERS, Panel, sheet};

/// Results that are drawn, at most.
const RESULTS: usize = 6;
/// Keys with bars, at most: those with the largest total indices.
const KEYS: usize = 6;
/// Height of a key with its name and bars, and of a bar; points.
const ROW: f64 = 20.0;
const BAR: f64 = 3.6;
/// Height of the axis below the bars, points.
const AXIS: f64 = 22.0;
/// Ratio of height and width of a distribution.
const ASPECT: f64 = 0.55;

/// The picture; `None` where no main result spreads. `keys`: the names of the uncertain keys.
pub fn uncertainty(title: &str, units: &Units, keys: &[NamedKey], found: &Uncertainty) -> Option<Canvas> {
    let shown: Vec<&Spread> = found.shown().take(RESULTS).collect();
    let draws = shown.first()?.draws.len();
    let names: Vec<String> = keys.iter().map(|key| units.key_of(key).text().to_owned()).collect();
    let charts: Vec<Chart> = shown.iter().map(|spread| distribution(spread, units)).collect();
    let plots: Vec<Plot<'_>> = charts.iter().map(|chart| Plot { chart, aspect: ASPECT }).collect();
    let bars: Vec<Bars> = shown.iter().map(|spread| Bars::of(spread, &names)).collect();
    let panels: Vec<&dyn Panel> =
        plots.iter().zip(&bars).flat_map(|(plot, bars)| [plot as &dyn Panel, bars as &dyn Panel]).collect();
    let title = if title.is_empty() { String::new() } else { format!("{}; ", title.trim_end_matches('.')) };
    let caption = format!(
        "{title}{draws} draws of {}. Left: the part of all draws below a value. Right: the part of the variance that a key makes, \
         blue with all its interactions (total index), pale by itself (first-order index); thin lines: 95 % intervals of the sampling.",
        found.keys()
    );
    Some(sheet(&caption, &panels))
}

fn label(spread: &Spread, units: &Units) -> Label {
    match &spread.what {
        What::Quantity(named, name, _) if named.name == *name => units.label(named),
        What::Quantity(_, name, _) => name.clone().into(),
        What::Limit(quantity, name) => units.clone().with_loads_in(*quantity).load_of(name),
    }
}

/// The part of all known draws below each value; a curve that does not reach 1 has draws beyond what was searched.
fn distribution(spread: &Spread, units: &Units) -> Chart {
    let mut known: Vec<f64> = spread.draws.iter().copied().filter(|value| !value.is_nan()).collect();
    known.sort_by(f64::total_cmp);
    let part = |index: usize| (index as f64 + 0.5) / known.len() as f64;
    let points = known.iter().enumerate().filter(|(_, value)| value.is_finite());
    let points = points.map(|(index, &value)| [value, part(index)]).collect();
    let label = label(spread, units);
    let is_passes = matches!(spread.what, What::Quantity(named, ..) if named.kind == Kind::Passes);
    let mut x = if is_passes { Axis::log(label) } else { Axis::linear(label) };
    let marked = spread.statistics.quantiles.iter().zip(["5 %", "50 %", "95 %"]);
    x.marks = marked.filter(|(at, _)| at.value.is_finite()).map(|(at, word)| (at.value, word.to_owned())).collect();
    let curve = Curve { label: String::new(), points, errors: Vec::new(), style: Style::Line, colour: Ink::Number(1) };
    let title = if spread.is_below_the_grid() { "the grid errs by more than this spreads" } else { "" };
    Chart {
        title: title.to_owned(),
        x,
        y: Axis::linear("part of the draws below").from_to(0.0, 1.0),
        curves: vec![curve],
    }
}

/// Bars of the indices of the keys of a result, the largest total index first.
struct Bars {
    /// Name of a key with its first-order and total index.
    rows: Vec<(String, [Estimate; 2])>,
}

impl Bars {
    fn of(spread: &Spread, names: &[String]) -> Self {
        let indices = &spread.statistics.indices;
        let mut rows: Vec<(String, [Estimate; 2])> = names.iter().cloned().zip(indices.iter().copied()).collect();
        rows.retain(|(_, [_, total])| total.value.is_finite());
        rows.sort_by(|(_, [_, a]), (_, [_, b])| b.value.total_cmp(&a.value));
        rows.truncate(KEYS);
        Self { rows }
    }
}

impl Panel for Bars {
    fn title(&self) -> &str {
        ""
    }

    fn margins(&self, _width: f64) -> Margins {
        Margins::default()
    }

    fn height(&self, _width: f64, margins: Margins) -> f64 {
        margins.top + ROW * self.rows.len() as f64 + AXIS
    }

    fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2], width: f64, margins: Margins) {
        let (left, right) = (ox + 0.5 * margins.left, ox + width - NUMBERS);
        let (top, bottom) = (oy + margins.top, oy + margins.top + ROW * self.rows.len() as f64);
        let place = |index: f64| left + index.clamp(0.0, 1.0) * (right - left);
        for (row, (name, indices)) in self.rows.iter().enumerate() {
            let y = top + ROW * row as f64;
            let words = format!("{name}: {}", short((100.0 * indices[1].value).round() / 100.0));
            canvas.label(&words, [left + 2.0, y + 0.5 * NUMBERS], Anchor::Left, NUMBERS, Colour::BLACK);
            let blue = Colour::line(1);
            // The total index above the first-order one.
            for (bar, (index, colour)) in indices.iter().rev().zip([blue, blue.lighter(0.6)]).enumerate() {
                let [y0, y1] = [0.0, BAR].map(|down| y + 1.25 * NUMBERS + bar as f64 * BAR + down);
                let end = place(index.value);
                canvas.area(&[[left, y0], [end, y0], [end, y1], [left, y1]], colour);
                let middle = 0.5 * (y0 + y1);
                canvas.line(&[[place(index.low), middle], [place(index.high), middle]], HAIR, Colour::BLACK);
            }
        }
        canvas.line(&[[left, top], [left, bottom], [right, bottom]], HAIR, Colour::BLACK);
        for tick in [0.0, 0.5, 1.0] {
            canvas.line(&[[place(tick), bottom], [place(tick), bottom - 2.0]], HAIR, Colour::BLACK);
            canvas.label(&short(tick), [place(tick), bottom + NUMBERS], Anchor::Centre, NUMBERS, Colour::BLACK);
        }
        let middle = [0.5 * (left + right), bottom + 2.2 * NUMBERS];
        canvas.label("part of the variance", middle, Anchor::Centre, LABELS, Colour::BLACK);
    }
}

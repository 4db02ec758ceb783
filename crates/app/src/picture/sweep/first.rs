//! Map of the criterion that comes first, over two keys of a sweep: in colours, with the names of the criteria below.

use crate::sweep::Foremost;
use percoat_draw::canvas::{Anchor, Canvas};
use percoat_draw::colour::Colour;
use percoat_draw::map::Map;
use percoat_draw::sheet::{HAIR, Margins, NUMBERS, Panel};
use percoat_draw::text;

/// Side of a sample of a colour, and its distance from its name, points.
const SAMPLE: f64 = 0.8 * NUMBERS;
const GAP: f64 = 3.0;
/// Height of a name.
const ROW: f64 = 1.4 * NUMBERS;

/// The colour of a criterion by its place among all; what does not fail is white.
pub fn colour(first: Foremost, index: usize) -> Colour {
    match first {
        Foremost::Undecided | Foremost::Nothing => Colour::WHITE,
        // Six colours, then six paler ones.
        Foremost::Criterion(_) => Colour::line(index + 1).lighter(if index % 12 < 6 { 0.0 } else { 0.55 }),
    }
}

/// A map with the names of its colours.
pub struct NamedMap<'a> {
    pub map: Map<'a>,
    pub names: Vec<(Colour, String)>,
}

impl NamedMap<'_> {
    /// Positions of the samples relative to the corner of the names, and the height of all, at a width.
    fn places(&self, width: f64) -> (Vec<[f64; 2]>, f64) {
        let widths = self.names.iter().map(|(_, name)| SAMPLE + GAP + text::width(name, NUMBERS) + 3.0 * GAP);
        let pitch = widths.fold(1.0, f64::max);
        let columns = ((width / pitch) as usize).clamp(1, self.names.len().max(1));
        let place = |k: usize| [(k % columns) as f64 * pitch, (k / columns) as f64 * ROW];
        let rows = self.names.len().div_ceil(columns);
        ((0..self.names.len()).map(place).collect(), rows as f64 * ROW + GAP)
    }
}

impl Panel for NamedMap<'_> {
    fn title(&self) -> &str {
        self.map.title()
    }

    fn margins(&self, width: f64) -> Margins {
        self.map.margins(width)
    }

    fn height(&self, width: f64, margins: Margins) -> f64 {
        self.map.height(width, margins) + self.places(width - margins.left).1
    }

    fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2], width: f64, margins: Margins) {
        self.map.draw(canvas, [ox, oy], width, margins);
        let corner = [ox + margins.left, oy + self.map.height(width, margins) + GAP];
        for ([x, y], (colour, name)) in self.places(width - margins.left).0.into_iter().zip(&self.names) {
            let [left, top] = [corner[0] + x, corner[1] + y + 0.5 * (ROW - SAMPLE)];
            let sample = [[left, top], [left + SAMPLE, top], [left + SAMPLE, top + SAMPLE], [left, top + SAMPLE]];
            canvas.area(&sample, *colour);
            canvas.outline(&sample, 0.5 * HAIR, Colour::BLACK);
            let middle = [left + SAMPLE + GAP, top + 0.5 * SAMPLE];
            canvas.label(name, middle, Anchor::Left, NUMBERS, Colour::BLACK);
        }
    }
}

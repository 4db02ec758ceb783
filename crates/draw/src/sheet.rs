//! Panels side by side on one sheet, each with its title, above a common caption.

use super::canvas::{Anchor, COLUMN, Canvas};
use super::colour::Colour;
use super::text::wrapped;

/// Size of the numbers on axes, points.
pub const NUMBERS: f64 = 7.0;
/// Size of the labels of axes, points.
pub const LABELS: f64 = 7.5;
/// Size of titles, points.
pub const TITLES: f64 = 8.0;
/// Size of captions, points.
pub const CAPTIONS: f64 = 6.5;
/// Width of frames, points.
pub const HAIR: f64 = 0.6;
/// Distance from the border of the sheet and between panels, points.
const MARGIN: f64 = 5.0;
/// Line spacing over the size of the letters.
const LEADING: f64 = 1.3;

/// Margins of a panel around its plot, points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Margins {
    /// Margin for the numbers and the label of the vertical axis.
    pub left: f64,
    /// Margin for a colour bar.
    pub right: f64,
    /// Margin for a power of ten.
    pub top: f64,
}

impl Margins {
    /// The larger one of two margins on each side.
    pub fn union(self, other: Self) -> Self {
        Self { left: self.left.max(other.left), right: self.right.max(other.right), top: self.top.max(other.top) }
    }
}

/// A part of a picture.
pub trait Panel {
    /// Title above the panel.
    fn title(&self) -> &str;
    /// Margins that the panel needs around its plot at a width; points.
    fn margins(&self, width: f64) -> Margins;
    /// Height of the panel without its title, at a width and with margins; points.
    fn height(&self, width: f64, margins: Margins) -> f64;
    /// Draws the panel without its title, its upper left corner at `corner`.
    fn draw(&self, canvas: &mut Canvas, corner: [f64; 2], width: f64, margins: Margins);
}

/// Puts panels on a sheet, two in a row.
pub fn sheet(caption: &str, panels: &[&dyn Panel]) -> Canvas {
    let columns = panels.len().clamp(1, 2);
    let width = COLUMN * columns as f64;
    let inner = width - 2.0 * MARGIN;
    let panel_width = (inner - 2.0 * MARGIN * (columns - 1) as f64) / columns as f64;
    let mut canvas = Canvas::new([width, 0.0]);
    let mut y = MARGIN;
    // All plots of a sheet are aligned.
    let all = panels.iter().map(|panel| panel.margins(panel_width)).fold(Margins::default(), Margins::union);
    for row in panels.chunks(columns) {
        let top = row.iter().map(|panel| panel.margins(panel_width).top).fold(0.0, f64::max);
        let margins = Margins { top, ..all };
        let lines = |text: &str| wrapped(text, TITLES, panel_width).len() as f64;
        let head = row.iter().map(|panel| lines(panel.title())).fold(0.0, f64::max) * LEADING * TITLES;
        let mut deepest: f64 = 0.0;
        for (column, panel) in row.iter().enumerate() {
            let x = MARGIN + column as f64 * (panel_width + 2.0 * MARGIN);
            paragraph(&mut canvas, panel.title(), [x, y], TITLES, panel_width, Colour::BLACK);
            panel.draw(&mut canvas, [x, y + head], panel_width, margins);
            deepest = deepest.max(y + head + panel.height(panel_width, margins));
        }
        y = deepest + MARGIN;
    }
    y += paragraph(&mut canvas, caption, [MARGIN, y - 0.5 * MARGIN], CAPTIONS, inner, Colour::GREY);
    canvas.size[1] = y;
    canvas
}

/// Draws a text, broken to the width, below `corner`; returns its height.
fn paragraph(canvas: &mut Canvas, text: &str, corner: [f64; 2], size: f64, width: f64, colour: Colour) -> f64 {
    let lines = wrapped(text, size, width);
    for (number, line) in (1..).zip(&lines) {
        let baseline = corner[1] + f64::from(number) * LEADING * size - 0.35 * size;
        canvas.text(line, [corner[0], baseline], Anchor::Left, size, colour);
    }
    lines.len() as f64 * LEADING * size
}

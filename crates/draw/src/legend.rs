//! The legend of a chart: where it covers no curve, or else below the chart.

use super::canvas::Canvas;
use super::curve::{Curve, TEXT_GAP};
use super::sheet::NUMBERS;
use super::text;

/// Length of the piece of line before an entry, points.
const PIECE: f64 = 16.0;
/// Distance around the legend, points.
pub const GAP: f64 = 3.5;
/// Height of an entry, points.
const ROW: f64 = 1.4 * NUMBERS;

/// A legend laid out.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend {
    /// Index of the curve, text and upper left corner relative to the legend's of each entry.
    entries: Vec<(usize, String, [f64; 2])>,
    /// Width and height, points.
    pub size: [f64; 2],
}

impl Legend {
    /// Legend with entries in as many columns of equal width as fit into `width` points, at least one and at most `most`; `None`
    /// without entries. Labels are [fitted](text::fitted) into the width.
    pub fn new(curves: &[Curve], width: f64, most: usize) -> Option<Self> {
        let room = width - PIECE - TEXT_GAP - 3.0 * GAP;
        let named = curves.iter().enumerate().filter(|(_, curve)| !curve.label.is_empty());
        let texts: Vec<(usize, String)> =
            named.map(|(index, curve)| (index, text::fitted(&curve.label, NUMBERS, room))).collect();
        let widest = texts.iter().map(|(_, text)| text::width(text, NUMBERS)).fold(0.0, f64::max);
        let (pitch, count) = (PIECE + TEXT_GAP + widest + 3.0 * GAP, texts.len());
        let columns = ((width / pitch) as usize).clamp(1, count.clamp(1, most));
        let rows = count.div_ceil(columns);
        let place = |k: usize| [GAP + (k / rows) as f64 * pitch, 0.5 * GAP + (k % rows) as f64 * ROW];
        let entries = texts.into_iter().enumerate().map(|(k, (index, text))| (index, text, place(k))).collect();
        (count > 0).then_some(Self { entries, size: [columns as f64 * pitch - GAP, rows as f64 * ROW + GAP] })
    }

    /// Upper left corner of a place in the plot (given by corner and size) that covers no point of `taken`; `None` without one.
    pub fn free_place(&self, [x, y]: [f64; 2], [width, height]: [f64; 2], taken: &[[f64; 2]]) -> Option<[f64; 2]> {
        const STEPS: u8 = 6;
        let free = [width - self.size[0] - 2.0 * GAP, height - self.size[1] - 2.0 * GAP];
        if free[0] < 0.0 || free[1] < 0.0 || self.size[1] > 0.6 * height {
            return None;
        }
        let mut places: Vec<[u8; 2]> = (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| [i, j])).collect();
        // Corners first, then along the borders, the upper right one before all.
        let inside = |k: u8| k.min(STEPS - k);
        places.sort_by_key(|&[i, j]| (inside(i).min(inside(j)), inside(i) + inside(j), j, STEPS - i));
        let corner = |[i, j]: [u8; 2]| {
            let part = |k: u8| f64::from(k) / f64::from(STEPS);
            [x + GAP + part(i) * free[0], y + GAP + part(j) * free[1]]
        };
        places.into_iter().map(corner).find(|[left, top]| {
            let near = |&[px, py]: &[f64; 2]| {
                px > left - GAP && px < left + self.size[0] + GAP && py > top - GAP && py < top + self.size[1] + GAP
            };
            !taken.iter().any(near)
        })
    }

    /// Draws the entries with the upper left corner at `corner`.
    pub fn draw(&self, canvas: &mut Canvas, corner: [f64; 2], curves: &[Curve]) {
        for (index, text, [dx, dy]) in &self.entries {
            let middle = [corner[0] + dx, corner[1] + dy + 0.5 * ROW];
            curves[*index].entry(text, canvas, middle, PIECE);
        }
    }
}

//! Lines of a path beyond the window of an isolated contact.
//!
//! Stresses that a point meets on its way past the contact do not end at the window: stiff layers bend, and the tension
//! of the surface or the shear of an interface may be largest several contact radii away. So each line of the window
//! goes on in the [windows around it](super::surroundings), to the distance from which stresses only decay. Between
//! four neighbouring lines of such a window its stresses are those of the cubic through them: there the waves of the
//! pressure have been cut so that samples are dense.
//!
//! Lines beside the window are left out: they pass the contact at a distance, and meet what those through it meet on their way, and less.

use super::field::StressField;
use super::line_plane::{Kept, LinePlane, LineStresses};
use super::loaded_window::MOST_WINDOWS;
use crate::body::Depth;
use crate::lattice::Cell;

/// A plane in a window around that of an isolated contact.
#[derive(Debug)]
pub(super) struct PlaneAround {
    plane: LinePlane,
    cell: Cell,
    /// y of its lines, ascending, with their numbers.
    lines: Vec<(f64, usize)>,
}

impl StressField {
    /// Number of windows around that of an isolated contact up to the distance from which stresses only decay; none of a periodic system.
    pub(super) fn windows_around(&self) -> u32 {
        let Some(loaded) = self.loaded.as_ref().filter(|_| !self.has_hole()) else { return 0 };
        (1..=MOST_WINDOWS).take_while(|number| loaded.extent.margin(number - 1) < loaded.reach).count() as u32
    }

    /// Part of the stresses that the waves left out around the window may add to those of a line.
    pub(super) fn left_out_of_lines(&self) -> f64 {
        let around = self.loaded.as_ref().filter(|_| self.windows_around() > 0);
        around.map_or(0.0, |loaded| loaded.extent.left_out(1))
    }

    /// The field of the window around which holds a place, lengths, or of the last one.
    pub(super) fn holding(&self, place: [f64; 2]) -> &Self {
        let around = (1..=self.windows_around()).filter_map(|number| self.around(number));
        std::iter::once(self)
            .chain(around)
            .reduce(|a, b| if a.grid().cell().contains(place) { a } else { b })
            .unwrap_or(self)
    }

    /// The planes of a depth around the window, from the inner one outward, with lines along a direction, a unit vector.
    pub(super) fn planes_around(&self, direction: [f64; 2], depth: Depth, kept: Kept) -> Vec<PlaneAround> {
        let of = |number: u32| {
            let (wide, loaded) = (self.around(number)?, self.loaded.as_ref()?);
            let (lines, cell) = (wide.sliding_lines(direction), wide.grid().cell());
            let plane = wide.line_plane(&lines, depth, loaded.extent.radii(number)[0], kept);
            let of_line = |line: usize| Some((lines.y(plane.first_place(cell, line)?), line));
            let mut all: Vec<(f64, usize)> = (0..plane.count()).filter_map(of_line).collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            Some(PlaneAround { plane, cell, lines: all })
        };
        (1..=self.windows_around()).filter_map(of).collect()
    }
}

impl PlaneAround {
    /// Window of the plane.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// Adds the samples of the line at y that lie before the first one of a line and behind its last one, which is that of the window within
    /// the `hole`.
    pub fn lengthen(&self, line: &mut LineStresses, y: f64, hole: Cell) {
        let axis = self.plane.advance();
        let Some(middle) = line.places.get(line.places.len() / 2).map(|&place| self.cell.fractions(place)[axis]) else {
            return;
        };
        let [mut before, mut behind] = [LineStresses::default(), LineStresses::default()];
        let after = self.lines.partition_point(|(at, _)| *at <= y);
        let first = after.saturating_sub(2).min(self.lines.len().saturating_sub(4));
        let beside = self.lines.get(first..first + 4).unwrap_or_default();
        let weight =
            |at: f64| beside.iter().filter(|(y, _)| *y != at).map(|(other, _)| (y - other) / (at - other)).product();
        let weights: Vec<(f64, usize)> = beside.iter().map(|&(at, line)| (weight(at), line)).collect();
        for row in 0..self.plane.rows() {
            let Some(sample) = self.plane.combined(self.cell, row, &weights) else { continue };
            let Some(&place) = sample.places.first() else { continue };
            if hole.contains(place) {
                continue;
            }
            let side = if self.cell.fractions(place)[axis] < middle { &mut before } else { &mut behind };
            side.append(sample);
        }
        line.lengthen(before, behind);
    }
}

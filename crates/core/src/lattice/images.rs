//! Images of a place: all equivalent ones in a periodic cell, the place alone in a window.

use super::{Cell, ReducedBasis, Surroundings};

/// Part of the shortest lattice vector within which a place is nearest to its own centre, to rounding.
const NEARLY_HALF: f64 = 0.499;

impl Cell {
    /// Distance from a point within which everything is nearer to it than to its images, a length; infinite in a window.
    pub(crate) fn clear_radius(&self) -> f64 {
        match self.surroundings() {
            Surroundings::Periodic => {
                let [x, y] = self.reduced().short();
                NEARLY_HALF * x.hypot(y)
            }
            Surroundings::FreeSpace => f64::INFINITY,
        }
    }

    /// Distance of a point from the border of a window around 0, a length; infinite in a periodic cell.
    pub(crate) fn border_distance(&self, place: [f64; 2]) -> f64 {
        let within = |[width, height]: [f64; 2]| (0.5 * width - place[0].abs()).min(0.5 * height - place[1].abs());
        self.window_sides().map_or(f64::INFINITY, within)
    }

    /// Whether the place at an `offset` from a `centre`, lengths, belongs to it: no image of the centre is nearer, or the place lies in the
    /// window. `reduced` is the basis of the cell, `rounding` a length by which two images may differ.
    pub(crate) fn belongs(&self, reduced: &ReducedBasis, centre: [f64; 2], offset: [f64; 2], rounding: f64) -> bool {
        let [x, y] = offset;
        match self.surroundings() {
            Surroundings::Periodic => {
                let [nearest_x, nearest_y] = reduced.nearest(self.parts(offset));
                (nearest_x - x).abs().max((nearest_y - y).abs()) <= rounding
            }
            Surroundings::FreeSpace => {
                self.fractions([centre[0] + x, centre[1] + y]).iter().all(|s| (0.0..1.0).contains(s))
            }
        }
    }

    /// The shortest vector equivalent to a vector, lengths: the vector itself in a window.
    pub(crate) fn shortest_equivalent(&self, vector: [f64; 2]) -> [f64; 2] {
        match self.surroundings() {
            Surroundings::Periodic => self.reduced().nearest(self.parts(vector)),
            Surroundings::FreeSpace => vector,
        }
    }

    /// All vectors equivalent to a vector that are shorter than `reach`, lengths; the vector alone in a window.
    pub(crate) fn equivalents_within(&self, vector: [f64; 2], reach: f64) -> Vec<[f64; 2]> {
        let is_within = |[x, y]: &[f64; 2]| x.hypot(*y) < reach;
        match self.surroundings() {
            Surroundings::FreeSpace => Some(vector).filter(is_within).into_iter().collect(),
            Surroundings::Periodic => {
                let (parts, vectors) = (self.parts(vector), self.vectors());
                // In periods along both vectors: the disc of the reach lies between two parallels.
                let span = |axis: usize| {
                    let [x, y] = vectors[1 - axis];
                    let most = reach * x.hypot(y) / self.area();
                    (-parts[axis] - most).ceil() as i64..=(-parts[axis] + most).floor() as i64
                };
                let all = span(0).flat_map(|m| span(1).map(move |n| [m, n]));
                let image = |[m, n]: [i64; 2]| self.vector([parts[0] + m as f64, parts[1] + n as f64]);
                all.map(image).filter(is_within).collect()
            }
        }
    }

    /// All images in a rectangle, [first, last] along x and along y, of the place at the fractions `place` of a₁ and a₂; lengths.
    pub fn images_in(&self, place: [f64; 2], [[x0, x1], [y0, y1]]: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
        let is_inside = |[x, y]: &[f64; 2]| (x0..=x1).contains(x) && (y0..=y1).contains(y);
        if self.surroundings() == Surroundings::FreeSpace {
            return [self.point(place)].into_iter().filter(is_inside).collect();
        }
        let reduced = self.reduced().cell();
        let fractions = reduced.fractions(self.point(place));
        let corners = [[x0, y0], [x0, y1], [x1, y0], [x1, y1]].map(|corner| reduced.fractions(corner));
        // Multiples of the reduced vectors that may move the place into the rectangle.
        let range = |k: usize| {
            let parts = corners.iter().map(|corner| corner[k] - fractions[k]);
            let [low, high] = parts.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            (low - 1e-9).ceil() as i64..=(high + 1e-9).floor() as i64
        };
        let multiples = range(0).flat_map(|i| range(1).map(move |j| [i as f64, j as f64]));
        let images = multiples.map(|[i, j]| reduced.point([fractions[0] + i, fractions[1] + j]));
        images.filter(is_inside).collect()
    }

    /// Indices of the last of `points` along a₁ and a₂ where the border of a cell is drawn on both sides: those of a periodic cell are the
    /// first ones again.
    pub fn last_points(&self, points: [usize; 2]) -> [usize; 2] {
        match self.surroundings() {
            Surroundings::Periodic => points,
            Surroundings::FreeSpace => points.map(|n| n - 1),
        }
    }

    /// A window `factor` times as wide and as high around 0; `None` for a periodic cell, which has its size.
    pub(crate) fn widened(&self, factor: f64) -> Option<Self> {
        Self::window(self.window_sides()?.map(|side| factor * side)).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_images_in_a_cell_and_none_in_a_window() {
        let [cell, window] = [Cell::square(2.0), Cell::window([2.0; 2])].map(Result::unwrap);
        assert_eq!(
            (cell.shortest_equivalent([1.5, 0.0]), window.shortest_equivalent([1.5, 0.0])),
            ([-0.5, 0.0], [1.5, 0.0])
        );
        let within = |cell: Cell| cell.equivalents_within([1.0, 0.0], 1.1).len();
        assert_eq!((within(cell), within(window)), (2, 1));
        let inside = |cell: Cell| cell.images_in([0.5; 2], [[-3.5, 3.5], [-0.5, 1.5]]).len();
        assert_eq!((inside(cell), inside(window)), (4, 1));
        assert_eq!((window.border_distance([0.3, 0.1]), cell.border_distance([0.3, 0.1])), (0.7, f64::INFINITY));
        let belongs = |cell: Cell, x: f64| cell.belongs(&cell.reduced(), [0.8, 0.0], [x, 0.0], 1e-6);
        assert_eq!(
            [belongs(cell, 0.9), belongs(cell, 1.1), belongs(window, 0.1), belongs(window, 0.3)],
            [true, false, true, false]
        );
        assert!((cell.clear_radius() - 0.998).abs() < 1e-12 && window.clear_radius() == f64::INFINITY);
        assert_eq!((cell.widened(2.0), window.widened(2.0)), (None, Some(Cell::window([4.0; 2]).unwrap())));
    }
}

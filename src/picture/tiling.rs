//! The cell repeated over a window of the surface, true to scale.

use super::snapshot::Snapshot;
use crate::lattice::{Cell, Grid};

/// A rectangle of the surface, [first, last] along x and along y; lengths.
pub type Window = [[f64; 2]; 2];

/// A window of at least two by two cells around the middle of the unit cell.
pub fn window(cell: Cell) -> Window {
    let reduced = cell.reduced();
    let long = reduced.longer_side();
    // Rows of cells are area/long apart; of a slender cell several are shown.
    let rows = (1.2 * long * long / cell.area()).max(2.0);
    let half = [long, 0.5 * rows * cell.area() / long];
    // The longer vector of the reduced cell lies along x in all named lattices; otherwise a square shows as much.
    let [[x1, y1], [x2, y2]] = cell.vectors();
    let half = if y1 == 0.0 { half } else { [half[0].max(half[1]); 2] };
    let middle = [0.5 * (x1 + x2), 0.5 * (y1 + y2)];
    [0, 1].map(|k| [middle[k] - half[k], middle[k] + half[k]])
}

/// All places in the window that are equivalent to the place given in fractions of a₁, a₂.
pub fn images(cell: Cell, place: [f64; 2], window: Window) -> Vec<[f64; 2]> {
    let [[x0, x1], [y0, y1]] = window;
    let corners = [[x0, y0], [x1, y0], [x0, y1], [x1, y1]].map(|corner| cell.fractions(corner));
    let span = |k: usize| {
        let all = corners.map(|s| s[k] - place[k]);
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        let most = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        least.floor() as i64..=most.ceil() as i64
    };
    let mut images = Vec::new();
    for (i, j) in span(0).flat_map(|i| span(1).map(move |j| (i, j))) {
        let [x, y] = cell.point([place[0] + i as f64, place[1] + j as f64]);
        if x >= x0 && x <= x1 && y >= y0 && y <= y1 {
            images.push([x, y]);
        }
    }
    images
}

/// Corners of the unit cell.
pub fn cell_corners(cell: Cell) -> [[f64; 2]; 4] {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|s| cell.point(s))
}

/// The four samples around a place and their bilinear weights.
pub fn around(grid: &Grid, place: [f64; 2]) -> [(usize, f64); 4] {
    let [n1, n2] = grid.points();
    let [s, t] = grid.cell().fractions(place);
    let (u, v) = ((s - s.floor()) * n1 as f64, (t - t.floor()) * n2 as f64);
    let (i, j) = (u as usize % n1, v as usize % n2);
    let (u, v) = (u - u.floor(), v - v.floor());
    let (next_i, next_j) = ((i + 1) % n1, (j + 1) % n2);
    [
        (i * n2 + j, (1.0 - u) * (1.0 - v)),
        (i * n2 + next_j, (1.0 - u) * v),
        (next_i * n2 + j, u * (1.0 - v)),
        (next_i * n2 + next_j, u * v),
    ]
}

impl Snapshot {
    /// Pressure at a place; `None` outside contact. Between samples on both sides of the edge the fitted boundary
    /// decides, or where there is none the nearer samples.
    pub fn pressure_at(&self, place: [f64; 2]) -> Option<f64> {
        let (mut weight, mut sum, mut touching, mut site) = (0.0, 0.0, 0, None);
        for (index, part) in around(self.grid(), place) {
            let p = self.pressures()[index];
            if p > 0.0 {
                weight += part;
                sum += part * p;
                touching += 1;
                site = self.surface().owners().get(index).copied();
            }
        }
        if touching == 0 {
            return None;
        }
        let is_inside =
            match site.map(|site| site as usize).and_then(|site| Some((site, self.boundaries()[site].as_ref()?))) {
                Some((site, boundary)) if touching < 4 => {
                    let cell = self.grid().cell();
                    let (s, t) = (cell.fractions(place), self.surface().sites()[site].place);
                    let [x, y] = cell.reduced().nearest([s[0] - t[0], s[1] - t[1]]);
                    (boundary.hole_radius(y.atan2(x))..boundary.radius(y.atan2(x))).contains(&x.hypot(y))
                }
                _ => weight >= 0.5,
            };
        (is_inside && weight > 0.0).then(|| sum / weight)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_holds_four_cells_and_every_site_four_times() {
        for cell in [Cell::hexagonal(3f64.sqrt()).unwrap(), Cell::square(2.0).unwrap()] {
            let window = window(cell);
            let area: f64 = window.iter().map(|[first, last]| last - first).product();
            assert!((area / cell.area() - 4.0).abs() < 1e-12);
            for place in [[0.31, 0.17], [0.6, 0.77], [0.99, 0.52]] {
                let images = images(cell, place, window);
                assert_eq!(images.len(), 4);
                for image in images {
                    let s = cell.fractions(image);
                    assert!((0..2).all(|k| ((s[k] - place[k]) - (s[k] - place[k]).round()).abs() < 1e-12));
                }
            }
        }
    }

    #[test]
    fn samples_around_a_place_make_up_the_place() {
        let grid = Grid::new(Cell::new([1.0, 0.1], [0.3, 1.4]).unwrap(), [12, 10]).unwrap();
        let place = [0.71, 0.42];
        let mut sum = [0.0; 2];
        for (index, weight) in around(&grid, place) {
            let sample = grid.cell().point(grid.fractions(index));
            sum = [0, 1].map(|k| sum[k] + weight * sample[k]);
        }
        assert!((sum[0] - place[0]).abs() < 1e-12 && (sum[1] - place[1]).abs() < 1e-12);
    }

    #[test]
    fn a_place_and_its_images_lie_between_the_same_samples() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [16, 16]).unwrap();
        let [a1, a2] = grid.cell().vectors();
        let here = around(&grid, [0.4, 0.3]);
        let there = around(&grid, [0.4 + 2.0 * a1[0] - a2[0], 0.3 + 2.0 * a1[1] - a2[1]]);
        assert!(here.iter().zip(there).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-9));
    }
}

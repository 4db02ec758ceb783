//! The cell repeated over a window of the surface.

use super::snapshot::Snapshot;
use percoat_core::lattice::{Grid, Surroundings};

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
    /// Whether a place is outside the window of an isolated contact.
    pub fn is_outside(&self, place: [f64; 2]) -> bool {
        let cell = self.step.grid().cell();
        cell.surroundings() == Surroundings::FreeSpace
            && cell.fractions(place).iter().any(|part| !(0.0..=1.0).contains(part))
    }

    /// The sample nearest to a place; `None` outside the window of an isolated contact.
    pub fn nearest(&self, place: [f64; 2]) -> Option<usize> {
        let [first, rest @ ..] = around(self.step.grid(), place);
        let heavier = |a: (usize, f64), b: (usize, f64)| if b.1 > a.1 { b } else { a };
        (!self.is_outside(place)).then(|| rest.into_iter().fold(first, heavier).0)
    }

    /// Stretches of a straight line with contact (`touching`) or without: their first and last point, as parts of the line.
    pub fn stretches(&self, [from, to]: [[f64; 2]; 2], touching: bool) -> Vec<[f64; 2]> {
        const STEPS: u32 = 800;
        let belongs = |part: f64| {
            let place = [0, 1].map(|k| from[k] + part * (to[k] - from[k]));
            self.pressure_at(place).is_some() == touching
        };
        let parts: Vec<f64> = (0..=STEPS).map(|k| f64::from(k) / f64::from(STEPS)).collect();
        let alike = parts.chunk_by(|a, b| belongs(*a) == belongs(*b));
        alike.filter(|run| run.len() > 1 && belongs(run[0])).map(|run| [run[0], run[run.len() - 1]]).collect()
    }

    /// A field, sample by sample, between its samples.
    pub fn between_samples(&self, field: &[f64], place: [f64; 2]) -> f64 {
        around(self.step.grid(), place).into_iter().map(|(index, part)| part * field[index]).sum()
    }

    /// Pressure at a place; `None` outside contact. Between samples on both sides of the edge the fitted boundary
    /// decides, or the distance from the edge where no boundary is fitted.
    pub fn pressure_at(&self, place: [f64; 2]) -> Option<f64> {
        let (mut weight, mut sum, mut touching, mut site) = (0.0, 0.0, 0, None);
        for (index, part) in around(self.step.grid(), place) {
            let p = self.pressures()[index];
            if p > 0.0 {
                weight += part;
                sum += part * p;
                touching += 1;
                site = self.step.surface().owners().get(index).copied();
            }
        }
        if touching == 0 {
            return None;
        }
        let is_inside =
            match site.map(|site| site as usize).and_then(|site| Some((site, self.reading.boundaries[site].as_ref()?)))
            {
                Some((site, boundary)) if touching < 4 => {
                    let cell = self.step.grid().cell();
                    let (s, t) = (cell.fractions(place), self.step.surface().sites()[site].place);
                    let [x, y] = cell.reduced().nearest([s[0] - t[0], s[1] - t[1]]);
                    (boundary.hole_radius(y.atan2(x))..boundary.radius(y.atan2(x))).contains(&x.hypot(y))
                }
                _ => touching == 4 || self.inside(place) > 0.0,
            };
        (is_inside && weight > 0.0).then(|| sum / weight)
    }
}

#[cfg(test)]
mod tests {
    use super::super::window::View;
    use super::*;
    use percoat_core::lattice::Cell;

    #[test]
    fn a_window_holds_four_cells_and_every_site_four_times() {
        for cell in [Cell::hexagonal(3f64.sqrt()).unwrap(), Cell::square(2.0).unwrap()] {
            let window = View::cells(cell).window;
            let area: f64 = window.iter().map(|[first, last]| last - first).product();
            assert!((area / cell.area() - 4.0).abs() < 1e-12);
            for place in [[0.31, 0.17], [0.6, 0.77], [0.99, 0.52]] {
                let images = cell.images_in(place, window);
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

//! Connected sets of samples of a periodic grid.

use crate::grid::Grid;

/// Samples joined along the grid's lines.
#[derive(Debug, Clone)]
pub struct Component {
    /// Samples and their places followed through the set, lengths.
    pub samples: Vec<(usize, [f64; 2])>,
    /// Whether it meets an image of itself.
    pub wraps: bool,
}

impl Component {
    /// Mean of the places.
    pub fn centre(&self) -> [f64; 2] {
        let count = self.samples.len() as f64;
        [0, 1].map(|k| self.samples.iter().map(|(_, place)| place[k]).sum::<f64>() / count)
    }

    /// Samples closer than `reach` to `centre`, each once, with their places relative to it.
    pub fn around(&self, grid: &Grid, centre: [f64; 2], reach: f64) -> Vec<(usize, [f64; 2])> {
        let [n1, n2] = grid.points();
        let (cell, n) = (grid.cell(), [n1 as f64, n2 as f64]);
        let middle = cell.fractions(centre);
        // The height of the cell over a side bounds the fractions of a place at that distance.
        let steps = grid.steps();
        let extent = [0, 1].map(|k| {
            let [x, y] = steps[1 - k];
            // Half a row more, by which the middle is rounded; no sample twice.
            let rows = (reach * x.hypot(y) / grid.sample_area() + 0.5).ceil();
            rows.min((0.5 * (n[k] - 1.0)).floor()) as i64
        });
        let first = [0, 1].map(|k| (middle[k] * n[k]).round() as i64);
        let mut found = Vec::new();
        for i in first[0] - extent[0]..=first[0] + extent[0] {
            for j in first[1] - extent[1]..=first[1] + extent[1] {
                let place = cell.point([i as f64 / n[0], j as f64 / n[1]]);
                let offset = [0, 1].map(|k| place[k] - centre[k]);
                if offset[0].hypot(offset[1]) < reach {
                    let index = i.rem_euclid(n1 as i64) as usize * n2 + j.rem_euclid(n2 as i64) as usize;
                    found.push((index, offset));
                }
            }
        }
        found
    }
}

/// The connected sets of the samples that are `members`.
pub fn components(grid: &Grid, members: impl Fn(usize) -> bool) -> Vec<Component> {
    let [n1, n2] = grid.points();
    let mut seen: Vec<Option<[i64; 2]>> = vec![None; grid.len()];
    let place = |[i, j]: [i64; 2]| grid.cell().point([i as f64 / n1 as f64, j as f64 / n2 as f64]);
    let mut found = Vec::new();
    for start in 0..grid.len() {
        if seen[start].is_some() || !members(start) {
            continue;
        }
        let here = [(start / n2) as i64, (start % n2) as i64];
        seen[start] = Some(here);
        let (mut samples, mut wraps, mut next) = (Vec::new(), false, vec![(start, here)]);
        while let Some((index, [i, j])) = next.pop() {
            samples.push((index, place([i, j])));
            for there in [[i + 1, j], [i - 1, j], [i, j + 1], [i, j - 1]] {
                let index = there[0].rem_euclid(n1 as i64) as usize * n2 + there[1].rem_euclid(n2 as i64) as usize;
                if !members(index) {
                    continue;
                }
                match seen[index] {
                    None => {
                        seen[index] = Some(there);
                        next.push((index, there));
                    }
                    Some(before) => wraps |= before != there,
                }
            }
        }
        found.push(Component { samples, wraps });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    #[test]
    fn a_spot_across_the_border_is_one_and_a_stripe_wraps() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let corner = |index: usize| [0, 7].contains(&(index / 8)) && [0, 7].contains(&(index % 8));
        let found = components(&grid, corner);
        assert!(found.len() == 1 && found[0].samples.len() == 4 && !found[0].wraps);
        let [x, y] = found[0].centre().map(|x| (x + 0.5).rem_euclid(1.0) - 0.5);
        assert!((x + 0.0625).abs() < 1e-12 && (y + 0.0625).abs() < 1e-12, "{x} {y}");
        assert_eq!(found[0].around(&grid, found[0].centre(), 0.1).len(), 4);
        assert!(components(&grid, |index| index / 8 == 3)[0].wraps);
    }
}

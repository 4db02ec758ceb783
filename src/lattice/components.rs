//! Connected sets of samples of a periodic grid: contact spots, and what is open between or inside them.

use crate::lattice::{Grid, Joined};

/// Samples that hang together.
#[derive(Debug, Clone)]
pub struct Component {
    /// Rows and columns of the samples, followed through the set over the borders of the cell.
    pub samples: Vec<[i32; 2]>,
    /// Whether it meets an image of itself.
    pub wraps: bool,
}

/// The sample of the cell that a row and a column beyond its borders repeat.
fn index([n1, n2]: [usize; 2], [i, j]: [i32; 2]) -> usize {
    // Most stand in the cell: a division costs more than all else that is done with a sample.
    let within = |k: i32, n: usize| match usize::try_from(k) {
        Ok(k) if k < n => k,
        _ => k.rem_euclid(n as i32) as usize,
    };
    within(i, n1) * n2 + within(j, n2)
}

fn place(grid: &Grid, [i, j]: [i32; 2]) -> [f64; 2] {
    let [n1, n2] = grid.points();
    grid.cell().point([f64::from(i) / n1 as f64, f64::from(j) / n2 as f64])
}

impl Component {
    /// Indices of the samples.
    pub fn indices(&self, grid: &Grid) -> impl Iterator<Item = usize> {
        let points = grid.points();
        self.samples.iter().map(move |sample| index(points, *sample))
    }

    /// Mean of the places, lengths.
    pub fn centre(&self, grid: &Grid) -> [f64; 2] {
        let count = self.samples.len() as f64;
        let sum =
            self.samples.iter().map(|sample| place(grid, *sample)).fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y]);
        sum.map(|x| x / count)
    }

    /// Distance of the farthest sample from a place.
    pub fn farthest(&self, grid: &Grid, [x, y]: [f64; 2]) -> f64 {
        let distance = |sample: &[i32; 2]| {
            let [own_x, own_y] = place(grid, *sample);
            (own_x - x).hypot(own_y - y)
        };
        self.samples.iter().map(distance).fold(0.0, f64::max)
    }
}

/// The connected sets of the samples that are `members`.
pub fn components(grid: &Grid, joined: Joined, members: impl Fn(usize) -> bool) -> Vec<Component> {
    const UNSEEN: [i32; 2] = [i32::MIN; 2];
    let points = grid.points();
    let ways: Vec<[i32; 2]> = grid.ways(joined).into_iter().flat_map(|way| [way, way.map(|k| -k)]).collect();
    let mut seen = vec![UNSEEN; grid.len()];
    let mut found = Vec::new();
    for start in 0..grid.len() {
        if seen[start] != UNSEEN || !members(start) {
            continue;
        }
        let here = [start / points[1], start % points[1]].map(|k| k as i32);
        seen[start] = here;
        // Those found, of which the last ones have not been looked around.
        let (mut samples, mut looked, mut wraps) = (vec![here], 0, false);
        while looked < samples.len() {
            let [i, j] = samples[looked];
            looked += 1;
            for there in ways.iter().map(|[rows, columns]| [i + rows, j + columns]) {
                let next = index(points, there);
                if seen[next] == UNSEEN && members(next) {
                    seen[next] = there;
                    samples.push(there);
                } else if seen[next] != UNSEEN {
                    wraps |= seen[next] != there;
                }
            }
        }
        found.push(Component { samples, wraps });
    }
    found
}

/// What is counted of the contact spots of a pressure.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Counts {
    /// Samples and sum of the pressure of each spot; those of few samples first.
    pub sizes: Vec<(usize, f64)>,
    /// Whether one meets an image of itself.
    pub wraps: bool,
}

impl Counts {
    /// Of spots of a pressure.
    pub fn of(spots: &[Component], grid: &Grid, pressure: &[f64]) -> Self {
        let size = |spot: &Component| (spot.samples.len(), spot.indices(grid).map(|index| pressure[index]).sum());
        let mut sizes: Vec<(usize, f64)> = spots.iter().map(size).collect();
        sizes.sort_by_key(|(size, _)| *size);
        Self { sizes, wraps: spots.iter().any(|spot| spot.wraps) }
    }

    /// Index of the spot up to which, from the smallest on, half of the load is carried; `None` without contact.
    pub fn half_load(&self) -> Option<usize> {
        let mut rest: f64 = 0.5 * self.sizes.iter().map(|(_, load)| load).sum::<f64>();
        self.sizes.iter().position(|(_, load)| {
            rest -= load;
            rest <= 0.0
        })
    }
}

/// Samples closer than `reach` to `centre`, each once, with their places relative to it; those half a cell away, which
/// stand on both sides, are left out.
pub fn around(grid: &Grid, centre: [f64; 2], reach: f64) -> impl Iterator<Item = (usize, [f64; 2])> {
    let n = grid.points().map(|n| n as f64);
    let middle = grid.cell().fractions(centre);
    // The height of the cell over a side bounds the fractions of a place at that distance.
    let steps = grid.steps();
    let range = [0, 1].map(|k| {
        let [x, y] = steps[1 - k];
        // Half a row more, by which the middle is rounded; no sample twice.
        let rows = (reach * x.hypot(y) / grid.sample_area() + 0.5).ceil();
        let rows = rows.min((0.5 * (n[k] - 1.0)).floor()) as i32;
        let first = (middle[k] * n[k]).round() as i32;
        first - rows..=first + rows
    });
    let [rows, columns] = range;
    rows.flat_map(move |i| columns.clone().map(move |j| [i, j])).filter_map(move |sample| {
        let [x, y] = place(grid, sample);
        let offset = [x - centre[0], y - centre[1]];
        (offset[0].hypot(offset[1]) < reach).then(|| (index(grid.points(), sample), offset))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;
    use std::f64::consts::PI;

    #[test]
    fn a_spot_across_the_border_is_one_and_a_stripe_wraps() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let corner = |index: usize| [0, 7].contains(&(index / 8)) && [0, 7].contains(&(index % 8));
        let found = components(&grid, Joined::AtEdges, corner);
        assert!(found.len() == 1 && found[0].samples.len() == 4 && !found[0].wraps);
        let centre = found[0].centre(&grid);
        let [x, y] = centre.map(|x| (x + 0.5).rem_euclid(1.0) - 0.5);
        assert!((x + 0.0625).abs() < 1e-12 && (y + 0.0625).abs() < 1e-12, "{x} {y}");
        assert!((found[0].farthest(&grid, centre) - 0.0625 * 2f64.sqrt()).abs() < 1e-12);
        let near: Vec<_> = around(&grid, centre, 0.1).collect();
        assert!(near.len() == 4 && near.iter().all(|&(index, _)| corner(index)));
        assert!(components(&grid, Joined::AtEdges, |index| index / 8 == 3)[0].wraps);
    }

    /// Cells of a square or oblique grid share corners with four more than the four at their edges, hexagons with none; the
    /// vectors that describe the cell do not matter.
    #[test]
    fn samples_at_corners_are_joined_where_cells_have_neighbours_there() {
        let joined = |a2: [f64; 2], set: &[[i32; 2]]| {
            let grid = Grid::new(Cell::new([1.0, 0.0], a2).unwrap(), [8, 8]).unwrap();
            let members: Vec<usize> = set.iter().map(|sample| index([8, 8], *sample)).collect();
            [Joined::AtEdges, Joined::AtCorners]
                .map(|joined| components(&grid, joined, |index| members.contains(&index)).len())
        };
        let [up, down] = [[[2, 2], [3, 3]], [[2, 3], [3, 2]]];
        for a2 in [[0.0, 1.0], [0.2, 0.9]] {
            assert_eq!((joined(a2, &up), joined(a2, &down)), ([2, 1], [2, 1]), "{a2:?}");
        }
        // The shorter diagonal of a rhombus of 60° leads to a neighbour, the longer one past two others.
        let hexagonal = [0.5, 0.75f64.sqrt()];
        assert_eq!((joined(hexagonal, &up), joined(hexagonal, &down)), ([2, 2], [1, 1]));
        // a₂ + a₁ in the place of a₂: the diagonals are (1, 0) + (−1, 1) and (1, 0) − (−1, 1).
        assert_eq!(joined([1.0, 1.0], &[[2, 2], [2, 3]]), [2, 1]);
        assert_eq!(joined([1.0, 1.0], &[[2, 2], [4, 1]]), [2, 1]);
        assert_eq!(joined([1.0, 1.0], &[[2, 2], [3, 3]]), [2, 2]);
    }

    /// Four samples around one meet at corners: one spot, with a hole that is not joined to what lies outside.
    #[test]
    fn a_ring_closed_at_corners_keeps_its_hole() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let ring = [[3, 4], [5, 4], [4, 3], [4, 5]].map(|sample| index([8, 8], sample));
        let spots = components(&grid, Joined::AtCorners, |index| ring.contains(&index));
        let open = components(&grid, Joined::AtEdges, |index| !ring.contains(&index));
        let sizes = |found: &[Component]| found.iter().map(|set| (set.samples.len(), set.wraps)).collect::<Vec<_>>();
        assert_eq!((sizes(&spots), sizes(&open)), (vec![(4, false)], vec![(59, true), (1, false)]));
    }

    #[test]
    fn half_of_the_load_decides_which_spot_counts() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = [0.0; 64];
        let counts = |pressure: &[f64]| {
            Counts::of(&components(&grid, Joined::AtCorners, |index| pressure[index] > 0.0), &grid, pressure)
        };
        assert_eq!((counts(&pressure), counts(&pressure).half_load()), (Counts::default(), None));
        // One sample of load 1, two of 1 each, four of 2 each.
        pressure[0] = 1.0;
        pressure[16..18].fill(1.0);
        pressure[36..40].fill(2.0);
        assert_eq!(counts(&pressure).sizes, [(1, 1.0), (2, 2.0), (4, 8.0)]);
        assert_eq!(counts(&pressure).half_load(), Some(2));
        pressure[0] = 20.0;
        assert_eq!(counts(&pressure).half_load(), Some(0));
    }

    #[test]
    fn what_is_near_is_counted_once_in_a_skewed_cell_too() {
        let grid = Grid::new(Cell::new([1.0, 0.0], [0.7, 0.6]).unwrap(), [30, 21]).unwrap();
        for reach in [0.02, 0.11, 0.29, 5.0] {
            let near: Vec<_> = around(&grid, [0.3, -0.2], reach).collect();
            let mut indices: Vec<usize> = near.iter().map(|(index, _)| *index).collect();
            indices.sort_unstable();
            indices.dedup();
            assert_eq!(indices.len(), near.len());
            // A disc that fits into the cell has as many samples as its area, up to its rim.
            if reach < 0.3 {
                let expected = PI * reach * reach / grid.sample_area();
                assert!(
                    (near.len() as f64 - expected).abs() < 3.0 * expected.sqrt() + 2.0,
                    "{} {expected}",
                    near.len()
                );
            }
        }
    }
}

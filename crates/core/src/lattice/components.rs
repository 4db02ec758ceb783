//! Connected components of the samples of a periodic grid: contact spots, and the open regions between and inside them.
//!
//! Consecutive samples of each row form runs, and runs that touch are joined (union–find). Each run keeps the number of cells
//! between it and the first run of its component; where two paths to a run disagree in it, the component is connected to an
//! image of itself.

use super::runs::SampleRun;
use super::{Connectivity, Grid};
use crate::numeric::parallel;
use std::ops::Range;

/// A connected component of samples.
#[derive(Debug, Clone)]
pub struct Component {
    /// Runs of the samples, continued over the borders of the cell; each within one cell.
    pub runs: Vec<SampleRun>,
    /// Whether it is connected to an image of itself.
    pub wraps: bool,
}

impl Component {
    /// Number of samples.
    pub fn size(&self) -> usize {
        self.runs.iter().map(SampleRun::len).sum()
    }

    /// Flat indices of the samples, run by run.
    pub fn indices(&self, grid: &Grid) -> impl Iterator<Item = Range<usize>> {
        let points = grid.points();
        self.runs.iter().map(move |run| {
            let first = run.index(points);
            first..first + run.len()
        })
    }

    /// Centre of area, lengths.
    pub fn centre(&self, grid: &Grid) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for run in &self.runs {
            let [first, last] = run.ends(grid);
            sum = [0, 1].map(|k| sum[k] + 0.5 * run.len() as f64 * (first[k] + last[k]));
        }
        sum.map(|x| x / self.size() as f64)
    }

    /// Distance of the farthest sample from a point, a length: of each run one of its ends is the farthest.
    pub fn farthest(&self, grid: &Grid, [x, y]: [f64; 2]) -> f64 {
        let ends = self.runs.iter().flat_map(|run| run.ends(grid));
        ends.map(|[own_x, own_y]| (own_x - x).hypot(own_y - y)).fold(0.0, f64::max)
    }
}

/// The contact spots of a `pressure`: samples in contact whose cells share an edge or a corner; merged contacts are one.
pub fn contact_spots(grid: &Grid, pressure: &[f64]) -> Vec<Component> {
    components(grid, Connectivity::EdgesAndCorners, |index| pressure[index] > 0.0)
}

/// The open regions between and inside the contact spots of a `pressure`: open samples whose cells share an edge.
pub fn open_regions(grid: &Grid, pressure: &[f64]) -> Vec<Component> {
    components(grid, Connectivity::Edges, |index| pressure[index] <= 0.0)
}

/// Connected components of the samples that are `members`, in the order of their first samples.
pub fn components(grid: &Grid, connectivity: Connectivity, members: impl Fn(usize) -> bool + Sync) -> Vec<Component> {
    let [n1, n2] = grid.points();
    let mut offsets = grid.neighbour_offsets(connectivity);
    // Each sample is a run of its own where consecutive samples of a row are not joined.
    let along = offsets.iter().position(|&offset| offset == [0, 1] || offset == [0, -1]);
    if let Some(along) = along {
        offsets.swap_remove(along);
    }
    let rows: Vec<Vec<[i32; 2]>> = parallel::map(n1, |row| runs_of_row(n2, along.is_some(), |j| members(row * n2 + j)));
    let starts: Vec<usize> = std::iter::once(0)
        .chain(rows.iter().scan(0, |sum, row| {
            *sum += row.len();
            Some(*sum)
        }))
        .collect();
    let mut sets = DisjointSets::new(starts[n1]);
    for (i, row) in rows.iter().enumerate() {
        if let ([first, ..], [.., last]) = (&row[..], &row[..])
            && along.is_some()
            && first[0] == 0
            && last[1] as usize == n2
        {
            sets.join(starts[i] + row.len() - 1, starts[i], [0, 1]);
        }
        for &offset in &offsets {
            join_rows(&mut sets, &rows, &starts, i, offset, n2);
        }
    }
    collected(&rows, &mut sets, [n1, n2])
}

/// Joins the runs of the row `i` to those that they touch in the row `down` below, shifted by `right` columns.
fn join_rows(
    sets: &mut DisjointSets,
    rows: &[Vec<[i32; 2]>],
    starts: &[usize],
    i: usize,
    [down, right]: [i32; 2],
    columns: usize,
) {
    let (n1, n2) = (rows.len() as i32, columns as i32);
    let below = i as i32 + down;
    let (cell, there) = (below.div_euclid(n1), below.rem_euclid(n1) as usize);
    for (number, &[first, end]) in (starts[i]..).zip(&rows[i]) {
        let (first, last) = (first + right, end - 1 + right);
        for across in first.div_euclid(n2)..=last.div_euclid(n2) {
            let offset = across * n2;
            let touching = rows[there].partition_point(|run| run[1] + offset <= first)..;
            for (k, run) in touching.clone().zip(&rows[there][touching]) {
                if run[0] + offset > last {
                    break;
                }
                sets.join(number, starts[there] + k, [cell, across]);
            }
        }
    }
}

/// Runs [first, end) of members among the `count` samples of a row.
fn runs_of_row(count: usize, joined: bool, member: impl Fn(usize) -> bool) -> Vec<[i32; 2]> {
    let mut runs = Vec::new();
    let mut from = 0;
    while let Some(first) = (from..count).find(|&j| member(j)) {
        let end = if joined { (first..count).find(|&j| !member(j)).unwrap_or(count) } else { first + 1 };
        runs.push([first as i32, end as i32]);
        from = end;
    }
    runs
}

fn collected(rows: &[Vec<[i32; 2]>], sets: &mut DisjointSets, [n1, n2]: [usize; 2]) -> Vec<Component> {
    const NONE: u32 = u32::MAX;
    let mut component_of = vec![NONE; sets.parents.len()];
    let mut components: Vec<Component> = Vec::new();
    let runs = rows.iter().enumerate().flat_map(|(i, row)| row.iter().map(move |run| (i as i32, *run)));
    for (number, (row, [first, end])) in runs.enumerate() {
        // The root is the first run of its set.
        let (root, [down, right]) = sets.root(number);
        if component_of[root] == NONE {
            component_of[root] = components.len() as u32;
            components.push(Component { runs: Vec::new(), wraps: sets.wraps[root] });
        }
        let (rows, columns) = (down * n1 as i32, right * n2 as i32);
        let run = SampleRun { row: row + rows, first: first + columns, end: end + columns };
        components[component_of[root] as usize].runs.push(run);
    }
    components
}

/// Disjoint sets of runs, each with the number of cells between it and the first run of its set.
struct DisjointSets {
    parents: Vec<u32>,
    /// Number of cells from the parent along a₁ and a₂.
    shifts: Vec<[i32; 2]>,
    /// Whether the set of a root is connected to an image of itself.
    wraps: Vec<bool>,
}

impl DisjointSets {
    fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect(), shifts: vec![[0; 2]; count], wraps: vec![false; count] }
    }

    /// The first run of the set of `run`, and the number of cells from it to `run` along a₁ and a₂.
    fn root(&mut self, run: usize) -> (usize, [i32; 2]) {
        let (mut root, mut shift) = (run, [0; 2]);
        while self.parents[root] as usize != root {
            shift = sum(shift, self.shifts[root]);
            root = self.parents[root] as usize;
        }
        // Path compression.
        let (mut at, mut rest) = (run, shift);
        while self.parents[at] as usize != root && at != root {
            let (next, step) = (self.parents[at] as usize, self.shifts[at]);
            (self.parents[at], self.shifts[at]) = (root as u32, rest);
            (at, rest) = (next, difference(rest, step));
        }
        (root, shift)
    }

    /// Joins a run to the image of `other` that lies `cells` cells along a₁ and a₂ away.
    fn join(&mut self, run: usize, other: usize, cells: [i32; 2]) {
        let ((a, shift), (b, other_shift)) = (self.root(run), self.root(other));
        // Cells from the root a to the root b.
        let apart = difference(sum(shift, cells), other_shift);
        if a == b {
            self.wraps[a] |= apart != [0; 2];
            return;
        }
        let (first, second, apart) = if a < b { (a, b, apart) } else { (b, a, difference([0; 2], apart)) };
        (self.parents[second], self.shifts[second]) = (first as u32, apart);
        self.wraps[first] |= self.wraps[second];
    }
}

fn sum(a: [i32; 2], b: [i32; 2]) -> [i32; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn difference(a: [i32; 2], b: [i32; 2]) -> [i32; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Sizes and loads of the contact spots of a pressure.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SpotCounts {
    /// Number of samples and sum of the pressure of each spot, in ascending number of samples.
    pub sizes: Vec<(usize, f64)>,
    /// Whether a spot is connected to an image of itself.
    pub wraps: bool,
}

impl SpotCounts {
    /// Counts of the `spots` of a `pressure`.
    pub fn of(spots: &[Component], grid: &Grid, pressure: &[f64]) -> Self {
        let size = |spot: &Component| {
            let load = spot.indices(grid).map(|run| pressure[run].iter().sum::<f64>()).sum();
            (spot.size(), load)
        };
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    fn index([i, j]: [usize; 2]) -> usize {
        i * 8 + j
    }

    #[test]
    fn a_spot_across_the_border_is_one_and_a_stripe_wraps() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let corner = |index: usize| [0, 7].contains(&(index / 8)) && [0, 7].contains(&(index % 8));
        let found = components(&grid, Connectivity::Edges, corner);
        assert!(found.len() == 1 && found[0].size() == 4 && !found[0].wraps);
        let centre = found[0].centre(&grid);
        let [x, y] = centre.map(|x| (x + 0.5).rem_euclid(1.0) - 0.5);
        assert!((x + 0.0625).abs() < 1e-12 && (y + 0.0625).abs() < 1e-12, "{x} {y}");
        assert!((found[0].farthest(&grid, centre) - 0.0625 * 2f64.sqrt()).abs() < 1e-12);
        assert!(components(&grid, Connectivity::Edges, |index| index / 8 == 3)[0].wraps);
    }

    /// Cells of a square or oblique grid share corners with four more than the four at their edges, hexagons with none; the
    /// vectors that describe the cell do not matter.
    #[test]
    fn samples_at_corners_are_joined_where_cells_have_neighbours_there() {
        let joined = |a2: [f64; 2], set: &[[usize; 2]]| {
            let grid = Grid::new(Cell::new([1.0, 0.0], a2).unwrap(), [8, 8]).unwrap();
            let members: Vec<usize> = set.iter().map(|sample| index(*sample)).collect();
            [Connectivity::Edges, Connectivity::EdgesAndCorners]
                .map(|connectivity| components(&grid, connectivity, |index| members.contains(&index)).len())
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
        let ring = [[3, 4], [5, 4], [4, 3], [4, 5]].map(index);
        let spots = components(&grid, Connectivity::EdgesAndCorners, |index| ring.contains(&index));
        let open = components(&grid, Connectivity::Edges, |index| !ring.contains(&index));
        let sizes = |found: &[Component]| found.iter().map(|set| (set.size(), set.wraps)).collect::<Vec<_>>();
        assert_eq!((sizes(&spots), sizes(&open)), (vec![(4, false)], vec![(59, true), (1, false)]));
    }

    #[test]
    fn half_of_the_load_decides_which_spot_counts() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = [0.0; 64];
        let counts = |pressure: &[f64]| SpotCounts::of(&contact_spots(&grid, pressure), &grid, pressure);
        assert_eq!((counts(&pressure), counts(&pressure).half_load()), (SpotCounts::default(), None));
        // One sample of load 1, two of 1 each, four of 2 each.
        pressure[0] = 1.0;
        pressure[16..18].fill(1.0);
        pressure[36..40].fill(2.0);
        assert_eq!(counts(&pressure).sizes, [(1, 1.0), (2, 2.0), (4, 8.0)]);
        assert_eq!(counts(&pressure).half_load(), Some(2));
        pressure[0] = 20.0;
        assert_eq!(counts(&pressure).half_load(), Some(0));
    }

    /// Against a flood fill, on cells whose nearest samples do not follow each other in a row too.
    #[test]
    fn sets_are_those_of_a_flood_fill() {
        let mut state = 1u64;
        let mut chance = |part: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as f64) < part * 2f64.powi(31)
        };
        for (a2, points) in
            [([0.0, 1.0], [9, 12]), ([0.5, 0.75f64.sqrt()], [10, 10]), ([1.3, 0.4], [12, 7]), ([3.2, 1.0], [8, 9])]
        {
            let grid = Grid::new(Cell::new([1.0, 0.0], a2).unwrap(), points).unwrap();
            for part in [0.2, 0.4, 0.55, 0.7, 1.0] {
                for connectivity in [Connectivity::Edges, Connectivity::EdgesAndCorners] {
                    let set: Vec<bool> = (0..grid.len()).map(|_| chance(part)).collect();
                    let found = components(&grid, connectivity, |index| set[index]);
                    let mut described: Vec<(Vec<usize>, bool)> = Vec::new();
                    for component in &found {
                        let mut indices: Vec<usize> = component.indices(&grid).flatten().collect();
                        indices.sort_unstable();
                        described.push((indices, component.wraps));
                    }
                    assert_eq!(described, flooded(&grid, connectivity, &set), "{a2:?} {part} {connectivity:?}");
                }
            }
        }
    }

    /// Connected sets by following every sample to its neighbours.
    fn flooded(grid: &Grid, connectivity: Connectivity, set: &[bool]) -> Vec<(Vec<usize>, bool)> {
        let points = grid.points().map(|n| n as i32);
        let offsets: Vec<[i32; 2]> =
            grid.neighbour_offsets(connectivity).into_iter().flat_map(|offset| [offset, offset.map(|k| -k)]).collect();
        let index = |[i, j]: [i32; 2]| (i.rem_euclid(points[0]) * points[1] + j.rem_euclid(points[1])) as usize;
        let mut seen: Vec<Option<[i32; 2]>> = vec![None; set.len()];
        let mut found = Vec::new();
        for start in 0..set.len() {
            if seen[start].is_some() || !set[start] {
                continue;
            }
            let here = [start as i32 / points[1], start as i32 % points[1]];
            seen[start] = Some(here);
            let (mut samples, mut looked, mut wraps) = (vec![here], 0, false);
            while looked < samples.len() {
                let [i, j] = samples[looked];
                looked += 1;
                for there in offsets.iter().map(|[rows, columns]| [i + rows, j + columns]) {
                    match seen[index(there)] {
                        None if set[index(there)] => {
                            seen[index(there)] = Some(there);
                            samples.push(there);
                        }
                        Some(other) => wraps |= other != there,
                        None => {}
                    }
                }
            }
            let mut indices: Vec<usize> = samples.into_iter().map(index).collect();
            indices.sort_unstable();
            found.push((indices, wraps));
        }
        found
    }
}

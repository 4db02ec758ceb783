//! Runs of consecutive samples in a row of the periodic plane.

use super::Grid;

/// Samples of one row from the column `first` up to, but not including, the column `end`; rows and columns continue beyond
/// the borders of the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SampleRun {
    pub row: i32,
    pub first: i32,
    pub end: i32,
}

impl SampleRun {
    /// Number of samples.
    pub fn len(&self) -> usize {
        (self.end - self.first) as usize
    }

    /// Flat index, within the cell, of the sample whose image is the first one.
    pub fn index(&self, [n1, n2]: [usize; 2]) -> usize {
        self.row.rem_euclid(n1 as i32) as usize * n2 + self.first.rem_euclid(n2 as i32) as usize
    }

    /// Positions of the first and of the last sample, lengths.
    pub fn ends(&self, grid: &Grid) -> [[f64; 2]; 2] {
        [self.first, self.end - 1].map(|column| place(grid, [self.row, column]))
    }
}

/// Position of a sample, lengths.
fn place(grid: &Grid, [row, column]: [i32; 2]) -> [f64; 2] {
    let [n1, n2] = grid.points();
    grid.cell().point([f64::from(row) / n1 as f64, f64::from(column) / n2 as f64])
}

/// Runs of the samples of the plane at distances from `centre` of at least `from` and less than `to`; lengths.
pub fn annulus(grid: &Grid, centre: [f64; 2], [from, to]: [f64; 2]) -> Vec<SampleRun> {
    let [down, along] = grid.steps();
    let length = along[0].hypot(along[1]);
    let unit = along.map(|x| x / length);
    let cross = |[x, y]: [f64; 2]| x * unit[1] - y * unit[0];
    let corner = grid.cell().corner();
    // From the sample (0, 0).
    let centre = [0, 1].map(|k| centre[k] - corner[k]);
    let middle = cross(centre) / cross(down);
    let rows = to / cross(down).abs();
    let mut runs = Vec::new();
    for row in (middle - rows).ceil() as i32..=(middle + rows).floor() as i32 {
        let start = [0, 1].map(|k| f64::from(row) * down[k] - centre[k]);
        let (beside, before) = (cross(start), start[0] * unit[0] + start[1] * unit[1]);
        // First and end column of the row's samples nearer than a distance.
        let nearer = |distance: f64| {
            let half = (distance * distance - beside * beside).sqrt();
            let [first, end] = [-half, half].map(|t| ((t - before) / length).ceil());
            (half > 0.0 && end > first).then_some([first as i32, end as i32])
        };
        let Some([first, end]) = nearer(to) else { continue };
        let parts = match nearer(from) {
            Some([from, to]) => [[first, from], [to, end]],
            None => [[first, end], [end, end]],
        };
        runs.extend(parts.into_iter().filter(|[first, end]| first < end).map(|[first, end]| SampleRun {
            row,
            first,
            end,
        }));
    }
    runs
}

/// Samples of runs: flat index within the cell, and position from `centre`, lengths.
pub fn samples(grid: &Grid, runs: &[SampleRun], centre: [f64; 2]) -> impl Iterator<Item = (usize, [f64; 2])> {
    let [n1, n2] = grid.points();
    let along = grid.steps()[1];
    runs.iter().flat_map(move |run| {
        let row = run.row.rem_euclid(n1 as i32) as usize * n2;
        let start = place(grid, [run.row, run.first]);
        let mut column = run.first.rem_euclid(n2 as i32) as usize;
        (0..run.len()).map(move |k| {
            let index = row + column;
            column = if column + 1 == n2 { 0 } else { column + 1 };
            (index, [0, 1].map(|c| start[c] + k as f64 * along[c] - centre[c]))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    /// Against all samples of the plane around.
    #[test]
    fn an_annulus_holds_what_is_as_far_away() {
        for (a2, points) in [([0.0, 1.0], [20, 20]), ([0.7, 0.6], [30, 21]), ([-2.1, 0.4], [16, 25])] {
            let grid = Grid::new(Cell::new([1.0, 0.0], a2).unwrap(), points).unwrap();
            let centre = [0.31, -0.223];
            for [from, to] in [[0.0, 0.02], [0.0, 0.3], [0.117, 0.292], [0.9, 1.4]] {
                let runs = annulus(&grid, centre, [from, to]);
                let mut found: Vec<[i32; 2]> =
                    runs.iter().flat_map(|run| (run.first..run.end).map(|column| [run.row, column])).collect();
                found.sort_unstable();
                let all = (-200..200).flat_map(|i| (-200..200).map(move |j| [i, j]));
                let expected: Vec<[i32; 2]> = all
                    .filter(|sample| {
                        let [x, y] = place(&grid, *sample);
                        (from..to).contains(&(x - centre[0]).hypot(y - centre[1]))
                    })
                    .collect();
                assert_eq!(found, expected, "{a2:?} {from} {to}");
                for ((index, offset), sample) in samples(&grid, &runs, centre)
                    .zip(runs.iter().flat_map(|run| (run.first..run.end).map(|column| [run.row, column])))
                {
                    let [n1, n2] = points.map(|n| n as i32);
                    assert_eq!(index as i32, sample[0].rem_euclid(n1) * n2 + sample[1].rem_euclid(n2));
                    let position = place(&grid, sample);
                    assert!((0..2).all(|k| (offset[k] - position[k] + centre[k]).abs() < 1e-12));
                }
            }
        }
    }
}

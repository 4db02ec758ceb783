//! Nearest neighbours of the samples of a grid, and the lines of samples through them.
//!
//! Nearest neighbours lie along the reduced basis r₁, r₂ of the lattice **a**₁/N₁, **a**₂/N₂ of the samples, whichever vectors
//! describe it. Where r₂ and its shorter diagonal with r₁ are equally long, as in a rhombic lattice, there are several reduced
//! bases, and readings along their vectors are averaged over all of them.

use super::Grid;
use super::cell::norm;
use std::iter;

/// Largest relative difference of the squares of equal lengths.
const LENGTH_TOLERANCE: f64 = 1e-9;

/// A direction from each sample to one of its nearest neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NeighbourDirection {
    /// Offset to the next sample, in rows and columns.
    pub step: [i32; 2],
    /// Number of the reduced bases that contain the direction, over the number of all.
    pub weight: f64,
    /// Length of the other vector of the basis, a length.
    pub beside: f64,
}

impl NeighbourDirection {
    /// Flat index of the sample `count` steps from the sample `index`.
    pub fn sample(&self, [n1, n2]: [usize; 2], index: usize, count: i64) -> usize {
        let along = |k: usize, n: usize, step: i32| (k as i64 + count * i64::from(step)).rem_euclid(n as i64) as usize;
        along(index / n2, n1, self.step[0]) * n2 + along(index % n2, n2, self.step[1])
    }

    /// Flat index of the first sample of each closed line along the direction; all lines are equally long.
    pub fn lines(&self, points: [usize; 2]) -> Vec<usize> {
        // Rows and columns begin at their first samples.
        match self.step.map(i32::abs) {
            [0, 1] => return (0..points[0]).map(|row| row * points[1]).collect(),
            [1, 0] => return (0..points[1]).collect(),
            _ => {}
        }
        let mut seen = vec![false; points[0] * points[1]];
        let mut starts = Vec::new();
        for start in 0..seen.len() {
            if !seen[start] {
                starts.push(start);
                self.line(points, start).for_each(|index| seen[index] = true);
            }
        }
        starts
    }

    /// Flat indices of the closed line through the sample `start`, from there on.
    pub fn line(&self, [n1, n2]: [usize; 2], start: usize) -> impl Iterator<Item = usize> + use<> {
        let [down, right] =
            [(self.step[0], n1), (self.step[1], n2)].map(|(step, n)| step.rem_euclid(n as i32) as usize);
        let next = move |&[row, column]: &[usize; 2]| {
            let (row, column) = (row + down, column + right);
            let next = [if row < n1 { row } else { row - n1 }, if column < n2 { column } else { column - n2 }];
            (next != [start / n2, start % n2]).then_some(next)
        };
        iter::successors(Some([start / n2, start % n2]), next).map(move |[row, column]| row * n2 + column)
    }
}

/// Neighbours that a sample is connected to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Connectivity {
    /// Samples whose cells share an edge: the connectivity of open samples.
    Edges,
    /// Samples whose cells share an edge or a corner: the connectivity of contact. A ring of samples that meet at corners
    /// encloses the open samples inside it.
    EdgesAndCorners,
}

impl Grid {
    /// Offsets in rows and columns from a sample to those connected to it, one of each pair ±.
    pub(crate) fn neighbour_offsets(&self, connectivity: Connectivity) -> Vec<[i32; 2]> {
        let mut offsets: Vec<[i32; 2]> = self.directions().iter().map(|direction| direction.step).collect();
        if let (&[[i1, j1], [i2, j2]], Connectivity::EdgesAndCorners) = (&offsets[..], connectivity) {
            offsets.extend([[i1 + i2, j1 + j2], [i1 - i2, j1 - j2]]);
        }
        offsets
    }

    /// Flat index of the sample at an offset in rows and columns from the sample `index`.
    pub(crate) fn at_offset(&self, [rows, columns]: [i32; 2], index: usize) -> usize {
        let [n1, n2] = self.points();
        let moved = |k: usize, n: usize, by: i32| (k as i64 + i64::from(by)).rem_euclid(n as i64) as usize;
        moved(index / n2, n1, rows) * n2 + moved(index % n2, n2, columns)
    }

    /// Directions to the nearest neighbours, one of each pair ±: two, or three of equal length. Their weights add to two.
    pub(crate) fn directions(&self) -> Vec<NeighbourDirection> {
        let [e1, e2] = self.steps();
        let vector = |[i, j]: [i32; 2]| [0, 1].map(|k| f64::from(i) * e1[k] + f64::from(j) * e2[k]);
        let length = |step: [i32; 2]| norm(vector(step));
        let reduced = self.samples_cell().map_or([[1, 0], [0, 1]], |cell| cell.reduced().matrix());
        // Rows and columns continued through a whole spot are kept in 32 bits: on a more skewed cell the directions are those
        // of its own vectors.
        let most = reduced.iter().flatten().map(|m| i64::from(m.abs())).max().unwrap_or(1);
        let [mut r1, mut r2] = if most * self.len() as i64 <= i64::from(i32::MAX) { reduced } else { [[1, 0], [0, 1]] };
        if length(r2) < length(r1) {
            (r1, r2) = (r2, r1);
        }
        let ([x1, y1], [x2, y2]) = (vector(r1), vector(r2));
        let sign = if x1 * x2 + y1 * y2 > 0.0 { -1 } else { 1 };
        let diagonal = [r2[0] + sign * r1[0], r2[1] + sign * r1[1]];
        let is_tied = |a: f64, b: f64| (a * a - b * b).abs() <= LENGTH_TOLERANCE * b * b;
        let (short, long) = (length(r1), length(r2));
        let direction = |step, weight, beside| NeighbourDirection { step, weight, beside };
        if !is_tied(length(diagonal), long) {
            return vec![direction(r1, 1.0, long), direction(r2, 1.0, short)];
        }
        let [shortest, others] = if is_tied(short, long) { [2.0 / 3.0; 2] } else { [1.0, 0.5] };
        vec![direction(r1, shortest, long), direction(r2, others, short), direction(diagonal, others, short)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    /// Lengths, weights and distances of the lines, in order of the angle.
    fn described(cell: Cell, points: [usize; 2]) -> Vec<[f64; 4]> {
        let grid = Grid::new(cell, points).unwrap();
        let mut all: Vec<[f64; 4]> = grid
            .directions()
            .iter()
            .map(|direction| {
                let [x, y] =
                    [0, 1].map(|k| (0..2).map(|c| f64::from(direction.step[c]) * grid.steps()[c][k]).sum::<f64>());
                // Rounded, so that −0 and π are one.
                [
                    1e-9 * (y.atan2(x).rem_euclid(std::f64::consts::PI) * 1e9 + 0.5).floor(),
                    x.hypot(y),
                    direction.weight,
                    direction.beside,
                ]
            })
            .collect();
        all.sort_by(|a, b| a[0].total_cmp(&b[0]));
        all
    }

    #[test]
    fn directions_are_those_of_the_lattice_whichever_vectors_describe_it() {
        for (a1, a2, count) in [
            ([1.0, 0.0], [0.0, 1.0], 2),
            ([1.0, 0.0], [0.1, 0.7], 2),
            ([1.0, 0.0], [0.5, 0.75f64.sqrt()], 3),
            ([1.0, 0.0], [0.5, 2.0], 3),
        ] {
            let lines = described(Cell::new(a1, a2).unwrap(), [6, 6]);
            assert_eq!(lines.len(), count);
            assert!((lines.iter().map(|direction| direction[2]).sum::<f64>() - 2.0).abs() < 1e-15);
            for multiple in [-3.0, -1.0, 1.0, 2.0] {
                let skewed = Cell::new(a1, [0, 1].map(|k| a2[k] + multiple * a1[k])).unwrap();
                for (a, b) in lines.iter().flatten().zip(described(skewed, [6, 6]).iter().flatten()) {
                    assert!((a - b).abs() < 1e-8, "{a1:?} {a2:?} {multiple}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn lines_hold_every_sample_once() {
        for step in [[1, 0], [0, 1], [1, 1], [-1, 2], [3, -2]] {
            let direction = NeighbourDirection { step, weight: 1.0, beside: 1.0 };
            let starts = direction.lines([6, 8]);
            let mut all: Vec<usize> = starts.into_iter().flat_map(|start| direction.line([6, 8], start)).collect();
            all.sort_unstable();
            assert_eq!(all, (0..48).collect::<Vec<_>>(), "{step:?}");
        }
        let along = NeighbourDirection { step: [0, 1], weight: 1.0, beside: 1.0 };
        assert_eq!((along.lines([2, 3]), along.line([2, 3], 3).collect()), (vec![0, 3], vec![3, 4, 5]));
    }

    #[test]
    fn a_skew_that_does_not_fit_into_thirty_two_bits_has_the_grid_s_own_lines() {
        let grid = Grid::new(Cell::new([1.0, 0.0], [3e8, 1e3]).unwrap(), [64, 64]).unwrap();
        assert!(grid.directions().iter().all(|direction| direction.step.iter().all(|step| step.abs() <= 1)));
    }
}

//! The path on which a point of the body meets the stresses under a counterbody that slides.
//!
//! The counterbody slides along **e**: in its own frame a point of the body moves along a straight line, y across **e** and z
//! constant. On a lattice the line closes where **e** is the direction of a lattice vector m₁**a**₁ + m₂**a**₂: then it is one period
//! long. In any other direction it comes as near as one likes to every place of the plane: all points of the body at a depth are
//! damaged alike, by the mean over the lines of the nearest direction that closes within a few cells. At an isolated contact it comes
//! from far away and goes there, from rest to rest.
//!
//! Lines are sampled by rows and columns: rows follow one another along the cell vector **a** that **e** is nearest to, and in each row
//! the columns, along the other one **b**, are shifted by the slope of **e**, so that a column is a part of a line. A path crosses the cell |m| times
//! before it closes, m the multiple of **a**, each time in another column.

use super::trace::lattice_direction;
use crate::lattice::{Cell, Surroundings};
use serde::{Deserialize, Serialize};

/// Tolerance of the whole multiples of a direction.
const WHOLE_TOLERANCE: f64 = 1e-9;
/// Most cells that a line crosses before it closes, of the direction that stands for one that never closes.
const MOST_TURNS: i32 = 32;
/// Columns of a whole turn of an isolated contact that lie before the window, at most, when they are sheared: the rest lies behind.
const BEHIND: f64 = 0.75;

/// The path of a point of the body under a counterbody that slides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SlidingPath {
    /// Path along the lattice vector m₁a₁ + m₂a₂ of these m₁, m₂, after which it closes.
    LatticeVector([i32; 2]),
    /// Path that never closes: every place of a plane of constant depth counts.
    WholePlane,
    /// Path from far away to far away, past an isolated contact.
    FromFarAway,
    /// Steps of a cycle at a point that stays in place: no path of sliding.
    InPlace,
}

impl SlidingPath {
    /// The path along a `direction`, a unit vector, on a `cell`.
    pub(crate) fn of(cell: Cell, direction: [f64; 2]) -> Self {
        SlidingLines::new(cell, direction).path
    }
}

/// Sampling of the lines of a path on planes of constant depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SlidingLines {
    pub path: SlidingPath,
    /// Unit vector **e**.
    direction: [f64; 2],
    /// Number, 0 or 1, of the cell vector **a** along which rows follow one another.
    pub advance: usize,
    /// Fraction of **b** by which a line rises over a fraction of **a**.
    pub slope: f64,
    /// Times that a line crosses the cell along **a** before it closes.
    turns: usize,
    /// Multiple of **b** after which a line closes.
    across: i32,
    cell: Cell,
}

/// Numbers of the samples of a plane along **a** and **b**.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LinePoints {
    pub rows: usize,
    pub columns: usize,
}

impl SlidingLines {
    /// Lines along a `direction`, a unit vector, on a `cell`: of an isolated contact its window.
    pub fn new(cell: Cell, direction: [f64; 2]) -> Self {
        let parts = cell.parts(direction);
        let advance = usize::from(parts[1].abs() > parts[0].abs() * (1.0 + WHOLE_TOLERANCE));
        let slope = parts[1 - advance] / parts[advance];
        let of = |path: SlidingPath, slope: f64, turns: i32, across: i32| Self {
            path,
            direction,
            advance,
            slope: if slope.abs() > WHOLE_TOLERANCE { slope } else { 0.0 },
            turns: turns.unsigned_abs() as usize,
            across: turns.signum() * across,
            cell,
        };
        if cell.surroundings() == Surroundings::FreeSpace {
            return of(SlidingPath::FromFarAway, slope, 1, 0);
        }
        match lattice_direction(parts, WHOLE_TOLERANCE) {
            Some((multiples, _)) => {
                let [m, n] = [multiples[advance], multiples[1 - advance]];
                of(SlidingPath::LatticeVector(multiples), f64::from(n) / f64::from(m), m, n)
            }
            None => {
                let [m, n] = nearest_ratio(slope);
                of(SlidingPath::WholePlane, f64::from(n) / f64::from(m), m, n)
            }
        }
    }

    /// Length of a line until it closes, a length.
    pub fn length(&self) -> f64 {
        self.turns as f64 * self.lengths()[2]
    }

    /// Distance after which a point of the body has met what it meets, a length: the lattice vector, or where the path never closes the
    /// side of a square as large as the cell. `None` of an isolated contact, which a point meets once.
    pub fn period(&self) -> Option<f64> {
        match self.path {
            SlidingPath::LatticeVector(_) => Some(self.length()),
            SlidingPath::WholePlane => Some(self.cell.area().sqrt()),
            SlidingPath::FromFarAway | SlidingPath::InPlace => None,
        }
    }

    /// Whether the columns of a row are shifted.
    pub fn is_sheared(&self) -> bool {
        self.slope != 0.0
    }

    /// Lengths of the cell vectors **a** and **b**, and of the way along **e** over one **a**.
    pub fn lengths(&self) -> [f64; 3] {
        let vectors = self.cell.vectors();
        let [a, b] = [vectors[self.advance], vectors[1 - self.advance]];
        let way = [0, 1].map(|k| a[k] + self.slope * b[k]);
        [a, b, way].map(|[x, y]| x.hypot(y))
    }

    /// Least number of columns from a number on that a path may be sampled with.
    pub fn columns(&self, least: usize, fast: impl Fn(usize) -> usize) -> usize {
        self.turns * fast(least.div_ceil(self.turns))
    }

    /// Number of lines of a plane.
    pub fn count(&self, points: LinePoints) -> usize {
        match self.path {
            SlidingPath::WholePlane => 1,
            _ => points.columns / self.turns,
        }
    }

    /// Whether a line ends where it begins.
    pub fn is_closed(&self) -> bool {
        matches!(self.path, SlidingPath::LatticeVector(_))
    }

    /// Distance after which lines repeat, across **e**, a length; `None` where they do not.
    pub fn period_across(&self) -> Option<f64> {
        self.is_closed().then(|| self.apart(1.0).abs() / self.turns as f64)
    }

    /// Number of samples of a line from one end to the other, of those that [`Self::samples`] puts one behind the other.
    pub fn run(&self, points: LinePoints) -> usize {
        self.turns * points.rows
    }

    /// y of lines a fraction of **b** apart.
    fn apart(&self, fraction: f64) -> f64 {
        fraction * self.y(self.cell.vectors()[1 - self.advance])
    }

    /// y of a place, across **e**, a length: of **e** along x that along y.
    pub fn y(&self, [x, y]: [f64; 2]) -> f64 {
        self.direction[0] * y - self.direction[1] * x
    }

    /// Rows and columns of the samples of a line, from one end to the other, all of the cell.
    pub fn samples(&self, line: usize, points: LinePoints) -> Vec<[usize; 2]> {
        let LinePoints { rows, columns } = points;
        let lines = match self.path {
            SlidingPath::WholePlane => 0..columns / self.turns,
            _ => line..line + 1,
        };
        let turns = lines.flat_map(|line| (0..self.turns).map(move |turn| (line, turn)));
        turns.flat_map(|turn| (0..rows).map(move |row| [row, self.column(turn, columns)])).collect()
    }

    /// Column of a turn of a line.
    fn column(&self, (line, turn): (usize, usize), columns: usize) -> usize {
        let moved = i64::from(self.across) * (turn * (columns / self.turns)) as i64;
        (line as i64 + moved).rem_euclid(columns as i64) as usize
    }

    /// Position of a place of a cell among the samples of a line: the number of the sample before it and the part of
    /// the way to the next.
    pub fn position(&self, place: [f64; 2], line: usize, points: LinePoints) -> f64 {
        let LinePoints { rows, columns } = points;
        let parts = self.cell.parts(place);
        // The remainder of a tiny negative number is rounded to 1.
        let u = Some(parts[self.advance].rem_euclid(1.0)).filter(|u| *u < 1.0).unwrap_or(0.0);
        let column = (parts[1 - self.advance] - self.shift(u)) * columns as f64;
        let away = |of_turn: usize| {
            let away = (column - of_turn as f64) / columns as f64;
            (away - away.round()).abs()
        };
        let lines = if self.path == SlidingPath::WholePlane { 0..columns / self.turns } else { line..line + 1 };
        let turns = lines.flat_map(|line| (0..self.turns).map(move |turn| (line, turn))).enumerate();
        let nearest =
            turns.min_by(|(_, a), (_, b)| away(self.column(*a, columns)).total_cmp(&away(self.column(*b, columns))));
        nearest.map_or(0.0, |(number, _)| (number * rows) as f64 + u * rows as f64)
    }

    /// Fraction of **b** by which the columns of a row are shifted, at the fraction u of **a** of the row: nothing in the middle of a
    /// window, and at the first row of a cell.
    pub fn shift(&self, u: f64) -> f64 {
        self.slope * (u - if self.path == SlidingPath::FromFarAway { 0.5 } else { 0.0 })
    }

    /// Fractions of the cell vectors a₁, a₂ of a row's fraction u of **a** and a column's v of **b**; columns of a
    /// window run over two windows.
    pub fn fractions(&self, u: f64, v: f64) -> [f64; 2] {
        let v = if self.path == SlidingPath::FromFarAway && v >= 2.0 * BEHIND { v - 2.0 } else { v };
        let parts = [u, v + self.shift(u)];
        [parts[self.advance], parts[1 - self.advance]]
    }
}

/// m and n, without a common factor, 0 < m ≤ 32, of the ratio n/m that misses a slope by the least distance after m cells.
fn nearest_ratio(slope: f64) -> [i32; 2] {
    let whole = |m: i32| (slope * f64::from(m)).round() as i32;
    let off = |m: i32| (slope * f64::from(m) - f64::from(whole(m))).abs();
    let is_reduced = |m: &i32| (2..=*m).all(|k| m % k != 0 || whole(*m) % k != 0);
    let best = (1..=MOST_TURNS).filter(is_reduced).min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(1);
    [best, whole(best)]
}

/// Distance after which a point of the body has met what it meets under a counterbody that slides along a direction of any length, a
/// length; `None` of an isolated contact.
pub(crate) fn period_along(cell: Cell, [x, y]: [f64; 2]) -> Option<f64> {
    let length = x.hypot(y);
    SlidingLines::new(cell, [x / length, y / length]).period()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(cell: Cell, [x, y]: [f64; 2]) -> SlidingLines {
        let length = x.hypot(y);
        SlidingLines::new(cell, [x / length, y / length])
    }

    #[test]
    fn a_direction_of_the_lattice_closes_and_any_other_does_not() {
        let (square, rhombus) = (Cell::square(2.0).unwrap(), Cell::hexagonal(1.0).unwrap());
        let path = |cell: Cell, direction: [f64; 2]| lines(cell, direction).path;
        assert_eq!(path(square, [1.0, 0.0]), SlidingPath::LatticeVector([1, 0]));
        assert_eq!(path(square, [0.0, 3.0]), SlidingPath::LatticeVector([0, 1]));
        assert_eq!(path(square, [-1.0, 2.0]), SlidingPath::LatticeVector([-1, 2]));
        assert_eq!(path(rhombus, [0.5, 0.75f64.sqrt()]), SlidingPath::LatticeVector([0, 1]));
        assert_eq!(path(rhombus, [0.0, 1.0]), SlidingPath::LatticeVector([-1, 2]));
        assert_eq!(path(square, [1.0, 2f64.sqrt()]), SlidingPath::WholePlane);
        assert_eq!(path(Cell::window([1.0, 2.0]).unwrap(), [1.0, 0.3]), SlidingPath::FromFarAway);
    }

    /// Places of the samples of each line lie on one straight line along **e**, equally far apart, and over all lines every sample is
    /// met once.
    #[test]
    fn the_samples_of_a_line_follow_one_another_along_the_direction() {
        let cells =
            [Cell::square(2.0).unwrap(), Cell::hexagonal(1.0).unwrap(), Cell::new([1.0, 0.3], [-0.2, 0.8]).unwrap()];
        for (cell, multiples) in
            cells.iter().flat_map(|cell| [[1, 0], [0, 1], [1, 1], [-1, 2], [3, 2]].map(|m| (*cell, m)))
        {
            let direction = cell.vector(multiples.map(f64::from));
            let sliding = lines(cell, direction);
            assert_eq!(sliding.path, SlidingPath::LatticeVector(multiples));
            let points = LinePoints { rows: 6, columns: sliding.columns(12, |n| n) };
            let mut met = vec![0; points.rows * points.columns];
            let (count, reduced) = (sliding.count(points), cell.reduced());
            for line in 0..count {
                let samples = sliding.samples(line, points);
                let place = |[row, column]: [usize; 2]| {
                    cell.point(sliding.fractions(row as f64 / 6.0, column as f64 / points.columns as f64))
                };
                let way = [0, 1].map(|k| sliding.lengths()[2] / 6.0 * direction[k] / direction[0].hypot(direction[1]));
                for (one, next) in samples.iter().zip(samples.iter().cycle().skip(1)) {
                    met[one[0] * points.columns + one[1]] += 1;
                    let (from, to) = (place(*one), place(*next));
                    let toward = [-1.0, 1.0].map(|sign| [0, 1].map(|k| to[k] - from[k] - sign * way[k]));
                    let off = toward.map(|vector| {
                        let [x, y] = reduced.nearest(cell.parts(vector));
                        x.hypot(y)
                    });
                    assert!(off[0].min(off[1]) < 1e-12, "{cell}, {multiples:?}: {from:?}, {to:?}");
                }
            }
            assert!(met.iter().all(|&times| times == 1), "{multiples:?}: {met:?}");
            let length = direction[0].hypot(direction[1]);
            assert!((sliding.period_across().unwrap() * length / cell.area() - 1.0).abs() < 1e-12, "{multiples:?}");
            assert!((sliding.period().unwrap() / length - 1.0).abs() < 1e-12, "{multiples:?}");
            for line in 0..count {
                for (number, [row, column]) in sliding.samples(line, points).into_iter().enumerate() {
                    let place =
                        cell.point(sliding.fractions((row as f64 + 0.25) / 6.0, column as f64 / points.columns as f64));
                    let position = sliding.position(place, line, points);
                    assert!((position - number as f64 - 0.25).abs() < 1e-9, "{multiples:?}: {position}, {number}");
                }
            }
        }
    }
}

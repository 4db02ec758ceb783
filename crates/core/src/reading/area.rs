//! Area of contact of any shape, between the samples.
//!
//! Along every line of nearest samples contact is a set of intervals. At a distance d inside an end p² falls nearly as d, at a
//! distance d outside g^{2/3} rises nearly as d: the end is the mean of the roots of two parabolas, one fitted to p² on
//! the one side, one to g^{2/3} on the other, each without the outermost sample. The lengths, averaged over the lines
//! of all directions, give the fraction of the cell. Half the difference of the two roots is the error. Between intervals
//! of few samples the end is halfway.

use super::fraction::Fraction;
use crate::lattice::Grid;
use crate::lattice::components::Component;
use crate::numeric::parallel;

/// Fewest samples of an interval through which a parabola is fitted.
const FEWEST_SAMPLES: usize = 6;
/// Samples from an end on that must not be at the hardness where the pressure gives the end.
const FULL_REACH: usize = 3;
/// Samples that a parabola uses beyond the square root of their number, at most.
const EXTRA_SAMPLES: usize = 3;

/// Fraction of the cell in contact, from pressure and gap (one value per sample each), without the intervals whose samples are
/// `excluded`; its uncertainty is half of the difference of the two roots of each end. Where the pressure of a sample beside an end is
/// `most`, the hardness, it says nothing about the end.
pub(super) fn contact_fraction(
    grid: &Grid,
    (pressure, most): (&[f64], f64),
    gap: &[f64],
    excluded: impl Fn(usize) -> bool + Sync,
) -> Fraction {
    let points = grid.points();
    let parabolas = Parabolas::new(points[0].max(points[1]));
    let mut mean = [0.0; 2];
    for direction in grid.directions() {
        let lines = direction.lines(points);
        let read = |line: &mut Vec<f64>, number: usize| {
            let start = lines[number];
            line.clear();
            line.extend(direction.line(points, start).map(|index| pressure[index]));
            let at = |k: usize| direction.sample(points, start, k as i64);
            SampleLine {
                pressure: line,
                most,
                gap: |k| gap[at(k)],
                excluded: |k| excluded(at(k)),
                parabolas: &parabolas,
            }
            .fraction()
        };
        // Lines are added in their order, whichever thread has read them.
        let all: Vec<[f64; 2]> = parallel::map_with(lines.len(), Vec::new, read);
        let sum = all.iter().fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        mean = [0, 1].map(|k| mean[k] + 0.5 * direction.weight * (sum[k] / lines.len() as f64));
    }
    Fraction { value: mean[0], uncertainty: mean[1] }
}

/// Fraction of the cell that `some` of the `all` contact spots take, by the lines of samples.
pub fn of_components<'a>(
    grid: &Grid,
    pressure: (&[f64], f64),
    gap: &[f64],
    some: impl Iterator<Item = &'a Component>,
    all: usize,
) -> Fraction {
    let some: Vec<&Component> = some.collect();
    if some.is_empty() {
        return Fraction::default();
    }
    if some.len() == all {
        return contact_fraction(grid, pressure, gap, |_| false);
    }
    let mut excluded = vec![true; grid.len()];
    some.iter().for_each(|component| component.indices(grid).for_each(|run| excluded[run].fill(false)));
    contact_fraction(grid, pressure, gap, |index| excluded[index])
}

/// A closed line of samples.
struct SampleLine<'a, G, X> {
    /// Pressure, sample by sample.
    pressure: &'a [f64],
    /// Largest pressure, infinite without hardness.
    most: f64,
    /// Gap of a sample by its number in the line, a length.
    gap: G,
    /// Whether the interval that a sample belongs to is left out, by its number in the line.
    excluded: X,
    parabolas: &'a Parabolas,
}

impl<G: Fn(usize) -> f64, X: Fn(usize) -> bool> SampleLine<'_, G, X> {
    /// Fraction of the line in contact and its estimated error.
    fn fraction(&self) -> [f64; 2] {
        let n = self.pressure.len();
        let touches = |i: usize| self.pressure[i] > 0.0;
        // Beginnings and ends of contact, alternately, from the first sample in contact beside an open one on.
        let mut ends: Vec<usize> = (1..n).filter(|&i| touches(i - 1) != touches(i)).collect();
        if touches(n - 1) != touches(0) {
            ends.insert(0, 0);
        }
        if ends.is_empty() {
            // All or nothing.
            return [f64::from(u8::from(touches(0) && !(self.excluded)(0))), 0.0];
        }
        if !touches(ends[0]) {
            let first = ends.remove(0);
            ends.push(first + n);
        }
        ends.push(ends[0] + n);
        let height = |i: usize| match self.pressure[i % n] {
            p if p > 0.0 => p * p,
            _ => (self.gap)(i % n).max(0.0).cbrt().powi(2),
        };
        let mut total = [0.0; 2];
        for (index, interval) in ends.windows(2).enumerate().step_by(2) {
            let [first, last] = [interval[0], interval[1]];
            if (self.excluded)(first % n) {
                continue;
            }
            total[0] += (last - first) as f64 - 1.0;
            // How far contact reaches beyond its outermost samples.
            let (before, after) = (open_length(&ends, index, n), open_length(&ends, index + 1, n));
            let count = last - first;
            for [length, error] in [
                self.overhang(|k| height(first + k), count, |k| height(first + n - 1 - k), before),
                self.overhang(|k| height(last - 1 - k), count, |k| height(last + k), after),
            ] {
                total[0] += length;
                total[1] += error;
            }
        }
        total.map(|samples| samples / n as f64)
    }

    /// Length by which contact reaches beyond its outermost sample, in samples, between 0 and 1, and its uncertainty, from the
    /// heights `inside(k)` and `outside(k)` k samples from the end on either side. The uncertainty is a quarter of a sample where
    /// one side alone can be read, and half a sample where none can.
    fn overhang(
        &self,
        inside: impl Fn(usize) -> f64,
        count: usize,
        outside: impl Fn(usize) -> f64,
        open: usize,
    ) -> [f64; 2] {
        // Heights are squares of pressures.
        let is_full = (0..FULL_REACH.min(count)).any(|k| inside(k) >= self.most * self.most);
        let from_inside = self.parabolas.root(inside, count).filter(|_| !is_full);
        let from_outside = self.parabolas.root(outside, open).map(|x| 1.0 - x);
        match (from_inside, from_outside) {
            (Some(a), Some(b)) => [0.5 * (a + b), 0.5 * (a - b).abs()],
            (Some(x), None) | (None, Some(x)) => [x, 0.25],
            (None, None) => [0.5; 2],
        }
    }
}

/// Length in samples of the open interval that ends or begins at the border with this index, of n samples in all.
fn open_length(ends: &[usize], index: usize, n: usize) -> usize {
    // Borders alternate; the first and the last one are the same border of the closed line.
    let (end, borders) = (ends[index], ends.len() - 1);
    if index % 2 == 1 { ends[index + 1] - end } else { (end + n - ends[(index + borders - 1) % borders]) % n }
}

/// Parabolas of least squares through m heights at x = 1/m, 2/m, … 1: each coefficient is a weighted sum of the heights.
struct Parabolas {
    /// Weights of each height in the three coefficients, for m = 3, 4, ….
    weights: Vec<Vec<[f64; 3]>>,
}

impl Parabolas {
    /// Parabolas for the intervals of lines of at most `longest` samples.
    fn new(longest: usize) -> Self {
        let most = EXTRA_SAMPLES + (longest as f64).sqrt() as usize;
        Self { weights: (3..=most).map(weights).collect() }
    }

    /// Distance beyond the outermost of `count` samples at which the parabola through their heights vanishes, from 0 to 1 sample;
    /// `None` for less than [`FEWEST_SAMPLES`], or without a root.
    fn root(&self, height: impl Fn(usize) -> f64, count: usize) -> Option<f64> {
        if count < FEWEST_SAMPLES {
            return None;
        }
        let used = (count / 2 - 1).min(EXTRA_SAMPLES + (count as f64).sqrt() as usize).clamp(3, 2 + self.weights.len());
        let mut c = [0.0; 3];
        for (k, weights) in (1..).zip(&self.weights[used - 3]) {
            let sample = height(k);
            c = [0, 1, 2].map(|power| c[power] + weights[power] * sample);
        }
        let discriminant = c[1] * c[1] - 4.0 * c[0] * c[2];
        let root = 2.0 * c[0] / (c[1] + discriminant.max(0.0).sqrt()) * used as f64;
        (c[1] > 0.0 && discriminant >= 0.0).then(|| root.clamp(0.0, 1.0))
    }
}

/// Weights of `used` heights, at least three, in the coefficients: the rows of (XᵀX)⁻¹Xᵀ with X = (1, x, x²).
fn weights(used: usize) -> Vec<[f64; 3]> {
    let x = |k: usize| k as f64 / used as f64;
    let sum = |power: i32| (1..=used).map(|k| x(k).powi(power)).sum::<f64>();
    let [s0, s1, s2, s3, s4] = [0, 1, 2, 3, 4].map(sum);
    // Adjugate of the symmetric matrix of the sums.
    let (a, b, c) = (s2 * s4 - s3 * s3, s2 * s3 - s1 * s4, s1 * s3 - s2 * s2);
    let (d, e, f) = (s0 * s4 - s2 * s2, s1 * s2 - s0 * s3, s0 * s2 - s1 * s1);
    let determinant = s0 * a + s1 * b + s2 * c;
    let of = |x: f64| [a + b * x + c * x * x, b + d * x + e * x * x, c + e * x + f * x * x].map(|w| w / determinant);
    (1..=used).map(|k| of(x(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;
    use std::f64::consts::PI;

    #[test]
    fn a_disc_and_its_complement_have_their_areas() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [120, 120]).unwrap();
        let radius = 0.3;
        let exact = PI * radius * radius / grid.cell().area();
        for (inside, expected) in [(1.0, exact), (-1.0, 1.0 - exact)] {
            let depth: Vec<f64> = (0..grid.len())
                .map(|index| {
                    let [s, t] = grid.fractions(index);
                    let [x, y] = grid.cell().vector([s - 0.5, t - 0.5]);
                    inside * (1.0 - (x * x + y * y) / (radius * radius))
                })
                .collect();
            let pressure: Vec<f64> = depth.iter().map(|d| d.max(0.0).sqrt()).collect();
            let gap: Vec<f64> = depth.iter().map(|d| (-d).max(0.0).powf(1.5)).collect();
            let Fraction { value: fraction, .. } = contact_fraction(&grid, (&pressure, f64::INFINITY), &gap, |_| false);
            assert!((fraction - expected).abs() < 2e-4, "{fraction} {expected}");
        }
    }

    #[test]
    fn full_contact_and_none_are_exact() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 12]).unwrap();
        let exact = |value| Fraction { value, uncertainty: 0.0 };
        assert_eq!(contact_fraction(&grid, (&[1.0; 96], f64::INFINITY), &[0.0; 96], |_| false), exact(1.0));
        assert_eq!(contact_fraction(&grid, (&[0.0; 96], f64::INFINITY), &[1.0; 96], |_| false), exact(0.0));
    }

    #[test]
    fn one_sample_in_contact_is_one_sample_of_area() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap();
        let mut pressure = [0.0; 64];
        pressure[27] = 1.0;
        // One line of eight in each direction, with one sample: half a sample beyond it on either side.
        let found = contact_fraction(&grid, (&pressure, f64::INFINITY), &[0.0; 64], |_| false);
        assert!((found.value - 1.0 / 64.0).abs() < 1e-12 && found.uncertainty > 0.0);
        assert_eq!(contact_fraction(&grid, (&pressure, f64::INFINITY), &[0.0; 64], |index| index == 27).value, 0.0);
    }

    #[test]
    fn a_parabola_has_its_root() {
        let parabolas = Parabolas::new(100);
        for count in [6, 9, 20, 100] {
            let height = |k: usize| (k as f64 + 0.37) * (1.0 - 2e-3 * k as f64);
            let found = parabolas.root(height, count).unwrap();
            assert!((found - 0.37).abs() < 1e-9, "{count}: {found}");
        }
        assert_eq!(parabolas.root(|_| 1.0, 5), None);
    }
}

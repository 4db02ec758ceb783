//! Mean ⟨p⟩ of a field along the direction of sliding, on a grid.
//!
//! - **Periodic cell**, the path along a lattice vector n₁**a**₁ + n₂**a**₂, after which it closes: of the waves k₁**b**₁ + k₂**b**₂ those
//!   constant along it stay, k₁n₁ + k₂n₂ = 0, which are the multiples m(−n₂, n₁). A component of the grid is its shortest aliases in equal
//!   parts: of those constant along the path their part stays. On the samples
//!
//!   ⟨p⟩_l = Σ_m W_m e^{2πiml/L} p̂_m,  p̂_m = (1/L) Σ_l p̄_l e^{−2πiml/L}
//!
//!   with the means p̄_l over the samples of each of the L lines along the path. Where the grid holds all waves of the lines, as along
//!   **a**₁ and **a**₂, every W is 1 and ⟨p⟩ = p̄.
//! - **Periodic cell**, any other path covers the cell evenly: the wave q = 0 alone stays, ⟨p⟩ is the mean over the cell.
//! - **Window** of an isolated contact, the path along one of its sides: mean over the width of the window, as far as it goes.
//!
//! The mean is symmetric, its eigenvalues lie in [0, 1], and it keeps Σp.

use super::wear_error::WearError;
use crate::lattice::{Cell, Grid, Surroundings};
use crate::numeric::sums;
use percoat_fft::FftDirection;
use rustfft::num_complex::Complex64;

/// Lattice vector along a `direction` of any length; `None` where no path along it closes.
///
/// # Errors
/// [`WearError::Oblique`] in a window unless the direction is along a side.
pub(super) fn vector_along(cell: Cell, direction: [f64; 2]) -> Result<Option<[i32; 2]>, WearError> {
    let vector = cell.closing_vector(direction);
    let is_alone = cell.surroundings() == Surroundings::FreeSpace;
    if is_alone && !vector.is_some_and(|vector| vector.contains(&0)) {
        return Err(WearError::Oblique(direction));
    }
    Ok(vector)
}

/// Mean along the direction of sliding on a grid.
#[derive(Debug)]
pub(super) struct SlidingMean {
    points: [usize; 2],
    /// `None` where the path does not close.
    lines: Option<Lines>,
    /// Components (k₁, k₂), 0 ≤ kᵢ < Nᵢ, of which something stays, each once with the part that does.
    parts: Vec<([usize; 2], f64)>,
}

/// Lines of samples along a lattice vector.
#[derive(Debug)]
struct Lines {
    /// The axis of the grid along them, if there is one.
    axis: Option<usize>,
    /// From a sample to the next one along a₁ and a₂ the number of the line grows by these, modulo the count.
    strides: [usize; 2],
    /// L.
    count: usize,
    /// W, for 0 ≤ m < L; `None` where all are 1.
    parts: Option<Vec<f64>>,
}

impl SlidingMean {
    /// Mean along a `direction` of any length.
    ///
    /// # Errors
    /// [`WearError::Oblique`] in a window unless the direction is along a side.
    pub fn new(grid: &Grid, direction: [f64; 2]) -> Result<Self, WearError> {
        let (points, vector) = (grid.points(), vector_along(grid.cell(), direction)?);
        let Some(vector) = vector else { return Ok(Self { points, lines: None, parts: vec![([0, 0], 1.0)] }) };
        // The wave m = 1.
        let first = [-vector[1], vector[0]];
        let count = {
            let order = |axis: usize| points[axis] / gcd(points[axis], first[axis].unsigned_abs() as usize);
            order(0) / gcd(order(0), order(1)) * order(1)
        };
        let (mut kept, mut parts) = (vec![0.0; count], Vec::new());
        for (wave, part) in waves(grid, first) {
            kept[wave.rem_euclid(count as i64) as usize] += part;
        }
        for (wave, &part) in (0i64..).zip(&kept).filter(|(_, part)| **part > 0.0) {
            parts.push((component(points, [0, 1].map(|axis| wave * i64::from(first[axis]))), part));
        }
        // k·x of the wave m = 1 over 2π, in units of 1/L.
        let stride = |axis: usize| {
            let turn = i64::from(first[axis]) * count as i64 / points[axis] as i64;
            turn.rem_euclid(count as i64) as usize
        };
        let parts_of_lines = kept.iter().any(|&part| part != 1.0).then_some(kept);
        let axis = (0..2).find(|&axis| vector[1 - axis] == 0);
        Ok(Self {
            points,
            lines: Some(Lines { axis, strides: [0, 1].map(stride), count, parts: parts_of_lines }),
            parts,
        })
    }

    /// Components (k₁, k₂), 0 ≤ kᵢ < Nᵢ, of which something stays, each once with the part that does.
    pub fn components(&self) -> &[([usize; 2], f64)] {
        &self.parts
    }

    /// The mean over the window as a convolution on a larger grid of `points`, zero beyond the window: components, each once with its
    /// factor.
    pub fn padded(&self, points: [usize; 2]) -> Vec<([usize; 2], f64)> {
        let axis = self.lines.as_ref().and_then(|lines| lines.axis).expect("the path in a window is along a side");
        let factor = points[axis] as f64 / self.points[axis] as f64;
        let component = |k: usize| if axis == 0 { [0, k] } else { [k, 0] };
        (0..points[1 - axis]).map(|k| (component(k), factor)).collect()
    }

    /// ⟨p⟩, one value per sample.
    pub fn of(&self, field: &[f64]) -> Vec<f64> {
        let Some(lines) = &self.lines else { return vec![sums::mean(field); field.len()] };
        let mut means = vec![0.0; lines.count];
        lines.each(self.points, |sample, line| means[line] += field[sample]);
        let samples = (field.len() / lines.count) as f64;
        means.iter_mut().for_each(|sum| *sum /= samples);
        if let Some(parts) = &lines.parts {
            means = filtered(&means, parts);
        }
        let mut mean = vec![0.0; field.len()];
        lines.each(self.points, |sample, line| mean[sample] = means[line]);
        mean
    }
}

impl Lines {
    /// Every sample with the number of its line, row by row.
    fn each(&self, [n1, n2]: [usize; 2], mut visit: impl FnMut(usize, usize)) {
        for row in 0..n1 {
            let mut line = row * self.strides[0] % self.count;
            for column in 0..n2 {
                visit(row * n2 + column, line);
                line += self.strides[1];
                if line >= self.count {
                    line -= self.count;
                }
            }
        }
    }
}

/// The waves m of a grid along the multiples m `first`, each with its part of its component.
fn waves(grid: &Grid, first: [i32; 2]) -> Vec<(i64, f64)> {
    let [b1, b2] = grid.cell().reciprocal();
    let [k1, k2] = first.map(f64::from);
    let length = (k1 * b1[0] + k2 * b2[0]).hypot(k1 * b1[1] + k2 * b2[1]);
    let most = (grid.largest_wavenumber() / length * (1.0 + 1e-9)) as i32;
    let part = |wave: i32| {
        let index = first.map(|k| wave * k);
        let aliases = grid.aliases(component(grid.points(), index.map(i64::from)));
        aliases.contains(&index).then(|| (i64::from(wave), 1.0 / aliases.len() as f64))
    };
    (-most..=most).filter_map(part).collect()
}

/// The component of a wave.
fn component(points: [usize; 2], wave: [i64; 2]) -> [usize; 2] {
    [0, 1].map(|axis| wave[axis].rem_euclid(points[axis] as i64) as usize)
}

/// Values of the lines with a part of each of their waves.
fn filtered(values: &[f64], parts: &[f64]) -> Vec<f64> {
    let count = values.len();
    let plan = |direction| percoat_fft::complex(count, direction);
    let mut waves: Vec<Complex64> = values.iter().map(|&value| Complex64::from(value)).collect();
    plan(FftDirection::Forward).process(&mut waves);
    waves.iter_mut().zip(parts).for_each(|(wave, part)| *wave *= part / count as f64);
    plan(FftDirection::Inverse).process(&mut waves);
    waves.into_iter().map(|value| value.re).collect()
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;
    use std::f64::consts::TAU;

    fn noise(len: usize) -> Vec<f64> {
        (0..len).map(|k| ((k * k * 7919 + k * 131) % 1009) as f64 / 1009.0).collect()
    }

    /// Grids on cells, and directions by multiples of the cell vectors, the last ones off the lattice.
    fn cases() -> impl Iterator<Item = (Grid, [f64; 2])> {
        let cells = [
            (Cell::square(1.0), [12, 12]),
            (Cell::hexagonal(0.8), [12, 12]),
            (Cell::hexagonal(0.8), [9, 9]),
            (Cell::new([1.0, 0.2], [0.4, 0.9]), [7, 10]),
            (Cell::new([1.0, 0.0], [2.3, 0.7]), [8, 9]),
            (Cell::new([2.0, 0.0], [0.0, 1.0]), [20, 6]),
            (Cell::square(1.0), [1, 5]),
        ];
        let directions = [[1.0, 0.0], [0.0, -1.0], [1.0, 1.0], [2.0, -1.0], [3.0, 5.0], [1.0, 2f64.sqrt()]];
        cells.into_iter().flat_map(move |(cell, points)| {
            let cell = cell.unwrap();
            directions.map(|parts| (Grid::new(cell, points).unwrap(), cell.vector(parts)))
        })
    }

    #[test]
    fn a_mean_keeps_the_sum_and_is_symmetric_and_positive() {
        for (grid, direction) in cases() {
            let mean = SlidingMean::new(&grid, direction).unwrap();
            let (p, q) = (noise(grid.len()), noise(2 * grid.len()).split_off(grid.len()));
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let ones = vec![1.0; grid.len()];
            let scale = dot(&p, &p);
            assert!((dot(&mean.of(&p), &ones) - dot(&p, &ones)).abs() < 1e-13 * scale, "{grid}, {direction:?}");
            assert!((dot(&mean.of(&p), &q) - dot(&p, &mean.of(&q))).abs() < 1e-13 * scale, "{grid}, {direction:?}");
            let energy = dot(&mean.of(&p), &p);
            assert!(energy > 0.0 && energy <= scale * (1.0 + 1e-14), "{grid}, {direction:?}");
        }
    }

    /// ⟨p⟩ at the place of each sample by the sum over the shortest aliases of all components.
    #[test]
    fn a_mean_is_that_of_the_waves_along_the_path() {
        for (grid, direction) in cases() {
            let ([n1, n2], p) = (grid.points(), noise(grid.len()));
            let mean = SlidingMean::new(&grid, direction).unwrap().of(&p);
            let phase = |k: [i32; 2], sample: usize| {
                let [s, t] = grid.fractions(sample);
                TAU * (f64::from(k[0]) * s + f64::from(k[1]) * t)
            };
            let mut expected = vec![0.0; grid.len()];
            for component in (0..n1).flat_map(|k1| (0..n2).map(move |k2| [k1, k2])) {
                let aliases = grid.aliases(component);
                let constant = |k: &&[i32; 2]| {
                    let [s, t] = grid.cell().parts(direction);
                    (f64::from(k[0]) * s + f64::from(k[1]) * t).abs() < 1e-9
                };
                for wave in aliases.iter().filter(constant) {
                    let [re, im] = (0..grid.len()).fold([0.0; 2], |[re, im], i| {
                        let angle = phase(*wave, i);
                        [re + p[i] * angle.cos(), im - p[i] * angle.sin()]
                    });
                    let size = (aliases.len() * grid.len()) as f64;
                    for (i, expected) in expected.iter_mut().enumerate() {
                        let angle = phase(*wave, i);
                        *expected += (re * angle.cos() - im * angle.sin()) / size;
                    }
                }
            }
            let error = mean.iter().zip(&expected).fold(0.0f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(error < 1e-13, "{grid}, {direction:?}: {error:e}");
        }
    }

    /// Along a cell vector all samples of a line have one value, the mean of the pressure on that line.
    #[test]
    fn along_a_cell_vector_the_mean_is_that_of_the_samples_of_a_line() {
        let grid = Grid::new(Cell::hexagonal(1.0).unwrap(), [7, 10]).unwrap();
        let p = noise(70);
        let mean = SlidingMean::new(&grid, [2.0, 0.0]).unwrap().of(&p);
        for (k, value) in mean.iter().enumerate() {
            let line = (0..7).map(|i| p[i * 10 + k % 10]).sum::<f64>() / 7.0;
            assert!((value - line).abs() < 1e-15 && *value == mean[k % 10]);
        }
    }

    #[test]
    fn in_a_window_the_path_goes_along_a_side() {
        let grid = Grid::new(Cell::window([2.0, 3.0]).unwrap(), [8, 6]).unwrap();
        assert_eq!(SlidingMean::new(&grid, [1.0, 1.0]).unwrap_err(), WearError::Oblique([1.0, 1.0]));
        assert!(SlidingMean::new(&grid, [1.0, 2f64.sqrt()]).is_err());
        assert!(SlidingMean::new(&grid, [0.0, -3.0]).is_ok());
    }
}

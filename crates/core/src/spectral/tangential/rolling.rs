//! Steady rolling: the contact moves over the surface, and material enters it at its leading edge.
//!
//! In the frame of the contact, which moves by Δs in a step toward **e**, a point of the surface comes from x + Δs**e**: the step is that of
//! partial slip with the displacement before it taken there, and its rise of the shift is ξΔs with the creepage ξ. Steps are repeated until the
//! contact has rolled over some of its lengths. The implicit step is of first order in Δs: two steps Δs and ½Δs are extrapolated.

use super::disc::{Vector, dot, scale};
use crate::lattice::components::contact_spots;
use crate::lattice::waves::WAVENUMBER_TOLERANCE;
use crate::lattice::{Grid, Surroundings};
use crate::numeric::array::{samples, view};
use crate::numeric::fourier::field::{components, field};
use ndarray::Array2;
use percoat_fft::Complex;

/// Samples that half a step in free space is a multiple of, where a field moves by whole samples: a step on the next coarser grid is as long.
const SAMPLES: f64 = 2.0;

/// How far a contact rolls, in lengths of the contact along its way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rolling {
    /// Direction of rolling, a unit vector.
    pub direction: Vector,
    /// Distance, in contact lengths.
    pub distance: f64,
    /// Step, in contact lengths.
    pub step: f64,
}

/// A way that the contact cannot roll on its grid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("in the window of an isolated contact rolling goes along its sides, by whole samples, not along [{}, {}]", .0[0], .0[1])]
pub struct NotAlongGrid(pub Vector);

/// Largest length of a contact spot along a direction, with one spacing of the samples for its edges; 0 without contact.
pub(super) fn contact_length(grid: &Grid, pressure: &[f64], direction: Vector) -> f64 {
    let extent = |ends: Vec<f64>| {
        let [low, high] = [f64::min, f64::max].map(|of| ends.iter().copied().reduce(of).unwrap_or(0.0));
        high - low
    };
    let spots = contact_spots(grid, pressure);
    let lengths = spots.iter().map(|spot| {
        extent(spot.runs.iter().flat_map(|run| run.ends(grid)).map(|place| dot(place, direction)).collect())
    });
    lengths.reduce(f64::max).map_or(0.0, |length| length + grid.spacing())
}

/// Numbers of samples along a₁ and a₂ by which a contact in free space moves in a step of about this length.
fn whole_samples(grid: &Grid, direction: Vector, length: f64) -> Result<[isize; 2], NotAlongGrid> {
    let steps = grid.steps();
    for axis in [0, 1] {
        let spacing = dot(steps[axis], steps[axis]).sqrt();
        let along = dot(steps[axis], direction) / spacing;
        if (along.abs() - 1.0).abs() < 1e-9 {
            let half = (SAMPLES * (0.5 * length / (SAMPLES * spacing)).round().max(1.0)) as isize;
            let mut shift = [0; 2];
            shift[axis] = if along > 0.0 { 2 * half } else { -2 * half };
            return Ok(shift);
        }
    }
    Err(NotAlongGrid(direction))
}

/// Factors of the waves of a field that moves from x + **by** to x on a periodic grid; tied aliases share one.
fn phases(grid: &Grid, by: Vector) -> Array2<Complex<f64>> {
    let [n1, n2] = grid.points();
    Array2::from_shape_fn((n1, n2 / 2 + 1), |(k1, k2)| {
        let tied = grid.tied_wavevectors([k1, k2], WAVENUMBER_TOLERANCE);
        let sum: Complex<f64> = tied.iter().map(|(_, q)| Complex::from_polar(1.0, dot(*q, by))).sum();
        sum / tied.len() as f64
    })
}

/// The field of vectors on a periodic grid whose waves are multiplied by these factors.
fn moved(grid: &Grid, vectors: &[Vector], phases: &Array2<Complex<f64>>) -> Vec<Vector> {
    let [_, n2] = grid.points();
    let component = |axis: usize| -> Array2<f64> {
        let values: Vec<f64> = vectors.iter().map(|v| v[axis]).collect();
        field(components(view(grid.points(), &values)) * phases, n2)
    };
    let [x, y] = [component(0), component(1)];
    samples(&x).iter().zip(samples(&y)).map(|(x, y)| [*x, *y]).collect()
}

/// The field v(i + shift) of vectors in a window, zero where it comes from outside.
fn moved_by_samples(grid: &Grid, vectors: &[Vector], shift: [isize; 2]) -> Vec<Vector> {
    let [n1, n2] = grid.points();
    let at = |i: usize, n: usize, by: isize| i.checked_add_signed(by).filter(|i| *i < n);
    let from = |index: usize| Some(vectors[at(index / n2, n1, shift[0])? * n2 + at(index % n2, n2, shift[1])?]);
    (0..vectors.len()).map(|index| from(index).unwrap_or_default()).collect()
}

/// One step of rolling on a grid.
#[derive(Debug, Clone)]
pub(super) struct Stride {
    length: f64,
    motion: FieldMotion,
}

/// How a field moves by a step.
#[derive(Debug, Clone)]
enum FieldMotion {
    /// Factors of the waves of a periodic field.
    Waves(Array2<Complex<f64>>),
    /// Samples along a₁ and a₂ in a window.
    Samples([isize; 2]),
}

impl Stride {
    /// A step of about a length, and of the half of it.
    pub fn pair(grid: &Grid, direction: Vector, length: f64) -> Result<[Self; 2], NotAlongGrid> {
        if grid.cell().surroundings() == Surroundings::Periodic {
            let of = |length: f64| Self { length, motion: FieldMotion::Waves(phases(grid, scale(length, direction))) };
            return Ok([of(length), of(0.5 * length)]);
        }
        let shift = whole_samples(grid, direction, length)?;
        let of = |shift: [isize; 2]| {
            let [e1, e2] = grid.steps();
            let by = [0, 1].map(|k| shift[0] as f64 * e1[k] + shift[1] as f64 * e2[k]);
            Self { length: dot(by, by).sqrt(), motion: FieldMotion::Samples(shift) }
        };
        Ok([of(shift), of(shift.map(|count| count / 2))])
    }

    /// Length of the step.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The field as it comes to the contact in a step.
    pub fn moved(&self, grid: &Grid, vectors: &[Vector]) -> Vec<Vector> {
        match &self.motion {
            FieldMotion::Samples(shift) => moved_by_samples(grid, vectors, *shift),
            FieldMotion::Waves(phases) => moved(grid, vectors, phases),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Cell;

    #[test]
    fn a_wave_moves_by_any_length_and_a_window_by_whole_samples() {
        let cell = Cell::hexagonal(1.3).unwrap();
        let grid = Grid::new(cell, [12, 10]).unwrap();
        let wave = |[x, y]: Vector| {
            let [b1, b2] = cell.reciprocal();
            let q = [2.0 * b1[0] - b2[0], 2.0 * b1[1] - b2[1]];
            (q[0] * x + q[1] * y + 0.3).cos()
        };
        let place = |i: usize| cell.point(grid.fractions(i));
        let field: Vec<Vector> = (0..grid.len()).map(|i| [wave(place(i)), 1.0]).collect();
        let by = [0.17, -0.4];
        for (i, v) in moved(&grid, &field, &phases(&grid, by)).into_iter().enumerate() {
            let [x, y] = place(i);
            assert!((v[0] - wave([x + by[0], y + by[1]])).abs() < 1e-13 && (v[1] - 1.0).abs() < 1e-13);
        }
        let grid = Grid::new(Cell::window([1.2, 1.0]).unwrap(), [12, 10]).unwrap();
        let [whole, half] = Stride::pair(&grid, [-1.0, 0.0], 0.37).unwrap();
        assert!((whole.length() - 0.4).abs() < 1e-14 && (half.length() - 0.2).abs() < 1e-14);
        let numbers: Vec<Vector> = (0..120).map(|i| [f64::from(i), 0.0]).collect();
        let moved = half.moved(&grid, &numbers);
        assert_eq!((moved[47][0], moved[7][0]), (27.0, 0.0));
        assert!(Stride::pair(&grid, [0.6, 0.8], 0.37).is_err());
    }

    #[test]
    fn the_length_of_a_contact_is_that_of_its_longest_spot() {
        let grid = Grid::new(Cell::square(1.0).unwrap(), [10, 10]).unwrap();
        let mut pressure = vec![0.0; 100];
        // Over the border along a₁.
        [95, 5, 15, 25, 61].into_iter().for_each(|i| pressure[i] = 1.0);
        assert!((contact_length(&grid, &pressure, [1.0, 0.0]) - 0.4).abs() < 1e-12);
        assert!((contact_length(&grid, &pressure, [0.0, 1.0]) - 0.1).abs() < 1e-12);
    }
}

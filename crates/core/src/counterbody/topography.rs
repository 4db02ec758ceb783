//! One period of a measured or generated topography, or the roughness of a ball.

use super::roughness::{RunOut, Spectrum, above_waves, apex, apex_by};
use super::{CounterbodyError, Shape};
use crate::lattice::{Cell, LatticeError, Surroundings};
use crate::notation::number;
use ndarray::{Array2, ArrayView2};
use std::borrow::Cow;
use std::fmt;

/// Place, over the way from the middle to the nearer border of the window, at which the profile of a ball goes over
/// into a plane for the search of the apex, and steepness there: in the middle the profile differs from the ball by
/// 10⁻¹⁴ of the plane's depth, at a fifth of the way by 2·10⁻⁷. Thirty samples to the border hold its waves to 10⁻⁷.
const PLANE_FROM: (f64, f64) = (0.6, 9.0);

/// One period of a measured or generated topography, or the roughness of a ball in the window of an isolated contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    cell: Cell,
    /// Heights, lengths, in standard layout.
    heights: Array2<f64>,
    run_out: Option<RunOut>,
    /// Radius of the ball that the heights stand on, a length.
    ball: Option<f64>,
    /// The apex on the grid of the samples, a length, where it was found before.
    apex: Option<f64>,
}

impl Topography {
    /// Topography on `cell` with `heights` (lengths, protrusion upward) at equally spaced samples: axis 0 along a₁,
    /// axis 1 along a₂, sample \[0, 0\] at the origin.
    ///
    /// # Errors
    /// [`CounterbodyError::Empty`] without heights, [`CounterbodyError::Height`] for one that is not finite.
    pub fn new(cell: Cell, heights: Array2<f64>) -> Result<Self, CounterbodyError> {
        let (n1, n2) = heights.dim();
        if heights.is_empty() {
            return Err(CounterbodyError::Empty(n1, n2));
        }
        if let Some(((i, j), &value)) = heights.indexed_iter().find(|(_, height)| !height.is_finite()) {
            return Err(CounterbodyError::Height { place: [i, j], value });
        }
        let heights = if heights.is_standard_layout() { heights } else { heights.as_standard_layout().into_owned() };
        Ok(Self { cell, heights, run_out: None, ball: None, apex: None })
    }

    /// The topography, whose apex is found by the `spectrum` of its heights, which is then not computed once more.
    #[must_use]
    pub fn with_spectrum(self, spectrum: &Spectrum) -> Self {
        let is_own = spectrum.grid().points() == self.points() && self.ball.is_none();
        Self { apex: is_own.then(|| apex_by(spectrum, self.heights()).ok()).flatten(), ..self }
    }

    /// The topography, whose heights were [tapered](super::roughness::tapered), with the run-out at the border of the cell.
    #[must_use]
    pub fn with_run_out(self, run_out: RunOut) -> Self {
        Self { run_out: Some(run_out), ..self }
    }

    /// The topography on a ball of the `radius` > 0, a length, whose apex is the middle of the window of an isolated contact, or of each
    /// periodic cell: heights are those above the ball, h − R + √(R² − r²).
    ///
    /// # Errors
    /// [`CounterbodyError::Ball`] for another radius.
    pub fn on_ball(self, radius: f64) -> Result<Self, CounterbodyError> {
        if radius > 0.0 && radius.is_finite() {
            Ok(Self { ball: Some(radius), apex: None, ..self })
        } else {
            Err(CounterbodyError::Ball(radius))
        }
    }

    /// Radius of the ball that the heights stand on, a length; `None` on a plane.
    pub fn ball(&self) -> Option<f64> {
        self.ball
    }

    /// Run-out at the border of the cell; `None` without a taper.
    pub fn run_out(&self) -> Option<&RunOut> {
        self.run_out.as_ref()
    }

    /// Heights for statistics and spectrum: tapered, but without the run-out below the surface; lengths, axes along a₁ and a₂.
    pub fn own_heights(&self) -> Cow<'_, Array2<f64>> {
        match &self.run_out {
            Some(run_out) => Cow::Owned(run_out.undone(self.heights.clone())),
            None => Cow::Borrowed(&self.heights),
        }
    }

    /// The unit cell.
    pub fn cell(&self) -> Cell {
        self.cell
    }

    /// Heights, lengths, without the ball that they stand on; axes along a₁ and a₂.
    pub fn heights(&self) -> ArrayView2<'_, f64> {
        self.heights.view()
    }

    /// Number of samples [n₁, n₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        self.heights.dim().into()
    }

    /// Depths, of the ball too, below the apex on a grid of `points` = [N₁, N₂], lengths ≥ 0: of the [sum of waves](Spectrum::resampled) through all
    /// samples, without those that the grid cannot hold. The apex is the highest point of that sum, also between the samples: all
    /// grids that hold all waves measure from the same point.
    ///
    /// # Errors
    /// [`LatticeError`] when a number of points is zero.
    pub fn depths(&self, points: [usize; 2]) -> Result<Array2<f64>, LatticeError> {
        let on_grid = match points == self.points() {
            true => self.heights.clone(),
            false => Spectrum::of(self.cell, self.heights.view())?.resampled(points)?,
        };
        let Some(radius) = self.ball else {
            let found = self.apex.filter(|_| points == self.points());
            let apex = found.map_or_else(|| apex(self.cell, on_grid.view()), Ok)?;
            return Ok(on_grid.mapv_into(|height| apex - height));
        };
        // Waves hold no corner: the ball becomes a plane where the apex is not.
        let ball = Shape::Sphere { radius };
        let (border, points) = (self.half_width(), points.map(|n| n as f64));
        let lowest = ball.profile(border);
        let (from, steepness) = PLANE_FROM;
        let beside = self.beside_ball();
        let distance = |(i, j): (usize, usize)| {
            let [x, y] = beside([i as f64 / points[0], j as f64 / points[1]]);
            x.hypot(y)
        };
        let below = |at: (usize, usize)| {
            let r = distance(at);
            let plane = 0.5 * libm::erfc(steepness * (from - r / border));
            ball.profile(r.min(border)) * (1.0 - plane) + lowest * plane
        };
        let smooth = Array2::from_shape_fn(on_grid.dim(), |at| on_grid[at] - below(at));
        let height = |at: (usize, usize)| on_grid[at] - ball.profile(distance(at));
        let highest = on_grid.indexed_iter().map(|(at, _)| height(at)).fold(f64::NEG_INFINITY, f64::max);
        let apex = apex(self.cell, smooth.view())?.max(highest);
        Ok(Array2::from_shape_fn(on_grid.dim(), |at| apex - height(at)))
    }

    /// Estimated height by which a kinked surface with these samples exceeds the apex of the sum of waves, a length ≥ 0; next to nothing for
    /// a smooth one.
    pub fn apex_error(&self) -> f64 {
        let Some(radius) = self.ball else { return above_waves(self.heights(), |_, _| 0.0) };
        let (ball, [n1, n2]) = (Shape::Sphere { radius }, self.points().map(|n| n as f64));
        let beside = self.beside_ball();
        above_waves(self.heights(), |i, j| {
            let [x, y] = beside([i as f64 / n1, j as f64 / n2]);
            ball.profile(x.hypot(y))
        })
    }

    /// Vector from the nearest apex of the ball to the place at fractions of a₁ and a₂, lengths.
    pub(crate) fn beside_ball(&self) -> impl Fn([f64; 2]) -> [f64; 2] + Sync + use<> {
        let (cell, reduced) = (self.cell, self.cell.reduced());
        move |s| match cell.surroundings() {
            Surroundings::FreeSpace => cell.point(s),
            Surroundings::Periodic => reduced.nearest([s[0] - 0.5, s[1] - 0.5]),
        }
    }

    /// Distance from the apex of the ball to the nearest border of its window, or to half the way to the next apex, a length.
    fn half_width(&self) -> f64 {
        match self.cell.surroundings() {
            Surroundings::FreeSpace => {
                let [[width, _], [_, height]] = self.cell.vectors();
                0.5 * width.min(height)
            }
            Surroundings::Periodic => {
                let [x, y] = self.cell.reduced().short();
                0.5 * x.hypot(y)
            }
        }
    }
}

impl fmt::Display for Topography {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [n1, n2] = self.points();
        write!(f, "{}, topography of {n1} × {n2} samples", self.cell)?;
        self.ball.map_or(Ok(()), |radius| write!(f, " on a ball of radius {}", number(radius)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::counterbody::{Indenters, Level, Surface};
    use crate::lattice::Lattice;
    use ndarray::ShapeBuilder;

    #[test]
    fn heights_keep_their_places_in_any_memory_order() {
        let cell = Cell::square(1.0).unwrap();
        let height = |(i, j): (usize, usize)| (10 * i + j) as f64;
        let rows = Topography::new(cell, Array2::from_shape_fn((3, 4), height)).unwrap();
        let columns = Topography::new(cell, Array2::from_shape_fn((3, 4).f(), height)).unwrap();
        assert_eq!(rows.depths([3, 4]), columns.depths([3, 4]));
        assert_eq!((rows.points(), rows.heights()[[2, 3]]), ([3, 4], 23.0));
    }

    #[test]
    fn other_grids_have_the_waves_between_the_samples_below_the_same_apex() {
        let wave = |i: usize, n: usize| (std::f64::consts::TAU * (i as f64 / n as f64 - 0.04)).cos();
        let on = |[n1, n2]: [usize; 2]| Array2::from_shape_fn([n1, n2], |(i, j)| wave(i, n1) + 0.2 * wave(j, n2));
        let surface = Topography::new(Cell::hexagonal(1.0).unwrap(), on([12, 6])).unwrap();
        for points in [[12, 6], [4, 3], [30, 18], [7, 5]] {
            let (depths, expected) = (surface.depths(points).unwrap(), on(points));
            // Both crests, of 1 and 0.2, stand between the samples.
            assert!(depths.indexed_iter().all(|(at, d)| (d - (1.2 - expected[at])).abs() < 1e-14), "{points:?}");
        }
        assert!(surface.depths([0, 3]).is_err());
        let spectrum = Spectrum::of(surface.cell(), surface.heights()).unwrap();
        let known = surface.clone().with_spectrum(&spectrum);
        assert!(known.apex.is_some_and(|apex| (apex - 1.2).abs() < 1e-14));
        assert_eq!(known.depths([12, 6]), surface.depths([12, 6]));
        assert_eq!(known.depths([30, 18]), surface.depths([30, 18]));
    }

    /// Waves that a grid cannot hold are left out, whether or not it divides the samples.
    #[test]
    fn waves_too_short_for_a_grid_are_left_out_on_every_grid() {
        let wave = |k: usize, i: usize, n: usize| (std::f64::consts::TAU * (k * i) as f64 / n as f64).cos();
        let heights = Array2::from_shape_fn((24, 24), |(i, _)| wave(1, i, 24) + wave(7, i, 24));
        let surface = Topography::new(Cell::square(1.0).unwrap(), heights).unwrap();
        for n in [12, 10] {
            let depths = surface.depths([n, n]).unwrap();
            assert!(depths.indexed_iter().all(|((i, _), d)| (d - (1.0 - wave(1, i, n))).abs() < 1e-13), "{n}");
        }
    }

    /// A smooth ball is that of the indenters, also where its apex is between the samples or it is tilted; roughness stands on it.
    #[test]
    fn a_ball_lies_below_its_roughness() {
        let window = Cell::window([1.0, 1.6]).unwrap();
        let ball = Shape::Sphere { radius: 3.0 };
        for points in [[60, 90], [65, 101]] {
            let distance = |i: usize, j: usize, [n1, n2]: [usize; 2]| {
                let [x, y] = window.point([i as f64 / n1 as f64, j as f64 / n2 as f64]);
                x.hypot(y)
            };
            let smooth = Topography::new(window, Array2::zeros(points)).unwrap().on_ball(3.0).unwrap();
            let depths = smooth.depths(points).unwrap();
            for ((i, j), depth) in depths.indexed_iter() {
                // The apex is found to what the waves of its grid leave of the step into the plane.
                assert!((depth - ball.profile(distance(i, j, points))).abs() < 1e-7, "{points:?} {i} {j}: {depth}");
            }
            // Waves of whole periods: on a finer grid the same surface below the same apex.
            let wave = |i: usize, n: usize| 1e-3 * (std::f64::consts::TAU * 3.0 * i as f64 / n as f64).cos();
            let rough = Array2::from_shape_fn(points, |(i, _)| wave(i, points[0]));
            let rough = Topography::new(window, rough).unwrap().on_ball(3.0).unwrap();
            let fine = [120, 180];
            let (coarser, finer) = (rough.depths(points).unwrap(), rough.depths(fine).unwrap());
            let apex = 1e-3 * (std::f64::consts::TAU * 1.5).cos();
            let highest = |depths: &Array2<f64>, points: [usize; 2]| {
                let all = depths
                    .indexed_iter()
                    .map(|((i, j), depth)| depth - ball.profile(distance(i, j, points)) + wave(i, points[0]));
                all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| [low.min(height), high.max(height)])
            };
            let ([low, high], [from, to]) = (highest(&coarser, points), highest(&finer, fine));
            // The rest is the height of the apex: one number on both grids, above the trough of the wave in the middle.
            assert!(high - low < 1e-14 && to - from < 1e-14 && (high - to).abs() < 1e-7, "{low} {high} {from} {to}");
            assert!(high > apex && high < 1e-3, "{high}");
        }
        let flat = |cell: Cell| Topography::new(cell, Array2::zeros((24, 24))).unwrap();
        assert_eq!(flat(Cell::square(1.0).unwrap()).on_ball(0.0), Err(CounterbodyError::Ball(0.0)));
        // In a periodic cell that of an indenter in the middle.
        let lattice = Lattice::new(Cell::hexagonal(1.0).unwrap(), vec![vec![[0.5; 2]]]).unwrap();
        let depths = flat(lattice.cell()).on_ball(3.0).unwrap().depths([24; 2]).unwrap();
        let alone = Indenters::new(lattice, vec![Level::new(ball.clone(), 0.0).unwrap()]).unwrap();
        let surface = Surface::new(&alone.into(), [24; 2]).unwrap();
        assert!(depths.iter().zip(surface.initial_gap()).all(|(a, b)| (a - b).abs() < 1e-7));
    }

    #[test]
    fn empty_and_infinite_heights_are_refused() {
        let cell = Cell::square(1.0).unwrap();
        assert_eq!(Topography::new(cell, Array2::zeros((0, 4))), Err(CounterbodyError::Empty(0, 4)));
        let mut heights = Array2::zeros((2, 2));
        heights[[1, 0]] = f64::INFINITY;
        let refused = CounterbodyError::Height { place: [1, 0], value: f64::INFINITY };
        assert_eq!(Topography::new(cell, heights), Err(refused));
    }
}

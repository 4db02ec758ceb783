//! A tangential traction with fields of its own on the surface, smoothed as the pressure is in [`super::smoothed_surface`].

use super::cubic::CubicInterpolation;
use super::field::StressField;
use super::series::Response;
use super::traction_waves::Wave;
use super::transform::Transform;
use crate::numeric::search::largest;
use rustfft::num_complex::Complex64;

/// Response q_x, q_y smoothed by the Gaussian near edges, then q_x, q_y as smoothed away from edges.
#[derive(Debug)]
pub(super) struct SmoothedShear {
    /// Both factors of each shell.
    factors: Vec<[f64; 2]>,
    mean: [f64; 2],
}

impl SmoothedShear {
    /// Fields with these means, pressures, the waves of each shell times its factor near edges and its factor away from them.
    pub fn new(factors: impl Iterator<Item = [f64; 2]>, mean: [f64; 2]) -> Self {
        Self { factors: factors.collect(), mean }
    }
}

impl Response<4> for SmoothedShear {
    fn shells(&self) -> usize {
        self.factors.len()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, _: [f64; 2], shell: usize, wave: W) -> [Complex64; 4] {
        let ([near, open], [x, y]) = (self.factors[shell], wave.shear());
        [near * x, near * y, open * x, open * y]
    }

    fn mean(&self) -> [f64; 4] {
        let [x, y] = self.mean;
        [x, y, x, y]
    }
}

/// Smoothed fields at the samples of the grid of a series: the four components one after the other; `None` of a traction that follows
/// from the pressure.
pub(super) struct ShearSamples(Option<Vec<f64>>);

impl ShearSamples {
    /// Samples of the smoothed fields, by the transform of their grid.
    pub fn new(field: &StressField, smoothed: Option<&SmoothedShear>, transform: &Transform) -> Self {
        let written = smoothed.map(|smoothed| {
            let mut fields = vec![0.0; 4 * field.series_grid().len()];
            field.series.on_plane(transform, Vec::new(), smoothed).write(&mut fields);
            fields
        });
        Self(written)
    }

    /// Fields near edges and away from them at a sample.
    pub fn at(&self, sample: usize) -> [[f64; 2]; 2] {
        shear_parts(self.0.as_ref().map(|fields| std::array::from_fn(|k| fields[k * (fields.len() / 4) + sample])))
    }

    /// Fields near edges and away from them between the samples of a grid with n₂ columns.
    pub fn between(&self, place: &CubicInterpolation, n2: usize) -> [[f64; 2]; 2] {
        let of = |fields: &[f64], k: usize| {
            let len = fields.len() / 4;
            place.value(&fields[k * len..(k + 1) * len], n2)
        };
        shear_parts(self.0.as_ref().map(|fields| std::array::from_fn(|k| of(fields, k))))
    }

    /// The largest traction as smoothed away from edges, a pressure; `None` of one that follows from the pressure.
    pub fn largest(&self) -> Option<f64> {
        let len = self.0.as_ref()?.len() / 4;
        Some(largest((0..len).map(|sample| self.at(sample)).map(|[_, [x, y]]| x.hypot(y))))
    }
}

/// Fields near edges and away from them, of the components of a [`SmoothedShear`]; zero of a traction that follows from the pressure.
pub(super) fn shear_parts(shear: Option<[f64; 4]>) -> [[f64; 2]; 2] {
    let [x, y, open_x, open_y] = shear.unwrap_or_default();
    [[x, y], [open_x, open_y]]
}

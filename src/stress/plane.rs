//! Planes of constant depth.

use super::field::{REACH, StressField};
use super::series::Response;
use super::slice::Third;
use super::tensor::State;
use super::transform::Transform;
use crate::body::Depth;
use ndarray::{Array2, Array3};
use rustfft::num_complex::Complex64;

/// The states on a plane of constant depth.
#[derive(Debug, Clone)]
pub struct Plane {
    /// Where.
    pub depth: Depth,
    /// Axis 0: xx, yy, zz, xy, xz, yz, then u_x, u_y, u_z; axes 1 and 2 along a₁ and a₂.
    pub components: Array3<f64>,
}

impl Plane {
    /// Samples [n₁, n₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        let (_, n1, n2) = self.components.dim();
        [n1, n2]
    }

    /// The state at the sample [i, j].
    pub fn state(&self, [i, j]: [usize; 2]) -> State {
        State::from_components(std::array::from_fn(|c| self.components[[c, i, j]]))
    }

    /// The states of all samples, axes along a₁ and a₂.
    pub fn states(&self) -> Array2<State> {
        Array2::from_shape_fn(self.points(), |(i, j)| self.state([i, j]))
    }
}

impl StressField {
    /// States on the whole plane, at [n₁, n₂] `points` of the cell, which need not be those of the pressure's grid.
    ///
    /// # Panics
    /// When a number of points is zero, or the depth in a material that is not there.
    pub fn plane(&self, depth: Depth, points: [usize; 2]) -> Plane {
        Plane { depth, components: self.thirds(depth, points, &[0, 1, 2]) }
    }

    /// Stresses alone on the whole plane, as [`Self::plane`] has them. Axis 0: xx, yy, zz, xy, xz, yz.
    ///
    /// # Panics
    /// As [`Self::plane`].
    pub fn stresses(&self, depth: Depth, points: [usize; 2]) -> Array3<f64> {
        self.thirds(depth, points, &[0, 1])
    }

    /// Displacements alone on the whole plane, lengths, as [`Self::plane`] has them. Axis 0: u_x, u_y, u_z.
    ///
    /// # Panics
    /// As [`Self::plane`].
    pub fn displacements(&self, depth: Depth, points: [usize; 2]) -> Array3<f64> {
        self.thirds(depth, points, &[2])
    }

    /// Some of xx, yy, zz (0), xy, xz, yz (1) and u_x, u_y, u_z (2). Three at a time are transformed: that takes as much
    /// room as they do.
    fn thirds(&self, depth: Depth, points: [usize; 2], numbers: &[usize]) -> Array3<f64> {
        let (transform, slice) = (Transform::new(points), self.slice(depth, REACH));
        let [n1, n2] = points;
        let (mut room, mut all) = (Vec::new(), vec![0.0; 3 * numbers.len() * n1 * n2]);
        for (number, fields) in numbers.iter().zip(all.chunks_exact_mut(3 * n1 * n2)) {
            room = match number {
                0 => self.write(&transform, room, &Third::<0>(&slice), fields),
                1 => self.write(&transform, room, &Third::<1>(&slice), fields),
                _ => self.write(&transform, room, &Third::<2>(&slice), fields),
            };
        }
        Array3::from_shape_vec([3 * numbers.len(), n1, n2], all).expect("three fields each")
    }

    fn write(
        &self,
        transform: &Transform,
        room: Vec<Complex64>,
        response: &impl Response<3>,
        fields: &mut [f64],
    ) -> Vec<Complex64> {
        let columns = self.series.on_plane(transform, room, response);
        columns.write(fields);
        columns.into_room()
    }
}

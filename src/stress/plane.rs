//! Planes of constant depth.

use super::field::{REACH, StressField};
use super::series::Response;
use super::slice::Third;
use super::tensor::State;
use super::transform::Transform;
use crate::body::Depth;
use ndarray::{Array2, Array3};

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
        let (transform, slice) = (Transform::new(points), self.slice(depth, REACH));
        let [n1, n2] = points;
        let mut components = Array3::zeros([9, n1, n2]);
        // Three at a time: what they are transformed from takes as much room as they do.
        let thirds = components.as_slice_mut().into_iter().flat_map(|all| all.chunks_exact_mut(3 * n1 * n2));
        for (number, third) in thirds.enumerate() {
            match number {
                0 => self.write(&transform, &Third::<0>(&slice), third),
                1 => self.write(&transform, &Third::<1>(&slice), third),
                _ => self.write(&transform, &Third::<2>(&slice), third),
            }
        }
        Plane { depth, components }
    }

    fn write(&self, transform: &Transform, response: &impl Response<3>, fields: &mut [f64]) {
        self.series.on_plane(transform, response).write(fields);
    }
}

//! Stresses and displacements on planes of constant depth, by inverse transforms.

use super::depth_response::{DisplacementComponents, StressComponents};
use super::field::{REACH, StressField};
use super::tensor::StressState;
use super::transform::Transform;
use crate::body::Depth;
use ndarray::{Array2, Array3, ArrayView3};

/// States on a plane of constant depth, at equally spaced points of the cell.
#[derive(Debug, Clone)]
pub struct DepthPlane {
    /// Depth and material of the plane.
    pub depth: Depth,
    /// Stresses xx, yy, zz, xy, xz, yz (pressures), then u_x, u_y, u_z (lengths), along axis 0; axes 1 and 2 along a₁ and a₂.
    pub components: Array3<f64>,
}

impl DepthPlane {
    /// Number of points [n₁, n₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        let (_, n1, n2) = self.components.dim();
        [n1, n2]
    }

    /// The state at the point [i, j].
    pub fn state(&self, [i, j]: [usize; 2]) -> StressState {
        StressState::from_components(std::array::from_fn(|c| self.components[[c, i, j]]))
    }

    /// The states of all points, axes along a₁ and a₂.
    pub fn states(&self) -> Array2<StressState> {
        Array2::from_shape_fn(self.points(), |(i, j)| self.state([i, j]))
    }
}

impl StressField {
    /// States on a plane at [n₁, n₂] `points` of the cell, which may differ from those of the pressure's grid.
    ///
    /// # Panics
    /// When a number of points is zero, or the depth names a material that does not exist.
    pub fn plane(&self, depth: Depth, points: [usize; 2]) -> DepthPlane {
        let (transform, response, [n1, n2]) = (Transform::new(points), self.depth_response(depth, REACH), points);
        let mut components = vec![0.0; 9 * n1 * n2];
        let (stresses, displacements) = components.split_at_mut(6 * n1 * n2);
        let columns = self.series.on_plane(&transform, Vec::new(), &StressComponents(&response));
        columns.write(stresses);
        self.series
            .on_plane(&transform, columns.into_buffer(), &DisplacementComponents(&response))
            .write(displacements);
        let components = Array3::from_shape_vec([9, n1, n2], components);
        DepthPlane { depth, components: components.expect("nine fields") }
    }

    /// Calls `sink` with the stresses of [`Self::plane`], some rows at a time, from the first to the last; memory holds six
    /// fields transformed along their columns. Axis 0: xx, yy, zz, xy, xz, yz, then τ₁, von Mises and σ₁; axis 1: rows; axis 2
    /// along a₂.
    ///
    /// # Errors
    /// The first error of `sink`, after which it is not called again.
    ///
    /// # Panics
    /// As [`Self::plane`].
    pub fn stresses_by_rows<E>(
        &self,
        depth: Depth,
        points: [usize; 2],
        sink: impl FnMut(ArrayView3<'_, f64>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (transform, response) = (Transform::new(points), self.depth_response(depth, REACH));
        let columns = self.series.on_plane(&transform, Vec::new(), &StressComponents(&response));
        let read = |stresses @ [xx, yy, zz, xy, xz, yz]: [f64; 6]| {
            let [tau1, mises, s1] = StressState::from_stresses(stresses).derived();
            [xx, yy, zz, xy, xz, yz, tau1, mises, s1]
        };
        columns.hand_on(read, sink)
    }

    /// Calls `sink` with the displacements of [`Self::plane`], lengths, some rows at a time, from the first to the last. Axis 0:
    /// u_x, u_y, u_z; axis 1: rows; axis 2 along a₂.
    ///
    /// # Errors
    /// The first error of `sink`, after which it is not called again.
    ///
    /// # Panics
    /// As [`Self::plane`].
    pub fn displacements_by_rows<E>(
        &self,
        depth: Depth,
        points: [usize; 2],
        sink: impl FnMut(ArrayView3<'_, f64>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (transform, response) = (Transform::new(points), self.depth_response(depth, REACH));
        self.series.on_plane(&transform, Vec::new(), &DisplacementComponents(&response)).hand_on(|row| row, sink)
    }
}

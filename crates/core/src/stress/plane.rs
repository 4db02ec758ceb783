//! Stresses and displacements on planes of constant depth, by inverse transforms.

use super::depth_response::{DisplacementComponents, StressComponents};
use super::field::{REACH, StressField};
use super::series_grid::times;
use super::tensor::StressState;
use super::transform::Transform;
use crate::body::Depth;
use ndarray::{Array2, Array3, ArrayView3, Axis, Slice};

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

/// Points of the cell of a series.
struct PlaneAround {
    points: [usize; 2],
    /// Fractions of the first point.
    start: [f64; 2],
}

impl StressField {
    /// States on a plane at [n₁, n₂] `points` of the cell, which may differ from those of the pressure's grid.
    ///
    /// # Panics
    /// When a number of points is zero, or the depth names a material that does not exist.
    pub fn plane(&self, depth: Depth, points: [usize; 2]) -> DepthPlane {
        let (response, around) = (self.depth_response(depth, REACH), self.plane_around(points));
        let (transform, [n1, n2]) = (Transform::new(around.points), around.points);
        let mut components = vec![0.0; 9 * n1 * n2];
        let (stresses, displacements) = components.split_at_mut(6 * n1 * n2);
        let columns = self.series.on_plane_from(around.start, &transform, Vec::new(), &StressComponents(&response));
        columns.write(stresses);
        self.series
            .on_plane_from(around.start, &transform, columns.into_buffer(), &DisplacementComponents(&response))
            .write(displacements);
        let components = Array3::from_shape_vec([9, n1, n2], components).expect("nine fields");
        let components =
            if around.points == points { components } else { first_of(components.view(), points).to_owned() };
        DepthPlane { depth, components }
    }

    /// The points of the cell of the series with which a plane of these `points` of the contact's cell is computed.
    fn plane_around(&self, points: [usize; 2]) -> PlaneAround {
        let times = times(self.grid().cell());
        PlaneAround { points: points.map(|n| times * n), start: self.first_fractions() }
    }

    /// Calls `sink` with the stresses of [`Self::plane`], some rows at a time, from the first to the last; memory holds six
    /// fields transformed along their columns. Axis 0: xx, yy, zz, xy, xz, yz, then τ₁, von Mises and σ₁; axis 1: rows; axis 2
    /// along a₂.
    ///
    /// # Errors
    /// The first error of `sink`, after which it is not called again.
    ///
    /// # Panics
    /// When [`Self::plane`] does.
    pub fn stresses_by_rows<E>(
        &self,
        depth: Depth,
        points: [usize; 2],
        sink: impl FnMut(ArrayView3<'_, f64>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (response, around) = (self.depth_response(depth, REACH), self.plane_around(points));
        let transform = Transform::new(around.points);
        let columns = self.series.on_plane_from(around.start, &transform, Vec::new(), &StressComponents(&response));
        let read = |stresses @ [xx, yy, zz, xy, xz, yz]: [f64; 6]| {
            let [tau1, mises, s1] = StressState::from_stresses(stresses).derived();
            [xx, yy, zz, xy, xz, yz, tau1, mises, s1]
        };
        columns.hand_on(read, cropped(around.points, points, sink))
    }

    /// Calls `sink` with the displacements of [`Self::plane`], lengths, some rows at a time, from the first to the last. Axis 0:
    /// u_x, u_y, u_z; axis 1: rows; axis 2 along a₂.
    ///
    /// # Errors
    /// The first error of `sink`, after which it is not called again.
    ///
    /// # Panics
    /// When [`Self::plane`] does.
    pub fn displacements_by_rows<E>(
        &self,
        depth: Depth,
        points: [usize; 2],
        sink: impl FnMut(ArrayView3<'_, f64>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (response, around) = (self.depth_response(depth, REACH), self.plane_around(points));
        let transform = Transform::new(around.points);
        let columns =
            self.series.on_plane_from(around.start, &transform, Vec::new(), &DisplacementComponents(&response));
        columns.hand_on(|row| row, cropped(around.points, points, sink))
    }
}

/// The first rows and columns of fields.
fn first_of(fields: ArrayView3<'_, f64>, [rows, columns]: [usize; 2]) -> ArrayView3<'_, f64> {
    let mut first = fields;
    first.slice_axis_inplace(Axis(1), Slice::from(..rows));
    first.slice_axis_inplace(Axis(2), Slice::from(..columns));
    first
}

/// A sink of the first `points` of rows of `whole` points, for a sink of the former.
fn cropped<E>(
    whole: [usize; 2],
    points: [usize; 2],
    mut sink: impl FnMut(ArrayView3<'_, f64>) -> Result<(), E>,
) -> impl FnMut(ArrayView3<'_, f64>) -> Result<(), E> {
    let mut passed = 0;
    move |rows| {
        if whole == points {
            return sink(rows);
        }
        let count = rows.len_of(Axis(1)).min(points[0].saturating_sub(passed));
        passed += rows.len_of(Axis(1));
        if count == 0 {
            return Ok(());
        }
        sink(first_of(rows, [count, points[1]]).as_standard_layout().view())
    }
}

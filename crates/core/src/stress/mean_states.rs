//! The state under the mean pressure and traction in each material, which the waves do not have.

use super::tensor::StressState;
use crate::body::{HalfSpace, Interface, MeanStress};
use crate::lattice::Grid;

/// The unit vector across lines along an axis of a grid's cell; along x without lines.
pub(super) fn across(grid: &Grid, line: Option<usize>) -> [f64; 2] {
    line.map_or([1.0, 0.0], |axis| {
        let [x, y] = grid.cell().vectors()[axis];
        let length = x.hypot(y);
        [y / length, -x / length]
    })
}

/// State at the upper face of each material under the mean pressure p̄ and the mean tangential `traction`, with the mean lateral stress of a
/// choice and the unit vector across its lines, and the derivative of its displacement by depth. σ_xz = −q̄_x and σ_yz = −q̄_y at every depth; residual stresses are added.
///
/// Displacements are measured from the mean plane of the deformed surface, or from a rigid base; those under a lateral mean strain are
/// left out.
pub(super) fn mean_states(
    half_space: &HalfSpace,
    (mean, [nx, ny]): (MeanStress, [f64; 2]),
    pressure: f64,
    traction: [f64; 2],
) -> Vec<(StressState, [f64; 3])> {
    let shear = traction.map(|q| -q);
    let mut displacement = [0.0; 3];
    let mut states = Vec::new();
    let materials = half_space.materials().zip(mean.across_and_along(half_space)).zip(half_space.residual_stresses());
    for (index, ((material, lateral), residual)) in materials.enumerate() {
        let [across, along] = lateral.map(|ratio| pressure * ratio);
        let closing = (-pressure - material.poisson() * (across + along)) / material.young();
        let slope = [shear[0] / material.shear(), shear[1] / material.shear(), closing];
        let (xx, yy) = (nx * nx * across + ny * ny * along + residual, ny * ny * across + nx * nx * along + residual);
        let (xy, zz, [xz, yz]) = (nx * ny * (across - along), -pressure, shear);
        states.push((StressState { xx, yy, zz, xy, xz, yz, displacement }, slope));
        if let Some(layer) = half_space.layers().get(index) {
            displacement.iter_mut().zip(slope).for_each(|(u, slope)| *u += slope * layer.thickness());
            if let Interface::Spring { tangential, normal } = layer.interface() {
                let jumps = [shear[0] / tangential, shear[1] / tangential, -pressure / normal];
                displacement.iter_mut().zip(jumps).for_each(|(u, jump)| *u += jump);
            }
        }
    }
    if half_space.substrate().is_rigid() {
        // Displacements of the base have been counted from the surface.
        let all = states.iter_mut().flat_map(|(state, _)| state.displacement.iter_mut().zip(displacement));
        all.for_each(|(u, base)| *u -= base);
    }
    states
}

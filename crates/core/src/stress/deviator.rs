//! The deviator of a stress as a vector of five coordinates, in which the shear stress is a length: |s| = √(½ s:s).

use super::tensor::StressState;

/// The deviator in an orthonormal basis of the norm √(½ s:s).
pub(super) fn deviator(state: &StressState) -> [f64; 5] {
    let StressState { xx, yy, zz, xy, xz, yz, .. } = *state;
    [0.5 * (xx - yy), (2.0 * zz - xx - yy) / 12f64.sqrt(), xy, xz, yz]
}

/// The stress whose deviator it is, without a mean.
pub(super) fn of_deviator([across, along, xy, xz, yz]: [f64; 5]) -> StressState {
    let third = along / 3f64.sqrt();
    StressState { xx: across - third, yy: -across - third, zz: 2.0 * third, xy, xz, yz, ..StressState::default() }
}

/// The hydrostatic stress: the mean of the normal stresses.
pub(super) fn hydrostatic(state: &StressState) -> f64 {
    (state.xx + state.yy + state.zz) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deviator_is_read_back_from_its_coordinates() {
        let state = StressState { xx: 1.0, yy: -2.0, zz: 4.0, xy: 0.3, xz: -0.7, yz: 1.1, ..StressState::default() };
        let coordinates = deviator(&state);
        let size: f64 = coordinates.iter().map(|x| x * x).sum();
        assert!((size - state.invariants().1).abs() < 1e-13);
        let back = of_deviator(coordinates);
        assert!((back.xx - (state.xx - 1.0)).abs() < 1e-14 && (back.zz - 3.0).abs() < 1e-14 && back.yz == 1.1);
    }
}

//! The smooth cut between small and large wavenumbers: φ(s) = ½ erfc(6(2s − 1)).
//!
//! s is the wavenumber over that of the circle inscribed in the zone of the grid. φ is 1 − 10⁻¹⁷ at s = 0 and 10⁻¹⁷ at
//! s = 1: what it keeps lies within the circle, what it leaves is zero at k = 0, both to rounding.

/// Steepness of the cut: ½ erfc(6) = 10⁻¹⁷.
const STEEPNESS: f64 = 6.0;

/// φ(s).
pub(super) fn low_pass(s: f64) -> f64 {
    0.5 * libm::erfc(STEEPNESS * (2.0 * s - 1.0))
}

/// 1 − φ(s), without cancellation.
pub(super) fn high_pass(s: f64) -> f64 {
    0.5 * libm::erfc(STEEPNESS * (1.0 - 2.0 * s))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_parts_are_the_whole_and_end_where_they_must() {
        for k in 0..=100 {
            let s = f64::from(k) / 100.0;
            assert!((low_pass(s) + high_pass(s) - 1.0).abs() < 1e-15);
        }
        assert!(high_pass(0.0) < 1.1e-17 && low_pass(1.0) < 1.1e-17 && low_pass(1.4) < 1e-50);
    }
}

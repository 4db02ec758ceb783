//! Taylor expansion of the stresses below a load that moves over a body that relaxes.
//!
//! Derivatives along the surface are exact sums over the waves, i q_α times each. Amplitudes are complex there, and those in depth are
//! differences over a hundredth of the depth: they lead searches, whose values are exact.

use super::depth_response::{DepthResponse, StressComponents};
use super::eight_waves::{STRESSES, TERMS, TaylorTerms};
use super::far_plane::FarPlane;
use super::field::StressField;
use super::plane_search::SEARCH_REACH;
use super::series::Response;
use super::taylor::Expansion;
use super::traction_waves::Wave;
use crate::body::Depth;
use rustfft::num_complex::Complex64;

/// Part of the depth, and of the thickness of a layer, over which differences are taken.
const STEP: f64 = 0.01;
/// The stresses and their derivatives by x, y, x², xy, y².
const ALONG: usize = 6 * STRESSES;

/// The stresses of a response, and their derivatives along the surface up to the second, squares with the factor ½.
struct WithDerivatives<'a>(&'a DepthResponse);

impl Response<ALONG> for WithDerivatives<'_> {
    fn shells(&self) -> usize {
        self.0.shells()
    }

    fn times<W: Wave>(&self, q @ [x, y]: [f64; 2], shell: usize, wave: W) -> [Complex64; ALONG] {
        let stresses: [Complex64; STRESSES] = StressComponents(self.0).times(q, shell, wave);
        let i = Complex64::I;
        let factors = [1.0.into(), i * x, i * y, (-0.5 * x * x).into(), (-x * y).into(), (-0.5 * y * y).into()];
        let factors: [Complex64; 6] = factors;
        std::array::from_fn(|k| factors[k / STRESSES] * stresses[k % STRESSES])
    }

    fn mean(&self) -> [f64; ALONG] {
        let mean = StressComponents(self.0).mean();
        std::array::from_fn(|k| if k < STRESSES { mean[k] } else { 0.0 })
    }

    fn is_deep(&self) -> bool {
        self.0.is_deep()
    }

    fn far(&self) -> Option<FarPlane<ALONG>> {
        None
    }
}

impl StressField {
    /// Expansion around a place at a depth, by sums at three depths.
    pub(super) fn expand_by_sums(&self, depth: Depth, place: [f64; 2]) -> Expansion {
        let at = |z: f64| -> [f64; ALONG] {
            let response = self.depth_response(Depth { z, ..depth }, SEARCH_REACH);
            self.at(&[place], &WithDerivatives(&response))[0]
        };
        let (top, bottom) = self.half_space().faces(depth.material);
        let step = STEP * depth.z.max(f64::MIN_POSITIVE).min(bottom - top);
        // Beside a face the differences are those of the nearest depth with both neighbours.
        let middle = depth.z.clamp(top + step, (bottom - step).max(top + step));
        let here = at(depth.z);
        let [above, centre, below] =
            [at(middle - step), if middle == depth.z { here } else { at(middle) }, at(middle + step)];
        let mut terms: TaylorTerms = [[0.0; STRESSES]; TERMS];
        for k in 0..STRESSES {
            for (along, term) in terms.iter_mut().take(6).enumerate() {
                term[k] = here[along * STRESSES + k];
            }
            let slope = |along: usize| {
                let index = along * STRESSES + k;
                0.5 * (below[index] - above[index]) / step
            };
            terms[6][k] = slope(0);
            terms[7][k] = slope(1);
            terms[8][k] = slope(2);
            terms[9][k] = 0.5 * (below[k] - 2.0 * centre[k] + above[k]) / (step * step);
        }
        Expansion { depth, place, terms }
    }
}

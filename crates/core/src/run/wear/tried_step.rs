//! A step of wear that is tried, and its error.
//!
//! By TR-BDF2 (Bank et al., IEEE Trans. CAD 4 (1985) 436; Hosea & Shampine, Appl. Numer. Math. 20 (1996) 21): with d = 1 − 1/√2,
//! w = √2/4 and the pressures p₀ at the start, p₁ after 2dΔs, p₂ at the end,
//!
//! h₁ = h₀ + k d Δs (p₀ + p₁),  h₂ = h₀ + k Δs [w (p₀ + p₁) + d p₂]:
//!
//! two implicit steps over dΔs, each after wear by known pressures. It is of second order and stable for any length, its weights are
//! positive, and their sum is one: the worn volume k P Δs under a given force P is exact. Waves that wear away within a step are gone at
//! its end. With the same pressures a third order has other weights, and the difference is the error of the step,
//!
//! k Δs [(√2−1) p₀ − p₁ + (2−√2) p₂]/3.
//!
//! The largest of it is compared with the largest depth worn in the step, or with a tenth of that worn so far where this is more: errors
//! where contact reaches a point are made once at each point, and do not add up.

use super::path::WearPath;
use super::worn_step::{largest, worn_depth};
use crate::load::Load;
use crate::numeric::array::samples;
use crate::spectral::{Solver, Step, Stop, WearError, WearState, Worn};
use ndarray::Array2;

/// d and w of TR-BDF2.
const IMPLICIT: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
const EXPLICIT: f64 = 0.5 * std::f64::consts::FRAC_1_SQRT_2;
/// Weights of its error on the three pressures.
const ERROR: [f64; 3] = [(std::f64::consts::SQRT_2 - 1.0) / 3.0, -1.0 / 3.0, (2.0 - std::f64::consts::SQRT_2) / 3.0];
/// Part of the depth worn so far with which the error of a step is compared at least.
const OF_ALL: f64 = 0.1;

/// A step that was tried.
#[derive(Debug)]
pub(super) struct Tried {
    /// The contact at its end, unless it is not solved.
    pub step: Option<Step>,
    pub stop: Stop,
    /// Errors of the depth, lengths, and the largest over the depth worn in the step or a tenth of all.
    pub errors: Array2<f64>,
    pub relative: f64,
    /// Relative change of the largest pressure.
    change: f64,
    pub convolutions: f64,
}

impl Tried {
    /// The larger of two ratios: error over tolerance, and change of the largest pressure over its limit. A step of at most 1 is accepted.
    pub fn excess(&self, path: &WearPath) -> f64 {
        (self.relative / path.tolerance).max(self.change / path.change)
    }
}

impl WearPath {
    /// A step from the `present`; the solver is left at its end.
    pub(super) fn tried(
        &self,
        solver: &mut Solver,
        started: f64,
        present: &WearState,
        length: f64,
    ) -> Result<Tried, WearError> {
        let [implicit, explicit] = [IMPLICIT, EXPLICIT].map(|part| part * length);
        solver.wear_by(&[(present, implicit)], &self.wear)?;
        let middle = solver.wear(self.load_now(solver, started), &self.wear, implicit)?;
        let mut tried = Tried {
            step: None,
            stop: middle.report.stop,
            errors: Array2::zeros([0, 0]),
            relative: 0.0,
            change: 0.0,
            convolutions: middle.convolutions,
        };
        if !tried.stop.solved() {
            return Ok(tried);
        }
        drop(middle);
        let middle = solver.wear_state();
        // From the start again, with the pressure of the middle as the first guess.
        solver.return_to_surfaces(present);
        solver.wear_by(&[(present, explicit), (&middle, explicit)], &self.wear)?;
        let step = solver.wear(self.load_now(solver, started), &self.wear, implicit)?;
        tried.stop = step.report.stop;
        tried.convolutions += step.convolutions;
        if !tried.stop.solved() {
            return Ok(tried);
        }
        let end = solver.wear_state();
        let moments = [present, &middle, &end];
        let depth = |weights: [f64; 3]| {
            let weighted: Vec<_> = moments.into_iter().zip(weights.map(|weight| weight * length)).collect();
            solver.depth_by(&weighted, &self.wear)
        };
        tried.errors = depth(ERROR)?;
        let of_step = largest(samples(&depth([EXPLICIT, EXPLICIT, IMPLICIT])?));
        let all = self.before + largest(samples(&worn_depth(solver)));
        let scale = of_step.max(OF_ALL * all);
        tried.relative = if scale > 0.0 { largest(samples(&tried.errors)) / scale } else { 0.0 };
        let [before, after] = [present, &end].map(|moment| largest(moment.pressure()));
        tried.change = if before > 0.0 { (after / before - 1.0).abs() } else { 0.0 };
        tried.step = Some(step);
        Ok(tried)
    }

    /// The load on the surfaces as they are worn by now.
    fn load_now(&self, solver: &Solver, started: f64) -> Load {
        let receded = solver.worn().map_or(0.0, Worn::recession) - started;
        match self.load {
            Load::Penetration(penetration) => Load::Penetration(penetration - receded),
            load => load,
        }
    }
}

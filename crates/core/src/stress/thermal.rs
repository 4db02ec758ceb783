//! Stresses by heat at one depth, by the waves of the flux into a body.

use super::passed_shells::PassedShells;
use crate::body::{Amplitudes, Depth};
use crate::heat::{HeatedBody, ThermalStress};
use crate::numeric::parallel;
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// Fewest shells of a parallel task.
const MIN_PARALLEL: usize = 512;

/// Thermal stresses of the waves of a grid in a heated body.
#[derive(Debug)]
pub(super) struct Thermal {
    shells: Arc<PassedShells>,
    body: HeatedBody,
    waves: Vec<ThermalStress>,
}

/// Amplitudes of thermal stresses at one depth over the flux, by shell.
#[derive(Debug)]
pub(super) struct ThermalAmplitudes {
    shells: Arc<PassedShells>,
    all: Vec<Amplitudes<Complex64>>,
}

impl Thermal {
    /// Stresses of the waves in `shells` in a body.
    pub fn new(shells: &Arc<PassedShells>, body: &HeatedBody) -> Self {
        let waves = shells.map(|wavevector| body.thermal_stress(wavevector));
        Self { shells: Arc::clone(shells), body: body.clone(), waves }
    }

    /// Whether the stresses are those of a body by the waves in `shells`.
    pub fn is_of(&self, shells: &Arc<PassedShells>, body: &HeatedBody) -> bool {
        self.shells.are(shells) && self.body == *body
    }

    /// Amplitudes of the first `count` shells at a depth.
    pub fn at(&self, count: usize, depth: Depth) -> ThermalAmplitudes {
        let all = parallel::map_by(MIN_PARALLEL, count, |shell| self.waves[shell].at(depth));
        ThermalAmplitudes { shells: Arc::clone(&self.shells), all }
    }
}

impl ThermalAmplitudes {
    /// Real and imaginary parts of the amplitudes at the wavevector **q** of a shell: waves against the motion have the conjugate.
    #[inline(always)]
    pub fn of(&self, q: [f64; 2], shell: usize) -> [Amplitudes; 2] {
        let (a, sign) = (&self.all[shell], self.shells.sign(q));
        let part = |of: fn(Complex64) -> f64, sign: f64| Amplitudes {
            szz: sign * of(a.szz),
            sqz: sign * of(a.sqz),
            sqq: sign * of(a.sqq),
            stt: sign * of(a.stt),
            uz: sign * of(a.uz),
            uq: sign * of(a.uq),
        };
        [part(|x| x.re, 1.0), part(|x| x.im, sign)]
    }
}

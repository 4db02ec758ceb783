//! Waves of a traction: those of the pressure, and those of tangential tractions that do not follow from it.

use rustfft::num_complex::Complex64;
use std::ops::Mul;

/// Coefficients of one wave of a traction, pressures.
#[derive(Debug, Clone, Copy)]
pub(super) struct TractionWave {
    pub pressure: Complex64,
    /// q_x and q_y; `None` where they follow from the pressure.
    pub shear: Option<[Complex64; 2]>,
}

impl<T: Copy> Mul<T> for TractionWave
where
    Complex64: Mul<T, Output = Complex64>,
{
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self { pressure: self.pressure * factor, shear: self.shear.map(|[x, y]| [x * factor, y * factor]) }
    }
}

/// Coefficients of all waves of a traction, in the order of the waves of a grid.
#[derive(Debug, Clone)]
pub(super) struct TractionWaves {
    pub pressure: Vec<Complex64>,
    /// Those of q_x and q_y; `None` where they follow from the pressure.
    pub shear: Option<[Vec<Complex64>; 2]>,
}

impl TractionWaves {
    /// Coefficients of the wave of a number.
    #[inline(always)]
    pub fn at(&self, number: usize) -> TractionWave {
        TractionWave {
            pressure: self.pressure[number],
            shear: self.shear.as_ref().map(|[x, y]| [x[number], y[number]]),
        }
    }

    /// Coefficients times a factor of the number of each wave.
    #[must_use]
    pub fn scaled(mut self, factor: impl Fn(usize) -> f64) -> Self {
        for all in [&mut self.pressure].into_iter().chain(self.shear.iter_mut().flatten()) {
            all.iter_mut().enumerate().for_each(|(number, c)| *c *= factor(number));
        }
        self
    }
}

//! Waves of a traction: those of the pressure, and those of tangential tractions that do not follow from it.

use rustfft::num_complex::Complex64;
use std::ops::Mul;

/// Coefficients of one wave of a traction, pressures: of a pressure alone, from which any tangential traction follows, or of a
/// pressure and q_x, q_y.
pub(super) trait Wave: Copy + Mul<f64, Output = Self> + Mul<Complex64, Output = Self> {
    /// Whether q_x and q_y have coefficients of their own.
    const HAS_SHEAR: bool;

    /// A wave of these coefficients.
    fn new(pressure: Complex64, shear: impl FnOnce() -> [Complex64; 2]) -> Self;

    /// Coefficient of the pressure.
    fn pressure(self) -> Complex64;

    /// Coefficients of q_x and q_y; zero where they follow from the pressure.
    fn shear(self) -> [Complex64; 2];
}

impl Wave for Complex64 {
    const HAS_SHEAR: bool = false;

    #[inline(always)]
    fn new(pressure: Complex64, _: impl FnOnce() -> [Complex64; 2]) -> Self {
        pressure
    }

    #[inline(always)]
    fn pressure(self) -> Complex64 {
        self
    }

    #[inline(always)]
    fn shear(self) -> [Complex64; 2] {
        Default::default()
    }
}

/// Coefficients of a pressure and of tangential tractions of its own, pressures.
#[derive(Debug, Clone, Copy)]
pub(super) struct TractionWave {
    pressure: Complex64,
    /// q_x and q_y.
    shear: [Complex64; 2],
}

impl Wave for TractionWave {
    const HAS_SHEAR: bool = true;

    #[inline(always)]
    fn new(pressure: Complex64, shear: impl FnOnce() -> [Complex64; 2]) -> Self {
        Self { pressure, shear: shear() }
    }

    #[inline(always)]
    fn pressure(self) -> Complex64 {
        self.pressure
    }

    #[inline(always)]
    fn shear(self) -> [Complex64; 2] {
        self.shear
    }
}

impl<T: Copy> Mul<T> for TractionWave
where
    Complex64: Mul<T, Output = Complex64>,
{
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self { pressure: self.pressure * factor, shear: self.shear.map(|q| q * factor) }
    }
}

/// Coefficients of all waves of a traction, in the order of the waves of a grid.
#[derive(Debug, Clone)]
pub(super) struct TractionWaves {
    pub pressure: Vec<Complex64>,
    /// Coefficients of q_x and q_y; `None` where they follow from the pressure.
    pub shear: Option<[Vec<Complex64>; 2]>,
}

impl TractionWaves {
    /// Coefficients of the wave of a number.
    #[inline(always)]
    pub fn at<W: Wave>(&self, number: usize) -> W {
        let shear = || self.shear.as_ref().map_or_else(Default::default, |[x, y]| [x[number], y[number]]);
        W::new(self.pressure[number], shear)
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

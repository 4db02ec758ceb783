//! Waves of a traction: those of the pressure, those of tangential tractions that have waves of their own, and those of the heat that flows in.

use rustfft::num_complex::Complex64;
use std::ops::Mul;

/// Coefficients of one wave of a traction, pressures: of a pressure alone, from which any tangential traction follows, or of a
/// pressure and q_x, q_y.
pub(super) trait Wave: Copy + Mul<f64, Output = Self> + Mul<Complex64, Output = Self> {
    /// Whether q_x and q_y have coefficients of their own.
    const HAS_SHEAR: bool;

    /// A wave of these coefficients: of the pressure, of q_x and q_y, and of the flux of heat.
    fn new(pressure: Complex64, shear: impl FnOnce() -> [Complex64; 2], heat: impl FnOnce() -> Complex64) -> Self;

    /// Coefficient of the pressure.
    fn pressure(self) -> Complex64;

    /// Coefficients of q_x and q_y; zero where they follow from the pressure.
    fn shear(self) -> [Complex64; 2];

    /// Coefficient of the flux of heat into the body, a power per area; zero without heat.
    fn heat(self) -> Complex64;
}

impl Wave for Complex64 {
    const HAS_SHEAR: bool = false;

    #[inline(always)]
    fn new(pressure: Complex64, _: impl FnOnce() -> [Complex64; 2], _: impl FnOnce() -> Complex64) -> Self {
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

    #[inline(always)]
    fn heat(self) -> Complex64 {
        Complex64::default()
    }
}

/// Coefficients of a pressure and of tangential tractions of its own, pressures, and of a flux of heat, a power per area.
#[derive(Debug, Clone, Copy)]
pub(super) struct TractionWave {
    pressure: Complex64,
    /// q_x and q_y.
    shear: [Complex64; 2],
    heat: Complex64,
}

impl Wave for TractionWave {
    const HAS_SHEAR: bool = true;

    #[inline(always)]
    fn new(pressure: Complex64, shear: impl FnOnce() -> [Complex64; 2], heat: impl FnOnce() -> Complex64) -> Self {
        Self { pressure, shear: shear(), heat: heat() }
    }

    #[inline(always)]
    fn pressure(self) -> Complex64 {
        self.pressure
    }

    #[inline(always)]
    fn shear(self) -> [Complex64; 2] {
        self.shear
    }

    #[inline(always)]
    fn heat(self) -> Complex64 {
        self.heat
    }
}

impl<T: Copy> Mul<T> for TractionWave
where
    Complex64: Mul<T, Output = Complex64>,
{
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: T) -> Self {
        Self { pressure: self.pressure * factor, shear: self.shear.map(|q| q * factor), heat: self.heat * factor }
    }
}

/// Coefficients of all waves of a traction, in the order of the waves of a grid.
#[derive(Debug, Clone)]
pub(super) struct TractionWaves {
    pub pressure: Vec<Complex64>,
    /// Coefficients of q_x and q_y; `None` where they follow from the pressure.
    pub shear: Option<[Vec<Complex64>; 2]>,
    /// Coefficients of the flux of heat into the body, beside those of q_x and q_y; `None` without heat.
    pub heat: Option<Vec<Complex64>>,
}

impl TractionWaves {
    /// Coefficients of the wave of a number.
    #[inline(always)]
    pub fn at<W: Wave>(&self, number: usize) -> W {
        let shear = || self.shear.as_ref().map_or_else(Default::default, |[x, y]| [x[number], y[number]]);
        W::new(self.pressure[number], shear, || self.heat.as_ref().map_or_else(Default::default, |heat| heat[number]))
    }

    /// Coefficients with those of a `flux` of heat beside them; q_x and q_y have a `ratio` to the pressure unless they have waves of their own.
    #[must_use]
    pub fn heated(self, flux: Vec<Complex64>, ratio: Option<[f64; 2]>) -> Self {
        let rubbed = |ratio: f64| self.pressure.iter().map(|p| ratio * p).collect();
        let shear = self.shear.clone().unwrap_or_else(|| ratio.unwrap_or_default().map(rubbed));
        Self { shear: Some(shear), heat: Some(flux), ..self }
    }

    /// Coefficients times a factor of the number of each wave.
    #[must_use]
    pub fn scaled(mut self, factor: impl Fn(usize) -> f64) -> Self {
        for all in [&mut self.pressure].into_iter().chain(self.shear.iter_mut().flatten()).chain(&mut self.heat) {
            all.iter_mut().enumerate().for_each(|(number, c)| *c *= factor(number));
        }
        self
    }
}

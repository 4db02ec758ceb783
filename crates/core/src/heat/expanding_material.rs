//! Stress function of heat in one material: Goodier's part, and four numbers for what the faces ask.

use super::conducting_material::ConductingMaterial;
use super::goodier::Goodier;
use crate::body::{Amplitudes, Moduli, stress_function_derivatives};
use rustfft::num_complex::Complex64;

/// One material with its moduli.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ExpandingMaterial {
    pub heat: ConductingMaterial,
    pub elastic: Moduli,
    /// 2G(1+ν)/(1−ν) α, a pressure per temperature.
    pub modulus: f64,
}

/// F, F′, 2k u_z and 2k u_q at a face of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Face {
    /// Each of them by the four numbers.
    pub rows: [[f64; 4]; 4],
    /// Parts of Goodier's potential, one a row.
    pub goodier: [Complex64; 4],
}

impl ExpandingMaterial {
    /// F and its first three derivatives of each of the four numbers at a distance below the upper face; zero of those that the substrate
    /// does not have.
    fn derivatives(&self, below: f64) -> [[f64; 4]; 4] {
        let k = self.heat.rate.wavenumber;
        std::array::from_fn(|number| {
            if number > 1 && self.heat.thickness.is_infinite() {
                return [0.0; 4];
            }
            let one = std::array::from_fn(|other| f64::from(u8::from(other == number)));
            stress_function_derivatives(&one, k * below, k * self.heat.thickness)
        })
    }

    /// Face at a distance below the upper one.
    pub fn face(&self, below: f64) -> Face {
        let Moduli { shear, poisson } = self.elastic;
        let derivatives = self.derivatives(below);
        let displacement = |[f0, f1, f2, f3]: [f64; 4]| {
            [((1.0 - poisson) * f3 - (2.0 - poisson) * f1) / shear, ((1.0 - poisson) * f2 + poisson * f0) / shear]
        };
        let rows =
            std::array::from_fn(|row| derivatives.map(|of| if row < 2 { of[row] } else { displacement(of)[row - 2] }));
        let Goodier { function, slope, .. } = Goodier::at(&self.heat, self.modulus, below);
        Face { rows, goodier: [function, slope, -slope / shear, function / shear] }
    }

    /// Amplitudes from the four numbers at a distance below the upper face, over the flux into the surface.
    pub fn amplitudes(&self, numbers: &[Complex64; 4], below: f64) -> Amplitudes<Complex64> {
        let Moduli { shear, poisson } = self.elastic;
        let derivatives = self.derivatives(below);
        let sum = |order: usize| (0..4).map(|number| numbers[number] * derivatives[number][order]).sum::<Complex64>();
        let [f0, f1, f2, f3] = [0, 1, 2, 3].map(sum);
        let Goodier { function, slope, membrane } = Goodier::at(&self.heat, self.modulus, below);
        let per_displacement = 0.5 / (shear * self.heat.rate.wavenumber);
        Amplitudes {
            szz: -(f0 + function),
            sqz: f1 + slope,
            sqq: f2 + function - membrane,
            stt: (f2 - f0) * poisson - membrane,
            uz: (f3 * (1.0 - poisson) - f1 * (2.0 - poisson) - slope) * per_displacement,
            uq: (f2 * (1.0 - poisson) + f0 * poisson + function) * per_displacement,
        }
    }
}

//! Strains by Hooke's law of an isotropic material from its stresses,
//!
//! ε_ij = [(1 + ν) σ_ij − ν σ_kk δ_ij]/E,
//!
//! positive in extension, as σ is in tension; ε_xy, ε_xz and ε_yz are components of the tensor, half the shear angles γ. The stresses are
//! those stated, residual ones included, so that ε is the elastic strain, from the state without stress. Across a bonded interface ε_xx,
//! ε_yy and ε_xy are continuous, but for the misfit (1 − ν)σ_r/E of a residual stress σ_r and that of an expansion αT by heat, which is no part of ε.

use super::tensor::StressState;
use crate::body::Material;
use ndarray::{Array3, ArrayView3};

/// Compliance of an isotropic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compliance {
    /// (1 + ν)/E, one over a pressure.
    shear: f64,
    /// ν/E, one over a pressure.
    lateral: f64,
    /// √(1 + 2ν²)/E, one over a pressure: the largest ε_nn of any direction **n** over the size √(Σσᵢⱼ²) of the stresses.
    size: f64,
}

impl From<Material> for Compliance {
    fn from(material: Material) -> Self {
        let (young, nu) = (material.young(), material.poisson());
        Self { shear: (1.0 + nu) / young, lateral: nu / young, size: (1.0 + 2.0 * nu * nu).sqrt() / young }
    }
}

impl Compliance {
    /// Strain under the stresses of a state.
    pub fn strain(&self, state: &StressState) -> StrainState {
        let common = self.lateral * (state.xx + state.yy + state.zz);
        let StressState { xx, yy, zz, xy, xz, yz, .. } = *state;
        let [xx, yy, zz] = [xx, yy, zz].map(|normal| self.shear * normal - common);
        let [xy, xz, yz] = [xy, xz, yz].map(|shear| self.shear * shear);
        StrainState { xx, yy, zz, xy, xz, yz }
    }

    /// The ten numbers of [`StrainState::all`] (axis 0) of stresses xx, yy, zz, xy, xz, yz, which may be followed by others, along axis 0.
    pub fn strains(&self, stresses: ArrayView3<'_, f64>) -> Array3<f64> {
        let (_, rows, points) = stresses.dim();
        let mut strains = Array3::zeros([StrainState::NAMES.len(), rows, points]);
        for row in 0..rows {
            for point in 0..points {
                let state = StressState::from_stresses(std::array::from_fn(|c| stresses[[c, row, point]]));
                let all = self.strain(&state).all();
                (0..).zip(all).for_each(|(c, value)| strains[[c, row, point]] = value);
            }
        }
        strains
    }

    /// Largest principal strain under stresses of the mean σ_kk/3 whose largest principal stress is `first`; pressures.
    pub(super) fn first(&self, first: f64, mean: f64) -> f64 {
        self.shear * first - 3.0 * self.lateral * mean
    }

    /// √(1 + 2ν²)/E, one over a pressure: normal strains of any direction change by as much at most, times the size of added stresses.
    ///
    /// ε_nn is the product of the stresses with the tensor [(1 + ν) n_i n_j − ν δ_ij]/E, whose size it is.
    pub(super) fn size(&self) -> f64 {
        self.size
    }
}

/// Strain at a point, positive in extension; the shears are components of the tensor, half the shear angles.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StrainState {
    /// Strain ε_xx.
    pub xx: f64,
    /// Strain ε_yy.
    pub yy: f64,
    /// Strain ε_zz.
    pub zz: f64,
    /// Strain ε_xy.
    pub xy: f64,
    /// Strain ε_xz.
    pub xz: f64,
    /// Strain ε_yz.
    pub yz: f64,
}

impl StrainState {
    /// Names of the numbers of [`Self::all`].
    pub const NAMES: [&str; 10] = ["exx", "eyy", "ezz", "exy", "exz", "eyz", "e1", "e2", "e3", "ev"];

    /// Components xx, yy, zz, xy, xz, yz.
    pub fn components(&self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz]
    }

    /// Principal strains ε₁ ≥ ε₂ ≥ ε₃, the eigenvalues of the tensor.
    pub fn principal(&self) -> [f64; 3] {
        StressState::from_stresses(self.components()).principal()
    }

    /// Volumetric strain ε_kk.
    pub fn volume(&self) -> f64 {
        self.xx + self.yy + self.zz
    }

    /// Largest normal strain of the horizontal directions, ½(ε_xx + ε_yy) + √(¼(ε_xx − ε_yy)² + ε_xy²).
    pub fn horizontal(&self) -> f64 {
        0.5 * (self.xx + self.yy) + (0.5 * (self.xx - self.yy)).hypot(self.xy)
    }

    /// Components, principal strains and volumetric strain, in the order of [`Self::NAMES`].
    pub fn all(&self) -> [f64; 10] {
        let ([xx, yy, zz, xy, xz, yz], [first, second, third]) = (self.components(), self.principal());
        [xx, yy, zz, xy, xz, yz, first, second, third, self.volume()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(stresses: [f64; 6]) -> StressState {
        StressState::from_stresses(stresses)
    }

    #[test]
    fn a_bar_that_is_pulled_lengthens_by_its_modulus_and_thins_by_poissons_ratio() {
        let compliance = Compliance::from(Material::from_young(200.0, 0.3).unwrap());
        let strain = compliance.strain(&state([0.0, 0.0, 10.0, 0.0, 0.0, 0.0]));
        let expected = [-0.015, -0.015, 0.05, 0.0, 0.0, 0.0];
        assert!(strain.components().iter().zip(expected).all(|(found, due)| (found - due).abs() < 1e-16), "{strain:?}");
        assert!((strain.volume() - 0.02).abs() < 1e-16 && (strain.horizontal() + 0.015).abs() < 1e-16);
        assert!(strain.principal().iter().zip([0.05, -0.015, -0.015]).all(|(found, due)| (found - due).abs() < 1e-15));
        // γ = τ/G, and the tensor has half of it.
        let sheared = compliance.strain(&state([0.0, 0.0, 0.0, 0.0, 10.0, 0.0]));
        let half = 0.5 * 10.0 / (200.0 / 2.6);
        assert!((sheared.xz - half).abs() < 1e-16 && (sheared.principal()[0] - half).abs() < 1e-15);
    }

    #[test]
    fn an_incompressible_material_keeps_its_volume() {
        let compliance = Compliance::from(Material::from_young(3.0, 0.5).unwrap());
        let strain = compliance.strain(&state([-1.0, 0.3, -2.0, 0.4, -0.7, 0.1]));
        assert!(strain.volume().abs() < 1e-15 && strain.principal()[0] > 0.1, "{strain:?}");
        let pressed = compliance.strain(&state([-1.0, -1.0, -1.0, 0.0, 0.0, 0.0]));
        assert!(pressed.components().iter().all(|component| component.abs() < 1e-15));
    }

    #[test]
    fn strains_of_fields_are_those_of_their_points() {
        let compliance = Compliance::from(Material::from_young(7.0, 0.25).unwrap());
        let fields = Array3::from_shape_fn([9, 2, 3], |(c, i, j)| ((7 * c + 3 * i + j) as f64).sin());
        let strains = compliance.strains(fields.view());
        assert_eq!(strains.dim(), (10, 2, 3));
        for (i, j) in (0..2).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let all = compliance.strain(&state(std::array::from_fn(|c| fields[[c, i, j]]))).all();
            assert!((0..10).all(|c| strains[[c, i, j]] == all[c]));
        }
    }
}

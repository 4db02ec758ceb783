//! Stress under the mean pressure p̄, the component q = 0 that the periodic problem alone leaves open in the plane.
//!
//! σ_zz = −p̄ everywhere; the shears vanish. The lateral stress σ_xx = σ_yy depends on what surrounds the periodic
//! system:
//!
//! - **confined**: no mean lateral strain, σ_xx = −ν/(1−ν) p̄ in each material.
//! - **half-space**: the centre of a disc loaded by p̄ that is wide against every thickness. In the substrate σ_xx =
//!   −(1+2ν₂)p̄/2, with the lateral strain ε₂ = −p̄(1−2ν₂)(1+ν₂)/(2E₂), which is imposed on each layer whose way down
//!   to the substrate carries shear (bonded or spring: the load is wide against the length over which a spring slips):
//!   σ_xx = Eε₂/(1−ν) − νp̄/(1−ν). Layers above a frictionless interface are a laminate of their own, a wide sheet
//!   whose loaded disc wants to spread: with A₁₁ = Σ Eh/(1−ν²) and T = Σ hνp̄/(1−ν) its strain is ε = T/(2A₁₁) (a disc
//!   in an infinite sheet; for one layer σ_xx = −νp̄/2).

use crate::material::{HalfSpace, Interface, Material};

/// What the mean lateral stress is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum MeanStress {
    /// No mean lateral strain: the periodic system fills the plane.
    #[default]
    Confined,
    /// The centre of a wide loaded disc on the half-space.
    HalfSpace,
}

impl MeanStress {
    /// σ_xx = σ_yy in each material (layers from the surface down, then the substrate) for p̄ = 1.
    pub fn lateral(self, half_space: &HalfSpace) -> Vec<f64> {
        let materials = half_space.layers().iter().map(|layer| layer.material()).chain([half_space.substrate()]);
        match self {
            Self::Confined => materials.map(|material| stress_at(material, 0.0)).collect(),
            Self::HalfSpace => materials
                .zip(lateral_strains(half_space))
                .map(|(material, strain)| stress_at(material, strain))
                .collect(),
        }
    }
}

/// Lateral stress at the lateral strain ε under σ_zz = −1.
fn stress_at(material: Material, strain: f64) -> f64 {
    (material.young() * strain - material.poisson()) / (1.0 - material.poisson())
}

/// Lateral strain of each material under a wide disc loaded by p̄ = 1.
fn lateral_strains(half_space: &HalfSpace) -> Vec<f64> {
    let substrate = half_space.substrate();
    let nu = substrate.poisson();
    let mut strain = -(1.0 - 2.0 * nu) * (1.0 + nu) / (2.0 * substrate.young());
    let layers = half_space.layers();
    let mut strains = vec![strain; layers.len() + 1];
    for (index, layer) in layers.iter().enumerate().rev() {
        if layer.interface() == Interface::Frictionless {
            // The laminate of this layer and all above it that hold to it.
            let top = layers[..index]
                .iter()
                .rposition(|above| above.interface() == Interface::Frictionless)
                .map_or(0, |above| above + 1);
            let (mut stiffness, mut push) = (0.0, 0.0);
            for layer in &layers[top..=index] {
                let (material, h) = (layer.material(), layer.thickness());
                stiffness += h * material.young() / (1.0 - material.poisson() * material.poisson());
                push += h * material.poisson() / (1.0 - material.poisson());
            }
            strain = push / (2.0 * stiffness);
        }
        strains[index] = strain;
    }
    strains
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Layer;

    fn coated(interfaces: &[Interface]) -> HalfSpace {
        let coating = Material::from_young(5.0, 0.2).unwrap();
        let layers = interfaces.iter().map(|&interface| Layer::new(coating, 0.1, interface).unwrap()).collect();
        HalfSpace::new(layers, Material::from_young(1.0, 0.3).unwrap())
    }

    #[test]
    fn the_substrate_is_that_of_a_wide_disc_and_a_bonded_layer_follows_it() {
        let lateral = MeanStress::HalfSpace.lateral(&coated(&[Interface::Bonded]));
        assert!((lateral[1] + 0.8).abs() < 1e-15, "−(1+2ν₂)/2");
        let strain = -0.4 * 1.3 / 2.0;
        assert!((lateral[0] - (5.0 * strain - 0.2) / 0.8).abs() < 1e-15);
        let confined = MeanStress::Confined.lateral(&coated(&[Interface::Bonded]));
        assert!((confined[0] + 0.25).abs() < 1e-15 && (confined[1] + 0.3 / 0.7).abs() < 1e-15);
    }

    #[test]
    fn an_uncoated_half_space_follows_its_own_law() {
        let bare = coated(&[]);
        assert!((MeanStress::HalfSpace.lateral(&bare)[0] + 0.8).abs() < 1e-15);
    }

    #[test]
    fn sliding_layers_spread_on_their_own_however_they_are_counted() {
        let one = MeanStress::HalfSpace.lateral(&coated(&[Interface::Frictionless]));
        let two = MeanStress::HalfSpace.lateral(&coated(&[Interface::Bonded, Interface::Frictionless]));
        assert!((one[0] + 0.1).abs() < 1e-15, "−ν/2");
        assert!((two[0] + 0.1).abs() < 1e-15 && (two[1] + 0.1).abs() < 1e-15);
        assert!((one[1] + 0.8).abs() < 1e-15);
    }

    #[test]
    fn a_material_of_its_substrate_is_no_layer() {
        let substrate = Material::from_young(1.0, 0.3).unwrap();
        let layer = Layer::new(substrate, 0.3, Interface::Bonded).unwrap();
        for mean in [MeanStress::Confined, MeanStress::HalfSpace] {
            let lateral = mean.lateral(&HalfSpace::new(vec![layer], substrate));
            assert!((lateral[0] - lateral[1]).abs() < 1e-15);
        }
    }
}

//! Lateral stress under the mean pressure p̄, the component q = 0 that the periodic problem alone leaves open in the plane.

use super::{HalfSpace, Interface, Layer, Material};
use serde::Serialize;

/// Assumption for the mean lateral stress.
///
/// σ_zz = −p̄ everywhere; the shears vanish. The lateral stress σ_xx = σ_yy depends on what surrounds the periodic
/// system:
///
/// - **confined**: no mean lateral strain, σ_xx = −ν/(1−ν) p̄ in each material.
/// - **half-space**: the centre of a disc loaded by p̄ that is wide against every thickness. In the substrate σ_xx =
///   −(1+2ν₂)p̄/2, with the lateral strain ε₂ = −p̄(1−2ν₂)(1+ν₂)/(2E₂), which is imposed on each layer whose connection
///   to the substrate carries shear (bonded or spring: the load is wide against the length over which a spring slips):
///   σ_xx = Eε₂/(1−ν) − νp̄/(1−ν). Layers above a frictionless interface are a laminate of their own, a wide sheet
///   whose loaded disc spreads: with A₁₁ = Σ Eh/(1−ν²) and T = Σ hνp̄/(1−ν) its strain is ε = T/(2A₁₁) (a disc
///   in an infinite sheet; for one layer σ_xx = −νp̄/2). A rigid base has no strain: ε₂ = 0.
///
/// **A spring of any stiffness is bonded here, a frictionless interface is not**, though the one is the limit of the other:
/// "wide" and "k_t → 0" do not commute. Under a disc of radius R the layers above a spring obey A₁₁ 𝓛v = k_t v away from
/// the rim, v their radial displacement against the substrate's, 𝓛v = v″ + v′/r − v/r², while at the rim v′ jumps by
/// −2(ε_f − ε₂), ε_f the strain of the laminate on its own. So v is a I₁(r/ℓ) inside and b K₁(r/ℓ) outside, and at the
/// centre
///
/// ε = ε₂ + (ε_f − ε₂) ρK₁(ρ),  ρ = R/ℓ,  ℓ = √(A₁₁/k_t).
///
/// ρK₁(ρ) is 1 at ρ = 0 and √(πρ/2) e^{−ρ} far off: the load is wide against the **slip length** ℓ ([`Self::slip_lengths`])
/// and the layers follow the substrate, or it is narrow and they spread on their own. `half-space` means R → ∞ with k_t
/// fixed. Where ℓ is longer than the cell a case is warned, for then only loads of many cells are wide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
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
        let materials = half_space.materials();
        match self {
            Self::Confined => materials.map(|material| stress_at(material, 0.0)).collect(),
            Self::HalfSpace => materials
                .zip(lateral_strains(half_space))
                .map(|(material, strain)| stress_at(material, strain))
                .collect(),
        }
    }

    /// Slip length ℓ = √(A₁₁/k_t) of the spring under each layer, `None` under a layer without one: over it the shear that a
    /// spring carries makes the layers above follow what is below. A length.
    pub fn slip_lengths(half_space: &HalfSpace) -> Vec<Option<f64>> {
        let layers = half_space.layers();
        let length = |(index, layer): (usize, &Layer)| match layer.interface() {
            Interface::Spring { tangential, .. } if tangential.is_finite() => {
                Some((laminate(layers, index).0 / tangential).sqrt())
            }
            _ => None,
        };
        layers.iter().enumerate().map(length).collect()
    }
}

/// Lateral stress at the lateral strain ε under σ_zz = −1.
fn stress_at(material: Material, strain: f64) -> f64 {
    (material.young() * strain - material.poisson()) / (1.0 - material.poisson())
}

/// Lateral strain of each material under a wide disc loaded by p̄ = 1.
fn lateral_strains(half_space: &HalfSpace) -> Vec<f64> {
    let below_disc = |substrate: Material| {
        let nu = substrate.poisson();
        -(1.0 - 2.0 * nu) * (1.0 + nu) / (2.0 * substrate.young())
    };
    let mut strain = half_space.substrate().material().map_or(0.0, below_disc);
    let layers = half_space.layers();
    let mut strains = vec![strain; half_space.material_count()];
    for (index, layer) in layers.iter().enumerate().rev() {
        if layer.interface() == Interface::Frictionless {
            let (stiffness, push) = laminate(layers, index);
            strain = push / (2.0 * stiffness);
        }
        strains[index] = strain;
    }
    strains
}

/// A₁₁ = Σ Eh/(1−ν²) and T = Σ hν/(1−ν) of layer `index` and all above it, up to a frictionless interface.
fn laminate(layers: &[Layer], index: usize) -> (f64, f64) {
    let slides = |above: &Layer| above.interface() == Interface::Frictionless;
    let top = layers[..index].iter().rposition(slides).map_or(0, |above| above + 1);
    layers[top..=index].iter().fold((0.0, 0.0), |(stiffness, push), layer| {
        let (material, h) = (layer.material(), layer.thickness());
        let nu = material.poisson();
        (stiffness + h * material.young() / (1.0 - nu * nu), push + h * nu / (1.0 - nu))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn a_spring_slips_over_the_length_that_its_layers_stiffness_gives() {
        let spring = |tangential| Interface::Spring { tangential, normal: f64::INFINITY };
        let stiffness: f64 = 0.1 * 5.0 / 0.96;
        let lengths = MeanStress::slip_lengths(&coated(&[Interface::Bonded, spring(2.0)]));
        assert_eq!(lengths[0], None);
        assert!((lengths[1].unwrap() - (2.0 * stiffness / 2.0).sqrt()).abs() < 1e-15);
        // Layers above a frictionless interface pull at nothing below it.
        let lengths = MeanStress::slip_lengths(&coated(&[Interface::Frictionless, spring(2.0), spring(f64::INFINITY)]));
        assert!((lengths[1].unwrap() - (stiffness / 2.0).sqrt()).abs() < 1e-15);
        assert_eq!((lengths[0], lengths[2]), (None, None));
    }
}

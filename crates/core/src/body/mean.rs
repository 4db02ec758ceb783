//! Lateral stress under the mean pressure p̄, the component q = 0 that the periodic problem alone leaves open in the plane.

use super::{HalfSpace, Interface, Layer, Material};
use serde::Serialize;

/// Assumption for the mean lateral stress.
///
/// σ_zz = −p̄ everywhere; the shears vanish. The lateral stress, σ_xx = σ_yy but for lines, depends on what surrounds the periodic
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
/// - **line**: contacts along lines that are far apart, each alone but for what its neighbours displace. The sum of the fields of lines,
///   each of which decays on its own, has the mean stress that the wave q of the pressure has for q → 0. Across the lines: in the substrate
///   σ_xx = −p̄, with the strain ε₂ = −p̄(1−2ν₂)(1+ν₂)/E₂ in plane strain; in a layer that shear connects with the substrate
///   σ_xx = Eε₂/(1−ν²) − νp̄/(1−ν), so that of the substrate's material −p̄ too. Layers above a frictionless interface carry no force together:
///   with A₁₁ and T as above ε = T/A₁₁ (one layer: σ_xx = 0). On a rigid base ε₂ = 0. Along the lines, in plane strain, σ_yy = ν(σ_xx − p̄).
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
pub enum MeanStress {
    /// No mean lateral strain: the periodic system fills the plane.
    #[default]
    Confined,
    /// The centre of a wide loaded disc on the half-space.
    HalfSpace,
    /// Lines far apart along an axis on which nothing depends, in plane strain.
    Line,
}

impl MeanStress {
    /// σ_xx in each material (layers from the surface down, then the substrate) for p̄ = 1: σ_yy is the same, but with [`Self::Line`], where x
    /// is across the lines.
    pub fn lateral(self, half_space: &HalfSpace) -> Vec<f64> {
        self.across_and_along(half_space).into_iter().map(|[across, _]| across).collect()
    }

    /// σ_xx across the lines and σ_yy along them in each material for p̄ = 1, equal but with [`Self::Line`].
    pub(crate) fn across_and_along(self, half_space: &HalfSpace) -> Vec<[f64; 2]> {
        let materials = half_space.materials();
        match self {
            Self::Confined => materials.map(|material| [stress_at(material, 0.0); 2]).collect(),
            Self::HalfSpace => {
                let strains = lateral_strains(half_space, 0.5);
                materials.zip(strains).map(|(material, strain)| [stress_at(material, strain); 2]).collect()
            }
            Self::Line => {
                let strains = lateral_strains(half_space, 1.0);
                materials.zip(strains).map(|(material, strain)| line_stress_at(material, strain)).collect()
            }
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

/// σ across and along lines at the strain ε across them, without strain along them, under σ_zz = −1.
fn line_stress_at(material: Material, strain: f64) -> [f64; 2] {
    let nu = material.poisson();
    let across = material.young() * strain / (1.0 - nu * nu) - nu / (1.0 - nu);
    [across, nu * (across - 1.0)]
}

/// Lateral strain of each material under p̄ = 1: the `part` ½ under a wide disc, all of it across lines, along which nothing spreads.
fn lateral_strains(half_space: &HalfSpace, part: f64) -> Vec<f64> {
    let below = |substrate: Material| {
        let nu = substrate.poisson();
        -part * (1.0 - 2.0 * nu) * (1.0 + nu) / substrate.young()
    };
    let mut strain = half_space.substrate().material().map_or(0.0, below);
    let layers = half_space.layers();
    let mut strains = vec![strain; half_space.material_count()];
    for (index, layer) in layers.iter().enumerate().rev() {
        if layer.interface() == Interface::Frictionless {
            let (stiffness, push) = laminate(layers, index);
            strain = part * push / stiffness;
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
    use super::super::{Depth, InPlane};
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

    /// The amplitudes of a wave much longer than all layers are thick, for stiff and soft, incompressible and compressible layers and every
    /// kind of interface, on elastic and rigid bases.
    #[test]
    fn the_mean_of_lines_is_that_of_an_infinitely_long_wave() {
        let material = |young: f64, nu: f64| Material::from_young(young, nu).unwrap();
        let layer = |young, nu, h, interface| Layer::new(material(young, nu), h, interface).unwrap();
        let spring = Interface::Spring { tangential: 0.4, normal: 3.0 };
        let bodies = |last: Interface| {
            let all = [
                vec![layer(5.0, 0.2, 0.1, last)],
                vec![layer(0.02, 0.5, 0.3, Interface::Bonded), layer(40.0, 0.0, 0.05, last)],
                vec![
                    layer(3.0, 0.3, 0.2, Interface::Frictionless),
                    layer(0.5, 0.45, 0.1, spring),
                    layer(8.0, 0.1, 0.1, last),
                ],
            ];
            let elastic = all.clone().map(|layers| HalfSpace::new(layers, material(1.0, 0.3)));
            let rigid = all.map(|layers| HalfSpace::on_rigid_base(layers).unwrap());
            elastic.into_iter().chain(rigid)
        };
        let bare = HalfSpace::new(vec![], material(2.0, 0.35));
        let coated = [Interface::Bonded, Interface::Frictionless, spring].into_iter().flat_map(bodies);
        for body in coated.chain([bare]) {
            for (index, [across, along]) in MeanStress::Line.across_and_along(&body).into_iter().enumerate() {
                let (top, bottom) = body.faces(index + 1);
                let depth =
                    Depth { z: if bottom.is_finite() { 0.5 * (top + bottom) } else { top }, material: index + 1 };
                // Stresses of bending with the layer are of the order qh.
                let at = |q: f64| body.response().amplitudes(InPlane::Normal, q, depth);
                let (one, other) = (at(1e-5), at(2e-5));
                let limits = [2.0 * one.sqq - other.sqq, 2.0 * one.stt - other.stt];
                for (mean, limit) in [across, along].into_iter().zip(limits) {
                    assert!((mean - limit).abs() < 1e-5, "{body}, material {}: {mean} for {limit}", index + 1);
                }
            }
        }
        assert_eq!(MeanStress::Line.across_and_along(&HalfSpace::new(vec![], material(2.0, 0.35)))[0][0], -1.0);
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

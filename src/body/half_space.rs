//! Coating layers and the half-space they form.

use super::{Depth, InterfaceStrength, Material, MaterialError, Strength};
use crate::notation::number;
use std::fmt;

/// How the lower face of a layer holds to what lies below it. Interfaces never open: tension is carried.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Interface {
    /// Perfect adhesion, Eq. (3): tractions and displacements continuous.
    Bonded,
    /// Complete sliding: no shear traction, normal displacement continuous.
    Frictionless,
    /// Incomplete sliding: the displacements jump by σ_qz/k_t and p/k_n. `f64::INFINITY` is rigid.
    Spring {
        /// Tangential stiffness k_t, a pressure per length.
        tangential: f64,
        /// Normal stiffness k_n, a pressure per length.
        normal: f64,
    },
}

impl Interface {
    /// Jumps of displacement that a unit of tangential and of normal traction makes, in the units of the layer above:
    /// Gq/k_t and Gq/k_n for its shear modulus times the wavenumber, `stiffness`; zero unless it is a spring.
    pub(super) fn jumps(self, stiffness: f64) -> [f64; 2] {
        match self {
            Self::Spring { tangential, normal } => [stiffness / tangential, stiffness / normal],
            Self::Bonded | Self::Frictionless => [0.0; 2],
        }
    }
}

impl fmt::Display for Interface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bonded => write!(f, "bonded"),
            Self::Frictionless => write!(f, "frictionless"),
            Self::Spring { tangential, normal } => {
                let [tangential, normal] = [*tangential, *normal].map(number);
                write!(f, "spring, tangential stiffness {tangential}, normal stiffness {normal}")
            }
        }
    }
}

/// One layer of a coating.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    material: Material,
    thickness: f64,
    interface: Interface,
    residual: f64,
    strength: Strength,
    interface_strength: InterfaceStrength,
}

impl Layer {
    /// Layer of the given thickness (a length) with the given lower interface.
    ///
    /// # Errors
    /// [`MaterialError`] for a thickness or a stiffness that is not positive.
    pub fn new(material: Material, thickness: f64, interface: Interface) -> Result<Self, MaterialError> {
        if !(thickness.is_finite() && thickness > 0.0) {
            return Err(MaterialError::Thickness(thickness));
        }
        if let Interface::Spring { tangential, normal } = interface {
            for stiffness in [tangential, normal] {
                if stiffness.is_nan() || stiffness <= 0.0 {
                    return Err(MaterialError::Stiffness(stiffness));
                }
            }
        }
        Ok(Self {
            material,
            thickness,
            interface,
            residual: 0.0,
            strength: Strength::default(),
            interface_strength: InterfaceStrength::default(),
        })
    }

    /// The same with an equi-biaxial residual stress σ_r, a pressure, positive in tension: deposited with the layer, it adds to
    /// σ_xx and σ_yy everywhere in it and does not change the contact.
    ///
    /// # Errors
    /// [`MaterialError::Residual`] for a stress that is not finite.
    pub fn with_residual_stress(self, residual: f64) -> Result<Self, MaterialError> {
        if residual.is_finite() { Ok(Self { residual, ..self }) } else { Err(MaterialError::Residual(residual)) }
    }

    /// The same with strengths of its material and its interface.
    ///
    /// # Errors
    /// [`MaterialError::Strength`] for one that is not positive.
    pub fn with_strengths(self, strength: Strength, interface: InterfaceStrength) -> Result<Self, MaterialError> {
        Ok(Self { strength: strength.check()?, interface_strength: interface.check()?, ..self })
    }

    /// Strengths of its material.
    pub fn strength(&self) -> Strength {
        self.strength
    }

    /// Strengths of its lower interface.
    pub fn interface_strength(&self) -> InterfaceStrength {
        self.interface_strength
    }

    /// Equi-biaxial residual stress σ_r, a pressure, positive in tension.
    pub fn residual_stress(&self) -> f64 {
        self.residual
    }

    /// Material of the layer.
    pub fn material(&self) -> Material {
        self.material
    }

    /// Thickness h, a length.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Interface at the layer's lower face.
    pub fn interface(&self) -> Interface {
        self.interface
    }
}

/// A coated elastic half-space: layers from the surface down, then the substrate.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpace {
    layers: Vec<Layer>,
    substrate: Material,
    substrate_strength: Strength,
}

impl HalfSpace {
    /// Half-space of `substrate` under `layers`, given from the surface down (none: uncoated).
    pub fn new(layers: Vec<Layer>, substrate: Material) -> Self {
        Self { layers, substrate, substrate_strength: Strength::default() }
    }

    /// The same with strengths of the substrate.
    ///
    /// # Errors
    /// [`MaterialError::Strength`] for one that is not positive.
    pub fn with_substrate_strength(self, strength: Strength) -> Result<Self, MaterialError> {
        Ok(Self { substrate_strength: strength.check()?, ..self })
    }

    /// Layers from the surface down.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Material of the substrate.
    pub fn substrate(&self) -> Material {
        self.substrate
    }

    /// Material at the surface: that of the first layer, or the substrate's.
    pub fn surface_material(&self) -> Material {
        self.layers.first().map_or(self.substrate, Layer::material)
    }

    /// All materials: those of the layers from the surface down, then the substrate.
    pub fn materials(&self) -> impl Iterator<Item = Material> {
        self.layers.iter().map(Layer::material).chain([self.substrate])
    }

    /// Strengths of all materials, in the order of [`Self::materials`].
    pub fn strengths(&self) -> impl Iterator<Item = Strength> {
        self.layers.iter().map(Layer::strength).chain([self.substrate_strength])
    }

    /// Residual stresses of all materials, in the order of [`Self::materials`]: that of the substrate is zero.
    pub fn residual_stresses(&self) -> impl Iterator<Item = f64> {
        self.layers.iter().map(Layer::residual_stress).chain([0.0])
    }

    /// Depths of the interfaces from the surface down, lengths.
    pub fn interface_depths(&self) -> Vec<f64> {
        self.layers
            .iter()
            .scan(0.0, |depth, layer| {
                *depth += layer.thickness;
                Some(*depth)
            })
            .collect()
    }

    /// Depths of the upper and the lower face of a material (from 1), lengths; the lower one of the substrate is
    /// infinite.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn faces(&self, material: usize) -> (f64, f64) {
        let below = |layers: &[Layer]| layers.iter().fold(0.0, |depth, layer| depth + layer.thickness);
        let bottom = if material <= self.layers.len() { below(&self.layers[..material]) } else { f64::INFINITY };
        (below(&self.layers[..material - 1]), bottom)
    }

    /// The depth z ≥ 0 in its material, or, on an interface, to rounding, in both: above, then below.
    pub fn depths(&self, z: f64) -> Vec<Depth> {
        let faces = self.interface_depths();
        let tolerance = 1e-12;
        let above = faces.iter().filter(|&&face| face * (1.0 + tolerance) < z).count();
        let below = faces.iter().filter(|&&face| face * (1.0 - tolerance) <= z).count();
        (above + 1..=below + 1).map(|material| Depth { z, material }).collect()
    }

    /// Depths down to `depth` > 0, a length, by `rows` equal intervals; both sides of each interface are among them.
    pub fn rows(&self, depth: f64, rows: usize) -> Vec<Depth> {
        let mut depths = self.interface_depths();
        depths.retain(|&face| face <= depth);
        // A row below the surface that is an interface but for rounding is that interface.
        let is_face = |z: f64| z > 0.0 && depths.iter().any(|face| (face - z).abs() < 1e-9 * depth);
        let rows = (0..=rows).map(|row| row as f64 * depth / rows as f64);
        let others: Vec<f64> = rows.filter(|&z| !is_face(z)).collect();
        depths.extend(others);
        depths.sort_by(f64::total_cmp);
        depths.into_iter().flat_map(|z| self.depths(z)).collect()
    }
}

impl fmt::Display for HalfSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, layer) in (1..).zip(&self.layers) {
            writeln!(
                f,
                "layer {index}: thickness {}, χ {}, {}, {}{}",
                number(layer.thickness),
                number(layer.material.shear() / self.substrate.shear()),
                layer.material,
                layer.interface,
                if layer.residual == 0.0 { String::new() } else { format!(", σ_r {}", number(layer.residual)) }
            )?;
        }
        write!(f, "substrate: {}", self.substrate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_depth_on_an_interface_has_two_sides_whatever_the_rounding() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        let layers = [0.1, 0.2].map(|h| Layer::new(material, h, Interface::Bonded).unwrap());
        let half_space = HalfSpace::new(layers.to_vec(), material);
        let sides = |z: f64| half_space.depths(z).into_iter().map(|depth| depth.material).collect::<Vec<usize>>();
        let found = [0.0, 0.1, 0.2, 0.3, 0.1 + 0.2, 5.0].map(sides);
        assert_eq!(found, [vec![1], vec![1, 2], vec![2], vec![2, 3], vec![2, 3], vec![3]]);
    }

    #[test]
    fn rows_keep_both_sides_of_every_interface() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        // Just beside a row, and so near to the surface that no row tells it apart.
        for thickness in [0.333_333_333_4, 0.333_333_333_3, 1.0 / 3.0, 1e-11, 1.0] {
            let layer = Layer::new(material, thickness, Interface::Bonded).unwrap();
            let rows = HalfSpace::new(vec![layer], material).rows(1.0, 3);
            let sides: Vec<usize> = rows.iter().filter(|at| at.z == thickness).map(|at| at.material).collect();
            assert_eq!(sides, [1, 2], "{thickness}: {rows:?}");
            assert_eq!(rows.len(), if thickness < 1e-9 { 6 } else { 5 }, "{thickness}: {rows:?}");
        }
    }

    #[test]
    fn values_out_of_range_are_refused() {
        let material = Material::from_shear(1.0, 0.5).unwrap();
        assert!(Layer::new(material, 0.0, Interface::Bonded).is_err());
        let interface = Interface::Spring { tangential: 0.0, normal: f64::INFINITY };
        assert_eq!(Layer::new(material, 1.0, interface), Err(MaterialError::Stiffness(0.0)));
    }
}

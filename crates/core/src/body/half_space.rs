//! The coated half-space: layers on a substrate, elastic or rigid.

use super::{
    Depth, Durability, Interface, InterfaceId, Layer, LayeredResponse, Material, MaterialError, MaterialId, Moduli,
    Name, Side, Strength, Substrate,
};
use crate::notation::number;
use crate::numeric::number::Number;
use std::fmt;
use std::sync::Arc;

/// Part of its thickness below which a layer that wears is gone.
const GONE: f64 = 1e-6;

/// A coated elastic half-space: layers from the surface down, then the substrate, or layers on a rigid base.
///
/// The elastic [response](Self::response) is set up once, in the constructor, and shared by all clones.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpace {
    layers: Vec<Layer>,
    substrate: Substrate,
    substrate_strength: Strength,
    substrate_durability: Durability,
    /// Side of the half-space, where it is one of two elastic bodies.
    side: Option<Side>,
    response: Arc<LayeredResponse>,
}

impl HalfSpace {
    /// Half-space of `substrate` under `layers`, given from the surface down (none: uncoated).
    pub fn new(layers: Vec<Layer>, substrate: Material) -> Self {
        Self::on(layers, Substrate::Elastic(substrate))
    }

    /// `layers` on a rigid base, given from the surface down.
    ///
    /// # Errors
    /// [`MaterialError::NoLayers`] without layers.
    pub fn on_rigid_base(layers: Vec<Layer>) -> Result<Self, MaterialError> {
        if layers.is_empty() { Err(MaterialError::NoLayers) } else { Ok(Self::on(layers, Substrate::Rigid)) }
    }

    fn on(layers: Vec<Layer>, substrate: Substrate) -> Self {
        let response = Arc::new(LayeredResponse::new(&layers, substrate, |_, material| material.into()));
        let (substrate_strength, substrate_durability) = (Strength::default(), Durability::default());
        Self { layers, substrate, substrate_strength, substrate_durability, side: None, response }
    }

    /// The half-space as one of two elastic bodies: its materials and interfaces say so.
    #[must_use]
    pub fn on_side(self, side: Side) -> Self {
        Self { side: Some(side), ..self }
    }

    /// Side of the half-space, one of two elastic bodies; `None` under a rigid counterbody.
    pub fn side(&self) -> Option<Side> {
        self.side
    }

    /// Half-space with strengths of an elastic substrate; a rigid base has none.
    ///
    /// # Errors
    /// [`MaterialError::Strength`] for one that is not positive.
    pub fn with_substrate_strength(self, strength: Strength) -> Result<Self, MaterialError> {
        Ok(Self { substrate_strength: strength.check()?, ..self })
    }

    /// Half-space with the durability of an elastic substrate; a rigid base has none.
    ///
    /// # Errors
    /// [`MaterialError`] for a hardness that is not positive, and for a coefficient of wear below zero.
    pub fn with_substrate_durability(self, durability: Durability) -> Result<Self, MaterialError> {
        Ok(Self { substrate_durability: durability.check()?, ..self })
    }

    /// Response to harmonic tractions on the surface: compliances, and amplitudes at any depth.
    pub fn response(&self) -> &Arc<LayeredResponse> {
        &self.response
    }

    /// Response of the same layers and interfaces with other `moduli`: a function of the number of a material, from 1 at the
    /// surface down, and of the material itself. Complex moduli stand for a load e^{iωt} on viscoelastic materials.
    pub fn response_of<N: Number>(&self, moduli: impl FnMut(usize, Material) -> Moduli<N>) -> LayeredResponse<N> {
        LayeredResponse::new(&self.layers, self.substrate, moduli)
    }

    /// Response to a load e^{st} with the Laplace variable s, one over a time: s = iω of a load e^{iωt} on materials that relax.
    pub fn response_at<N: Number>(&self, s: N) -> LayeredResponse<N> {
        self.response_of(|_, material| material.moduli_at(s))
    }

    /// Whether all materials conduct heat.
    pub fn conducts(&self) -> bool {
        self.materials().all(|material| material.conduction().is_some())
    }

    /// Whether a material relaxes.
    pub fn relaxes(&self) -> bool {
        self.materials().any(|material| material.relaxation().is_some())
    }

    /// Layers from the surface down.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Substrate that the layers lie on, elastic or rigid.
    pub fn substrate(&self) -> Substrate {
        self.substrate
    }

    /// Material at the surface: that of the first layer, or the substrate's.
    pub fn surface_material(&self) -> Material {
        self.materials().next().expect("there are layers on a rigid base")
    }

    /// All materials: those of the layers from the surface down, then an elastic substrate.
    pub fn materials(&self) -> impl Iterator<Item = Material> {
        self.layers.iter().map(Layer::material).chain(self.substrate.material())
    }

    /// Number of materials.
    pub fn material_count(&self) -> usize {
        self.layers.len() + usize::from(!self.substrate.is_rigid())
    }

    /// Material `number`, from 1 at the surface down.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn material(&self, number: usize) -> Material {
        self.materials().nth(number - 1).expect("a material of the body")
    }

    /// Depth of the rigid base, a length; infinite without one.
    pub fn base_depth(&self) -> f64 {
        match self.substrate {
            Substrate::Elastic(_) => f64::INFINITY,
            Substrate::Rigid => self.layers.iter().map(Layer::thickness).sum(),
        }
    }

    /// Displacement of the surface under a uniform pressure without mean lateral strain, over the pressure, a length per
    /// pressure: Σ h/M of the layers and 1/k_n of their springs, from the rigid base. Zero on an elastic substrate, whose infinite
    /// mean displacement is left out.
    pub fn mean_compliance(&self) -> f64 {
        let compliance = |layer: &Layer| {
            let closure = match layer.interface() {
                Interface::Spring { normal, .. } => normal.recip(),
                Interface::Bonded | Interface::Frictionless => 0.0,
            };
            layer.thickness() * layer.material().oedometric_compliance() + closure
        };
        match self.substrate {
            Substrate::Elastic(_) => 0.0,
            Substrate::Rigid => self.layers.iter().map(compliance).sum(),
        }
    }

    /// Displacement of the surface under a uniform shear traction, over the traction, a length per pressure: Σ h/G of the layers and 1/k_t
    /// of their springs, from the rigid base; infinite where a layer slides without friction. Zero on an elastic substrate, whose infinite
    /// mean displacement is left out.
    pub fn mean_shear_compliance(&self) -> f64 {
        let compliance = |layer: &Layer| {
            let slip = match layer.interface() {
                Interface::Bonded => 0.0,
                Interface::Spring { tangential, .. } => tangential.recip(),
                Interface::Frictionless => f64::INFINITY,
            };
            layer.thickness() / layer.material().shear() + slip
        };
        match self.substrate {
            Substrate::Elastic(_) => 0.0,
            Substrate::Rigid => self.layers.iter().map(compliance).sum(),
        }
    }

    /// Number and name of material `number`, from 1 at the surface down to the substrate.
    pub fn material_id(&self, number: usize) -> MaterialId {
        let name = number.checked_sub(1).and_then(|index| self.materials().nth(index)?.name());
        MaterialId { side: self.side, number, name }
    }

    /// Number and name of interface `number`, from 1: the lower face of that layer.
    pub fn interface_id(&self, number: usize) -> InterfaceId {
        let lower = self.material_id(number + 1);
        // The base has a name where the layer on it has one.
        let is_base = number == self.layers.len() && self.substrate.is_rigid();
        let upper = self.material_id(number);
        let name = if is_base { upper.name.map(|_| Name::new("rigid base")) } else { lower.name };
        InterfaceId::between(upper, MaterialId { name, ..lower })
    }

    /// Strengths of all materials, in the order of [`Self::materials`].
    pub fn strengths(&self) -> impl Iterator<Item = Strength> {
        self.layers.iter().map(Layer::strength).chain(self.substrate.material().map(|_| self.substrate_strength))
    }

    /// Durabilities of all materials, in the order of [`Self::materials`].
    pub fn durabilities(&self) -> impl Iterator<Item = Durability> {
        self.layers.iter().map(Layer::durability).chain(self.substrate.material().map(|_| self.substrate_durability))
    }

    /// Durability of the material at the surface.
    pub fn surface_durability(&self) -> Durability {
        self.durabilities().next().unwrap_or_default()
    }

    /// Half-space after everything above a `depth`, a length, has come off, and the number of layers gone: the first
    /// one left is thinner, and a layer of which less than a millionth is left is gone too. `None` where nothing is
    /// left on a rigid base.
    pub fn uncovered(&self, depth: f64) -> Option<(Self, usize)> {
        let faces = self.interface_depths();
        let is_gone = |(layer, face): (&Layer, &f64)| face - depth < GONE * layer.thickness();
        let gone = self.layers.iter().zip(&faces).take_while(|&(layer, face)| is_gone((layer, face))).count();
        let mut layers = self.layers[gone..].to_vec();
        if let (Some(layer), Some(face)) = (layers.first_mut(), faces.get(gone)) {
            *layer = layer.thinned((face - depth).min(layer.thickness()));
        }
        if layers.is_empty() && self.substrate.is_rigid() {
            return None;
        }
        let response = Arc::new(LayeredResponse::new(&layers, self.substrate, |_, material| material.into()));
        Some((Self { layers, response, ..self.clone() }, gone))
    }

    /// The half-space without hardness: elastic under any pressure.
    #[must_use]
    pub fn without_hardness(&self) -> Self {
        let layers = self.layers.iter().map(|layer| layer.of_hardness(None)).collect();
        let substrate_durability = Durability { hardness: None, ..self.substrate_durability };
        Self { layers, substrate_durability, ..self.clone() }
    }

    /// The half-space with another hardness of its surface layer, a pressure.
    pub(crate) fn with_surface_hardness(&self, hardness: f64) -> Self {
        let of = |(index, layer): (usize, &Layer)| {
            if index == 0 { layer.of_hardness(Some(hardness)) } else { *layer }
        };
        Self { layers: self.layers.iter().enumerate().map(of).collect(), ..self.clone() }
    }

    /// Residual stresses of all materials, in the order of [`Self::materials`]: that of the substrate is zero.
    pub fn residual_stresses(&self) -> impl Iterator<Item = f64> {
        self.layers.iter().map(Layer::residual_stress).chain(self.substrate.material().map(|_| 0.0))
    }

    /// Depths of the interfaces from the surface down, lengths.
    pub fn interface_depths(&self) -> Vec<f64> {
        self.layers
            .iter()
            .scan(0.0, |depth, layer| {
                *depth += layer.thickness();
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
        let below = |layers: &[Layer]| layers.iter().fold(0.0, |depth, layer| depth + layer.thickness());
        let bottom = if material <= self.layers.len() { below(&self.layers[..material]) } else { f64::INFINITY };
        (below(&self.layers[..material - 1]), bottom)
    }

    /// The depth z ≥ 0 in its material, or, on an interface, to rounding, in both: above, then below. A rigid base is no material:
    /// on it there is the layer alone, and below it nothing.
    pub fn depths(&self, z: f64) -> Vec<Depth> {
        let faces = self.interface_depths();
        let tolerance = 1e-12;
        let above = faces.iter().filter(|&&face| face * (1.0 + tolerance) < z).count();
        let below = faces.iter().filter(|&&face| face * (1.0 - tolerance) <= z).count();
        (above + 1..=below + 1)
            .filter(|&material| material <= self.material_count())
            .map(|material| Depth { z, material })
            .collect()
    }

    /// Depths down to `depth` > 0, a length, or to a rigid base above it, by `rows` equal intervals; both sides of each interface are
    /// among them.
    pub fn rows(&self, depth: f64, rows: usize) -> Vec<Depth> {
        let depth = depth.min(self.base_depth());
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
                "layer {index}{}: thickness {}, {}{}, {}{}",
                layer.material().name_behind(),
                number(layer.thickness()),
                self.substrate
                    .material()
                    .map_or(String::new(), |base| format!("χ {}, ", number(layer.material().shear() / base.shear()))),
                layer.material(),
                layer.interface(),
                match layer.residual_stress() {
                    0.0 => String::new(),
                    residual => format!(", σ_r {}", number(residual)),
                }
            )?;
        }
        match self.substrate {
            Substrate::Elastic(material) => write!(f, "substrate{}: {material}", material.name_behind()),
            Substrate::Rigid => write!(f, "substrate: rigid base"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Interface;

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
    fn what_comes_off_leaves_thinner_layers_and_takes_those_above_it() {
        let material = |young: f64| Material::from_young(young, 0.3).unwrap();
        let layers = [0.1, 0.2].map(|h| Layer::new(material(h), h, Interface::Bonded).unwrap());
        let half_space = HalfSpace::new(layers.to_vec(), material(1.0));
        let left = |depth: f64| {
            let (rest, gone) = half_space.uncovered(depth).unwrap();
            let thicknesses: Vec<f64> = rest.layers().iter().map(Layer::thickness).collect();
            assert_eq!(
                rest.response().compliance(3.0),
                HalfSpace::new(rest.layers().to_vec(), material(1.0)).response().compliance(3.0)
            );
            (thicknesses, gone, rest.surface_material().young())
        };
        assert_eq!(left(0.0), (vec![0.1, 0.2], 0, material(0.1).young()));
        assert_eq!(left(0.025), (vec![0.1 - 0.025, 0.2], 0, material(0.1).young()));
        assert_eq!(left(0.1 - 1e-9), (vec![0.2], 1, material(0.2).young()));
        assert_eq!(left(0.25).0[0], 0.1 + 0.2 - 0.25);
        assert_eq!(left(7.0), (vec![], 2, 1.0));
        let on_base = HalfSpace::on_rigid_base(layers.to_vec()).unwrap();
        assert!(on_base.uncovered(0.3).is_none() && on_base.uncovered(0.2).is_some());
    }

    #[test]
    fn rows_keep_both_sides_of_every_interface() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        // Just beside a row, and nearer to the surface than the spacing of rows resolves.
        for thickness in [0.333_333_333_4, 0.333_333_333_3, 1.0 / 3.0, 1e-11, 1.0] {
            let layer = Layer::new(material, thickness, Interface::Bonded).unwrap();
            let rows = HalfSpace::new(vec![layer], material).rows(1.0, 3);
            let sides: Vec<usize> = rows.iter().filter(|at| at.z == thickness).map(|at| at.material).collect();
            assert_eq!(sides, [1, 2], "{thickness}: {rows:?}");
            assert_eq!(rows.len(), if thickness < 1e-9 { 6 } else { 5 }, "{thickness}: {rows:?}");
        }
    }
}

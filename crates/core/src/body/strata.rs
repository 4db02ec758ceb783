//! The layers and the substrate by the coefficients of their plane-strain equations, and the recursion over them.

use super::minors::{Minors, PlaneStrain};
use super::{Interface, Layer, Material, Moduli, Substrate};
use crate::numeric::number::Number;

/// One layer as the recursion needs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stratum<N = f64> {
    pub material: PlaneStrain<N>,
    /// h, a length.
    pub thickness: f64,
    /// The lower interface.
    pub interface: Interface,
}

/// Layers from the surface down, and the substrate.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Strata<N = f64> {
    pub layers: Vec<Stratum<N>>,
    /// `None`: a rigid base.
    pub substrate: Option<PlaneStrain<N>>,
}

impl<N: Number> Strata<N> {
    /// Strata whose materials have the `moduli` of their numbers, from 1 at the surface down.
    pub fn new(layers: &[Layer], substrate: Substrate, mut moduli: impl FnMut(usize, Material) -> Moduli<N>) -> Self {
        let mut number = 0;
        let mut material = |material: Material| {
            number += 1;
            PlaneStrain::new(moduli(number, material))
        };
        let stratum = |layer: &Layer| Stratum {
            material: material(layer.material()),
            thickness: layer.thickness(),
            interface: layer.interface(),
        };
        Self { layers: layers.iter().map(stratum).collect(), substrate: substrate.material().map(material) }
    }

    /// The material at the surface.
    pub fn surface_material(&self) -> &PlaneStrain<N> {
        self.materials().next().expect("there are layers on a rigid base")
    }

    /// All materials, from the surface down.
    pub fn materials(&self) -> impl Iterator<Item = &PlaneStrain<N>> {
        self.layers.iter().map(|layer| &layer.material).chain(&self.substrate)
    }

    /// Minors of the plane of admissible states at the surface, at the wavenumber q > 0 (1/length). Calls `face` with the
    /// minors at the upper face of an elastic substrate, then at the lower face of each layer, seen from inside it, from the
    /// substrate up.
    pub fn surface_minors(&self, wavenumber: f64, mut face: impl FnMut(Minors<N>)) -> Minors<N> {
        let mut below = self.substrate.as_ref();
        let mut minors = below.map_or_else(Minors::rigid, Minors::half_space);
        if below.is_some() {
            face(minors);
        }
        for layer in self.layers.iter().rev() {
            minors = minors.above(layer.interface, below, &layer.material, wavenumber);
            face(minors);
            minors = minors.raised(&layer.material, wavenumber * layer.thickness);
            below = Some(&layer.material);
        }
        minors
    }
}

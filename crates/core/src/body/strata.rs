//! The layers and the substrate by the coefficients of their plane-strain equations, and the recursion over them.

use super::minors::{Minors, PlaneStrain};
use super::{Interface, Layer, Substrate};

/// One layer as the recursion needs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stratum {
    pub material: PlaneStrain,
    /// h, a length.
    pub thickness: f64,
    /// The lower interface.
    pub interface: Interface,
}

/// Layers from the surface down, and the substrate.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Strata {
    pub layers: Vec<Stratum>,
    /// `None`: a rigid base.
    pub substrate: Option<PlaneStrain>,
}

impl Strata {
    pub fn new(layers: &[Layer], substrate: Substrate) -> Self {
        let stratum = |layer: &Layer| Stratum {
            material: PlaneStrain::new(layer.material()),
            thickness: layer.thickness(),
            interface: layer.interface(),
        };
        Self { layers: layers.iter().map(stratum).collect(), substrate: substrate.material().map(PlaneStrain::new) }
    }

    /// The material at the surface.
    pub fn surface_material(&self) -> &PlaneStrain {
        self.materials().next().expect("there are layers on a rigid base")
    }

    /// All materials, from the surface down.
    pub fn materials(&self) -> impl Iterator<Item = &PlaneStrain> {
        self.layers.iter().map(|layer| &layer.material).chain(&self.substrate)
    }

    /// Minors of the plane of admissible states at the surface, at the wavenumber q > 0 (1/length). Calls `face` with the
    /// minors at the upper face of an elastic substrate, then at the lower face of each layer, seen from inside it, from the
    /// substrate up.
    pub fn surface_minors(&self, wavenumber: f64, mut face: impl FnMut(Minors)) -> Minors {
        let mut below = self.substrate.as_ref();
        let mut minors = below.map_or(Minors::RIGID, Minors::half_space);
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

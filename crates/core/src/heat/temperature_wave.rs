//! Temperature at all depths of a layered body for one wave of the flux into its surface.

use super::conducting_material::ConductingMaterial;
use crate::body::Depth;
use rustfft::num_complex::Complex64;

/// Wave of temperature e^{ik·x} in a layered body, over the amplitude of the flux into its surface.
#[derive(Debug, Clone, PartialEq)]
pub struct TemperatureWave {
    materials: Vec<ConductingMaterial>,
}

impl TemperatureWave {
    /// Wave in the materials of a body, from the surface down.
    pub(super) fn of(materials: Vec<ConductingMaterial>) -> Self {
        Self { materials }
    }

    /// Temperature at a depth, a temperature per power and area. Depths outside their material are brought back to its faces: both sides
    /// of an interface with a resistance differ.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn at(&self, depth: Depth) -> Complex64 {
        let material = &self.materials[depth.material - 1];
        material.temperature(material.below(depth))
    }

    /// Temperature of the surface, a temperature per power and area.
    pub fn surface(&self) -> Complex64 {
        self.materials[0].temperature(0.0)
    }

    /// Flux into the depth at a depth, over that into the surface.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn flux(&self, depth: Depth) -> Complex64 {
        let material = &self.materials[depth.material - 1];
        material.flux(material.below(depth))
    }

    /// Amplitudes A of e^{−s(z−z_j)} and B of e^{−s(z_{j+1}−z)} in a material between the depths z_j and z_{j+1}, temperatures per power and
    /// area; B = 0 in the substrate. In layers that are thin against |1/s| they are large and cancel.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn exponentials(&self, material: usize) -> [Complex64; 2] {
        self.materials[material - 1].exponentials()
    }

    /// Rate s of the decay with depth in a material, 1/length, Re s > 0.
    ///
    /// # Panics
    /// When there is no such material.
    pub fn rate(&self, material: usize) -> Complex64 {
        self.materials[material - 1].rate.rate
    }

    pub(super) fn materials(&self) -> &[ConductingMaterial] {
        &self.materials
    }
}

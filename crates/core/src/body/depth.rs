//! A place in depth, and the material it lies in.

/// A depth in one material. An interface is a depth in each of its two materials, where stresses differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth {
    /// Depth z ≥ 0 below the surface, a length.
    pub z: f64,
    /// Material, from 1; the substrate is layers + 1.
    pub material: usize,
}

impl Depth {
    /// The surface.
    pub const SURFACE: Self = Self { z: 0.0, material: 1 };
}

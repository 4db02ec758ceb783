//! One contact spot of a localized solution, and its readings.

use super::circle::Circle;
use super::edge_ratios::EdgeRatios;
use super::mesh::Mesh;
use super::outline::Outline;
use crate::numeric::array::samples;
use crate::numeric::closed_line::mean_radius;
use crate::numeric::paraboloid;
use ndarray::Array2;
use std::f64::consts::PI;
use std::sync::Arc;

/// Contact of the indenter of one site.
#[derive(Debug, Clone)]
pub struct Spot {
    /// Level of the indenter, from 1.
    pub level: usize,
    /// Position of the indenter, in fractions of the cell vectors.
    pub place: [f64; 2],
    /// Mesh around the indenter's axis.
    pub mesh: Mesh,
    /// Pressure on each element, in the unit of Young's modulus; axes along x and y.
    pub pressure: Array2<f64>,
    /// Gap w + f − δ over each element, a length; axes along x and y.
    pub gap: Array2<f64>,
    /// Circle around the indenter, with the indenters inside.
    pub circle: Circle,
    /// Radius of the circle, a length; infinite without mutual effect.
    pub radius: f64,
    /// Whether the contact reaches under a neighbour's surface, or a neighbour's contact under this indenter's surface.
    pub merged: bool,
    /// Ratios of pressure and gap at an edge on this half-space to those on a bare one.
    pub(super) edge: Arc<EdgeRatios>,
}

impl Spot {
    /// Pressure of each element, row by row.
    pub(super) fn pressures(&self) -> &[f64] {
        samples(&self.pressure)
    }

    /// Load on the indenter, a force: a pressure times an area.
    pub fn load(&self) -> f64 {
        self.pressures().iter().sum::<f64>() * self.element_area()
    }

    /// Whether the indenter is in contact.
    pub fn touches(&self) -> bool {
        self.pressures().iter().any(|&p| p > 0.0)
    }

    fn element_area(&self) -> f64 {
        self.mesh.size * self.mesh.size
    }

    /// Peak pressure: that of the most loaded element, raised to the top of the paraboloid through the 5 × 5 elements
    /// around it. The pressure of an element is nearly that at its centre, where the displacement is prescribed: at the
    /// top of Hertz' contact it errs by 7e-5 with 48 elements across.
    pub fn peak(&self) -> f64 {
        let (pressures, width) = (self.pressures(), self.mesh.width as i32);
        let Some(index) = (0..pressures.len()).max_by(|&a, &b| pressures[a].total_cmp(&pressures[b])) else {
            return 0.0;
        };
        let (row, column) = (index as i32 / width, index as i32 % width);
        let at = |i: i32, j: i32| {
            let [i, j] = [row + i, column + j];
            if i.min(j) >= 0 && i.max(j) < width { pressures[(i * width + j) as usize] } else { 0.0 }
        };
        pressures[index] + paraboloid::rise(2, at).unwrap_or(0.0)
    }

    /// Outline of the contact between the elements. `None` for spots of too few elements.
    pub fn outline(&self) -> Option<Outline> {
        Outline::new(&self.mesh, &self.edge, self.pressures(), samples(&self.gap))
    }

    /// Contact radius √(A/π), a length, from the outline, or from the number of elements where there is no outline.
    pub fn contact_radius(&self) -> f64 {
        self.outline().map_or(self.counted_radius(), |outline| (outline.area() / PI).sqrt())
    }

    /// Outer radius √(area within the outer rim/π), a length: larger than the contact radius where the spot is a ring.
    pub fn outer_radius(&self) -> f64 {
        self.outline().map_or(self.counted_radius(), |outline| mean_radius(&outline.radii))
    }

    /// Radius √(A/π) of the area of the elements in contact, a length.
    pub fn counted_radius(&self) -> f64 {
        let count = self.pressures().iter().filter(|&&p| p > 0.0).count() as f64;
        (count * self.element_area() / PI).sqrt()
    }
}

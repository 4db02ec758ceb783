//! One contact spot of a localized solution, and what is read off it.

use super::circle::Circle;
use super::mesh::Mesh;
use super::outline::Outline;
use crate::numeric::array::samples;
use crate::numeric::closed_line::mean_radius;
use crate::numeric::least_squares;
use ndarray::Array2;
use std::f64::consts::PI;

/// The contact of one site's indenter.
#[derive(Debug, Clone)]
pub struct Spot {
    /// Level of the indenter, from 1.
    pub level: usize,
    /// Its place in fractions of the cell vectors.
    pub place: [f64; 2],
    /// Elements around its axis.
    pub mesh: Mesh,
    /// Pressure on each element, in the unit of Young's modulus; axes along x and y.
    pub pressure: Array2<f64>,
    /// Gap w + f − δ over each element, a length; axes along x and y.
    pub gap: Array2<f64>,
    /// Indenters inside the circle around it.
    pub circle: Circle,
    /// Radius of that circle, a length; infinite without mutual effect.
    pub radius: f64,
}

impl Spot {
    /// The pressure element by element, row by row.
    pub(super) fn pressures(&self) -> &[f64] {
        samples(&self.pressure)
    }

    /// Force on the indenter: a pressure times an area.
    pub fn load(&self) -> f64 {
        self.pressures().iter().sum::<f64>() * self.element_area()
    }

    /// Whether the indenter touches.
    pub fn touches(&self) -> bool {
        self.pressures().iter().any(|&p| p > 0.0)
    }

    fn element_area(&self) -> f64 {
        self.mesh.size * self.mesh.size
    }

    /// Peak pressure: that of the most loaded element, raised to the top of the paraboloid through the 5 × 5 elements
    /// around it. Where displacements are prescribed at the centres of elements, so are the pressures nearly: at the
    /// top of Hertz' contact they err by 7e-5 with 48 elements across.
    pub fn peak(&self) -> f64 {
        let width = self.mesh.width;
        let Some(index) =
            (0..self.pressures().len()).max_by(|&a, &b| self.pressures()[a].total_cmp(&self.pressures()[b]))
        else {
            return 0.0;
        };
        let (row, column) = (index / width, index % width);
        if row < 2 || column < 2 || row + 3 > width || column + 3 > width {
            return self.pressures()[index];
        }
        let steps = || (0..25).map(|k| (k / 5, k % 5));
        let at = |(i, j): (usize, usize)| self.pressures()[(row + i - 2) * width + column + j - 2];
        if steps().any(|step| at(step) <= 0.0) {
            return self.pressures()[index];
        }
        let basis = |(i, j): (usize, usize)| {
            let (x, y) = (i as f64 - 2.0, j as f64 - 2.0);
            vec![1.0, x, y, x * x, x * y, y * y]
        };
        let Some(c) = least_squares::fit(6, steps().map(|step| (basis(step), at(step)))) else {
            return self.pressures()[index];
        };
        let determinant = 4.0 * c[3] * c[5] - c[4] * c[4];
        if c[3] >= 0.0 || determinant <= 0.0 {
            return self.pressures()[index];
        }
        self.pressures()[index] - (c[5] * c[1] * c[1] - c[4] * c[1] * c[2] + c[3] * c[2] * c[2]) / determinant
    }

    /// Outline of the contact between the elements. `None` for spots of too few elements.
    pub fn outline(&self) -> Option<Outline> {
        Outline::new(&self.mesh, self.pressures(), samples(&self.gap))
    }

    /// Contact radius √(A/π), from the outline, or from the number of elements where it is not found.
    pub fn contact_radius(&self) -> f64 {
        self.outline().map_or(self.counted_radius(), |outline| (outline.area() / PI).sqrt())
    }

    /// √(area within the outer line/π): larger than the contact radius where the spot is a ring.
    pub fn outer_radius(&self) -> f64 {
        self.outline().map_or(self.counted_radius(), |outline| mean_radius(&outline.radii))
    }

    /// √(A/π) of the elements in contact.
    pub fn counted_radius(&self) -> f64 {
        let count = self.pressures().iter().filter(|&&p| p > 0.0).count() as f64;
        (count * self.element_area() / PI).sqrt()
    }
}

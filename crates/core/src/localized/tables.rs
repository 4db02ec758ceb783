//! Influence tables of all pairs of sites.

use super::circle::Circle;
use super::exterior::Exterior;
use super::mesh::{Influence, Mesh};
use super::square::Squares;
use super::system::System;

/// Influence tables A_mc of all pairs of sites m, c.
#[derive(Debug)]
pub(super) struct InfluenceTables {
    /// Table `rows[m][c]`; `None` where no indenter of c acts on m.
    rows: Vec<Vec<Option<Influence>>>,
    /// Area of an element, a length squared.
    element: f64,
}

impl InfluenceTables {
    /// Influence of the indenters inside the circles.
    pub fn inside(system: &System, mesh: Mesh, circles: &[Circle]) -> Self {
        let squares = Squares::new(system.kernel(), 0.5 * mesh.size);
        let table = |images: &Vec<[f64; 2]>| (!images.is_empty()).then(|| Influence::new(&squares, mesh, images, None));
        let rows = circles.iter().map(|circle| circle.images.iter().map(table).collect()).collect();
        Self { rows, element: mesh.size * mesh.size }
    }

    /// Influence of all indenters of the lattice, inside circles of at least `indenters` and outside them.
    pub fn whole(system: &System, mesh: Mesh, indenters: usize) -> Self {
        let squares = Squares::new(system.kernel(), 0.5 * mesh.size);
        let exterior = Exterior::new(system, mesh, indenters);
        let element = mesh.size * mesh.size;
        let table = |m: usize, c: usize| {
            let outside = |x: f64, y: f64| element * exterior.at(m, c, [x, y]);
            Some(Influence::new(&squares, mesh, &exterior.circles()[m].images[c], Some(&outside)))
        };
        let sites = 0..exterior.circles().len();
        let rows = sites.clone().map(|m| sites.clone().map(|c| table(m, c)).collect()).collect();
        Self { rows, element }
    }

    /// Influence of the indenters of the site m under m.
    pub fn on_itself(&self, m: usize) -> &Influence {
        self.rows[m][m].as_ref().expect("the centre stands in its own circle")
    }

    /// Influence of the indenters of the site c under m; `None` where none of them acts.
    pub fn of(&self, m: usize, c: usize) -> Option<&Influence> {
        self.rows[m][c].as_ref()
    }

    /// Displacement on the axis of m by unit forces on the axes of the indenters of c, a length per force.
    pub fn between_axes(&self, m: usize, c: usize) -> f64 {
        self.of(m, c).map_or(0.0, |table| table.diagonal() / self.element)
    }
}

//! The area in contact between the samples: within located boundaries, and along the lines of samples elsewhere.
//!
//! Spots without a located boundary share the area that the lines of samples find there in proportion to their counted areas.

use super::area;
use super::boundary::Boundary;
use super::fraction::Fraction;
use super::spots::SpotReading;
use crate::lattice::components::Component;
use crate::spectral::Contact;

/// The area in contact on one grid.
pub struct ContactArea {
    /// Area of the cell, a length squared.
    cell: f64,
    /// Area within located boundaries and its error, lengths squared.
    located: [f64; 2],
    /// Fraction of the cell that the spots without a located boundary take.
    along_lines: Fraction,
    /// The cell over the counted area of the spots without a located boundary; 0 without such spots.
    per_counted: f64,
}

impl ContactArea {
    /// The area of a contact with these components: `spots` of indenters, or boundaries of a `topography`, one for each component.
    pub fn of(
        contact: &Contact,
        components: &[Component],
        spots: &[SpotReading],
        topography: &[Option<Boundary>],
    ) -> Self {
        let (grid, surface) = (contact.grid(), contact.surface());
        let (pressure, gap, cell) = (contact.pressures(), contact.gaps(), grid.cell().area());
        let along_lines = if surface.owners().is_empty() {
            let others = components.iter().zip(topography).filter(|(_, boundary)| boundary.is_none());
            area::of_components(
                grid,
                (pressure, contact.hardness()),
                gap,
                others.map(|(component, _)| component),
                components.len(),
            )
        } else {
            // A component has one owner, or its owners have merged.
            let owner = |component: &Component| surface.owners()[component.runs[0].index(grid.points())];
            let others = components.iter().filter(|component| spots[owner(component) as usize].boundary.is_none());
            area::of_components(grid, (pressure, contact.hardness()), gap, others, components.len())
        };
        let boundaries = || spots.iter().map(|spot| &spot.boundary).chain(topography).flatten();
        let located = [boundaries().map(Boundary::area).sum(), boundaries().map(Boundary::area_error).sum()];
        let counted: f64 = spots.iter().filter(|spot| spot.boundary.is_none()).map(|spot| spot.counted).sum();
        Self { cell, located, along_lines, per_counted: if counted > 0.0 { cell / counted } else { 0.0 } }
    }

    /// Area within located boundaries, a length squared.
    pub fn located(&self) -> f64 {
        self.located[0]
    }

    /// Area in contact, a length squared.
    pub fn total(&self) -> f64 {
        self.located[0] + self.cell * self.along_lines.value
    }

    /// Fraction of the cell in contact.
    pub fn fraction(&self) -> Fraction {
        Fraction {
            value: self.total() / self.cell,
            uncertainty: self.located[1] / self.cell + self.along_lines.uncertainty,
        }
    }

    /// Area of one spot and its error, lengths squared.
    pub fn of_spot(&self, spot: &SpotReading) -> [f64; 2] {
        match &spot.boundary {
            Some(boundary) => [boundary.area(), boundary.area_error()],
            None => {
                let Fraction { value, uncertainty } = self.along_lines;
                [value, uncertainty].map(|part| part * self.per_counted * spot.counted)
            }
        }
    }
}

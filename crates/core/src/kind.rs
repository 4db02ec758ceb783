//! Kind of a contact: what lies around its cell, and what loads the body there.
//!
//! | | counterbody | given pressure |
//! |---|---|---|
//! | **periodic** | the pressure is sought; contact may be complete | the pressure is known |
//! | **isolated** | the pressure is sought; contact stays inside a window, which may be widened, and has a stiffness dP/dδ | the pressure is known |
//!
//! A periodic system has means, parts and densities of its cell, and its load is the mean pressure; an isolated contact has none of these,
//! and its load is a force.

use crate::lattice::Surroundings;
use crate::load::LoadQuantity;

/// Kind of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ContactKind {
    /// Surroundings of the cell.
    pub surroundings: Surroundings,
    /// Whether a pressure is given, and no contact is solved for.
    pub is_given: bool,
}

/// Datum from which the penetration and the displacements of a surface count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Datum {
    /// The mean plane of the deformed surface: the penetration is the additional displacement of Eq. (8).
    MeanPlane,
    /// Points far away, which do not move: the penetration is their approach.
    FarAway,
    /// The rigid base: the penetration has the mean compression of the layers, p̄ Σ h/M.
    Base,
}

impl ContactKind {
    /// The quantity in which loads are stated where a case does not say it.
    pub fn load_quantity(self) -> LoadQuantity {
        match self.surroundings {
            Surroundings::Periodic => LoadQuantity::MeanPressure,
            Surroundings::FreeSpace => LoadQuantity::Force,
        }
    }

    /// Whether all of the cell may be in contact.
    pub fn may_be_complete(self) -> bool {
        self.surroundings == Surroundings::Periodic && !self.is_given
    }

    /// Whether one counterbody alone is pressed in: contact has a stiffness dP/dδ, and stays inside its window.
    pub fn is_indentation(self) -> bool {
        self.surroundings == Surroundings::FreeSpace && !self.is_given
    }
}

impl Datum {
    /// The datum in these surroundings of a body whose surface a uniform pressure displaces by the `compliance`, a length per pressure;
    /// 0 where the mean plane is left.
    pub(crate) fn of(surroundings: Surroundings, compliance: f64) -> Self {
        match surroundings {
            Surroundings::FreeSpace => Self::FarAway,
            Surroundings::Periodic if compliance > 0.0 => Self::Base,
            Surroundings::Periodic => Self::MeanPlane,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Interface, Layer, Material};
    use crate::counterbody::{GivenPressure, LoadedDisc};
    use crate::lattice::Cell;
    use crate::problem::Problem;

    #[test]
    fn a_kind_states_what_exists_and_what_the_penetration_counts_from() {
        let disc = LoadedDisc { centre: [0.0; 2], radius: 0.2, pressure: 0.1 };
        let [periodic, isolated] = [Cell::square(1.0), Cell::window([1.0; 2])].map(|cell| {
            let given = GivenPressure::discs(cell.unwrap(), vec![disc]).unwrap();
            Problem::new(given, HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap()))
        });
        let quantities = [&periodic, &isolated].map(|problem| problem.kind().load_quantity());
        assert_eq!(quantities, [LoadQuantity::MeanPressure, LoadQuantity::Force]);
        assert_eq!(
            [&periodic, &isolated].map(|problem| problem.cell().surroundings().per_cell(2.0)),
            [Some(2.0), None]
        );
        let based = |poisson| {
            let layer = Layer::new(Material::from_young(1.0, poisson).unwrap(), 0.1, Interface::Bonded).unwrap();
            HalfSpace::on_rigid_base(vec![layer]).unwrap()
        };
        // An incompressible layer keeps its mean plane.
        let data =
            [&periodic, &periodic.on_body(based(0.3)), &periodic.on_body(based(0.5)), &isolated].map(Problem::datum);
        assert_eq!(data, [Datum::MeanPlane, Datum::Base, Datum::MeanPlane, Datum::FarAway]);
        let kinds = [false, true].map(|is_given| ContactKind { is_given, ..periodic.kind() });
        assert_eq!(kinds.map(ContactKind::may_be_complete), [true, false]);
        assert_eq!([isolated.kind().is_given, isolated.kind().is_indentation()], [true, false]);
    }
}

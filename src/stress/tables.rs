//! Tables of a body on the grids of a run, made once for all loads.

use crate::body::{HalfSpace, Interiors, TransferFunction};
use crate::lattice::Grid;
use std::sync::{Arc, Mutex, PoisonError};

/// Grids whose tables are kept: those of a step and its errors, and as many that take their place.
const KEPT: usize = 4;

/// What stress fields of one run share.
#[derive(Debug, Default)]
pub(crate) struct Tables(Mutex<Vec<Table>>);

#[derive(Debug)]
struct Table {
    grid: Arc<Grid>,
    half_space: HalfSpace,
    slides: bool,
    interiors: Arc<Interiors>,
}

impl Tables {
    /// The interiors of a half-space under the waves of a grid; they are made where there are none yet.
    pub fn interiors(&self, grid: &Arc<Grid>, half_space: &HalfSpace, slides: bool) -> Arc<Interiors> {
        let mut tables = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let is_own =
            |own: &&Table| Arc::ptr_eq(&own.grid, grid) && own.slides == slides && own.half_space == *half_space;
        if let Some(own) = tables.iter().find(is_own) {
            return Arc::clone(&own.interiors);
        }
        let transfer = TransferFunction::new(half_space);
        let interiors = Arc::new(Interiors::new(transfer, grid.waves().wavenumbers(), slides));
        if tables.len() == KEPT {
            tables.remove(0);
        }
        let (grid, half_space) = (Arc::clone(grid), half_space.clone());
        tables.push(Table { grid, half_space, slides, interiors: Arc::clone(&interiors) });
        interiors
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Interface, Layer, Material};
    use crate::lattice::Cell;

    #[test]
    fn a_table_is_made_once_for_a_body_on_a_grid_and_few_are_kept() {
        let material = Material::from_shear(1.0, 0.3).unwrap();
        let body = |h: f64| HalfSpace::new(vec![Layer::new(material, h, Interface::Bonded).unwrap()], material);
        let grid = || Arc::new(Grid::new(Cell::square(1.0).unwrap(), [8, 8]).unwrap());
        let (tables, grids) = (Tables::default(), [0; KEPT].map(|_| grid()));
        let first = tables.interiors(&grids[0], &body(0.1), false);
        assert!(Arc::ptr_eq(&first, &tables.interiors(&grids[0], &body(0.1), false)));
        assert!(!Arc::ptr_eq(&first, &tables.interiors(&grids[0], &body(0.2), false)));
        assert!(!Arc::ptr_eq(&first, &tables.interiors(&grids[0], &body(0.1), true)));
        grids.iter().for_each(|grid| drop(tables.interiors(grid, &body(0.1), false)));
        assert_eq!(tables.0.lock().unwrap().len(), KEPT);
    }
}

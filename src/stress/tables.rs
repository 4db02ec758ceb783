//! Tables of the interior on the grids of a run, set up once for all loads.

use super::far_field::FarTables;
use crate::body::{HalfSpace, InteriorTable, LayeredResponse};
use crate::lattice::{Cell, Grid};
use std::sync::{Arc, Mutex, PoisonError};

/// Tables that are kept: those of both bodies on the grids of a step and of its errors, and as many that replace them.
const KEPT: usize = 8;

/// Tables of the interior that the stress fields of one run share.
#[derive(Debug, Default)]
pub(crate) struct Tables {
    interiors: Mutex<Vec<Entry>>,
    far: Mutex<Vec<Arc<FarTables>>>,
}

#[derive(Debug)]
struct Entry {
    grid: Arc<Grid>,
    response: Arc<LayeredResponse>,
    slides: bool,
    table: Arc<InteriorTable>,
}

impl Tables {
    /// Table of a half-space for the wavenumbers of a grid, set up unless there is one already.
    pub fn interiors(&self, grid: &Arc<Grid>, half_space: &HalfSpace, slides: bool) -> Arc<InteriorTable> {
        let mut entries = self.interiors.lock().unwrap_or_else(PoisonError::into_inner);
        let response = half_space.response();
        let is_own = |own: &&Entry| Arc::ptr_eq(&own.grid, grid) && own.slides == slides && own.response == *response;
        if let Some(own) = entries.iter().find(is_own) {
            return Arc::clone(&own.table);
        }
        let (grid, response) = (Arc::clone(grid), Arc::clone(response));
        let table = Arc::new(InteriorTable::new(Arc::clone(&response), grid.waves().wavenumbers(), slides));
        if entries.len() == KEPT {
            entries.remove(0);
        }
        entries.push(Entry { grid, response, slides, table: Arc::clone(&table) });
        table
    }

    /// Tables of the free field around an isolated contact in a window.
    pub(super) fn far(&self, window: Cell, half_space: &HalfSpace, traction: Option<[f64; 2]>) -> Arc<FarTables> {
        let mut entries = self.far.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = entries.iter().find(|own| own.are_of(window, half_space, traction)) {
            return Arc::clone(own);
        }
        let own = FarTables::new(window, half_space, traction).expect("multiples of a window are windows");
        let own = Arc::new(own);
        if entries.len() == KEPT {
            entries.remove(0);
        }
        entries.push(Arc::clone(&own));
        own
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
        assert_eq!(tables.interiors.lock().unwrap().len(), KEPT);
    }
}

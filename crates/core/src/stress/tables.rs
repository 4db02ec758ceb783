//! Tables of the interior on the grids of a run, set up once for all loads.

use super::far_tables::FarTables;
use super::passed::Passed;
use super::passed_shells::PassedShells;
use super::series_grid::series_grid;
use super::smoothed_edge::SmoothedEdge;
use super::thermal::Thermal;
use super::traction::ShearForm;
use super::work::WorkCounter;
use crate::body::{HalfSpace, InteriorTable, LayeredResponse};
use crate::heat::HeatedBody;
use crate::lattice::{Cell, Grid};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Tables that are kept: those of both bodies on the grids of a step and of its errors, and as many that replace them.
const KEPT: usize = 8;
/// Tables that are kept of the windows around that of an isolated contact, up to twelve, each with two bodies on two grids. Their grids have few
/// samples.
const KEPT_AROUND: usize = 48;

/// Tables of the interior that the stress fields of one run share.
#[derive(Debug)]
pub(crate) struct Tables {
    /// Number of tables of each kind that are kept.
    kept: usize,
    /// Tables of the windows around that of an isolated contact.
    around: OnceLock<Arc<Tables>>,
    interiors: Mutex<Vec<Entry>>,
    shells: Mutex<Vec<Arc<PassedShells>>>,
    passed: Mutex<Vec<Arc<Passed>>>,
    thermal: Mutex<Vec<Arc<Thermal>>>,
    far: Mutex<Vec<Arc<FarTables>>>,
    /// Tables of smoothed edges by η of their exponents.
    edges: Mutex<Vec<(f64, Arc<SmoothedEdge>)>>,
    /// Grids of pressures with those of their series.
    grids: Mutex<Vec<[Arc<Grid>; 2]>>,
    /// Work of the fields so far.
    work: Arc<WorkCounter>,
}

#[derive(Debug)]
struct Entry {
    shells: Arc<PassedShells>,
    response: Arc<LayeredResponse>,
    slides: bool,
    table: Arc<InteriorTable>,
}

impl Default for Tables {
    fn default() -> Self {
        Self::keeping(KEPT, Arc::default())
    }
}

impl Tables {
    fn keeping(kept: usize, work: Arc<WorkCounter>) -> Self {
        let (around, interiors, shells, passed) = Default::default();
        let (thermal, far, edges, grids) = Default::default();
        Self { kept, around, interiors, shells, passed, thermal, far, edges, grids, work }
    }

    /// Counters of the work of all fields that share the tables.
    pub(super) fn work(&self) -> &Arc<WorkCounter> {
        &self.work
    }

    /// Tables of the windows around that of an isolated contact.
    pub(super) fn around(&self) -> &Arc<Self> {
        self.around.get_or_init(|| Arc::new(Self::keeping(KEPT_AROUND, Arc::clone(&self.work))))
    }

    /// Table of a half-space for the wavenumbers of a grid, set up unless there is one already.
    pub fn interiors(&self, grid: &Arc<Grid>, half_space: &HalfSpace, slides: bool) -> Arc<InteriorTable> {
        self.interiors_of(&self.shells(grid, None), half_space, slides)
    }

    /// Table of a half-space for the wavenumbers of `shells`, set up unless there is one already.
    pub(super) fn interiors_of(
        &self,
        shells: &Arc<PassedShells>,
        half_space: &HalfSpace,
        slides: bool,
    ) -> Arc<InteriorTable> {
        let mut entries = self.interiors.lock().unwrap_or_else(PoisonError::into_inner);
        let response = half_space.response();
        let is_known =
            |entry: &&Entry| entry.shells.are(shells) && entry.slides == slides && entry.response == *response;
        if let Some(entry) = entries.iter().find(is_known) {
            return Arc::clone(&entry.table);
        }
        let (shells, response) = (Arc::clone(shells), Arc::clone(response));
        let table = Arc::new(InteriorTable::new(Arc::clone(&response), shells.waves().wavenumbers(), slides));
        keep(self.kept, &mut entries, Entry { shells, response, slides, table: Arc::clone(&table) });
        table
    }

    /// Shells of the waves of a grid below a load that moves in a direction, or rests, set up unless there are some already.
    pub(super) fn shells(&self, grid: &Arc<Grid>, direction: Option<[f64; 2]>) -> Arc<PassedShells> {
        let is_known = |entry: &Arc<PassedShells>| entry.are_of(grid, direction);
        self.known_or(&self.shells, is_known, || PassedShells::new(grid, direction))
    }

    /// Table of a half-space that a load passes with a speed, for the waves in `shells`, set up unless there is one already.
    pub(super) fn passed(&self, shells: &Arc<PassedShells>, half_space: &HalfSpace, below: (f64, bool)) -> Arc<Passed> {
        let is_known = |entry: &Arc<Passed>| entry.is_of(shells, half_space, below);
        self.known_or(&self.passed, is_known, || Passed::new(shells, half_space, below))
    }

    /// Thermal stresses of a body, for the waves in `shells`, set up unless there are some already.
    pub(super) fn thermal(&self, shells: &Arc<PassedShells>, body: &HeatedBody) -> Arc<Thermal> {
        let is_known = |entry: &Arc<Thermal>| entry.is_of(shells, body);
        self.known_or(&self.thermal, is_known, || Thermal::new(shells, body))
    }

    /// The entry that `is_known`, or a new one.
    fn known_or<T>(
        &self,
        entries: &Mutex<Vec<Arc<T>>>,
        is_known: impl Fn(&Arc<T>) -> bool,
        make: impl FnOnce() -> T,
    ) -> Arc<T> {
        let mut entries = entries.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(entry) = entries.iter().find(|entry| is_known(entry)) {
            return Arc::clone(entry);
        }
        let made = Arc::new(make());
        keep(self.kept, &mut entries, Arc::clone(&made));
        made
    }

    /// The grid of the series of a pressure on `grid`, see [`series_grid`], set up unless there is one already.
    pub(super) fn series_grid(&self, grid: &Arc<Grid>) -> Arc<Grid> {
        let mut entries = self.grids.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some([_, series]) = entries.iter().find(|[known, _]| is_same(known, grid)) {
            return Arc::clone(series);
        }
        let series = series_grid(grid);
        keep(self.kept, &mut entries, [grid, &series].map(Arc::clone));
        series
    }

    /// Tables of smoothed edges with the exponents ½ ± η.
    pub(super) fn edges(&self, eta: f64) -> Arc<SmoothedEdge> {
        let mut entries = self.edges.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, edges)) = entries.iter().find(|(of, _)| *of == eta) {
            return Arc::clone(edges);
        }
        let edges = Arc::new(SmoothedEdge::new(eta));
        keep(self.kept, &mut entries, (eta, Arc::clone(&edges)));
        edges
    }

    /// Tables of the free field around an isolated contact in a window.
    pub(super) fn far(&self, window: Cell, half_space: &HalfSpace, form: ShearForm) -> Arc<FarTables> {
        let mut entries = self.far.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(tables) = entries.iter().find(|tables| tables.are_of(window, half_space, form)) {
            return Arc::clone(tables);
        }
        let tables = FarTables::new(window, half_space, form).expect("multiples of a window are windows");
        let tables = Arc::new(tables);
        keep(self.kept, &mut entries, Arc::clone(&tables));
        tables
    }
}

/// Adds an entry, and removes the first one of more than a number.
fn keep<T>(most: usize, entries: &mut Vec<T>, entry: T) {
    if entries.len() == most {
        entries.remove(0);
    }
    entries.push(entry);
}

/// Whether two grids have the same cell and the same numbers of samples, and with them the same waves.
fn is_same(one: &Arc<Grid>, other: &Arc<Grid>) -> bool {
    Arc::ptr_eq(one, other) || one.cell() == other.cell() && one.points() == other.points()
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
        let grid = |n: usize| Arc::new(Grid::new(Cell::square(1.0).unwrap(), [n, n]).unwrap());
        let tables = Tables::default();
        let grids: [_; KEPT] = std::array::from_fn(|k| grid(8 + k));
        let first = tables.interiors(&grids[0], &body(0.1), false);
        assert!(Arc::ptr_eq(&first, &tables.interiors(&grid(8), &body(0.1), false)));
        assert!(!Arc::ptr_eq(&first, &tables.interiors(&grids[0], &body(0.2), false)));
        assert!(!Arc::ptr_eq(&first, &tables.interiors(&grids[0], &body(0.1), true)));
        grids.iter().for_each(|grid| drop(tables.interiors(grid, &body(0.1), false)));
        assert_eq!(tables.interiors.lock().unwrap().len(), KEPT);
    }

    /// Around an isolated contact the fields of all loads share the grid of their series, and so its tables.
    #[test]
    fn the_wide_grid_of_a_window_is_made_once() {
        let grid = || Arc::new(Grid::new(Cell::window([1.0, 2.0]).unwrap(), [8, 10]).unwrap());
        let tables = Tables::default();
        let first = tables.series_grid(&grid());
        assert!(Arc::ptr_eq(&first, &tables.series_grid(&grid())) && first.points() == [16, 20]);
        let half_space = HalfSpace::new(vec![], Material::from_shear(1.0, 0.3).unwrap());
        let table = tables.interiors(&first, &half_space, false);
        assert!(Arc::ptr_eq(&table, &tables.interiors(&tables.series_grid(&grid()), &half_space, false)));
    }
}

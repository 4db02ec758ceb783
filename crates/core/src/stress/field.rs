//! The stress field under a solved contact, and its states at points.

use super::constants::SHALLOW;
use super::depth_response::DepthResponse;
use super::far_field::FarField;
use super::far_plane::FarPlane;
use super::loaded_window::{LoadedWindow, MOST_WINDOWS};
use super::mean_states::{across, mean_states};
use super::measure::StressMeasure;
use super::passed::{Meaning, Passed};
use super::regions::Regions;
use super::series::{Response, Series};
use super::series_grid::spread;
use super::tables::Tables;
use super::taylor::Expansion;
use super::tensor::StressState;
use super::thermal::Thermal;
use super::traction::{ShearForm, Traction};
use crate::body::{Bodies, Depth, HalfSpace, InteriorTable, MeanStress};
use crate::counterbody::LoadedDisc;
use crate::friction::Friction;
use crate::lattice::{Cell, Grid, NotOnGrid, Surroundings};
use crate::load::Load;
use crate::spectral::Contact;
use ndarray::ArrayView2;
use rustfft::num_complex::Complex64;
use std::collections::VecDeque;
use std::f64::consts::PI;
use std::fmt;
use std::sync::{Arc, Mutex, OnceLock};

pub(super) use crate::body::REACH;

/// Amplitudes of the waves inside a body.
#[derive(Debug)]
pub(super) enum Interiors {
    /// Amplitudes of a body at rest below its load, or elastic.
    Resting(Arc<InteriorTable>),
    /// Amplitudes of a body that relaxes below a load that moves.
    Passed(Arc<Passed>, Meaning),
}

/// The stress field of one body in a load step.
#[derive(Debug)]
pub struct StressField {
    pub(super) series: Series,
    /// The grid of the pressure.
    grid: Arc<Grid>,
    /// The grid of the series: that of the pressure, or of an isolated contact one of twice its window.
    series_grid: Arc<Grid>,
    /// Difference of the free field of an isolated contact and the periodic one of the series; `None` in a periodic
    /// cell.
    far: Option<FarField>,
    /// The traction in the window of an isolated contact; `None` in a periodic cell.
    pub(super) loaded: Option<Arc<LoadedWindow>>,
    /// Fields in the windows around that of an isolated contact, each made when it is asked for first.
    pub(super) around: [OnceLock<Option<Box<Self>>>; MOST_WINDOWS as usize],
    /// The expansions that searches made last.
    pub(super) expansions: Mutex<VecDeque<Expansion>>,
    /// The window inside of which the field does not hold, of one around the window of the contact.
    hole: Option<Cell>,
    half_space: HalfSpace,
    interiors: Interiors,
    /// Stresses by heat that enters the body; `None` of a cold one.
    thermal: Option<Arc<Thermal>>,
    tables: Arc<Tables>,
    /// State under the mean pressure at the upper face of each material, and the derivative of its displacement by depth.
    mean: Vec<(StressState, [f64; 3])>,
    mean_stress: MeanStress,
    /// Whether the largest strains are searched beside the largest stresses.
    pub(super) strains: bool,
    /// The mean pressure over the cell, or the force on an isolated contact.
    load: Load,
    regions: Regions,
    /// The discs of a given pressure under the load; none of any other.
    discs: Vec<LoadedDisc>,
    /// Distance of neighbouring samples across lines along which nothing changes, a length; `None` where there are none.
    across_lines: Option<f64>,
    /// Form of the tangential traction.
    form: ShearForm,
    /// Means of q_x and q_y over the cell of the series, pressures, of a tangential traction that is a field of its own; else zero.
    mean_shear: [f64; 2],
}

impl StressField {
    /// Stress field of the body under a solved contact.
    pub fn new(contact: &Contact, mean: MeanStress) -> Self {
        let body = contact.problem().bodies().on(None);
        Self::sharing(&Traction::sliding(contact), body, mean, Arc::default())
    }

    /// Stress field under any `pressure` on a `half_space`, axes along a₁ and a₂, and under the traction of `friction`. Of coupled friction
    /// the pressure is taken to end with its exponents, of any other like a square root.
    ///
    /// # Errors
    /// [`NotOnGrid`] unless the pressure has one value per sample of the grid.
    pub fn under(
        grid: &Arc<Grid>,
        pressure: ArrayView2<'_, f64>,
        half_space: &HalfSpace,
        friction: Option<&Friction>,
        mean: MeanStress,
    ) -> Result<Self, NotOnGrid> {
        let traction = Traction::normal(grid, pressure)?;
        let beta = Bodies::from(half_space.clone()).dundurs_beta();
        let traction = match friction {
            Some(friction) => traction.with_friction(friction, beta),
            None => traction,
        };
        Ok(Self::of(&traction, half_space, mean))
    }

    /// Stress field under any traction on a `half_space`.
    pub fn of(traction: &Traction<'_>, half_space: &HalfSpace, mean: MeanStress) -> Self {
        Self::sharing(traction, half_space, mean, Arc::default())
    }

    /// Stress field under a traction that shares the `tables` of other fields.
    pub(super) fn sharing(
        traction: &Traction<'_>,
        half_space: &HalfSpace,
        mean: MeanStress,
        tables: Arc<Tables>,
    ) -> Self {
        let (grid, form, discs, line) = (traction.grid(), traction.form(), traction.discs(), traction.line());
        let series_grid = tables.series_grid(grid);
        let spread = spread(grid, traction.pressure());
        let (mut series, mean_shear) = Series::under(&series_grid, grid, traction, &spread);
        let ([vx, vy], slides) = (traction.velocity(), form != ShearForm::None);
        let speed = vx.hypot(vy);
        let (lags, heat) = (speed > 0.0 && half_space.relaxes(), traction.heat());
        let is_passed = speed > 0.0 && (lags || heat.is_some());
        let shells = tables.shells(&series_grid, is_passed.then(|| [vx / speed, vy / speed]));
        series = series.in_shells_of(shells.waves());
        let interiors = match lags {
            true => Interiors::Passed(tables.passed(&shells, half_space, (speed, slides)), Meaning::Stresses),
            false => Interiors::Resting(tables.interiors_of(&shells, half_space, slides)),
        };
        let (load, far, loaded) = match grid.cell().surroundings() {
            Surroundings::Periodic => (Load::MeanPressure(series.mean), None, None),
            Surroundings::FreeSpace => {
                let load = Load::Force(series.mean * series_grid.cell().area());
                // The free field has no mean.
                series.mean = 0.0;
                let far = FarField::new(tables.far(grid.cell(), half_space, form), traction, series_grid.cell());
                let loaded = Arc::new(LoadedWindow::new(traction.clone().into_owned(), half_space));
                (load, Some(far), Some(loaded))
            }
        };
        let mean_traction = match (form.ratio(), &far) {
            (Some(ratio), _) => ratio.map(|ratio| series.mean * ratio),
            (None, Some(_)) => [0.0; 2],
            (None, None) => mean_shear,
        };
        let regions = Regions::new(&series_grid, &spread, line);
        Self {
            loaded,
            around: Default::default(),
            expansions: Mutex::default(),
            hole: None,
            grid: Arc::clone(grid),
            half_space: half_space.clone(),
            interiors,
            thermal: heat.map(|heat| tables.thermal(&shells, &heat.body)),
            far,
            mean: mean_states(half_space, (mean, across(grid, line)), series.mean, mean_traction),
            mean_stress: mean,
            strains: false,
            load,
            regions: match traction.is_of_contact() {
                true => regions,
                false => regions.without_edges(&series_grid, &spread, !discs.is_empty() && form != ShearForm::Fields),
            },
            discs: discs.to_vec(),
            across_lines: line.map(|axis| {
                let [x, y] = grid.steps()[axis];
                grid.sample_area() / x.hypot(y)
            }),
            series_grid,
            form,
            mean_shear,
            series: series.counted_by(tables.work()),
            tables,
        }
    }

    /// The field, of which the largest strains are searched beside the largest stresses where `strains` is set.
    #[must_use]
    pub fn with_strains(self, strains: bool) -> Self {
        Self { strains, ..self }
    }

    /// The field of other waves of the same pressure, on the grids of another window and of its series, that holds outside of a `hole`.
    pub(super) fn outside(
        &self,
        hole: Cell,
        [grid, series_grid]: [Arc<Grid>; 2],
        series: Series,
        far: FarField,
    ) -> Self {
        let tables = Arc::clone(self.tables.around());
        Self {
            loaded: self.loaded.clone(),
            around: Default::default(),
            expansions: Mutex::default(),
            hole: Some(hole),
            half_space: self.half_space.clone(),
            interiors: Interiors::Resting(tables.interiors(&series_grid, &self.half_space, self.slides())),
            thermal: None,
            far: Some(far),
            mean: self.mean.clone(),
            regions: Regions::new(&series_grid, &vec![0.0; series_grid.len()], None),
            discs: self.discs.clone(),
            across_lines: None,
            grid,
            series_grid,
            series: series.counted_by(tables.work()),
            tables,
            ..*self
        }
    }

    /// Field of the stresses that have the strains of this one by Hooke's law of the relaxed moduli, below a load that moves over a body that
    /// relaxes; `None` where the stresses themselves have them.
    ///
    /// By it strains are read and searched as in any other body. Below edges of a contact, where strains follow from glassy moduli, its
    /// surface is not sharpened as it should be.
    #[must_use]
    pub fn hookean(&self) -> Option<Self> {
        let Interiors::Passed(passed, Meaning::Stresses) = &self.interiors else { return None };
        Some(Self {
            series: self.series.clone(),
            grid: Arc::clone(&self.grid),
            series_grid: Arc::clone(&self.series_grid),
            far: None,
            loaded: None,
            around: Default::default(),
            expansions: Mutex::default(),
            hole: None,
            half_space: self.half_space.clone(),
            interiors: Interiors::Passed(Arc::clone(passed), Meaning::Strains),
            thermal: self.thermal.clone(),
            tables: Arc::clone(&self.tables),
            mean: self.mean.clone(),
            regions: self.regions.clone(),
            discs: self.discs.clone(),
            ..*self
        })
    }

    /// Whether a measure is one of the stresses of the field, and not of those of [`Self::hookean`], or the other way round.
    pub(super) fn has(&self, measure: StressMeasure) -> bool {
        match &self.interiors {
            Interiors::Passed(_, of) => measure.is_strain() == (*of == Meaning::Strains),
            Interiors::Resting(_) => true,
        }
    }

    /// Whether the field does not hold at a place, lengths.
    pub(super) fn is_hidden(&self, place: [f64; 2]) -> bool {
        let inside = |hole: &Cell| hole.fractions(place).iter().all(|s| (1e-9..1.0 - 1e-9).contains(s));
        self.hole.as_ref().is_some_and(inside)
    }

    /// Whether the field has a hole.
    pub(super) fn has_hole(&self) -> bool {
        self.hole.is_some()
    }

    /// The layered half-space below the pressure.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// Poisson's ratio ν of the material at the surface; below a load that moves that of waves of four samples.
    pub fn surface_poisson(&self) -> f64 {
        let material = self.half_space.surface_material();
        match &self.interiors {
            Interiors::Resting(_) => material.poisson(),
            Interiors::Passed(passed, _) => {
                let frequency = 0.5 * self.least_aliased() * passed.speed();
                material.moduli_at(Complex64::new(0.0, frequency)).poisson.re
            }
        }
    }

    /// The mean pressure over the cell of the series: around an isolated contact that of twice its window.
    pub(super) fn mean_pressure(&self) -> f64 {
        match self.load {
            Load::Force(force) => force / self.series_grid.cell().area(),
            _ => self.series.mean,
        }
    }

    /// The choice of the mean lateral stress.
    pub fn mean_stress(&self) -> MeanStress {
        self.mean_stress
    }

    /// Tangential traction on the surface over the pressure: μ **e** of a counterbody that slides, zero without friction; `None` of
    /// tangential tractions that do not follow from the pressure.
    pub fn traction_over_pressure(&self) -> Option<[f64; 2]> {
        self.form.ratio()
    }

    /// Form of the tangential traction.
    pub(super) fn form(&self) -> ShearForm {
        self.form
    }

    /// Means of q_x and q_y over the cell of the series, pressures, of tangential tractions that do not follow from the pressure; else
    /// zero.
    pub(super) fn mean_shear(&self) -> [f64; 2] {
        self.mean_shear
    }

    /// Whether the surface has a shear traction.
    pub(super) fn slides(&self) -> bool {
        self.form != ShearForm::None
    }

    /// Tables that it shares with other fields.
    pub(super) fn tables(&self) -> &Arc<Tables> {
        &self.tables
    }

    /// Amplitudes of the grid's waves in the half-space.
    pub(super) fn interiors(&self) -> &Interiors {
        &self.interiors
    }

    /// Whether heat enters the body.
    pub(super) fn is_heated(&self) -> bool {
        self.thermal.is_some()
    }

    /// Whether its stresses stand for the strains, see [`Self::hookean`].
    pub(super) fn stands_for_strains(&self) -> bool {
        matches!(self.interiors, Interiors::Passed(_, Meaning::Strains))
    }

    /// Contact spots and the open regions between them.
    pub(super) fn regions(&self) -> &Regions {
        &self.regions
    }

    /// The discs of a given pressure under the load; none of any other.
    pub(super) fn discs(&self) -> &[LoadedDisc] {
        &self.discs
    }

    /// Poisson's ratio ν of a material, from 1.
    pub(super) fn poisson(&self, material: usize) -> f64 {
        self.half_space.material(material).poisson()
    }

    /// Number of materials.
    pub(super) fn materials(&self) -> usize {
        self.half_space.material_count()
    }

    /// The grid of the pressure.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The grid of the series.
    pub(super) fn series_grid(&self) -> &Arc<Grid> {
        &self.series_grid
    }

    /// Difference of the free and the periodic field at a depth; `None` where the system is periodic.
    pub(super) fn far(&self, depth: Depth) -> Option<FarPlane<9>> {
        self.far.as_ref().map(|far| far.plane(depth))
    }

    /// Prepares what some depths need, all threads at once.
    pub(super) fn read_ahead(&self, depths: impl Iterator<Item = Depth>) {
        if let Some(far) = &self.far {
            far.read_ahead(depths);
        }
    }

    /// Wavenumbers of the shells with qz up to `reach` at a depth.
    pub(super) fn wavenumbers_within(&self, depth: Depth, reach: f64) -> &[f64] {
        let waves = &self.series.waves;
        &waves.wavenumbers()[..waves.shells_up_to(reach / depth.z.max(f64::MIN_POSITIVE))]
    }

    /// Distance between neighbouring samples, a length: across lines along which nothing changes, where there are any.
    pub(super) fn spacing(&self) -> f64 {
        self.across_lines.unwrap_or_else(|| self.series_grid.spacing())
    }

    /// Least wavenumber that the samples do not hold, 1/length: across lines along which nothing changes, where there are any.
    pub(super) fn least_aliased(&self) -> f64 {
        self.across_lines.map_or_else(|| self.series_grid.least_aliased(), |spacing| PI / spacing)
    }

    /// Whether a depth lies below what is near the surface, where the waves of discs are summed as they are.
    pub(super) fn is_deep(&self, depth: Depth) -> bool {
        depth.z >= SHALLOW * self.spacing()
    }

    /// Response at a depth of the waves with qz up to `reach`.
    pub(super) fn depth_response(&self, depth: Depth, reach: f64) -> DepthResponse {
        let (wavenumbers, mean) = (self.wavenumbers_within(depth, reach), self.mean(depth));
        let response = match &self.interiors {
            Interiors::Resting(table) => DepthResponse::new(table, depth, wavenumbers, self.form, mean),
            Interiors::Passed(passed, of) => DepthResponse::passed((passed, *of), depth, wavenumbers, self.form, mean),
        };
        let thermal = self.thermal.as_ref().map(|thermal| thermal.at(wavenumbers.len(), depth));
        response.heated(thermal).in_field(self.is_deep(depth), self.far.as_ref().map(|far| far.plane(depth)))
    }

    /// State under the mean pressure at a depth.
    pub(super) fn mean(&self, depth: Depth) -> StressState {
        let (mut state, slope) = self.mean[depth.material - 1];
        let below = depth.z - self.half_space.faces(depth.material).0;
        state.displacement.iter_mut().zip(slope).for_each(|(u, slope)| *u += slope * below);
        state
    }

    /// States at the points (x, y) of one depth, lengths, by the exact sum over the waves; not a number beyond the window of an
    /// isolated contact.
    ///
    /// # Panics
    /// When the depth names a material that does not exist.
    pub fn points(&self, depth: Depth, points: &[[f64; 2]]) -> Vec<StressState> {
        let states = self.at(points, &self.depth_response(depth, REACH)).into_iter().zip(points);
        states.map(|(state, &place)| self.where_it_holds(place, StressState::from_components(state))).collect()
    }

    /// The `state` found at a place; not a number beyond the window of an isolated contact, where the series is that of its images.
    pub(super) fn where_it_holds(&self, place: [f64; 2], state: StressState) -> StressState {
        if self.grid.cell().contains(place) { state } else { StressState::from_components([f64::NAN; 9]) }
    }

    /// Components of a response at the points (x, y), lengths.
    pub(super) fn at<const K: usize>(&self, places: &[[f64; 2]], response: &impl Response<K>) -> Vec<[f64; K]> {
        let fractions: Vec<[f64; 2]> = places.iter().map(|&place| self.series_grid.cell().fractions(place)).collect();
        self.series.at(&fractions, response)
    }
}

impl fmt::Display for StressField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "stress field of {} plane waves in {} shells, {} materials, {}",
            self.series.waves.shells().len(),
            self.series.waves.wavenumbers().len(),
            self.materials(),
            self.load
        )
    }
}

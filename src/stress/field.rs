//! The stress field under a solved contact, and its states at points.

use super::regions::Regions;
use super::series::{Response, Series};
use super::slice::Slice;
use super::tensor::State;
use crate::body::{Depth, HalfSpace, InPlane, Interface, MeanStress, TransferFunction};
use crate::lattice::{Grid, NotOnGrid};
use crate::numeric::number::number;
use crate::spectral::Contact;
use ndarray::ArrayView2;
use rayon::prelude::*;
use std::fmt;
use std::sync::Arc;

/// Largest qz of a wave that still counts: its stresses are below (1 + qz)e^{−qz} of the pressure, 10⁻¹⁶.
pub(super) const REACH: f64 = 41.0;

/// The stress field of one load step.
#[derive(Debug)]
pub struct StressField {
    pub(super) series: Series,
    grid: Arc<Grid>,
    half_space: HalfSpace,
    transfer: TransferFunction,
    /// State under the mean pressure at the upper face of each material, and the slope of u_z there.
    mean: Vec<(State, f64)>,
    mean_stress: MeanStress,
    regions: Regions,
}

impl StressField {
    /// Under a solved contact.
    pub fn new(contact: &Contact, mean: MeanStress) -> Self {
        Self::of_samples(contact.grid(), contact.pressures(), contact.problem().half_space(), mean)
    }

    /// Under any `pressure` on a `half_space`; axes along a₁ and a₂.
    ///
    /// # Errors
    /// [`NotOnGrid`] unless the pressure has one value per sample of the grid.
    pub fn under(
        grid: &Arc<Grid>,
        pressure: ArrayView2<'_, f64>,
        half_space: &HalfSpace,
        mean: MeanStress,
    ) -> Result<Self, NotOnGrid> {
        grid.check(pressure.dim().into())?;
        let samples: Vec<f64> = pressure.iter().copied().collect();
        Ok(Self::of_samples(grid, &samples, half_space, mean))
    }

    fn of_samples(grid: &Arc<Grid>, pressure: &[f64], half_space: &HalfSpace, mean: MeanStress) -> Self {
        let series = Series::new(grid, pressure);
        Self {
            grid: Arc::clone(grid),
            half_space: half_space.clone(),
            transfer: TransferFunction::new(half_space),
            mean: mean_states(half_space, mean, series.mean),
            mean_stress: mean,
            regions: Regions::new(grid, pressure),
            series,
        }
    }

    /// What it lies in.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// Poisson's ratio ν of the material at the surface.
    pub fn surface_poisson(&self) -> f64 {
        self.half_space.surface_material().poisson()
    }

    /// What the mean lateral stress is.
    pub fn mean_stress(&self) -> MeanStress {
        self.mean_stress
    }

    /// Contact spots and what is open between them.
    pub(super) fn regions(&self) -> &Regions {
        &self.regions
    }

    /// Number of materials, layers + 1.
    pub(super) fn materials(&self) -> usize {
        self.half_space.layers().len() + 1
    }

    /// The grid of the pressure.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// What the waves with qz up to `reach` cause at a depth.
    pub(super) fn slice(&self, depth: Depth, reach: f64) -> Slice {
        let waves = &self.series.waves;
        let count = waves.shells_up_to(reach / depth.z.max(f64::MIN_POSITIVE));
        let amplitude = |&q: &f64| self.transfer.amplitudes(InPlane::Normal, q, depth);
        let wavenumbers = &waves.wavenumbers()[..count];
        let amplitudes = wavenumbers.par_iter().with_min_len(512).map(amplitude).collect();
        Slice { amplitudes, lengths: wavenumbers.iter().map(|q| 1.0 / q).collect(), mean: self.mean(depth) }
    }

    /// The state that the mean pressure causes at a depth.
    pub(super) fn mean(&self, depth: Depth) -> State {
        let (mut state, slope) = self.mean[depth.material - 1];
        state.displacement[2] += slope * (depth.z - self.half_space.faces(depth.material).0);
        state
    }

    /// States at the points (x, y), lengths, of one depth: the sum over waves itself.
    ///
    /// # Panics
    /// When the depth is in a material that is not there.
    pub fn points(&self, depth: Depth, points: &[[f64; 2]]) -> Vec<State> {
        let states = self.at(points, &self.slice(depth, REACH));
        states.into_iter().map(State::from_components).collect()
    }

    /// Components at places (x, y), lengths.
    pub(super) fn at<const K: usize>(&self, places: &[[f64; 2]], response: &impl Response<K>) -> Vec<[f64; K]> {
        let fractions: Vec<[f64; 2]> = places.iter().map(|&place| self.grid.cell().fractions(place)).collect();
        self.series.at(&fractions, response)
    }
}

impl fmt::Display for StressField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "stress field of {} plane waves in {} shells, {} materials, mean pressure {}",
            self.series.coefficients.len(),
            self.series.waves.wavenumbers().len(),
            self.materials(),
            number(self.series.mean)
        )
    }
}

/// State at the upper face of each material under the mean pressure, and the slope of u_z in it.
///
/// u_z is measured from the mean plane of the deformed surface; lateral displacements under a lateral mean strain are
/// left out.
fn mean_states(half_space: &HalfSpace, mean: MeanStress, pressure: f64) -> Vec<(State, f64)> {
    let mut uz = 0.0;
    let mut states = Vec::new();
    for (index, (material, lateral)) in half_space.materials().zip(mean.lateral(half_space)).enumerate() {
        let lateral = pressure * lateral;
        let slope = (-pressure - 2.0 * material.poisson() * lateral) / material.young();
        let state = State { xx: lateral, yy: lateral, zz: -pressure, displacement: [0.0, 0.0, uz], ..State::default() };
        states.push((state, slope));
        if let Some(layer) = half_space.layers().get(index) {
            uz += slope * layer.thickness();
            if let Interface::Spring { normal, .. } = layer.interface() {
                uz -= pressure / normal;
            }
        }
    }
    states
}

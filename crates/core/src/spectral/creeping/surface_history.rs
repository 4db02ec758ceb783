//! History of the pressure on a grid of a periodic cell: the operator of an interval of time, and what is displaced without it.
//!
//! All waves of one wavenumber, a shell, have the same [modes](crate::creep::RetardationModes). The mean displacement of half-spaces is infinite
//! and left out; that of layers on a rigid base creeps with modes of its own.

use crate::creep::{History, Interval, Retardation};
use crate::lattice::Grid;
use crate::lattice::waves::WAVENUMBER_TOLERANCE;
use crate::numeric::array::view;
use crate::numeric::fourier::field::{components, field};
use crate::spectral::LayeredOperator;
use crate::spectral::transforms::Transforms;
use ndarray::Array2;
use rustfft::num_complex::Complex64;
use std::sync::Arc;

/// History of the pressure on a grid. A copy shares all that does not change in time.
#[derive(Debug, Clone)]
pub struct SurfaceHistory {
    grid: Arc<Grid>,
    transforms: Arc<Transforms>,
    /// Shell of each Fourier component (k₁, k₂), 0 ≤ k₂ ≤ N₂/2, k₂ fastest. Shells ascend with the wavenumber; the mean is one behind them.
    shells: Arc<[u32]>,
    /// Number of the shells without the mean.
    waves: usize,
    history: History,
}

impl SurfaceHistory {
    /// History without pressure, on a grid of bodies.
    pub fn new(grid: &Arc<Grid>, retardation: &Retardation<'_>) -> Self {
        let (shells, wavenumbers) = shells(grid);
        let mut modes = retardation.modes_of(&wavenumbers);
        modes.push(retardation.mean_modes());
        let (shells, waves): (Arc<[u32]>, _) = (shells.into(), wavenumbers.len());
        let history = History::new(&modes, Arc::clone(&shells));
        Self { grid: Arc::clone(grid), transforms: Arc::new(Transforms::new(grid.points())), shells, waves, history }
    }

    /// An interval of a duration Δt ≥ 0, a time: 0 for a jump of the load.
    pub fn interval(&self, duration: f64) -> Interval {
        self.history.interval(duration)
    }

    /// Operator of the pressure at the end of an interval.
    pub fn operator(&self, interval: &Interval) -> LayeredOperator {
        let compliances = self.history.compliances(interval);
        let (mean, unit) = (compliances[self.waves], compliances.first().copied().unwrap_or(1.0));
        let half = self.grid.points()[1] / 2 + 1;
        let multiplier = self.transforms.double.multiplier(self.grid.cell().is_rectangular(), |[k1, k2], values| {
            let shells = &self.shells[k1 * half + k2..];
            values.iter_mut().zip(shells).for_each(|(value, shell)| *value = compliances[*shell as usize]);
            // Where displacements have zero mean the inverse takes the mean for a component of the least wavenumber.
            if [k1, k2] == [0, 0] && mean == 0.0 {
                values[0] = unit;
            }
        });
        let multiplier = if mean == 0.0 { multiplier.dropping_mean() } else { multiplier };
        LayeredOperator::of(Transforms::clone(&self.transforms), multiplier, unit).with_mean(mean)
    }

    /// Displacement at the end of an interval beside that of the pressure there, lengths sample by sample, a₂ fastest.
    pub fn known(&self, interval: &Interval) -> Vec<f64> {
        self.samples(self.history.known(interval))
    }

    /// Goes to the end of an interval, where the pressure has these values, sample by sample, a₂ fastest.
    pub fn advance(&mut self, interval: &Interval, pressure: &[f64]) {
        let components = components(view(self.grid.points(), pressure));
        self.history.advance(interval, &components.into_raw_vec_and_offset().0);
    }

    /// Energy that the bodies store at the present time, of one cell: a pressure times a cubed length.
    pub fn stored(&self) -> f64 {
        let (n2, stored) = (self.grid.points()[1], self.history.stored());
        let half = n2 / 2 + 1;
        // Components that are not in the list are conjugates of some that are.
        let count = |index: usize| if index.is_multiple_of(half) || 2 * (index % half) == n2 { 1.0 } else { 2.0 };
        let sum: f64 = stored.iter().enumerate().map(|(index, stored)| count(index) * stored).sum();
        sum * self.grid.cell().area()
    }

    /// Samples of a field with some components.
    fn samples(&self, components: Vec<Complex64>) -> Vec<f64> {
        let [n1, n2] = self.grid.points();
        let components = Array2::from_shape_vec((n1, n2 / 2 + 1), components).expect("one of each component");
        field(components, n2).into_raw_vec_and_offset().0
    }
}

/// Shell of each Fourier component (k₁, k₂), 0 ≤ k₂ ≤ N₂/2, k₂ fastest, and the wavenumbers of the shells, ascending, 1/length. The mean is one
/// behind them.
fn shells(grid: &Grid) -> (Vec<u32>, Vec<f64>) {
    let [n1, n2] = grid.points();
    let half = n2 / 2 + 1;
    let mut all = vec![0.0; n1 * half];
    all.chunks_exact_mut(half).enumerate().for_each(|(k1, row)| grid.wavenumbers([k1, 0], row));
    let mut order: Vec<u32> = (1..all.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| all[a as usize].total_cmp(&all[b as usize]));
    let (mut shells, mut wavenumbers) = (vec![0; all.len()], Vec::<f64>::new());
    for component in order {
        let wavenumber = all[component as usize];
        if wavenumbers.last().is_none_or(|last| wavenumber > last * (1.0 + WAVENUMBER_TOLERANCE)) {
            wavenumbers.push(wavenumber);
        }
        shells[component as usize] = wavenumbers.len() as u32 - 1;
    }
    shells[0] = wavenumbers.len() as u32;
    (shells, wavenumbers)
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Bodies, HalfSpace, Interface, Layer, Material, Relaxation};
    use crate::lattice::Cell;
    use crate::spectral::Workspace;

    /// After a long hold what is known and what the pressure displaces add up to the relaxed displacement, whose work is stored: odd
    /// and even numbers of samples of oblique and square cells, with and without a rigid base.
    #[test]
    fn a_held_pressure_displaces_as_the_relaxed_bodies_in_the_end() {
        let relaxation = Relaxation::new(&[2.0, 5.0], &[1.0, 30.0]).unwrap();
        let soft = Material::from_shear(1.0, 0.45).unwrap().with_relaxation(Some(relaxation));
        let layer = Layer::new(soft, 0.2, Interface::Bonded).unwrap();
        let half_space = HalfSpace::new(vec![layer], Material::from_shear(3.0, 0.3).unwrap());
        let bodies = [half_space, HalfSpace::on_rigid_base(vec![layer]).unwrap()].map(Bodies::from);
        let cells = [Cell::new([1.0, 0.1], [0.3, 0.8]).unwrap(), Cell::square(1.0).unwrap()];
        for (cell, points) in
            cells.into_iter().flat_map(|cell| [[15, 9], [12, 10], [7, 8]].map(|points| (cell, points)))
        {
            let grid = Arc::new(Grid::new(cell, points).unwrap());
            let pressure: Vec<f64> = (0..grid.len()).map(|k| ((k * k * 7 + 3 * k) % 11) as f64).collect();
            for bodies in &bodies {
                let mut history = SurfaceHistory::new(&grid, &Retardation::new(bodies));
                let mut relaxed = pressure.clone();
                LayeredOperator::new(&grid, bodies.clone()).displacement(&mut relaxed, &mut Workspace::default());
                history.advance(&history.interval(0.0), &pressure);
                history.advance(&history.interval(1e4), &pressure);
                let interval = history.interval(2.0);
                let mut found = pressure.clone();
                history.operator(&interval).displacement(&mut found, &mut Workspace::default());
                let known = history.known(&interval);
                let largest = relaxed.iter().fold(0.0, |most: f64, w| most.max(w.abs()));
                for ((found, known), relaxed) in found.iter().zip(known).zip(&relaxed) {
                    assert!((found + known - relaxed).abs() < 1e-9 * largest, "{points:?} {cell}, {bodies}");
                }
                let work: f64 = pressure.iter().zip(&relaxed).map(|(p, w)| 0.5 * p * w * grid.sample_area()).sum();
                assert!((history.stored() / work - 1.0).abs() < 1e-9, "{points:?} {cell}, {bodies}");
            }
        }
    }
}

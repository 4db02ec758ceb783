//! The stress field under a solved contact: planes and points.

use super::regions::Regions;
use super::spectrum::{Spectrum, Wave};
use super::tensor::State;
use crate::body::{Amplitudes, Depth, HalfSpace, Interface, Interior, MeanStress, TransferFunction};
use crate::lattice::{Grid, NotOnGrid};
use crate::numeric::array::field;
use crate::numeric::number::number;
use crate::numeric::sums;
use crate::spectral::Contact;
use crate::spectral::fourier::Fourier;
use ndarray::{Array2, Array3, ArrayView2};
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::fmt;
use std::sync::Arc;

/// Largest qz of a wave that still counts: its stresses are below e^{−60} of the pressure.
pub(super) const REACH: f64 = 60.0;

/// The stress field of one load step.
#[derive(Debug)]
pub struct StressField {
    pub(super) spectrum: Spectrum,
    grid: Arc<Grid>,
    half_space: HalfSpace,
    transfer: TransferFunction,
    /// State under the mean pressure at the upper face of each material, and the slope of u_z there.
    mean: Vec<(State, f64)>,
    mean_stress: MeanStress,
    pub(super) regions: Regions,
}

/// The states on a plane of constant depth.
#[derive(Debug, Clone)]
pub struct Plane {
    /// Where.
    pub depth: Depth,
    /// Axis 0: xx, yy, zz, xy, xz, yz, then u_x, u_y, u_z; axes 1 and 2 along a₁ and a₂.
    pub components: Array3<f64>,
}

impl Plane {
    /// Samples [n₁, n₂] along a₁ and a₂.
    pub fn points(&self) -> [usize; 2] {
        let (_, n1, n2) = self.components.dim();
        [n1, n2]
    }

    /// The state at the sample [i, j].
    pub fn state(&self, [i, j]: [usize; 2]) -> State {
        State::from_components(std::array::from_fn(|c| self.components[[c, i, j]]))
    }

    /// The states of all samples, axes along a₁ and a₂.
    pub fn states(&self) -> Array2<State> {
        Array2::from_shape_fn(self.points(), |(i, j)| self.state([i, j]))
    }
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
        let spectrum = Spectrum::new(grid, pressure);
        Self {
            grid: Arc::clone(grid),
            half_space: half_space.clone(),
            transfer: TransferFunction::new(half_space),
            mean: mean_states(half_space, mean, spectrum.mean),
            mean_stress: mean,
            regions: Regions::new(grid, pressure),
            spectrum,
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

    /// Number of materials, layers + 1.
    pub(super) fn materials(&self) -> usize {
        self.half_space.layers().len() + 1
    }

    /// The grid of the pressure.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// Amplitudes of the shells with qz up to `reach`; the waves of all of them come first.
    pub(super) fn amplitudes(&self, depth: Depth, reach: f64) -> Vec<Amplitudes> {
        let count = self.spectrum.shells_up_to(reach / depth.z.max(f64::MIN_POSITIVE));
        self.spectrum.shells[..count]
            .par_iter()
            .with_min_len(256)
            .map(|&q| Interior::new(&self.transfer, q).at(depth))
            .collect()
    }

    /// The waves of the first `shells` shells.
    pub(super) fn waves(&self, shells: usize) -> &[Wave] {
        &self.spectrum.waves[..self.spectrum.starts[shells]]
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
        self.points_within(depth, points, REACH)
    }

    /// States at points of one depth from the waves with qz up to `reach`.
    pub(super) fn points_within(&self, depth: Depth, points: &[[f64; 2]], reach: f64) -> Vec<State> {
        let amplitudes = self.amplitudes(depth, reach);
        let waves = self.waves(amplitudes.len());
        let mean = self.mean(depth).components();
        let at = |&place: &[f64; 2]| {
            let sum = sums::of(waves.len(), |i| {
                let wave = &waves[i];
                components(wave, &amplitudes[wave.shell as usize], wave.at(place)).map(|term| term.re)
            });
            State::from_components(std::array::from_fn(|c| mean[c] + sum[c]))
        };
        points.iter().map(at).collect()
    }

    /// States on the whole plane, at [n₁, n₂] `points` of the cell, which need not be those of the pressure's grid.
    ///
    /// # Panics
    /// When a number of points is zero, or the depth in a material that is not there.
    pub fn plane(&self, depth: Depth, points: [usize; 2]) -> Plane {
        self.plane_within(depth, points, REACH)
    }

    /// States on the whole plane from the waves with qz up to `reach`.
    pub(super) fn plane_within(&self, depth: Depth, points: [usize; 2], reach: f64) -> Plane {
        let amplitudes = self.amplitudes(depth, reach);
        let waves = self.waves(amplitudes.len());
        let mean = self.mean(depth).components();
        let fourier = Fourier::new(points);
        let mut all = Array3::zeros([mean.len(), points[0], points[1]]);
        for (c, mut component) in all.outer_iter_mut().enumerate() {
            let value = |wave: &Wave| components(wave, &amplitudes[wave.shell as usize], wave.coefficient)[c];
            component.assign(&field(points, self.synthesised(&fourier, waves, mean[c], value)));
        }
        Plane { depth, components: all }
    }

    /// mean + Re Σ value(wave) e^{iq·x} at the points of the cell that the transform is planned for, a₂ fastest: exact
    /// there, however few they are, as waves that look alike at the points add up.
    pub(super) fn synthesised(
        &self,
        fourier: &Fourier,
        waves: &[Wave],
        mean: f64,
        value: impl Fn(&Wave) -> Complex64,
    ) -> Vec<f64> {
        let points = fourier.points();
        let [n1, n2] = points.map(|n| n as i32);
        let place = |[k1, k2]: [i32; 2]| {
            let (k1, k2) = (k1.rem_euclid(n1), k2.rem_euclid(n2));
            (2 * k2 <= n2).then_some((k2 * n1 + k1) as usize)
        };
        let mut spectrum = vec![Complex64::default(); (points[1] / 2 + 1) * points[0]];
        for wave in waves {
            let half = 0.5 * value(wave);
            // Re C e^{iq·x} is half the wave and half its conjugate.
            if let Some(index) = place(wave.index) {
                spectrum[index] += half;
            }
            if let Some(index) = place(wave.index.map(|k| -k)) {
                spectrum[index] += half.conj();
            }
        }
        spectrum[0] += mean;
        fourier.synthesise(spectrum)
    }
}

impl fmt::Display for StressField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "stress field of {} plane waves in {} shells, {} materials, mean pressure {}",
            self.spectrum.waves.len(),
            self.spectrum.shells.len(),
            self.materials(),
            number(self.spectrum.mean)
        )
    }
}

/// xx, yy, zz, xy, xz, yz, u_x, u_y, u_z of a wave whose pressure is the real part of `value`.
pub(super) fn components(wave: &Wave, amplitudes: &Amplitudes, value: Complex64) -> [Complex64; 9] {
    let [x, y] = wave.q;
    let square = x * x + y * y;
    let (xx, yy, xy) = (x * x / square, y * y / square, x * y / square);
    let length = square.sqrt();
    let (nx, ny) = (x / length, y / length);
    let Amplitudes { szz, sqz, sqq, stt, uz, uq } = *amplitudes;
    let quarter = Complex64::new(value.im, -value.re);
    [
        value * (xx * sqq + yy * stt),
        value * (yy * sqq + xx * stt),
        value * szz,
        value * (xy * (sqq - stt)),
        quarter * (nx * sqz),
        quarter * (ny * sqz),
        quarter * (nx * uq),
        quarter * (ny * uq),
        value * uz,
    ]
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

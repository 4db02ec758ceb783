//! The stress field under a solved contact: planes and points.

use super::mean::MeanStress;
use super::spectrum::{Spectrum, Wave};
use super::spots::Spots;
use super::tensor::State;
use crate::fourier::Fourier;
use crate::grid::Grid;
use crate::layered::{Amplitudes, Interior, TransferFunction};
use crate::material::{HalfSpace, Interface};
use crate::number::number;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use std::fmt;

/// Largest qz of a wave that still counts: its stresses are below e^{−60} of the pressure.
pub(super) const REACH: f64 = 60.0;
/// Waves summed at a time; fixed, so that sums do not depend on the number of threads.
pub(super) const BLOCK: usize = 4096;

/// A depth in one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth {
    /// Depth z ≥ 0 below the surface, a length.
    pub z: f64,
    /// Material, from 1; the substrate is layers + 1.
    pub side: usize,
}

/// The stress field of one load step.
#[derive(Debug)]
pub struct Field {
    pub(super) spectrum: Spectrum,
    grid: Grid,
    half_space: HalfSpace,
    transfer: TransferFunction,
    /// Depths of the upper faces of all materials.
    tops: Vec<f64>,
    /// State under the mean pressure at the upper face of each material, and the slope of u_z there.
    mean: Vec<(State, f64)>,
    mean_stress: MeanStress,
    pub(super) spots: Spots,
}

/// The states on a plane of constant depth.
#[derive(Debug, Clone)]
pub struct Plane {
    /// Where.
    pub depth: Depth,
    /// Samples [n₁, n₂] along a₁ and a₂.
    pub points: [usize; 2],
    /// xx, yy, zz, xy, xz, yz, then u_x, u_y, u_z: one value per sample each, a₂ fastest.
    pub components: [Vec<f64>; 9],
}

impl Plane {
    /// The state at the sample `index`.
    pub fn state(&self, index: usize) -> State {
        State::from_components(self.components.each_ref().map(|component| component[index]))
    }
}

impl Field {
    /// Field under `pressure` (one value per sample of `grid`) on `half_space`.
    pub fn new(grid: &Grid, pressure: &[f64], half_space: &HalfSpace, mean: MeanStress) -> Self {
        let spectrum = Spectrum::new(grid, pressure);
        let faces = half_space.interface_depths();
        let tops = std::iter::once(0.0).chain(faces).collect();
        let states = mean_states(half_space, mean, spectrum.mean);
        Self {
            spectrum,
            grid: grid.clone(),
            half_space: half_space.clone(),
            transfer: TransferFunction::new(half_space),
            tops,
            mean: states,
            mean_stress: mean,
            spots: Spots::new(grid, pressure),
        }
    }

    /// The field under another pressure, on the same half-space.
    pub fn under(&self, grid: &Grid, pressure: &[f64]) -> Self {
        Self::new(grid, pressure, &self.half_space, self.mean_stress)
    }

    /// Poisson's ratio ν of the material at the surface.
    pub fn surface_poisson(&self) -> f64 {
        self.half_space.surface_material().poisson()
    }

    /// The depth `z` in its material, or, on an interface, in both: above, then below.
    pub fn depths(&self, z: f64) -> Vec<Depth> {
        self.half_space.sides(z).map(|side| Depth { z, side }).collect()
    }

    /// Depth of the upper face of material `side`, and of its lower face (infinite for the substrate).
    pub fn faces(&self, side: usize) -> (f64, f64) {
        (self.tops[side - 1], self.tops.get(side).copied().unwrap_or(f64::INFINITY))
    }

    /// Number of materials, layers + 1.
    pub fn materials(&self) -> usize {
        self.tops.len()
    }

    /// The grid of the pressure.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Amplitudes of the shells with qz up to `reach`; the waves of all of them come first.
    pub(super) fn amplitudes(&self, depth: Depth, reach: f64) -> Vec<Amplitudes> {
        let count = self.spectrum.shells_up_to(reach / depth.z.max(f64::MIN_POSITIVE));
        let below = depth.z - self.tops[depth.side - 1];
        self.spectrum.shells[..count]
            .par_iter()
            .with_min_len(256)
            .map(|&q| Interior::new(&self.transfer, q).at(depth.side, below.max(0.0)))
            .collect()
    }

    /// The waves of the first `shells` shells.
    pub(super) fn waves(&self, shells: usize) -> &[Wave] {
        &self.spectrum.waves[..self.spectrum.starts[shells]]
    }

    /// The state that the mean pressure causes at a depth.
    pub(super) fn mean(&self, depth: Depth) -> State {
        let (mut state, slope) = self.mean[depth.side - 1];
        state.displacement[2] += slope * (depth.z - self.tops[depth.side - 1]);
        state
    }

    /// States at the points (x, y) of one depth: the sum over waves itself.
    pub fn points(&self, depth: Depth, points: &[[f64; 2]]) -> Vec<State> {
        self.points_within(depth, points, REACH)
    }

    /// States at points of one depth from the waves with qz up to `reach`.
    pub(super) fn points_within(&self, depth: Depth, points: &[[f64; 2]], reach: f64) -> Vec<State> {
        let amplitudes = self.amplitudes(depth, reach);
        let waves = self.waves(amplitudes.len());
        let mean = self.mean(depth);
        points
            .iter()
            .map(|&[x, y]| {
                let blocks: Vec<[f64; 9]> = waves
                    .par_chunks(BLOCK)
                    .map(|block| {
                        let mut sum = [0.0; 9];
                        for wave in block {
                            let value = wave.coefficient * Complex64::cis(wave.q[0] * x + wave.q[1] * y);
                            let terms = components(wave, &amplitudes[wave.shell as usize], value);
                            sum.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term.re);
                        }
                        sum
                    })
                    .collect();
                let mut total = mean.components();
                for block in blocks {
                    total.iter_mut().zip(block).for_each(|(total, part)| *total += part);
                }
                State::from_components(total)
            })
            .collect()
    }

    /// States on the whole plane, on [n₁, n₂] `points` of the cell; waves that a grid coarser than the pressure's
    /// cannot hold are left out.
    pub fn plane(&self, depth: Depth, points: [usize; 2]) -> Plane {
        let amplitudes = self.amplitudes(depth, REACH);
        let coarser = points != self.grid.points();
        let waves: Vec<&Wave> = self
            .waves(amplitudes.len())
            .iter()
            .filter(|wave| !coarser || (0..2).all(|k| 2 * wave.index[k].unsigned_abs() < points[k] as u32))
            .collect();
        let mean = self.mean(depth).components();
        let component = |c: usize| {
            let value = |wave: &Wave| components(wave, &amplitudes[wave.shell as usize], wave.coefficient)[c];
            self.synthesised(&waves, points, mean[c], value)
        };
        Plane { depth, points, components: std::array::from_fn(component) }
    }

    /// mean + Re Σ value(wave) e^{iq·x} at [n₁, n₂] `points` of the cell, a₂ fastest.
    pub(super) fn synthesised(
        &self,
        waves: &[&Wave],
        points: [usize; 2],
        mean: f64,
        value: impl Fn(&Wave) -> Complex64,
    ) -> Vec<f64> {
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
        Fourier::new(points).synthesise(spectrum)
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
    let materials = half_space.layers().iter().map(|layer| layer.material()).chain([half_space.substrate()]);
    let mut uz = 0.0;
    let mut states = Vec::new();
    for (index, (material, lateral)) in materials.zip(mean.lateral(half_space)).enumerate() {
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

impl fmt::Display for Field {
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

//! Vertical sections and lines, without whole-plane transforms.
//!
//! On a line **x** = **x**₀ + s**d** a wave c e^{i**q**·**x**} is c e^{i**q**·**x**₀} e^{iκs} with κ = **q**·**d**.
//! Waves with the same κ are added up first, depth by depth: along a lattice direction N² waves collapse onto a few N
//! wavenumbers κ. Along a direction that is incommensurate with the lattice nothing collapses: each wave is a sum of
//! its own, and a section takes longer.
//!
//! On the surface the stresses are those of [`super::surface`]: a line meets edges between the samples, where the series
//! itself overshoots. Just below it, where the series still does, stresses are interpolated in depth.

use super::field::{REACH, StressField, components};
use super::spectrum::Wave;
use super::surface::{OPEN, Skin};
use super::tensor::State;
use crate::body::Depth;
use crate::numeric::array::field;
use ndarray::Array2;
use rayon::prelude::*;
use rustfft::num_complex::Complex64;

/// Equally spaced points on a straight line along the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where s = 0, lengths.
    pub origin: [f64; 2],
    /// Direction along which s grows; any length, s is a length.
    pub direction: [f64; 2],
    /// First and last s, lengths.
    pub span: [f64; 2],
    /// Number of points, both ends counted.
    pub points: usize,
}

impl Line {
    /// Values of s.
    pub fn distances(&self) -> Vec<f64> {
        (0..self.points).map(|i| self.span[0] + i as f64 * self.step()).collect()
    }

    /// Places (x, y) of the points.
    pub fn places(&self) -> Vec<[f64; 2]> {
        let unit = self.unit();
        self.distances().into_iter().map(|s| [0, 1].map(|k| self.origin[k] + s * unit[k])).collect()
    }

    /// The first and the last place.
    pub fn ends(&self) -> [[f64; 2]; 2] {
        self.span.map(|s| [0, 1].map(|k| self.origin[k] + s * self.unit()[k]))
    }

    fn step(&self) -> f64 {
        (self.span[1] - self.span[0]) / (self.points.max(2) - 1) as f64
    }

    fn unit(&self) -> [f64; 2] {
        let length = self.direction[0].hypot(self.direction[1]);
        self.direction.map(|x| x / length)
    }
}

/// Where fewer than this many waves share a wavenumber on average, none are added up: sums would take more memory than
/// the waves.
const FEW_SHARE: usize = 4;

/// The states on a vertical section.
#[derive(Debug, Clone)]
pub struct Section {
    /// The line on the surface.
    pub line: Line,
    /// Depths of its rows; one on an interface stands twice, once for each side.
    pub depths: Vec<Depth>,
    /// Axis 0: rows, as `depths`; axis 1: points of the line.
    pub states: Array2<State>,
    /// s on the surface where the normal stress along the line is largest, between the points, and that stress; `None`
    /// unless the first row is the surface.
    pub highest: Option<[f64; 2]>,
}

/// A field along a line: its waves by their wavenumbers there. Sections and the highest place are read off it.
#[derive(Debug)]
struct Trace<'a> {
    field: &'a StressField,
    line: Line,
    /// Wavenumbers κ along the line, ascending.
    wavenumbers: Vec<f64>,
    /// Per wave: index of its κ, and its coefficient at the origin of the line.
    waves: Vec<(u32, Complex64)>,
    /// The surface, where contact has edges.
    skin: Option<Skin<'a>>,
}

impl StressField {
    /// States on a vertical section: for each depth those at the points of the line.
    ///
    /// # Panics
    /// When a depth is in a material that is not there.
    pub fn section(&self, line: &Line, depths: &[Depth]) -> Section {
        let trace = Trace::new(self, *line);
        let rows = trace.rows(depths);
        let highest = rows.first().filter(|_| depths[0] == Depth::SURFACE).and_then(|surface| trace.highest(surface));
        let states = field([depths.len(), line.points], rows.into_iter().flatten().collect());
        Section { line: *line, depths: depths.to_vec(), states, highest }
    }

    /// Depth from which on the series needs no help: the least wavenumber that the grid cannot hold has fallen as far
    /// as smoothing makes it fall on the surface. Zero where contact has no edge; at most the thickness of the coating.
    fn shallow(&self) -> f64 {
        let depth = if self.regions.have_edges() { 0.5 * OPEN * OPEN / self.grid().least_aliased() } else { 0.0 };
        depth.min(self.half_space().faces(1).1)
    }
}

impl<'a> Trace<'a> {
    fn new(field: &'a StressField, line: Line) -> Self {
        let [dx, dy] = line.unit();
        let all = &field.spectrum.waves;
        let along: Vec<f64> = all.iter().map(|wave| wave.q[0] * dx + wave.q[1] * dy).collect();
        let mut order: Vec<u32> = (0..all.len() as u32).collect();
        order.par_sort_unstable_by(|&a, &b| along[a as usize].total_cmp(&along[b as usize]).then(a.cmp(&b)));
        // Equal up to rounding: a phase error of 1e-11 over a period.
        let tie = 1e-12 * field.spectrum.shells.last().copied().unwrap_or(0.0);
        let mut wavenumbers: Vec<f64> = Vec::new();
        let mut waves = vec![(0, Complex64::default()); all.len()];
        for number in order {
            let (wave, kappa) = (&all[number as usize], along[number as usize]);
            if wavenumbers.last().is_none_or(|last| kappa > last + tie) {
                wavenumbers.push(kappa);
            }
            waves[number as usize] = (wavenumbers.len() as u32 - 1, wave.at(line.origin));
        }
        let skin = field.regions.have_edges().then(|| Skin::new(field, 1.0));
        Self { field, line, wavenumbers, waves, skin }
    }

    /// States on the vertical section below the line: for each depth those at its points.
    fn rows(&self, depths: &[Depth]) -> Vec<Vec<State>> {
        let shallow = self.field.shallow();
        let between = |depth: &Depth| depth.material == 1 && depth.z > 0.0 && depth.z < shallow;
        let ends =
            depths.iter().any(between).then(|| [0.0, shallow].map(|z| self.row(&self.line, Depth { z, material: 1 })));
        let row = |depth: &Depth| {
            let own = self.row(&self.line, *depth);
            match &ends {
                Some([surface, below]) if between(depth) => {
                    let part = depth.z / shallow;
                    let pairs = surface.iter().zip(below).zip(own);
                    pairs.map(|((a, b), own)| State { displacement: own.displacement, ..a.toward(b, part) }).collect()
                }
                _ => own,
            }
        };
        depths.par_iter().map(row).collect()
    }

    /// Where on the surface the normal stress along the line is largest, between its points: s and the stress.
    /// `surface` holds the states at the points.
    fn highest(&self, surface: &[State]) -> Option<[f64; 2]> {
        let line = self.line;
        let stress = |state: &State| state.along(line.direction);
        let best = (0..surface.len()).max_by(|&a, &b| stress(&surface[a]).total_cmp(&stress(&surface[b])))?;
        let mut highest = [line.distances()[best], stress(&surface[best])];
        let mut half = line.step();
        // The stress drops at once at an edge: a search without slopes, to 1/512 of the distance of two points.
        for _ in 0..if self.skin.is_some() { 3 } else { 0 } {
            let [s, _] = highest;
            let span = [(s - half).max(line.span[0]), (s + half).min(line.span[1])];
            let finer = Line { span, points: 17, ..line };
            let states = self.row(&finer, Depth::SURFACE);
            for (s, state) in finer.distances().into_iter().zip(&states) {
                if stress(state) > highest[1] {
                    highest = [s, stress(state)];
                }
            }
            half /= 8.0;
        }
        Some(highest)
    }

    /// States at a depth, at the points of `line`: of the trace's own or a part of it.
    fn row(&self, line: &Line, depth: Depth) -> Vec<State> {
        let field = self.field;
        let amplitudes = field.amplitudes(depth, REACH);
        let waves = field.waves(amplitudes.len());
        let term = |wave: &Wave, value: Complex64| components(wave, &amplitudes[wave.shell as usize], value);
        let states = self.sums(line, waves, field.mean(depth).components(), term);
        let states = states.into_iter().map(State::from_components);
        let Some(skin) = self.skin.as_ref().filter(|_| depth.z == 0.0) else { return states.collect() };
        let smooth = self.sums(line, waves, skin.mean(), |wave, value| skin.terms(wave, value));
        let on_surface = smooth.iter().zip(states);
        on_surface.map(|(smooth, state)| State { displacement: state.displacement, ..skin.state(smooth) }).collect()
    }

    /// Sums over `waves` at the points of `line`; `term` gives the components of a wave whose pressure is the real part
    /// of the value.
    fn sums<const N: usize>(
        &self,
        line: &Line,
        waves: &[Wave],
        mean: [f64; N],
        term: impl Fn(&Wave, Complex64) -> [Complex64; N],
    ) -> Vec<[f64; N]> {
        let mut values = vec![mean; line.points];
        let step = line.step();
        let mut add = |kappa: f64, sum: &[Complex64; N]| {
            if sum.iter().all(|value| value.norm_sqr() == 0.0) {
                return;
            }
            let mut phase = Complex64::cis(kappa * line.span[0]);
            let turn = Complex64::cis(kappa * step);
            for value in &mut values {
                value.iter_mut().zip(sum).for_each(|(total, wave)| *total += wave.re * phase.re - wave.im * phase.im);
                phase *= turn;
            }
        };
        let terms = waves.iter().zip(&self.waves).map(|(wave, &(index, value))| (index as usize, term(wave, value)));
        if FEW_SHARE * self.wavenumbers.len() > self.waves.len() {
            terms.for_each(|(index, term)| add(self.wavenumbers[index], &term));
        } else {
            let mut sums = vec![[Complex64::default(); N]; self.wavenumbers.len()];
            for (index, term) in terms {
                sums[index].iter_mut().zip(term).for_each(|(sum, term)| *sum += term);
            }
            self.wavenumbers.iter().zip(&sums).for_each(|(&kappa, sum)| add(kappa, sum));
        }
        values
    }
}

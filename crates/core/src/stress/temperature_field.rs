//! Temperature at any depth below a contact that frictional heat enters.

use super::field::REACH;
use super::passed_shells::PassedShells;
use super::section::SurfaceLine;
use super::series::{Response, Series};
use super::trace::Trace;
use super::traction_waves::Wave;
use crate::body::{Depth, HalfSpace};
use crate::heat::{HeatedBody, TemperatureWave};
use crate::heating::HeatedBodies;
use crate::lattice::Grid;
use crate::numeric::parallel;
use crate::spectral::Contact;
use ndarray::Array2;
use rustfft::num_complex::Complex64;
use std::fmt;
use std::sync::Arc;

/// Fewest waves of a parallel task.
const MIN_PARALLEL: usize = 512;

/// Temperature in one body below a contact.
#[derive(Debug)]
pub struct TemperatureField {
    grid: Arc<Grid>,
    half_space: HalfSpace,
    series: Series,
    shells: PassedShells,
    /// Wave of each shell, of a component along the motion that is not below 0; the other waves have the conjugate.
    waves: Vec<TemperatureWave>,
    bulk: f64,
}

/// Temperature of each shell over its flux at a depth.
struct AtDepth<'a> {
    field: &'a TemperatureField,
    amplitudes: Vec<Complex64>,
}

impl Response<1> for AtDepth<'_> {
    fn shells(&self) -> usize {
        self.amplitudes.len()
    }

    #[inline(always)]
    fn times<W: Wave>(&self, q: [f64; 2], shell: usize, wave: W) -> [Complex64; 1] {
        let Complex64 { re, im } = self.amplitudes[shell];
        [wave.pressure() * Complex64::new(re, self.field.shells.sign(q) * im)]
    }

    fn mean(&self) -> [f64; 1] {
        [self.field.bulk]
    }
}

impl TemperatureField {
    /// Temperatures of the body and then of a counterbody that takes heat; none where nothing heats.
    pub fn of(contact: &Contact) -> Vec<Self> {
        let problem = contact.problem();
        let (Some(heat), Some(heating), Ok(bodies)) = (contact.heat(), problem.heating(), problem.heated_bodies())
        else {
            return Vec::new();
        };
        let [below, above] = heating.bulk();
        let of = |body: &HeatedBody, flux: &[f64], bulk: f64| Self::new(contact.grid(), body, flux, (bulk, &bodies));
        let counterbody = bodies.counterbody.as_ref().map(|body| of(body, &heat.flux_above(), above));
        std::iter::once(of(&bodies.body, &heat.flux, below)).chain(counterbody).collect()
    }

    fn new(grid: &Arc<Grid>, body: &HeatedBody, flux: &[f64], (bulk, bodies): (f64, &HeatedBodies)) -> Self {
        let moves = body.velocity() != 0.0;
        let shells = PassedShells::new(grid, moves.then(|| bodies.direction()));
        let waves = shells.map(|wavevector| body.temperature_wave(wavevector));
        let series = Series::new(grid, flux).in_shells_of(shells.waves());
        let (grid, half_space) = (Arc::clone(grid), body.half_space().clone());
        Self { grid, half_space, series, shells, waves, bulk }
    }

    /// The body.
    pub fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// Temperatures at points (x, y), lengths, of a depth.
    ///
    /// # Panics
    /// When the depth names a material that does not exist.
    pub fn points(&self, depth: Depth, points: &[[f64; 2]]) -> Vec<f64> {
        let fractions: Vec<[f64; 2]> = points.iter().map(|&place| self.grid.cell().fractions(place)).collect();
        self.series.at(&fractions, &self.at(depth)).into_iter().map(|[temperature]| temperature).collect()
    }

    /// Temperatures in a vertical section, depths down axis 0 and along the line on axis 1.
    ///
    /// # Panics
    /// When a depth names a material that does not exist.
    pub fn section(&self, line: &SurfaceLine, depths: &[Depth]) -> Array2<f64> {
        let cell = self.grid.cell();
        let trace = Trace::new(&self.series, cell.fractions(line.origin), cell.parts(line.unit()));
        let mut section = Array2::zeros([depths.len(), line.points]);
        for (mut row, &depth) in section.outer_iter_mut().zip(depths) {
            let along = trace.sums(&self.at(depth), [line.span[0], line.step()], line.points);
            row.iter_mut().zip(along).for_each(|(value, [temperature])| *value = temperature);
        }
        section
    }

    fn at(&self, depth: Depth) -> AtDepth<'_> {
        let count = self.series.waves.shells_up_to(REACH / depth.z.max(f64::MIN_POSITIVE));
        let amplitudes = parallel::map_by(MIN_PARALLEL, count, |shell| self.waves[shell].at(depth));
        AtDepth { field: self, amplitudes }
    }
}

impl fmt::Display for TemperatureField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "temperature by {} plane waves in {} shells", self.series.waves.shells().len(), self.waves.len())
    }
}

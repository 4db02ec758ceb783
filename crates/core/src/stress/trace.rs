//! Waves along a straight line.
//!
//! On a line **x** = **x**₀ + s**d** a wave c e^{i**q**·**x**} is c e^{i**q**·**x**₀} e^{iκs} with κ = **q**·**d**: N² waves
//! of any κ, summed at equally spaced s ([`Nonuniform`]). Along a lattice direction, **d** ∝ m₁**a**₁ + m₂**a**₂, κ is a
//! multiple m₁κ₁ + m₂κ₂ of one wavenumber: they are first collapsed onto a few N multiples, −κ being the conjugate of κ.

use super::phases::Phases;
use super::series::{Response, Series};
use super::traction_waves::{TractionWave, Wave};
use crate::lattice::waves::WaveRow;
use crate::numeric::fourier::Nonuniform;
use crate::numeric::lanes::vectorised;
use rustfft::num_complex::Complex64;

/// Largest multiples m₁, m₂ of a lattice direction.
const MAX_MULTIPLE: i32 = 32;
/// Tolerance of whole multiples: a phase error of 1e-11 over a period.
const WHOLE_TOLERANCE: f64 = 1e-12;

/// The waves of a series along a line.
#[derive(Debug)]
pub(super) struct Trace<'a> {
    series: &'a Series,
    /// Fractions of a₁ and a₂ of the origin **x**₀, and of the unit vector **d**.
    origin: [f64; 2],
    unit: [f64; 2],
    /// m₁, m₂ and 1/s of m₁**a**₁ + m₂**a**₂; `None` for a direction that is incommensurate with the lattice.
    lattice: Option<([i32; 2], f64)>,
}

impl<'a> Trace<'a> {
    /// Trace along the line from `origin` in the direction of the `unit` vector, both as fractions of a₁ and a₂.
    pub fn new(series: &'a Series, origin: [f64; 2], unit: [f64; 2]) -> Self {
        Self { series, origin, unit, lattice: lattice_direction(unit, WHOLE_TOLERANCE) }
    }

    /// Components of a response at s = first + i step, 0 ≤ i < `points`; s, first and step are lengths.
    pub fn sums<const K: usize, R: Response<K>>(
        &self,
        response: &R,
        equally_spaced: [f64; 2],
        points: usize,
    ) -> Vec<[f64; K]> {
        match self.series.coefficients(response.is_deep()).shear {
            None => self.sums_of::<Complex64, K, R>(response, equally_spaced, points),
            Some(_) => self.sums_of::<TractionWave, K, R>(response, equally_spaced, points),
        }
    }

    fn sums_of<W: Wave, const K: usize, R: Response<K>>(
        &self,
        response: &R,
        [first, step]: [f64; 2],
        points: usize,
    ) -> Vec<[f64; K]> {
        let rows = self.series.waves.rows_within(response.shells());
        let middle = first + (points / 2) as f64 * step;
        let origin = [0, 1].map(|axis| self.origin[axis] + middle * self.unit[axis]);
        let (along, across) = (Phases::along(&rows, [origin[0]]), Phases::across(&rows, [origin[1]]));
        let mut waves = Nonuniform::new(points);
        match self.lattice {
            Some(([m1, m2], unit)) => {
                let multiple = |row: &WaveRow, k: usize| m1 * (row.first + k as i32) + m2 * row.across;
                let ends = rows.iter().flat_map(|row| [multiple(row, 0), multiple(row, row.len - 1)]);
                let most = ends.map(i32::abs).max().unwrap_or(0) as usize;
                let mut sums = vec![[Complex64::default(); K]; most + 1];
                for row in &rows {
                    let numbers = (multiple(row, 0), m1);
                    vectorised!(_simd => self.collapse::<W, K, R>((row, numbers), &along, &across, response, &mut sums));
                }
                let turns = unit * step;
                waves.add(sums.into_iter().enumerate().map(|(multiple, sums)| (multiple as f64 * turns, sums)));
            }
            None => {
                let [s, t] = self.unit.map(|fraction| step * fraction);
                for row in &rows {
                    let turns = |k: usize| f64::from(row.first + k as i32) * s + f64::from(row.across) * t;
                    let terms = self.terms::<W, K, R>(row, &along, &across, response);
                    waves.add(terms.enumerate().map(|(k, term)| (turns(k), term)));
                }
            }
        }
        let mean = response.mean();
        let mut all: Vec<[f64; K]> =
            waves.real_parts().into_iter().map(|sums| std::array::from_fn(|k| mean[k] + sums[k])).collect();
        if let Some(far) = response.far() {
            let line = far.on_line(self.origin, self.unit, [first, first + points.saturating_sub(1) as f64 * step]);
            for (i, sum) in all.iter_mut().enumerate() {
                sum.iter_mut().zip(line.at(first + i as f64 * step)).for_each(|(component, far)| *component += far);
            }
        }
        all
    }

    /// Adds the waves of a row, of the multiples `first`, `first` + `step`, … of one wavenumber, to the sums of these multiples.
    #[inline(always)]
    fn collapse<W: Wave, const K: usize, R: Response<K>>(
        &self,
        (row, (first, step)): (&WaveRow, (i32, i32)),
        along: &Phases<1>,
        across: &Phases<1>,
        response: &R,
        sums: &mut [[Complex64; K]],
    ) {
        for (multiple, term) in (0..).map(|k| first + k * step).zip(self.terms::<W, K, R>(row, along, across, response))
        {
            let side = f64::from(multiple.signum() | 1);
            for (sum, term) in sums[multiple.unsigned_abs() as usize].iter_mut().zip(term) {
                *sum += Complex64::new(term.re, side * term.im);
            }
        }
    }

    /// Terms of the waves of a row at a point, by the phases of its fractions of a₁ and a₂.
    #[inline(always)]
    fn terms<'b, W: Wave + 'b, const K: usize, R: Response<K>>(
        &'b self,
        row: &'b WaveRow,
        along: &'b Phases<1>,
        across: &Phases<1>,
        response: &'b R,
    ) -> impl Iterator<Item = [Complex64; K]> + 'b {
        let &[[re], [im]] = across.of(row);
        let across = Complex64::new(re, im);
        self.series
            .of::<W>(row, response.is_deep())
            .zip(along.from(row))
            .map(move |((q, shell, c), [[re], [im]])| response.times(q, shell, c * (across * Complex64::new(*re, *im))))
    }
}

/// m₁, m₂ without a common factor along a unit vector of these fractions of a₁ and a₂, and one over the distance s of
/// m₁**a**₁ + m₂**a**₂ along it (of either sign); `None` for a direction that is incommensurate with the lattice, whose multiples are
/// not whole to the `tolerance`.
pub(super) fn lattice_direction([s, t]: [f64; 2], tolerance: f64) -> Option<([i32; 2], f64)> {
    let larger = if s.abs() > t.abs() { s } else { t };
    let near = |x: f64| (x - x.round()).abs() <= tolerance;
    let scale = (1..=MAX_MULTIPLE).map(f64::from).find(|m| near(m * s / larger) && near(m * t / larger))?;
    Some(([s, t].map(|x| (scale * x / larger).round() as i32), larger / scale))
}

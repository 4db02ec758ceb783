//! Waves along a straight line.
//!
//! On a line **x** = **x**₀ + s**d** a wave c e^{i**q**·**x**} is c e^{i**q**·**x**₀} e^{iκs} with κ = **q**·**d**. Along a
//! lattice direction, **d** ∝ m₁**a**₁ + m₂**a**₂, κ is a multiple m₁κ₁ + m₂κ₂ of one wavenumber: N² waves collapse onto a
//! few N multiples, −κ being the conjugate of κ, before any point of the line is looked at. Along a direction that is
//! incommensurate with the lattice nothing collapses: each wave is a sum of its own, and a line takes longer.

use super::series::{Phases, Response, Series, turned};
use crate::lattice::waves::Row;
use rustfft::num_complex::Complex64;
use std::f64::consts::TAU;

/// Multiples m₁, m₂ up to which a direction is one of the lattice.
const LATTICE: i32 = 32;
/// How near whole ones they are: a phase error of 1e-11 over a period.
const WHOLE: f64 = 1e-12;

/// The waves of a series along a line.
#[derive(Debug)]
pub(super) struct Trace<'a> {
    series: &'a Series,
    /// Fractions of a₁ and a₂ of the origin **x**₀, and of the unit vector **d**.
    origin: [f64; 2],
    unit: [f64; 2],
    /// m₁, m₂ and the wavenumber they are multiples of, 1/length.
    lattice: Option<([i32; 2], f64)>,
    /// e^{2πiκ₁s₁} at the origin.
    along: Phases<1>,
}

impl<'a> Trace<'a> {
    /// Along the line from `origin` in the direction of the `unit` vector, both as fractions of a₁ and a₂.
    pub fn new(series: &'a Series, origin: [f64; 2], unit: [f64; 2]) -> Self {
        let along = Phases::along(series.waves.rows(), [origin[0]]);
        Self { series, origin, unit, lattice: lattice_direction(unit), along }
    }

    /// Components at s = first + i step, 0 ≤ i < `points`, lengths.
    pub fn sums<const K: usize, R: Response<K>>(
        &self,
        response: &R,
        [first, step]: [f64; 2],
        points: usize,
    ) -> Vec<[f64; K]> {
        let places: Vec<f64> = (0..points).map(|i| first + i as f64 * step).collect();
        let mut fields = response.mean().map(|mean| vec![mean; points]);
        let rows = self.series.waves.rows_within(response.shells());
        match self.lattice {
            Some(([m1, m2], unit)) => {
                let multiple = |row: &Row, k: usize| m1 * (row.first + k as i32) + m2 * row.across;
                let ends = rows.iter().flat_map(|row| [multiple(row, 0), multiple(row, row.len - 1)]);
                let most = ends.map(i32::abs).max().unwrap_or(0) as usize;
                let mut sums = vec![[Complex64::default(); K]; most + 1];
                for row in &rows {
                    self.terms(row, response, |k, term| {
                        let multiple = multiple(row, k);
                        let side = f64::from(multiple.signum() | 1);
                        for (sum, term) in sums[multiple.unsigned_abs() as usize].iter_mut().zip(term) {
                            *sum += Complex64::new(term.re, side * term.im);
                        }
                    });
                }
                let mut turning = Turning::new(&places, 0.0, unit);
                sums.iter().for_each(|sums| turning.add(&mut fields, sums));
            }
            None => {
                let [s, t] = self.unit.map(|fraction| TAU * fraction);
                for row in &rows {
                    let kappa = f64::from(row.across) * t + f64::from(row.first) * s;
                    let mut turning = Turning::new(&places, kappa, s);
                    self.terms(row, response, |_, term| turning.add(&mut fields, &term));
                }
            }
        }
        (0..points).map(|i| std::array::from_fn(|k| fields[k][i])).collect()
    }

    /// Hands over what the waves of a row give at the origin, by their number in it.
    fn terms<const K: usize, R: Response<K>>(
        &self,
        row: &Row,
        response: &R,
        mut add: impl FnMut(usize, [Complex64; K]),
    ) {
        let [[re], [im]] = turned(row.across, [self.origin[1]]);
        let across = Complex64::new(re, im);
        for (k, ((q, shell, c), [[re], [im]])) in self.series.of(row).zip(self.along.from(row)).enumerate() {
            let even = c * (across * Complex64::new(*re, *im));
            let odd = Complex64::new(even.im, -even.re);
            let factors = response.factors(q, shell);
            add(k, std::array::from_fn(|j| factors[j] * if R::ODD[j] { odd } else { even }));
        }
    }
}

/// e^{iκs} at some places s, κ growing by equal steps.
struct Turning<'a> {
    places: &'a [f64],
    /// κ of the present step and its growth, 1/length; the number of the step.
    kappa: f64,
    growth: f64,
    number: usize,
    /// cos κs, sin κs, and the same of the growth.
    phases: [Vec<f64>; 2],
    turns: [Vec<f64>; 2],
}

/// Steps after which phases are taken afresh, before rounding adds up.
const AFRESH: usize = 32;

impl<'a> Turning<'a> {
    fn new(places: &'a [f64], kappa: f64, growth: f64) -> Self {
        let phases =
            |kappa: f64| [f64::cos, f64::sin].map(|of| places.iter().map(|s| of(kappa * s)).collect::<Vec<_>>());
        Self { places, kappa, growth, number: 0, phases: phases(kappa), turns: phases(growth) }
    }

    /// Adds Re `sums` e^{iκs} to fields of the places, and turns on to the next κ.
    fn add<const K: usize>(&mut self, fields: &mut [Vec<f64>; K], sums: &[Complex64; K]) {
        let [cosines, sines] = &mut self.phases;
        for (field, sum) in fields.iter_mut().zip(sums).filter(|(_, sum)| sum.norm_sqr() != 0.0) {
            for ((total, cosine), sine) in field.iter_mut().zip(&*cosines).zip(&*sines) {
                *total += sum.re * cosine - sum.im * sine;
            }
        }
        self.number += 1;
        if self.number.is_multiple_of(AFRESH) {
            let kappa = self.kappa + self.number as f64 * self.growth;
            for ((cosine, sine), s) in cosines.iter_mut().zip(sines).zip(self.places) {
                (*sine, *cosine) = (kappa * s).sin_cos();
            }
        } else {
            let [turn_cosines, turn_sines] = &self.turns;
            for (((cosine, sine), c), s) in cosines.iter_mut().zip(sines).zip(turn_cosines).zip(turn_sines) {
                (*cosine, *sine) = (*cosine * c - *sine * s, *cosine * s + *sine * c);
            }
        }
    }
}

/// m₁, m₂ without a common factor along a unit vector of these fractions of a₁ and a₂, and 2π over the length of
/// m₁**a**₁ + m₂**a**₂; none for a direction that is incommensurate with the lattice.
fn lattice_direction([s, t]: [f64; 2]) -> Option<([i32; 2], f64)> {
    let larger = if s.abs() > t.abs() { s } else { t };
    let near = |x: f64| (x - x.round()).abs() <= WHOLE;
    let scale = (1..=LATTICE).map(f64::from).find(|m| near(m * s / larger) && near(m * t / larger))?;
    Some(([s, t].map(|x| (scale * x / larger).round() as i32), TAU * larger / scale))
}

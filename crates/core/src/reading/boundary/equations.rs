//! The normal equations of a fit, one step of its iteration.
//!
//! The equations need sums over samples of products of five factors with waves in the angle. Products of a sector are added first; the
//! waves are those at its middle. At the fitted boundary the shift is zero, whatever the waves.

use super::beside::Beside;
use super::constants::WEIGHT_RISE;
use super::fit::Fit;
use super::spot::NEAREST;
use crate::numeric::closed_line::{self, ANGLES, angle, series_line, waves_at};
use crate::numeric::parallel;
use crate::numeric::series_fit::SeriesFit;
use std::iter::once;
use std::ops::Range;

/// Sums over the samples of one side of a sector of their squared weights times the products of φ or γ (v), of its change with the
/// boundary times the reach (s), and of the pressure or opening (y), all over the side's φ or γ at the reach, with powers of the
/// distance over the reach (t).
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    /// Number of samples.
    count: usize,
    /// v² times 1, t, … t⁴.
    squares: [f64; 5],
    /// vs times 1, t, t².
    mixed: [f64; 3],
    /// s².
    slopes: f64,
    /// vy times 1, t, t².
    values: [f64; 3],
    /// sy.
    slope_values: f64,
}

/// Sectors of one task, and samples from which on a fit is divided into tasks.
const SECTORS_PER_TASK: usize = 30;
const LARGE_FIT: usize = 8192;
/// Samples for each harmonic of a boundary, at least.
const SAMPLES_PER_HARMONIC: usize = 24;

impl Fit {
    /// The boundary fitted around `radii`; `amplitude` is A's series, empty at first. `None` where the samples do not determine it.
    pub(super) fn refined(&self, beside: &Beside<'_>, radii: &[f64], amplitude: &mut Vec<f64>) -> Option<Vec<f64>> {
        let sums = self.sector_sums(beside, radii);
        let over_all = |of: fn(&Sums) -> f64| sums.iter().flatten().map(of).sum::<f64>();
        let count = sums.iter().flatten().map(|sums| sums.count).sum::<usize>();
        let harmonics = self.harmonics.min(count / SAMPLES_PER_HARMONIC);
        if amplitude.is_empty() {
            amplitude.push(over_all(|sums| sums.values[0]) / over_all(|sums| sums.squares[0]));
        }
        let unit = amplitude[0];
        let mut fit = SeriesFit::new(self.term_harmonics(harmonics));
        let terms = 2 + self.sides().len() * self.powers;
        let (mut products, mut values) = (vec![0.0; terms * (terms + 1) / 2], vec![0.0; terms]);
        let counted = |(_, sums): &(&usize, &[Sums; 2])| sums.iter().any(|sums| sums.count > 0);
        for (sector, sums) in beside.filled().iter().zip(&sums).filter(counted) {
            let waves = &waves_at(*sector)[..1 + 4 * harmonics];
            let size = amplitude.iter().zip(waves).map(|(c, wave)| c * wave).sum::<f64>() / unit;
            self.fill(&sums[self.sides()], [size, unit], &mut products, &mut values);
            fit.add(waves, &products, &values);
        }
        let c = fit.solve()?;
        let count = 1 + 2 * harmonics;
        *amplitude = c[..count].iter().map(|c| c * unit).collect();
        if amplitude[0].is_nan() || amplitude[0] <= 0.0 {
            return None;
        }
        // A larger contact moves its outer rim out and that of a hole in.
        let sign = beside.rim().sign() * self.reach;
        let shifts: Vec<f64> = series_line(&c[count..2 * count]).into_iter().map(|shift| sign * shift).collect();
        // One step moves the edge by one spacing at most.
        Some(closed_line::moved(radii, &shifts, beside.samples().spacing))
    }

    /// The sides of the rim whose samples enter: inside 0, outside 1.
    fn sides(&self) -> Range<usize> {
        if self.inside > 0.0 { 0..2 } else { 1..2 }
    }

    /// Highest harmonics of the terms: A, the shift, and for each side κ, which varies around the spot as near neighbours do, and
    /// κ′.
    fn term_harmonics(&self, harmonics: usize) -> Vec<usize> {
        let varying = if self.clearance.iter().all(|clearance| clearance.is_infinite()) { 0 } else { harmonics };
        let modified = self.sides().flat_map(|_| once(varying).chain((1..self.powers).map(|_| 0)));
        [harmonics; 2].into_iter().chain(modified).collect()
    }

    /// The normal equations of a sector from the sums of its sides, for the amplitude `size` at the sector over its `unit`, the
    /// mean: products of the terms, and of the terms with the values.
    fn fill(&self, sides: &[Sums], [size, unit]: [f64; 2], products: &mut [f64], values: &mut [f64]) {
        let product = |t: usize, u: usize| t * (t + 1) / 2 + u;
        products.fill(0.0);
        values.fill(0.0);
        for (side, sums) in sides.iter().enumerate() {
            products[product(0, 0)] += sums.squares[0];
            products[product(1, 0)] += size * sums.mixed[0];
            products[product(1, 1)] += size * size * sums.slopes;
            values[0] += sums.values[0] / unit;
            values[1] += size * sums.slope_values / unit;
            for p in 0..self.powers {
                let term = 2 + side * self.powers + p;
                products[product(term, 0)] = sums.squares[1 + p];
                products[product(term, 1)] = size * sums.mixed[1 + p];
                for q in 0..=p {
                    products[product(term, 2 + side * self.powers + q)] = sums.squares[2 + p + q];
                }
                values[term] = sums.values[1 + p] / unit;
            }
        }
    }

    /// Sums over the samples inside and outside the rim `radii`, for each sector with samples.
    fn sector_sums(&self, beside: &Beside<'_>, radii: &[f64]) -> Vec<[Sums; 2]> {
        let edge = beside.samples().edge;
        let units = [edge.pressure(self.reach, 0.0)[0].abs(), edge.opening(self.reach, 0.0)[0]];
        let side = |sector: usize, open: bool| self.summed(beside, radii, (sector, open), units[usize::from(open)]);
        let filled = beside.filled();
        let summed = |number: usize| [false, true].map(|open| side(filled[number], open));
        let together = if beside.len() < LARGE_FIT { ANGLES } else { SECTORS_PER_TASK };
        parallel::map_by(together, filled.len(), summed)
    }

    /// Sums over the samples of one side of a sector, beside the rim `radii`; `unit` is φ or γ at the reach.
    fn summed(&self, beside: &Beside<'_>, radii: &[f64], (sector, open): (usize, bool), unit: f64) -> Sums {
        let (samples, reach) = (beside.samples(), self.reach);
        let mut sums = Sums::default();
        if !open && self.inside == 0.0 {
            return sums;
        }
        // The outward normal of a hole points to the axis; an outline is nearly round.
        let along = beside.rim().sign() * samples.edge.along(angle(sector));
        let most = if open { self.one_edge_reach(sector) } else { reach };
        let outwards = if open { 1.0 } else { -1.0 };
        let (nearest, rise) = (NEAREST * samples.spacing, 1.0 / (WEIGHT_RISE * samples.spacing));
        let (per_reach, per_unit) = (1.0 / reach, 1.0 / unit);
        for point in beside.points(sector, open) {
            let d = outwards * beside.distance(point, radii);
            if d < nearest || d >= most {
                continue;
            }
            let part = d * per_reach;
            let rise = (d * rise).min(1.0);
            let ([value, slope], weight) = if open {
                let [value, slope] = samples.edge.opening(d, along);
                ([value, -slope], rise * rise / (2.25 * part))
            } else {
                (samples.edge.pressure(d, along), (2.0 * self.inside * rise).powi(2) * part)
            };
            let (y, value, slope) = (point.value * per_unit, value * per_unit, slope * (reach * per_unit));
            sums.count += 1;
            let (mut square, mut mixed, mut product) =
                (weight * value * value, weight * value * slope, weight * value * y);
            for k in 0..5 {
                sums.squares[k] += square;
                square *= part;
            }
            for k in 0..3 {
                sums.mixed[k] += mixed;
                sums.values[k] += product;
                (mixed, product) = (mixed * part, product * part);
            }
            sums.slopes += weight * slope * slope;
            sums.slope_values += weight * slope * y;
        }
        sums
    }
}

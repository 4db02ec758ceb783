//! The fit of one rim of a contact to the samples beside it: what it rests on, and where it stands.
//!
//! The normal equations of a fit need sums over samples of products of five factors with waves in the angle. Those of a sector
//! are added first; the waves are those at its middle. Where the fit stands its shift is zero, whatever the waves.

use super::beside::Beside;
use super::constants::{COUNTED_ERROR, HARMONICS, MAX_ITERATIONS, MAX_SHIFT, MIN_RESOLUTION, WEIGHT_RISE};
use super::rim::Rim;
use super::room::{SECTORS, room};
use super::spot::{NEAREST, Sample, Scale, Spot};
use crate::numeric::closed_line::{self, ANGLES, angle, mean_radius, series_line, waves_at};
use crate::numeric::series_fit::SeriesFit;
use rayon::prelude::*;
use std::f64::consts::PI;

/// What a fit rests on.
#[derive(Debug, Clone, Copy)]
struct Fit {
    /// Largest distance of a sample from the edge, a length.
    reach: f64,
    /// Weight of samples in contact; 0: the gap alone.
    inside: f64,
    /// Powers of d that modify φ and γ.
    powers: usize,
    /// Highest harmonic.
    harmonics: usize,
    /// How far samples lie open beside the rim in each of equal sectors, lengths.
    room: [f64; SECTORS],
}

/// Sums over the samples of one side of a sector: of their weights squared times the products of φ or γ (v), its change with the
/// boundary times the reach (s), the pressure or opening (y), all over the side's φ or γ at the reach, and powers of the distance over
/// the reach (t).
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

/// Highest harmonics of the boundary, and the distance in spacings by which a sample may lie on its wrong side: the first that
/// leave none farther are taken. Contacts about to merge are polygons.
const HIGHEST_HARMONICS: [(usize, f64); 2] = [(HARMONICS, 0.5), (12, 1.0)];
/// Radius of a disc that round contacts fill, over the distance of their farthest sample.
const DISC: f64 = 0.9;
/// Weight of the pressure's samples beside the gap's where both are fitted.
const PRESSURE: f64 = 0.1;
/// Part of the way to the middle between the contacts over which the gap is that of one edge.
const OWN: f64 = 0.4;
/// Part of the samples outside the edge that must be there for a fit of the gap alone.
const ROOM: f64 = 0.6;
/// Iterations of a fit after which one that changes the boundary by more than half a spacing and by more than half as much as
/// the one before diverges.
const FIRST_ROUNDS: usize = 2;
const LARGE: f64 = 0.5;
/// Sectors whose samples are summed by one thread at least, and samples from which on it is worth while.
const TOGETHER: usize = 30;
const MANY: usize = 8192;
/// Change of a boundary, in spacings, below which it stands.
const STANDS: f64 = 1e-4;
/// Term that an error estimate adds to the differences of readings, in spacings.
const FLOOR: f64 = 0.01;

/// Boundary of low harmonics that encloses the samples as they are counted, and √(area/π): ρ² has the moments
/// ½∮ρ² cos kθ dθ = ∫ cos kθ d²x.
pub(super) fn counted(spot: &Spot<'_>, sample_area: f64, rim: Rim) -> (Vec<f64>, f64) {
    const COUNT: usize = 2 * HARMONICS + 1;
    // Waves have no sum over a disc: only samples add to theirs that lie outside it, or within it and not in the spot.
    let disc = if rim == Rim::Outer { DISC * spot.farthest() } else { 0.0 };
    // No sample of the spot or its hole lies beyond the farthest in contact.
    let blocks = spot.taken([0.0, spot.farthest() * (1.0 + 1e-9)], |sums: &mut [f64; COUNT], _, [x, y], sample| {
        let own = sample == Sample::Hole || rim == Rim::Outer && sample == Sample::Contact;
        sums[0] += f64::from(u8::from(own));
        let square = x * x + y * y;
        if own != (square < disc * disc) && square > 0.0 {
            let r = square.sqrt();
            let (cosine, sine) = (x / r, y / r);
            let (mut c, mut s) = (if own { 1.0 } else { -1.0 }, 0.0);
            for k in 0..HARMONICS {
                (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
                sums[2 * k + 1] += c;
                sums[2 * k + 2] += s;
            }
        }
    });
    let mut squares = blocks.iter().fold([0.0; COUNT], |sum, block| std::array::from_fn(|k| sum[k] + block[k]));
    for (k, square) in squares.iter_mut().enumerate() {
        *square *= if k == 0 { 1.0 } else { 2.0 } * sample_area / PI;
    }
    let least = 0.1 * squares[0];
    (series_line(&squares).into_iter().map(|square| square.max(least).sqrt()).collect(), squares[0].sqrt())
}

/// Radii of a rim and the estimated error of their mean.
pub(super) fn located(spot: &Spot<'_>, scale: &Scale<'_>, rim: Rim) -> Option<(Vec<f64>, f64)> {
    let (start, radius) = counted(spot, scale.sample_area, rim);
    if scale.resolution(radius) < MIN_RESOLUTION {
        return None;
    }
    let (reach, room) = (scale.reach(radius), room(spot, rim, &start, scale.spacing));
    let mut beside = Beside::new(spot, scale, rim, reach, &start);
    // No boundary that would be believed leaves its samples on the right side.
    if beside.is_astray(&start, belief(&start, scale.spacing) + scale.spacing) {
        return None;
    }
    HIGHEST_HARMONICS.into_iter().find_map(|(harmonics, astray)| {
        let whole = Fit { reach, inside: 0.0, powers: 2, harmonics, room };
        let (best, radii) = whole.best(&mut beside, &start)?;
        beside.follow(&radii);
        if beside.is_astray(&radii, astray * scale.spacing) {
            return None;
        }
        let error = if scale.errors { whole.error(best, &mut beside, &start, &radii) } else { 0.0 };
        Some((radii, error))
    })
}

/// How far a boundary may lie from the counted one.
fn belief(counted: &[f64], spacing: f64) -> f64 {
    MAX_SHIFT * spacing + 0.1 * mean_radius(counted)
}

/// The largest distance of two lines.
fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

impl Fit {
    /// The best reading first: the gap alone, the pressure too, and that without κ′.
    fn readings(self) -> [Self; 3] {
        let both = Self { inside: PRESSURE, ..self };
        [self, both, Self { powers: 1, ..both }]
    }

    /// The best reading that stands, by its index, and where.
    fn best(self, beside: &mut Beside<'_>, start: &[f64]) -> Option<(usize, Vec<f64>)> {
        let mut readings = self.readings().into_iter().enumerate();
        readings
            .find_map(|(index, fit)| Some((index, fit.has_room(beside, start).then(|| fit.stands(beside, start))??)))
    }

    /// What the readings beside the best one, which stands at `radii`, say of its error.
    fn error(self, best: usize, beside: &mut Beside<'_>, start: &[f64], radii: &[f64]) -> f64 {
        let spacing = beside.scale().spacing;
        let half = Self { reach: (0.5 * (self.reach + WEIGHT_RISE * spacing)).min(self.reach), powers: 1, ..self };
        let mean = mean_radius(radii);
        let mut difference = |other: Self| {
            let there = other.has_room(beside, start).then(|| other.moved(beside, start, radii))??;
            Some((mean_radius(&there) - mean).abs())
        };
        // A reading that fails says no more than counting does.
        let spread = [Some(half), self.readings().get(best + 1).copied()]
            .map(|other| other.and_then(&mut difference).unwrap_or(COUNTED_ERROR * spacing));
        1.5 * spread[0].max(spread[1]) + FLOOR * spacing
    }

    /// The boundary at which the fit stands, from the one that is `counted`. `None` if it goes far from that or does not come to
    /// a stand.
    fn stands(&self, beside: &mut Beside<'_>, counted: &[f64]) -> Option<Vec<f64>> {
        let spacing = beside.scale().spacing;
        let (mut radii, mut amplitude, mut last) = (counted.to_vec(), Vec::new(), f64::INFINITY);
        for round in 0..MAX_ITERATIONS {
            let before = std::mem::take(&mut radii);
            radii = self.round(beside, counted, &before, &mut amplitude)?;
            let change = farthest(&radii, &before);
            if change < STANDS * spacing {
                return Some(radii);
            }
            if round >= FIRST_ROUNDS && change > (LARGE * spacing).max(0.5 * last) {
                return None;
            }
            last = change;
        }
        Some(radii)
    }

    /// Where the fit nearly stands, from where another one does: what it moves below the floor of the error does not count.
    fn moved(&self, beside: &mut Beside<'_>, counted: &[f64], from: &[f64]) -> Option<Vec<f64>> {
        let mut amplitude = Vec::new();
        let radii = self.round(beside, counted, from, &mut amplitude)?;
        if farthest(&radii, from) < FLOOR * beside.scale().spacing {
            return Some(radii);
        }
        self.round(beside, counted, &radii, &mut amplitude)
    }

    /// The boundary fitted around `radii`, `None` if it goes far from the one that is `counted`.
    fn round(
        &self,
        beside: &mut Beside<'_>,
        counted: &[f64],
        radii: &[f64],
        amplitude: &mut Vec<f64>,
    ) -> Option<Vec<f64>> {
        beside.follow(radii);
        let radii = self.refined(beside, radii, amplitude)?;
        let bound = belief(counted, beside.scale().spacing);
        // What is not a number is far, too.
        radii.iter().zip(counted).all(|(radius, counted)| (radius - counted).abs() < bound).then_some(radii)
    }

    /// Distance outside the edge over which the gap at an angle, given by its index, is that of this edge.
    fn own(&self, index: usize) -> f64 {
        self.reach.min(OWN * self.room[index * SECTORS / ANGLES])
    }

    /// Whether the samples in contact take part, or most of those that could be outside the edge within reach are there and
    /// open.
    fn has_room(&self, beside: &Beside<'_>, radii: &[f64]) -> bool {
        if self.inside > 0.0 {
            return true;
        }
        let (mean, sign) = (mean_radius(radii), beside.rim().sign());
        let whole = sign * PI * ((mean + sign * self.reach).powi(2) - mean * mean);
        let near = |sector: usize| {
            let own = 0.0..self.own(sector);
            beside.points(sector, true).iter().filter(|point| own.contains(&beside.distance(point, radii))).count()
        };
        beside.filled().iter().map(|&sector| near(sector)).sum::<usize>() as f64 * beside.scale().sample_area
            > ROOM * whole
    }

    /// What the samples of one side of a sector add, beside the rim `radii`; `unit` is φ or γ at the reach.
    fn summed(&self, beside: &Beside<'_>, radii: &[f64], (sector, open): (usize, bool), unit: f64) -> Sums {
        let (scale, reach) = (beside.scale(), self.reach);
        let mut sums = Sums::default();
        if !open && self.inside == 0.0 {
            return sums;
        }
        // The outward normal of a hole points to the axis; an outline is nearly round.
        let along = beside.rim().sign() * scale.edge.along(angle(sector));
        let most = if open { self.own(sector) } else { reach };
        let outwards = if open { 1.0 } else { -1.0 };
        let (nearest, rise) = (NEAREST * scale.spacing, 1.0 / (WEIGHT_RISE * scale.spacing));
        let (per_reach, per_unit) = (1.0 / reach, 1.0 / unit);
        for point in beside.points(sector, open) {
            let d = outwards * beside.distance(point, radii);
            if d < nearest || d >= most {
                continue;
            }
            let part = d * per_reach;
            let rise = (d * rise).min(1.0);
            let ([value, slope], weight) = if open {
                let [value, slope] = scale.edge.opening(d, along);
                ([value, -slope], rise * rise / (2.25 * part))
            } else {
                (scale.edge.pressure(d, along), (2.0 * self.inside * rise).powi(2) * part)
            };
            let (y, value, slope) = (point.value * per_unit, value * per_unit, slope * (reach * per_unit));
            sums.count += 1;
            let (mut square, mut mixed, mut own) = (weight * value * value, weight * value * slope, weight * value * y);
            for k in 0..5 {
                sums.squares[k] += square;
                square *= part;
            }
            for k in 0..3 {
                sums.mixed[k] += mixed;
                sums.values[k] += own;
                (mixed, own) = (mixed * part, own * part);
            }
            sums.slopes += weight * slope * slope;
            sums.slope_values += weight * slope * y;
        }
        sums
    }

    /// The boundary fitted around `radii`; `amplitude` is A's series, empty at first.
    fn refined(&self, beside: &Beside<'_>, radii: &[f64], amplitude: &mut Vec<f64>) -> Option<Vec<f64>> {
        let edge = beside.scale().edge;
        let units = [edge.pressure(self.reach, 0.0)[0].abs(), edge.opening(self.reach, 0.0)[0]];
        let side = |sector: usize, open: bool| self.summed(beside, radii, (sector, open), units[usize::from(open)]);
        let summed = |&sector: &usize| [false, true].map(|open| side(sector, open));
        let together = if beside.len() < MANY { ANGLES } else { TOGETHER };
        let all: Vec<[Sums; 2]> = beside.filled().par_iter().with_min_len(together).map(summed).collect();
        let over_all = |of: fn(&Sums) -> f64| all.iter().flatten().map(of).sum::<f64>();
        let count = all.iter().flatten().map(|sums| sums.count).sum::<usize>();
        let harmonics = self.harmonics.min(count / 24);
        let varying = if self.room.iter().all(|room| room.is_infinite()) { 0 } else { harmonics };
        if amplitude.is_empty() {
            amplitude.push(over_all(|sums| sums.values[0]) / over_all(|sums| sums.squares[0]));
        }
        let unit = amplitude[0];
        let sides = if self.inside > 0.0 { 0..2 } else { 1..2 };
        // A, the shift, and what modifies each side: κ, which varies around the spot as near neighbours do, then κ′.
        let modified = sides.clone().flat_map(|_| std::iter::once(varying).chain((1..self.powers).map(|_| 0)));
        let mut fit = SeriesFit::new([harmonics; 2].into_iter().chain(modified).collect());
        let terms = 2 + sides.len() * self.powers;
        let (mut products, mut values) = (vec![0.0; terms * (terms + 1) / 2], vec![0.0; terms]);
        let counted = |(_, sums): &(&usize, &[Sums; 2])| sums.iter().any(|sums| sums.count > 0);
        for (sector, sums) in beside.filled().iter().zip(&all).filter(counted) {
            let waves = &waves_at(*sector)[..1 + 4 * harmonics];
            let size = amplitude.iter().zip(waves).map(|(c, wave)| c * wave).sum::<f64>() / unit;
            products.fill(0.0);
            values.fill(0.0);
            for (place, sums) in sums[sides.clone()].iter().enumerate() {
                let product = |t: usize, u: usize| t * (t + 1) / 2 + u;
                products[product(0, 0)] += sums.squares[0];
                products[product(1, 0)] += size * sums.mixed[0];
                products[product(1, 1)] += size * size * sums.slopes;
                values[0] += sums.values[0] / unit;
                values[1] += size * sums.slope_values / unit;
                for p in 0..self.powers {
                    let term = 2 + place * self.powers + p;
                    products[product(term, 0)] = sums.squares[1 + p];
                    products[product(term, 1)] = size * sums.mixed[1 + p];
                    for q in 0..=p {
                        products[product(term, 2 + place * self.powers + q)] = sums.squares[2 + p + q];
                    }
                    values[term] = sums.values[1 + p] / unit;
                }
            }
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
        // One round moves the edge by one spacing at most.
        Some(closed_line::moved(radii, &shifts, beside.scale().spacing))
    }
}

//! The fit of one rim of a contact to the samples beside it: what it rests on, and where it stands.

use super::sample::{NEAREST, Polar, RISE, Scale};
use crate::numeric::closed_line::{self, ANGLES, angle, mean_radius, series, waves};
use crate::numeric::series_fit::SeriesFit;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Which boundary of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rim {
    Outer,
    Hole,
}

/// What a fit rests on.
#[derive(Debug, Clone, Copy)]
struct Fit {
    rim: Rim,
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

/// A sample as the fit sees it.
#[derive(Debug, Clone, Copy)]
struct Seen {
    /// Angle, radians.
    theta: f64,
    /// Distance from the edge over the reach.
    part: f64,
    /// 0 in contact, 1 outside.
    side: usize,
    /// Pressure or gap, φ or γ, and its change with the boundary times the reach; all over the side's φ or γ at the reach.
    y: f64,
    value: f64,
    slope: f64,
    /// Its weight.
    weight: f64,
}

/// Highest harmonics of the boundary: the first that leave no sample on its wrong side. Contacts about to merge are
/// polygons. And those of the counted boundary from which the fits start.
const HARMONICS: [usize; 2] = [6, 12];
const FIRST_HARMONICS: usize = 3;
/// Fewest samples per radius for a fit.
const FEWEST: f64 = 3.0;
/// Largest distance of a located boundary from the counted one, in spacings: beyond it the fit is not believed.
const BELIEF: f64 = 2.0;
/// Weight of the pressure's samples beside the gap's where both are fitted.
const PRESSURE: f64 = 0.1;
/// Sectors in which neighbours stand nearer or farther, and the part of the way to the middle between the contacts over
/// which the gap is that of one edge.
const SECTORS: usize = 24;
const OWN: f64 = 0.4;
/// Room over the radius from which on no neighbour is felt.
const FAR: f64 = 0.7;
/// Part of the samples outside the edge that must be there for a fit of the gap alone.
const ROOM: f64 = 0.6;
/// Fits, each from the boundary of the last.
const ROUNDS: usize = 8;
/// Samples that are summed together.
const BLOCK: usize = 2048;
/// Change of a boundary, in spacings, below which it stands.
const STANDS: f64 = 1e-7;
/// What an error estimate adds to the differences of readings, in spacings; the error of a counted radius.
const FLOOR: f64 = 0.01;
pub(super) const COUNTED: f64 = 0.5;

fn sector(theta: f64) -> usize {
    (theta.rem_euclid(TAU) / TAU * SECTORS as f64) as usize % SECTORS
}

/// Boundary of low harmonics that encloses the samples as they are counted, and √(area/π): ρ² has the moments
/// ½∮ρ² cos kθ dθ = ∫ cos kθ d²x.
pub(super) fn counted(samples: &[Polar], sample_area: f64, rim: Rim) -> (Vec<f64>, f64) {
    let mut squares = vec![0.0; 2 * FIRST_HARMONICS + 1];
    for sample in samples.iter().filter(|sample| sample.hole || rim == Rim::Outer && sample.p > 0.0) {
        let waves = waves(sample.theta, FIRST_HARMONICS);
        for (k, (square, wave)) in squares.iter_mut().zip(waves).enumerate() {
            *square += if k == 0 { 1.0 } else { 2.0 } * wave * sample_area / PI;
        }
    }
    let least = 0.1 * squares[0];
    let radius = |index| series(&squares, angle(index)).max(least).sqrt();
    ((0..ANGLES).map(radius).collect(), squares[0].sqrt())
}

/// Radii of a rim and the estimated error of their mean.
pub(super) fn located(samples: &[Polar], scale: &Scale<'_>, rim: Rim) -> Option<(Vec<f64>, f64)> {
    let (start, radius) = counted(samples, scale.sample_area, rim);
    if radius < FEWEST * scale.sample_area.sqrt() {
        return None;
    }
    let reach = scale.reach(radius);
    let fit = Fit { rim, reach, inside: 0.0, powers: 2, harmonics: HARMONICS[0], room: [0.0; SECTORS] };
    let fit = fit.with_room(samples, &start);
    HARMONICS.into_iter().find_map(|harmonics| {
        let (radii, error) = Fit { harmonics, ..fit }.read(samples, scale, &start)?;
        let astray = |sample: &Polar| fit.astray(sample, &radii) > scale.spacing;
        (!samples.iter().any(astray)).then_some((radii, error))
    })
}

impl Fit {
    /// The best of three readings and its error.
    fn read(self, samples: &[Polar], scale: &Scale<'_>, start: &[f64]) -> Option<(Vec<f64>, f64)> {
        let half = Self { reach: (0.5 * (self.reach + RISE * scale.spacing)).min(self.reach), powers: 1, ..self };
        let both = Self { inside: PRESSURE, ..self }.stands(samples, scale, start);
        let gap = |fit: Self| fit.has_room(samples, scale, start).then(|| fit.stands(samples, scale, start)).flatten();
        let (best, others) = match (gap(self), gap(half)) {
            (Some(whole), half) => (whole, vec![half, both]),
            (None, half) => {
                let short = Self { inside: PRESSURE, powers: 1, ..self }.stands(samples, scale, start);
                (both.or_else(|| short.clone())?, vec![half, short])
            }
        };
        let mean = mean_radius(&best);
        // A reading that fails says no more than counting does.
        let difference =
            |other: Option<Vec<f64>>| other.map_or(COUNTED * scale.spacing, |o| (mean_radius(&o) - mean).abs());
        let spread = others.into_iter().map(difference).fold(0.0, f64::max);
        Some((best, 1.5 * spread + FLOOR * scale.spacing))
    }

    /// How far a sample lies on the wrong side of a rim, a length; negative on the right one.
    fn astray(&self, sample: &Polar, radii: &[f64]) -> f64 {
        let outside = self.distance(sample, radii);
        if self.open(sample) {
            -outside
        } else if sample.p > 0.0 {
            outside
        } else {
            f64::NEG_INFINITY
        }
    }

    /// The boundary at which the fit stands, from `start`; `None` if it goes far from it.
    fn stands(&self, samples: &[Polar], scale: &Scale<'_>, start: &[f64]) -> Option<Vec<f64>> {
        let mut radii = start.to_vec();
        let mut amplitude = Vec::new();
        let bound = BELIEF * scale.spacing + 0.1 * mean_radius(start);
        for _ in 0..ROUNDS {
            let before = std::mem::take(&mut radii);
            radii = self.refined(samples, scale, &before, &mut amplitude)?;
            // What is not a number is far, too.
            let near = |(radius, start): (&f64, &f64)| (radius - start).abs() < bound;
            if !radii.iter().zip(start).all(near) {
                return None;
            }
            if radii.iter().zip(&before).all(|(now, before)| (now - before).abs() < STANDS * scale.spacing) {
                break;
            }
        }
        Some(radii)
    }

    /// Distance of a sample from the rim, positive where it is open.
    fn distance(&self, sample: &Polar, radii: &[f64]) -> f64 {
        let d = sample.r - closed_line::radius(radii, sample.theta);
        if self.rim == Rim::Outer { d } else { -d }
    }

    /// Whether a sample lies open beside this rim, not beside the other one.
    fn open(&self, sample: &Polar) -> bool {
        sample.p <= 0.0 && sample.hole == (self.rim == Rim::Hole)
    }

    /// With the room that there is around the boundary `radii`; samples are there out to twice its radius.
    fn with_room(self, samples: &[Polar], radii: &[f64]) -> Self {
        let mut room = [0.0f64; SECTORS];
        for sample in samples.iter().filter(|sample| self.open(sample)) {
            let own = &mut room[sector(sample.theta)];
            *own = own.max(self.distance(sample, radii));
        }
        let far = FAR * mean_radius(radii);
        let unbounded = |room: f64| self.rim == Rim::Outer && room > far;
        Self { room: room.map(|room| if unbounded(room) { f64::INFINITY } else { room }), ..self }
    }

    /// Whether a sample at a distance outside the edge shows the gap of this edge.
    fn sees(&self, sample: &Polar, distance: f64) -> bool {
        let most = self.reach.min(OWN * self.room[sector(sample.theta)]);
        self.open(sample) && (0.0..most).contains(&distance)
    }

    /// Whether most of the samples that could be outside the edge within reach are there and open.
    fn has_room(&self, samples: &[Polar], scale: &Scale<'_>, radii: &[f64]) -> bool {
        let near = |sample: &&Polar| self.sees(sample, self.distance(sample, radii));
        let (mean, sign) = (mean_radius(radii), if self.rim == Rim::Outer { 1.0 } else { -1.0 });
        let whole = sign * PI * ((mean + sign * self.reach).powi(2) - mean * mean);
        samples.iter().filter(near).count() as f64 * scale.sample_area > ROOM * whole
    }

    /// The boundary fitted around `radii`; `amplitude` is A's series, empty at first.
    fn refined(
        &self,
        samples: &[Polar],
        scale: &Scale<'_>,
        radii: &[f64],
        amplitude: &mut Vec<f64>,
    ) -> Option<Vec<f64>> {
        let Self { reach, powers, .. } = *self;
        // Most samples lie beyond the reach wherever the rim is.
        let band = radii.iter().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], &r| [a.min(r), b.max(r)]);
        let in_band = |sample: &&Polar| band[0] - reach < sample.r && sample.r < band[1] + reach;
        let range = [scale.edge.pressure(reach, 0.0)[0].abs(), scale.edge.opening(reach, 0.0)[0]];
        let seen = |sample: &Polar| {
            let d = self.distance(sample, radii);
            let (open, part) = (self.open(sample), d.abs() / reach);
            let wanted = self.sees(sample, d) || sample.p > 0.0 && d < 0.0 && self.inside > 0.0;
            if !wanted || part >= 1.0 || d.abs() < NEAREST * scale.spacing {
                return None;
            }
            let rise = (d.abs() / (RISE * scale.spacing)).min(1.0);
            let side = usize::from(open);
            // The outward normal of a hole points to the axis; an outline is nearly round.
            let along = if self.rim == Rim::Outer { 1.0 } else { -1.0 } * scale.edge.along(sample.theta);
            let ([value, slope], weight, y) = if open {
                let [value, slope] = scale.edge.opening(d, along);
                ([value, -slope], rise / part.sqrt() / 1.5, sample.opening.max(0.0))
            } else {
                (scale.edge.pressure(-d, along), 2.0 * self.inside * rise * part.sqrt(), sample.p)
            };
            let unit = range[side];
            let (y, value, slope) = (y / unit, value / unit, slope * reach / unit);
            Some(Seen { theta: sample.theta, part, side, y, value, slope, weight })
        };
        let near: Vec<Seen> = samples.par_iter().with_min_len(BLOCK).filter(in_band).filter_map(seen).collect();
        let harmonics = self.harmonics.min(near.len() / 24);
        let count = 1 + 2 * harmonics;
        let varying = if self.room.iter().all(|room| room.is_infinite()) { 0 } else { harmonics };
        if amplitude.is_empty() {
            let sum = |term: fn(f64, f64) -> f64| -> f64 {
                near.iter().map(|s| s.weight * s.weight * term(s.y, s.value)).sum()
            };
            amplitude.push(sum(|y, value| y * value) / sum(|_, value| value * value));
        }
        let unit = amplitude[0];
        let sides = if self.inside > 0.0 { 0..2 } else { 1..2 };
        // A, the shift, and what modifies each side: κ, which varies around the spot as near neighbours do, then κ′.
        let modified = sides.clone().flat_map(|_| std::iter::once(varying).chain((1..powers).map(|_| 0)));
        let empty = SeriesFit::new([harmonics; 2].into_iter().chain(modified).collect());
        let summed = |samples: &[Seen]| {
            let mut fit = empty.clone();
            let mut factors = Vec::new();
            for &Seen { theta, part, side, y, value, slope, weight } in samples {
                factors.clear();
                factors.extend([value, series(amplitude, theta) / unit * slope]);
                for own in sides.clone() {
                    let modified = if own == side { value * part } else { 0.0 };
                    factors.extend((0..powers as i32).map(|power| modified * part.powi(power)));
                }
                factors.iter_mut().for_each(|factor| *factor *= weight);
                fit.add(theta, &factors, weight * y / unit);
            }
            fit
        };
        let blocks: Vec<SeriesFit> = near.par_chunks(BLOCK).map(summed).collect();
        let whole = blocks.iter().fold(empty.clone(), |mut whole, block| {
            whole.merge(block);
            whole
        });
        let c = whole.solve()?;
        *amplitude = c[..count].iter().map(|c| c * unit).collect();
        if amplitude[0].is_nan() || amplitude[0] <= 0.0 {
            return None;
        }
        // A larger contact moves its outer rim out and that of a hole in.
        let sign = if self.rim == Rim::Outer { reach } else { -reach };
        let shifts: Vec<f64> = (0..ANGLES).map(|index| sign * series(&c[count..2 * count], angle(index))).collect();
        // One round moves the edge by one spacing at most.
        Some(closed_line::moved(radii, &shifts, scale.spacing))
    }
}

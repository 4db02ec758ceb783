//! The samples beside a rim, by the angle: a sector lies around each of the 360 angles of a line.
//!
//! The axes of a contact lie in the middle of sectors, so that rounding does not decide which sector the samples of a row along an
//! axis fall into. The samples are found once for all iterations of a fit, with a margin over which the rim may move.

use super::rim::Rim;
use super::spot::{ContactSamples, PolarSpot, Sample};
use crate::numeric::closed_line::ANGLES;
use std::f64::consts::TAU;

/// Distance in spacings over which a rim may move before its samples are found again.
const MARGIN: f64 = 2.0;

/// A sample beside a rim.
#[derive(Debug, Clone, Copy, Default)]
pub struct Point {
    /// Distance from the axis, a length.
    pub r: f64,
    /// Index of the angle before the sample.
    pub angle: u32,
    /// Part of the way to the next angle, from 0 to 1.
    pub part: f64,
    /// Pressure, or 3E*g/4 of an open sample.
    pub value: f64,
}

/// Samples near the rim `radii` of a spot.
pub struct Beside<'a> {
    spot: &'a PolarSpot<'a>,
    samples: &'a ContactSamples<'a>,
    rim: Rim,
    /// Largest distance of a sample from the rim, a length.
    reach: f64,
    /// The rim around which the samples were found, lengths.
    radii: Vec<f64>,
    /// Index of the first point of each sector in contact, then of the first open one.
    starts: Vec<usize>,
    points: Vec<Point>,
    /// Sectors with samples.
    filled: Vec<usize>,
    /// Distance outside the rim of the farthest sample in contact that is not near, a length; 0 without one.
    beyond: f64,
}

impl<'a> Beside<'a> {
    /// The samples nearer than `reach` to the rim `radii`.
    pub fn new(spot: &'a PolarSpot<'a>, samples: &'a ContactSamples<'a>, rim: Rim, reach: f64, radii: &[f64]) -> Self {
        let mut beside = Self {
            spot,
            samples,
            rim,
            reach,
            radii: radii.to_vec(),
            starts: Vec::new(),
            points: Vec::new(),
            filled: Vec::new(),
            beyond: 0.0,
        };
        beside.find();
        beside
    }

    /// Finds the samples again where the rim has moved too far to `radii`.
    pub fn follow(&mut self, radii: &[f64]) {
        let margin = MARGIN * self.samples.spacing;
        if radii.iter().zip(&self.radii).any(|(now, then)| (now - then).abs() > margin) {
            self.radii.copy_from_slice(radii);
            self.find();
        }
    }

    /// The rim.
    pub fn rim(&self) -> Rim {
        self.rim
    }

    /// The samples of the contact.
    pub fn samples(&self) -> &'a ContactSamples<'a> {
        self.samples
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// The sectors with samples.
    pub fn filled(&self) -> &[usize] {
        &self.filled
    }

    /// Samples of a sector in contact, or open ones.
    pub fn points(&self, sector: usize, open: bool) -> &[Point] {
        let group = 2 * sector + usize::from(open);
        &self.points[self.starts[group]..self.starts[group + 1]]
    }

    /// Distance of a sample outside the rim `radii`, a length; outside a hole lies contact.
    pub fn distance(&self, point: &Point, radii: &[f64]) -> f64 {
        let k = point.angle as usize;
        let [radius, next] = [radii[k], radii[if k + 1 == ANGLES { 0 } else { k + 1 }]];
        self.rim.sign() * (point.r - radius - point.part * (next - radius))
    }

    /// Whether a sample lies on the wrong side of the rim `radii`, by more than a distance.
    pub fn is_astray(&self, radii: &[f64], by: f64) -> bool {
        let wrong = |sector: usize, open: bool| {
            let sign = if open { -1.0 } else { 1.0 };
            self.points(sector, open).iter().any(|point| sign * self.distance(point, radii) > by)
        };
        self.beyond > by || self.filled.iter().any(|&sector| wrong(sector, false) || wrong(sector, true))
    }

    fn find(&mut self) {
        let beside = &*self;
        let Self { spot, samples, rim, ref radii, .. } = *beside;
        let near = self.reach + MARGIN * samples.spacing;
        let [least, most] =
            radii.iter().fold([f64::INFINITY, 0.0], |[a, b]: [f64; 2], &radius| [a.min(radius), b.max(radius)]);
        let distances = match rim {
            Rim::Outer => [(least - near).max(0.0), (most + near).max(spot.farthest() + samples.spacing)],
            Rim::Hole => [0.0, most + near],
        };
        type Found = (Vec<(u32, Point)>, f64);
        let found: Vec<Found> = spot.taken(distances, |(points, beyond): &mut Found, index, [x, y], sample| {
            let open = match sample {
                Sample::Contact => false,
                Sample::Open if rim == Rim::Outer => true,
                Sample::Hole if rim == Rim::Hole => true,
                _ => return,
            };
            let r = (x * x + y * y).sqrt();
            let angles = y.atan2(x) * (ANGLES as f64 / TAU);
            let place = if angles < 0.0 { angles + ANGLES as f64 } else { angles };
            // Rounding may make it the full angle.
            let angle = (place as u32).min(ANGLES as u32 - 1);
            let mut point = Point { r, angle, part: place - f64::from(angle), value: 0.0 };
            let distance = beside.distance(&point, &beside.radii);
            if distance.abs() < near {
                point.value = if open { samples.opening(index) } else { samples.pressure[index] };
                let sector = if point.part < 0.5 { angle } else { (angle + 1) % ANGLES as u32 };
                points.push((2 * sector + u32::from(open), point));
            } else if !open {
                *beyond = beyond.max(distance);
            }
        });
        let mut starts = vec![0; 2 * ANGLES + 1];
        found.iter().flat_map(|(points, _)| points).for_each(|(side, _)| starts[*side as usize + 1] += 1);
        (1..starts.len()).for_each(|k| starts[k] += starts[k - 1]);
        let mut next = starts.clone();
        let mut points = vec![Point::default(); starts[2 * ANGLES]];
        for (side, point) in found.iter().flat_map(|(points, _)| points) {
            points[next[*side as usize]] = *point;
            next[*side as usize] += 1;
        }
        self.beyond = found.iter().fold(0.0, |most, (_, beyond)| most.max(*beyond));
        self.filled = (0..ANGLES).filter(|sector| starts[2 * sector] < starts[2 * sector + 2]).collect();
        (self.starts, self.points) = (starts, points);
    }
}

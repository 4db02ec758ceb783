//! The path of the stresses along a line: which states follow one another, and the largest values between the samples.
//!
//! Past an isolated contact a path comes from rest and goes there. A point of an elastic counterbody stays under the contact: its path is
//! that of loading and unloading, from rest to the stresses of the step. On edges of contact there are states between the samples. Between
//! samples maxima are those of parabolas.

use super::chord::{Chord, distance, longest_chord};
use super::line_plane::LineStresses;
use super::sliding_path::SlidingPath;
use super::tensor::StressState;
use crate::numeric::search::first_largest;

/// The value of a measure along a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LineValue {
    pub value: f64,
    /// Place x, y where the stresses are most extreme, lengths.
    pub place: [f64; 2],
    /// Largest change of the value by stresses farther from an isolated contact than the samples, a pressure.
    pub beyond: f64,
    /// Rise of the value where those of all cycles rise by one.
    pub gain: f64,
}

/// Stresses along a line, and what they are compared with.
#[derive(Debug)]
pub(super) struct LinePath<'a> {
    pub stresses: &'a LineStresses,
    pub path: SlidingPath,
    /// Number of the samples that follow one another; others stand behind them, on edges of contact.
    pub ordered: usize,
    /// Numbers of the samples that are farthest from an isolated contact, before and behind it.
    pub border: [usize; 2],
    /// Number of samples from one end of a line to the other: fewer where all of a plane is one path.
    pub run: usize,
    /// Position of each sample behind the ordered ones: the number of that before it on the path, with the part of the
    /// way to the next.
    pub edges: Vec<f64>,
    /// Times that a pass goes along the path, in one way.
    pub times: f64,
    /// The way back, where the counterbody goes to and fro.
    pub back: Option<&'a LinePath<'a>>,
    /// Whether stresses vary slowly from sample to sample.
    pub is_smooth: bool,
    /// The state without load.
    pub rest: StressState,
    /// Whether the body is swept by the contact; else it is loaded and unloaded.
    pub is_swept: bool,
}

/// Excess of the top of the parabola through three values over the middle one, none of the others being higher, and its
/// place.
pub(super) fn top([before, middle, after]: [f64; 3]) -> (f64, f64) {
    let (slope, curvature) = (0.5 * (after - before), 2.0 * middle - before - after);
    if before <= middle && after <= middle && curvature > 0.0 {
        (0.5 * slope * slope / curvature, slope / curvature)
    } else {
        (0.0, 0.0)
    }
}

impl LinePath<'_> {
    /// Whether the state of rest belongs to the path.
    pub fn comes_from_rest(&self) -> bool {
        self.path == SlidingPath::FromFarAway || !self.is_swept
    }

    /// Samples before and behind one along its line; `None` at the borders of windows, on edges of contact, and near the surface in the window.
    pub fn along(&self, k: usize) -> Option<[usize; 2]> {
        let (run, [before, behind]) = (self.run, self.stresses.outside);
        let is_outside = k < before || k + behind >= self.ordered;
        if !(self.is_smooth || is_outside) || k >= self.ordered || run < 3 {
            return None;
        }
        let (from, index) = (k / run * run, k % run);
        let is_at_seam = || self.stresses.seams.iter().any(|&seam| k == seam || k + 1 == seam);
        let is_border = self.path == SlidingPath::FromFarAway && (index == 0 || index + 1 == run || is_at_seam());
        (!is_border).then(|| [from + (index + run - 1) % run, from + (index + 1) % run])
    }

    /// Samples before and behind one, along the line and, where all of a plane is one path, across it.
    fn beside(&self, k: usize) -> impl Iterator<Item = [usize; 2]> {
        let run = self.run;
        let is_inner = self.path == SlidingPath::WholePlane && run <= k && k + run < self.ordered;
        let across = (is_inner && self.is_smooth).then(|| [k - run, k + run]);
        self.along(k).into_iter().chain(across)
    }

    /// Excess of the values between the samples over that of sample `k`, the largest one beside it, and the place of
    /// the maximum.
    fn summit(&self, k: usize, value: impl Fn(usize) -> f64) -> (f64, [f64; 2]) {
        let place = self.stresses.places[k];
        let (mut rise, mut moved) = (0.0, place);
        for [before, after] in self.beside(k) {
            let (excess, offset) = top([value(before), value(k), value(after)]);
            rise += excess;
            // A neighbour across the border of the cell is left out: places there jump.
            let next = if offset < 0.0 { before } else { after };
            let [x, y] = [0, 1].map(|axis| self.stresses.places[next][axis] - place[axis]);
            let other = if offset < 0.0 { after } else { before };
            let [u, v] = [0, 1].map(|axis| place[axis] - self.stresses.places[other][axis]);
            if (x - u).hypot(y - v) <= 1e-6 * x.hypot(y) {
                moved = [moved[0] + offset.abs() * x, moved[1] + offset.abs() * y];
            }
        }
        (rise, moved)
    }

    /// The largest of values of the samples, between them too.
    pub fn largest(&self, value: impl Fn(usize) -> f64) -> LineValue {
        let (k, most) = first_largest((0..self.stresses.places.len()).map(&value)).unwrap_or((0, f64::NAN));
        // A sample beside it may be larger by rounding.
        let beside = self.along(k).into_iter().flatten();
        let (k, most) = beside.map(|k| (k, value(k))).fold((k, most), |a, b| if b.1 > a.1 { b } else { a });
        let (rise, place) = self.summit(k, value);
        LineValue { value: most + rise, place, beyond: 0.0, gain: 1.0 }
    }

    /// The longest chord of a path of points, each a sample or, the last one, the state of rest; its length between the samples too,
    /// and its ends.
    pub fn chord<const D: usize>(&self, points: &[[f64; D]]) -> Chord {
        let Chord { ends, length } = longest_chord(points);
        let rise = |k: usize, other: usize| {
            if k < self.stresses.places.len() {
                self.summit(k, |k| distance(&points[k], &points[other])).0
            } else {
                0.0
            }
        };
        Chord { ends, length: length + rise(ends[0], ends[1]) + rise(ends[1], ends[0]) }
    }

    /// Place of that end of a chord at which a value is larger.
    pub fn place_of_end(&self, ends: [usize; 2], value: impl Fn(usize) -> f64) -> [f64; 2] {
        let samples = ends.into_iter().filter(|&k| k < self.stresses.places.len());
        let larger = samples.reduce(|a, b| if value(b) > value(a) { b } else { a });
        self.stresses.places[larger.unwrap_or(0)]
    }

    /// Whether a sample is one of the farthest from an isolated contact.
    pub fn is_at_border(&self, k: usize) -> bool {
        self.border.contains(&k)
    }

    /// The larger of the values at the samples that are farthest from an isolated contact.
    pub fn at_border(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.border.into_iter().map(value).fold(0.0, f64::max)
    }

    /// Whether a value may rise farther away above the `most` on the path: where that is the value at rest or at the farthest samples.
    pub fn may_rise_beyond(&self, most: f64, value: impl Fn(usize) -> f64, at_rest: f64) -> bool {
        most <= self.border.into_iter().map(value).fold(at_rest, f64::max)
    }
}

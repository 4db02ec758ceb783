//! Measures of the stresses along a path: what fatigues a material or an interface.
//!
//! - the **range** of the principal shear stress: that of one cycle that does the damage of all cycles along the path, counted by
//!   [rainflow](super::rainflow). Of one cycle it is Δτ₁ = max τ₁ − min τ₁;
//! - the range of the **shear traction** (σ_xz, σ_yz) of an interface, in the same sense: cycles of its component in that direction in
//!   which they do the most damage, with its sign, so that a shear that reverses counts twice. Of one cycle it is the longest chord of
//!   the path;
//! - **Crossland**: of the deviator s, in the norm √(½ s:s), half the longest chord of its path, and the largest hydrostatic stress;
//! - **Dang Van**: the largest of τ_a + 3(τ₋₁/σ₋₁ − ½) σ_H along the path, τ_a the shear stress of the deviator about the centre of
//!   the smallest ball around its path.
//!
//! A pass holds as many cycles as the path has maxima: those of the levels of a cell count apart. Where the counterbody goes to and fro
//! the way back follows the way there. A point of an elastic counterbody stays under the contact: its path is that of loading and
//! unloading, from rest to the stresses of the step. Between samples maxima and minima are those of parabolas.

use super::chord::{Chord, distance, longest_chord};
use super::enclosing_ball::Ball;
use super::line_plane::LineStresses;
use super::rainflow::{Cycles, Equivalent};
use super::sliding_path::SlidingPath;
use super::tensor::StressState;
use crate::body::Endurance;
use crate::numeric::search::first_largest;
use std::f64::consts::{PI, TAU};

/// Directions of a traction that are compared, and halvings of the angle between them about the best.
const DIRECTIONS: usize = 8;
const HALVINGS: usize = 5;

/// A measure of the stresses along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PathMeasure {
    /// Range of τ₁ by a law of this exponent, a pressure.
    Range(f64),
    /// Range of the shear traction on a plane of constant depth by a law of this exponent, a pressure.
    ShearRange(f64),
    /// Utilisation of Crossland's criterion.
    Crossland(Endurance),
    /// Utilisation of Dang Van's criterion.
    DangVan(Endurance),
}

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

impl PathMeasure {
    /// Rise of the measure when the stresses along a path rise by a pressure.
    pub fn rise(self, by: f64) -> f64 {
        match self {
            Self::Range(_) | Self::ShearRange(_) => by,
            Self::Crossland(endurance) => endurance.crossland(by, by),
            Self::DangVan(endurance) => endurance.dang_van(by, by),
        }
    }

    /// Value of the measure along a line of at least one sample.
    pub fn along(self, line: &LinePath<'_>) -> LineValue {
        match self {
            Self::Range(exponent) => line.range(exponent),
            Self::ShearRange(exponent) => line.shear_range(exponent),
            Self::Crossland(endurance) => line.crossland(endurance),
            Self::DangVan(endurance) => line.dang_van(endurance),
        }
    }
}

/// The deviator in an orthonormal basis of the norm √(½ s:s).
fn deviator(state: &StressState) -> [f64; 5] {
    let StressState { xx, yy, zz, xy, xz, yz, .. } = *state;
    [0.5 * (xx - yy), (2.0 * zz - xx - yy) / 12f64.sqrt(), xy, xz, yz]
}

/// The stress whose deviator it is, without a mean.
fn of_deviator([across, along, xy, xz, yz]: [f64; 5]) -> StressState {
    let third = along / 3f64.sqrt();
    StressState { xx: across - third, yy: -across - third, zz: 2.0 * third, xy, xz, yz, ..StressState::default() }
}

fn hydrostatic(state: &StressState) -> f64 {
    (state.xx + state.yy + state.zz) / 3.0
}

/// Excess of the top of the parabola through three values over the middle one, none of the others being higher, and its
/// place.
fn top([before, middle, after]: [f64; 3]) -> (f64, f64) {
    let (slope, curvature) = (0.5 * (after - before), 2.0 * middle - before - after);
    if before <= middle && after <= middle && curvature > 0.0 {
        (0.5 * slope * slope / curvature, slope / curvature)
    } else {
        (0.0, 0.0)
    }
}

impl LinePath<'_> {
    fn comes_from_rest(&self) -> bool {
        self.path == SlidingPath::FromFarAway || !self.is_swept
    }

    /// Samples before and behind one along its line; `None` at the borders of windows, on edges of contact, and near the surface in the window.
    fn along(&self, k: usize) -> Option<[usize; 2]> {
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
    fn largest(&self, value: impl Fn(usize) -> f64) -> LineValue {
        let (k, most) = first_largest((0..self.stresses.places.len()).map(&value)).unwrap_or((0, f64::NAN));
        // A sample beside it may be larger by rounding.
        let beside = self.along(k).into_iter().flatten();
        let (k, most) = beside.map(|k| (k, value(k))).fold((k, most), |a, b| if b.1 > a.1 { b } else { a });
        let (rise, place) = self.summit(k, value);
        LineValue { value: most + rise, place, beyond: 0.0, gain: 1.0 }
    }

    /// Numbers of the samples of a line, by its number, in the order in which they are met, those on edges of contact among them.
    fn met(&self, run: usize) -> Vec<usize> {
        let samples = run * self.run..((run + 1) * self.run).min(self.ordered);
        let is_within = |position: f64| (position as usize) >= samples.start && (position as usize) < samples.end;
        let mut edges: Vec<(f64, usize)> = self.edges.iter().copied().zip(self.ordered..).collect();
        edges.retain(|(position, _)| is_within(*position));
        let mut all: Vec<(f64, usize)> = samples.map(|k| (k as f64, k)).chain(edges).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.into_iter().map(|(_, k)| k).collect()
    }

    /// Values met along a line, by its number, at least `least`; a maximum or a minimum is that of a parabola. The value at rest stands
    /// before them where the path comes from there.
    fn sequence(&self, run: usize, rest: f64, least: f64, value: &impl Fn(&Self, usize) -> f64) -> Vec<f64> {
        let turned = |k: usize| {
            let middle = value(self, k);
            let Some([before, after]) = self.along(k) else { return middle };
            let three = [value(self, before), middle, value(self, after)];
            (middle + top(three).0 - top(three.map(|x| -x)).0).max(least)
        };
        let rest = self.comes_from_rest().then_some(rest);
        rest.into_iter().chain(self.met(run).into_iter().map(turned)).collect()
    }

    /// The one cycle that does the damage of a pass, by the cycles of a value that is `rest` without load and at least `least`.
    fn counted(&self, exponent: f64, [rest, least]: [f64; 2], value: &impl Fn(&Self, usize) -> f64) -> Equivalent {
        let mut cycles = Cycles::default();
        let runs = self.ordered.div_ceil(self.run.max(1));
        let times = self.times / runs.max(1) as f64;
        for run in 0..runs {
            let there = self.sequence(run, rest, least, value);
            let Some(back) = self.back else {
                cycles.count(&there, times);
                continue;
            };
            let of_back = back.sequence(run, rest, least, value);
            // Once the last cycle there and the first one back are one.
            let joined = times.min(1.0 / runs as f64);
            for way in [&there, &of_back] {
                cycles.count(way, times - joined);
            }
            cycles.count(&self.there_and_back(run, there, (back, of_back)), joined);
        }
        cycles.equivalent(exponent)
    }

    /// Values along a line and back: from rest to rest, or where it closes for the point that is passed last with the largest value.
    fn there_and_back(&self, run: usize, mut there: Vec<f64>, (back, mut of_back): (&Self, Vec<f64>)) -> Vec<f64> {
        if !self.comes_from_rest() {
            let most = first_largest(there.iter().copied()).map_or(0, |(most, _)| most);
            let number = self.met(run)[most];
            let sample = number.checked_sub(self.ordered).map_or(number, |edge| self.edges[edge] as usize);
            let same = back.met(run).iter().position(|k| *k == sample).unwrap_or(0);
            there.rotate_left(most);
            of_back.rotate_left(same);
        }
        // Each way ends as it begins.
        for way in [&mut there, &mut of_back] {
            way.extend_from_within(..1);
        }
        there.into_iter().chain(of_back.into_iter().rev()).collect()
    }

    fn range(&self, exponent: f64) -> LineValue {
        let (tau1, rest) = (&self.stresses.tau1, self.rest.tau1());
        if !self.is_swept {
            return self.largest(|k| (tau1[k] - rest).abs());
        }
        let (high, low) = (self.largest(|k| tau1[k]), self.largest(|k| -tau1[k]));
        let [most, least] = [high.value, (-low.value).max(0.0)];
        let Equivalent { range, gain } = self.counted(exponent, [rest, 0.0], &|path, k| path.stresses.tau1[k]);
        if !self.comes_from_rest() {
            return LineValue { value: range, gain, ..high };
        }
        // Where the extreme is that of rest, stresses farther away may pass it by as much as they differ from it at the farthest samples.
        let away = self.at_border(|k| (tau1[k] - rest).abs());
        let is_extreme = rest > 0.0 && (rest >= most || rest <= least);
        let place = if rest > most { low.place } else { high.place };
        LineValue { value: range, place, beyond: if is_extreme { away } else { 0.0 }, gain }
    }

    /// The longest chord of a path of points, each a sample or, the last one, the state of rest; its length between the samples too,
    /// and its ends.
    fn chord<const D: usize>(&self, points: &[[f64; D]]) -> Chord {
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
    fn place_of_end(&self, ends: [usize; 2], value: impl Fn(usize) -> f64) -> [f64; 2] {
        let samples = ends.into_iter().filter(|&k| k < self.stresses.places.len());
        let larger = samples.reduce(|a, b| if value(b) > value(a) { b } else { a });
        self.stresses.places[larger.unwrap_or(0)]
    }

    fn shear_range(&self, exponent: f64) -> LineValue {
        let shear = &self.stresses.shear;
        let size = |k: usize| shear[k][0].hypot(shear[k][1]);
        if !self.is_swept {
            return self.largest(size);
        }
        let rest = self.comes_from_rest().then_some([0.0; 2]);
        let points: Vec<[f64; 2]> = shear.iter().copied().chain(rest).collect();
        let Chord { ends, .. } = longest_chord(&points);
        let place = self.place_of_end(ends, size);
        let back = self.back.map_or(&[][..], |path| &path.stresses.shear);
        let all: Vec<[f64; 2]> = points.iter().chain(back).copied().collect();
        let Chord { ends: [from, to], length } = longest_chord(&all);
        if !(length > 0.0 && length.is_finite()) {
            return LineValue { value: length, place, beyond: 0.0, gain: 1.0 };
        }
        let angle = (all[to][1] - all[from][1]).atan2(all[to][0] - all[from][0]);
        let toward = |angle: f64| {
            let (sine, cosine) = angle.sin_cos();
            let part =
                move |path: &Self, k: usize| path.stresses.shear[k][0] * cosine + path.stresses.shear[k][1] * sine;
            self.counted(exponent, [0.0, f64::NEG_INFINITY], &part)
        };
        // There and back the join lies elsewhere in the opposite direction.
        let turn = if self.back.is_some() { TAU } else { PI };
        let Equivalent { range, gain } = most_damaging(angle, turn, toward);
        LineValue { value: range, place, beyond: 0.0, gain }
    }

    /// Deviators of the samples, and of rest where the path comes from there.
    fn deviators(&self) -> Vec<[f64; 5]> {
        let rest = self.comes_from_rest().then_some(&self.rest);
        self.stresses.stress.iter().chain(rest).map(deviator).collect()
    }

    fn crossland(&self, endurance: Endurance) -> LineValue {
        let (stress, at_rest) = (&self.stresses.stress, hydrostatic(&self.rest));
        if !self.is_swept {
            let rest = deviator(&self.rest);
            return self.largest(|k| {
                let amplitude = 0.5 * distance(&deviator(&stress[k]), &rest);
                endurance.crossland(amplitude, hydrostatic(&stress[k]).max(at_rest))
            });
        }
        let points = self.deviators();
        let Chord { ends, length } = self.chord(&points);
        let mut pressed = self.largest(|k| hydrostatic(&stress[k])).value;
        let mut beyond = 0.0;
        if self.comes_from_rest() {
            pressed = pressed.max(at_rest);
            if self.may_rise_beyond(pressed, |k| hydrostatic(&stress[k]), at_rest) {
                beyond = self.at_border(|k| (hydrostatic(&stress[k]) - at_rest).abs());
            }
            let rest = deviator(&self.rest);
            if ends.iter().any(|&k| k == stress.len() || self.is_at_border(k)) {
                beyond = beyond.max(self.at_border(|k| 0.5 * distance(&points[k], &rest)));
            }
        }
        let size = |k: usize| points[k].iter().map(|x| x * x).sum::<f64>();
        let place = self.place_of_end(ends, size);
        LineValue { value: endurance.crossland(0.5 * length, pressed), place, beyond, gain: 1.0 }
    }

    /// Whether a sample is one of the farthest from an isolated contact.
    fn is_at_border(&self, k: usize) -> bool {
        self.border.contains(&k)
    }

    /// The larger of the values at the samples that are farthest from an isolated contact.
    fn at_border(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.border.into_iter().map(value).fold(0.0, f64::max)
    }

    /// Whether a value may rise farther away above the `most` on the path: where that is the value at rest or at the farthest samples.
    fn may_rise_beyond(&self, most: f64, value: impl Fn(usize) -> f64, at_rest: f64) -> bool {
        most <= self.border.into_iter().map(value).fold(at_rest, f64::max)
    }

    fn dang_van(&self, endurance: Endurance) -> LineValue {
        let (stress, at_rest) = (&self.stresses.stress, hydrostatic(&self.rest));
        let shear_about =
            |centre: &[f64; 5], point: &[f64; 5]| of_deviator(std::array::from_fn(|k| point[k] - centre[k])).tau1();
        if !self.is_swept {
            let rest = deviator(&self.rest);
            return self.largest(|k| {
                let amplitude = 0.5 * shear_about(&rest, &deviator(&stress[k]));
                endurance.dang_van(amplitude, hydrostatic(&stress[k]).max(at_rest))
            });
        }
        let points = self.deviators();
        let Ball { centre, .. } = Ball::around(&points);
        let value = |k: usize| endurance.dang_van(shear_about(&centre, &points[k]), hydrostatic(&stress[k]));
        let largest = self.largest(value);
        if !self.comes_from_rest() {
            return largest;
        }
        let rest = deviator(&self.rest);
        let of_rest = endurance.dang_van(shear_about(&centre, &rest), at_rest);
        let most = largest.value.max(of_rest);
        let beyond = match self.may_rise_beyond(most, value, of_rest) {
            true => self.at_border(|k| (hydrostatic(&stress[k]) - at_rest).abs().max(distance(&points[k], &rest))),
            false => 0.0,
        };
        LineValue { value: most, beyond, ..largest }
    }
}

/// The longest cycle of all directions within a `turn`, from the first one on, which has that of a single cycle.
fn most_damaging(first: f64, turn: f64, toward: impl Fn(f64) -> Equivalent) -> Equivalent {
    let mut apart = PI / DIRECTIONS as f64;
    let mut best = (first, toward(first));
    let longer = |best: (f64, Equivalent), angle: f64| {
        let cycle = toward(angle);
        if cycle.range > best.1.range { (angle, cycle) } else { best }
    };
    for k in 1..(turn / apart).round() as usize {
        best = longer(best, first + apart * k as f64);
    }
    for _ in 0..HALVINGS {
        apart *= 0.5;
        let middle = best.0;
        best = [-apart, apart].into_iter().fold(best, |best, by| longer(best, middle + by));
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(measure: PathMeasure, states: &[StressState], path: SlidingPath, is_swept: bool) -> f64 {
        let stresses = LineStresses {
            places: (0..states.len()).map(|k| [k as f64, 0.0]).collect(),
            tau1: states.iter().map(StressState::tau1).collect(),
            shear: states.iter().map(|state| [state.xz, state.yz]).collect(),
            stress: states.to_vec(),
            ..LineStresses::default()
        };
        measure.along(&path_of(&stresses, path, is_swept)).value
    }

    fn path_of(stresses: &LineStresses, path: SlidingPath, is_swept: bool) -> LinePath<'_> {
        let (run, rest) = (stresses.places.len(), StressState::default());
        let (ordered, edges, times, back, is_smooth) = (run, Vec::new(), 1.0, None, true);
        let border = [0, run - 1];
        LinePath { stresses, path, ordered, border, run, edges, times, back, is_smooth, rest, is_swept }
    }

    const CLOSED: SlidingPath = SlidingPath::LatticeVector([1, 0]);

    fn cycle(of: impl Fn(f64, f64) -> StressState) -> Vec<StressState> {
        (0..96).map(|k| (TAU * f64::from(k) / 96.0).sin_cos()).map(|(sine, cosine)| of(sine, cosine)).collect()
    }

    /// Alternating torsion and bending at their own limits, and bending from zero, with twice the hydrostatic stress of half the
    /// amplitude: all are proportional paths, whose chord and ball are those of a line.
    #[test]
    fn proportional_paths_have_the_utilisations_of_their_amplitude() {
        let (torsion, bending) = (0.29, 0.45);
        let endurance = Endurance::new(torsion, bending).unwrap();
        let [crossland, dang_van] = [PathMeasure::Crossland(endurance), PathMeasure::DangVan(endurance)];
        let twisted = cycle(|_, cosine| StressState { xz: torsion * cosine, ..StressState::default() });
        let bent = cycle(|_, cosine| StressState { xx: bending * cosine, ..StressState::default() });
        // Where two principal stresses are equal τ₁ has the root of rounding.
        let within = |measure: PathMeasure| if measure == crossland { 1e-13 } else { 1e-7 };
        for measure in [crossland, dang_van] {
            for states in [&twisted, &bent] {
                assert!((along(measure, states, CLOSED, true) - 1.0).abs() < within(measure), "{measure:?}");
            }
        }
        let pulsating = cycle(|_, cosine| StressState { xx: 0.5 * bending * (1.0 + cosine), ..StressState::default() });
        let half = 0.5 * bending;
        let known = endurance.crossland(half / 3f64.sqrt(), bending / 3.0);
        assert!((along(crossland, &pulsating, CLOSED, true) - known).abs() < 1e-13);
        let known = endurance.dang_van(0.5 * half, bending / 3.0);
        assert!((along(dang_van, &pulsating, CLOSED, true) - known).abs() < within(dang_van));
        // Loading and unloading is the same cycle.
        for measure in [crossland, dang_van] {
            let [swept, loaded] = [true, false].map(|is_swept| along(measure, &pulsating, CLOSED, is_swept));
            assert!((swept - loaded).abs() < within(measure), "{measure:?}: {swept}, {loaded}");
        }
    }

    /// Torsion that turns: the deviator runs on a circle of the radius τ about a middle that does not matter. Its chord is 2τ, its
    /// ball that of the circle, and the shear stress about the middle τ at every moment.
    #[test]
    fn on_a_circle_of_deviators_the_amplitude_is_its_radius() {
        let endurance = Endurance::new(1.0, 1.6).unwrap();
        let states = cycle(|sine, cosine| StressState {
            xz: 0.7 * cosine + 5.0,
            yz: 0.7 * sine,
            xx: -1.0,
            ..StressState::default()
        });
        let pressed = -1.0 / 3.0;
        let known = [endurance.crossland(0.7, pressed), endurance.dang_van(0.7, pressed), 1.4];
        let measures =
            [PathMeasure::Crossland(endurance), PathMeasure::DangVan(endurance), PathMeasure::ShearRange(6.0)];
        for (measure, known) in measures.into_iter().zip(known) {
            let found = along(measure, &states, CLOSED, true);
            assert!((found - known).abs() < 1e-12, "{measure:?}: {found}, {known}");
        }
    }

    /// A shear that reverses has τ₁ from 0 to τ and a range of 2τ of the traction; from far away rest belongs to it.
    #[test]
    fn a_shear_that_reverses_counts_twice_as_a_traction() {
        let states = cycle(|_, cosine| StressState { xz: cosine, ..StressState::default() });
        assert!((along(PathMeasure::ShearRange(6.0), &states, CLOSED, true) - 2.0).abs() < 1e-13);
        // τ₁ rises twice from 0 to 1.
        let twice = along(PathMeasure::Range(6.0), &states, CLOSED, true) / 2f64.powf(1.0 / 6.0);
        assert!((twice - 1.0).abs() < 1e-13, "{twice}");
        let pressed = cycle(|_, cosine| StressState { xz: 2.0 + cosine, ..StressState::default() });
        let range = |path: SlidingPath, is_swept: bool| along(PathMeasure::Range(6.0), &pressed, path, is_swept);
        // From far away τ₁ rises from 0 to 3, falls to 1 and rises again: a cycle of 3 and one of 2, less h²/2 = 2e-3 as it ends a sample before.
        let both = (3f64.powi(6) + 2f64.powi(6)).powf(1.0 / 6.0);
        let from_far = range(SlidingPath::FromFarAway, true);
        assert!((range(CLOSED, true) - 2.0).abs() < 1e-13 && (from_far - both).abs() < 2e-3, "{from_far}");
        assert!((range(CLOSED, false) - 3.0).abs() < 1e-13);
    }

    /// The maximum lies between two samples: a parabola leaves the fourth order, (h/2)⁴/24 and less of a cosine with the step h.
    #[test]
    fn extremes_between_samples_are_those_of_parabolas() {
        let h = TAU / 96.0;
        let states: Vec<StressState> = (0..96)
            .map(|k| StressState { xz: 2.0 + ((f64::from(k) + 0.4) * h).cos(), ..StressState::default() })
            .collect();
        let off = along(PathMeasure::Range(6.0), &states, CLOSED, true) - 2.0;
        assert!(off.abs() < h.powi(4) / 24.0, "{off:e}");
    }

    /// A shear from −1 to 2 on the way there and from −2 to 1 back: each way has a range of 3, and where they join there is one of 4; an
    /// edge of contact counts where it lies.
    #[test]
    fn there_and_back_the_signs_of_both_ways_count() {
        let of = |states: &[StressState]| LineStresses {
            places: (0..states.len()).map(|k| [k as f64, 0.0]).collect(),
            tau1: states.iter().map(StressState::tau1).collect(),
            shear: states.iter().map(|state| [state.xz, state.yz]).collect(),
            ..LineStresses::default()
        };
        let wave =
            |sign: f64| cycle(|_, cosine| StressState { yz: sign * (0.5 + 1.5 * cosine), ..StressState::default() });
        let [there, back] = [1.0, -1.0].map(|sign| of(&wave(sign)));
        let back = path_of(&back, CLOSED, true);
        let measure = PathMeasure::ShearRange(4.0);
        for times in [1.0, 5.0] {
            let path = LinePath { times, back: Some(&back), ..path_of(&there, CLOSED, true) };
            let known = 4f64.powi(4) + 2.0 * times * 3f64.powi(4);
            let found = measure.along(&path).value;
            // Where the ways join the last samples are a step h before the extremes: 1.5 (1 − cos h) less of a range, twice.
            let step = TAU / 96.0;
            assert!((found / known.powf(0.25) - 1.0).abs() < 0.75 * step * step, "{found}");
        }
        let mut states = wave(1.0);
        states.push(StressState { yz: 3.0, ..StressState::default() });
        let stresses = of(&states);
        let path = LinePath { ordered: 96, run: 96, edges: vec![0.5], ..path_of(&stresses, CLOSED, true) };
        assert!((measure.along(&path).value - 4.0).abs() < 1e-12, "an edge at the maximum makes it higher");
        let path = LinePath { edges: vec![48.5], ..path };
        // Behind it the shear goes on from the sample behind the minimum.
        let low = 0.5 + 1.5 * (TAU * 49.0 / 96.0).cos();
        let known = (4f64.powi(4) + (2.0 - low).powi(4)).powf(0.25);
        assert!((measure.along(&path).value / known - 1.0).abs() < 1e-12, "at the minimum it is a cycle of itself");
    }

    #[test]
    fn a_deviator_is_read_back_from_its_coordinates() {
        let state = StressState { xx: 1.0, yy: -2.0, zz: 4.0, xy: 0.3, xz: -0.7, yz: 1.1, ..StressState::default() };
        let coordinates = deviator(&state);
        let size: f64 = coordinates.iter().map(|x| x * x).sum();
        assert!((size - state.invariants().1).abs() < 1e-13);
        let back = of_deviator(coordinates);
        assert!((back.xx - (state.xx - 1.0)).abs() < 1e-14 && (back.zz - 3.0).abs() < 1e-14 && back.yz == 1.1);
    }
}

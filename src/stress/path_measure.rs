//! Measures of the stresses along a path: what fatigues a material or an interface.
//!
//! - the **range** of the principal shear stress, Δτ₁ = max τ₁ − min τ₁ along the path;
//! - the range of the **shear traction** of an interface: the longest chord of the path of (σ_xz, σ_yz), so that a shear that
//!   reverses counts twice;
//! - **Crossland**: of the deviator s, in the norm √(½ s:s), half the longest chord of its path, and the largest hydrostatic stress;
//! - **Dang Van**: the largest of τ_a + 3(τ₋₁/σ₋₁ − ½) σ_H along the path, τ_a the shear stress of the deviator about the centre of
//!   the smallest ball around its path.
//!
//! One period, or one pass of an isolated contact, counts as one cycle: several maxima along a path, of the levels of a cell, are not
//! counted apart. A point of an elastic counterbody stays under the contact: its path is that of loading and unloading, from rest to
//! the stresses of the step. Between samples maxima and minima are those of parabolas.

use super::chord::{Chord, distance, longest_chord};
use super::enclosing_ball::Ball;
use super::line_plane::LineStresses;
use super::sliding_path::SlidingPath;
use super::tensor::StressState;
use crate::body::Endurance;
use crate::numeric::search::first_largest;

/// A measure of the stresses along a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PathMeasure {
    /// Range of τ₁, a pressure.
    Range,
    /// Range of the shear traction on a plane of constant depth, a pressure.
    ShearRange,
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
    /// By how much stresses beyond the window of an isolated contact may change it, a pressure.
    pub beyond: f64,
}

/// Stresses along a line, and what they are compared with.
#[derive(Debug)]
pub(super) struct LinePath<'a> {
    pub stresses: &'a LineStresses,
    pub path: SlidingPath,
    /// Number of the samples that follow one another; others stand behind them.
    pub ordered: usize,
    /// Samples in a row of them, which follow one another across the line too where all of a plane is one path.
    pub columns: usize,
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
            Self::Range | Self::ShearRange => by,
            Self::Crossland(own) => own.crossland(by, by),
            Self::DangVan(own) => own.dang_van(by, by),
        }
    }

    /// Its value along a line of at least one sample.
    pub fn along(self, line: &LinePath<'_>) -> LineValue {
        match self {
            Self::Range => line.range(),
            Self::ShearRange => line.shear_range(),
            Self::Crossland(own) => line.crossland(own),
            Self::DangVan(own) => line.dang_van(own),
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

/// By how much the top of the parabola through three values exceeds the middle one, none of the others being higher, and its place.
fn top([before, own, after]: [f64; 3]) -> (f64, f64) {
    let (slope, curvature) = (0.5 * (after - before), 2.0 * own - before - after);
    if before <= own && after <= own && curvature > 0.0 {
        (0.5 * slope * slope / curvature, slope / curvature)
    } else {
        (0.0, 0.0)
    }
}

impl LinePath<'_> {
    fn comes_from_rest(&self) -> bool {
        self.path == SlidingPath::FromFarAway || !self.is_swept
    }

    /// Samples before and behind one, along the line and, where all of a plane is one path, across it.
    fn beside(&self, k: usize) -> Vec<[usize; 2]> {
        let n = self.ordered;
        if !self.is_smooth || k >= n || n < 3 {
            return Vec::new();
        }
        let by = |step: usize| [(k + n - step) % n, (k + step) % n];
        match self.path {
            SlidingPath::LatticeVector(_) => vec![by(1)],
            SlidingPath::FromFarAway if k == 0 || k + 1 == n => Vec::new(),
            SlidingPath::FromFarAway => vec![[k - 1, k + 1]],
            SlidingPath::WholePlane => {
                let columns = self.columns;
                let (row, column) = (k / columns * columns, k % columns);
                vec![[row + (column + columns - 1) % columns, row + (column + 1) % columns], by(columns)]
            }
        }
    }

    /// By how much the values between the samples exceed that of sample `k`, the largest one beside it, and the place of the maximum.
    fn summit(&self, k: usize, value: impl Fn(usize) -> f64) -> (f64, [f64; 2]) {
        let place = self.stresses.places[k];
        let (mut rise, mut moved) = (0.0, place);
        for [before, after] in self.beside(k) {
            let (own, offset) = top([value(before), value(k), value(after)]);
            rise += own;
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
        let (rise, place) = self.summit(k, value);
        LineValue { value: most + rise, place, beyond: 0.0 }
    }

    fn range(&self) -> LineValue {
        let (tau1, rest) = (&self.stresses.tau1, self.rest.tau1());
        if !self.is_swept {
            return self.largest(|k| (tau1[k] - rest).abs());
        }
        let (high, low) = (self.largest(|k| tau1[k]), self.largest(|k| -tau1[k]));
        let [most, least] = [high.value, (-low.value).max(0.0)];
        if !self.comes_from_rest() {
            return LineValue { value: most - least, ..high };
        }
        // Where the extreme is that of rest, stresses beyond the window may pass it by as much as they differ from it at its border.
        let ends = [tau1.first(), tau1.get(self.ordered.saturating_sub(1))];
        let away = ends.into_iter().flatten().map(|end| (end - rest).abs()).fold(0.0, f64::max);
        let is_extreme = rest > 0.0 && (rest >= most || rest <= least);
        let place = if rest > most { low.place } else { high.place };
        LineValue { value: most.max(rest) - least.min(rest), place, beyond: if is_extreme { away } else { 0.0 } }
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
        let own = ends.into_iter().filter(|&k| k < self.stresses.places.len());
        let larger = own.reduce(|a, b| if value(b) > value(a) { b } else { a });
        self.stresses.places[larger.unwrap_or(0)]
    }

    fn shear_range(&self) -> LineValue {
        let shear = &self.stresses.shear;
        let size = |k: usize| shear[k][0].hypot(shear[k][1]);
        if !self.is_swept {
            return self.largest(size);
        }
        let rest = self.comes_from_rest().then_some([0.0; 2]);
        let points: Vec<[f64; 2]> = shear.iter().copied().chain(rest).collect();
        let Chord { ends, length } = self.chord(&points);
        LineValue { value: length, place: self.place_of_end(ends, size), beyond: 0.0 }
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
        LineValue { value: endurance.crossland(0.5 * length, pressed), place, beyond }
    }

    /// Whether a sample is the first or the last of the window of an isolated contact.
    fn is_at_border(&self, k: usize) -> bool {
        k == 0 || k + 1 == self.ordered
    }

    /// The larger of the values at the border of the window.
    fn at_border(&self, value: impl Fn(usize) -> f64) -> f64 {
        [0, self.ordered.saturating_sub(1)].into_iter().map(value).fold(0.0, f64::max)
    }

    /// Whether a value may rise beyond the window above the `most` on the path: where that is the value at rest or at the border.
    fn may_rise_beyond(&self, most: f64, value: impl Fn(usize) -> f64, at_rest: f64) -> bool {
        most <= at_rest.max(value(0)).max(value(self.ordered.saturating_sub(1)))
    }

    fn dang_van(&self, endurance: Endurance) -> LineValue {
        let (stress, at_rest) = (&self.stresses.stress, hydrostatic(&self.rest));
        let shear_about =
            |centre: &[f64; 5], own: &[f64; 5]| of_deviator(std::array::from_fn(|k| own[k] - centre[k])).tau1();
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
        let own = self.largest(value);
        if !self.comes_from_rest() {
            return own;
        }
        let rest = deviator(&self.rest);
        let of_rest = endurance.dang_van(shear_about(&centre, &rest), at_rest);
        let most = own.value.max(of_rest);
        let beyond = match self.may_rise_beyond(most, value, of_rest) {
            true => self.at_border(|k| (hydrostatic(&stress[k]) - at_rest).abs().max(distance(&points[k], &rest))),
            false => 0.0,
        };
        LineValue { value: most, beyond, ..own }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn along(measure: PathMeasure, states: &[StressState], path: SlidingPath, is_swept: bool) -> f64 {
        let stresses = LineStresses {
            places: (0..states.len()).map(|k| [k as f64, 0.0]).collect(),
            tau1: states.iter().map(StressState::tau1).collect(),
            shear: states.iter().map(|own| [own.xz, own.yz]).collect(),
            stress: states.to_vec(),
        };
        let (ordered, rest) = (states.len(), StressState::default());
        measure
            .along(&LinePath { stresses: &stresses, path, ordered, columns: ordered, is_smooth: true, rest, is_swept })
            .value
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
        let own = Endurance::new(torsion, bending).unwrap();
        let [crossland, dang_van] = [PathMeasure::Crossland(own), PathMeasure::DangVan(own)];
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
        let known = own.crossland(half / 3f64.sqrt(), bending / 3.0);
        assert!((along(crossland, &pulsating, CLOSED, true) - known).abs() < 1e-13);
        let known = own.dang_van(0.5 * half, bending / 3.0);
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
        let own = Endurance::new(1.0, 1.6).unwrap();
        let states = cycle(|sine, cosine| StressState {
            xz: 0.7 * cosine + 5.0,
            yz: 0.7 * sine,
            xx: -1.0,
            ..StressState::default()
        });
        let pressed = -1.0 / 3.0;
        let known = [own.crossland(0.7, pressed), own.dang_van(0.7, pressed), 1.4];
        let measures = [PathMeasure::Crossland(own), PathMeasure::DangVan(own), PathMeasure::ShearRange];
        for (measure, known) in measures.into_iter().zip(known) {
            let found = along(measure, &states, CLOSED, true);
            assert!((found - known).abs() < 1e-12, "{measure:?}: {found}, {known}");
        }
    }

    /// A shear that reverses has τ₁ from 0 to τ and a range of 2τ of the traction; from far away rest belongs to it.
    #[test]
    fn a_shear_that_reverses_counts_twice_as_a_traction() {
        let states = cycle(|_, cosine| StressState { xz: cosine, ..StressState::default() });
        assert!((along(PathMeasure::ShearRange, &states, CLOSED, true) - 2.0).abs() < 1e-13);
        assert!((along(PathMeasure::Range, &states, CLOSED, true) - 1.0).abs() < 1e-13);
        let pressed = cycle(|_, cosine| StressState { xz: 2.0 + cosine, ..StressState::default() });
        let range = |path: SlidingPath, is_swept: bool| along(PathMeasure::Range, &pressed, path, is_swept);
        assert!(
            (range(CLOSED, true) - 2.0).abs() < 1e-13 && (range(SlidingPath::FromFarAway, true) - 3.0).abs() < 1e-13
        );
        assert!((range(CLOSED, false) - 3.0).abs() < 1e-13);
    }

    /// The maximum lies between two samples: a parabola leaves the fourth order, (h/2)⁴/24 and less of a cosine with the step h.
    #[test]
    fn extremes_between_samples_are_those_of_parabolas() {
        let h = TAU / 96.0;
        let states: Vec<StressState> = (0..96)
            .map(|k| StressState { xz: 2.0 + ((f64::from(k) + 0.4) * h).cos(), ..StressState::default() })
            .collect();
        let off = along(PathMeasure::Range, &states, CLOSED, true) - 2.0;
        assert!(off.abs() < h.powi(4) / 24.0, "{off:e}");
    }

    #[test]
    fn a_deviator_is_read_back_from_its_coordinates() {
        let state = StressState { xx: 1.0, yy: -2.0, zz: 4.0, xy: 0.3, xz: -0.7, yz: 1.1, ..StressState::default() };
        let own = deviator(&state);
        let size: f64 = own.iter().map(|x| x * x).sum();
        assert!((size - state.invariants().1).abs() < 1e-13);
        let back = of_deviator(own);
        assert!((back.xx - (state.xx - 1.0)).abs() < 1e-14 && (back.zz - 3.0).abs() < 1e-14 && back.yz == 1.1);
    }
}

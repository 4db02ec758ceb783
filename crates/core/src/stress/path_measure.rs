//! Measures of the stresses along a path: what fatigues a material or an interface.
//!
//! - the **range** of the principal shear stress: that of one cycle that does the damage of all [cycles](super::line_cycles) along the path.
//!   Of one cycle it is Δτ₁ = max τ₁ − min τ₁;
//! - the range of the **shear traction** (σ_xz, σ_yz) of an interface, in the same sense: cycles of its component in that direction in
//!   which they do the most damage, with its sign, so that a shear that reverses counts twice. Of one cycle it is the longest chord of
//!   the path;
//! - **Crossland**: of the deviator s, in the norm √(½ s:s), half the longest chord of its path, and the largest hydrostatic stress;
//! - **Dang Van**: the largest of τ_a + 3(τ₋₁/σ₋₁ − ½) σ_H along the path, τ_a the shear stress of the deviator about the centre of
//!   the smallest ball around its path.

use super::chord::{Chord, distance, longest_chord};
use super::deviator::{deviator, hydrostatic, of_deviator};
use super::enclosing_ball::Ball;
use super::line_cycles::most_damaging;
use super::line_path::{LinePath, LineValue};
use super::rainflow::Equivalent;
use crate::body::Endurance;
use std::f64::consts::{PI, TAU};

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

impl LinePath<'_> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::line_plane::LineStresses;
    use crate::stress::sliding_path::SlidingPath;
    use crate::stress::tensor::StressState;

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
}

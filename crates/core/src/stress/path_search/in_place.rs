//! Measures at points that stay in place: the path of their stresses is the closed one through the steps of a cycle, along straight lines
//! between their states.

use crate::numeric::search::first_largest;
use crate::stress::line_path::{LinePath, LineValue};
use crate::stress::line_plane::LineStresses;
use crate::stress::path_measure::PathMeasure;
use crate::stress::sliding_path::SlidingPath;
use crate::stress::tensor::StressState;

/// The largest value of a measure at the samples of a line, whose stresses at each step of a cycle are given in the order of the steps.
pub(super) fn measured(measure: PathMeasure, steps: &[LineStresses]) -> LineValue {
    let places = steps.first().map_or(&[][..], |line| &line.places);
    let values = (0..places.len()).map(|k| measure.along(&path(&through(steps, k))));
    let all: Vec<LineValue> = values.collect();
    match first_largest(all.iter().map(|value| value.value)) {
        Some((k, value)) => LineValue { value, place: places[k], ..all[k] },
        None => LineValue { value: 0.0, place: [0.0; 2], beyond: 0.0, gain: 1.0 },
    }
}

/// States on the way from one step to the next: where a shear turns its sign τ₁ is least between them.
const BETWEEN: usize = 4;

/// The stresses of a sample at all steps, and between them.
fn through(steps: &[LineStresses], k: usize) -> LineStresses {
    let states: Vec<StressState> = steps.iter().filter_map(|line| line.stress.get(k).copied()).collect();
    let count = states.len();
    let between = |i: usize| {
        let (from, part) = (i / BETWEEN, (i % BETWEEN) as f64 / BETWEEN as f64);
        states[from].toward(&states[(from + 1) % count], part)
    };
    let stress: Vec<StressState> = (0..BETWEEN * count).map(between).collect();
    let place = steps.first().map_or([0.0; 2], |line| line.places[k]);
    LineStresses {
        places: vec![place; stress.len()],
        tau1: stress.iter().map(StressState::tau1).collect(),
        shear: stress.iter().map(|state| [state.xz, state.yz]).collect(),
        stress,
        ..LineStresses::default()
    }
}

/// The closed path through the states of a point, whose extremes are at its states.
fn path(stresses: &LineStresses) -> LinePath<'_> {
    let count = stresses.places.len();
    LinePath {
        stresses,
        path: SlidingPath::InPlace,
        ordered: count,
        border: [0, count.saturating_sub(1)],
        run: count,
        edges: Vec::new(),
        times: 1.0,
        back: None,
        is_smooth: false,
        rest: StressState::default(),
        is_swept: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Endurance;

    fn line(states: [StressState; 2]) -> LineStresses {
        LineStresses { places: vec![[0.0, 0.0], [1.0, 0.0]], stress: states.to_vec(), ..LineStresses::default() }
    }

    /// The second sample is sheared to and fro by 0.7 beside a constant state; the first one by a tenth of it, but from zero.
    #[test]
    fn a_point_that_is_sheared_to_and_fro_has_the_range_of_both_signs() {
        let state = |xz: f64| StressState { xz, ..StressState::default() };
        let steps: Vec<LineStresses> =
            [0.7, -0.7].map(|xz| line([state(0.07 + 0.1 * xz), state(xz)])).into_iter().collect();
        let value = |measure: PathMeasure| measured(measure, &steps);
        let shear = value(PathMeasure::ShearRange(6.0));
        assert!((shear.value - 1.4).abs() < 1e-14 && shear.place == [1.0, 0.0], "{shear:?}");
        let endurance = Endurance::new(1.0, 1.6).unwrap();
        for measure in [PathMeasure::Crossland(endurance), PathMeasure::DangVan(endurance)] {
            assert!((value(measure).value - 0.7).abs() < 1e-7, "{measure:?}: {:?}", value(measure));
        }
        // τ₁ = |τ_xz| rises from 0 to .7 twice in a cycle, which counts as one of 2^{1/6} times that.
        let range = value(PathMeasure::Range(6.0)).value;
        assert!((range - 0.7 * 2f64.powf(1.0 / 6.0)).abs() < 1e-14, "{range}");
    }
}

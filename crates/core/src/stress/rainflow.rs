//! Cycles of a load that repeats, by rainflow counting, and the one cycle that does the damage of all of them.
//!
//! A closed sequence of turning points is counted from its largest value on, so that every cycle closes and no residue is left
//! (ASTM E1049-85, 5.4.5). Cycles add up by Miner's rule with the exponent m of the law of fatigue: the range of one cycle that
//! does the damage of n_k cycles of the ranges Δ_k is (Σ n_k Δ_k^m)^{1/m}. Of a single cycle it is the range itself.

/// Part of the largest range below which a cycle is a ripple of the samples.
const RIPPLE: f64 = 1e-3;

/// Ranges of the cycles of one or more closed sequences, each with its number.
#[derive(Debug, Clone, Default)]
pub(super) struct Cycles {
    ranges: Vec<[f64; 2]>,
}

/// The one cycle that does the damage of many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Equivalent {
    /// Range of the cycle.
    pub range: f64,
    /// Rise of the range where those of all cycles rise by one.
    pub gain: f64,
}

impl Cycles {
    /// Counts the cycles of a closed sequence, each `times`. A value that is not a number, or infinite, makes a cycle of such a range.
    pub fn count(&mut self, values: &[f64], times: f64) {
        if let Some(wrong) = values.iter().find(|value| !value.is_finite()) {
            self.ranges.push([wrong.abs(), times]);
            return;
        }
        let turns = turning_points(values);
        let mut open: Vec<f64> = Vec::new();
        for &value in turns.iter().chain(turns.first()) {
            open.push(value);
            while let [.., a, b, c] = open[..]
                && (c - b).abs() >= (b - a).abs()
            {
                self.ranges.push([(b - a).abs(), times]);
                open.drain(open.len() - 3..open.len() - 1);
            }
        }
    }

    /// The one cycle that does their damage by a law of the exponent m; a range of 0 without any.
    pub fn equivalent(&self, exponent: f64) -> Equivalent {
        let largest = |most: f64, range: f64| if most.is_nan() || range <= most { most } else { range };
        let most = self.ranges.iter().fold(0.0, |most, cycle| largest(most, cycle[0]));
        if !(most > 0.0 && most.is_finite()) {
            return Equivalent { range: most, gain: 1.0 };
        }
        let parts = self.ranges.iter().map(|[range, times]| (range / most, times)).filter(|(part, _)| *part > RIPPLE);
        let (damage, slope) = parts.fold((0.0, 0.0), |(damage, slope), (part, times)| {
            (damage + times * part.powf(exponent), slope + times * part.powf(exponent - 1.0))
        });
        let range = damage.powf(1.0 / exponent);
        Equivalent { range: most * range, gain: range * slope / damage }
    }
}

/// Maxima and minima of a closed sequence in turn, from the largest one on; nothing where it is constant.
fn turning_points(values: &[f64]) -> Vec<f64> {
    let most = (0..values.len()).reduce(|best, k| if values[k] > values[best] { k } else { best }).unwrap_or(0);
    let mut turns: Vec<f64> = Vec::new();
    for k in 0..values.len() {
        let value = values[(most + k) % values.len()];
        if let [.., before, last] = turns[..]
            && (last - before) * (value - last) >= 0.0
        {
            turns.pop();
        }
        if turns.last() != Some(&value) {
            turns.push(value);
        }
    }
    // From the last minimum the sequence rises to the first value.
    while let [first, .., before, last] = turns[..]
        && (last - before) * (first - last) >= 0.0
    {
        turns.pop();
    }
    if turns.len() < 2 { Vec::new() } else { turns }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranges(values: &[f64]) -> Vec<f64> {
        let mut cycles = Cycles::default();
        cycles.count(values, 1.0);
        let mut ranges: Vec<f64> = cycles.ranges.iter().map(|cycle| cycle[0]).collect();
        ranges.sort_by(f64::total_cmp);
        ranges
    }

    /// The example of ASTM E1049-85, figures 6 and 7: for a repeating history one cycle each of 3, 4, 7 and 9 is counted.
    #[test]
    fn the_example_of_the_standard_has_its_cycles() {
        let history = [-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0];
        let expected = ranges(&history);
        assert_eq!(expected, [3.0, 4.0, 7.0, 9.0]);
        // From wherever it begins, with places between the turning points, backwards and upside down.
        for start in 0..history.len() {
            let turned: Vec<f64> = (0..history.len()).map(|k| history[(start + k) % history.len()]).collect();
            let between: Vec<f64> = (0..turned.len())
                .flat_map(|k| [turned[k], 0.3 * turned[k] + 0.7 * turned[(k + 1) % turned.len()]])
                .collect();
            let (back, down) =
                (turned.iter().rev().copied().collect::<Vec<_>>(), turned.iter().map(|x| -x).collect::<Vec<_>>());
            for values in [turned, between, back, down] {
                assert_eq!(ranges(&values).iter().map(|x| (1e9 * x).round()).collect::<Vec<_>>(), [3e9, 4e9, 7e9, 9e9]);
            }
        }
    }

    #[test]
    fn the_equivalent_cycle_does_the_damage_of_all() {
        let mut cycles = Cycles::default();
        assert_eq!(cycles.equivalent(4.0), Equivalent { range: 0.0, gain: 1.0 });
        cycles.count(&[1.0; 7], 1.0);
        assert_eq!(cycles.equivalent(4.0).range, 0.0);
        cycles.count(&[0.0, 0.1, 0.5, 0.2], 1.0);
        assert_eq!(cycles.equivalent(8.0), Equivalent { range: 0.5, gain: 1.0 });
        cycles.count(&[0.0, 0.5, 0.1], 15.0);
        assert!(
            (cycles.equivalent(4.0).range - 1.0).abs() < 1e-15 && (cycles.equivalent(4.0).gain - 2.0).abs() < 1e-14
        );
        cycles.count(&[0.0, 2.0, 1.0, 2.0], 1.0);
        assert!((cycles.equivalent(2.0).range - (4.0f64 + 4.0 + 1.0).sqrt()).abs() < 1e-14);
        cycles.count(&[0.0, f64::INFINITY], 1.0);
        assert_eq!(cycles.equivalent(2.0).range, f64::INFINITY);
    }
}

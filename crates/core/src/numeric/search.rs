//! The largest of numbers, and the maximum of a function of one variable.

/// Place and value of the maximum of a unimodal function between `low` and `high` > 0, by golden sections, to the relative
/// `tolerance` of the place.
pub fn golden_maximum([low, high]: [f64; 2], tolerance: f64, value: impl Fn(f64) -> f64) -> [f64; 2] {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (low, high);
    let (mut c, mut d) = (b - golden * (b - a), a + golden * (b - a));
    let (mut at_c, mut at_d) = (value(c), value(d));
    while b - a > tolerance * b {
        if at_c > at_d {
            (b, d, at_d) = (d, c, at_c);
            c = b - golden * (b - a);
            at_c = value(c);
        } else {
            (a, c, at_c) = (c, d, at_d);
            d = a + golden * (b - a);
            at_d = value(d);
        }
    }
    if at_c > at_d { [c, at_c] } else { [d, at_d] }
}

/// The largest of some numbers, at least 0; NaN where one of them is, unlike [`f64::max`].
pub fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, |most, x| if most.is_nan() || x <= most { most } else { x })
}

/// Index and value of the largest of some numbers, the first of several that are equal to rounding, as those of symmetric places
/// are; NaN counts as the largest.
pub fn first_largest(numbers: impl Iterator<Item = f64>) -> Option<(usize, f64)> {
    let behind = |next: f64, best: f64| best.is_nan() || next <= best + 1e-12 * next.abs();
    numbers.enumerate().reduce(|best, next| if behind(next.1, best.1) { best } else { next })
}

/// Index and value of the first of some numbers that no neighbour exceeds and that is the largest but for a part of it.
pub fn first_summit(numbers: &[f64], part: f64) -> Option<(usize, f64)> {
    let (last, most) = first_largest(numbers.iter().copied())?;
    let is_summit = |k: usize| {
        let beside = [k.checked_sub(1), Some(k + 1)].into_iter().flatten().filter_map(|k| numbers.get(k));
        numbers[k] >= most - part * most.abs() && beside.into_iter().all(|beside| *beside <= numbers[k])
    };
    let first = (0..last).find(|&k| is_summit(k)).unwrap_or(last);
    Some((first, numbers[first]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_has_its_maximum_at_its_apex() {
        let [place, value] = golden_maximum([0.1, 3.0], 1e-6, |x| 2.0 - (x - 1.3) * (x - 1.3));
        assert!((place - 1.3).abs() < 1e-5 && (value - 2.0).abs() < 1e-10);
    }

    #[test]
    fn nan_is_the_largest() {
        assert_eq!(largest([0.1, 0.3, 0.2]), 0.3);
        assert_eq!(largest([]), 0.0);
        assert!(largest([0.1, f64::NAN, 5.0]).is_nan());
        assert_eq!(first_largest([0.1, 0.3, 0.3 + 1e-16, 0.2].into_iter()), Some((1, 0.3)));
        let summits = [0.1, 0.3 - 1e-9, 0.2, 0.3 - 2e-9, 0.3, 0.2];
        assert_eq!(first_summit(&summits, 1e-6), Some((1, 0.3 - 1e-9)), "the first summit");
        assert_eq!(first_summit(&summits[2..], 1e-6), Some((2, 0.3)), "not the slope of the same one");
        assert_eq!(first_summit(&[], 1e-6), None);
        assert_eq!(first_largest([0.1, f64::NAN, 5.0].into_iter()).map(|(index, _)| index), Some(1));
    }
}

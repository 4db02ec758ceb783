//! The top of a smooth peak between equally spaced values.

use super::least_squares;

/// How far the paraboloid c₀ + c₁i + c₂j + c₃i² + c₄ij + c₅j² through the values at i, j = −`half`, …, `half` (least
/// squares) rises from its middle to its top, with an error that falls with the fourth power of the spacing.
///
/// `None` next to the edge of contact, where a value is not positive, and where the top is none or farther than one step.
pub fn rise(half: i32, value: impl Fn(i32, i32) -> f64) -> Option<f64> {
    let steps = || (-half..=half).flat_map(|i| (-half..=half).map(move |j| (i, j)));
    if !steps().all(|(i, j)| value(i, j) > 0.0) {
        return None;
    }
    let row = |(i, j): (i32, i32)| {
        let (x, y) = (f64::from(i), f64::from(j));
        (vec![1.0, x, y, x * x, x * y, y * y], value(i, j))
    };
    let c = least_squares::fit(6, steps().map(row))?;
    let determinant = 4.0 * c[3] * c[5] - c[4] * c[4];
    let i = (c[4] * c[2] - 2.0 * c[5] * c[1]) / determinant;
    let j = (c[4] * c[1] - 2.0 * c[3] * c[2]) / determinant;
    let is_top = c[3] < 0.0 && determinant > 0.0 && i.abs() <= 1.0 && j.abs() <= 1.0;
    is_top.then_some(0.5 * (c[1] * i + c[2] * j))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_paraboloid_is_exact_and_looked_for_nearby_only() {
        let away = |x: f64, y: f64| {
            move |i: i32, j: i32| {
                let (i, j) = (f64::from(i) - x, f64::from(j) - y);
                50.0 - i * i - 0.7 * i * j - 1.5 * j * j
            }
        };
        for half in [1, 2] {
            let near = away(0.3, -0.2);
            assert!((near(0, 0) + rise(half, near).unwrap() - 50.0).abs() < 1e-12);
            assert_eq!(rise(half, away(1.2, 0.0)), None);
        }
        assert_eq!(rise(1, |i, j| f64::from(i * i + j * j) + 1.0), None);
        assert_eq!(rise(2, |i, _| 3.0 - f64::from(2 * i * i)), None);
    }
}

//! The top of a smooth peak between equally spaced values.

/// Rise from the middle to the top of the paraboloid c₀ + c₁i + c₂j + c₃i² + c₄ij + c₅j² through the values at i, j = −`half`, …,
/// `half` (least squares), with an error that falls with the fourth power of the spacing.
///
/// `None` where a value is not positive, as next to the edge of contact, and where there is no top within one step.
pub fn rise(half: i32, value: impl Fn(i32, i32) -> f64) -> Option<f64> {
    let steps = || (-half..=half).flat_map(|i| (-half..=half).map(move |j| (i, j)));
    if !steps().all(|(i, j)| value(i, j) > 0.0) {
        return None;
    }
    // At these points 1, i, j, ij, i² − m and j² − m are orthogonal, m the mean of i².
    let sum = |weight: &dyn Fn(f64, f64) -> f64| -> f64 {
        steps().map(|(i, j)| weight(f64::from(i), f64::from(j)) * value(i, j)).sum()
    };
    let [squares, fourths] = [2, 4].map(|power| (-half..=half).map(|i| f64::from(i).powi(power)).sum::<f64>());
    let count = f64::from(2 * half + 1);
    let m = squares / count;
    let [c1, c2] = [sum(&|i, _| i), sum(&|_, j| j)].map(|sum| sum / (count * squares));
    let [c3, c5] = [sum(&|i, _| i * i - m), sum(&|_, j| j * j - m)].map(|sum| sum / (count * (fourths - m * squares)));
    let c4 = sum(&|i, j| i * j) / (squares * squares);
    let determinant = 4.0 * c3 * c5 - c4 * c4;
    let i = (c4 * c2 - 2.0 * c5 * c1) / determinant;
    let j = (c4 * c1 - 2.0 * c3 * c2) / determinant;
    let is_top = c3 < 0.0 && determinant > 0.0 && i.abs() <= 1.0 && j.abs() <= 1.0;
    is_top.then_some(0.5 * (c1 * i + c2 * j))
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

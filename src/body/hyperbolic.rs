//! Hyperbolic functions of small numbers, and what remains of them where they cancel.

/// cosh x, sinh x, ½x sinh x and ½(x cosh x − sinh x), 0 ≤ x < 1, by their series: the last one is Σ j x^{2j+1}/(2j+1)!.
#[inline(always)]
pub(super) fn hyperbolic(x: f64) -> [f64; 4] {
    let square = x * x;
    let (mut cosh, mut sinh, mut bend) = (0.0, 0.0, 0.0);
    for j in (0..TERMS).rev() {
        cosh = cosh * square + EVEN[j];
        sinh = sinh * square + ODD[j];
        bend = bend * square + j as f64 * ODD[j];
    }
    [cosh, x * sinh, 0.5 * square * sinh, x * bend]
}

/// Terms of a series in x² < 1: the next one is below 10⁻¹⁷.
const TERMS: usize = 10;
/// 1/(2j)! and 1/(2j+1)!.
const EVEN: [f64; TERMS] = reciprocals(0);
const ODD: [f64; TERMS] = reciprocals(1);

const fn reciprocals(first: usize) -> [f64; TERMS] {
    let mut all = [1.0; TERMS];
    let mut j = 1;
    while j < TERMS {
        let n = (2 * j + first) as f64;
        all[j] = all[j - 1] / (n * (n - 1.0));
        j += 1;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_are_the_functions() {
        for x in [0.0, 1e-3, 0.3, 0.999f64] {
            let [cosh, sinh, rise, bend] = hyperbolic(x);
            assert!((cosh - x.cosh()).abs() < 1e-15 && (sinh - x.sinh()).abs() < 1e-15);
            assert!((rise - 0.5 * x * x.sinh()).abs() < 1e-15);
            // x³/6 + x⁵/60 + …, where the difference itself cancels.
            assert!((bend - 0.5 * (x * x.cosh() - x.sinh())).abs() < 1e-15);
            assert!((bend - x.powi(3) / 6.0 * (1.0 + 0.1 * x * x)).abs() <= 7e-4 * x.powi(7));
        }
    }
}

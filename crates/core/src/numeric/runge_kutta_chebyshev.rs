//! Steps of Runge–Kutta–Chebyshev: explicit, of second order, stable where a rate falls fast.
//!
//! Of **y**′ = **F**(**y**) with real negative eigenvalues down to −ρ a step h with s stages is stable for hρ ≤ ⅔(s² − 1)(1 − 2ε/15), ε = 2/13
//! (Sommeijer, Shampine & Verwer, J. Comput. Appl. Math. 88 (1998) 315). The cost of a stiff equation grows with the root of hρ.

/// Damping ε of the stages.
const DAMPING: f64 = 2.0 / 13.0;

/// **F** after a rise of **y**.
pub type Rate<'a, E> = dyn FnMut(&[f64]) -> Result<Vec<f64>, E> + 'a;

/// Number of stages for a step times the spectral radius ρ of the rate.
pub fn stages(product: f64) -> usize {
    (1.0 + (1.0 + 1.54 * product).sqrt().floor()).max(2.0) as usize
}

/// Step times ρ that so many stages allow.
pub fn largest(stages: usize) -> f64 {
    let s = stages as f64;
    ((s - 1.0).powi(2) - 1.0) / 1.54
}

/// A step.
#[derive(Debug)]
pub struct Step {
    /// Rise of **y**.
    pub rise: Vec<f64>,
    /// Estimated error of the rise, value by value.
    pub error: Vec<f64>,
}

/// The rise of **y** over a step `h` in so many stages, from the rate at its start; `rate` gives **F** after a rise.
///
/// # Errors
/// Errors of `rate`.
pub fn step<E>(first: &[f64], h: f64, stages: usize, rate: &mut Rate<'_, E>) -> Result<Step, E> {
    let s = stages.max(2);
    let w0 = 1.0 + DAMPING / (s * s) as f64;
    // Chebyshev's polynomials and their derivatives at w₀.
    let (mut t, mut dt, mut ddt) = (vec![1.0, w0], vec![0.0, 1.0], vec![0.0, 0.0]);
    for j in 2..=s {
        t.push(2.0 * w0 * t[j - 1] - t[j - 2]);
        dt.push(2.0 * t[j - 1] + 2.0 * w0 * dt[j - 1] - dt[j - 2]);
        ddt.push(4.0 * dt[j - 1] + 2.0 * w0 * ddt[j - 1] - ddt[j - 2]);
    }
    let w1 = dt[s] / ddt[s];
    let b: Vec<f64> = (0..=s).map(|j| j.max(2)).map(|j| ddt[j] / (dt[j] * dt[j])).collect();
    let mut before = vec![0.0; first.len()];
    let mut rise: Vec<f64> = first.iter().map(|rate| b[1] * w1 * h * rate).collect();
    for j in 2..=s {
        let (mu, nu) = (2.0 * b[j] * w0 / b[j - 1], -b[j] / b[j - 2]);
        let of_rate = 2.0 * b[j] * w1 / b[j - 1];
        let of_first = -(1.0 - b[j - 1] * t[j - 1]) * of_rate;
        let newest = rate(&rise)?;
        let next = (0..rise.len())
            .map(|i| mu * rise[i] + nu * before[i] + h * (of_rate * newest[i] + of_first * first[i]))
            .collect();
        before = std::mem::replace(&mut rise, next);
    }
    let last = rate(&rise)?;
    let error = (0..rise.len()).map(|i| (0.4 * h * (first[i] + last[i]) - 0.8 * rise[i]).abs()).collect();
    Ok(Step { rise, error })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn after(h: f64, stages: usize, rates: &[f64]) -> Vec<f64> {
        let mut rate = |rise: &[f64]| -> Result<Vec<f64>, Infallible> {
            Ok(rise.iter().zip(rates).map(|(rise, rate)| -rate * (1.0 + rise)).collect())
        };
        let first = rate(&vec![0.0; rates.len()]).unwrap();
        step(&first, h, stages, &mut rate).unwrap().rise
    }

    /// y′ = −y: the error of a step falls with its cube, and the estimate is of its size.
    #[test]
    fn a_step_is_of_second_order() {
        for stages in [2, 5, 12] {
            let error = |h: f64| (after(h, stages, &[1.0])[0] - ((-h).exp() - 1.0)).abs();
            let order = (error(0.1) / error(0.05)).log2();
            assert!((order - 3.0).abs() < 0.15, "{stages}: {order}");
        }
    }

    /// In a step of 1 solutions with eigenvalues from −1 to −10⁴ decay with the stages of [`stages`], and grow with three quarters of them.
    #[test]
    fn stages_suffice_and_are_not_many_more_than_needed() {
        let rates: Vec<f64> = (0..=400).map(|k| 10f64.powf(0.01 * f64::from(k))).collect();
        let largest =
            |stages: usize| after(1.0, stages, &rates).iter().map(|rise| (1.0 + rise).abs()).fold(0.0, f64::max);
        let asked = stages(1e4);
        assert!(largest(asked) < 1.0 && largest(asked * 3 / 4) > 1.0, "{asked}: {}", largest(asked));
        assert!(super::largest(asked) >= 1e4 * 0.95 && stages(super::largest(40) * 0.999) <= 40);
    }
}

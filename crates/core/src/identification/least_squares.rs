//! Least squares by Levenberg and Marquardt: the minimum of Σ rᵢ(t)² with the Jacobian J, by steps
//!
//! (JᵀJ + λ diag JᵀJ) Δt = −Jᵀr,
//!
//! λ smaller after a step that lowers the sum, larger after one that does not. The scale of each parameter drops out.

/// A model at parameters t: residuals and their Jacobian, one row for each residual, and what else is known of it there.
#[derive(Debug, Clone)]
pub struct Linearised<M> {
    /// Residuals r.
    pub residuals: Vec<f64>,
    /// J, one row for each residual.
    pub jacobian: Vec<Vec<f64>>,
    /// Model at t: all else that is known of it there.
    pub model: M,
}

/// The lowest place of a search.
#[derive(Debug, Clone)]
pub struct Minimum<M, R> {
    /// The parameters t.
    pub place: Vec<f64>,
    /// The model there, not at a later trial.
    pub linearised: Linearised<M>,
    /// Steps that lowered the sum.
    pub steps: usize,
    /// How the search ended.
    pub end: End<R>,
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum End<R> {
    /// A step changed each parameter by less than the tolerance.
    Converged,
    /// Not converged, and the model had no value at the end of a step; of several the reason of the last.
    Refused(R),
    /// Not converged: no step lowers the sum any more, or too many do.
    Exhausted,
}

/// Most trials of a step.
const TRIALS: usize = 30;
/// Change of each parameter, whose scale is 1, at which the search ends.
const TOLERANCE: f64 = 1e-6;
/// λ at the beginning, its factors after a step and after a failed one, and the largest.
const DAMPING: [f64; 4] = [1e-3, 0.2, 5.0, 1e10];

/// The minimum from a start; `at` gives a reason where the model has no value. A step there is tried again shorter.
///
/// # Errors
/// The reason of a start without a value.
pub fn minimise<M, R>(
    start: Vec<f64>,
    mut at: impl FnMut(&[f64]) -> Result<Linearised<M>, R>,
) -> Result<Minimum<M, R>, R> {
    let mut best = Minimum { linearised: at(&start)?, place: start, steps: 0, end: End::Exhausted };
    let ([mut damping, down, up, most], mut refused) = (DAMPING, None);
    for _ in 0..TRIALS {
        let Linearised { residuals, jacobian, .. } = &best.linearised;
        let (normal, gradient) = (normal(jacobian), gradient(residuals, jacobian));
        let mut damped = normal.clone();
        for (k, row) in damped.iter_mut().enumerate() {
            row[k] += damping * normal[k][k].max(f64::MIN_POSITIVE);
        }
        let mut change = up;
        if let Some(step) = factor(&damped).map(|factor| solve(&factor, &gradient)) {
            let trial: Vec<f64> = best.place.iter().zip(&step).map(|(t, step)| t - step).collect();
            let small = step.iter().all(|step| step.abs() <= TOLERANCE);
            match at(&trial) {
                Ok(linearised) => {
                    if sum(&linearised.residuals) <= sum(residuals) {
                        best = Minimum { place: trial, linearised, steps: best.steps + 1, end: End::Exhausted };
                        change = down;
                    }
                    // A sum that is not lower leaves only rounding, and the samples of a contact.
                    if small {
                        return Ok(Minimum { end: End::Converged, ..best });
                    }
                }
                Err(reason) => {
                    refused = Some(reason);
                    if small {
                        break;
                    }
                }
            }
        }
        damping *= change;
        if damping > most {
            break;
        }
    }
    Ok(Minimum { end: refused.map_or(End::Exhausted, End::Refused), ..best })
}

/// Σ rᵢ².
pub fn sum(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum()
}

/// JᵀJ.
pub fn normal(jacobian: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let count = jacobian.first().map_or(0, Vec::len);
    let entry = |i: usize, j: usize| jacobian.iter().map(|row| row[i] * row[j]).sum();
    (0..count).map(|i| (0..count).map(|j| entry(i, j)).collect()).collect()
}

/// Jᵀr.
fn gradient(residuals: &[f64], jacobian: &[Vec<f64>]) -> Vec<f64> {
    let count = jacobian.first().map_or(0, Vec::len);
    (0..count).map(|k| jacobian.iter().zip(residuals).map(|(row, r)| row[k] * r).sum()).collect()
}

/// Least pivot of a matrix scaled to a unit diagonal that counts as positive: below it columns of J are parallel to rounding.
const LEAST_PIVOT: f64 = 1e-13;

/// Cholesky's factor L of a symmetric matrix A = LLᵀ; `None` unless it is positive.
fn factor(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let mut lower = vec![vec![0.0; matrix.len()]; matrix.len()];
    for i in 0..matrix.len() {
        for j in 0..=i {
            let inner: f64 = (0..j).map(|k| lower[i][k] * lower[j][k]).sum();
            let rest: f64 = matrix[i][j] - inner;
            if i == j {
                if !(rest > LEAST_PIVOT * matrix[i][i] && rest.is_finite()) {
                    return None;
                }
                lower[i][i] = rest.sqrt();
            } else {
                lower[i][j] = rest / lower[j][j];
            }
        }
    }
    Some(lower)
}

/// x of LLᵀx = b.
fn solve(lower: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let mut x = right.to_vec();
    for i in 0..x.len() {
        let inner: f64 = (0..i).map(|k| lower[i][k] * x[k]).sum();
        x[i] = (x[i] - inner) / lower[i][i];
    }
    for i in (0..x.len()).rev() {
        let inner: f64 = (i + 1..x.len()).map(|k| lower[k][i] * x[k]).sum();
        x[i] = (x[i] - inner) / lower[i][i];
    }
    x
}

/// The inverse of a symmetric positive matrix; `None` where it is none to rounding.
pub fn inverse(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let lower = factor(matrix)?;
    let unit = |k: usize| (0..matrix.len()).map(|i| f64::from(u8::from(i == k))).collect::<Vec<f64>>();
    Some((0..matrix.len()).map(|k| solve(&lower, &unit(k))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linearised<M>(rows: impl IntoIterator<Item = (f64, Vec<f64>)>, model: M) -> Linearised<M> {
        let (residuals, jacobian) = rows.into_iter().unzip();
        Linearised { residuals, jacobian, model }
    }

    /// y = a e^{−bx} with a and b by their logarithms.
    fn decay(t: &[f64]) -> Linearised<()> {
        let [a, b] = [t[0].exp(), t[1].exp()];
        let of = |k: usize| {
            let x = k as f64 / 5.0;
            let (value, known) = (a * (-b * x).exp(), 3.0 * (-0.7 * x).exp());
            (value - known, vec![value, -value * b * x])
        };
        linearised((0..12).map(of), ())
    }

    #[test]
    fn an_exponential_is_found_from_far_away() {
        let found = minimise(vec![-2.0, 1.5], |t| Ok::<_, ()>(decay(t))).unwrap();
        assert!(found.end == End::Converged && sum(&found.linearised.residuals) < 1e-16, "{found:?}");
        assert!((found.place[0].exp() - 3.0).abs() < 1e-7 && (found.place[1].exp() - 0.7).abs() < 1e-7);
    }

    #[test]
    fn an_inverse_times_its_matrix_is_one_and_parallel_columns_have_none() {
        let matrix = vec![vec![4.0, 1.0, 0.5], vec![1.0, 3.0, -0.2], vec![0.5, -0.2, 1.0]];
        let inverse_of = inverse(&matrix).unwrap();
        for i in 0..3 {
            for j in 0..3 {
                let entry: f64 = (0..3).map(|k| matrix[i][k] * inverse_of[k][j]).sum();
                assert!((entry - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
        assert!(inverse(&[vec![1.0, 2.0], vec![2.0, 4.0]]).is_none());
        let parallel = minimise(vec![0.0, 0.0], |t| {
            let r = t[0] + t[1] - 1.0;
            Ok::<_, ()>(linearised([(r, vec![1.0, 1.0]), (2.0 * r, vec![2.0, 2.0])], ()))
        });
        assert!(sum(&parallel.unwrap().linearised.residuals) < 1e-12);
    }

    /// t − 0.4, with a slope that is too flat: steps go too far, up to a border.
    fn beyond(border: f64) -> impl FnMut(&[f64]) -> Result<Linearised<()>, f64> {
        move |t| if t[0] < border { Ok(linearised([(t[0] - 0.4, vec![0.1])], ())) } else { Err(t[0]) }
    }

    /// A step is shortened where the model has no value.
    #[test]
    fn steps_stay_where_the_model_has_a_value() {
        let found = minimise(vec![0.0], beyond(0.5)).unwrap();
        assert!((found.place[0] - 0.4).abs() < 0.1, "{found:?}");
    }

    /// A search that can step no further has not converged, and gives the last reason; that at a start is the error.
    #[test]
    fn a_search_that_ends_at_a_border_gives_the_reason() {
        let found = minimise(vec![0.0], beyond(0.3)).unwrap();
        let End::Refused(last) = found.end else { panic!("{found:?}") };
        assert!(found.place[0] < 0.3 && last >= 0.3, "{found:?}");
        assert_eq!(minimise(vec![0.7], beyond(0.3)).unwrap_err(), 0.7);
    }

    /// All trials after the second are worse, as those of a contact whose samples change.
    #[test]
    fn what_else_is_known_is_that_of_the_accepted_place() {
        let mut trials = Vec::new();
        let found = minimise(vec![1.0, 0.0], |t| {
            trials.push(t.to_vec());
            let Linearised { mut residuals, jacobian, .. } = decay(t);
            if trials.len() > 2 {
                residuals.iter_mut().for_each(|r| *r += 100.0);
            }
            Ok::<_, ()>(Linearised { residuals, jacobian, model: t.to_vec() })
        });
        let found = found.unwrap();
        assert!(trials.len() > 3 && found.steps == 1, "{} trials, {found:?}", trials.len());
        assert_eq!((&found.linearised.model, &found.place), (&trials[1], &trials[1]));
    }
}

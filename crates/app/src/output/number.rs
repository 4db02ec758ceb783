//! Numbers with their errors.

pub use percoat_core::notation::number;

/// Relative errors below this are rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// A number with its error, both to the first digit of the error: 0.4217 ± 0.0001. A smaller error than one of the fifth digit is
/// shown as one of it; an error of rounding is left out; a number below its error has at most one digit more than the error.
pub fn with_error(x: f64, error: Option<f64>) -> String {
    let Some(error) = error.filter(|error| error.is_finite() && *error > ROUNDING * x.abs() && x.is_finite()) else {
        return number(x);
    };
    let exponent = |x: f64| x.abs().max(f64::MIN_POSITIVE).log10().floor() as i32;
    let digit = exponent(error).max(exponent(x) - 4);
    // Errors are rounded up: 1.2e-4 is 2e-4.
    let counted = (error / 10f64.powi(digit) * (1.0 - 1e-9)).ceil();
    // Nine and a bit is ten: one digit further left.
    let (digit, counted) = if counted > 9.0 { (digit + 1, 1.0) } else { (digit, counted) };
    let lead = exponent(x).max(digit);
    let error = counted * 10f64.powi(digit);
    let digit = if x == 0.0 { digit } else { digit.min(exponent(x)).max(digit - 1) };
    if (-3..6).contains(&lead) && digit < 6 {
        let decimals = usize::try_from(-digit).unwrap_or(0);
        format!("{x:.decimals$} ± {error:.decimals$}")
    } else {
        let (scale, decimals) = (10f64.powi(-lead), usize::try_from(lead - digit).unwrap_or(0));
        format!("{:.decimals$}e{lead} ± {:.decimals$}e{lead}", x * scale, error * scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_have_one_digit_and_values_no_more_than_they_know() {
        let texts = [
            (0.421_690_1, Some(9.3e-5)),
            (0.421_690_1, Some(1.2e-4)),
            (0.421_690_1, Some(1e-9)),
            (0.055_395, Some(0.004)),
            (0.0553, Some(0.7)),
            (0.39, Some(5.3)),
            (0.0007, Some(8.0)),
            (0.25, Some(1e-16)),
            (210e9, Some(3e6)),
            (1.5e-7, Some(2e-9)),
            (12.0, None),
            (12.0, Some(0.0)),
        ]
        .map(|(x, error)| with_error(x, error));
        assert_eq!(
            texts,
            [
                "0.4217 ± 0.0001",
                "0.4217 ± 0.0002",
                "0.42169 ± 0.00001",
                "0.055 ± 0.004",
                "0.06 ± 0.70",
                "0.4 ± 6.0",
                "0.0 ± 8.0",
                "0.25000",
                "2.1000e11 ± 0.0001e11",
                "1.50e-7 ± 0.02e-7",
                "12.000",
                "12.000"
            ]
        );
    }
}

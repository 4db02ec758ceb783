//! Numbers in messages: five significant digits, and their relative errors.

/// Largest relative error of a number that is written behind "±"; one with a larger error is written as an interval.
pub const WIDE: f64 = 0.3;

/// A number with five significant digits, without exponent from 0.001 to 999999.
pub fn number(x: f64) -> String {
    // The exponent after rounding: 0.0099999999 is 0.010000.
    let scientific = format!("{x:.4e}");
    let exponent = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        Some(exponent) if (-3..6).contains(&exponent) => {
            format!("{x:.*}", usize::try_from(4 - exponent).unwrap_or(0))
        }
        _ => scientific,
    }
}

/// A relative error behind a positive number that is a power of what was computed: " ± 8 %", or where that is wide the factor exp(e) to
/// either side; nothing where the error is not known.
pub fn power_error(relative: Option<f64>) -> String {
    match relative {
        None => String::new(),
        Some(error) if error <= WIDE => format!(" ± {:.0} %", (100.0 * error).ceil()),
        Some(error) => match (10.0 * error.exp()).ceil() / 10.0 {
            factor if factor < 10.0 => format!(", known to a factor of {factor:.1}"),
            factor if factor < 1000.0 => format!(", known to a factor of {:.0}", factor.ceil()),
            _ => ", of which the error leaves no digit".to_owned(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wide_error_is_a_factor() {
        let told = [None, Some(0.072), Some(0.3), Some(1.1), Some(3.0), Some(40.0)].map(power_error);
        let wide = [", known to a factor of 3.1", ", known to a factor of 21", ", of which the error leaves no digit"];
        assert_eq!(told, ["", " ± 8 %", " ± 30 %", wide[0], wide[1], wide[2]]);
    }

    #[test]
    fn numbers_have_five_digits() {
        let texts = [0.42169, 1.5e-7, 210e9, 12345.6, 0.0, 0.009_999_999_99, 2e-6].map(number);
        assert_eq!(texts, ["0.42169", "1.5000e-7", "2.1000e11", "12346", "0.0000", "0.010000", "2.0000e-6"]);
    }
}

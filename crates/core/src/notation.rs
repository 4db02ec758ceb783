//! Numbers in messages: five significant digits.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_five_digits() {
        let texts = [0.42169, 1.5e-7, 210e9, 12345.6, 0.0, 0.009_999_999_99, 2e-6].map(number);
        assert_eq!(texts, ["0.42169", "1.5000e-7", "2.1000e11", "12346", "0.0000", "0.010000", "2.0000e-6"]);
    }
}

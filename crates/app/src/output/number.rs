//! Numbers with their errors.

use percoat_case::units::{Prefixed, Unit, Units};
use percoat_core::measured::Measured;
use percoat_core::quantity::{Kind, Named};

pub use percoat_core::notation::number;
use percoat_core::notation::{WIDE, power_error};

/// Relative errors below this are rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// A number with its error, both to the first digit of the error: 0.4217 ± 0.0001. A smaller error than one of the fifth digit is
/// shown as one of it; an error of rounding is left out. An error of more than three tenths of the number is shown by the interval,
/// "0.035 to 0.076"; a number below its error has at most one digit more than the error, since its sign is not known.
pub fn with_error(x: f64, error: Option<f64>) -> String {
    let Some(error) = error.filter(|error| error.is_finite() && *error > ROUNDING * x.abs() && x.is_finite()) else {
        return number(x);
    };
    if error > WIDE * x.abs() && error < x.abs() {
        return interval(x, error);
    }
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

/// The power of ten of a number's first digit.
fn exponent(x: f64) -> i32 {
    x.abs().max(f64::MIN_POSITIVE).log10().floor() as i32
}

/// The numbers between which one lies by its error, less than the number, to the second digit of it, rounded away from it.
fn interval(x: f64, error: f64) -> String {
    let lead = exponent(x);
    let digit = 10f64.powi(lead - 1);
    let [low, high] =
        [((x - error) / digit).floor(), ((x + error) / digit).ceil()].map(|counted| counted * digit + 0.0);
    if (-3..6).contains(&lead) {
        let decimals = usize::try_from(1 - lead).unwrap_or(0);
        format!("{low:.decimals$} to {high:.decimals$}")
    } else {
        let scale = 10f64.powi(-lead);
        format!("{:.1}e{lead} to {:.1}e{lead}", low * scale, high * scale)
    }
}

/// A value with its error, both in the unit of their column, which is not named; "singular" for an infinite one.
pub fn in_unit(unit: &Prefixed, measured: Measured) -> String {
    if measured.value.is_infinite() {
        return "singular".to_owned();
    }
    with_error(unit.shown(measured.value), measured.error.map(|error| unit.shown(error)))
}

/// Passes with their error, which are a power of what was computed: of a wide error the number and the factor to which it is known, as
/// sentences have it.
pub fn passes_with_error(measured: Measured) -> String {
    match measured.relative().filter(|relative| *relative > WIDE) {
        Some(relative) => format!("{}{}", number(measured.value), power_error(Some(relative))),
        None => with_error(measured.value, measured.error),
    }
}

/// Whether a text is a number whose wide error is shown by its interval, with a unit or without.
pub(crate) fn is_interval(text: &str) -> bool {
    let is_number = |text: Option<&str>| text.is_some_and(|text| text.parse::<f64>().is_ok());
    text.split_once(" to ")
        .is_some_and(|(low, high)| is_number(Some(low)) && is_number(high.split([' ', '\u{a0}']).next()))
}

/// A value with its error and its unit, "0.5 ± 0.1 µm"; "singular" for an infinite one.
pub fn with_unit(unit: &Unit, measured: Measured) -> String {
    if measured.value.is_infinite() {
        return in_unit(&unit.prefixed(1.0), measured);
    }
    let prefixed = unit.prefixed(measured.value);
    prefixed.behind(&in_unit(&prefixed, measured))
}

/// A quantity with its error and its unit, a part in per cent.
pub fn shown(named: &Named, measured: Measured, units: &Units) -> String {
    match named.kind {
        Kind::Fraction => percent_with_error(measured),
        Kind::Passes if measured.value.is_finite() => passes_with_error(measured),
        kind => with_unit(&units.unit(kind), measured),
    }
}

/// Two decimals; no sign for zero.
pub(super) fn percent(x: f64) -> String {
    let text = format!("{:.2} %", 100.0 * x);
    text.strip_prefix('-').filter(|text| *text == "0.00 %").map_or(text.clone(), str::to_owned)
}

/// A part with its error in per cent: at most two decimals, fewer where the error is larger.
pub fn percent_with_error(measured: Measured) -> String {
    match measured.times(100.0) {
        Measured { value, error: Some(error) } if error > ROUNDING * value.abs() => {
            format!("{} %", with_error(value, Some(error.max(0.01))))
        }
        _ => percent(measured.value),
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
            (0.055_395, Some(0.02)),
            (-97.0, Some(60.0)),
            (8.1e6, Some(5e6)),
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
                "0.035 to 0.076",
                "-157 to -37",
                "3.1e6 to 13.1e6",
                "0.25000",
                "2.1000e11 ± 0.0001e11",
                "1.50e-7 ± 0.02e-7",
                "12.000",
                "12.000"
            ]
        );
    }

    #[test]
    fn intervals_of_wide_errors_are_told_from_other_words() {
        let wide = with_unit(&Unit::Named("µm".to_owned()), Measured::new(0.055, Some(0.02)));
        for text in [&wide[..], "0.06 to 0.16 %", "-157 to -37", "3.1e6 to 13.1e6"] {
            assert!(is_interval(text), "{text}");
        }
        for text in ["0.42 ± 0.01", "ring 1.0 to 2.0", "1 to TiN", "singular"] {
            assert!(!is_interval(text), "{text}");
        }
    }

    #[test]
    fn what_is_infinite_has_no_number_and_a_part_is_in_per_cent() {
        let units = Units::unknown().named(Some("µm"), Some("GPa"));
        let named = |kind: Kind| Named::new("", "", "", kind, percoat_core::quantity::ErrorAt::Nowhere);
        let text = |kind: Kind, value: f64, error: Option<f64>| {
            shown(&named(kind), Measured::new(value, error), &units).replace('\u{a0}', " ")
        };
        assert_eq!(text(Kind::Pressure, f64::INFINITY, None), "singular");
        assert_eq!(text(Kind::Pressure, 0.002, Some(0.0001)), "2.0 ± 0.1 MPa");
        assert_eq!(text(Kind::Fraction, 0.25, Some(0.002)), "25.0 ± 0.2 %");
        assert_eq!(text(Kind::Stiffness, 2.0, None), "2.0000 mN/µm");
        assert_eq!(text(Kind::Passes, 2e6, Some(1e5)), "2.0e6 ± 0.1e6");
        assert_eq!(text(Kind::Passes, 2e6, Some(2e6)), "2.0000e6, known to a factor of 2.8");
    }
}

//! Units of length of files and cases.

use percoat_common::measure::Measure;

/// Known names, for error messages.
pub const KNOWN: &str = "\"m\", \"cm\", \"mm\", \"µm\", \"nm\", \"pm\", \"Å\", \"in\" or \"mil\"";

/// The error for an unknown unit of length.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("\"{0}\" is no unit of length that is known")]
pub struct UnknownUnit(pub String);

/// The unit of length of a name.
fn length(name: &str) -> Result<Measure, UnknownUnit> {
    // The micro sign of Latin-1 is not UTF-8, and read as U+FFFD.
    let cleaned = name.replace('\u{fffd}', "µ");
    Measure::like(&cleaned, Measure::METRE).ok_or_else(|| UnknownUnit(name.to_owned()))
}

/// Whether a name is a known unit of length.
pub fn is_known(name: &str) -> bool {
    length(name).is_ok()
}

/// Factor from lengths in the unit `from` to lengths in the unit `to`.
pub fn factor(from: &str, to: &str) -> Result<f64, UnknownUnit> {
    length(from)?.convert(1.0, length(to)?).ok_or_else(|| UnknownUnit(from.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_converted_and_strangers_named() {
        for (from, to, expected) in [
            ("nm", "µm", 1e-3),
            ("um", "m", 1e-6),
            ("Å", "nm", 0.1),
            ("in", "mm", 25.4),
            ("mm", "μm", 1e3),
            ("m", "pm", 1e12),
        ] {
            let found = factor(from, to).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-15, "{from} in {to}: {found}");
        }
        assert_eq!(factor("nm", "nm"), Ok(1.0));
        assert_eq!(factor("furlong", "m"), Err(UnknownUnit("furlong".to_owned())));
        assert_eq!(factor("m", "l"), Err(UnknownUnit("l".to_owned())));
    }
}

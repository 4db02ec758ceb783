//! Units of length of files and cases.

/// Names of the units, and each unit in metres.
const UNITS: [(&[&str], f64); 9] = [
    (&["m"], 1.0),
    (&["cm"], 1e-2),
    (&["mm"], 1e-3),
    (&["µm", "um", "μm", "micron"], 1e-6),
    (&["nm"], 1e-9),
    (&["pm"], 1e-12),
    (&["Å", "Å", "angstrom"], 1e-10),
    (&["in"], 0.0254),
    (&["mil"], 2.54e-5),
];

/// Known names, for error messages.
pub const KNOWN: &str = "\"m\", \"cm\", \"mm\", \"µm\", \"nm\", \"pm\", \"Å\", \"in\" or \"mil\"";

/// The error for an unknown unit of length.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("\"{0}\" is no unit of length that is known")]
pub struct UnknownUnit(pub String);

/// A unit of length in metres.
fn metres(name: &str) -> Result<f64, UnknownUnit> {
    // The micro sign of Latin-1 is not UTF-8, and read as U+FFFD.
    let cleaned = name.trim().replace('\u{fffd}', "µ");
    let known = UNITS.iter().find(|(names, _)| names.contains(&&cleaned[..]));
    known.map(|(_, metres)| *metres).ok_or_else(|| UnknownUnit(name.to_owned()))
}

/// Whether a name is a known unit of length.
pub fn is_known(name: &str) -> bool {
    metres(name).is_ok()
}

/// Factor from lengths in the unit `from` to lengths in the unit `to`.
pub fn factor(from: &str, to: &str) -> Result<f64, UnknownUnit> {
    let (from, to) = (metres(from)?, metres(to)?);
    // Quotients of powers of ten without rounding.
    Ok(if from >= to { (from / to * 1e12).round() / 1e12 } else { 1.0 / ((to / from * 1e12).round() / 1e12) })
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

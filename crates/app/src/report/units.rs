//! Units of the numbers of a result.

use crate::output::UnitNames;
use percoat_case::case::{Case, Source, kind_of};
use percoat_case::units::{Unit, Units};
use percoat_core::load::LoadQuantity;
use serde_json::Value;
use std::path::Path;

/// The units of a case, or of `names` where the case cannot be read: `keys` still say whether its loads are forces.
pub(super) fn units_of(names: &UnitNames, case: Option<&Case>, keys: &Value) -> Units {
    let UnitNames { length, pressure } = names;
    let by_force = ["load", "time"].iter().any(|section| !keys[section]["force"].is_null());
    let quantity = if by_force { LoadQuantity::Force } else { kind_of(keys).load_quantity() };
    let named = || Units::unknown().named(length.as_deref(), pressure.as_deref()).with_loads_in(quantity);
    case.map_or_else(named, Case::units)
}

/// The case in a result; `None` where it cannot be read, as when the file of its topography has moved.
pub(super) fn case_of(text: &str, folder: &Path) -> Option<Case> {
    let source =
        Source { name: "case.toml".to_owned(), text: text.to_owned(), folder: folder.to_owned(), ..Source::default() };
    Case::read(&source, &[]).ok()
}

/// The units of the tables, in a sentence.
pub(super) fn measured_in(units: &Units) -> String {
    let name = |unit: &Unit, unknown: &str| match unit {
        Unit::Relative(symbol) => format!("parts of {symbol}"),
        unit => unit.name().unwrap_or_else(|| unknown.to_owned()),
    };
    let length = name(units.length(), "the case’s unit of length");
    let pressure = name(units.pressure(), "the unit of E");
    let force = name(&units.force(), "a pressure times an area of these units");
    format!(
        "Unless stated otherwise, lengths are in {length}, pressures, stresses and moduli in {pressure}; the load on one \
         indenter is a force, in {force}, an energy a pressure times a cubed length. z points into the body; stresses are positive in tension, pressures in compression."
    )
}

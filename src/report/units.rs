//! What the numbers of a result are measured in, in words.

use serde_json::Value;

/// Names of the units, where the case has them.
#[derive(Debug, Clone, Default)]
pub(super) struct Units {
    length: Option<String>,
    pressure: Option<String>,
}

impl Units {
    /// Those a result or its case names.
    pub(super) fn of(file: &Value) -> Self {
        let name = |key: &str| {
            let named = [&file["units"], &file["case"]["units"]].into_iter().find_map(|units| units[key].as_str());
            named.map(str::to_owned).filter(|name| !name.trim().is_empty())
        };
        Self { length: name("length"), pressure: name("pressure") }
    }

    /// A length as words name it: "0.5 µm".
    pub(super) fn of_length(&self, text: &str) -> String {
        with(text, self.length.as_deref())
    }

    /// A pressure: "0.06 GPa".
    pub(super) fn of_pressure(&self, text: &str) -> String {
        with(text, self.pressure.as_deref())
    }

    /// What the tables are in.
    pub(super) fn sentence(&self) -> String {
        let length = self.length.as_deref().unwrap_or("the case's unit of length");
        let pressure = self.pressure.as_deref().unwrap_or("the unit of E");
        let force = match (&self.length, &self.pressure) {
            (Some(length), Some(pressure)) => format!("{pressure}·{length}²"),
            _ => "a pressure times an area of these units".to_owned(),
        };
        format!(
            "Lengths in {length}, pressures, stresses and moduli in {pressure}; the load on one indenter is a force, in \
             {force}. z points into the body; stresses are positive in tension, pressures in compression."
        )
    }
}

fn with(text: &str, unit: Option<&str>) -> String {
    unit.map_or(text.to_owned(), |unit| format!("{text}\u{a0}{unit}"))
}

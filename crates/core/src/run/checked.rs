//! Validation of the record of a load step that is read back.

use super::StepRecord;
use crate::quantity::Quantity;
use crate::reading::{FatigueReading, Governing, LEVEL, PLASTIC, Utilisation, Verdict};
use crate::spectral::{Certificate, Stop};
use crate::stress::maxima::{CARRIED, EXTREMES};

/// A number that is null was not finite, which is allowed only in a step with [`Stop::NotANumber`]; elsewhere a null, or a pressure
/// below zero, shows that the file was damaged or edited.
impl StepRecord {
    /// Refuses a record with a number that is missing or out of range.
    ///
    /// # Errors
    /// The key and its value.
    pub fn check(&self) -> Result<(), String> {
        if self.stop == Stop::NotANumber {
            return Ok(());
        }
        let reading = &self.reading;
        let Certificate { energy_gap, penetration, load } = self.certificate;
        at_least_zero("force", reading.force)?;
        // An isolated contact has no cell, and neither of the two.
        if reading.mean_pressure.or(reading.contact_fraction).is_some() {
            at_least_zero("mean_pressure", due(reading.mean_pressure))?;
            at_least_zero("contact_fraction", due(reading.contact_fraction))?;
        }
        // Nor has its topography parts of one.
        let parts = self.rough.as_ref().and_then(|rough| reading.surroundings().per_cell(rough));
        if let Some(rough) = parts {
            for (name, value) in [
                ("rough.counted_fraction", rough.counted_fraction),
                ("rough.corrected_fraction", rough.corrected_fraction),
                ("rough.perimeter_density", rough.perimeter_density),
                ("rough.spots.density", rough.spots.density),
                ("rough.mean_gap", rough.mean_gap),
            ] {
                finite(name, due(value))?;
            }
        }
        if let Some(plastic) = &self.plastic {
            PLASTIC
                .each()
                .into_iter()
                .try_for_each(|quantity| positive(quantity, plastic, |code| format!("plastic.{code}")))?;
        }
        if let Some(beneath) = &self.beneath {
            let numbers = [
                ("hardness", beneath.hardness),
                ("pressure", beneath.pressure),
                ("depth", beneath.depth),
                ("radius", beneath.radius),
            ];
            numbers.into_iter().try_for_each(|(key, value)| at_least_zero(&format!("beneath.{key}"), value))?;
        }
        finite("penetration", reading.penetration)?;
        at_least_zero("contact_area", reading.contact_area)?;
        peak("max_pressure", reading.max_pressure)?;
        // An iteration that could not begin has no certificate.
        if self.stop.solved() {
            finite("residual", self.residual)?;
        }
        for (name, value) in [("energy_gap", energy_gap), ("penetration", penetration), ("load", load)] {
            finite(&format!("certificate.{name}"), value)?;
        }
        for level in &reading.levels {
            let name = |key: &str| format!("{key} of level {}", level.level);
            let quantities = [&LEVEL.load, &LEVEL.load_share, &LEVEL.contact_area];
            quantities.into_iter().try_for_each(|quantity| positive(quantity, level, name))?;
            peak(&name("max_pressure"), level.max_pressure)?;
        }
        if let Some(stress) = &self.stress {
            for extremes in [&stress.overall].into_iter().chain(&stress.materials).chain(&stress.faces) {
                known(&EXTREMES.each(), extremes)?;
            }
            stress.interfaces.iter().try_for_each(|carried| known(&CARRIED.each(), carried))?;
        }
        for utilisation in &self.strength {
            number(&format!("utilisation of {}", utilisation.criterion), utilisation.value)?;
            let due =
                Utilisation::new(utilisation.criterion, utilisation.value, utilisation.error, utilisation.position)
                    .verdict;
            // An error that is not finite is null in a file, and leaves the criterion undecided.
            if utilisation.verdict != due && (utilisation.verdict != Verdict::Undecided || utilisation.error.is_some())
            {
                let (criterion, is) = (utilisation.criterion, utilisation.verdict);
                let value = utilisation
                    .error
                    .map_or(utilisation.value.to_string(), |error| format!("{} ± {error}", utilisation.value));
                return Err(format!("`state` of {criterion} is `{is}`, and its utilisation {value} makes it `{due}`"));
            }
        }
        if let Some(fatigue) = &self.fatigue {
            for life in &fatigue.lives {
                at_least_zero_or_infinite(&format!("range of {}", life.part), life.range)?;
                at_least_zero_or_infinite(&format!("passes of {}", life.part), life.passes)?;
            }
            let due = FatigueReading::new(fatigue.path, fatigue.lives.clone());
            if due.as_ref().is_none_or(|due| due.first != fatigue.first) {
                let due = due.map_or("nothing".to_owned(), |due| due.first.part.to_string());
                return Err(format!(
                    "`fatigue.first` is {}, and the shortest life is that of {due}",
                    fatigue.first.part
                ));
            }
        }
        let governing = |governing: Option<&Governing>| {
            governing.map_or("nothing".to_owned(), |governing| governing.criterion.to_string())
        };
        let [is, due] = [self.governing.as_ref(), Governing::of(&self.strength).as_ref()].map(governing);
        if is == due { Ok(()) } else { Err(format!("`governing` is {is}, and the largest utilisation is of {due}")) }
    }
}

/// A number that is due, not a number where it is null.
fn due(value: Option<f64>) -> f64 {
    value.unwrap_or(f64::NAN)
}

fn refused(name: &str, value: f64) -> String {
    if value.is_nan() { format!("`{name}` is null where a number is due") } else { format!("`{name}` is {value}") }
}

/// A number, which may be infinite.
fn number(name: &str, value: f64) -> Result<(), String> {
    if value.is_nan() { Err(refused(name, value)) } else { Ok(()) }
}

fn finite(name: &str, value: f64) -> Result<(), String> {
    if value.is_finite() { Ok(()) } else { Err(refused(name, value)) }
}

fn at_least_zero(name: &str, value: f64) -> Result<(), String> {
    finite(name, value)?;
    if value < 0.0 { Err(format!("`{name}` is {value}, which is below zero")) } else { Ok(()) }
}

/// Numbers of a record, which may be infinite.
fn known<R>(quantities: &[&Quantity<R>], record: &R) -> Result<(), String> {
    let all = quantities.iter().filter_map(|quantity| Some((quantity.named.code, quantity.of(record)?.value)));
    all.into_iter().try_for_each(|(code, value)| number(code, value))
}

/// A number of a record that is not below zero, under the name made of its code.
fn positive<R>(quantity: &Quantity<R>, record: &R, name: impl Fn(&str) -> String) -> Result<(), String> {
    quantity.of(record).map_or(Ok(()), |found| at_least_zero(&name(quantity.named.code), found.value))
}

/// A number that may be infinite and is not below zero.
fn at_least_zero_or_infinite(name: &str, value: f64) -> Result<(), String> {
    number(name, value)?;
    if value < 0.0 { Err(format!("`{name}` is {value}, which is below zero")) } else { Ok(()) }
}

/// A largest pressure, which may be infinite.
fn peak(name: &str, value: f64) -> Result<(), String> {
    if value == f64::INFINITY { Ok(()) } else { at_least_zero(name, value) }
}

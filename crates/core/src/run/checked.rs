//! Validation of the record of a load step that is read back.

use super::StepRecord;
use crate::quantity::Quantity;
use crate::reading::{FatigueReading, Governing, LEVEL, PLASTIC, Utilisation, Verdict};
use crate::spectral::{Certificate, Stop};
use crate::stress::maxima::{CARRIED, EXTREMES};

/// Check of a number under a name.
type Bounded = fn(&str, f64) -> Result<(), String>;

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
        // Surfaces that adhere are drawn apart by forces below zero.
        let pulls = self.adhesion.is_some();
        let signed = if pulls { finite } else { at_least_zero };
        signed("force", reading.force)?;
        self.check_cell(signed)?;
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
        peak("max_pressure", reading.max_pressure, signed)?;
        // An iteration that could not begin has no certificate.
        if self.stop.solved() {
            finite("residual", self.residual)?;
        }
        for (name, value) in [("energy_gap", energy_gap), ("penetration", penetration), ("load", load)] {
            finite(&format!("certificate.{name}"), value)?;
        }
        for level in &reading.levels {
            let name = |key: &str| format!("{key} of level {}", level.level);
            let quantities = [&LEVEL.load_share, &LEVEL.contact_area];
            quantities.into_iter().try_for_each(|quantity| positive(quantity, level, name))?;
            signed(&name("load"), level.load)?;
            peak(&name("max_pressure"), level.max_pressure, signed)?;
        }
        if let Some(stress) = &self.stress {
            for extremes in [&stress.overall].into_iter().chain(&stress.materials).chain(&stress.faces) {
                known(&EXTREMES.each(), extremes)?;
            }
            stress.interfaces.iter().try_for_each(|carried| known(&CARRIED.each(), carried))?;
        }
        self.strength.iter().try_for_each(as_judged)?;
        self.fatigue.as_ref().map_or(Ok(()), shortest_first)?;
        let governing = |governing: Option<&Governing>| {
            governing.map_or("nothing".to_owned(), |governing| governing.criterion.to_string())
        };
        let [is, due] = [self.governing.as_ref(), Governing::of(&self.strength).as_ref()].map(governing);
        if is == due { Ok(()) } else { Err(format!("`governing` is {is}, and the largest utilisation is of {due}")) }
    }

    /// Refuses numbers per cell that are missing or out of range; an isolated contact has none of them.
    fn check_cell(&self, signed: Bounded) -> Result<(), String> {
        let reading = &self.reading;
        if reading.mean_pressure.or(reading.contact_fraction).is_some() {
            signed("mean_pressure", due(reading.mean_pressure))?;
            at_least_zero("contact_fraction", due(reading.contact_fraction))?;
        }
        let Some(rough) = self.rough.as_ref().and_then(|rough| reading.surroundings().per_cell(rough)) else {
            return Ok(());
        };
        let numbers = [
            ("rough.counted_fraction", rough.counted_fraction),
            ("rough.corrected_fraction", rough.corrected_fraction),
            ("rough.perimeter_density", rough.perimeter_density),
            ("rough.spots.density", rough.spots.density),
            ("rough.mean_gap", rough.mean_gap),
        ];
        numbers.into_iter().try_for_each(|(name, value)| finite(name, due(value)))
    }
}

/// A utilisation with the verdict that its value and error make.
fn as_judged(utilisation: &Utilisation) -> Result<(), String> {
    let Utilisation { criterion, value, error, verdict, position, .. } = *utilisation;
    number(&format!("utilisation of {criterion}"), value)?;
    let due = Utilisation::new(criterion, value, error, position).verdict;
    // An error that is not finite is null in a file, and leaves the criterion undecided.
    if verdict == due || verdict == Verdict::Undecided && error.is_none() {
        return Ok(());
    }
    let value = error.map_or(value.to_string(), |error| format!("{value} ± {error}"));
    Err(format!("`state` of {criterion} is `{verdict}`, and its utilisation {value} makes it `{due}`"))
}

/// Lives with the shortest one as the first.
fn shortest_first(fatigue: &FatigueReading) -> Result<(), String> {
    for life in &fatigue.lives {
        at_least_zero_or_infinite(&format!("range of {}", life.part), life.range)?;
        at_least_zero_or_infinite(&format!("passes of {}", life.part), life.passes)?;
    }
    let due = FatigueReading::new(fatigue.path, fatigue.lives.clone()).map(|due| due.first);
    if due == Some(fatigue.first) {
        return Ok(());
    }
    let due = due.map_or("nothing".to_owned(), |due| due.part.to_string());
    Err(format!("`fatigue.first` is {}, and the shortest life is that of {due}", fatigue.first.part))
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
fn peak(name: &str, value: f64, bounded: Bounded) -> Result<(), String> {
    if value == f64::INFINITY { Ok(()) } else { bounded(name, value) }
}

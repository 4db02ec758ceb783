//! Which numbers of a load step must be there, and what they cannot be.
//!
//! A number that is not finite is null in a file. Where a step calls itself "not a number" any may be; elsewhere a null, or a
//! pressure below zero, is a file that was damaged or edited, and no step is made of it.

use crate::run::StepRecord;
use crate::spectral::Certificate;

/// Refuses a record of which a number is missing, or is what it cannot be: which.
pub(super) fn complete(record: &StepRecord) -> Result<(), String> {
    let reading = &record.reading;
    let Certificate { energy_gap, penetration, load } = record.certificate;
    at_least_zero("mean_pressure", reading.mean_pressure)?;
    finite("penetration", reading.penetration)?;
    at_least_zero("contact_fraction", reading.contact_fraction)?;
    peak("max_pressure", reading.max_pressure, reading.singular())?;
    // An iteration that could not begin has none.
    if record.report.stop.solved() {
        finite("residual", record.report.residual)?;
    }
    for (name, value) in [("energy_gap", energy_gap), ("penetration", penetration), ("load", load)] {
        finite(&format!("certificate.{name}"), value)?;
    }
    for level in &reading.levels {
        let name = |key: &str| format!("{key} of level {}", level.level);
        for (key, value) in
            [("load", level.load), ("load_share", level.load_share), ("contact_area", level.contact_area)]
        {
            at_least_zero(&name(key), value)?;
        }
        peak(&name("max_pressure"), level.max_pressure, level.singular)?;
    }
    if let Some(stress) = &record.stress {
        let bodies = stress.materials.iter().chain(&stress.faces);
        let within = bodies.flat_map(|own| {
            [("max_tau1", own.tau1.value), ("max_tension", own.tension.value), ("max_mises", own.mises.value)]
        });
        let between = stress.interfaces.iter();
        let between = between.flat_map(|own| [("max_normal", own.normal.value), ("max_shear", own.shear.value)]);
        within.chain(between).try_for_each(|(name, value)| known(name, value))?;
    }
    record.strength.iter().try_for_each(|own| known(&format!("utilisation of {}", own.criterion), own.value))
}

fn refused(name: &str, value: f64) -> String {
    if value.is_nan() { format!("`{name}` is null where a number is due") } else { format!("`{name}` is {value}") }
}

/// Infinite at most.
fn known(name: &str, value: f64) -> Result<(), String> {
    if value.is_nan() { Err(refused(name, value)) } else { Ok(()) }
}

fn finite(name: &str, value: f64) -> Result<(), String> {
    if value.is_finite() { Ok(()) } else { Err(refused(name, value)) }
}

fn at_least_zero(name: &str, value: f64) -> Result<(), String> {
    finite(name, value)?;
    if value < 0.0 { Err(format!("`{name}` is {value}, which is below zero")) } else { Ok(()) }
}

/// A largest pressure, which is infinite where it is singular.
fn peak(name: &str, value: f64, singular: bool) -> Result<(), String> {
    if singular && value == f64::INFINITY { Ok(()) } else { at_least_zero(name, value) }
}

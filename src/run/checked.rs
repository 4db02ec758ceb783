//! Validation of the record of a load step that is read back.

use super::StepRecord;
use crate::reading::{Governing, Utilisation};
use crate::spectral::{Certificate, Stop};

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
        at_least_zero("mean_pressure", reading.mean_pressure)?;
        finite("penetration", reading.penetration)?;
        at_least_zero("contact_fraction", reading.contact_fraction)?;
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
            for (key, value) in
                [("load", level.load), ("load_share", level.load_share), ("contact_area", level.contact_area)]
            {
                at_least_zero(&name(key), value)?;
            }
            peak(&name("max_pressure"), level.max_pressure)?;
        }
        if let Some(stress) = &self.stress {
            let within = [&stress.overall].into_iter().chain(&stress.materials).chain(&stress.faces).flat_map(|own| {
                [("max_tau1", own.tau1.value), ("max_tension", own.tension.value), ("max_mises", own.mises.value)]
            });
            let between = stress.interfaces.iter();
            let between = between.flat_map(|own| [("max_normal", own.normal.value), ("max_shear", own.shear.value)]);
            within.chain(between).try_for_each(|(name, value)| number(name, value))?;
        }
        for own in &self.strength {
            number(&format!("utilisation of {}", own.criterion), own.value)?;
            let due = Utilisation::new(own.criterion, own.value, own.error, own.position).verdict;
            if own.verdict != due {
                let (criterion, is) = (own.criterion, own.verdict);
                return Err(format!(
                    "the `state` of {criterion} is {is} where its utilisation and error make it {due}"
                ));
            }
        }
        if self.governing != Governing::of(&self.strength) {
            return Err("`governing` is not what `strength` makes it".to_owned());
        }
        Ok(())
    }
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

/// A largest pressure, which may be infinite.
fn peak(name: &str, value: f64) -> Result<(), String> {
    if value == f64::INFINITY { Ok(()) } else { at_least_zero(name, value) }
}

#[cfg(test)]
mod tests {
    use crate::case::{Case, embedded};
    use crate::reading::Verdict;

    #[test]
    fn a_state_that_its_utilisation_contradicts_is_refused() {
        let case = Case::read(&embedded::source("dlc-on-steel").unwrap(), &["grid.points=32".to_owned()]).unwrap();
        let step = case.run().solve(&mut ()).unwrap().steps.pop().unwrap();
        assert_eq!(step.check(), Ok(()));
        let mut other = step.clone();
        let own = other.strength.iter_mut().find(|own| own.verdict == Verdict::Fails).unwrap();
        own.verdict = Verdict::Holds;
        assert!(other.check().unwrap_err().contains("is holds where its utilisation and error make it fails"));
        let mut other = step;
        other.governing.as_mut().unwrap().rivals = vec![other.strength[0].criterion; 9];
        assert!(other.check().unwrap_err().contains("`governing`"));
    }
}

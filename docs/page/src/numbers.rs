//! The numbers of a step that are shown first.

use crate::answer::CaseNumber;
use percoat::output::table::in_unit;
use percoat::output::with_error;
use percoat::run::StepRecord;
use percoat::stress::Peak;
use percoat::units::{Unit, Units};

/// Penetration, contact, largest pressure and largest stresses of a step.
pub fn of(step: &StepRecord, units: &Units) -> Vec<CaseNumber> {
    let reading = &step.reading;
    let shown = |name: &str, unit: &Unit, value: f64, error: Option<f64>| {
        let suited = unit.suited([value]);
        let text = suited.behind(&in_unit(&suited, value, error));
        CaseNumber { name: name.to_owned(), text, value: Some(value).filter(|x| x.is_finite()), error }
    };
    let (length, pressure) = (units.length(), units.pressure());
    let mut all = vec![shown("penetration", length, reading.penetration, reading.errors.penetration)];
    if let [level] = &reading.levels[..]
        && let Some(radius) = level.contact_radius
    {
        all.push(shown("contact radius", length, radius, level.errors.contact_radius));
    } else if let Some(part) = reading.contact_fraction {
        all.push(shown("fraction in contact", &Unit::None, part, reading.errors.contact_fraction));
    }
    all.push(shown("largest pressure", pressure, reading.max_pressure, reading.errors.max_pressure));
    if let Some(stress) = &step.stress {
        let peak = |name: &str, Peak { value, error, .. }: Peak| shown(name, pressure, value, error);
        all.push(peak("largest shear stress τ₁", stress.overall.tau1));
        all.push(peak("largest tension", stress.overall.tension));
        all.push(peak("largest von Mises stress", stress.overall.mises));
    }
    if let Some(stiffness) = step.contact_stiffness {
        let error = step.contact_stiffness_error;
        all.push(CaseNumber {
            name: "contact stiffness".to_owned(),
            text: with_error(stiffness, error),
            value: Some(stiffness),
            error,
        });
    }
    all
}

//! The numbers of a step that are shown first.

use crate::answer::CaseNumber;
use percoat_app::output::shown;
use percoat_case::units::Units;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{LEVEL, READING, SLIP};
use percoat_core::run::{STEP, StepRecord};
use percoat_core::stress::maxima::EXTREMES;

/// Penetration, contact, peak pressure, shift and stick fraction, largest stresses and contact stiffness of a step.
pub fn of(step: &StepRecord, units: &Units) -> Vec<CaseNumber> {
    /// The number of a quantity; `None` where the record does not have it.
    fn number<R>(quantity: &Quantity<R>, record: &R, units: &Units) -> Option<CaseNumber> {
        let found = quantity.of(record)?;
        let (text, value) = (shown(&quantity.named, found, units), found.finite().map(|found| found.value));
        Some(CaseNumber { name: quantity.named.name.to_owned(), text, value, error: found.error })
    }
    let reading = &step.reading;
    let radius = match &reading.levels[..] {
        [level] => number(&LEVEL.contact_radius, level, units),
        _ => None,
    };
    let mut all = vec![
        number(&READING.penetration, reading, units),
        radius.or_else(|| number(&READING.contact_fraction, reading, units)),
        number(&READING.max_pressure, reading, units),
    ];
    if let Some(slip) = &step.tangential {
        all.extend([&SLIP.tangential_shift, &SLIP.stick_fraction].map(|quantity| number(quantity, slip, units)));
    }
    if let Some(stress) = &step.stress {
        all.extend(EXTREMES.each().into_iter().map(|quantity| number(quantity, &stress.overall, units)));
    }
    all.push(number(&STEP.contact_stiffness, step, units));
    all.into_iter().flatten().collect()
}

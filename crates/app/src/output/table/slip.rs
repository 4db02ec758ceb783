//! Table of partial slip, a row a step: tangential force, shift, stick fraction and dissipated energy.

use super::{DETAILED, Table};
use crate::output::number::{in_unit, number, with_unit};
use crate::output::summary::closed_cycle;
use percoat_case::units::{Prefixed, Unit, Units};
use percoat_core::measured::Measured;
use percoat_core::quantity::Kind;
use percoat_core::reading::{SLIP, SlipReading};
use percoat_core::run::StepRecord;

/// A sentence about the slip, and the table of it, a row a step, of many steps the last ones; `None` where nothing sticks or slips.
pub fn slip(steps: &[StepRecord], units: &Units) -> Option<(String, Table)> {
    let all: Vec<(usize, &SlipReading)> =
        (1..).zip(steps).filter_map(|(number, step)| Some((number, step.tangential.as_ref()?))).collect();
    let shown = &all[all.len().saturating_sub(DETAILED.max(SHOWN))..];
    let (_, last) = shown.last()?;
    let force = units.force().suited(shown.iter().map(|(_, slip)| slip.tangential_force));
    let length = units.length().suited(shown.iter().map(|(_, slip)| slip.tangential_shift));
    let energy = units.energy().suited(shown.iter().map(|(_, slip)| slip.work));
    let rolls = last.creepage.is_some();
    let header = [
        "step".to_owned(),
        SLIP.mobilised.named.symbol.to_owned(),
        force.headed(SLIP.tangential_force.named.name),
        if rolls { SLIP.creepage.named.name.to_owned() } else { length.headed(SLIP.tangential_shift.named.name) },
        SLIP.stick_fraction.named.name.to_owned(),
        energy.headed(SLIP.work.named.name),
    ];
    let text = |unit: &Prefixed, found: Option<Measured>| found.map_or("–".to_owned(), |found| in_unit(unit, found));
    let plain = Unit::None.prefixed(1.0);
    let row = |(step, slip): &(usize, &SlipReading)| {
        let moved =
            if rolls { text(&plain, SLIP.creepage.of(slip)) } else { text(&length, SLIP.tangential_shift.of(slip)) };
        vec![
            step.to_string(),
            number(slip.mobilised),
            text(&force, SLIP.tangential_force.of(slip)),
            moved,
            text(&plain, SLIP.stick_fraction.of(slip)),
            text(&energy, SLIP.work.of(slip)),
        ]
    };
    let cycle = closed_cycle(steps).map_or(String::new(), |energy| {
        format!("; the last closed cycle dissipates {}", with_unit(&units.unit(Kind::Energy), energy))
    });
    let of = if rolls { "; energies are of one contact length rolled" } else { "" };
    let words = format!("partial slip of elastic surfaces by Coulomb's law with one coefficient{of}{cycle}");
    Some((words, Table::new(&header, shown.iter().map(row).collect(), 1)))
}

/// Most steps of a table.
const SHOWN: usize = 20;

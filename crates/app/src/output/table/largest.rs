//! The largest stresses of the load steps, by material and interface.

use super::Table;
use super::by_step::{Quantity, by_step};
use crate::output::number::in_unit;
use percoat_case::units::Units;
use percoat_core::quantity::Kind;
use percoat_core::reading::StressReading;
use percoat_core::run::StepRecord;
use percoat_core::stress::Peak;
use percoat_core::stress::maxima::{CARRIED, EXTREMES};

/// Table of the largest stresses, one row a quantity; `None` where no step has stresses.
pub fn largest_stresses(steps: &[StepRecord], units: &Units) -> Option<Table> {
    let any = steps.iter().find_map(|step| step.stress.as_ref())?;
    let row = |name: String, peak: &dyn Fn(&StressReading) -> Option<Peak>| Quantity::of_peaks(name, steps, peak);
    let material = |index: usize| {
        let material = any.materials[index].tau1.material;
        let stresses = EXTREMES.each().into_iter().filter(|quantity| quantity.named.kind == Kind::Pressure);
        let rows = stresses.enumerate().map(|(at, quantity)| {
            let peak = |stress: &StressReading| stress.materials.get(index)?.peaks().nth(at);
            row(format!("{} in {material}", quantity.named.short), &peak)
        });
        rows.collect::<Vec<_>>()
    };
    let interface = |index: usize| {
        let interface = any.interfaces[index].interface;
        let rows = CARRIED.each().into_iter().enumerate().map(|(at, quantity)| {
            let peak = |stress: &StressReading| Some(stress.interfaces.get(index)?.peaks()[at]);
            row(format!("{} on {interface}", quantity.named.short), &peak)
        });
        rows.collect::<Vec<_>>()
    };
    let materials = (0..any.materials.len()).flat_map(material);
    let rows: Vec<Quantity> = materials.chain((0..any.interfaces.len()).flat_map(interface)).collect();
    by_step("largest stress", (units.pressure(), in_unit), units, steps, &rows)
}

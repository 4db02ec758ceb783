//! The largest stresses of the load steps, by material and interface.

use super::Table;
use super::by_step::{Quantity, QuantityInStep, by_step};
use percoat_case::units::Units;
use percoat_core::reading::StressReading;
use percoat_core::run::StepRecord;
use percoat_core::stress::Peak;

/// Table of the largest stresses, one row a quantity; `None` where no step has stresses.
pub fn largest_stresses(steps: &[StepRecord], units: &Units) -> Option<Table> {
    let any = steps.iter().find_map(|step| step.stress.as_ref())?;
    let row = |name: String, peak: &dyn Fn(&StressReading) -> Option<Peak>| {
        let of = |step: &StepRecord| {
            let Peak { value, error, position, rival, .. } = peak(step.stress.as_ref()?)?;
            Some(QuantityInStep { value, error, position, rival: rival.map(|rival| rival.position) })
        };
        Quantity { name, found: steps.iter().map(of).collect() }
    };
    let material = |index: usize| {
        let own = any.materials[index].tau1.material;
        [
            row(format!("τ₁ in {own}"), &|stress| Some(stress.materials.get(index)?.tau1)),
            row(format!("tension in {own}"), &|stress| Some(stress.materials.get(index)?.tension)),
            row(format!("von Mises in {own}"), &|stress| Some(stress.materials.get(index)?.mises)),
        ]
    };
    let interface = |index: usize| {
        let own = any.interfaces[index].interface;
        [
            row(format!("tension on {own}"), &|stress| Some(stress.interfaces.get(index)?.normal)),
            row(format!("shear on {own}"), &|stress| Some(stress.interfaces.get(index)?.shear)),
        ]
    };
    let materials = (0..any.materials.len()).flat_map(material);
    let rows: Vec<Quantity> = materials.chain((0..any.interfaces.len()).flat_map(interface)).collect();
    by_step("largest stress", units.pressure(), units, steps, &rows)
}

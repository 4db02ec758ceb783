//! The table of the passes until the first damage.

use super::Worded;
use super::by_step::{Quantity, QuantityInStep, by_step, place};
use crate::output::number::number;
use percoat_case::units::{Unit, Units};
use percoat_core::reading::{FatiguePart, LIFE, Life};
use percoat_core::run::StepRecord;

/// Table of the passes after which each material and interface first has the damage 1, one row each, the one that lasts shortest in the
/// last step first; `None` without laws of fatigue.
pub fn lives(steps: &[StepRecord], units: &Units) -> Option<Worded> {
    let last = steps.iter().rev().find_map(|step| step.fatigue.as_ref().map(|fatigue| (step, fatigue)))?;
    let mut parts: Vec<&Life> = last.1.lives.iter().collect();
    parts.sort_by(|a, b| a.passes.total_cmp(&b.passes));
    let row = |part: FatiguePart| {
        let of = |step: &StepRecord| {
            let life = step.fatigue.as_ref()?.life(part)?;
            Some(QuantityInStep { measured: LIFE.passes.finite(life)?, position: life.position, rival: None })
        };
        Quantity { name: part.to_string(), found: steps.iter().map(of).collect() }
    };
    let rows: Vec<Quantity> = parts.into_iter().map(|life| row(life.part)).collect();
    let table = by_step("passes until damage 1", &Unit::None, units, steps, &rows)?;
    let (quantity, first) = (units.quantity(), &last.1.first);
    let length = units.length().suited(first.position);
    let words = format!(
        "first damage at {} = {}: {}, at {}",
        quantity.symbol(),
        units.load().with_unit(last.0.reading.load(quantity), number),
        first.in_words(number),
        length.headed(&place(&length, first.position))
    );
    Some(Worded { words, table })
}

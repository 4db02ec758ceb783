//! The table of the passes until the first damage.

use super::Worded;
use super::by_step::{Quantity, QuantityInStep, by_step, place};
use crate::output::number::{number, passes_with_error};
use percoat_case::units::{Unit, Units};
use percoat_core::reading::{FatiguePart, LIFE, Life};
use percoat_core::run::StepRecord;
use percoat_core::stress::SlidingPath;

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
    let table =
        by_step("passes until damage 1", (&Unit::None, |_, passes| passes_with_error(passes)), units, steps, &rows)?;
    let (quantity, first) = (units.quantity(), &last.1.first);
    let length = units.length().suited(first.position);
    let cycle = match last.1.path {
        SlidingPath::InPlace => "; a pass is the last closed cycle of the steps, at points that stay in place",
        _ => "",
    };
    let words = format!(
        "first damage at {} = {}: {}, at {}{cycle}",
        quantity.symbol(),
        units.load().with_unit(last.0.reading.load(quantity), number),
        first.in_words(number),
        length.headed(&place(&length, first.position))
    );
    Some(Worded { words, table })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::examples;
    use percoat_core::body::{Fatigue, MaterialId};
    use percoat_core::reading::FatigueReading;

    #[test]
    fn passes_with_a_wide_error_stand_in_the_table_as_in_the_sentence() {
        let law = Fatigue::new(0.4, 1e6, 8.0).unwrap();
        let part = FatiguePart::Material(MaterialId::numbered(1));
        let told = |error: f64| {
            let lives = vec![Life::new(part, law, 0.4, Some(error), [0.0; 3])];
            let mut step = examples::step(1.0, None, 0.5);
            step.fatigue = FatigueReading::new(SlidingPath::WholePlane, lives);
            let Worded { words, table } = lives_of_one(step);
            (words, table.rows[0][1].clone())
        };
        let (words, cell) = told(0.04);
        assert_eq!(cell, "1.0000e6, known to a factor of 2.3");
        assert!(words.contains("after 1.0000e6 passes, known to a factor of 2.3"), "{words}");
        let (words, cell) = told(0.002);
        assert!(cell == "1.00e6 ± 0.04e6" && words.contains("± 4 %"), "{cell}, {words}");
    }

    fn lives_of_one(step: StepRecord) -> Worded {
        lives(&[step], &Units::unknown()).unwrap()
    }
}

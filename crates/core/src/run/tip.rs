//! Contacts that leave the part of a tip that was measured.

use super::words::Numbered;
use crate::counterbody::Shape;
use crate::notation::number;
use crate::problem::Problem;
use std::f64::consts::PI;

/// Warning about the levels whose contact leaves the measured part of their tip in some of the steps.
pub(super) fn beyond(problem: &Problem, steps: &[Numbered]) -> Option<String> {
    let levels = (1..).zip(problem.levels()).zip(0..);
    let told = levels.filter_map(|((number, level), index): ((usize, _), usize)| {
        let loads = steps.iter().filter_map(|(_, step)| step.reading.levels.get(index));
        // Merged contacts have no radius, but an area.
        let radii = loads.filter(|level| level.touches()).map(|level| (level.contact_area / PI).sqrt());
        let ends = radii.fold([f64::INFINITY, 0.0], |[low, high]: [f64; 2], a| [low.min(a), high.max(a)]);
        outside(&problem.level_name(number).to_string(), level.shape(), ends)
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| told.join("; "))
}

/// Warning that contacts with radii from the least to the largest, lengths, leave the measured part of the tip of a `level`.
pub fn outside(level: &str, shape: &Shape, [least, most]: [f64; 2]) -> Option<String> {
    let Shape::Measured(tip) = shape else { return None };
    let [from, to] = tip.range();
    let mut told = Vec::new();
    if most > to {
        told.push(format!(
            "the contact radius reaches {} and the tip was measured up to {}, from where on it is taken to go on as a cone: measure it \
             further, or press less",
            number(most),
            number(to)
        ));
    }
    if least < from {
        told.push(format!(
            "the contact radius {} is within the least measured one, {}, inside of which the apex is taken as rounded: measure its apex, or \
             leave the smallest loads out",
            number(least),
            number(from)
        ));
    }
    (!told.is_empty()).then(|| format!("{level}: {}", told.join("; ")))
}

//! Parts that sentences about steps share: their numbers, ratios, and from where on strains are not small.

use super::StepRecord;

/// Slope of a flank beyond which strains are not small.
pub const STEEP: f64 = 0.5;
/// Peak pressure over E*, or part of a thickness, beyond which strains are not small.
pub const HIGH: f64 = 1.0 / 3.0;

/// A step with its number in the outputs.
pub(super) type Numbered<'a> = (usize, &'a StepRecord);

/// Numbers of the steps for which `of` is true, as a list; `None` without any.
pub(super) fn list(steps: &[Numbered], of: impl Fn(&StepRecord) -> bool) -> Option<String> {
    let numbers = steps.iter().filter(|(_, step)| of(step)).map(|(number, _)| number.to_string());
    Some(numbers.collect::<Vec<_>>().join(", ")).filter(|list| !list.is_empty())
}

/// A ratio, with two decimals or two digits.
pub fn ratio(x: f64) -> String {
    if (0.01..1000.0).contains(&x) { format!("{x:.2}") } else { format!("{x:.1e}") }
}

//! Parts that sentences about steps share: their numbers, ratios, and from where on strains are not small.

use super::StepRecord;

/// Slope of a flank beyond which strains are not small.
pub const STEEP: f64 = 0.5;
/// Peak pressure over E*, or part of a thickness, beyond which strains are not small.
pub const HIGH: f64 = 1.0 / 3.0;

/// A step with its number in the outputs.
pub(super) type Numbered<'a> = (usize, &'a StepRecord);

/// Numbers of the steps for which `of` is true, as a list: "1, 4 to 7"; `None` without any.
pub(super) fn list(steps: &[Numbered], of: impl Fn(&StepRecord) -> bool) -> Option<String> {
    let numbers: Vec<usize> = steps.iter().filter(|(_, step)| of(step)).map(|(number, _)| *number).collect();
    (!numbers.is_empty()).then(|| joined(&numbers))
}

/// Numbers as a list, three or more that follow each other as a range.
fn joined(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, _, .., last] => format!("{first} to {last}"),
        _ => run.iter().map(usize::to_string).collect::<Vec<_>>().join(", "),
    });
    runs.collect::<Vec<_>>().join(", ")
}

/// A ratio, with two decimals or two digits.
pub fn ratio(x: f64) -> String {
    if (0.01..1000.0).contains(&x) { format!("{x:.2}") } else { format!("{x:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_that_follow_each_other_are_a_range() {
        let lists = [&[2][..], &[1, 2], &[1, 2, 3], &[1, 3, 4, 5, 7, 9, 10]].map(joined);
        assert_eq!(lists, ["2", "1, 2", "1 to 3", "1, 3 to 5, 7, 9, 10"]);
    }
}

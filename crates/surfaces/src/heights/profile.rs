//! Profiles: points x z along a line, which are no surface.

use super::fault::{Fault, Heights, PROFILE};

/// Fewest points of a profile.
const FEWEST: usize = 6;

/// Refuses a table of two columns or of two lines of which the first rises or falls throughout, as the places of a profile do.
pub fn refuse(table: &Heights) -> Result<(), Fault> {
    let Heights { points: [lines, numbers], values } = table;
    // A surface that does not change along one axis may have two equal lines.
    let columns =
        *numbers == 2 && is_ordered(values.iter().step_by(2)) && values.chunks_exact(2).any(|line| line[0] != line[1]);
    let rows = *lines == 2 && is_ordered(values[..*numbers].iter()) && values[..*numbers] != values[*numbers..];
    match (columns, rows) {
        (true, _) => Err(fault(&format!("{lines} lines of two numbers, of which the first rise or fall throughout"))),
        (_, true) => {
            Err(fault(&format!("two lines of {numbers} numbers, of which the first rises or falls throughout")))
        }
        _ => Ok(()),
    }
}

/// The fault of a file with the points of a profile.
pub fn fault(points: &str) -> Fault {
    Fault::new(format!("holds {points}: the points x z of a profile?"), "a profile?").help(PROFILE)
}

/// Whether numbers rise or fall throughout, equal neighbours by rounding apart.
pub fn is_ordered<'a>(numbers: impl Iterator<Item = &'a f64> + Clone) -> bool {
    let steps = numbers.clone().zip(numbers.skip(1)).map(|(a, b)| b - a);
    let (mut rising, mut falling, mut all) = (0, 0, 0);
    for step in steps {
        all += 1;
        rising += usize::from(step > 0.0);
        falling += usize::from(step < 0.0);
        if step.is_nan() || rising.min(falling) > 0 {
            return false;
        }
    }
    all + 1 >= FEWEST && 2 * rising.max(falling) >= all
}

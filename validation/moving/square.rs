//! Coated bodies below paraboloids in a square cell, against a spectral prototype on 1024² samples.

use super::setup::{Stack, TOLERANCE, friction, moving, paraboloids, solved};
use crate::{Check, Data, Outcome, StudyError, Tolerance};

const SIZES: [usize; 3] = [128, 256, 512];
/// Errors of a prototype's δ and μ on 128² samples.
const PROTOTYPE: [f64; 2] = [1.1e-6, 1.6e-5];
/// Error of the peak on 128² samples: its crest lies as few as four samples from the leading edge, ½/4².
const PEAK: f64 = 3e-2;
/// Half a unit of the last digit of a reference.
const DIGIT: f64 = 5e-8;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let table = Data::parse("paraboloids", include_str!("paraboloids.csv"))?;
    let mut data = Data::new(
        "paraboloids",
        &["body", "velocity", "points", "delta", "friction", "energy", "error", "peak", "exact"],
    );
    let sizes = if quick { &SIZES[..1] } else { &SIZES[..] };
    for known in &table.rows {
        for &points in sizes {
            let stack = if known[0] == 0.0 { Stack::soft(10.0) } else { Stack::stiff(10.0) };
            let problem = moving(paraboloids()?, stack.half_space()?, known[1])?;
            let step = solved(problem, [points; 2], [known[2], TOLERANCE])?;
            let reading = friction(&step)?;
            data.rows.push(vec![
                known[0],
                known[1],
                points as f64,
                step.penetration(),
                reading.friction_coefficient,
                reading.by_energy,
                reading.error.unwrap_or(f64::NAN),
                step.reading().max_pressure,
                known[4],
            ]);
        }
    }
    let known = |index: usize| &table.rows[index / sizes.len()];
    let rows = || data.rows.iter().enumerate();
    for &points in sizes {
        let on_grid = |value: usize, of: usize| {
            rows()
                .filter(move |(_, row)| row[2] == points as f64)
                .map(move |(index, row)| (row[value], known(index)[of]))
        };
        // Twice the prototype's on 128² samples, and h^1.5 by the edge of the contact, to two digits.
        let share = (200.0 * (128.0 / points as f64).powf(1.5)).floor() / 100.0;
        let [depth, coefficient] = PROTOTYPE.map(|error| Tolerance::Absolute(share * error + DIGIT));
        let mut worst = |name: &str, value, of, tolerance| {
            let name = format!("coated, paraboloids: {name}, {points}² samples");
            outcome.checks.push(Check::worst(name, on_grid(value, of), tolerance));
        };
        worst("penetration", 3, 3, depth);
        worst("friction by shape", 4, 4, coefficient);
        worst("friction by energy", 5, 4, coefficient);
        worst("peak", 7, 5, Tolerance::Relative(PEAK * (128.0 / points as f64).powi(2)));
    }
    let stated = rows().map(|(index, row)| (((row[4] - known(index)[4]).abs() - DIGIT) / row[6], 1.0));
    let name = "coated, paraboloids: error of friction by shape, over the stated one";
    outcome.checks.push(Check::worst(name, stated, Tolerance::AtMost));
    outcome.data.push(data);
    Ok(())
}

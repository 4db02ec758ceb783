//! Place of the largest range in a coated body with the same law of fatigue in all of it.

use super::coated::{hertz, under};
use super::lines::{Parts, fatigue_durability};
use crate::{Check, Data, Outcome, StudyError, Tolerance};

const PLACES: &str = include_str!("places.csv");
/// Friction of the rows.
const FRICTIONS: [f64; 2] = [0.1, 0.3];
/// Least factor by which the range of the largest place exceeds that of the next one.
const MARGIN: f64 = 1.1;
/// Parts of the thickness that belong to the surface and to the interface.
const NEAR: f64 = 0.1;
const DEEP: f64 = 0.8;
/// Tolerance of the ranges: depths of the table are up to 0.15h apart.
const VALUE: f64 = 2e-2;
/// Surface, inside the coating, at its side of the interface, substrate.
const SURFACE: usize = 0;
const INSIDE: usize = 1;
const INTERFACE: usize = 2;
const SUBSTRATE: usize = 3;

fn part(z: f64, h: f64) -> usize {
    if z < NEAR * h {
        SURFACE
    } else if z > DEEP * h {
        INTERFACE
    } else {
        INSIDE
    }
}

/// Place and value of the largest range of a row, and what it has over the next place.
fn place(row: &[f64]) -> Result<(usize, f64, f64), StudyError> {
    let &[_, h, _, surface, inside, z, above, below_interface, below, ..] = row else {
        return Err("a row too short".into());
    };
    let mut values = [surface, 0.0, above, below_interface.max(below)];
    let part = part(z, h);
    values[part] = inside.max(values[part]);
    let largest = (0..4).fold(0, |best, k| if values[k] > values[best] { k } else { best });
    let next = (0..4).filter(|&k| k != largest).map(|k| values[k]).fold(0.0, f64::max);
    Ok((largest, values[largest], values[largest] / next))
}

pub fn places(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let mut data = Data::new("places", &["E1", "h", "mu", "place", "place_exact", "range", "range_exact", "margin"]);
    let step = hertz()?;
    for row in Data::parse("places", PLACES)?.rows {
        let [modulus, h, mu] = [row[0], row[1], row[2]];
        let (known, exact, margin) = place(&row)?;
        if !FRICTIONS.contains(&mu) || margin < MARGIN {
            continue;
        }
        let law = fatigue_durability()?;
        let parts = Parts { coating: Some([h, modulus, 0.3]), substrate: [1.0, 0.3] };
        let body = parts.cut(&[h], |_| law)?.with_substrate_durability(law)?;
        let found = under(&step, &body, mu)?;
        let [coating, substrate] = [0, 1]
            .map(|k| found.materials.get(k).and_then(|material| material.range))
            .map(|range| range.ok_or("no range"));
        let (coating, substrate) = (coating?, substrate?);
        let part = if coating.value >= substrate.value { part(coating.position[2], h) } else { SUBSTRATE };
        data.rows.push(vec![
            modulus,
            h,
            mu,
            part as f64,
            known as f64,
            coating.value.max(substrate.value),
            exact,
            margin,
        ]);
    }
    outcome.checks.extend([
        Check::worst(
            "place of the largest Δτ₁ where it exceeds others by a tenth: surface 0, inside 1, interface 2, substrate 3",
            data.rows.iter().map(|row| (row[3], row[4])),
            Tolerance::Absolute(0.0),
        ),
        Check::worst("its Δτ₁/p₀", data.rows.iter().map(|row| (row[5], row[6])), Tolerance::Relative(VALUE)),
    ]);
    Ok(data)
}

//! Where a layer may be taken for springs side by side.

use super::setup::{Slide, layer};
use super::sheet::Sheet;
use super::statement::Statement;
use crate::{Check, Data, Outcome, StudyError};

/// Half-width of the relaxed contact with springs.
const HALF: f64 = 0.1;
/// A moderate relaxation, whose wake ends within the cell.
const RATIO: f64 = 4.0;
const WAYS: [f64; 3] = [0.03, 0.1, 0.3];
/// Thickness over half-width: of a thick layer and of thin ones.
const THICKNESSES: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0625];
const NEARLY_INCOMPRESSIBLE: f64 = 0.49;
/// "Thin": within a tenth. Thick: no less than a fifth off.
const THIN: f64 = 0.1;
const THICK: f64 = 0.2;
/// What is left of the difference at no thickness.
const LIMIT: f64 = 0.03;

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns = ["poisson", "thickness", "way", "friction", "error", "springs", "peak", "peak_error", "springs_peak"];
    let mut data = Data::new("thin", &columns);
    let thicknesses = if quick { &[THICKNESSES[0], THICKNESSES[4]][..] } else { &THICKNESSES[..] };
    let ways = if quick { &WAYS[1..2] } else { &WAYS[..] };
    for &thickness in thicknesses {
        for &way in ways {
            data.rows.push(row(0.3, thickness, way)?);
        }
    }
    for &way in ways {
        data.rows.push(row(NEARLY_INCOMPRESSIBLE, THICKNESSES[4], way)?);
    }
    let off = |poisson: f64, thickness: f64, column: usize| {
        let rows = data.rows.iter().filter(move |row| row[0] == poisson && row[1] == thickness);
        rows.map(move |row| (row[column] / row[column + 2] - 1.0).abs()).fold(0.0, f64::max)
    };
    let [thick, thin] = [THICKNESSES[0], THICKNESSES[4]];
    let named = |what: &str| format!("{what} by springs, relative error");
    let statement = Statement::new("springs do where the layer is soft and thin")
        .says(Check::at_most(named("friction at h = a/16, ν = 0.3,"), off(0.3, thin, 3), THIN))
        .says(Check::at_most(named("peak at h = a/16, ν = 0.3,"), off(0.3, thin, 6), THIN))
        .denied(Check::at_least(named("friction at h = a, ν = 0.3,"), off(0.3, thick, 3), THICK))
        .says(Check::at_most(named("friction at h = a/16, ν = 0.49,"), off(NEARLY_INCOMPRESSIBLE, thin, 3), THIN))
        .denied(Check::at_most(named("peak at h = a/16, ν = 0.49,"), off(NEARLY_INCOMPRESSIBLE, thin, 6), THIN));
    if !quick {
        limits(outcome, &data);
    }
    statement.judge(outcome, quick);
    outcome.data.push(data);
    Ok(())
}

/// Friction and peak over those of springs, drawn on to no thickness.
fn limits(outcome: &mut Outcome, data: &Data) {
    for (name, column) in [("friction", 3), ("peak", 6)] {
        let ratio = |thickness: f64, way: f64| {
            let of = |row: &&Vec<f64>| row[0] == 0.3 && row[1] == thickness && row[2] == way;
            data.rows.iter().find(of).map_or(f64::NAN, |row| row[column] / row[column + 2])
        };
        let pairs = WAYS.map(|way| (2.0 * ratio(THICKNESSES[4], way) - ratio(THICKNESSES[3], way), 1.0));
        let name = format!("{name} of thin layers over that of springs, drawn on to no thickness");
        outcome.checks.push(Check::worst(name, pairs, crate::Tolerance::Absolute(LIMIT)));
    }
}

/// A layer of a thickness and a way, over the half-width, by percoat and by springs under the same load.
fn row(poisson: f64, thickness: f64, way: f64) -> Result<Vec<f64>, StudyError> {
    let sheet = Sheet { thickness: thickness * HALF, poisson, ratio: RATIO, way: way * HALF };
    let load = std::f64::consts::PI * HALF.powi(4) * sheet.stiffness() / 4.0;
    let springs = sheet.under(load);
    let slide = Slide { exponent: 2.0, sides: [8.0 * HALF, 4.0 * HALF], points: [384, 192], way: sheet.way, load };
    let slid = slide.over(layer(Some(sheet.thickness), poisson, RATIO)?)?;
    let ([friction, error], [peak, peak_error]) = (slid.friction, slid.peak);
    Ok(vec![poisson, thickness, way, friction, error, springs.friction, peak, peak_error, springs.peak])
}

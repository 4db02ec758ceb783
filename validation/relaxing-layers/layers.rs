//! A layer that relaxes on a rigid base beside the half-space of its material.

use super::setup::{HERTZ, POISSON, RADIUS, RATIO, Slid, Slide, change, clear, layer};
use super::statement::Statement;
use crate::{Check, Data, Outcome, StudyError, Tolerance};

/// Thicknesses over a₀; 0 stands for the half-space.
pub const THICKNESSES: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 0.0];
const POISSONS: [f64; 2] = [POISSON, 0.45];
/// Cell and samples a side.
const SIDE: f64 = 12.0;
/// Friction at the slowest and the fastest way over the largest one: so much a maximum stands out.
const ENDS: f64 = 0.8;
/// A change is seen from so many of its errors on.
const SEEN: f64 = 3.0;
const QUANTITIES: [&str; 3] = ["friction", "the peak", "τ₁"];

pub fn add(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let columns = ["poisson", "thickness", "way", "friction", "error", "energy", "peak", "peak_error"];
    let mut data = Data::new("velocities", &columns);
    let thicknesses = if quick { &[0.5, 2.0, 0.0][..] } else { &THICKNESSES[..] };
    let poissons = if quick { &POISSONS[..1] } else { &POISSONS[..] };
    for &poisson in poissons {
        for &thickness in thicknesses {
            for way in ways(quick) {
                let slid = slid(thickness, poisson, way, points(quick))?;
                let ([friction, error], [peak, peak_error]) = (slid.friction, slid.peak);
                data.rows.push(vec![poisson, thickness, way, friction, error, slid.by_energy, peak, peak_error]);
            }
        }
    }
    let stated = data.rows.iter().map(|row| ((row[3] - row[5]).abs() / row[4], 1.0));
    let name = "friction by shape less that by energy, over the stated error";
    outcome.checks.push(Check::worst(name, stated, Tolerance::AtMost));
    slow(outcome, thicknesses, poissons, points(quick))?;
    maxima(outcome, &data, [thicknesses, poissons], quick)?;
    influences(outcome, quick)?;
    outcome.data.push(data);
    Ok(())
}

/// Ways in the relaxation time over a₀.
fn ways(quick: bool) -> Vec<f64> {
    crate::draw::logarithmic(0.02, 5.0, if quick { 6 } else { 11 })
}

fn points(quick: bool) -> usize {
    if quick { 96 } else { 128 }
}

fn slid(thickness: f64, poisson: f64, way: f64, points: usize) -> Result<Slid, StudyError> {
    let thickness = (thickness > 0.0).then_some(thickness * HERTZ);
    Slide::square(SIDE, points, way).over(layer(thickness, poisson, RATIO)?)
}

/// On a rigid base all waves of one constant ν follow G(iω) alone: in slow motion μ = vτ (r − 1)/R at any thickness.
fn slow(outcome: &mut Outcome, thicknesses: &[f64], poissons: &[f64], points: usize) -> Result<(), StudyError> {
    let way = 1e-5;
    let mut pairs = Vec::new();
    for &poisson in poissons {
        for &thickness in thicknesses {
            let slid = slid(thickness, poisson, way, points)?;
            let law = way * HERTZ * (RATIO - 1.0) / RADIUS;
            pairs.push(((1.0 - slid.friction[0] / law) * slid.step.reading().spot_resolution, 0.5));
        }
    }
    let name = "slow law at any thickness: shortfall times the samples of a radius";
    outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(0.5)));
    Ok(())
}

/// The rows of one layer, by their way.
pub fn curve(data: &Data, poisson: f64, thickness: f64) -> Vec<&Vec<f64>> {
    data.rows.iter().filter(|row| row[0] == poisson && row[1] == thickness).collect()
}

/// Way and value of the largest friction over the velocity: a parabola in ln v, the ways equally spaced there, through the three largest.
pub fn largest(rows: &[&Vec<f64>]) -> [f64; 2] {
    let top = (1..rows.len() - 1).max_by(|&a, &b| rows[a][3].total_cmp(&rows[b][3])).unwrap_or(1);
    let [left, middle, right] = [top - 1, top, top + 1].map(|k| rows[k][3]);
    let (slope, bend) = (0.5 * (right - left), right - 2.0 * middle + left);
    let ratio = rows[top][2] / rows[top - 1][2];
    [rows[top][2] * ratio.powf(-slope / bend), middle - 0.5 * slope * slope / bend]
}

/// The largest friction once more on twice the samples a side, at the way of [`largest`] and a fifth beside it; with its relative error.
fn refined(data: &Data, poisson: f64, thickness: f64, quick: bool) -> Result<[f64; 4], StudyError> {
    let [way, _] = largest(&curve(data, poisson, thickness));
    let mut rows = Vec::new();
    for part in [0.8, 1.0, 1.25] {
        let [friction, error] = slid(thickness, poisson, part * way, 2 * points(quick))?.friction;
        rows.push(vec![poisson, thickness, part * way, friction, error]);
    }
    let [way, crest] = largest(&rows.iter().collect::<Vec<_>>());
    let [middle, error] = [rows[1][3], rows[1][4]];
    Ok([thickness, way, crest, error / middle + (crest / middle - 1.0).abs()])
}

fn maxima(
    outcome: &mut Outcome,
    data: &Data,
    [thicknesses, poissons]: [&[f64]; 2],
    quick: bool,
) -> Result<(), StudyError> {
    let each = || poissons.iter().flat_map(|&poisson| thicknesses.iter().map(move |&thickness| (poisson, thickness)));
    let ends = |(poisson, thickness): (f64, f64)| {
        let rows = curve(data, poisson, thickness);
        (rows[0][3].max(rows[rows.len() - 1][3]) / largest(&rows)[1], ENDS)
    };
    let name = "friction at the ends over the largest one, worst layer";
    Statement::new("friction has a maximum over the velocity")
        .says(Check::worst(name, each().map(ends), Tolerance::AtMost))
        .judge(outcome, quick);
    let mut found = Data::new("maxima", &["poisson", "thickness", "way", "friction", "relative_error"]);
    for (poisson, thickness) in each() {
        found.rows.push([poisson].into_iter().chain(refined(data, poisson, thickness, quick)?).collect());
    }
    let below = |row: &Vec<f64>| {
        let bare = found.rows.iter().find(|bare| bare[0] == row[0] && bare[1] == 0.0);
        (bare.map_or(f64::NAN, |bare| row[3] / bare[3] * (1.0 + row[4] + bare[4])), 1.0)
    };
    let layers = found.rows.iter().filter(|row| row[1] > 0.0).map(below);
    let name = "largest friction of a layer over that of the half-space, with its error, worst layer";
    Statement::new("the largest friction is larger on a half-space than on a layer")
        .says(Check::worst(name, layers, Tolerance::AtMost))
        .judge(outcome, quick);
    outcome.data.push(found);
    Ok(())
}

/// Velocity, thickness and ν, one after the other: their changes of friction, peak and τ₁ over the errors of these.
fn influences(outcome: &mut Outcome, quick: bool) -> Result<(), StudyError> {
    let base = (1.0, POISSON, 0.3);
    let cases =
        [("velocity", (1.0, POISSON, 1.0)), ("thickness", (0.5, POISSON, 0.3)), ("Poisson's ratio", (1.0, 0.45, 0.3))];
    let read = |(thickness, poisson, way): (f64, f64, f64)| -> Result<[[f64; 2]; 3], StudyError> {
        let slide = Slide::square(8.0, if quick { 96 } else { 384 }, way);
        let slid = slide.over(layer(Some(thickness * HERTZ), poisson, RATIO)?)?;
        Ok([slid.friction, slid.peak, if quick { [f64::NAN; 2] } else { slid.shear(0)? }])
    };
    let from = read(base)?;
    let mut data = Data::new("influences", &["parameter", "quantity", "change", "error"]);
    for (parameter, (_, case)) in cases.iter().enumerate() {
        for (quantity, to) in read(*case)?.into_iter().enumerate().take(if quick { 1 } else { 3 }) {
            let [change, error] = change(from[quantity], to);
            data.rows.push(vec![parameter as f64, quantity as f64, change, error]);
        }
    }
    let mut statement = Statement::new("velocity, thickness and ν change friction, peak and stresses");
    for row in &data.rows {
        let [parameter, quantity] = [row[0], row[1]].map(|index| index as usize);
        let name = format!("{}, change of {} over its error", cases[parameter].0, QUANTITIES[quantity]);
        statement = statement.says(Check::at_least(name, clear([row[2], row[3]]), SEEN));
    }
    statement.judge(outcome, quick);
    outcome.data.push(data);
    Ok(())
}

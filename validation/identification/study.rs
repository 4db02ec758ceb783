//! Moduli and thickness of a coating from the indentation curve of an integral equation, with and without noise, and the derivatives
//! from which their standard errors come.

use super::alone::{POINTS, WINDOW, half_space, problem};
use super::draw::{self, curve};
use super::steps::Steps;
use super::{Check, Data, Outcome, Study, StudyError, Tolerance};
use percoat_app::picture::{Axis, Chart, Curve, Figure, Style};
use percoat_core::body::Interface::Bonded;
use percoat_core::counterbody::Shape;
use percoat_core::identification::{
    Identification, IdentificationError, MOST_UNCERTAIN, Measurement, Model, Parameter, Quantity,
};
use percoat_core::load::Load;
use percoat_core::problem::Problem;
use percoat_core::spectral::Settings;

pub const STUDY: Study = Study {
    name: "identification",
    title: "Moduli and thickness of a coating from its indentation curve, and the derivatives behind them",
    files: &["curve.data.csv", "derivatives.data.csv", "figure.png", "found.data.csv"],
    run: || run(true),
    quick: Some(|| run(false)),
};

const EXACT: &str = include_str!("indentation.csv");
const NOISY: &str = include_str!("indentation_noisy.csv");
const DERIVATIVES: &str = include_str!("indentation_derivatives.csv");

/// A ball of 10 µm; the units are µm and GPa, so that forces are in mN.
const BALL: Shape = Shape::Paraboloid { radius: 10.0 };
/// Moduli of coating and substrate, and the thickness.
const KNOWN: [f64; 3] = [300.0, 70.0, 1.0];
/// Start of the search with noise.
const START: [f64; 3] = [270.0, 75.0, 1.1];
const NAMES: [&str; 3] = ["E_c", "E_s", "h"];
/// Standard deviation of the noise, µm.
const NOISE: f64 = 5e-4;
/// Samples along the windows of a curve: 22 to the radius, which leave some 2·10⁻⁴ of δ.
const COARSE: usize = 64;
/// Largest force of a range that does not contain all three, mN: the standard error of the thickness is 0.76 of it.
const LIGHT: f64 = 8.0;

/// The ball on a coating with these moduli and thickness, in a window.
fn model(values: [f64; 3], side: f64) -> Result<Problem, StudyError> {
    let [coating, substrate, thickness] = values;
    problem(BALL, half_space(&[(thickness, coating, 0.2, Bonded)], [substrate, 0.3])?, side)
}

/// The first `starts.len()` of the values in the order of [`KNOWN`] from a measured curve, the others known.
fn found(
    starts: &[f64],
    measured: &Measurement,
    points: usize,
) -> Result<Identification, IdentificationError<StudyError>> {
    let parameter =
        |(name, &start): (&str, &f64)| Parameter { name: name.to_owned(), quantity: Quantity::Positive, start };
    let parameters: Vec<Parameter> = NAMES.into_iter().zip(starts).map(parameter).collect();
    let problem = |values: &[f64]| {
        let mut all = KNOWN;
        all[..values.len()].copy_from_slice(values);
        model(all, 4.0)
    };
    let settings = Settings { tolerance: 1e-9, ..Settings::default() };
    Identification::new(&Model { problem: &problem, points, settings }, &parameters, measured)
}

fn columns(text: &str) -> Result<[Vec<f64>; 2], StudyError> {
    let table = Data::parse("indentation", text)?;
    Ok([table.column("force_mN"), table.column("penetration_um")])
}

/// The whole study, or derivatives and moduli alone.
fn run(is_whole: bool) -> Result<Outcome, StudyError> {
    let mut outcome = Outcome::default();
    let derivatives = derivatives(&mut outcome)?;
    let mut data = Data::new("found", &["noise", "E_c", "error_E_c", "E_s", "error_E_s", "h", "error_h"]);
    exact(&mut data, &mut outcome)?;
    let curve = if is_whole {
        standard_errors(&mut outcome)?;
        light(&mut outcome)?;
        noisy(&mut data, &mut outcome)?
    } else {
        Data::new("curve", &[])
    };
    outcome.figures.push(("figure", figure(&derivatives, &curve)));
    outcome.data = vec![derivatives, data, curve];
    Ok(outcome)
}

/// Penetration, stiffness and ∂δ/∂ln θ under five loads, with the samples of the study `free-space`.
fn derivatives(outcome: &mut Outcome) -> Result<Data, StudyError> {
    let table = Data::parse("derivatives", DERIVATIVES)?;
    let columns = [
        "force",
        "delta",
        "delta_exact",
        "S",
        "S_exact",
        "by_Ec",
        "by_Ec_exact",
        "by_Es",
        "by_Es_exact",
        "by_h",
        "by_h_exact",
    ];
    let mut data = Data::new("derivatives", &columns);
    for row in &table.rows {
        let (force, stiffness) = (row[0], row[2]);
        // S = 2 E_eq a to some percent of the radius, which only lays out the window.
        let coarse = Steps::to(model(KNOWN, 6.0)?, [64; 2], 1e-8)?.solve(Load::Force(force))?.1;
        let side = WINDOW * coarse.levels[0].contact_radius.unwrap_or(f64::NAN);
        let mut steps = Steps::to(model(KNOWN, side)?, [POINTS; 2], 1e-10)?;
        let step = steps.step(Load::Force(force))?;
        let tangent = steps.solver.tangent().ok_or("no tangent")?;
        let mut values = vec![force, step.penetration(), row[1], tangent.stiffness(), stiffness];
        for (index, exact) in row[3..6].iter().enumerate() {
            // Five points, 0.02 apart in the logarithm.
            let at = |k: f64| {
                let mut all = KNOWN;
                all[index] *= (0.02 * k).exp();
                model(all, side)
            };
            let [two, one] = [2.0, 1.0].map(|k| Ok::<_, StudyError>([at(k)?, at(-k)?]));
            let ([two, back_two], [one, back_one]) = (two?, one?);
            let weights = [(-1.0, &two), (8.0, &one), (-8.0, &back_one), (1.0, &back_two)];
            let quotient = weights.map(|(weight, perturbed)| (weight / (12.0 * 0.02), perturbed));
            values.extend([tangent.penetration(step.finest(), &quotient), *exact]);
        }
        data.rows.push(values);
    }
    for (name, first, tolerance) in [("penetration δ", 1, 3e-4), ("stiffness dP/dδ", 3, 1.4e-3)] {
        let pairs = data.rows.iter().map(|row| (row[first], row[first + 1]));
        outcome.checks.push(Check::worst(format!("five loads: {name}"), pairs, Tolerance::Relative(tolerance)));
    }
    // Over the one by all moduli together, −P/S.
    for (name, first) in [("∂δ/∂ln E_c", 5), ("∂δ/∂ln E_s", 7), ("∂δ/∂ln h", 9)] {
        let pairs = data.rows.iter().map(|row| [0, 1].map(|k| row[first + k] * row[4] / row[0]).into());
        let name = format!("five loads: {name} over P/S");
        outcome.checks.push(Check::worst(name, pairs, Tolerance::Absolute(1.4e-3)));
    }
    Ok(data)
}

/// The moduli from the exact curve.
fn exact(data: &mut Data, outcome: &mut Outcome) -> Result<(), StudyError> {
    let [forces, penetrations] = columns(EXACT)?;
    let fit = found(&[150.0, 140.0], &Measurement::new(forces, penetrations, None)?, COARSE)?;
    for (estimate, known) in fit.estimates.iter().zip(KNOWN) {
        let name = format!("exact curve: {}", estimate.parameter.name);
        outcome.checks.push(Check::relative(name, estimate.value, known, 3e-3));
    }
    data.rows.push(row(0.0, &fit));
    Ok(())
}

/// Moduli and thickness from the noisy curve.
fn noisy(data: &mut Data, outcome: &mut Outcome) -> Result<Data, StudyError> {
    let ([forces, penetrations], [_, measured]) = (columns(EXACT)?, columns(NOISY)?);
    let fit = found(&START, &Measurement::new(forces.clone(), measured.clone(), None)?, COARSE)?;
    outcome.checks.push(within("noisy curve: E_c, E_s, h, off by standard errors", &fit));
    // The standard deviation of s is s/√(2·57).
    outcome.checks.push(Check::relative("noisy curve: residual, nm", 1e3 * fit.rms, 1e3 * NOISE, 0.25));
    data.rows.push(row(NOISE, &fit));
    let mut curve = Data::new("curve", &["force", "penetration", "noisy", "fitted", "band"]);
    for (i, force) in forces.into_iter().enumerate() {
        curve.rows.push(vec![force, penetrations[i], measured[i], fit.fitted[i], fit.band[i]]);
    }
    Ok(curve)
}

fn within(name: &str, fit: &Identification) -> Check {
    let pairs = fit.estimates.iter().zip(KNOWN);
    let pairs = pairs.map(|(estimate, known)| ((estimate.value - known) / estimate.error, 0.0));
    Check::worst(name, pairs, Tolerance::Absolute(3.0))
}

fn row(noise: f64, fit: &Identification) -> Vec<f64> {
    let mut row = vec![noise];
    row.extend(
        (0..3).flat_map(|k| fit.estimates.get(k).map_or([f64::NAN; 2], |estimate| [estimate.value, estimate.error])),
    );
    row
}

/// Standard errors from the five loads whose derivatives J are known: σ √((JᵀJ)⁻¹)ₖₖ.
fn standard_errors(outcome: &mut Outcome) -> Result<(), StudyError> {
    let table = Data::parse("derivatives", DERIVATIVES)?;
    let [forces, penetrations] = columns(DERIVATIVES)?;
    let deviations = Some(vec![NOISE; forces.len()]);
    let measured = Measurement::new(forces, penetrations, deviations)?;
    let jacobian: Vec<[f64; 3]> = table.rows.iter().map(|row| [row[3], row[4], row[5]].map(|x| x / NOISE)).collect();
    let expected = deviations_of(&jacobian);
    let fit = found(&KNOWN, &measured, COARSE)?;
    for ((estimate, known), expected) in fit.estimates.iter().zip(KNOWN).zip(expected) {
        let name = format!("five loads: relative standard error of {}", estimate.parameter.name);
        outcome.checks.push(Check::relative(name, estimate.error / known, expected, 0.05));
    }
    Ok(())
}

/// √ of the diagonal of (JᵀJ)⁻¹, by cofactors.
fn deviations_of(jacobian: &[[f64; 3]]) -> [f64; 3] {
    let m = |i: usize, j: usize| jacobian.iter().map(|row| row[i] * row[j]).sum::<f64>();
    let minor = |i: usize, j: usize, k: usize, l: usize| m(i, k) * m(j, l) - m(i, l) * m(j, k);
    let determinant = m(0, 0) * minor(1, 2, 1, 2) - m(0, 1) * minor(1, 2, 0, 2) + m(0, 2) * minor(1, 2, 0, 1);
    [minor(1, 2, 1, 2), minor(0, 2, 0, 2), minor(0, 1, 0, 1)].map(|cofactor| (cofactor / determinant).sqrt())
}

/// Light loads do not contain all three, with the noise as their deviation: the error that is refused, over the value.
fn light(outcome: &mut Outcome) -> Result<(), StudyError> {
    let [forces, penetrations] = columns(EXACT)?;
    let count = forces.iter().filter(|force| **force <= LIGHT).count();
    let measured =
        Measurement::new(forces[..count].to_vec(), penetrations[..count].to_vec(), Some(vec![NOISE; count]))?;
    let error = match found(&KNOWN, &measured, COARSE) {
        Ok(_) => f64::NAN,
        Err(IdentificationError::Undetermined(estimate)) => estimate.error / estimate.value,
        Err(error) => return Err(error.to_string().into()),
    };
    let name = format!("loads up to {LIGHT} mN: refused, largest relative standard error");
    outcome.checks.push(Check::at_least(name, error, MOST_UNCERTAIN));
    Ok(())
}

fn figure(derivatives: &Data, measured: &Data) -> Figure {
    let mut slopes = Vec::new();
    for (colour, (name, column)) in (1..).zip([("θ = E_c", 5), ("θ = E_s", 7), ("θ = h", 9)]) {
        let points = |column: usize| derivatives.rows.iter().map(move |row| [row[0], -row[column] / row[2]]);
        slopes.push(curve("", Style::Line, colour, points(column + 1)));
        slopes.push(curve(name, Style::Markers, colour, points(column)));
    }
    let over = |of: fn(&[f64]) -> f64| measured.rows.iter().map(move |row| [row[0], 1e3 * (of(row) - row[1])]);
    let curves = vec![
        curve("measured", Style::Markers, 1, over(|row| row[2])),
        Curve {
            errors: measured.rows.iter().map(|row| 1e3 * row[4]).collect(),
            ..curve("fitted", Style::Line, 2, over(|row| row[3]))
        },
    ];
    let chart = |title: &str, x: Axis, y: Axis, curves| Chart { title: title.to_owned(), x, y, curves };
    let panels = vec![
        chart("Sensitivities", Axis::log("force (mN)"), Axis::linear("−∂ln δ/∂ln θ"), slopes),
        chart("Noisy curve", Axis::log("force (mN)"), Axis::linear("δ less the exact one (nm)"), curves),
    ];
    let caption = "Left: lines from the integral equation, markers solved. Right: moduli and thickness fitted; band: a standard error.";
    draw::figure(panels, caption)
}

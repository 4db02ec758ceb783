//! `identification.json` and `identification.csv`: parameters found from a measured indentation curve, and the fit.

use super::json::indented;
use super::number::{number, with_error};
use super::summary::UnitNames;
use super::table::Table;
use crate::case::Case;
use crate::identification::{Estimate, Identification, Measurement, Trial};
use serde::Serialize;
use serde_json::{Value, json};
use std::fmt::Write;

/// The content of `identification.json`.
#[derive(Debug, Clone, Serialize)]
pub struct IdentificationFile {
    percoat: &'static str,
    title: String,
    /// The whole case with the values found.
    case: Value,
    units: UnitNames,
    parameters: Vec<FoundParameter>,
    correlation: Vec<Vec<f64>>,
    points: usize,
    degrees_of_freedom: usize,
    rms_residual: f64,
    reduced_chi_square: Option<f64>,
    model_error: Option<f64>,
    contact_radii: [f64; 2],
    steps: usize,
}

/// A parameter in the file.
#[derive(Debug, Clone, Serialize)]
struct FoundParameter {
    name: String,
    start: f64,
    value: f64,
    standard_error: f64,
    interval_95: [f64; 2],
}

impl IdentificationFile {
    /// The record of what was found; `case` has the values found.
    pub fn new(found: &Identification, case: &Case) -> Self {
        let parameter = |own: &Estimate| FoundParameter {
            name: own.parameter.name.clone(),
            start: own.parameter.start,
            value: own.value,
            standard_error: own.error,
            interval_95: own.interval,
        };
        Self {
            percoat: env!("CARGO_PKG_VERSION"),
            title: case.title.clone(),
            case: json!(case),
            units: UnitNames::of(case),
            parameters: found.estimates.iter().map(parameter).collect(),
            correlation: found.correlation.clone(),
            points: found.fitted.len(),
            degrees_of_freedom: found.freedom,
            rms_residual: found.rms,
            reduced_chi_square: found.reduced_chi_square,
            model_error: found.model_error,
            contact_radii: found.radii,
            steps: found.steps,
        }
    }

    /// The content of the file.
    pub fn to_json(&self) -> String {
        indented(self)
    }
}

/// The content of `identification.csv`: a line for each measured point, the fit and its standard error by that of the parameters.
pub fn fitted(measured: &Measurement, found: &Identification) -> String {
    let mut text = "force,penetration,fitted,fitted_error\n".to_owned();
    let points = measured.forces().iter().zip(measured.penetrations()).zip(&found.fitted).zip(&found.band);
    for (((force, penetration), fitted), band) in points {
        writeln!(text, "{force},{penetration},{fitted},{band}").expect("a String takes any text");
    }
    text
}

/// A trial of the search in words, in lengths of the case.
pub fn trial(case: &Case, trial: Trial) -> String {
    let residual = trial.rms.map(|rms| case.units().length().with_unit(rms, number));
    format!("trial {}, residual {}", trial.number, residual.unwrap_or("unknown: no contact is solved there".to_owned()))
}

/// The text of `percoat identify`.
pub fn identified(found: &Identification, case: &Case, width: usize) -> String {
    let units = case.units();
    let head = ["parameter", "start", "value", "95 % interval", "relative"];
    let row = |own: &Estimate| {
        let [low, high] = own.interval.map(number);
        let relative = 100.0 * own.error / own.value.abs();
        vec![
            own.parameter.name.clone(),
            number(own.parameter.start),
            with_error(own.value, Some(own.error)),
            format!("{low} to {high}"),
            if relative.is_finite() { format!("± {relative:.2} %") } else { String::new() },
        ]
    };
    let mut text = format!("{}\n\n", Table::new(&head, found.estimates.iter().map(row).collect(), 1).fitted(width));
    let pairs = (0..found.estimates.len()).flat_map(|k| (0..k).map(move |other| (other, k)));
    for (k, other) in pairs {
        let names = [k, other].map(|k| found.estimates[k].parameter.name.as_str());
        text += &format!("correlation of {} and {}: {:+.3}\n", names[0], names[1], found.correlation[k][other]);
    }
    let length = units.length();
    let [least, most] = found.radii.map(|radius| length.with_unit(radius, number));
    text += &format!(
        "{} points, residual {} (root mean square); contact radii {least} to {most}\n",
        found.fitted.len(),
        length.with_unit(found.rms, number)
    );
    if let Some(chi) = found.reduced_chi_square {
        text += &format!("reduced chi-square {chi:.2}, about 1 where model and deviations hold\n");
    }
    if let Some(error) = found.model_error {
        text += &format!("error of the computed penetrations by the grid: {:.1e} at most\n", error);
    }
    text
}

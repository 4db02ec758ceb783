//! `percoat identify`: parameters of a stack from a measured indentation curve.

use super::ending::{Ending, Failure};
use super::input::{output_folder, read_source, read_text};
use super::options::Common;
use super::plan::plan;
use super::results::Results;
use super::terminal;
use crate::case::{Case, Source, plausibility};
use crate::identification::{Identification, IdentificationError, Measurement, Model, Parameter, Quantity};
use crate::output::{IdentificationFile, Writer, fitted, identified};
use crate::run::Sampling;
use crate::{Problem, measurements, picture, plain};
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

/// Name of a zero that was missed, and of the compliance of the frame, among the parameters.
const OFFSET: &str = "offset";
const FRAME: &str = "frame_compliance";
/// Most samples along a side of a window: its contact takes up two thirds of them, and leaves some 1e-4 of the penetration.
const MOST_POINTS: usize = 96;

pub fn run(data: &Path, case: &Path, free: &[String], set: &[String], common: &Common) -> Result<Ending, Failure> {
    let started = Instant::now();
    let (source, name) = read_source(Some(case))?;
    let own = Case::read(&source, set)?;
    let measured = measurements::read(&read_text(data)?, &own.units())
        .map_err(|fault| Failure::Refused(format!("{}: {fault}", plain::path(data))))?;
    let parameters = parameters(&own, free)?;
    let folder = output_folder(common, &name)?;
    let plan =
        plan(Writer::Identify, &["identification.json", "identification.csv"], &common.pictures, &["identification"]);
    let results = Results::claim(folder, plan, common.saying())?;
    let found = found(&source, set, &own, &parameters, &measured)?;
    let values: Vec<f64> = found.estimates.iter().map(|own| own.value).collect();
    let best = Case::read(&source, &[set, &settings(&parameters, &values)].concat())?;
    let json = IdentificationFile::new(&found, &best).to_json();
    results.write("identification.json", &json)?;
    results.write("identification.csv", &fitted(&measured, &found))?;
    let drawn = || Some(picture::identification(&best.title, &best.units(), &measured, &found));
    common.pictures.write(&results.staging(), "identification", drawn)?;
    let warnings = plausibility::of_case(&best);
    let line = || format!("{} steps of the search; {:.2} s", found.steps, started.elapsed().as_secs_f64());
    results.finish(|| json, || identified(&found, &best, terminal::width()), line, &warnings)?;
    Ok(Ending::Done)
}

/// The search for the parameters from the values of the case.
fn found(
    source: &Source,
    set: &[String],
    case: &Case,
    parameters: &[Parameter],
    measured: &Measurement,
) -> Result<Identification, Failure> {
    let problem = |values: &[f64]| -> Result<Problem, String> {
        let changed = Case::read(source, &[set, &settings(parameters, values)].concat());
        changed.map(|case| case.problem().as_ref().clone()).map_err(|error| error.to_string())
    };
    let points = match case.grid {
        Sampling::Points([n1, n2]) => n1.max(n2).min(MOST_POINTS),
        Sampling::Accuracy(_) => MOST_POINTS,
    };
    let model = Model { problem: &problem, points, settings: case.solver };
    Identification::new(&model, parameters, measured)
        .map_err(|error: IdentificationError<String>| Failure::Refused(error.to_string()))
}

/// The parameters of these names, with the values of the case as starts.
fn parameters(case: &Case, free: &[String]) -> Result<Vec<Parameter>, Failure> {
    let whole = json!(case);
    let mut parameters: Vec<Parameter> = Vec::new();
    for name in free.iter().map(|name| name.trim()) {
        if parameters.iter().any(|own| own.name == name) {
            return Err(Failure::Refused(format!("--free: `{}` is there twice", plain::line(name))));
        }
        let (quantity, start) = match name {
            OFFSET => (Quantity::Offset, 0.0),
            FRAME => (Quantity::FrameCompliance, 0.0),
            key => {
                let value = whole.pointer(&format!("/{}", key.replace('.', "/"))).and_then(Value::as_f64);
                let start = value.filter(|value| *value > 0.0).ok_or_else(|| none(key))?;
                let is_ratio = key.ends_with("poisson");
                (if is_ratio { Quantity::Number } else { Quantity::Positive }, start)
            }
        };
        parameters.push(Parameter { name: name.to_owned(), quantity, start });
    }
    Ok(parameters)
}

fn none(key: &str) -> Failure {
    Failure::Refused(format!(
        "--free: the case has no number above 0 at `{}`: name a key as layers.0.young, layers.0.thickness, substrate.young or \
         levels.0.radius, layers counted from 0, or `{OFFSET}` or `{FRAME}`",
        plain::line(key)
    ))
}

/// The values of parameters of the case as KEY=VALUE.
fn settings(parameters: &[Parameter], values: &[f64]) -> Vec<String> {
    let of_case = |(own, _): &(&Parameter, &f64)| matches!(own.quantity, Quantity::Positive | Quantity::Number);
    parameters.iter().zip(values).filter(of_case).map(|(own, value)| format!("{}={value:e}", own.name)).collect()
}

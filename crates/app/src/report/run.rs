//! Part of a report: a run.

use super::ReportError;
use super::answer::{answer, doubts};
use super::certificate::certificate;
use super::figures::{PictureText, figures};
use super::markup::{tag, with};
use super::part::{Part, Section, assumed, by, case_text, case_to_copy, section, warnings};
use super::problem::problem;
use super::resolution::{resolution, upper};
use super::results::Results;
use super::table::table;
use super::units::{case_of, measured_in, units_of};
use crate::output::{Summary, table as tables};
use percoat_case::case::{Case, kind_of};
use percoat_case::units::Units;
use percoat_case::words::AroundWords;
use percoat_core::run::StepRecord;
use serde_json::Value;

/// The pictures of a run; those of an isolated contact have no neighbours.
fn pictures(words: &AroundWords) -> [PictureText; 10] {
    let [pressure, contact, profiles] = words.pictures;
    [
        ("pressure", pressure[0], pressure[1]),
        ("contact", contact[0], contact[1]),
        ("profiles", profiles[0], profiles[1]),
        (
            "indentation",
            "Map of the depths pressed in, and a profile through the deepest place",
            "What the hardness has pressed in for good, without the elastic displacement.",
        ),
        ("temperature", "Maps of the temperature of both surfaces", "Temperature of the surfaces by frictional heat."),
        (
            "approach",
            "Curves of force and contact area over the penetration, with jumps and pull-off",
            "Force and contact area as the surfaces come together and part.",
        ),
        ("creep", "Curves of load, penetration and contact over time", "Load, penetration and contact over time."),
        ("curve", "Curves of what the load steps say over the load", "What the load steps say over the load."),
        (
            "section",
            "Maps of stresses in a vertical cut, with the interfaces",
            "Stresses in a vertical cut, with the interfaces; crosses: the largest values.",
        ),
        (
            "lines",
            "Curves of stresses along the surface and both sides of each interface",
            "The same stresses along the surface and both sides of each interface.",
        ),
    ]
}

/// The section of the largest stresses and strains; `None` without stresses.
fn stresses(case: &Value, steps: &[StepRecord], units: &Units) -> Option<Section> {
    let stresses = table("Largest stresses and their places", &tables::largest_stresses(steps, units)?);
    let strains = tables::largest_strains(steps, units);
    let strains = strains.map(|strains| table("Largest strains and their places", &strains)).unwrap_or_default();
    Some(section("stresses", "Largest stresses", vec![stresses, strains, assumed(case, false)]))
}

/// Temperatures by frictional heat; `None` where nothing heats.
fn temperature(case: &Case, steps: &[StepRecord], units: &Units) -> Option<Section> {
    let (words, found) = tables::temperature(case.problem(), steps, units)?;
    let caption = "Largest temperature of each material; ± is the estimated error of the grid";
    let words = words.iter().map(|words| tag("p", upper(words)));
    Some(section("temperature", "Frictional heat", words.chain([table(caption, &found)]).collect()))
}

/// Friction by hysteresis of a moving load; `None` at rest.
fn hysteresis(case: &Case, steps: &[StepRecord], units: &Units) -> Option<Section> {
    let (words, found) = tables::hysteresis(case.problem(), steps, units)?;
    let caption = "Friction by hysteresis; ± is the estimated error";
    let words = words.iter().map(|words| tag("p", upper(words)));
    Some(section("hysteresis", "Friction by hysteresis", words.chain([table(caption, &found)]).collect()))
}

/// Bodies that creep; `None` where nothing depends on time.
fn creep(case: &Case, steps: &[StepRecord], units: &Units) -> Option<Section> {
    let (words, found) = tables::creep(case, steps, units)?;
    let caption = "Creep and rate; ± is the estimated error of the grid and of steps in time";
    let words = words.iter().map(|words| tag("p", upper(words)));
    Some(section("creep", "Creep and rate", words.chain([table(caption, &found)]).collect()))
}

/// The section of adhesion; `None` where surfaces do not pull each other.
fn adhesion(case: &Case, steps: &[StepRecord], units: &Units) -> Option<Section> {
    let (words, all) = tables::adhesion(case, steps, units)?;
    let words = words.iter().map(|words| tag("p", upper(words)));
    let all = table("Adhesion; ± is the estimated error of the grid", &all);
    Some(section("adhesion", "Adhesion", words.chain([all]).collect()))
}

/// The part of the page for a run, from `summary.json`.
pub(super) fn part(results: &Results, summary: &Summary) -> Result<Part, ReportError> {
    let path = results.folder.join("summary.json");
    let Summary { case, steps, .. } = summary;
    let refused = |reason: String| ReportError::version(&path, &summary.percoat, reason);
    let text = case_text(case).map_err(refused)?;
    // Without it the body is not known beyond its tables.
    let read = case_of(&text, &results.folder);
    if let Some(loads) = read.as_ref().map(|case| case.step_count()).filter(|loads| *loads != steps.len()) {
        return Err(refused(format!("it has {} steps, and its case {loads} loads", steps.len())));
    }
    let units = units_of(&summary.units, read.as_ref(), case);
    let taken = tables::utilisations(steps, read.as_ref().map(|case| case.problem().bodies()), &units);
    let fails = taken.as_ref().map(|taken| with("p", &[("class", "answer")], upper(&taken.words)));
    let hertz = read.as_ref().and_then(|case| tables::hertz(case, steps, &units));
    let hertz = hertz.map(|lines| tag("p", upper(&lines.join("; "))));
    let mut sections = vec![
        section(
            "answer",
            "Answer",
            vec![doubts(steps), fails.unwrap_or_default(), answer(steps, &units), hertz.unwrap_or_default()],
        ),
        section("problem", "Problem", vec![problem(case), tag("p", measured_in(&units))]),
        section(
            "pictures",
            "Pictures",
            vec![figures(results, "summary.json", &pictures(AroundWords::of(kind_of(case).surroundings)))?],
        ),
        section(
            "steps",
            "Load steps",
            vec![table("Load steps; ± is the estimated error of the grid", &tables::steps(steps, &units))],
        ),
    ];
    if let Some((words, pressed)) = tables::plastic(steps, &units) {
        let caption = "What the hardness has pressed in; ± is the estimated error of the grid";
        let pressed = pressed.map(|pressed| table(caption, &pressed)).unwrap_or_default();
        sections.push(section("hardness", "Hardness", vec![tag("p", upper(&words)), pressed]));
    }
    sections.extend(read.as_ref().and_then(|case| hysteresis(case, steps, &units)));
    sections.extend(read.as_ref().and_then(|case| temperature(case, steps, &units)));
    if let Some((words, slip)) = tables::slip(steps, &units) {
        let caption = "Partial slip; ± is the estimated error of the grid and of steps in which the load changes";
        sections.push(section("slip", "Partial slip", vec![tag("p", upper(&words)), table(caption, &slip)]));
    }
    sections.extend(read.as_ref().and_then(|case| adhesion(case, steps, &units)));
    sections.extend(read.as_ref().and_then(|case| creep(case, steps, &units)));
    sections.extend(stresses(case, steps, &units));
    if let Some(taken) = &taken {
        let caption = "Utilisations: 1 is where the material or interface fails";
        sections.push(section("strengths", "Strengths", vec![table(caption, &taken.table), assumed(case, true)]));
    }
    sections.push(warnings());
    sections.push(section("resolution", "Resolution", vec![resolution(steps, summary.accuracy)]));
    sections.push(section(
        "certificate",
        "Certificate",
        vec![certificate(steps, case["solver"]["tolerance"].as_f64())],
    ));
    let timing = summary.timing.as_ref().map(|timing| tag("p", format!("Seconds: {}.", tables::timing(timing))));
    sections.push(section("time", "Time and version", timing.into_iter().chain([by(&summary.percoat)]).collect()));
    sections.push(section("case", "Case", vec![case_to_copy(&text, "solve")]));
    Ok(Part { name: "run", kind: "Run", title: summary.title.clone(), sections, warnings: summary.warnings.clone() })
}

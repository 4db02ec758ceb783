//! Table of temperatures by frictional heat, a row a material, and sentences on how it was shared.

use super::Table;
use crate::output::number::{in_unit, number, percent, shown};
use percoat_case::units::Units;
use percoat_core::measured::Measured;
use percoat_core::problem::Problem;
use percoat_core::quantity::Quantity;
use percoat_core::reading::{TEMPERATURE, TemperatureReading};
use percoat_core::run::StepRecord;
use percoat_core::spectral::{Settings, Solver};

/// Points of the grid on which the longest waves of a cell are looked at.
const COARSE: [usize; 2] = [16; 2];

/// Sentences on frictional heat, before anything is solved; none where nothing heats.
pub fn heat_words(problem: &Problem) -> Vec<String> {
    let Some(heating) = problem.heating() else { return Vec::new() };
    let mut words = vec![heating.to_string()];
    let left = Solver::new(problem.clone(), COARSE, Settings::default()).map(|solver| solver.left_by_heat());
    if let Some(left) = left.ok().filter(|left| *left < 1.0) {
        let end = if left > 0.0 { "" } else { ", and the case is refused" };
        words.push(format!(
            "the surface swells: that takes {} of the compliance of a wave of the cell at most; from 100 % on no steady state is unique{end}",
            percent(1.0 - left)
        ));
    }
    words
}

/// Sentences about the heat of the last step that has any, and the table of its largest temperatures; `None` where nothing heats.
pub fn temperature(problem: &Problem, steps: &[StepRecord], units: &Units) -> Option<(Vec<String>, Table)> {
    let (step, heat) =
        (1..).zip(steps).filter_map(|(number, step)| Some((number, step.temperature.as_ref()?))).last()?;
    let of = |quantity: &'static Quantity<TemperatureReading>| {
        quantity.of(heat).map_or(String::new(), |found| shown(&quantity.named, found, units))
    };
    let at = if steps.len() > 1 { format!(" in step {step}") } else { String::new() };
    let [name, mean] = [&TEMPERATURE.counterbody_share, &TEMPERATURE.mean_in_contact].map(|of| of.named.name);
    let surface = of(&TEMPERATURE.mean_in_contact);
    let mut words = vec![match problem.bodies().counterbody() {
        Some(_) => {
            let share = of(&TEMPERATURE.counterbody_share);
            format!("frictional heat{at}: {name} {share}; {mean} of the body {surface}")
        }
        None => format!("frictional heat{at}: all of it into the body; {mean} {surface}"),
    }];
    if problem.heating().is_some_and(|heating| heating.expands()) && heat.criticality > 0.0 {
        words.push(format!(
            "the surface swells: that takes {} of the compliance of a wave of the cell at most; from 100 % on no steady state is unique",
            percent(heat.criticality)
        ));
    }
    let relaxes = problem.bodies().each().any(|body| body.relaxes());
    if relaxes && problem.heating().is_some_and(|heating| heating.expands()) {
        words.push("swelling and stresses by heat are those of relaxed moduli".to_owned());
    }
    words.push(match problem.heating().map(|heating| heating.bulk()) {
        Some(bulk) if bulk != [0.0; 2] => {
            "the mean temperature of each surface is its bulk temperature: the mean rise of a periodic cell has no steady value and is left out".to_owned()
        }
        _ => "temperatures are those above the mean temperature of each surface, its bulk temperature here: the mean rise of a periodic cell has no \
             steady value and is left out"
            .to_owned(),
    });
    let temperature = units.temperature().suited(heat.materials.iter().map(|material| material.value));
    let length = units.length().suited(heat.materials.iter().flat_map(|material| material.place));
    let header = [
        format!("{} of", temperature.headed(TEMPERATURE.max.named.name)),
        String::new(),
        length.headed("place (x, y, z)"),
    ];
    let row = |material: &percoat_core::reading::MaterialTemperature| {
        let [x, y, z] = material.place.map(|x| number(length.shown(x)));
        vec![
            material.material.to_string(),
            in_unit(&temperature, Measured { value: material.value, error: material.error }),
            format!("({x}, {y}, {z})"),
        ]
    };
    Some((words, Table::new(&header, heat.materials.iter().map(row).collect(), 1)))
}

//! Table of adhesion, a row a step: contact and adhesive load, area that pulls, margin of stability; with pull-off, jumps and loss in words.

use super::Table;
use crate::output::number::{in_unit, number, percent_with_error, with_unit};
use percoat_case::case::Case;
use percoat_case::units::{Prefixed, Units};
use percoat_core::adhesion::{Adhesion, MaugisState, Regime};
use percoat_core::counterbody::Level;
use percoat_core::lattice::Grid;
use percoat_core::measured::Measured;
use percoat_core::reading::{ADHESION, AdhesionReading, JumpKind, READING, loss, of_apex, pull_off};
use percoat_core::run::{Sampling, StepRecord};
use percoat_core::spectral::adhesive_samples;
use std::f64::consts::PI;

/// Most steps of the table.
const SHOWN: usize = 12;

/// A step by its number, with its adhesion.
type Told<'a> = (usize, &'a StepRecord, &'a AdhesionReading);

/// Pull-off, jumps and the loss of a closed path, a sentence each.
pub fn adhesive_path(steps: &[StepRecord], units: &Units) -> Vec<String> {
    let readings = || steps.iter().filter_map(|step| step.adhesion.as_ref());
    let (force, length) = (units.force(), units.length());
    let pulled = pull_off(readings()).map(|found| {
        let at = length.with_unit(found.penetration, number);
        let area = units.area().with_unit(found.contact_area, number);
        let how = if found.jumps { ", where the surfaces jump apart" } else { "" };
        let measured = Measured::new(found.force, found.error);
        format!("pull-off at the force {}, penetration {at}, contact area {area}{how}", with_unit(&force, measured))
    });
    let jumps = readings().flat_map(|reading| &reading.jumps).map(|jump| {
        let way = if jump.kind == JumpKind::In { "together" } else { "apart" };
        let [from, to] = jump.force.map(|x| force.with_unit(x, number));
        let places: Vec<String> = jump.penetration.iter().flatten().map(|x| length.with_unit(*x, number)).collect();
        let at = match &places[..] {
            [before, after] => format!("between the penetrations {before} and {after}"),
            [place] => format!("at the penetration {place}"),
            _ => "where nothing holds them".to_owned(),
        };
        let lost = jump.loss.map_or(String::new(), |loss| format!(", {} lost", units.energy().with_unit(loss, number)));
        format!("the surfaces jump {way} {at}: the force goes from {from} to {to}{lost}")
    });
    let lost = adhesive_loss(steps).map(|loss| format!("the closed path loses {}", with_unit(&units.energy(), loss)));
    pulled.into_iter().chain(jumps).chain(lost).collect()
}

/// Energy that a closed path loses; `None` of other paths.
pub fn adhesive_loss(steps: &[StepRecord]) -> Option<Measured> {
    loss(
        steps.iter().filter_map(|step| Some(([step.reading.force, step.reading.penetration], step.adhesion.as_ref()?))),
    )
}

/// Law, regime and what closed forms say, and the table of the steps, of many those around jumps and pull-off, the first and the last; `None`
/// without adhesion.
pub fn adhesion(case: &Case, steps: &[StepRecord], units: &Units) -> Option<(Vec<String>, Table)> {
    let all: Vec<Told<'_>> =
        (1..).zip(steps).filter_map(|(number, step)| Some((number, step, step.adhesion.as_ref()?))).collect();
    all.first()?;
    let shown = told(&all);
    let force =
        units.force().suited(shown.iter().flat_map(|(.., reading)| [reading.contact_load, reading.adhesive_load]));
    let length = units.length().suited(shown.iter().map(|(_, step, _)| step.reading.penetration));
    let area = units.area().suited(shown.iter().map(|(_, step, _)| step.reading.contact_area));
    let header = [
        "step".to_owned(),
        length.headed(READING.penetration.named.name),
        force.headed(READING.force.named.name),
        force.headed(ADHESION.contact_load.named.name),
        force.headed(ADHESION.adhesive_load.named.name),
        area.headed(READING.contact_area.named.name),
        area.headed("pulls beside it"),
        ADHESION.stability.named.name.to_owned(),
    ];
    let text = |unit: &Prefixed, found: Option<Measured>| found.map_or("–".to_owned(), |found| in_unit(unit, found));
    let row = |(number, step, reading): &Told<'_>| {
        vec![
            number.to_string(),
            text(&length, READING.penetration.of(&step.reading)),
            text(&force, READING.force.of(&step.reading)),
            text(&force, ADHESION.contact_load.of(reading)),
            text(&force, ADHESION.adhesive_load.of(reading)),
            text(&area, READING.contact_area.of(&step.reading)),
            text(&area, ADHESION.cohesive_area.of(reading)),
            ADHESION.stability.of(reading).map_or("–".to_owned(), percent_with_error),
        ]
    };
    let words = [adhesion_words(case, units), adhesive_path(steps, units)].concat();
    Some((words, Table::new(&header, shown.iter().map(row).collect(), 1)))
}

/// The steps that a table has: all of few, of many the first and the last, those on both sides of a jump, and the ones nearest to pull-off.
fn told<'a>(all: &[Told<'a>]) -> Vec<Told<'a>> {
    let last = all.len() - 1;
    if all.len() <= SHOWN {
        return all.to_vec();
    }
    let jumps = all.iter().enumerate().filter(|(_, (.., reading))| !reading.jumps.is_empty()).map(|(index, _)| index);
    let lowest = (0..all.len()).min_by(|a, b| all[*a].1.reading.force.total_cmp(&all[*b].1.reading.force));
    let around = jumps.flat_map(|index| [index.saturating_sub(1), index]);
    let near = lowest.into_iter().flat_map(|index| [index.saturating_sub(1), index, (index + 1).min(last)]);
    // The ends and pull-off come before jumps, of which there may be many.
    let mut indices: Vec<usize> = Vec::new();
    for index in [0, last].into_iter().chain(near).chain(around) {
        if indices.len() < SHOWN && !indices.contains(&index) {
            indices.push(index);
        }
    }
    indices.sort_unstable();
    indices.into_iter().map(|index| all[index]).collect()
}

/// Law, regime and what closed forms say of the first indenter on the bare surface material, a sentence each; none without adhesion.
pub fn adhesion_words(case: &Case, units: &Units) -> Vec<String> {
    let problem = case.problem();
    let Some(adhesion) = problem.adhesion() else { return Vec::new() };
    let modulus = problem.bodies().contact_modulus();
    let zone = units.length().with_unit(adhesion.cohesive_zone(modulus), number);
    let samples = match case.grid {
        Sampling::Points(points) => Grid::new(problem.cell(), points).ok(),
        Sampling::Accuracy(_) => None,
    };
    let samples =
        samples.map_or(String::new(), |grid| format!(", {} samples", number(adhesive_samples(problem, &grid))));
    let law = format!(
        "adhesion, {}: work {}, range {}, strength {}; the surfaces pull beside contact in a zone some {zone} wide{samples}",
        adhesion.law(),
        units.energy_per_area().with_unit(adhesion.work(), number),
        units.length().with_unit(adhesion.range(), number),
        units.pressure().with_unit(adhesion.strength(), number)
    );
    let radius = problem.levels().first().and_then(|level: &Level| level.shape().apex_radius());
    let regime = of_apex(problem, adhesion, Adhesion::tabor).zip(of_apex(problem, adhesion, Adhesion::maugis));
    let regime = regime.map(|(tabor, maugis)| {
        let name = if problem.levels().len() > 1 { "level 1: " } else { "" };
        format!("{name}Tabor μ = {}, Maugis λ = {}, {}", number(tabor), number(maugis), Regime::of(tabor))
    });
    let closed = radius.zip(of_apex(problem, adhesion, Adhesion::maugis)).map(|(radius, maugis)| {
        let unit = PI * adhesion.work() * radius;
        let of = |part: f64| units.force().with_unit(part * unit, number);
        let jkr = (9.0 * PI * adhesion.work() * radius * radius / (8.0 * modulus)).cbrt();
        let thickness = problem.bodies().thinnest_first_layer();
        let thin = thickness.map_or(String::new(), |h| {
            format!(", with a contact radius of {} thicknesses of the first layer by JKR", number(jkr / h))
        });
        format!(
            "one indenter on a bare body of the surface material is pulled off at {} by Maugis, {} by JKR, {} by DMT{thin}",
            of(MaugisState::pull_off(maugis).force),
            of(-1.5),
            of(-2.0)
        )
    });
    [Some(law), regime, closed].into_iter().flatten().collect()
}

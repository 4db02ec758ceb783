//! Tables of results for the terminal and the report.

mod alone;
mod assumed;
mod by_step;
mod comparison;
mod fatigue;
mod hertz;
mod largest;
mod life;
mod plastic;
mod strains;
mod strength;
mod text;

pub use alone::alone;
pub use assumed::{Assumptions, library_strengths};
pub use comparison::{differences, readings, stresses};
pub use fatigue::lives;
pub use hertz::hertz;
pub use largest::largest_stresses;
pub use life::{events, headline, left};
pub use plastic::plastic;
pub use strains::largest_strains;
pub use strength::{limits, utilisations};
pub(super) use text::lines;
pub use text::{Table, Worded};

use super::number::{ROUNDING, number, with_error};
use super::{LifeFile, Timing};
use percoat_case::case::{Case, SurfaceSection};
use percoat_case::units::{Prefixed, Units};
use percoat_case::words::LoadWords;
use percoat_common::plain;
use percoat_core::comparison::Comparison;
use percoat_core::lattice::Surroundings;
use percoat_core::numeric::search::largest;
use percoat_core::reading::{LevelReading, Reading};
use percoat_core::run::{Limits, StepRecord};
use percoat_core::spectral::Stop;

/// Relative errors up to this are rounding.
const NOTHING: f64 = 1e-12;

/// Most load steps with a row for every level.
pub const DETAILED: usize = 6;

/// Table of the load steps: up to [`DETAILED`] with a row for every level, more with one row a step.
pub fn steps(steps: &[StepRecord], units: &Units) -> Table {
    let levels = steps.first().map_or(0, |step| step.reading.levels.len());
    if steps.len() <= DETAILED && levels > 0 { detailed(steps, units) } else { compact(steps, levels, units) }
}

/// The text of `percoat solve`: tables of readings, largest stresses and utilisations, convergence and errors. `change`: relative
/// change from the next coarser grid, where an accuracy was prescribed.
pub fn outcome(case: &Case, steps: &[StepRecord], change: Option<f64>, width: usize) -> String {
    let units = case.units();
    let mut text = heading(case);
    text += &format!("\n{}\n\n{}\n", self::steps(steps, &units).fitted(width), solved(steps));
    text += &spots(steps).map_or(String::new(), |spots| format!("{spots}\n"));
    text += &contact_stiffness(steps, &units).unwrap_or_default();
    if let Some((words, table)) = plastic(steps, &units) {
        text += &lines(&words, width);
        text += &table.map_or(String::new(), |table| format!("{}\n\n", table.fitted(width)));
    }
    text += &hertz(case, steps, &units).map_or(String::new(), |lines| format!("{}\n", lines.join(";\n")));
    let largest = largest_stresses(steps, &units);
    if let Some(largest) = &largest {
        text += &format!("\n{}\n", largest.fitted(width));
    }
    text += &largest_strains(steps, &units).map_or(String::new(), |strains| format!("\n{}\n", strains.fitted(width)));
    let strength = utilisations(steps, Some(case.problem().bodies()), &units);
    if let Some(strength) = &strength {
        text += &format!("\n{}\n", strength.fitted(width));
    }
    let lives = lives(steps, &units);
    if let Some(lives) = &lives {
        text += &format!("\n{}\n", lives.fitted(width));
    }
    if largest.is_some() || strength.is_some() || lives.is_some() {
        text.push('\n');
    }
    if let Some(errors) = largest_errors(steps) {
        text += &format!("{errors}\n");
    }
    if largest.is_some() || strength.is_some() {
        text += &Assumptions::of(case).lines(strength.is_some(), width);
    }
    if let Some(change) = change {
        text += &format!("change from the next coarser grid: {change:.1e}\n");
    }
    text
}

/// The contact stiffness of the last step that has one, as a line.
fn contact_stiffness(steps: &[StepRecord], units: &Units) -> Option<String> {
    let step = steps.iter().rev().find(|step| step.contact_stiffness.is_some())?;
    let (stiffness, error) = (step.contact_stiffness?, step.contact_stiffness_error);
    let load = units.force().with_unit(step.reading.force, number);
    let per = match (units.force().name(), units.length().name()) {
        (Some(force), Some(length)) => format!("\u{a0}{force}/{length}"),
        _ => String::new(),
    };
    Some(format!("contact stiffness ∂P/∂δ at the force {load}: {}{per}\n", with_error(stiffness, error)))
}

/// The title of a case as a line, and the assumed orientation of its surface file where the file does not state it.
fn heading(case: &Case) -> String {
    let title = Some(plain::line(&case.title).to_string()).filter(|title| !title.is_empty());
    let lines = case.surface.as_ref().and_then(SurfaceSection::lines);
    title.into_iter().chain(lines).map(|line| line + "\n").collect()
}

/// The text of `percoat limit`: limit loads, the loads solved, convergence and errors.
pub fn limited(case: &Case, found: &Limits, width: usize) -> String {
    let mut text = heading(case);
    if !text.is_empty() {
        text.push('\n');
    }
    text += &format!("{}\n\n", limits(found, &case.units()).fitted(width));
    text += &Assumptions::of(case).lines(true, width);
    if let Some(words) = wider_windows(found, &case.units()) {
        text += &format!("{words}\n");
    }
    if let Some(change) = found.change {
        text += &format!("change from the next coarser grid: {change:.1e}\n");
    }
    text
}

/// The text of `percoat life`: lives of all that tires, events, and what is left.
pub fn life(case: &Case, file: &LifeFile, width: usize) -> String {
    let (mut text, units) = (heading(case), case.units());
    text += &format!("\n{}", lines(&headline(file, &units), width));
    if let Some(lives) = lives(&file.steps, &units) {
        text += &format!("\n{}\n", lives.table.fitted(width));
    }
    if let Some(events) = events(&file.events, &units).filter(|_| file.end.is_some()) {
        text += &format!("\n{}\n", events.fitted(width));
    }
    if let Some(left) = left(file, &units) {
        text += &format!("\n{}", lines(&left, width));
    }
    if let Some(last) = file.steps.last() {
        text += &format!("\n{}", lines(&solved(std::slice::from_ref(last)), width));
    }
    text += &Assumptions::of(case).lines(false, width);
    text
}

/// That loads were solved in larger windows than that of the case, and how large these are; `None` where none was.
pub fn wider_windows(found: &Limits, units: &Units) -> Option<String> {
    let [width, height] = found.window?;
    let unit = units.length().suited([width, height]);
    let sides = unit.behind(&format!("{} × {}", number(unit.shown(width)), number(unit.shown(height))));
    Some(format!("loads for which the contact is too large for its window are solved in windows of up to {sides}"))
}

/// The text of `percoat compare`: both methods under the last load of a case.
pub fn compared(case: &Case, comparison: &Comparison, width: usize) -> String {
    let (units, steps) = (case.units(), case.load.values().len());
    let mut text = heading(case);
    if steps > 1 {
        text += &format!("the last of {steps} load steps\n");
    }
    let readings = readings(comparison, &units).fitted(width);
    text += &format!("\n{readings}\n\n{}\n\n", differences(comparison).fitted(width));
    let mean = Assumptions::of(case).lines(false, width);
    text + &stresses(comparison, &units).map_or(String::new(), |stresses| format!("{stresses}\n{mean}"))
}

/// The units of the load and the penetration.
fn units_of_loads(steps: &[StepRecord], units: &Units) -> [Prefixed; 2] {
    let readings = || steps.iter().map(|step| &step.reading);
    [
        units.load().suited(readings().map(|reading| reading.load(units.quantity()))),
        units.length().suited(readings().map(|reading| reading.penetration)),
    ]
}

fn detailed(steps: &[StepRecord], units: &Units) -> Table {
    let levels = || steps.iter().flat_map(|step| &step.reading.levels);
    let [load_unit, penetration] = units_of_loads(steps, units);
    let quantity = units.quantity();
    let load = units.force().suited(levels().map(|level| level.load));
    let pressure = units.pressure().suited(levels().filter_map(|level| level.finite_peak()));
    let length = units.length().suited(levels().filter_map(|level| level.contact_radius));
    let header = [
        load_unit.headed(units.quantity().name()),
        penetration.headed("penetration"),
        "contact".to_owned(),
        "level".to_owned(),
        load.headed("load on one"),
        "share".to_owned(),
        pressure.headed("peak pressure"),
        length.headed("contact radius"),
        "asymmetry".to_owned(),
    ];
    let mut rows = Vec::new();
    for step in steps {
        let mut lead = [
            in_unit(&load_unit, step.reading.load(quantity), step.reading.load_error(quantity)),
            in_unit(&penetration, step.reading.penetration, step.reading.errors.penetration),
            contact(&step.reading, units),
        ];
        for level in &step.reading.levels {
            let radius = match level.contact_radius {
                _ if level.load == 0.0 => "–".to_owned(),
                // A ring has two radii.
                Some(radius) if level.ring => match (level.radius_inner, level.radius_outer) {
                    (Some(inner), Some(outer)) => format!(
                        "ring {} to {}",
                        in_unit(&length, inner, level.errors.radius_inner),
                        in_unit(&length, outer, level.errors.radius_outer)
                    ),
                    _ => format!("ring, area of {}", number(length.shown(radius))),
                },
                Some(radius) => in_unit(&length, radius, level.errors.contact_radius),
                None => "merged".to_owned(),
            };
            let cells = [
                level.level.to_string(),
                in_unit(&load, level.load, level.errors.load),
                percent_with_error(level.load_share, level.errors.load_share),
                finite(&pressure, level.finite_peak(), level.errors.max_pressure),
                radius,
                level.asymmetry.map_or("–".to_owned(), |part| percent_with_error(part, level.errors.asymmetry)),
            ];
            rows.push([&lead[..], &cells[..]].concat());
            lead = [const { String::new() }; 3];
        }
    }
    let table = Table::new(&header, rows, 0);
    if steps.iter().any(|step| step.reading.levels.len() > 1) {
        return table.keyed(&[0, 3]);
    }
    // A single level has the whole load, and a single isolated indenter the force: no columns of level, load on one and share.
    let has_force = |reading: &Reading| (reading.levels[0].load - reading.force).abs() <= NOTHING * reading.force;
    let is_alone = |reading: &Reading| reading.surroundings() == Surroundings::FreeSpace && has_force(reading);
    table.without(if steps.iter().all(|step| is_alone(&step.reading)) { &[3, 4, 5] } else { &[3, 5] })
}

fn compact(steps: &[StepRecord], levels: usize, units: &Units) -> Table {
    let readings = || steps.iter().map(|step| &step.reading);
    let [load_unit, penetration] = units_of_loads(steps, units);
    let quantity = units.quantity();
    let pressure = units.pressure().suited(readings().filter_map(Reading::finite_peak));
    let LoadWords { depth, area, .. } = *LoadWords::of(steps);
    let mut header = vec![load_unit.headed(units.quantity().name()), penetration.headed(depth), area.to_owned()];
    header.extend((1..=levels).map(|level| pressure.headed(&format!("peak {level}"))));
    // A single level has the whole load.
    let shares = if levels > 1 { levels } else { 0 };
    header.extend((1..=shares).map(|level| format!("share {level}")));
    let energy = units.energy().suited(readings().map(|reading| reading.elastic_energy));
    if levels == 0 {
        header.extend([pressure.headed("peak pressure"), energy.headed("elastic energy")]);
    }
    let row = |reading: &Reading| {
        let mut row = vec![
            in_unit(&load_unit, reading.load(quantity), reading.load_error(quantity)),
            in_unit(&penetration, reading.penetration, reading.errors.penetration),
            contact(reading, units),
        ];
        let peak = |level: &LevelReading| finite(&pressure, level.finite_peak(), level.errors.max_pressure);
        row.extend(reading.levels.iter().map(peak));
        let shared = reading.levels.iter().take(shares);
        row.extend(shared.map(|level| percent_with_error(level.load_share, level.errors.load_share)));
        if levels == 0 {
            row.push(finite(&pressure, reading.finite_peak(), reading.errors.max_pressure));
            row.push(in_unit(&energy, reading.elastic_energy, reading.errors.elastic_energy));
        }
        row
    };
    Table::new(&header, readings().map(row).collect(), 0)
}

/// The fraction in contact, or the area of an isolated one.
fn contact(reading: &Reading, units: &Units) -> String {
    let Some(part) = reading.contact_fraction else {
        let area = units.area().suited([reading.contact_area]);
        return area.behind(&in_unit(&area, reading.contact_area, reading.errors.contact_area));
    };
    percent_with_error(part, reading.errors.contact_fraction)
}

/// Two decimals; no sign for zero.
fn percent(x: f64) -> String {
    let text = format!("{:.2} %", 100.0 * x);
    text.strip_prefix('-').filter(|text| *text == "0.00 %").map_or(text.clone(), str::to_owned)
}

/// "`name` by +1.25 %": the relative change of a quantity, from its value `without` layers or neighbours to the one `found`; `None`
/// where one of them is missing.
fn change(name: &str, found: Option<f64>, without: Option<f64>) -> Option<String> {
    let text = percent(found? / without? - 1.0);
    let sign = if text.starts_with('-') { "" } else { "+" };
    Some(format!("{name} by {sign}{text}"))
}

/// A number with its error, or "singular".
fn finite(unit: &Prefixed, x: Option<f64>, error: Option<f64>) -> String {
    x.map_or("singular".to_owned(), |x| in_unit(unit, x, error))
}

/// A number with its error, both in the unit of their column, which is not named.
pub fn in_unit(unit: &Prefixed, x: f64, error: Option<f64>) -> String {
    with_error(unit.shown(x), error.map(|error| unit.shown(error)))
}

/// A part with its error in per cent: at most two decimals, fewer where the error is larger.
pub(crate) fn percent_with_error(x: f64, error: Option<f64>) -> String {
    match error.map(|error| 100.0 * error) {
        Some(error) if error > ROUNDING * 100.0 * x.abs() => {
            format!("{} %", with_error(100.0 * x, Some(error.max(0.01))))
        }
        _ => percent(x),
    }
}

/// Convergence of the load steps, in a line.
pub fn solved(steps: &[StepRecord]) -> String {
    let [n1, n2] = steps.last().map_or([0, 0], |step| step.points);
    if steps.iter().any(|step| step.kind().is_given) {
        return format!("displacements by the given pressure on {n1} × {n2} samples");
    }
    let most = steps.iter().map(|step| step.iterations).max().unwrap_or(0);
    let gap = largest(steps.iter().map(|step| step.certificate.energy_gap));
    let done = steps.iter().filter(|step| step.converged()).count();
    let at_rounding = match steps.iter().filter(|step| step.stop == Stop::Rounding).count() {
        0 => String::new(),
        count => format!("; {count} of them as far as double precision carries, short of solver.tolerance"),
    };
    format!(
        "{done} of {} load steps converged on {n1} × {n2} samples, at most {most} iterations each, energy of the \
         error below {gap:.0e} of the elastic energy{at_rounding}",
        steps.len()
    )
}

/// Number of contact spots of a topography in the last step that has any, in a line; `None` for indenters.
fn spots(steps: &[StepRecord]) -> Option<String> {
    let last = steps.iter().rposition(|step| step.rough.is_some())?;
    let count = steps[last].rough.as_ref()?.spots.count;
    Some(format!("contact spots in step {}: {count}; samples that share an edge or a corner are one spot", last + 1))
}

/// The largest estimated discretisation errors of all steps, in a line; `None` where there are none.
pub fn largest_errors(steps: &[StepRecord]) -> Option<String> {
    // What is rounding is no error of the grid.
    let relative = |value: f64, error: Option<f64>| {
        error.filter(|_| value != 0.0).map(|error| error / value.abs()).filter(|error| *error > NOTHING)
    };
    let readings = || steps.iter().map(|step| &step.reading);
    let levels = || readings().flat_map(|reading| &reading.levels);
    let depth = LoadWords::of(steps).depth;
    let named = [
        (depth, readings().filter_map(|s| relative(s.penetration, s.errors.penetration)).reduce(f64::max)),
        (
            "peak pressure",
            readings().filter_map(|s| relative(s.finite_peak()?, s.errors.max_pressure)).reduce(f64::max),
        ),
        ("load on one", levels().filter_map(|l| relative(l.load, l.errors.load)).reduce(f64::max)),
        (
            "contact radius",
            levels().filter_map(|l| relative(l.contact_radius?, l.errors.contact_radius)).reduce(f64::max),
        ),
    ];
    let texts: Vec<String> =
        named.into_iter().filter_map(|(name, error)| Some(format!("{name} {:.1e}", error?))).collect();
    (!texts.is_empty()).then(|| format!("estimated relative discretisation errors, at most: {}", texts.join(", ")))
}

/// Wall times of a run by phases, in a line.
pub fn timing(timing: &Timing) -> String {
    let Timing { setup, solve, stress, output } = timing;
    let stress = if *stress > 0.0 { format!(", stresses {stress:.2}") } else { String::new() };
    format!("setup {setup:.2}, solution {solve:.2}{stress}, output {output:.2}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use percoat_case::units::Unit;

    #[test]
    fn what_rounds_to_zero_has_no_sign_and_what_is_infinite_no_number() {
        assert_eq!([-1e-9, 0.0, -0.00006, 0.5].map(percent), ["0.00 %", "0.00 %", "-0.01 %", "50.00 %"]);
        let changes = [1.0 - 1e-9, 1.0, 1.00006, 0.5].map(|found| change("it", Some(found), Some(1.0)).unwrap());
        assert_eq!(changes, ["it by +0.00 %", "it by +0.00 %", "it by +0.01 %", "it by -50.00 %"]);
        assert_eq!(change("it", None, Some(1.0)), None);
        assert_eq!([None, Some(0.5)].map(|x| finite(&Unit::None.prefixed(1.0), x, None)), ["singular", "0.50000"]);
    }
}

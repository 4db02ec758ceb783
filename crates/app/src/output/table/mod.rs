//! Tables of results for the terminal and the report.

mod adhesion;
mod alone;
mod assumed;
mod by_step;
mod comparison;
mod creep;
mod fatigue;
mod hertz;
mod hysteresis;
mod largest;
mod life;
mod load_steps;
mod plastic;
mod slip;
mod strains;
mod strength;
mod temperature;
mod text;

pub use adhesion::{adhesion, adhesion_words, adhesive_loss, adhesive_path};
pub use alone::alone;
pub(super) use assumed::BARS;
pub use assumed::{Assumptions, library_strengths, scatter};
pub use comparison::{differences, readings, stresses};
pub use creep::{creep, creep_words};
pub use fatigue::lives;
pub use hertz::hertz;
pub use hysteresis::{hysteresis, motion_words};
pub use largest::largest_stresses;
pub use life::{events, headline, left};
pub use load_steps::{DETAILED, steps};
pub use plastic::plastic;
pub use slip::slip;
pub use strains::largest_strains;
pub use strength::{limits, utilisations};
pub use temperature::{heat_words, temperature};
pub use text::{INTERVALS, Table, Worded};
pub(super) use text::{indented, lines};

use super::number::{number, percent, with_unit};
use super::{ComparisonFile, LifeFile, Timing};
use percoat_case::case::{Case, SurfaceSection};
use percoat_case::units::Units;
use percoat_common::plain;
use percoat_core::measured::Measured;
use percoat_core::numeric::search::largest;
use percoat_core::quantity::{Named, Quantity};
use percoat_core::reading::{LEVEL, READING};
use percoat_core::run::{Limits, STEP, StepRecord};
use percoat_core::spectral::Stop;

/// Relative errors up to this are rounding.
const NOTHING: f64 = 1e-12;

/// The text of `percoat solve`: tables of readings, largest stresses and utilisations, convergence and errors. `change`: relative
/// change from the next coarser grid, where an accuracy was prescribed.
pub fn outcome(case: &Case, steps: &[StepRecord], change: Option<f64>, width: usize) -> String {
    let units = case.units();
    let mut text = heading(case);
    let mut has_intervals = false;
    let mut fitted = |table: &Table| {
        has_intervals |= table.has_intervals();
        table.fitted(width)
    };
    text += &format!("\n{}\n\n{}\n", fitted(&self::steps(steps, &units)), solved(steps));
    text += &spots(steps).map_or(String::new(), |spots| format!("{spots}\n"));
    text += &contact_stiffness(steps, &units).unwrap_or_default();
    if let Some((words, table)) = plastic(steps, &units) {
        text += &lines(&words, width);
        text += &table.map_or(String::new(), |table| format!("{}\n\n", fitted(&table)));
    }
    if let Some((words, table)) = slip(steps, &units) {
        text += &format!("{}{}\n\n", lines(&words, width), table.fitted(width));
    }
    let told = [
        adhesion(case, steps, &units),
        hysteresis(case.problem(), steps, &units),
        temperature(case.problem(), steps, &units),
        creep(case, steps, &units),
    ];
    for (words, table) in told.into_iter().flatten() {
        text += &words.iter().map(|words| lines(words, width)).collect::<String>();
        text += &format!("{}\n\n", fitted(&table));
    }
    text += &hertz(case, steps, &units).map_or(String::new(), |lines| format!("{}\n", lines.join(";\n")));
    let largest = largest_stresses(steps, &units);
    if let Some(largest) = &largest {
        text += &format!("\n{}\n", fitted(largest));
    }
    text += &largest_strains(steps, &units).map_or(String::new(), |strains| format!("\n{}\n", fitted(&strains)));
    let strength = utilisations(steps, Some(case.problem().bodies()), &units);
    if let Some(strength) = &strength {
        text += &format!("\n{}\n{}\n", lines(&strength.words, width), fitted(&strength.table));
    }
    let lives = lives(steps, &units);
    if let Some(lives) = &lives {
        text += &format!("\n{}\n{}\n", lines(&lives.words, width), fitted(&lives.table));
    }
    if largest.is_some() || strength.is_some() || lives.is_some() {
        text.push('\n');
    }
    if has_intervals {
        text += &format!("{INTERVALS}\n");
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
    let (step, stiffness) = steps.iter().rev().find_map(|step| Some((step, STEP.contact_stiffness.of(step)?)))?;
    let Named { name, symbol, kind, .. } = STEP.contact_stiffness.named;
    let load = units.force().with_unit(step.reading.force, number);
    Some(format!("{name} {symbol} at the force {load}: {}\n", with_unit(&units.unit(kind), stiffness)))
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

/// Sentence on the size of windows larger than that of the case, in which loads were solved; `None` without any.
pub fn wider_windows(found: &Limits, units: &Units) -> Option<String> {
    let [width, height] = found.window?;
    let unit = units.length().suited([width, height]);
    let sides = unit.behind(&format!("{} × {}", number(unit.shown(width)), number(unit.shown(height))));
    Some(format!("loads for which the contact is too large for its window are solved in windows of up to {sides}"))
}

/// The text of `percoat compare`: both methods under the last load of a case.
pub fn compared(case: &Case, comparison: &ComparisonFile, width: usize) -> String {
    let (units, steps) = (case.units(), case.step_count());
    let mut text = heading(case);
    if steps > 1 {
        text += &format!("the last of {steps} load steps\n");
    }
    let readings = readings(comparison, &units);
    text += &format!("\n{}\n\n{}\n\n", readings.fitted(width), differences(comparison).fitted(width));
    if readings.has_intervals() {
        text += &format!("{INTERVALS}\n");
    }
    let mean = Assumptions::of(case).lines(false, width);
    text + &stresses(comparison, case).map_or(String::new(), |stresses| format!("{stresses}\n{mean}"))
}

/// "`name` by +1.25 %": the relative change of a quantity, from its value `without` layers or neighbours to the one `found`; `None`
/// where one of them is missing.
fn change(name: &str, found: Option<f64>, without: Option<f64>) -> Option<String> {
    let text = percent(found? / without? - 1.0);
    let sign = if text.starts_with('-') { "" } else { "+" };
    Some(format!("{name} by {sign}{text}"))
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
    // Relative errors of rounding are no errors of the grid. Values of surfaces that adhere pass through zero: their errors are over the largest one.
    fn most<'a, R: 'static>(quantity: &Quantity<R>, all: impl Iterator<Item = &'a R>, adheres: bool) -> Option<f64> {
        let found: Vec<Measured> = all.filter_map(|record| quantity.finite(record)).collect();
        let largest = found.iter().map(|found| found.value.abs()).fold(0.0, f64::max);
        let relative = |found: &Measured| if adheres { Some(found.error? / largest) } else { found.relative() };
        found.iter().filter_map(relative).filter(|error| *error > NOTHING).reduce(f64::max)
    }
    let adheres = steps.iter().any(|step| step.adhesion.is_some());
    let readings = || steps.iter().map(|step| &step.reading);
    let is_given = steps.iter().any(|step| step.kind().is_given);
    let whole = [&READING.penetration, &READING.max_pressure];
    let whole = whole.map(|quantity| (quantity.named.of(is_given), most(quantity, readings(), adheres)));
    let of_level = [&LEVEL.load, &LEVEL.contact_radius];
    let of_level = of_level
        .map(|quantity| (quantity.named.name, most(quantity, readings().flat_map(|reading| &reading.levels), adheres)));
    let texts: Vec<String> =
        whole.into_iter().chain(of_level).filter_map(|(name, error)| Some(format!("{name} {:.1e}", error?))).collect();
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

    #[test]
    fn what_rounds_to_zero_has_no_sign() {
        assert_eq!([-1e-9, 0.0, -0.00006, 0.5].map(percent), ["0.00 %", "0.00 %", "-0.01 %", "50.00 %"]);
        let changes = [1.0 - 1e-9, 1.0, 1.00006, 0.5].map(|found| change("it", Some(found), Some(1.0)).unwrap());
        assert_eq!(changes, ["it by +0.00 %", "it by +0.00 %", "it by +0.01 %", "it by -50.00 %"]);
        assert_eq!(change("it", None, Some(1.0)), None);
    }
}

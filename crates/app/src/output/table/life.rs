//! Events of a body pass after pass.

use super::{Table, lives};
use crate::output::LifeFile;
use crate::output::number::number;
use percoat_case::units::{Unit, Units, pascals};
use percoat_core::life::{Course, Event, First, FirstKind, LifeEnd, Scar};
use percoat_core::notation::power_error;
use percoat_core::spectral::Stop;

/// Most events in the table, from both ends.
const EVENTS: usize = 12;

/// Table of events, of many the first and the last ones.
pub fn events(events: &[Event], units: &Units) -> Option<Table> {
    if events.is_empty() {
        return None;
    }
    let length = units.length().suited(events.iter().flat_map(|event| [event.depth, event.thickness, event.removed]));
    let way = units.length().suited(events.iter().filter_map(|event| event.distance));
    let is_known = events.iter().any(|event| event.distance.is_some());
    let mut header = vec!["passes".to_owned(), "event".to_owned(), "what fails".to_owned()];
    header.extend(is_known.then(|| way.headed("distance")));
    header.extend(["depth", "layers left", "removed"].map(|name| length.headed(name)));
    let row = |event: &Event| {
        let shown = |x: f64| number(length.shown(x));
        let mut row = vec![number(event.passes), event.what.to_string(), event.part.to_string()];
        row.extend(is_known.then(|| event.distance.map_or(String::new(), |distance| number(way.shown(distance)))));
        row.extend([event.depth, event.thickness, event.removed].map(shown));
        row
    };
    let mut rows: Vec<Vec<String>> = events.iter().map(row).collect();
    if rows.len() > EVENTS {
        let left = rows.len() - EVENTS;
        let tail = rows.split_off(rows.len() - EVENTS / 2);
        rows.truncate(EVENTS / 2);
        let mut gap = vec![String::new(); header.len()];
        gap[0] = "…".to_owned();
        gap[1] = format!("{left} more");
        rows.push(gap);
        rows.extend(tail);
    }
    Some(Table::new(&header, rows, 0))
}

/// The first event, of any kind, in a line; of surfaces that only wear how far they were followed.
pub fn headline(file: &LifeFile, units: &Units) -> String {
    let slid = |first: &First| {
        let slid = first.distance.map(|slid| units.length().with_unit(slid, number));
        slid.map_or(String::new(), |slid| format!(", after sliding {slid}"))
    };
    let foreseen = lives(&file.steps, units).map(|lives| lives.words);
    let Some(first) = &file.first else {
        let passes = file.wear.last().map_or(0.0, |last| last.passes);
        return format!("nothing is worn through in {} passes; no fatigue law is given", number(passes));
    };
    // The life of the unworn surfaces, as the steps have it.
    let is_foreseen = file
        .criteria
        .iter()
        .any(|criterion| criterion.life.part == first.part && criterion.life.passes == first.passes);
    match (first.kind, foreseen) {
        (FirstKind::Fatigue | FirstKind::Delamination, Some(words)) if is_foreseen => {
            let worn = file.wear.iter().any(|state| state.body_depth > 0.0 || state.counterbody_depth > 0.0);
            match (file.events.is_empty() && worn, file.wear.last()) {
                (true, Some(last)) => format!(
                    "nothing fails in {} passes, as the surfaces wear; unworn: {words}{}",
                    number(last.passes),
                    slid(first)
                ),
                _ => format!("{words}{}", slid(first)),
            }
        }
        (FirstKind::WornThrough, _) => {
            format!("first event: {} is worn through after {} passes{}", first.part, number(first.passes), slid(first))
        }
        _ => {
            let (passes, error) = (number(first.passes), power_error(first.error));
            format!("first damage of {} after {passes} passes{error}{}", first.part, slid(first))
        }
    }
}

/// Layers left at the end, in a line, or that nothing ever fails; `None` where the life was followed only to the first
/// failure.
pub fn left(file: &LifeFile, units: &Units) -> Option<String> {
    let (last, end) = (file.wear.last()?, file.end?);
    let length = |x: f64| units.length().with_unit(x, number);
    let why = match end {
        LifeEnd::Passes => String::new(),
        LifeEnd::Endless => return Some("no part of the body ever fails by fatigue under this load".to_owned()),
        LifeEnd::NothingLeft => ", and nothing is left on the rigid base".to_owned(),
        LifeEnd::Unsolved => {
            format!("; the contact of the worn surfaces could not be solved any further: {}", unsolved(file.stop))
        }
        LifeEnd::LoadLimit => "; no more loads are solved".to_owned(),
    };
    let slid = last.distance.map_or(String::new(), |slid| format!(", {} of sliding,", length(slid)));
    let worn = match (last.body, last.counterbody) {
        (Some(body), Some(counterbody)) => format!(
            ", sliding has worn off {} of the body and {} of the counterbody (means)",
            length(body),
            length(counterbody)
        ),
        _ => worn_alone(last, units),
    };
    Some(format!(
        "after {} passes{slid} {} of the layers are left, {} of the body is removed{worn}{why}",
        number(last.passes),
        length(last.thickness),
        length(last.removed),
    ))
}

/// Why a contact was not solved, and what to do.
fn unsolved(stop: Option<Stop>) -> String {
    match stop {
        Some(Stop::AtBorder) => {
            "it reaches the border of its window, which has been enlarged as often as allowed; give a larger lattice.size".to_owned()
        }
        Some(Stop::BeyondHardness) => "no pressure below the hardness bears the load".to_owned(),
        Some(stop) => format!("{stop}; raise solver.max_iterations, or give a finer grid"),
        None => "its solution did not converge".to_owned(),
    }
}

/// The groove and the scars of an isolated contact, as wear is measured.
fn worn_alone(last: &Course, units: &Units) -> String {
    let length = |x: f64| units.length().with_unit(x, number);
    let raised = |x: f64, power: i32, sign: &str| {
        let unit = units.length().suited([x.powf(1.0 / f64::from(power))]);
        let shown = number(x * 10f64.powi(power * unit.exponent));
        if unit.name.is_empty() { shown } else { format!("{shown}\u{a0}{}{sign}", unit.name) }
    };
    let groove = last.groove.map(|area| {
        format!("its groove is {} deep and has a cross-section of {}", length(last.body_depth), raised(area, 2, "²"))
    });
    let scar = |of: &str, scar: Option<Scar>| {
        let words = |scar: Scar| {
            let (diameter, depth) = (length(scar.diameter), length(scar.depth));
            let volume = raised(scar.volume, 3, "³");
            format!("the scar of the {of} has a diameter of {diameter}, a depth of {depth} and a volume of {volume}")
        };
        scar.filter(|scar| scar.depth > 0.0).map(words)
    };
    let rate = last.specific_rate.map_or(String::new(), |rate| format!(", {}", specific_rate(rate, units)));
    let of_counterbody = scar("counterbody", last.scar).map(|words| words + &rate);
    let all = groove.into_iter().chain(scar("body", last.body_scar)).chain(of_counterbody);
    all.map(|words| format!(", {words}")).collect()
}

/// A specific wear rate with its unit.
fn specific_rate(rate: f64, units: &Units) -> String {
    let pressure = match units.pressure() {
        Unit::Si { .. } | Unit::Named(_) => units.pressure().name(),
        Unit::None | Unit::Relative(_) | Unit::Strain => None,
    };
    match pressure.as_deref().and_then(pascals) {
        // One over a gigapascal is a cubic millimetre per newton and metre.
        Some(pascals) => format!("a specific wear rate of {}\u{a0}mm³/(N·m)", number(rate * 1e9 / pascals)),
        None => {
            let unit = pressure.map_or(String::new(), |name| format!("\u{a0}1/{name}"));
            format!("a specific wear rate (volume over force and distance) of {}{unit}", number(rate))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_specific_rate_is_told_in_cubic_millimetres_where_pressures_have_a_unit() {
        let units = |pressure: Option<&str>| Units::unknown().named(None, pressure);
        let told = |pressure: Option<&str>| specific_rate(2e-6, &units(pressure)).replace('\u{a0}', " ");
        for (pressure, rate) in [("GPa", 2e-6), ("MPa", 2e-3), ("Pa", 2e3)] {
            let expected = format!("of {} mm³/(N·m)", number(rate));
            assert!(told(Some(pressure)).ends_with(&expected), "{}", told(Some(pressure)));
        }
        assert!(told(None).contains("volume over force and distance"), "{}", told(None));
    }
}

//! What happens to a body pass after pass.

use super::Table;
use crate::life::{Course, Event, LifeEnd};
use crate::output::number::number;
use crate::units::Units;

/// Most events in the table, from both ends.
const EVENTS: usize = 12;

/// Table of events, of many the first and the last ones.
pub fn events(events: &[Event], units: &Units) -> Option<Table> {
    if events.is_empty() {
        return None;
    }
    let length = units.length().suited(events.iter().flat_map(|own| [own.depth, own.thickness, own.removed]));
    let header = [
        "passes".to_owned(),
        "event".to_owned(),
        "what fails".to_owned(),
        length.headed("depth"),
        length.headed("layers left"),
        length.headed("removed"),
    ];
    let row = |own: &Event| {
        let shown = |x: f64| number(length.shown(x));
        vec![
            number(own.passes),
            own.what.to_string(),
            own.part.to_string(),
            shown(own.depth),
            shown(own.thickness),
            shown(own.removed),
        ]
    };
    let mut rows: Vec<Vec<String>> = events.iter().map(row).collect();
    if rows.len() > EVENTS {
        let left = rows.len() - EVENTS;
        let tail = rows.split_off(rows.len() - EVENTS / 2);
        rows.truncate(EVENTS / 2);
        rows.push(vec![
            "…".to_owned(),
            format!("{left} more"),
            String::new(),
            String::new(),
            String::new(),
            String::new(),
        ]);
        rows.extend(tail);
    }
    Some(Table::new(&header, rows, 0))
}

/// What is left at the end, in a line, or that nothing ever fails; `None` where it was followed only to the first failure.
pub fn left(course: &[Course], end: Option<LifeEnd>, units: &Units) -> Option<String> {
    let (last, end) = (course.last()?, end?);
    let length = |x: f64| units.length().with_unit(x, number);
    let why = match end {
        LifeEnd::Passes => String::new(),
        LifeEnd::Endless => return Some("nothing of the body ever fails by fatigue under this load".to_owned()),
        LifeEnd::NothingLeft => ", and nothing is left on the rigid base".to_owned(),
        LifeEnd::Unsolved => "; the contact of the worn surfaces could not be solved any further".to_owned(),
        LifeEnd::LoadLimit => "; no more loads are solved".to_owned(),
    };
    Some(format!(
        "after {} passes {} of the layers are left, {} of the body is removed, sliding has worn off {} of the body and {} of the counterbody (means){why}",
        number(last.passes),
        length(last.thickness),
        length(last.removed),
        length(last.body),
        length(last.counterbody)
    ))
}

//! Which criterion comes first, over two keys of a sweep: a map in colours, with their names below it.

use super::super::canvas::{Anchor, Canvas};
use super::super::colour::Colour;
use super::super::map::Map;
use super::super::sheet::{HAIR, Margins, NUMBERS, Panel};
use super::super::text;
use serde_json::Value;
use std::collections::BTreeMap;

/// Side of a sample of a colour, and its distance from its name, points.
const SAMPLE: f64 = 0.8 * NUMBERS;
const GAP: f64 = 3.0;
/// Height of a name.
const ROW: f64 = 1.4 * NUMBERS;

/// What results say of the criterion that comes first: in a search for limits the first one, under a load the one that
/// governs.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum First {
    Criterion(String),
    /// No criterion is reached, and by the errors some may be.
    Undecided,
    Nothing,
}

impl First {
    /// `None` where the result is neither of a search for limits nor of a load step with strengths.
    pub fn of(result: &Value) -> Option<Self> {
        let first = own(result)?;
        let Some(criterion) = first.get("criterion").and_then(Value::as_str) else {
            return Some(if Self::is_undecided(result) { Self::Undecided } else { Self::Nothing });
        };
        let of = ["material", "interface"].iter().find_map(|of| Some(format!(" of {of} {}", first.get(of)?.as_u64()?)));
        Some(Self::Criterion(format!("{criterion}{}", of.unwrap_or_default())))
    }

    pub fn name(&self) -> &str {
        match self {
            Self::Criterion(name) => name,
            Self::Undecided => "undecided",
            Self::Nothing => "nothing fails",
        }
    }

    /// Whether the errors leave open that another criterion comes first.
    pub fn is_undecided(result: &Value) -> bool {
        let rivals = own(result).and_then(|first| first.get("rivals")?.as_array());
        rivals.is_some_and(|rivals| !rivals.is_empty())
    }

    /// What comes first in any of the results, the most frequent first, with how often it does.
    pub fn counted<'a>(results: impl Iterator<Item = &'a Value>) -> Vec<(Self, usize)> {
        let mut counts: BTreeMap<Self, usize> = BTreeMap::new();
        results.filter_map(Self::of).for_each(|own| *counts.entry(own).or_default() += 1);
        let mut counted: Vec<(Self, usize)> = counts.into_iter().collect();
        counted.sort_by_key(|(_, count)| usize::MAX - count);
        counted
    }
}

/// What a result says of the first limit, or of what governs.
fn own(result: &Value) -> Option<&Value> {
    result.get("first").or_else(|| result.get("governing"))
}

/// The colour of a criterion by its place among all; what does not fail is white.
pub fn colour(first: &First, index: usize) -> Colour {
    match first {
        First::Undecided | First::Nothing => Colour::WHITE,
        // Six colours, then six paler ones.
        First::Criterion(_) => Colour::line(index + 1).lighter(if index % 12 < 6 { 0.0 } else { 0.55 }),
    }
}

/// A map with the names of its colours.
pub struct Named<'a> {
    pub map: Map<'a>,
    pub names: Vec<(Colour, String)>,
}

impl Named<'_> {
    /// Where the samples stand relative to the corner of the names, and the height of all, at a width.
    fn places(&self, width: f64) -> (Vec<[f64; 2]>, f64) {
        let widths = self.names.iter().map(|(_, name)| SAMPLE + GAP + text::width(name, NUMBERS) + 3.0 * GAP);
        let pitch = widths.fold(1.0, f64::max);
        let columns = ((width / pitch) as usize).clamp(1, self.names.len().max(1));
        let place = |k: usize| [(k % columns) as f64 * pitch, (k / columns) as f64 * ROW];
        let rows = self.names.len().div_ceil(columns);
        ((0..self.names.len()).map(place).collect(), rows as f64 * ROW + GAP)
    }
}

impl Panel for Named<'_> {
    fn title(&self) -> &str {
        self.map.title()
    }

    fn margins(&self, width: f64) -> Margins {
        self.map.margins(width)
    }

    fn height(&self, width: f64, margins: Margins) -> f64 {
        self.map.height(width, margins) + self.places(width - margins.left).1
    }

    fn draw(&self, canvas: &mut Canvas, [ox, oy]: [f64; 2], width: f64, margins: Margins) {
        self.map.draw(canvas, [ox, oy], width, margins);
        let corner = [ox + margins.left, oy + self.map.height(width, margins) + GAP];
        for ([x, y], (colour, name)) in self.places(width - margins.left).0.into_iter().zip(&self.names) {
            let [left, top] = [corner[0] + x, corner[1] + y + 0.5 * (ROW - SAMPLE)];
            let sample = [[left, top], [left + SAMPLE, top], [left + SAMPLE, top + SAMPLE], [left, top + SAMPLE]];
            canvas.area(&sample, *colour);
            canvas.outline(&sample, 0.5 * HAIR, Colour::BLACK);
            let middle = [left + SAMPLE + GAP, top + 0.5 * SAMPLE];
            canvas.label(name, middle, Anchor::Left, NUMBERS, Colour::BLACK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_comes_first_is_named_as_the_search_names_it_and_counted() {
        let yields = json!({ "first": { "criterion": "yield", "material": 2 } });
        let parts = json!({ "first": { "criterion": "delamination", "interface": 1 } });
        let open = json!({ "first": { "criterion": null, "reached": "undecided", "rivals": ["yield of material 2"] } });
        assert_eq!(First::of(&open), Some(First::Undecided));
        let results = [yields, parts.clone(), parts, json!({ "first": null }), json!({ "max_pressure": 1.0 })];
        let counted = First::counted(results.iter());
        let counted: Vec<(&str, usize)> = counted.iter().map(|(first, count)| (first.name(), *count)).collect();
        assert_eq!(counted, [("delamination of interface 1", 2), ("yield of material 2", 1), ("nothing fails", 1)]);
        let undecided = |rivals: Value| {
            First::is_undecided(&json!({ "governing": { "criterion": "yield", "material": 2, "rivals": rivals } }))
        };
        assert!(undecided(json!(["cracking of material 1"])) && !undecided(json!([])) && !undecided(Value::Null));
    }
}

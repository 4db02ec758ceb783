//! The problem of a result, and how it is solved: the keys of its case in tables.

use super::markup::{Markup, tag};
use super::table::{pairs, table};
use crate::output::number;
use crate::output::table::Table;
use percoat_case::case::kind_of;
use percoat_case::words::AroundWords;
use percoat_core::counterbody::LevelName;
use percoat_core::lattice::Surroundings;
use serde_json::{Map, Value};

/// Names of keys in the tables; a key that is not listed is shown as in the case, underscores as blanks.
const NAMES: [(&str, &str); 22] = [
    ("a1", "cell vector a₁"),
    ("a2", "cell vector a₂"),
    ("accuracy", "prescribed accuracy"),
    ("coefficient", "coefficient"),
    ("coupling", "coupled to the pressure"),
    ("heights", "heights, a file"),
    ("interface", "lower face"),
    ("interface_fatigue", "fatigue of the lower face"),
    ("interface_strength", "strength of the lower face"),
    ("kind", "lattice"),
    ("material", "from the library"),
    ("max_iterations", "most iterations"),
    ("poisson", "Poisson’s ratio"),
    ("residual_stress", "residual stress"),
    ("shear_ratio", "shear ratio χ"),
    ("sites", "sites (parts of a₁, a₂)"),
    ("size", "sides of the window"),
    ("tensile_strength", "tensile strength"),
    ("tolerance", "tolerance of the solver"),
    ("wear", "coefficient of wear, 1/pressure"),
    ("yield_strength", "yield strength"),
    ("young", "Young’s modulus"),
];

/// Keys of a list of which the columns come first.
const FRONT: [&str; 5] = ["name", "thickness", "shear_ratio", "young", "graded"];

/// Sections of a case that the last table leaves out: shown in tables of their own, or without effect on the result.
const APART: [&str; 7] = ["title", "levels", "layers", "substrate", "counterbody", "localized", "units"];

/// Counterbody and body in a sentence, then the keys of the case in tables.
pub(super) fn problem(case: &Value) -> Markup {
    let words = AroundWords::of(kind_of(case).surroundings);
    let mut parts = vec![tag("p", sentence(case))];
    let levels = list(case, "levels");
    let rigid = if is_elastic(case) { "" } else { ", rigid" };
    if let Some(shape) = lone_shape(case) {
        parts.push(items(&format!("The indenter{rigid}"), "indenter", levels, |_| {
            LevelName::of_shape(shape).to_owned()
        }));
    } else if !levels.is_empty() {
        parts.push(items(&format!("The indenters{rigid}, level by level"), "level", levels, |number| {
            number.to_string()
        }));
    }
    parts.push(materials("The body, from the surface down", list(case, "layers"), &case["substrate"]));
    if let Some(keys) = case["counterbody"].as_object().filter(|_| !is_elastic(case)) {
        let surface: Map<String, Value> =
            keys.iter().filter(|(key, _)| *key != "rigid").map(|(key, value)| (key.clone(), value.clone())).collect();
        parts.push(of_keys(
            "The surface of the rigid counterbody",
            &entries("counterbody", &Value::Object(surface), words),
        ));
    } else if let Some(keys) = case["counterbody"].as_object() {
        let substrate: Map<String, Value> =
            keys.iter().filter(|(key, _)| *key != "layers").map(|(key, value)| (key.clone(), value.clone())).collect();
        let layers = list(&case["counterbody"], "layers");
        parts.push(materials("The counterbody, from its surface inward", layers, &Value::Object(substrate)));
    }
    let sections = case.as_object().into_iter().flatten().filter(|(key, _)| !APART.contains(&key.as_str()));
    let rows: Vec<(String, String)> = sections.flat_map(|(section, value)| entries(section, value, words)).collect();
    parts.push(of_keys(&format!("{}, load, grid and all other keys", words.heading), &rows));
    parts.into()
}

/// Keys and their values, a row each.
fn of_keys(caption: &str, rows: &[(String, String)]) -> Markup {
    let rows: Vec<(&str, Markup)> = rows.iter().map(|(name, text)| (name.as_str(), text.as_str().into())).collect();
    pairs(caption, &rows)
}

/// The items of a list of a section; empty without it.
fn list<'a>(section: &'a Value, key: &str) -> &'a [Value] {
    section[key].as_array().map(Vec::as_slice).unwrap_or_default()
}

/// Whether the counterbody is elastic, or its coating.
pub(super) fn is_elastic(case: &Value) -> bool {
    let counterbody = &case["counterbody"];
    !(counterbody.is_null() || on_rigid_base(counterbody) && list(counterbody, "layers").is_empty())
}

/// The layers of a body and its substrate as one table, with the numbers of their materials.
fn materials(caption: &str, layers: &[Value], substrate: &Value) -> Markup {
    let substrate = (!on_rigid_base(substrate)).then(|| substrate.clone());
    let body: Vec<Value> = layers.iter().cloned().chain(substrate).collect();
    let name = |number: usize| {
        let part = if number > layers.len() { "substrate".to_owned() } else { format!("layer\u{a0}{number}") };
        let above: usize = layers.iter().take(number - 1).map(sublayers).sum();
        match layers.get(number - 1).map_or(1, sublayers) {
            1 => format!("{}\u{a0}({part})", above + 1),
            several => format!("{} to {} ({part})", above + 1, above + several),
        }
    };
    items(caption, "material", &body, name)
}

/// Number of sublayers of a layer; 1 where it is not graded.
fn sublayers(layer: &Value) -> usize {
    layer["graded"]["sublayers"].as_u64().and_then(|count| usize::try_from(count).ok()).unwrap_or(1)
}

/// Whether a substrate is a rigid base.
fn on_rigid_base(substrate: &Value) -> bool {
    substrate["rigid"].as_bool().unwrap_or(false)
}

/// Counterbody and body in a sentence.
fn sentence(case: &Value) -> String {
    let (subject, is_one) = counterbody(case);
    let above = match coating(list(&case["counterbody"], "layers").len()) {
        coating if coating.is_empty() => coating,
        coating => format!("; the counterbody is one{coating}"),
    };
    let body = match coating(list(case, "layers").len()) {
        _ if on_rigid_base(&case["substrate"]) => match list(case, "layers").len() {
            1 => "an elastic layer on a rigid base".to_owned(),
            layers => format!("{layers} elastic layers on a rigid base"),
        },
        coating if coating.is_empty() => "an uncoated elastic half-space".to_owned(),
        coating => format!("an elastic half-space{coating}"),
    };
    if kind_of(case).is_given {
        return format!("A given pressure acts on {body}.");
    }
    let pressed = if is_one { "is pressed" } else { "are pressed" };
    let slide = match (case["tangential"].as_object(), is_one) {
        (Some(keys), true) if keys.contains_key("rolling") => "rolls",
        (Some(keys), false) if keys.contains_key("rolling") => "roll",
        (Some(_), true) => "sticks and slips",
        (Some(_), false) => "stick and slip",
        (None, true) => "slides",
        (None, false) => "slide",
    };
    let slides = case["friction"]["coefficient"].as_f64();
    let slides = slides.map_or(String::new(), |mu| format!(", and {slide} over it with friction μ = {}", plain(mu)));
    let pulls = if case["adhesion"].is_object() { ", and their surfaces pull each other" } else { "" };
    format!("{subject} {pressed} into {body}{slides}{above}{pulls}.")
}

/// The coating of a body in words; none of an uncoated one.
fn coating(layers: usize) -> String {
    match layers {
        0 => String::new(),
        1 => " with a coating of one layer".to_owned(),
        layers => format!(" with a coating of {layers} layers"),
    }
}

/// The indenters or the topography as the subject of the sentence, and whether it is singular.
fn counterbody(case: &Value) -> (String, bool) {
    let (levels, surroundings) = (list(case, "levels"), kind_of(case).surroundings);
    let [of, one, several] =
        if is_elastic(case) { ["elastic", "An elastic", "Elastic"] } else { ["rigid", "A rigid", "Rigid"] };
    let heights = if levels.len() == 1 { "one height".to_owned() } else { format!("{} levels", levels.len()) };
    match (count(levels), surroundings) {
        (0, Surroundings::Periodic) => (format!("{one} topography, repeated without end,"), true),
        (0, Surroundings::FreeSpace) => (format!("{one} topography in a window"), true),
        (1, Surroundings::FreeSpace) => {
            (format!("{one} {}", lone_shape(case).map_or("indenter", LevelName::of_shape)), true)
        }
        (count, Surroundings::FreeSpace) => (format!("{count} {of} indenters of {heights} in a window"), false),
        (_, Surroundings::Periodic) => {
            let lattice = match case["lattice"]["kind"].as_str().unwrap_or("periodic") {
                "oblique" => "an oblique".to_owned(),
                kind => format!("a {kind}"),
            };
            (format!("{several} indenters of {heights} on {lattice} lattice"), false)
        }
    }
}

/// Number of indenters of levels.
fn count(levels: &[Value]) -> usize {
    levels.iter().map(|level| level["sites"].as_array().map_or(1, Vec::len)).sum()
}

/// Shape of the only indenter of an isolated contact, in the word of case files; `None` of others.
fn lone_shape(case: &Value) -> Option<&str> {
    let levels = list(case, "levels");
    let is_lone = count(levels) == 1 && kind_of(case).surroundings == Surroundings::FreeSpace;
    let level = levels.first().filter(|_| is_lone)?;
    // A sharp pyramid is solved as a cone.
    let is_sharp = level["tip_radius"].is_null()
        && ["berkovich", "vickers", "cube-corner"].iter().any(|name| level["shape"] == **name);
    if is_sharp { Some("cone") } else { level["shape"].as_str() }
}

/// Most items that stand side by side.
const ABREAST: usize = 5;

/// A list of the case as one table: a row an item and a column for every key of any item, or of few items with many keys the other way
/// round.
fn items(caption: &str, lead: &str, items: &[Value], name: impl Fn(usize) -> String) -> Markup {
    let known = |key: &str| FRONT.iter().position(|front| *front == key).unwrap_or(FRONT.len());
    let mut keys: Vec<&String> = Vec::new();
    for key in items.iter().filter_map(Value::as_object).flat_map(Map::keys) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys.sort_by_key(|key| known(key));
    let cell = |item: &Value, key: &String| item.get(key).map_or("–".to_owned(), text);
    if items.len() <= ABREAST && items.len() < keys.len() {
        let head: Vec<String> = [lead.to_owned()].into_iter().chain((1..=items.len()).map(&name)).collect();
        let row = |key: &&String| [named(key)].into_iter().chain(items.iter().map(|item| cell(item, key))).collect();
        return table(caption, &Table::new(&head, keys.iter().map(row).collect(), head.len()));
    }
    let row = |(number, item): (usize, &Value)| {
        [name(number)].into_iter().chain(keys.iter().map(|key| cell(item, key))).collect()
    };
    let head: Vec<String> = [lead.to_owned()].into_iter().chain(keys.iter().map(|key| named(key))).collect();
    table(caption, &Table::new(&head, (1..).zip(items).map(row).collect(), 1))
}

/// The keys of a section with their values, without those of no effect on an isolated contact.
fn entries(section: &str, value: &Value, words: &AroundWords) -> Vec<(String, String)> {
    let prefix = |key: &str| {
        if matches!(section, "stress" | "friction" | "tangential" | "adhesion" | "life") {
            format!("{section}: {key}")
        } else {
            key.to_owned()
        }
    };
    let has_effect = |key: &str| !words.without_effect.contains(&[section, key]);
    match value {
        Value::Object(keys) => {
            let entry = |(key, value): (&String, &Value)| match key.as_str() {
                "points" if section == "grid" => (words.samples.to_owned(), text(value).replace(", ", " × ")),
                "points" => (prefix("single points"), text(value)),
                "tolerance" if section == "life" => (prefix("error of a step of wear"), text(value)),
                "size" => (named(key), text(value).replace(", ", " × ")),
                key => (prefix(&named(key)), text(value)),
            };
            keys.iter().filter(|(key, _)| has_effect(key)).map(entry).collect()
        }
        other => vec![(named(section), text(other))],
    }
}

fn named(key: &str) -> String {
    NAMES.iter().find(|(known, _)| *known == key).map_or_else(|| key.replace('_', " "), |(_, name)| (*name).to_owned())
}

/// Most items of a list that is shown whole.
const SHOWN: usize = 12;

/// A value of the case as text.
fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Bool(true) => "yes".to_owned(),
        Value::Bool(false) => "no".to_owned(),
        Value::Null => "–".to_owned(),
        Value::Number(number) if number.is_f64() => plain(number.as_f64().unwrap_or(f64::NAN)),
        Value::Number(number) => number.to_string(),
        Value::Array(items) if items.is_empty() => "none".to_owned(),
        Value::Array(items) if items.len() > SHOWN => {
            let ends = [items.first(), items.last()].map(|item| item.map_or(String::new(), text));
            format!("{} values from {} to {}", items.len(), ends[0], ends[1])
        }
        Value::Array(items) => {
            let nested = items.iter().any(Value::is_array);
            let texts: Vec<String> = items.iter().map(text).collect();
            if nested {
                texts.iter().map(|text| format!("({text})")).collect::<Vec<_>>().join(" ")
            } else {
                texts.join(", ")
            }
        }
        Value::Object(keys) => {
            let inner = |value: &Value| if value.is_array() { format!("({})", text(value)) } else { text(value) };
            keys.iter().map(|(key, value)| format!("{} {}", named(key), inner(value))).collect::<Vec<_>>().join(", ")
        }
    }
}

/// A number with all its digits, or with five where these are many; 2e-7 for 0.0000002.
fn plain(x: f64) -> String {
    if x.to_string().len() > 9 && x.abs() < 1e6 && x.abs() >= 1e-3 {
        number(x)
    } else if x == 0.0 || (1e-3..1e6).contains(&x.abs()) {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn counterbody_and_body_are_said_as_they_are() {
        let levels = |count: usize| vec![json!({ "shape": "sphere", "radius": 1.0 }); count];
        let [isolated, square] = ["isolated", "square"].map(|kind| json!({ "kind": kind }));
        let steel = json!({ "young": 210.0, "poisson": 0.3 });
        let coated = json!({ "young": 210.0, "poisson": 0.3, "layers": [{}, {}] });
        for (case, words) in [
            (
                json!({ "lattice": square, "levels": levels(2), "layers": [{}] }),
                "Rigid indenters of 2 levels on a square lattice are pressed into an elastic half-space with a coating of one layer.",
            ),
            (
                json!({ "lattice": { "kind": "oblique" }, "levels": levels(1), "friction": { "coefficient": 0.3 } }),
                "Rigid indenters of one height on an oblique lattice are pressed into an uncoated elastic half-space, and slide over \
                 it with friction μ = 0.3.",
            ),
            (
                json!({
                    "lattice": isolated, "levels": levels(1), "friction": { "coefficient": 0.3 },
                    "tangential": { "rolling": { "force": 0.1 } },
                }),
                "A rigid ball is pressed into an uncoated elastic half-space, and rolls over it with friction μ = 0.3.",
            ),
            (
                json!({ "lattice": isolated, "levels": levels(1), "counterbody": steel, "friction": { "coefficient": 0.3 } }),
                "An elastic ball is pressed into an uncoated elastic half-space, and slides over it with friction μ = 0.3.",
            ),
            (
                json!({ "lattice": isolated, "levels": levels(2) }),
                "2 rigid indenters of 2 levels in a window are pressed into an uncoated elastic half-space.",
            ),
            (
                json!({ "lattice": isolated, "surface": {}, "counterbody": coated, "layers": [{}] }),
                "An elastic topography in a window is pressed into an elastic half-space with a coating of one layer; the \
                 counterbody is one with a coating of 2 layers.",
            ),
        ] {
            assert_eq!(sentence(&case), words);
        }
    }

    #[test]
    fn a_sharp_pyramid_is_the_cone_that_is_solved() {
        let named = |level: Value| {
            let case = json!({ "lattice": { "kind": "isolated", "size": 2.0 }, "levels": [level] });
            lone_shape(&case).map(|shape| LevelName::of_shape(shape).to_owned())
        };
        assert_eq!(named(json!({ "shape": "berkovich" })).as_deref(), Some("cone"));
        assert_eq!(named(json!({ "shape": "berkovich", "tip_radius": 0.1 })).as_deref(), Some("tip"));
        assert_eq!(named(json!({ "shape": "sphere", "radius": 1.0 })).as_deref(), Some("ball"));
    }

    #[test]
    fn few_materials_with_many_keys_stand_side_by_side() {
        let body = json!([{ "thickness": 2.0, "young": 300.0, "poisson": 0.2, "hardness": 24.0 }]);
        let table = |layers: &Value| materials("The body", layers.as_array().unwrap(), &json!({ "young": 210.0 }));
        let head = |table: Markup| {
            let (head, _) = table.as_str().split_once("</thead>").expect("a head");
            head.replace('\u{a0}', " ")
        };
        let few = head(table(&body));
        assert!(few.contains("1 (layer 1)") && few.contains("2 (substrate)") && !few.contains("hardness"), "{few}");
        let many = json!(vec![body[0].clone(); 9]);
        let many = head(table(&many));
        assert!(many.contains("hardness") && !many.contains("layer 1"), "{many}");
    }

    #[test]
    fn what_bodies_bear_stands_in_words() {
        let law = json!({ "amplitude": 0.2, "passes": 1e6, "exponent": 8.0 });
        let case = json!({
            "lattice": { "kind": "square", "period": 4.0 }, "levels": [{ "radius": 1.0 }],
            "layers": [{ "thickness": 2.0, "young": 300.0, "hardness": 24.0, "interface_fatigue": law }],
            "substrate": { "young": 210.0, "wear": 1e-9 }, "counterbody": { "rigid": true, "hardness": 80.0 },
            "solver": { "tolerance": 1e-8 }, "life": { "passes": 1e7, "tolerance": 0.01 },
        });
        let page = problem(&case).as_str().replace('\u{a0}', " ");
        for words in [
            "Rigid indenters",
            "The indenters, rigid",
            "fatigue of the lower face",
            "amplitude 0.2, passes 1e6, exponent 8",
            "coefficient of wear, 1/pressure",
            "The surface of the rigid counterbody",
            ">80<",
            "life: passes",
            "life: error of a step of wear",
            "tolerance of the solver",
        ] {
            assert!(page.contains(words), "{words}: {page}");
        }
        assert!(!page.contains("from its surface inward"), "{page}");
    }

    #[test]
    fn keys_of_the_counterbody_stand_in_a_table_of_their_own() {
        let layers = json!([{ "thickness": 2.0, "young": 300.0 }]);
        let case = json!({
            "lattice": { "kind": "isolated", "size": [4.0, 3.0] }, "levels": [{ "radius": 1.0 }], "substrate": { "young": 1.0 },
            "counterbody": { "young": 210.0, "poisson": 0.3, "layers": layers }, "grid": { "points": [32, 24] },
            "stress": { "mean": "confined", "planes": [] },
        });
        let page = problem(&case).as_str().replace('\u{a0}', " ");
        let (before, counterbody) =
            page.split_once("The counterbody, from its surface inward</caption>").expect("a table");
        let (counterbody, rest) = counterbody.split_once("</table>").expect("its end");
        assert!(before.contains("The indenters, level by level"), "{before}");
        for words in ["1 (layer 1)", ">300<", "2 (substrate)", ">210<", ">0.3<"] {
            assert!(counterbody.contains(words) && !rest.contains(words), "{words}: {counterbody}\n{rest}");
        }
        for words in ["sides of the window", "4 × 3", "samples of the window", "32 × 24", "stress: planes"] {
            assert!(rest.contains(words), "{words}: {rest}");
        }
        assert!(!rest.contains("stress: mean") && !rest.contains("confined"), "{rest}");
    }
}

//! The problem of a result, and how it is solved: the keys of its case in tables.

use super::markup::{Markup, tag};
use super::table::{pairs, table};
use crate::output::number;
use crate::output::table::Table;
use serde_json::{Map, Value};

/// Names of keys in the tables; a key that is not listed is shown as in the case, underscores as blanks.
const NAMES: [(&str, &str); 19] = [
    ("a1", "cell vector a₁"),
    ("a2", "cell vector a₂"),
    ("accuracy", "prescribed accuracy"),
    ("coefficient", "coefficient"),
    ("coupling", "coupled to the pressure"),
    ("heights", "heights, a file"),
    ("interface", "lower face"),
    ("interface_strength", "strength of the lower face"),
    ("kind", "lattice"),
    ("max_iterations", "most iterations"),
    ("poisson", "Poisson’s ratio"),
    ("points", "samples of the cell"),
    ("residual_stress", "residual stress"),
    ("shear_ratio", "shear ratio χ"),
    ("sites", "sites (parts of a₁, a₂)"),
    ("tensile_strength", "tensile strength"),
    ("tolerance", "tolerance of the solver"),
    ("yield_strength", "yield strength"),
    ("young", "Young’s modulus"),
];

/// Keys of a list of which the columns come first.
const FRONT: [&str; 5] = ["name", "thickness", "shear_ratio", "young", "graded"];

/// Sections of a case that the last table leaves out: shown in tables of their own, or without effect on the result.
const APART: [&str; 6] = ["title", "levels", "layers", "substrate", "localized", "units"];

/// Counterbody and body in a sentence, then the keys of the case in tables.
pub(super) fn problem(case: &Value) -> Markup {
    let mut parts = vec![tag("p", sentence(case))];
    let list = |key: &str| case[key].as_array().map(Vec::as_slice).unwrap_or_default();
    if !list("levels").is_empty() {
        parts.push(items("The indenters, rigid, level by level", "level", list("levels"), |number| number.to_string()));
    }
    let layers = list("layers");
    let substrate = Some(case["substrate"].clone()).filter(|_| !on_rigid_base(case));
    let body: Vec<Value> = layers.iter().cloned().chain(substrate).collect();
    let name = |number: usize| {
        let own = if number > layers.len() { "substrate".to_owned() } else { format!("layer\u{a0}{number}") };
        let above: usize = layers.iter().take(number - 1).map(sublayers).sum();
        match layers.get(number - 1).map_or(1, sublayers) {
            1 => format!("{}\u{a0}({own})", above + 1),
            several => format!("{} to {} ({own})", above + 1, above + several),
        }
    };
    parts.push(items("The body, from the surface down", "material", &body, name));
    let sections = case.as_object().into_iter().flatten().filter(|(key, _)| !APART.contains(&key.as_str()));
    let rows: Vec<(String, String)> = sections.flat_map(|(section, value)| entries(section, value)).collect();
    let rows: Vec<(&str, Markup)> = rows.iter().map(|(name, text)| (name.as_str(), text.as_str().into())).collect();
    parts.push(pairs("Cell, load, grid and all other keys", &rows));
    parts.into()
}

/// Number of sublayers of a layer; 1 where it is not graded.
fn sublayers(layer: &Value) -> usize {
    layer["graded"]["sublayers"].as_u64().and_then(|count| usize::try_from(count).ok()).unwrap_or(1)
}

/// Whether the layers lie on a rigid base.
fn on_rigid_base(case: &Value) -> bool {
    case["substrate"]["rigid"].as_bool().unwrap_or(false)
}

/// Counterbody and body in a sentence.
fn sentence(case: &Value) -> String {
    let count = |key: &str| case[key].as_array().map_or(0, Vec::len);
    let kind = case["lattice"]["kind"].as_str().unwrap_or("periodic");
    let counterbody = match count("levels") {
        0 => "A rigid topography, repeated without end,".to_owned(),
        1 => format!("Rigid indenters of one height on a {kind} lattice"),
        levels => format!("Rigid indenters of {levels} levels on a {kind} lattice"),
    };
    let body = match count("layers") {
        1 if on_rigid_base(case) => "an elastic layer on a rigid base".to_owned(),
        layers if on_rigid_base(case) => format!("{layers} elastic layers on a rigid base"),
        0 => "an uncoated elastic half-space".to_owned(),
        1 => "an elastic half-space with a coating of one layer".to_owned(),
        layers => format!("an elastic half-space with a coating of {layers} layers"),
    };
    if !case["load"]["pressure"].is_null() {
        return format!("A given pressure acts on {body}.");
    }
    let slides = case["friction"]["coefficient"].as_f64();
    let slides = slides.map_or(String::new(), |mu| format!(", and slide over it with friction μ = {}", plain(mu)));
    let slides = if count("levels") == 0 { slides.replace("and slide", "and slides") } else { slides };
    let pressed = if count("levels") == 0 { "is pressed" } else { "are pressed" };
    format!("{counterbody} {pressed} into {body}{slides}.")
}

/// A list of the case as one table: a row an item, a column for every key of any item.
fn items(caption: &str, lead: &str, items: &[Value], name: impl Fn(usize) -> String) -> Markup {
    let known = |key: &str| FRONT.iter().position(|own| *own == key).unwrap_or(FRONT.len());
    let mut keys: Vec<&String> = Vec::new();
    for key in items.iter().filter_map(Value::as_object).flat_map(Map::keys) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys.sort_by_key(|key| known(key));
    let row = |(number, item): (usize, &Value)| {
        let cells = keys.iter().map(|key| item.get(key).map_or("–".to_owned(), text));
        [name(number)].into_iter().chain(cells).collect()
    };
    let head: Vec<String> = [lead.to_owned()].into_iter().chain(keys.iter().map(|key| named(key))).collect();
    table(caption, &Table::new(&head, (1..).zip(items).map(row).collect(), 1))
}

/// The keys of a section with their values.
fn entries(section: &str, value: &Value) -> Vec<(String, String)> {
    let prefix =
        |key: &str| if matches!(section, "stress" | "friction") { format!("{section}: {key}") } else { key.to_owned() };
    match value {
        Value::Object(keys) => {
            let entry = |(key, value): (&String, &Value)| match key.as_str() {
                "points" if section == "grid" => (named(key), text(value).replace(", ", " × ")),
                "points" => (prefix("single points"), text(value)),
                key => (prefix(&named(key)), text(value)),
            };
            keys.iter().map(entry).collect()
        }
        other => vec![(named(section), text(other))],
    }
}

fn named(key: &str) -> String {
    NAMES.iter().find(|(own, _)| *own == key).map_or_else(|| key.replace('_', " "), |(_, name)| (*name).to_owned())
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

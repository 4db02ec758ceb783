//! A part of the page: one result in its sections, and the sections that every result has.

use super::markup::{Markup, tag, with};
use crate::body::MeanStress;
use serde_json::Value;

/// A result on the page.
#[derive(Debug)]
pub(super) struct Part {
    /// What its anchors begin with.
    pub name: &'static str,
    /// What it is.
    pub kind: &'static str,
    /// The title of its case.
    pub title: String,
    pub sections: Vec<Section>,
}

/// A section of a part.
#[derive(Debug)]
pub(super) struct Section {
    /// What its anchor ends with.
    pub name: &'static str,
    pub heading: &'static str,
    pub content: Markup,
}

/// A section; without content it is left out.
pub(super) fn section(name: &'static str, heading: &'static str, content: Vec<Markup>) -> Section {
    Section { name, heading, content: content.into() }
}

/// The version that a result names.
pub(super) fn version(file: &Value) -> Option<&str> {
    file["percoat"].as_str()
}

/// The warnings of a result, or that there are none.
pub(super) fn warnings(file: &Value) -> Markup {
    let list: Vec<&str> = file["warnings"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    if list.is_empty() {
        return tag("p", "None.");
    }
    with("ul", &[("class", "doubt")], list.into_iter().map(|warning| tag("li", warning)).collect::<Markup>())
}

/// The case in full, with what to do with it.
pub(super) fn case_to_copy(text: &str, command: &str) -> Markup {
    let hint = format!("To compute it again, save this as case.toml and type percoat {command} case.toml.");
    let hint = if command == "sweep" {
        hint.replace("case.toml.", "case.toml with the values above after --set.")
    } else {
        hint
    };
    vec![tag("p", hint), with("pre", &[("tabindex", "0"), ("aria-label", "The case")], tag("code", text))].into()
}

/// Which version has computed it.
pub(super) fn by(file: &Value) -> Markup {
    tag(
        "p",
        version(file)
            .map_or("By a version that does not name itself.".to_owned(), |own| format!("Computed by percoat {own}.")),
    )
}

/// The mean lateral stress in the stresses of a result, as its case says; the default where it says nothing.
pub(super) fn mean_of(case: &Value) -> MeanStress {
    if case["stress"]["mean"] == "half-space" { MeanStress::HalfSpace } else { MeanStress::default() }
}

/// The title of a result's case.
pub(super) fn title(file: &Value) -> String {
    file["title"].as_str().unwrap_or_default().to_owned()
}

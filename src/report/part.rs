//! A part of the page: one result in its sections, and the sections that every result has.

use super::markup::{Markup, tag, with};
use crate::body::MeanStress;
use serde::Deserialize;
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
///
/// # Errors
/// Where they are no list of texts.
pub(super) fn warnings(file: &Value) -> Result<Markup, String> {
    let list = Vec::<String>::deserialize(&file["warnings"]).map_err(|error| format!("`warnings`: {error}"))?;
    if list.is_empty() {
        return Ok(tag("p", "None."));
    }
    let items = list.iter().map(|warning| tag("li", warning.as_str())).collect::<Markup>();
    Ok(with("ul", &[("class", "doubt")], items))
}

/// A number that a result may have; `None` where it has none.
///
/// # Errors
/// Where something else stands in its place.
pub(super) fn measured(file: &Value, key: &str) -> Result<Option<f64>, String> {
    Option::<f64>::deserialize(&file[key]).map_err(|error| format!("`{key}`: {error}"))
}

/// The case of a result as TOML.
///
/// # Errors
/// Where it is none.
pub(super) fn case_text(case: &Value) -> Result<String, String> {
    if !case.is_object() {
        return Err("`case` is missing, or no table".to_owned());
    }
    crate::case::written(case).map_err(|error| format!("`case` is no case: {error}"))
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

//! A part of the page: one result in its sections, and the sections that every result has.

use super::markup::{Markup, tag, with};
use super::problem::is_elastic;
use super::resolution::upper;
use crate::output::table::{Assumptions, library_strengths, scatter};
use percoat_case::case::kind_of;
use percoat_core::body::MeanStress;
use serde_json::Value;

/// A result on the page.
#[derive(Debug)]
pub(super) struct Part {
    /// Beginning of its anchors.
    pub name: &'static str,
    /// Kind of result, such as "Run".
    pub kind: &'static str,
    /// Title of its case.
    pub title: String,
    pub sections: Vec<Section>,
}

/// A section of a part.
#[derive(Debug)]
pub(super) struct Section {
    /// End of its anchor.
    pub name: &'static str,
    pub heading: &'static str,
    pub content: Markup,
}

/// A section; left out of the page where `content` is empty.
pub(super) fn section(name: &'static str, heading: &'static str, content: Vec<Markup>) -> Section {
    Section { name, heading, content: content.into() }
}

/// The warnings of a result, or that there are none.
pub(super) fn warnings(list: &[String]) -> Markup {
    if list.is_empty() {
        return tag("p", "None.");
    }
    let items = list.iter().map(|warning| tag("li", warning.as_str())).collect::<Markup>();
    with("ul", &[("class", "doubt")], items)
}

/// The case of a result as TOML.
///
/// # Errors
/// The reason why `case` is not a case.
pub(super) fn case_text(case: &Value) -> Result<String, String> {
    if !case.is_object() {
        return Err("`case` is missing, or no table".to_owned());
    }
    percoat_case::case::written(case).map_err(|error| format!("`case` is no case: {error}"))
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

/// The version that has computed a result, in a sentence.
pub(super) fn by(version: &str) -> Markup {
    tag("p", format!("Computed by percoat {version}."))
}

/// Assumptions of a case, with the default mean lateral stress where it gives none.
fn assumptions(case: &Value) -> Assumptions {
    let mean = match case["stress"]["mean"].as_str() {
        Some("half-space") => MeanStress::HalfSpace,
        Some("line") => MeanStress::Line,
        _ => MeanStress::default(),
    };
    let kind = kind_of(case);
    let mean = kind.surroundings.per_cell(mean);
    let rigid = !is_elastic(case) && !kind.is_given;
    Assumptions {
        mean,
        line: None,
        rigid,
        untested: untested(case),
        library: library_strengths(case),
        scatter: scatter(case),
    }
}

/// Names of the materials without a strength, an endurance limit or a law of fatigue, as the case names them.
fn untested(case: &Value) -> Vec<String> {
    let has_strength = |part: &Value| {
        ["yield_strength", "tensile_strength", "endurance", "fatigue"].iter().any(|key| !part[key].is_null())
    };
    let is_rigid = |part: &Value| part.is_null() || part["rigid"] == true;
    let name = |part: &Value, number: usize| part["name"].as_str().map_or(format!("material {number}"), str::to_owned);
    let of = |layers: &Value, deepest: &Value, side: &str| -> Vec<String> {
        let parts = layers.as_array().into_iter().flatten().chain(Some(deepest).filter(|part| !is_rigid(part)));
        let without = (1..).zip(parts).filter(|(_, part)| !has_strength(part));
        without.map(|(number, part)| name(part, number) + side).collect()
    };
    let counterbody = &case["counterbody"];
    let mut names = of(&case["layers"], &case["substrate"], "");
    names.extend(of(&counterbody["layers"], counterbody, " of the counterbody"));
    names
}

/// Assumptions of the largest stresses of a case, `with_strength` those of its strengths too, a paragraph each.
pub(super) fn assumed(case: &Value, with_strength: bool) -> Markup {
    assumptions(case).sentences(with_strength).into_iter().map(|sentence| tag("p", upper(&sentence))).collect()
}

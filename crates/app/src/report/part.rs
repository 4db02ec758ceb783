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
    /// Warnings, which the page lists in the section [`WARNINGS`].
    pub warnings: Vec<String>,
}

/// Name of the section of the warnings.
const WARNINGS: &str = "warnings";

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

/// The place of the warnings of a part among its sections.
pub(super) fn warnings() -> Section {
    section(WARNINGS, "Warnings", Vec::new())
}

/// The parts with their warnings, each once on the page.
pub(super) fn with_warnings(mut parts: Vec<Part>) -> Vec<Part> {
    let mut told: Vec<String> = Vec::new();
    for Part { sections, warnings, .. } in &mut parts {
        for section in sections.iter_mut().filter(|section| section.name == WARNINGS) {
            section.content = untold(warnings, &mut told);
        }
    }
    parts
}

/// The warnings of a result without those that were told above, or that there are none.
fn untold(warnings: &[String], told: &mut Vec<String>) -> Markup {
    let is_told_above = warnings.iter().any(|warning| told.contains(warning));
    let mut items = Vec::new();
    for warning in warnings {
        if !told.contains(warning) {
            items.push(tag("li", warning.as_str()));
            told.push(warning.clone());
        }
    }
    let list = if items.is_empty() { Markup::default() } else { with("ul", &[("class", "doubt")], items) };
    let rest = match (is_told_above, list.is_empty()) {
        (true, true) => tag("p", "None but those above."),
        (true, false) => tag("p", "Beside them some of those above."),
        (false, true) => tag("p", "None."),
        (false, false) => Markup::default(),
    };
    vec![list, rest].into()
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
        ["yield_strength", "tensile_strength", "endurance", "fatigue", "strain_life"]
            .iter()
            .any(|key| !part[key].is_null())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_warning_stands_once_on_a_page() {
        let part = |warnings: &[&str]| Part {
            name: "run",
            kind: "Run",
            title: String::new(),
            sections: vec![super::warnings()],
            warnings: warnings.iter().map(|text| (*text).to_owned()).collect(),
        };
        let parts = [&["thin", "coarse", "thin"][..], &["coarse"], &["thin", "steep"], &[]].map(part);
        let pages = with_warnings(parts.into()).into_iter().map(|part| part.sections[0].content.as_str().to_owned());
        let pages: Vec<String> = pages.collect();
        for word in ["thin", "coarse", "steep"] {
            assert_eq!(pages.concat().matches(word).count(), 1, "{pages:?}");
        }
        assert!(pages[1].contains("None but those above") && pages[3].contains("None.") && !pages[0].contains("above"));
    }
}

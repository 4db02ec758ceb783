//! `percoat materials`: the library of materials, and a file of one's own.

use super::ending::{Ending, Failure};
use super::terminal;
use percoat_app::output::table::Table;
use percoat_case::case::{
    Certainty, LibraryMaterial, MaterialsError, Property, UnknownMaterial, library, materials_of_file,
};
use std::io::Write;
use std::path::Path;

/// Lists the materials of a file, if any, and of the library; or prints the one of a name as TOML.
pub fn run(name: Option<&str>, file: Option<&Path>) -> Result<Ending, Failure> {
    let of_file = file.map(materials_of_file).transpose()?.unwrap_or_default();
    let mut out = terminal::out();
    let Some(name) = name else {
        // One of the library that the file has too is never taken.
        let others = library().iter().filter(|other| of_file.iter().all(|material| material.name != other.name));
        write!(out, "{}", listed(of_file.iter().chain(others)))?;
        return Ok(Ending::Done);
    };
    let all = || of_file.iter().chain(library());
    let unknown = || Failure::refused(UnknownMaterial::among(name, all()));
    write!(out, "{}", all().find(|material| material.is_called(name)).ok_or_else(unknown)?.to_toml())?;
    Ok(Ending::Done)
}

fn listed<'a>(materials: impl Iterator<Item = &'a LibraryMaterial>) -> String {
    let head = ["material", "Young's modulus", "Poisson", "hardness", "strength"];
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut last = None;
    for material in materials {
        // A row of its own for each kind.
        let kind = material.kind.as_deref().unwrap_or("other");
        if last.replace(kind) != Some(kind) {
            let blank = vec![String::new(); head.len()];
            rows.extend((!rows.is_empty()).then(|| blank.clone()));
            rows.push([&[kind.to_owned()], &blank[1..]].concat());
        }
        rows.push(row(material));
    }
    format!("{}\n\n{LEGEND}", Table::new(&head, rows, 1).fitted(terminal::width()))
}

const LEGEND: &str = "\
GPa; moduli with their range, ~ assumed. percoat materials NAME prints sources
and what the numbers depend on; material = \"NAME\" takes them into a case.
";

fn row(material: &LibraryMaterial) -> Vec<String> {
    let young = match material.young.range {
        Some([low, high]) => format!("{} ({low} to {high})", value(&material.young)),
        None => value(&material.young),
    };
    let strengths = [("yield", &material.yield_strength), ("tensile", &material.tensile_strength)];
    let strengths =
        strengths.iter().filter_map(|(what, strength)| Some(format!("{what} {}", value(strength.as_ref()?))));
    vec![
        format!("  {}", material.name),
        young,
        value(&material.poisson),
        material.hardness.as_ref().map_or_else(String::new, value),
        strengths.collect::<Vec<_>>().join(", "),
    ]
}

fn value(property: &Property) -> String {
    format!("{}{}", if property.certainty == Some(Certainty::Assumed) { "~" } else { "" }, property.value)
}

impl From<MaterialsError> for Failure {
    fn from(error: MaterialsError) -> Self {
        match error {
            MaterialsError::File(error) => error.into(),
            MaterialsError::Fault(error) => error.into(),
        }
    }
}

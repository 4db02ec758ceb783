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
    let own = file.map(materials_of_file).transpose()?.unwrap_or_default();
    let mut out = terminal::out();
    let Some(name) = name else {
        // One of the library that the file has too is never taken.
        let others = library().iter().filter(|other| own.iter().all(|own| own.name != other.name));
        write!(out, "{}", listed(own.iter().chain(others)))?;
        return Ok(Ending::Done);
    };
    let all = || own.iter().chain(library());
    let unknown = || Failure::refused(UnknownMaterial::among(name, all()));
    write!(out, "{}", all().find(|own| own.name == name).ok_or_else(unknown)?.to_toml())?;
    Ok(Ending::Done)
}

fn listed<'a>(materials: impl Iterator<Item = &'a LibraryMaterial>) -> String {
    let head = ["material", "Young's modulus", "Poisson", "hardness", "strength"];
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut last = None;
    for own in materials {
        // A row of its own for each kind.
        let kind = own.kind.as_deref().unwrap_or("other");
        if last.replace(kind) != Some(kind) {
            let blank = vec![String::new(); head.len()];
            rows.extend((!rows.is_empty()).then(|| blank.clone()));
            rows.push([&[kind.to_owned()], &blank[1..]].concat());
        }
        rows.push(row(own));
    }
    format!("{}\n\n{LEGEND}", Table::new(&head, rows, 1).fitted(terminal::width()))
}

const LEGEND: &str = "\
GPa; moduli with their range, ~ assumed. percoat materials NAME prints sources
and what the numbers depend on; material = \"NAME\" takes them into a case.
";

fn row(own: &LibraryMaterial) -> Vec<String> {
    let young = match own.young.range {
        Some([low, high]) => format!("{} ({low} to {high})", value(&own.young)),
        None => value(&own.young),
    };
    let strengths = [("yield", &own.yield_strength), ("tensile", &own.tensile_strength)];
    let strengths = strengths.iter().filter_map(|(what, own)| Some(format!("{what} {}", value(own.as_ref()?))));
    vec![
        format!("  {}", own.name),
        young,
        value(&own.poisson),
        own.hardness.as_ref().map_or_else(String::new, value),
        strengths.collect::<Vec<_>>().join(", "),
    ]
}

fn value(own: &Property) -> String {
    format!("{}{}", if own.certainty == Some(Certainty::Assumed) { "~" } else { "" }, own.value)
}

impl From<MaterialsError> for Failure {
    fn from(error: MaterialsError) -> Self {
        match error {
            MaterialsError::File(error) => error.into(),
            MaterialsError::Fault(error) => error.into(),
        }
    }
}

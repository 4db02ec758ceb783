//! `percoat cases`: the embedded example cases.

use super::ending::{Ending, Failure};
use super::terminal;
use percoat_case::case::{Case, embedded};
use std::io::Write;

pub fn run(name: Option<&str>, set: &[String]) -> Result<Ending, Failure> {
    let mut out = terminal::out();
    match name {
        Some(name) => {
            let Some(source) = embedded::source(name) else {
                let names = embedded::all().iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
                return Err(Failure::Refused(format!("there is no embedded case {name}; there are {names}")));
            };
            if set.is_empty() {
                write!(out, "{}", source.text)?;
            } else {
                let case = Case::read(&source, set)?;
                write!(out, "# {name} with {}\n\n{}", set.join(", ").replace('\n', " "), case.to_toml())?;
            }
        }
        None if !set.is_empty() => {
            return Err(Failure::refused("--set changes a case: say which one, as in percoat cases fig2 --set …"));
        }
        None => {
            for (name, _) in embedded::all() {
                let title = embedded::source(name).and_then(|source| Case::read(&source, &[]).ok());
                let title = title.map_or(String::new(), |case| case.title);
                let default = if *name == embedded::DEFAULT { " (default)" } else { "" };
                writeln!(out, "{name:<14} {title}{default}")?;
            }
        }
    }
    Ok(Ending::Done)
}

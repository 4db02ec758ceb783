//! `percoat cases`: the embedded example cases.

use super::ending::{Ending, Failure};
use super::terminal;
use percoat::case::{Case, embedded};
use std::io::Write;

pub fn run(name: Option<&str>, set: &[String]) -> Result<Ending, Failure> {
    let mut out = terminal::out();
    match name {
        Some(name) => {
            let Some(text) = embedded::find(name) else {
                let names: Vec<&str> = embedded::all().iter().map(|(name, _)| *name).collect();
                return Err(Failure::Refused(format!(
                    "there is no embedded case {name}; there are {}",
                    names.join(", ")
                )));
            };
            match (embedded::source(name), set) {
                (Some(source), [_, ..]) => {
                    let case = Case::read(&source, set).map_err(|error| Failure::Case(Box::new(error)))?;
                    write!(out, "# {name} with {}\n\n{}", set.join(", ").replace('\n', " "), case.to_toml())?;
                }
                _ => write!(out, "{text}")?,
            }
        }
        None if !set.is_empty() => {
            return Err(Failure::Refused(
                "--set changes a case: say which one, as in percoat cases fig2 --set …".to_owned(),
            ));
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

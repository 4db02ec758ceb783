//! `percoat completions` and `percoat man`: for the shell and for the reader of manuals.

use super::arguments::Arguments;
use super::ending::{Ending, Failure};
use super::terminal;
use clap::CommandFactory;
use clap_complete::Shell;
use std::io::Write;

/// Completions for a shell.
pub fn completions(shell: Shell) -> Result<Ending, Failure> {
    // A generator writes to what cannot fail.
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "percoat", &mut text);
    terminal::out().write_all(&text)?;
    Ok(Ending::Done)
}

/// The page of percoat, or of one of its commands.
pub fn page(name: Option<&str>) -> Result<Ending, Failure> {
    let mut percoat = Arguments::command();
    percoat.build();
    let command = match name {
        None => percoat,
        Some(name) => {
            let found = percoat.find_subcommand(name).cloned();
            let names: Vec<&str> = percoat.get_subcommands().map(clap::Command::get_name).collect();
            found.ok_or_else(|| {
                Failure::refused(format!("there is no command {name}; there are {}", names.join(", ")))
            })?
        }
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text)?;
    terminal::out().write_all(&text)?;
    Ok(Ending::Done)
}

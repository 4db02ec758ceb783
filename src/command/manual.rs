//! `percoat completions` and `percoat man`: completions for a shell, and manual pages.

use super::arguments::Arguments;
use super::ending::{Ending, Failure};
use super::terminal;
use clap::CommandFactory;
use clap_complete::Shell;
use std::io::Write;

/// Prints the completions for a shell.
pub fn completions(shell: Shell) -> Result<Ending, Failure> {
    // The generator panics where writing fails: memory does not fail.
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "percoat", &mut text);
    terminal::out().write_all(&text)?;
    Ok(Ending::Done)
}

/// Prints the manual page of percoat, or of one of its commands.
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

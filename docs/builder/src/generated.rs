//! The parts of pages that the program itself writes: lines `<!-- percoat: … -->`.

use crate::run::Tools;
use anyhow::{Result, bail};
use std::fmt::Write;

/// The page with its generated parts.
pub fn filled(text: &str, tools: &Tools) -> Result<String> {
    let mut filled = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let name = line.trim().strip_prefix("<!-- percoat: ").and_then(|rest| rest.strip_suffix(" -->"));
        match name {
            None => filled += line,
            Some("keys") => filled += &tools.printed("percoat explain --markdown")?,
            Some("cases") => filled += &cases(tools)?,
            Some("exit codes") => filled += &exit_codes(tools)?,
            Some("commands") => filled += &commands(tools)?,
            Some(other) => bail!("nothing is generated under the name {other}"),
        }
    }
    Ok(filled)
}

/// The embedded cases with their titles, as a list.
fn cases(tools: &Tools) -> Result<String> {
    Ok(format!("```text\n{}```\n", tools.printed("percoat cases")?))
}

/// The exit codes, a row each, from the end of the help.
fn exit_codes(tools: &Tools) -> Result<String> {
    let help = tools.printed("percoat --help")?;
    let Some((_, codes)) = help.split_once("Exit codes: ") else { bail!("percoat --help lists no exit codes") };
    let codes = codes.split_whitespace().collect::<Vec<_>>().join(" ");
    let row = |code: &str| {
        let (number, means) = code.trim().split_once(' ').unwrap_or((code, ""));
        format!("| {number} | {means} |\n")
    };
    Ok(format!("| code | means |\n|---|---|\n{}", codes.split(';').map(row).collect::<String>()))
}

/// The help of each command under its name.
fn commands(tools: &Tools) -> Result<String> {
    let help = |command: &str| tools.printed(&format!("percoat {command} --help"));
    let whole = help("")?;
    let list = whole.split_once("Commands:\n").map_or("", |(_, rest)| rest);
    let names = list.lines().take_while(|line| !line.trim().is_empty()).filter_map(|line| {
        // A line that begins further right goes on with the one above.
        let entry = line.strip_prefix("  ")?;
        entry.split_whitespace().next().filter(|_| !entry.starts_with(' '))
    });
    let mut text = String::new();
    for name in names.filter(|name| *name != "help") {
        write!(text, "## `percoat {name}`\n\n```text\n{}```\n\n", help(name)?)?;
    }
    if text.is_empty() {
        bail!("percoat --help lists no commands");
    }
    Ok(text)
}

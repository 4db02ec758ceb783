//! The parts of pages that the program itself writes, between `<!-- percoat: … -->` and `<!-- end of … -->`; sources have them as they
//! were written last, so that they are whole where nothing is built.

use crate::run::{Difference, Tools};
use anyhow::{Result, bail};
use std::fmt::Write;

/// The page with its generated parts renewed, and where they differ from what it has.
pub fn renewed(text: &str, tools: &Tools) -> Result<(String, Vec<Difference>)> {
    let (mut renewed, mut differences) = (String::with_capacity(text.len()), Vec::new());
    let mut lines = text.split_inclusive('\n');
    while let Some(line) = lines.next() {
        renewed += line;
        let Some(name) = line.trim().strip_prefix("<!-- percoat: ").and_then(|rest| rest.strip_suffix(" -->")) else {
            continue;
        };
        let end = format!("<!-- end of {name} -->");
        let (mut shown, mut is_closed) = (String::new(), false);
        for inside in lines.by_ref() {
            is_closed = inside.trim() == end;
            if is_closed {
                break;
            }
            shown += inside;
        }
        if !is_closed {
            bail!("a part is not closed: write {end} behind {}", line.trim());
        }
        // Empty lines keep Markdown from reading the comments as a part of what is between them.
        let found = format!("\n{}\n", written(name, tools)?.trim_end_matches('\n')) + "\n";
        differences.extend(tools.take(name, &mut shown, found));
        renewed += &format!("{shown}{end}\n");
    }
    Ok((renewed, differences))
}

/// A part by its name.
fn written(name: &str, tools: &Tools) -> Result<String> {
    match name {
        "keys" => tools.printed("percoat explain --markdown"),
        "cases" => cases(tools),
        "exit codes" => exit_codes(tools),
        "commands" => commands(tools),
        other => bail!("nothing is generated under the name {other}"),
    }
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

//! Messages on options of other commands, instead of "unexpected argument".

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Options that only some commands have, and the reason why the others, or the named one, have none.
const OPTIONS: [(&[&str], &str, &str); 6] = [
    (&["-o", "--output"], "", "it writes no files"),
    (&["--set"], "", "it reads no case"),
    (&["--threads"], "", "it computes next to nothing"),
    (&["-q", "--quiet", "-v", "--verbose"], "", "what it prints is all it does"),
    (&["--pictures", "--no-pictures"], "validate", "its pictures are fixed"),
    (&["--pictures", "--no-pictures"], "", "it draws none"),
];

/// Message on an option of another command; `None` for any other error. `typed` is the command line of `percoat`.
pub fn explained(error: &clap::Error, typed: &[String], percoat: &clap::Command) -> Option<String> {
    let (ErrorKind::UnknownArgument, Some(ContextValue::String(option))) =
        (error.kind(), error.get(ContextKind::InvalidArg))
    else {
        return None;
    };
    let at = typed.iter().position(|word| percoat.find_subcommand(word).is_some())?;
    let command = &typed[at];
    let applies = |names: &[&str], of: &str| names.contains(&option.as_str()) && (of.is_empty() || of == command);
    let (_, _, why) = OPTIONS.iter().find(|(names, of, _)| applies(names, of))?;
    if typed[..at].iter().any(|word| word.starts_with(option.as_str())) {
        return Some(format!("{option} stands before the command; write it behind: percoat {command} {option} …"));
    }
    Some(format!("{option} has no effect in `percoat {command}`: {why}; leave it out"))
}

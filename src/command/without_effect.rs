//! Options that one command has and another has no use for: said so, instead of "unexpected argument".

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Options that only some commands have, and why the others do without them.
const OPTIONS: [(&[&str], &str); 5] = [
    (&["-o", "--output"], "it writes no files"),
    (&["--set"], "it reads no case"),
    (&["--threads"], "it computes next to nothing"),
    (&["-q", "--quiet", "-v", "--verbose"], "what it prints is all it does"),
    (&["--pictures", "--no-pictures"], "it draws none"),
];

const COMMANDS: [&str; 6] = ["solve", "compare", "kernel", "check", "cases", "validate"];

/// What is wrong with an option of another command; `None` for every other fault. `typed` is the command line.
pub fn explained(error: &clap::Error, typed: &[String]) -> Option<String> {
    let (ErrorKind::UnknownArgument, Some(ContextValue::String(option))) =
        (error.kind(), error.get(ContextKind::InvalidArg))
    else {
        return None;
    };
    let (_, why) = OPTIONS.iter().find(|(names, _)| names.contains(&option.as_str()))?;
    let at = typed.iter().position(|word| COMMANDS.contains(&word.as_str()))?;
    let command = &typed[at];
    if typed[..at].iter().any(|word| word.starts_with(option.as_str())) {
        return Some(format!("{option} stands before the command; write it behind: percoat {command} {option} …"));
    }
    Some(format!("{option} has no effect in `percoat {command}`: {why}; leave it out"))
}

//! The commands of the program.

mod arguments;
mod cases;
mod check;
mod compare;
mod declared;
mod ending;
mod explain;
mod help;
mod identify;
mod input;
mod interruption;
mod kernel;
mod life;
mod limit;
mod manual;
mod materials;
mod merge;
mod options;
mod pictures;
mod progress;
mod progress_recorder;
mod report;
mod results;
mod roughness;
mod solve;
mod solved_pictures;
mod sweep;
mod sweep_files;
mod terminal;
mod threads;
#[cfg(feature = "validate")]
mod validate;
mod without_effect;

use arguments::{Arguments, Command};
use ending::{Ending, Failure};
use percoat_case::measurements::Segment;
use std::ffi::OsString;
use std::io::Write;

/// The program: reads the command line `typed`, its own name first, runs the command, and returns the exit code.
pub fn main(typed: impl IntoIterator<Item = OsString>) -> u8 {
    let typed: Vec<OsString> = typed.into_iter().collect();
    threads::on_own_stack(move || Arguments::read(&typed).map_or_else(|code| code, |arguments| run(&arguments)))
}

fn run(arguments: &Arguments) -> u8 {
    interruption::outlive_large_files();
    let ended = arguments.computes().map_or(Ok(()), |(count, quiet)| threads::start(count, quiet));
    let ended = ended.and_then(|()| carry_out(&arguments.command));
    // The rest of the buffer may not fit on the disk.
    let ended = ended.and_then(|ending| Ok(terminal::out().flush().map(|()| ending)?));
    match ended {
        Ok(ending) => ending.code(),
        Err(failure) => {
            failure.tell();
            interruption::tell_saved();
            failure.code()
        }
    }
}

fn carry_out(command: &Command) -> Result<Ending, Failure> {
    match command {
        Command::Solve { case, changes, options, common } => {
            solve::run(case.as_deref(), changes.once()?, options, common)
        }
        Command::Compare { case, changes, common } => compare::run(case.as_deref(), changes.once()?, common),
        Command::Limit { case, up_to, changes, common } => {
            limit::run(case.as_deref(), up_to.as_deref(), changes.once()?, common)
        }
        Command::Life { case, changes, options, common } => {
            life::run(case.as_deref(), changes.once()?, options, common)
        }
        Command::Identify { files, free, known, segment, part, changes, common } => {
            let segment = Segment::of(segment.as_deref(), part.as_deref()).map_err(Failure::refused)?;
            identify::run(files, (free, known), segment, (changes.once()?, common))
        }
        Command::Sweep { case, set, options, common } => sweep::run(case, set, options, common),
        Command::Merge { folders, output, pictures, saying } => {
            merge::run(folders, output.as_deref(), pictures, *saying)
        }
        Command::Report { folder, output, quiet } => report::run(folder, output.as_deref(), *quiet),
        Command::Kernel { case, wavenumber, depth, traction, changes } => {
            kernel::run(case.as_deref(), wavenumber, depth, *traction, changes.once()?)
        }
        Command::Check { case, output, changes, .. } => check::run(case, output.as_deref(), changes.once()?),
        Command::Cases { name, changes } => cases::run(name.as_deref(), changes.once()?),
        Command::Materials { name, file } => materials::run(name.as_deref(), file.as_deref()),
        Command::Explain { schema: true, .. } => explain::schema(),
        Command::Explain { markdown: true, .. } => explain::table(),
        Command::Explain { key, .. } => explain::run(key.as_deref()),
        #[cfg(feature = "validate")]
        Command::Validate { list: true, study, .. } => validate::list(study.as_deref()),
        #[cfg(feature = "validate")]
        Command::Validate { study, expect, studies, .. } => validate::run(study.as_deref(), expect.as_deref(), studies),
        Command::Completions { shell } => manual::completions(*shell),
        Command::Man { command } => manual::page(command.as_deref()),
    }
}

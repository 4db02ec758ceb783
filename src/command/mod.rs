//! Commands: what the user types, and how it ends.

mod allowed;
mod arguments;
mod cases;
mod check;
mod compare;
mod ending;
mod input;
mod interruption;
mod kernel;
mod limit;
mod options;
mod pictures;
mod plan;
mod roughness;
mod shown;
mod solve;
mod terminal;
#[cfg(feature = "validate")]
mod validate;
mod without_effect;

pub use arguments::Arguments;

use arguments::Command;
use std::process::ExitCode;
use terminal::tell;

/// Runs the command.
pub fn run(arguments: &Arguments) -> ExitCode {
    if let Some(threads) = arguments.threads()
        && let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global()
    {
        tell!("error: cannot start {threads} threads: {error}");
        return ExitCode::from(4);
    }
    let ending = match &arguments.command {
        Command::Solve { case, pictures, common } => solve::run(case.as_deref(), pictures, common),
        Command::Compare { case, pictures, common } => compare::run(case.as_deref(), pictures, common),
        Command::Limit { case, pictures, common } => limit::run(case.as_deref(), pictures, common),
        Command::Kernel { case, wavenumber, depth, traction, changes } => {
            kernel::run(case.as_deref(), wavenumber, depth, *traction, &changes.set)
        }
        Command::Check { case, output, changes, .. } => check::run(case, output.as_deref(), &changes.set),
        Command::Cases { name, changes } => cases::run(name.as_deref(), &changes.set),
        #[cfg(feature = "validate")]
        Command::Validate { study, expect, studies, .. } => validate::run(study.as_deref(), expect.as_deref(), studies),
    };
    ExitCode::from(match ending {
        Ok(ending) => ending.code(),
        Err(failure) => {
            failure.tell();
            interruption::tell_saved();
            failure.code()
        }
    })
}

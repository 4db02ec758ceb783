//! Commands: what the user types, and how it ends.

mod cases;
mod check;
mod compare;
mod interruption;
mod kernel;
mod pictures;
mod plan;
mod solve;
mod terminal;
#[cfg(feature = "validate")]
mod validate;
mod without_effect;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use percoat::case::{CARRIED, Case, CaseError, Source, embedded};
use percoat::output::{FolderError, OutputError};
use percoat::run::RunError;
use pictures::PictureOptions;
use std::convert::Infallible;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use terminal::tell;

/// Periodic contact of coated bodies: pressures, contact spots and penetrations of a doubly periodic
/// system of rigid asperities at several heights on a layered elastic half-space.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve every load step of a case (without CASE: the embedded default, Fig. 2 of the paper)
    Solve {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        #[command(flatten)]
        pictures: PictureOptions,
        #[command(flatten)]
        common: Common,
    },
    /// Solve a case by both methods, spectral and localized, and show their differences (the last load step)
    Compare {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        #[command(flatten)]
        pictures: PictureOptions,
        #[command(flatten)]
        common: Common,
    },
    /// Response of the layered half-space to a harmonic pressure cos(qx), as JSON lines
    Kernel {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        /// Wavenumbers q > 0, 1/length
        #[arg(long, value_delimiter = ',', required = true, value_name = "Q,…", value_parser = wavenumber)]
        wavenumber: Vec<f64>,
        /// Depths z ≥ 0 at which stresses and displacements are wanted
        #[arg(long, value_delimiter = ',', value_name = "Z,…", value_parser = depth)]
        depth: Vec<f64>,
        #[command(flatten)]
        changes: Changes,
    },
    /// Say what a case means: cell, grid, materials, memory, first touch loads; solves nothing at full size
    Check {
        /// Case file, or the name of an embedded case
        case: PathBuf,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        work: Work,
    },
    /// List the embedded example cases, or print one; changed by --set it is complete with its defaults
    Cases {
        /// Name of the case to print
        name: Option<String>,
        #[command(flatten)]
        changes: Changes,
    },
    #[cfg(feature = "validate")]
    /// Hold percoat against closed forms, references and peers; exit code 1 when a check fails
    Validate {
        /// Name of one study, or of a folder of them (`paper`) [default: all of them]
        study: Option<String>,
        /// An earlier REPORT.md: fail unless studies, quantities and verdicts are the same
        #[arg(long, value_name = "REPORT")]
        expect: Option<PathBuf>,
        #[command(flatten)]
        studies: Studies,
        #[command(flatten)]
        work: Work,
    },
}

/// Options of the commands that solve a case into a folder.
#[derive(Debug, Args)]
struct Common {
    /// Output folder [default: out/<case name>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Change a value of the case, as in layers.0.thickness=0.2 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Say more on the way
    #[arg(short, long)]
    verbose: bool,
}

impl Common {
    /// Whether progress is drawn.
    fn shows_progress(&self) -> bool {
        !self.quiet && !self.verbose && terminal::moves()
    }
}

/// Overrides of a case.
#[derive(Debug, Args)]
struct Changes {
    /// Change a value of the case, as in layers.0.thickness=0.2 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

/// Where the studies of a validation go, and how they are told of.
#[cfg(feature = "validate")]
#[derive(Debug, Args)]
struct Studies {
    /// Output folder [default: out/validate]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Say more on the way
    #[arg(short, long)]
    verbose: bool,
}

/// How much of the machine is used.
#[derive(Debug, Args)]
struct Work {
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
enum Failure {
    /// The case is refused.
    #[error("{}", .0.render(terminal::coloured()).trim_end())]
    Case(Box<CaseError>),
    /// The command line, or what it asks for, is refused.
    #[error("{0}")]
    Refused(String),
    /// A file cannot be read.
    #[error("cannot read {}: {error}", path.display())]
    Input { path: PathBuf, error: std::io::Error },
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Standard output cannot be written.
    #[error("cannot write standard output: {0}")]
    Print(#[from] std::io::Error),
}

impl From<FolderError> for Failure {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::Output(error) => Self::Output(error),
            refused => Self::Refused(refused.to_string()),
        }
    }
}

impl<E: std::error::Error + Into<Failure> + 'static> From<RunError<E>> for Failure {
    fn from(error: RunError<E>) -> Self {
        match error {
            RunError::Recorder(error) => error.into(),
            refused => Self::Refused(refused.to_string()),
        }
    }
}

impl From<Infallible> for Failure {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

/// How a command that did its work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Done,
    /// A check of the validation fails.
    #[cfg(feature = "validate")]
    Failed,
    /// Everything computed is written and marked.
    NotConverged,
}

impl Arguments {
    /// The command line as typed; what cannot be read is told, with the exit code that goes with it.
    pub fn read() -> Result<Self, ExitCode> {
        let command = Self::command().color(terminal::parser_colour());
        let read = command.try_get_matches().and_then(|matches| Self::from_arg_matches(&matches));
        read.map_err(|error| {
            let typed: Vec<String> =
                std::env::args_os().skip(1).map(|arg| arg.to_string_lossy().into_owned()).collect();
            match without_effect::explained(&error, &typed) {
                Some(message) => tell!("error: {message}"),
                // Help that nobody reads is no fault.
                None => drop(error.print()),
            }
            ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
        })
    }

    fn threads(&self) -> Option<u16> {
        match &self.command {
            Command::Solve { common, .. } | Command::Compare { common, .. } => common.threads,
            Command::Check { work, .. } => work.threads,
            #[cfg(feature = "validate")]
            Command::Validate { work, .. } => work.threads,
            Command::Kernel { .. } | Command::Cases { .. } => None,
        }
    }
}

/// Runs the command; the exit codes are 0 done, 1 a validation failed, 2 refused, 3 not converged, 4 input or output
/// failed, 130 interrupted.
pub fn run(arguments: &Arguments) -> ExitCode {
    if let Some(threads) = arguments.threads()
        && let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global()
    {
        tell!("error: cannot start {threads} threads: {error}");
        return ExitCode::from(4);
    }
    let outcome = match &arguments.command {
        Command::Solve { case, pictures, common } => solve::run(case.as_deref(), pictures, common),
        Command::Compare { case, pictures, common } => compare::run(case.as_deref(), pictures, common),
        Command::Kernel { case, wavenumber, depth, changes } => {
            kernel::run(case.as_deref(), wavenumber, depth, &changes.set)
        }
        Command::Check { case, changes, .. } => check::run(case, &changes.set),
        Command::Cases { name, changes } => cases::run(name.as_deref(), &changes.set),
        #[cfg(feature = "validate")]
        Command::Validate { study, expect, studies, .. } => validate::run(study.as_deref(), expect.as_deref(), studies),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        #[cfg(feature = "validate")]
        Ok(Outcome::Failed) => ExitCode::FAILURE,
        Ok(Outcome::NotConverged) => ExitCode::from(3),
        // Whoever reads standard output may stop reading; that is no fault.
        Err(Failure::Print(error)) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            match &failure {
                Failure::Case(_) => tell!("{failure}"),
                _ => tell!("error: {failure}"),
            }
            interruption::tell_saved();
            ExitCode::from(match failure {
                Failure::Case(_) | Failure::Refused(_) => 2,
                Failure::Input { .. } | Failure::Output(_) | Failure::Print(_) => 4,
            })
        }
    }
}

/// The case a command works on, and its name: a file, an embedded case by its name, or the default.
fn read_case(case: Option<&Path>, common: &Common) -> Result<(Case, String), Failure> {
    read_changed(case, &common.set)
}

/// The same with the overrides `set`.
fn read_changed(case: Option<&Path>, set: &[String]) -> Result<(Case, String), Failure> {
    let path = case.unwrap_or(Path::new(embedded::DEFAULT));
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let embedded = path.to_str().filter(|_| case.is_none() || !path.is_file()).and_then(embedded::source);
    let source = match embedded {
        Some(source) => source,
        None if path.extension().is_none() && !path.is_file() => {
            let names: Vec<&str> = embedded::all().iter().map(|(name, _)| *name).collect();
            return Err(Failure::Refused(format!(
                "{} is neither a file nor an embedded case ({})",
                path.display(),
                names.join(", ")
            )));
        }
        None => Source::file(path).map_err(|error| match error.kind() {
            // It can be read, but is no case.
            ErrorKind::InvalidData => Failure::Refused(error.to_string()),
            _ => Failure::Input { path: path.to_owned(), error },
        })?,
    };
    let case = Case::read(&source, set).map_err(|error| Failure::Case(Box::new(error)))?;
    Ok((case, name))
}

/// A wavenumber that double precision carries through the products made of it.
fn wavenumber(text: &str) -> Result<f64, String> {
    number(text, |x| CARRIED.contains(&x), "a number greater than 0, between 1e-60 and 1e60")
}

fn depth(text: &str) -> Result<f64, String> {
    number(text, |x| x == 0.0 || CARRIED.contains(&x), "a number not less than 0, at most 1e60")
}

fn number(text: &str, allowed: impl Fn(f64) -> bool, wanted: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(x) if x.is_finite() && allowed(x) => Ok(x),
        _ => Err(format!("must be {wanted}")),
    }
}

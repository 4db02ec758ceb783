//! Commands: what the user types, and how it ends.

mod cases;
mod check;
mod compare;
mod interruption;
mod kernel;
mod pictures;
mod plan;
mod solve;
mod stress;
mod validate;

use clap::{Args, Parser, Subcommand};
use percoat::case::{Case, CaseError, Source, embedded};
use percoat::output::{FolderError, OutputError};
use pictures::PictureOptions;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Periodic contact of coated bodies: pressures, contact spots and penetrations of a doubly periodic
/// system of rigid asperities at several heights on a layered elastic half-space.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve every load step of a case (without CASE: the embedded default, Fig. 2 of the paper)
    Solve {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        #[command(flatten)]
        pictures: PictureOptions,
    },
    /// Solve a case by both methods, spectral and localized, and show their differences (the last load step)
    Compare {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        #[command(flatten)]
        pictures: PictureOptions,
    },
    /// Response of the layered half-space to a harmonic pressure cos(qx), as JSON lines
    Kernel {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        /// Wavenumbers q > 0, 1/length
        #[arg(long, value_delimiter = ',', required = true, value_name = "Q,…", value_parser = positive)]
        wavenumber: Vec<f64>,
        /// Depths z ≥ 0 at which stresses and displacements are wanted
        #[arg(long, value_delimiter = ',', value_name = "Z,…", value_parser = not_negative)]
        depth: Vec<f64>,
    },
    /// Say what a case means: cell, grid, materials, memory, first touch loads; solves nothing at full size
    Check {
        /// Case file, or the name of an embedded case
        case: PathBuf,
    },
    /// List the embedded example cases, or print one
    Cases {
        /// Name of the case to print
        name: Option<String>,
    },
    /// Hold percoat against closed forms, references and peers; exit code 1 when a check fails
    Validate {
        /// Name of one study, or of a folder of them (`paper`) [default: all of them]
        study: Option<String>,
        /// An earlier REPORT.md: fail unless studies, quantities and verdicts are the same
        #[arg(long, value_name = "REPORT")]
        expect: Option<PathBuf>,
    },
}

#[derive(Debug, Args)]
struct Common {
    /// Output folder [default: out/<case name>]
    #[arg(short, long, global = true, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Change a value of the case, as in layers.0.thickness=0.2 (repeatable)
    #[arg(long, global = true, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say more on the way
    #[arg(short, long, global = true)]
    verbose: bool,
}

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
enum Failure {
    /// The case is refused.
    #[error("{}", .0.render(std::io::stderr().is_terminal()).trim_end())]
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

/// How a command that did its work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Done,
    /// A check of the validation fails.
    Failed,
    /// Everything computed is written and marked.
    NotConverged,
}

/// Runs the command; the exit codes are 0 done, 1 a validation failed, 2 refused, 3 not converged, 4 input or output
/// failed, 130 interrupted.
pub fn run(arguments: &Arguments) -> ExitCode {
    let common = &arguments.common;
    if let Some(threads) = common.threads
        && let Err(error) = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global()
    {
        eprintln!("error: cannot start {threads} threads: {error}");
        return ExitCode::from(4);
    }
    let outcome = match &arguments.command {
        Command::Solve { case, pictures } => solve::run(case.as_deref(), pictures, common),
        Command::Compare { case, pictures } => compare::run(case.as_deref(), pictures, common),
        Command::Kernel { case, wavenumber, depth } => kernel::run(case.as_deref(), wavenumber, depth, common),
        Command::Check { case } => check::run(case, common),
        Command::Cases { name } => cases::run(name.as_deref()),
        Command::Validate { study, expect } => validate::run(study.as_deref(), expect.as_deref(), common),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Failed) => ExitCode::FAILURE,
        Ok(Outcome::NotConverged) => ExitCode::from(3),
        // Whoever reads standard output may stop reading; that is no fault.
        Err(Failure::Print(error)) if error.kind() == std::io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            match &failure {
                Failure::Case(_) => eprintln!("{failure}"),
                _ => eprintln!("error: {failure}"),
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
        None => Source::file(path).map_err(|error| Failure::Input { path: path.to_owned(), error })?,
    };
    let case = Case::read(&source, &common.set).map_err(|error| Failure::Case(Box::new(error)))?;
    Ok((case, name))
}

fn positive(text: &str) -> Result<f64, String> {
    number(text, |x| x > 0.0, "a number greater than 0")
}

fn not_negative(text: &str) -> Result<f64, String> {
    number(text, |x| x >= 0.0, "a number not less than 0")
}

fn number(text: &str, allowed: impl Fn(f64) -> bool, wanted: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(x) if x.is_finite() && allowed(x) => Ok(x),
        _ => Err(format!("must be {wanted}")),
    }
}

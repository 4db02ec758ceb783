//! The command line as it is typed.

#[cfg(feature = "validate")]
use super::options::Studies;
use super::options::{Changes, Common, Work};
use super::pictures::PictureOptions;
use super::terminal::{self, tell};
use super::without_effect;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use percoat::case::CARRIED;
use std::path::PathBuf;
use std::process::ExitCode;

/// Periodic contact of coated bodies: pressures, contact spots and penetrations of a doubly periodic
/// system of rigid asperities at several heights on a layered elastic half-space.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

/// What is to be done.
#[derive(Debug, Subcommand)]
pub enum Command {
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
    /// Find the mean pressure at which something first fails, and what (without CASE: a DLC coating on steel)
    Limit {
        /// Case file with strengths, or the name of an embedded case
        case: Option<PathBuf>,
        #[command(flatten)]
        pictures: PictureOptions,
        #[command(flatten)]
        common: Common,
    },
    /// Response of the layered half-space to a harmonic pressure or shear traction cos(qx), as JSON lines
    Kernel {
        /// Case file, or the name of an embedded case
        case: Option<PathBuf>,
        /// Wavenumbers q > 0, 1/length
        #[arg(long, value_delimiter = ',', required = true, value_name = "Q,…", value_parser = wavenumber)]
        wavenumber: Vec<f64>,
        /// Depths z ≥ 0 at which stresses and displacements are wanted
        #[arg(long, value_delimiter = ',', value_name = "Z,…", value_parser = depth)]
        depth: Vec<f64>,
        /// What acts on the surface: a pressure, or a shear traction along or across the wavevector
        #[arg(long, value_enum, default_value_t, value_name = "TRACTION")]
        traction: Traction,
        #[command(flatten)]
        changes: Changes,
    },
    /// Say what a case means: cell, grid, materials, memory, first touch loads; solves no load step
    Check {
        /// Case file, or the name of an embedded case
        case: PathBuf,
        /// Folder for the power spectrum of a surface, as picture and table [default: none is written]
        #[arg(short, long, value_name = "DIR")]
        output: Option<PathBuf>,
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

/// What acts on the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Traction {
    /// A pressure
    #[default]
    Normal,
    /// A shear traction along the wavevector
    Along,
    /// A shear traction across the wavevector
    Across,
}

impl Arguments {
    /// The command line as typed; what cannot be read is told, with the exit code that goes with it.
    pub fn read() -> Result<Self, ExitCode> {
        let command = Self::command().color(terminal::parser_colour());
        let read = command.try_get_matches().and_then(|matches| Self::from_arg_matches(&matches));
        read.map_err(|error| {
            let typed: Vec<String> =
                std::env::args_os().skip(1).map(|arg| arg.to_string_lossy().into_owned()).collect();
            match without_effect::explained(&error, &typed, &Self::command()) {
                Some(message) => tell!("error: {message}"),
                // Help that nobody reads is no fault.
                None => drop(error.print()),
            }
            ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
        })
    }

    /// Threads asked for.
    pub fn threads(&self) -> Option<u16> {
        match &self.command {
            Command::Solve { common, .. } | Command::Compare { common, .. } | Command::Limit { common, .. } => {
                common.threads
            }
            Command::Check { work, .. } => work.threads,
            #[cfg(feature = "validate")]
            Command::Validate { work, .. } => work.threads,
            Command::Kernel { .. } | Command::Cases { .. } => None,
        }
    }
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
        Ok(x) if allowed(x) => Ok(x),
        _ => Err(format!("must be {wanted}")),
    }
}

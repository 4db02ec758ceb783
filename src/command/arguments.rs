//! The command line: commands, arguments and options.

use super::ending::Failure;
use super::help;
use super::life::LifeOptions;
#[cfg(feature = "validate")]
use super::options::Studies;
use super::options::{Changes, Common, Saying, Work};
use super::pictures::PictureOptions;
use super::solve::SolveOptions;
use super::sweep::SweepOptions;
use super::terminal::{self, Colour, tell};
use super::without_effect;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use percoat_app::output::Traction;
use percoat_case::units::CARRIED;
use percoat_common::plain;
use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

/// Contact of coated bodies: pressures, contact spots, penetration and stresses under a ball, asperities at several heights or a rough
/// surface, rigid or elastic, and the load or number of passes at which something fails.
#[derive(Debug, Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true, after_help = help::PERCOAT)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    /// Colour messages: auto, always or never
    #[arg(long, value_enum, default_value_t, global = true, value_name = "WHEN", hide_possible_values = true)]
    color: Colour,
}

/// A command with its arguments.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Solve every load step of a case (without CASE: the embedded default, Fig. 2 of the paper)
    #[command(after_help = help::SOLVE)]
    Solve {
        /// Case file, the name of an embedded case, or - for standard input
        case: Option<PathBuf>,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        options: SolveOptions,
        #[command(flatten)]
        common: Common,
    },
    /// Solve a case by both methods, spectral and localized, and show their differences (the last load step)
    #[command(after_help = help::COMPARE)]
    Compare {
        /// Case file, the name of an embedded case, or - for standard input
        case: Option<PathBuf>,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        common: Common,
    },
    /// Find the limit loads: the mean pressures or forces at which materials and interfaces fail (without CASE: a DLC coating on steel)
    #[command(after_help = help::LIMIT)]
    Limit {
        /// Case file with strengths, the name of an embedded case, or - for standard input
        case: Option<PathBuf>,
        /// Search no higher than this load, as "20 N" or as a number in the units of the case
        #[arg(long, value_name = "LOAD", allow_hyphen_values = true)]
        up_to: Option<String>,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        common: Common,
    },
    /// Find how many passes a body lasts: what fails first, where, and what is left after [life] passes (without CASE: TiN on steel)
    #[command(after_help = help::LIFE)]
    Life {
        /// Case file with fatigue or wear, the name of an embedded case, or - for standard input
        case: Option<PathBuf>,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        options: LifeOptions,
        #[command(flatten)]
        common: Common,
    },
    /// Find moduli, thicknesses or other keys of a case from measured indentation curves
    #[command(after_help = help::IDENTIFY, override_usage = "percoat identify [OPTIONS] --free <KEY,…> <DATA>... <CASE>")]
    Identify {
        /// Tables of one or more curves, as instruments export them: columns `force` and `penetration`, with units as in `force_mN` or `Depth [nm]`; behind them the case file of one indenter alone, or the name of an embedded case
        #[arg(required = true, value_name = "DATA… CASE")]
        files: Vec<PathBuf>,
        /// Keys to be found, as layers.0.young,substrate.young; `offset`: the error of the zero of penetration, of each loading curve; `frame_compliance`: that of the instrument's frame
        #[arg(long, required = true, value_name = "KEY,…", value_delimiter = ',')]
        free: Vec<String>,
        /// Known additions of the instrument, in the units of the case, and the factor of the stiffness of unloading of tips that are not round [default: 1]: offset=LENGTH,frame_compliance=LENGTH PER FORCE,beta=FACTOR
        #[arg(long, value_name = "NAME=VALUE,…", value_delimiter = ',')]
        known: Vec<String>,
        /// Part of the test that is fitted; `loading`: up to nearly the largest force, without hold and unloading; `unloading`: the stiffness at the largest force, by Oliver and Pharr's method on the layered body; `retraction`: drawing off surfaces that adhere, to the least force, as for adhesion.work [default: all of it, which has to be loading]
        #[arg(long, value_name = "SEGMENT", value_parser = ["loading", "unloading", "retraction"])]
        segment: Option<String>,
        /// Parts of the largest force between which unloading is fitted [default: 0.25,0.95]
        #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',')]
        part: Option<Vec<f64>>,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        common: Common,
    },
    /// Solve a case for many values of its keys: one row for each combination and load step in sweep.csv
    #[command(after_help = help::SWEEP)]
    Sweep {
        /// Case file, the name of an embedded case, or - for standard input
        case: PathBuf,
        /// Values of a key: KEY=V1,V2,… or KEY=A:B:N or KEY=A:B:N:log (repeatable); a single value applies to all combinations
        #[arg(long, value_name = "KEY=VALUES")]
        set: Vec<String>,
        #[command(flatten)]
        options: SweepOptions,
        #[command(flatten)]
        common: Common,
    },
    /// Join the parts of a sweep that were solved with --shard into one table
    #[command(after_help = help::MERGE)]
    Merge {
        /// Output folders of the parts
        #[arg(required = true, value_name = "DIR")]
        folders: Vec<PathBuf>,
        /// Output folder [default: the one that contains all parts]
        #[arg(short, long, value_name = "DIR")]
        output: Option<PathBuf>,
        #[command(flatten)]
        pictures: PictureOptions,
        #[command(flatten)]
        saying: Saying,
    },
    /// Make one HTML page of a finished run, sweep, limit or life, for screen, phone and print, without network
    #[command(after_help = help::REPORT)]
    Report {
        /// Output folder of the run
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// File to write [default: DIR/report.html]
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
        /// Print nothing but errors
        #[arg(short, long)]
        quiet: bool,
    },
    /// Response of the layered half-space to a harmonic pressure or shear traction cos(qx), as JSON lines
    #[command(after_help = help::KERNEL)]
    Kernel {
        /// Case file, the name of an embedded case, or - for standard input
        case: Option<PathBuf>,
        /// Wavenumbers q > 0, 1/length
        #[arg(long, value_delimiter = ',', required = true, value_name = "Q,…", value_parser = wavenumber)]
        wavenumber: Vec<f64>,
        /// Depths z ≥ 0 at which stresses and displacements are computed
        #[arg(long, value_delimiter = ',', value_name = "Z,…", value_parser = depth)]
        depth: Vec<f64>,
        /// Load on the surface: a pressure, or a shear traction along or across the wavevector
        #[arg(long, value_enum, default_value_t, value_name = "TRACTION")]
        traction: Traction,
        #[command(flatten)]
        changes: Changes,
    },
    /// Check a case and show what it means: cell, grid, materials, memory, loads of first touch; solves no load step
    #[command(after_help = help::CHECK)]
    Check {
        /// Case file, the name of an embedded case, or - for standard input
        case: PathBuf,
        /// Folder for the power spectrum C(q) of a surface, h_rms² = ∫ C d²q, as picture and table [default: none is written]
        #[arg(short, long, value_name = "DIR")]
        output: Option<PathBuf>,
        #[command(flatten)]
        changes: Changes,
        #[command(flatten)]
        work: Work,
    },
    /// List the embedded example cases, or print one; with --set it is printed with the changes and all defaults
    #[command(after_help = help::CASES)]
    Cases {
        /// Name of the case to print
        name: Option<String>,
        #[command(flatten)]
        changes: Changes,
    },
    /// List the library of materials, or print one with ranges and sources
    #[command(after_help = help::MATERIALS)]
    Materials {
        /// Name of the material to print as TOML
        name: Option<String>,
        /// A file of one's own materials, which come before those of the library
        #[arg(long, value_name = "FILE")]
        file: Option<PathBuf>,
    },
    /// Explain the keys of a case: type, unit, range, default and an example (without KEY: the sections)
    #[command(after_help = help::EXPLAIN)]
    Explain {
        /// A section, a key such as layers.poisson, or the name of a key
        key: Option<String>,
        /// Print the JSON schema of case files, for editors
        #[arg(long, conflicts_with = "key")]
        schema: bool,
        /// Print all keys as tables in Markdown
        #[arg(long, conflicts_with_all = ["key", "schema"])]
        markdown: bool,
    },
    #[cfg(feature = "validate")]
    /// Compare percoat with closed forms, references and other programs; exit code 1 when a check fails
    #[command(after_help = help::VALIDATE)]
    Validate {
        /// Name of one study, or of a folder of studies (`paper`) [default: all]
        study: Option<String>,
        /// List the studies without running them
        #[arg(long, conflicts_with_all = ["expect", "output", "quiet", "verbose", "threads"])]
        list: bool,
        /// An earlier REPORT.md: fail unless studies, quantities and verdicts are the same
        #[arg(long, value_name = "REPORT")]
        expect: Option<PathBuf>,
        #[command(flatten)]
        studies: Studies,
        #[command(flatten)]
        work: Work,
    },
    /// Print the completions of commands and options for a shell
    #[command(after_help = help::COMPLETIONS)]
    Completions {
        /// Name of the shell
        shell: Shell,
    },
    /// Print the manual page of percoat, or of one of its commands, as roff
    #[command(after_help = help::MAN)]
    Man {
        /// Name of the command
        command: Option<String>,
    },
}

impl Arguments {
    /// The arguments of a command line, the program's name first; an error is printed, and its exit code returned.
    pub fn read(typed: &[OsString]) -> Result<Self, u8> {
        let words: Vec<String> = typed.iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect();
        terminal::choose_colour(typed_colour(&words));
        let command = Self::command().color(terminal::parser_colour());
        let read = command.try_get_matches_from(typed).and_then(|matches| Self::from_arg_matches(&matches));
        read.map_err(|error| {
            let message = without_effect::explained(&error, &words, &Self::command());
            answer(&error, message, &words)
        })
    }

    /// Number of threads that is prescribed, and whether errors alone are printed; `None` for a command that computes nothing.
    pub fn computes(&self) -> Option<(Option<u16>, bool)> {
        match &self.command {
            Command::Solve { common, .. }
            | Command::Compare { common, .. }
            | Command::Limit { common, .. }
            | Command::Life { common, .. }
            | Command::Identify { common, .. }
            | Command::Sweep { common, .. } => Some((common.work.threads, common.quiet)),
            Command::Check { work, .. } => Some((work.threads, false)),
            #[cfg(feature = "validate")]
            Command::Validate { work, studies, .. } => Some((work.threads, studies.quiet)),
            Command::Merge { saying, .. } => Some((None, saying.quiet)),
            Command::Report { quiet, .. } => Some((None, *quiet)),
            Command::Kernel { .. } | Command::Cases { .. } => Some((None, false)),
            Command::Materials { .. } | Command::Explain { .. } | Command::Completions { .. } | Command::Man { .. } => {
                None
            }
        }
    }
}

/// Prints the help, or the error of the command line; returns the exit code.
fn answer(error: &clap::Error, message: Option<String>, words: &[String]) -> u8 {
    let printed = match message {
        Some(message) => {
            tell!("error: {message}");
            Ok(())
        }
        // Words with control characters are shown as their escapes, without colours.
        None if error.use_stderr() && words.iter().any(|word| word.contains(plain::is_hidden)) => {
            tell!("{}", error.render().to_string().trim_end());
            Ok(())
        }
        None => error.print().and_then(|()| terminal::out().flush()),
    };
    match printed {
        // A closed pipe behind help is no error; an error message that cannot be printed keeps its exit code.
        Err(failed) if !error.use_stderr() && failed.kind() != ErrorKind::BrokenPipe => {
            let failure = Failure::Print(failed);
            failure.tell();
            failure.code()
        }
        _ => u8::try_from(error.exit_code()).unwrap_or(2),
    }
}

/// The last value of --color, which is needed before any message.
fn typed_colour(words: &[String]) -> Colour {
    let mut colour = Colour::Auto;
    let mut words = words.iter().map(String::as_str).take_while(|word| *word != "--");
    while let Some(word) = words.next() {
        let value = if word == "--color" { words.next() } else { word.strip_prefix("--color=") };
        colour = value.and_then(|value| Colour::from_str(value, false).ok()).unwrap_or(colour);
    }
    colour
}

/// A wavenumber whose powers are within double precision.
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

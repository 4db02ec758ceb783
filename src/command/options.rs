//! Options that several commands share.

use clap::Args;
use std::path::PathBuf;

/// Options of the commands that solve a case into a folder.
#[derive(Debug, Args)]
pub struct Common {
    /// Output folder [default: out/<case name>]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more on the way
    #[arg(short, long)]
    pub verbose: bool,
    /// Print the summary on standard output as JSON, instead of tables
    #[arg(long)]
    pub json: bool,
}

/// How a command that computes nothing tells of its result.
#[derive(Debug, Args)]
pub struct Saying {
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
    /// Print the summary on standard output as JSON
    #[arg(long)]
    pub json: bool,
}

/// Overrides of a case.
#[derive(Debug, Args)]
pub struct Changes {
    /// Change a value of the case, as in layers.0.thickness=0.2 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// Where the studies of a validation go, and how they are told of.
#[cfg(feature = "validate")]
#[derive(Debug, Args)]
pub struct Studies {
    /// Output folder [default: out/validate]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more on the way
    #[arg(short, long)]
    pub verbose: bool,
}

/// How much of the machine is used.
#[derive(Debug, Args)]
pub struct Work {
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

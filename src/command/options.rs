//! Options that several commands share.

use super::terminal;
use clap::Args;
use indicatif::ProgressBar;
use std::path::PathBuf;

/// Options of the commands that solve a case into a folder.
#[derive(Debug, Args)]
pub struct Common {
    /// Output folder [default: out/<case name>]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Change a value of the case, as in layers.0.thickness=0.2 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more on the way
    #[arg(short, long)]
    pub verbose: bool,
}

impl Common {
    /// The bar where progress is drawn; elsewhere a hidden one.
    pub fn bar(&self, bar: ProgressBar) -> ProgressBar {
        if self.quiet || self.verbose || !terminal::moves() { ProgressBar::hidden() } else { bar }
    }
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

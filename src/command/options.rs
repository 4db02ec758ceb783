//! Options of several commands.

use super::ending::Failure;
use super::pictures::PictureOptions;
use clap::Args;
use percoat_case::case::given_twice;
use percoat_common::plain;
use std::path::PathBuf;

/// Options of the commands that solve a case into a folder.
#[derive(Debug, Args)]
pub struct Common {
    #[command(flatten)]
    pub pictures: PictureOptions,
    /// Output folder [default: out/<case name>]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub work: Work,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print more about the progress
    #[arg(short, long)]
    pub verbose: bool,
    /// Print the summary on standard output as JSON, instead of tables
    #[arg(long)]
    pub json: bool,
}

impl Common {
    /// The options of printing alone.
    pub fn saying(&self) -> Saying {
        Saying { quiet: self.quiet, json: self.json }
    }
}

/// Options of printing.
#[derive(Debug, Clone, Copy, Args)]
pub struct Saying {
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
    /// Print the summary on standard output as JSON
    #[arg(long)]
    pub json: bool,
}

/// Changes of a case.
#[derive(Debug, Args)]
pub struct Changes {
    /// Change a value of the case, as in layers.0.thickness=0.2 (repeatable)
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl Changes {
    /// The changes, each of another key.
    pub fn once(&self) -> Result<&[String], Failure> {
        match given_twice(self.set.iter().map(|text| text.split_once('=').map_or(text.as_str(), |(key, _)| key))) {
            Some(key) => Err(Failure::Refused(format!(
                "--set gives `{}` twice: give one value; percoat sweep takes several, --set KEY=V1,V2,…",
                plain::line(key.trim())
            ))),
            None => Ok(&self.set),
        }
    }
}

/// Options of output and printing of a validation.
#[cfg(feature = "validate")]
#[derive(Debug, Args)]
pub struct Studies {
    /// Output folder [default: out/validate]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print more about the progress
    #[arg(short, long)]
    pub verbose: bool,
}

/// Options on the use of the machine.
#[derive(Debug, Args)]
pub struct Work {
    /// Threads to use [default: all cores]; results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

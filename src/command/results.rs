//! The frame of the commands that compute into a folder: claim the folder, gather files in it, publish them, print the result.

use super::ending::Failure;
use super::interruption;
use super::options::Common;
use super::terminal;
use crate::output::{Plan, RunFolder, write_text};
use crate::plain;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A folder that is claimed for the results of a command, and where these are gathered.
pub struct Results {
    /// The claimed folder.
    pub claim: RunFolder,
    folder: PathBuf,
    quiet: bool,
}

/// A folder with published results.
pub struct Published {
    folder: PathBuf,
}

impl Results {
    /// Claims a folder for the files of a plan; from here on a signal to end is answered with the saved files.
    pub fn claim(folder: &Path, plan: Plan, quiet: bool) -> Result<Self, Failure> {
        interruption::watch();
        let claim = RunFolder::claim(folder, plan)?;
        terminal::tell_aside(claim.set_aside(), quiet);
        Ok(Self { claim, folder: folder.to_owned(), quiet })
    }

    /// The folder in which the files are gathered.
    pub fn staging(&self) -> PathBuf {
        self.claim.staging()
    }

    /// Writes a text file, given its name in the folder.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        Ok(write_text(&self.staging().join(name), text)?)
    }

    /// Puts all files in their place, instead of those of the results before.
    pub fn publish(self) -> Result<Published, Failure> {
        interruption::publish(self.claim, &self.folder, self.quiet)?;
        Ok(Published { folder: self.folder })
    }
}

impl Published {
    /// Prints the results: as JSON where `--json` is given, else as tables and a line on the computation, unless quiet.
    pub fn print(
        &self,
        common: &Common,
        json: impl FnOnce() -> String,
        tables: impl FnOnce() -> String,
        line: &str,
    ) -> Result<(), Failure> {
        let mut out = terminal::out();
        if common.json {
            write!(out, "{}", json())?;
        } else if !common.quiet {
            write!(out, "{}", tables())?;
            writeln!(out, "{line}; written to {}", plain::path(&self.folder))?;
        }
        Ok(())
    }
}

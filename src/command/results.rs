//! The frame of the commands that compute into a folder: claim the folder, gather files in it, publish them, print the result.

use super::declared::Declared;
use super::ending::Failure;
use super::interruption;
use super::options::Saying;
use super::pictures::PictureOptions;
use super::terminal::{self, tell};
use percoat_app::output::{Plan, RunFolder, disk, make_folder, write_text};
use percoat_common::plain;
use std::io::Write;
use std::path::PathBuf;

/// A folder that is claimed for the results of a command, and in which these are gathered.
pub struct Results {
    /// The claimed folder.
    pub claim: RunFolder,
    /// The path of the folder.
    pub folder: PathBuf,
    /// Options of printing.
    pub saying: Saying,
}

impl Results {
    /// Claims a folder for the files of a plan. From here on the handler of signals to end prints the saved files.
    pub fn claim(folder: PathBuf, plan: Plan, saying: Saying) -> Result<Self, Failure> {
        interruption::watch();
        let claim = RunFolder::claim(&folder, plan)?;
        terminal::tell_aside(claim.set_aside(), saying.quiet);
        Ok(Self { claim, folder, saying })
    }

    /// Begins anew because what an interrupted command has left is damaged, for a `reason`: it is kept, and a warning says where, and
    /// what is `done`.
    pub fn begin_after_damage(&mut self, reason: &str, done: &str) -> Result<(), Failure> {
        let aside = self.claim.begin_after_damage()?;
        tell!("warning: {}", terminal::damage(reason, aside.as_deref(), done));
        Ok(())
    }

    /// The folder in which the files are gathered.
    pub fn staging(&self) -> PathBuf {
        self.claim.staging()
    }

    /// Writes a text file, given its name in the folder; a folder in the name is made.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.staging().join(name);
        path.parent().filter(|_| name.contains('/')).map_or(Ok(()), make_folder)?;
        Ok(write_text(&path, text)?)
    }

    /// Writes the declared files of a `result`.
    pub fn write_all<R>(&self, files: &[Declared<R>], result: &R, pictures: &PictureOptions) -> Result<(), Failure> {
        files.iter().try_for_each(|file| file.write(result, &self.staging(), pictures))
    }

    /// Puts all files in their place, instead of those of the results before.
    pub fn publish(self) -> Result<(), Failure> {
        Ok(interruption::publish(self.claim, &self.folder, self.saying.quiet)?)
    }

    /// [Publishes](Self::publish) the files and prints the results: the file named `json` where `--json` is given, else tables and a
    /// line on the computation, unless quiet; then the warnings.
    pub fn finish(
        self,
        json: &str,
        tables: impl FnOnce() -> String,
        line: impl FnOnce() -> String,
        warnings: &[String],
    ) -> Result<(), Failure> {
        let (folder, saying) = (self.folder.clone(), self.saying);
        let (outdated, path) = (self.claim.outdated_reports()?, self.staging().join(json));
        let printed = saying.json.then(|| disk::read_text(&path)).transpose();
        let printed = printed.map_err(|error| Failure::Input { path, error })?;
        self.publish()?;
        let line = line();
        if let Some(json) = printed {
            write!(terminal::out(), "{json}")?;
        } else if !saying.quiet {
            writeln!(terminal::out(), "{}{line}; written to {}", tables(), plain::path(&folder))?;
        }
        terminal::warn(warnings, saying.quiet);
        if !saying.quiet {
            for report in outdated {
                let folder = plain::path(&folder);
                tell!("{report} showed the earlier result and is removed; `percoat report {folder}` writes it anew");
            }
        }
        Ok(())
    }
}

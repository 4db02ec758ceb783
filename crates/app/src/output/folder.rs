//! An output folder locked for one run; its life is described in the [module's head](super).

use super::error::AtPath;
use super::files::{FileRecord, Files};
use super::folder_error::FolderError;
use super::foreign::{refuse_in_own_places, refuse_in_staging, refuse_planned};
use super::interrupted::{has_begun, has_finished, has_steps, move_to_coarser, remove_fields, settle};
use super::layout::{LIST, OWN, is_staging};
use super::lock::lock;
use super::manifest::{self, published};
use super::plan::Plan;
use super::staging::{create, discard, plan_more, remove_retired, set_aside};
use super::writer::Writer;
use super::{OutputError, disk, publication};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// An output folder locked for this run until it is dropped or the process ends.
#[derive(Debug)]
pub struct RunFolder {
    folder: PathBuf,
    plan: Plan,
    set_aside: Option<PathBuf>,
    resumed: bool,
    _lock: File,
}

impl RunFolder {
    /// Creates the folder where there is none, locks it and creates an empty staging folder. An interrupted run there is dealt with
    /// first: a publication that was decided is completed, finished steps are resumed or [set aside](Self::set_aside).
    ///
    /// # Errors
    /// [`FolderError`]; no file of the folder is then replaced or removed.
    pub fn claim(folder: &Path, plan: Plan) -> Result<Self, FolderError> {
        refuse_in_own_places(folder, plan.writer)?;
        let kept = folder.join(OWN);
        if !disk::is_folder(&kept) {
            refuse_planned(folder, &listed(folder, &plan)?, &plan)?;
        }
        disk::make_folder(&kept).at(&kept)?;
        let lock = lock(folder)?;
        manifest::remove_drafts(folder);
        let mut aside = remove_retired(folder)?;
        for writer in Writer::all() {
            aside = publication::complete(folder, writer)?.or(aside);
        }
        let listed = listed(folder, &plan)?;
        refuse_planned(folder, &listed, &plan)?;
        if !plan.adopted.is_empty() {
            manifest::write(&folder.join(LIST), listed)?;
        }
        let mut claimed = Self { folder: folder.to_owned(), plan, set_aside: None, resumed: false, _lock: lock };
        let staging = claimed.staging();
        claimed.resumed = claimed.plan.resumes && is_staging(&staging) && has_begun(&staging);
        if claimed.resumed {
            plan_more(&staging, &claimed.plan.names)?;
            refuse_in_staging(&staging)?;
            settle(&staging)?;
        } else {
            // A staging folder with foreign files under percoat's names is set aside as it is.
            if refuse_in_staging(&staging).is_ok() {
                settle(&staging)?;
            }
            aside = claimed.begin_anew()?.or(aside);
        }
        claimed.set_aside = aside;
        Ok(claimed)
    }

    /// The staging folder, into which every file of the result is written.
    pub fn staging(&self) -> PathBuf {
        self.plan.writer.staging(&self.folder)
    }

    /// Whether this run resumes the interrupted run in the staging folder.
    pub fn resumes(&self) -> bool {
        self.resumed
    }

    /// Ends without a result: the staging folder goes. Returns where files of a user are now that stood in it.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be removed.
    pub fn abandon(self) -> Result<Option<PathBuf>, OutputError> {
        discard(&self.staging(), &self.folder)
    }

    /// Starts a new run in place of resuming the interrupted one. Returns the folder to which its finished steps were moved.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_anew(&mut self) -> Result<Option<PathBuf>, OutputError> {
        let staging = self.staging();
        let aside = if !disk::is_folder(&staging) {
            None
        } else if self.plan.writer.is_resumable() && has_finished(&staging) {
            Some(set_aside(&staging, &self.folder)?)
        } else {
            discard(&staging, &self.folder)?
        };
        create(&staging, &self.plan.names)?;
        self.resumed = false;
        Ok(aside)
    }

    /// Starts a new run because the interrupted one is damaged. Nothing is removed; returns the folder to which all of it was moved.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_after_damage(&mut self) -> Result<Option<PathBuf>, OutputError> {
        let aside = set_aside(&self.staging(), &self.folder)?;
        Ok(self.begin_anew()?.or(Some(aside)))
    }

    /// Keeps the writer's earlier files whose names have this beginning.
    pub fn keep(&mut self, beginning: String) {
        self.plan.kept.push(beginning);
    }

    /// The folder to which finished steps of an interrupted run were moved, or foreign files beside them; `None` where none were.
    pub fn set_aside(&self) -> Option<&Path> {
        self.set_aside.as_deref()
    }

    /// Begins a finer grid: the steps of the coarser one stay in `coarser/` until the result is published. Returns the folder to
    /// which foreign files in the way were moved.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_finer(&self) -> Result<Option<PathBuf>, OutputError> {
        let staging = self.staging();
        match has_steps(&staging) {
            true => move_to_coarser(&staging, &self.folder),
            // An interrupted run may have left fields of an unfinished step.
            false if self.resumed => remove_fields(&staging, &self.folder),
            false => Ok(None),
        }
    }

    /// Names of the reports that show the earlier result, which go when the new one is published.
    ///
    /// # Errors
    /// [`OutputError`] with the report that cannot be read.
    pub fn outdated_reports(&self) -> Result<Vec<String>, OutputError> {
        let reports = published(&self.folder).filtered(|_, by| self.plan.writer.outdates(by));
        Ok(reports.as_written(&self.folder)?.into_iter().map(str::to_owned).collect())
    }

    /// Replaces the earlier result by the new one, and unlocks the folder. Returns the folder to which foreign files of the staging
    /// folder were moved.
    ///
    /// # Errors
    /// [`OutputError`], also where a foreign file has appeared in the way since the folder was claimed; the result then stays in the
    /// staging folder.
    pub fn publish(self) -> Result<Option<PathBuf>, OutputError> {
        let published = publication::decide(&self.folder, &self.plan);
        let published = published.and_then(|()| publication::complete(&self.folder, self.plan.writer));
        published.map_err(|error| match error {
            FolderError::Output(error) => error,
            refused => OutputError::new(&self.folder, io::Error::other(refused.to_string())),
        })
    }
}

/// The published files of a folder, and the adopted ones.
fn listed(folder: &Path, plan: &Plan) -> Result<Files, OutputError> {
    let mut files = published(folder);
    for name in plan.adopted.iter().filter(|name| disk::is_file(&folder.join(name))) {
        let path = folder.join(name);
        files.insert(name, FileRecord::of(&path, plan.writer.listed()).at(&path)?);
    }
    Ok(files)
}

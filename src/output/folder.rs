//! An output folder that a run has for itself, see the [module's head](super) for its life.

use super::gathered::{mark, remove_gathered, set_aside};
use super::layout::{COARSER, FolderError, MARK, OWN, foreign, names, own, staging};
use super::leftovers::{has_begun, has_finished, has_steps, move_aside, remove_begun, settle};
use super::lock::{self, lock};
use super::manifest::{Manifest, Scope, Writer, Written};
use super::publication::{PLACING, Publication};
use super::{Files, OutputError, disk, stranger, write_text};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

/// What a run is going to write.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Who writes.
    pub writer: Writer,
    /// Every name that may come, relative to the folder.
    pub names: Vec<String>,
    /// Which of the writer's earlier files the result replaces.
    pub scope: Scope,
    /// Names whose content shows that they are percoat's, whatever stands in its list.
    pub adopted: Vec<String>,
    /// Whether finished steps or combinations of an earlier run that was killed stay where they were gathered.
    pub resumes: bool,
    /// Content of `case.toml`, if it is among them: the same file there already is no obstacle, and stays its owner's.
    pub case: Option<String>,
}

impl Plan {
    /// Of a result without files that replaces the writer's earlier one.
    pub fn new(writer: Writer) -> Self {
        Self { writer, names: Vec::new(), scope: Scope::default(), adopted: Vec::new(), resumes: false, case: None }
    }
}

/// An output folder of this run alone, until it is dropped or the process ends in whatever way.
#[derive(Debug)]
pub struct RunFolder {
    folder: PathBuf,
    plan: Plan,
    set_aside: Option<PathBuf>,
    resumed: bool,
    _lock: File,
}

impl RunFolder {
    /// Makes the folder if need be, has it for this run and begins an empty result beside what stands there. What an
    /// earlier run was killed over is put in order first: a result that was being published is, finished steps of an
    /// unfinished one are [set aside](Self::set_aside).
    ///
    /// # Errors
    /// [`FolderError`]; nothing in the folder has been replaced or removed.
    pub fn claim(folder: &Path, plan: Plan) -> Result<Self, FolderError> {
        stranger::refuse(folder, plan.writer)?;
        if !disk::is_folder(&folder.join(OWN)) {
            let adopted = |name: &&String| !plan.adopted.contains(name);
            let names = plan.names.iter().filter(adopted).cloned().collect();
            refuse_foreign(folder, &Manifest::empty(), &Plan { names, ..plan.clone() })?;
        }
        make_own(folder)?;
        let lock = lock(folder)?;
        let mut aside = None;
        for writer in Writer::ALL {
            aside = Publication::new(folder, writer).complete()?.or(aside);
        }
        refuse_foreign(folder, &adopting(folder, &plan)?, &plan)?;
        let mut claimed = Self { folder: folder.to_owned(), plan, set_aside: None, resumed: false, _lock: lock };
        if claimed.plan.resumes && claimed.is_begun() {
            stranger::refuse_in(&claimed.staging())?;
            settle(&claimed.staging())?;
            claimed.resumed = true;
            claimed.set_aside = aside;
            return Ok(claimed);
        }
        aside = claimed.clear_staging()?.or(aside);
        claimed.set_aside = claimed.make_staging()?.or(aside);
        Ok(claimed)
    }

    /// Where the result is gathered: every file of it is written here.
    pub fn staging(&self) -> PathBuf {
        staging(&self.folder, self.plan.writer)
    }

    /// Whether what an earlier run finished stands where the result is gathered, and this run goes on with it.
    pub fn resumes(&self) -> bool {
        self.resumed
    }

    /// What stands where the result is gathered already, bytes.
    pub fn gathered(folder: &Path) -> u64 {
        fn size(folder: &Path) -> u64 {
            let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
            let own = |entry: std::fs::DirEntry| match entry.metadata() {
                Ok(own) if own.is_dir() => size(&entry.path()),
                own => own.map_or(0, |own| own.len()),
            };
            entries.map(own).sum()
        }
        let staging = staging(folder, Writer::Solve);
        if disk::is_folder(&staging) { size(&staging) } else { 0 }
    }

    /// Ends without a result: where it would have been gathered goes.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be removed.
    pub fn leave(self) -> Result<(), OutputError> {
        remove_gathered(&self.staging(), &|_| false).map(|_| ())
    }

    /// Begins anew although this run was to go on: the steps that an earlier one finished are moved aside; where to.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_anew(&mut self) -> Result<Option<PathBuf>, OutputError> {
        self.resumed = false;
        let aside = self.clear_staging()?;
        Ok(self.make_staging()?.or(aside))
    }

    /// Begins anew because what an earlier run has finished is damaged: all of it is moved aside, nothing removed; where to.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_after_damage(&mut self) -> Result<Option<PathBuf>, OutputError> {
        self.resumed = false;
        let aside = set_aside(&self.staging(), &self.folder)?;
        Ok(self.make_staging()?.or(aside))
    }

    /// The writer's earlier files whose names begin like this stay as they are.
    pub fn keeps(&mut self, beginning: String) {
        self.plan.scope.except.push(beginning);
    }

    /// Where the finished steps of an earlier run that was killed are now, or what somebody else has put beside them.
    pub fn set_aside(&self) -> Option<&Path> {
        self.set_aside.as_deref()
    }

    /// Where the steps of a coarser grid stand, if there are any, in the place where a result is gathered.
    pub fn coarser(staging: &Path) -> Option<PathBuf> {
        Some(staging.join(COARSER)).filter(|path| disk::is_folder(path))
    }

    /// Whether anything has been solved in the place where a result is gathered, on its grid or a coarser one, be it a load
    /// of which nothing is read off yet.
    pub fn has_begun(staging: &Path) -> bool {
        has_begun(staging)
    }

    /// Whether an earlier `solve` into a folder has solved its first load, or begun to, and finished no step: nothing that
    /// could be set aside, and something with which a run of the same case can go on.
    pub fn has_solved_alone(folder: &Path) -> bool {
        let staging = staging(folder, Writer::Solve);
        disk::is_folder(&staging)
            && disk::is_file(&staging.join(MARK))
            && has_begun(&staging)
            && !has_finished(&staging)
    }

    /// Begins again on a finer grid. The steps of the coarser one stand in `coarser/` until the result is published.
    /// What somebody else has put there before is moved aside: where to.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_finer(&self) -> Result<Option<PathBuf>, OutputError> {
        let staging = self.staging();
        if has_steps(&staging) {
            return move_aside(&staging, &self.folder);
        }
        // A run that was killed may have begun here, without coming to the end of a step.
        if self.resumed { remove_begun(&staging, &self.folder) } else { Ok(None) }
    }

    /// Puts the result in the place of the one before, and ends the run's hold of the folder. What somebody else has put
    /// beside the gathered result is moved aside: where to.
    ///
    /// # Errors
    /// [`OutputError`], also when something that is not percoat's has come into the way since the folder was claimed;
    /// the result then stays where it was gathered.
    pub fn publish(self) -> Result<Option<PathBuf>, OutputError> {
        let publication = Publication::new(&self.folder, self.plan.writer);
        let decided = publication.decide(&self.plan.names, &self.plan.scope);
        decided.and_then(|()| publication.complete()).map_err(|error| match error {
            FolderError::Output(error) => error,
            refused => OutputError::new(&self.folder, io::Error::other(refused.to_string())),
        })
    }

    /// Whether an earlier run of this writer has finished something and not published it.
    fn is_begun(&self) -> bool {
        let staging = self.staging();
        disk::is_folder(&staging) && disk::is_file(&staging.join(MARK)) && has_begun(&staging)
    }

    /// Moves what an earlier run of this writer left unfinished to `interrupted-1/` or the next free number; removes it
    /// where no step was finished and nobody else has put anything there.
    fn clear_staging(&self) -> Result<Option<PathBuf>, OutputError> {
        let staging = self.staging();
        if !disk::is_folder(&staging) {
            return Ok(None);
        }
        let planned = |name: &str| self.plan.names.iter().any(|own| own == name);
        if !has_finished(&staging) && remove_gathered(&staging, &planned)? {
            return Ok(None);
        }
        // Where somebody has put something in the place of a file or a folder all of it stays as it is.
        if stranger::refuse_in(&staging).is_ok() {
            settle(&staging)?;
        }
        set_aside(&staging, &self.folder)
    }

    /// An empty place for the result, marked as percoat's from the moment it is there. What stood where it is made and is
    /// somebody else's is moved aside: where to.
    fn make_staging(&self) -> Result<Option<PathBuf>, OutputError> {
        let (new, staging) = (own(&self.folder, "new"), self.staging());
        let aside = if remove_gathered(&new, &|_| false)? { None } else { set_aside(&new, &self.folder)? };
        disk::create_folder(&new).map_err(|error| OutputError::new(&new, error))?;
        mark(&new, &self.plan.names)?;
        // The mark comes to the disk before the folder has its name, and that before anything is finished in it.
        let moved = disk::sync_folder(&new).and_then(|()| disk::move_to(&new, &staging));
        let moved = moved.and_then(|()| disk::sync_folder(staging.parent().unwrap_or(&self.folder)));
        moved.map_err(|error| OutputError::new(&staging, error))?;
        Ok(aside)
    }
}

/// Makes an output folder where there is none, and what percoat keeps for itself in it.
fn make_own(folder: &Path) -> Result<(), OutputError> {
    let own = folder.join(OWN);
    let made = disk::make_folder(&own).and_then(|made| made.iter().try_for_each(|folder| disk::sync_folder(folder)));
    made.map_err(|error| OutputError::new(&own, error))
}

/// Whether a folder is one that was [released](release), be it not to the end: a result stands there, and no list of it.
pub fn is_released(folder: &Path) -> bool {
    let is_result = |name: &String| *name != OWN && folder.join(name) != staging(folder, Writer::Solve);
    !disk::is_file(&own(folder, "written.json")) && names(folder).is_ok_and(|names| names.iter().any(is_result))
}

/// Gives up what percoat keeps for itself in a folder whose files become part of another result: those that were solved there.
/// Anything else there stays.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn release(folder: &Path) -> Result<Files, OutputError> {
    let files = Files::published(folder, Writer::Solve);
    let place = folder.join(OWN);
    if !disk::is_folder(&place) {
        return Ok(files);
    }
    for name in ["written.json", lock::NAME] {
        let path = own(folder, name);
        if disk::is_file(&path) {
            disk::remove(&path).map_err(|error| OutputError::new(&path, error))?;
        }
    }
    let gone = match disk::remove_folder(&place) {
        Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => Ok(()),
        gone => gone.and_then(|()| disk::sync_folder(folder)),
    };
    gone.map(|()| files).map_err(|error| OutputError::new(&place, error))
}

/// The list of a folder, with the adopted names on it.
fn adopting(folder: &Path, plan: &Plan) -> Result<Manifest, OutputError> {
    let list = own(folder, "written.json");
    let mut manifest = Manifest::read(&list);
    let there: Vec<&String> = plan.adopted.iter().filter(|name| disk::is_file(&folder.join(name))).collect();
    for name in &there {
        let path = folder.join(name);
        manifest.add(name, Written::of(&path, plan.writer).map_err(|error| OutputError::new(&path, error))?);
    }
    if !there.is_empty() {
        write_text(&list, &manifest.to_json())?;
    }
    Ok(manifest)
}

/// Refuses what the plan, or the removal of the writer's earlier files, would take from its owner.
fn refuse_foreign(folder: &Path, manifest: &Manifest, plan: &Plan) -> Result<(), FolderError> {
    let replaced = |name: &&str| plan.scope.contains(name) && !plan.names.iter().any(|planned| planned == name);
    let earlier = manifest.names(plan.writer).filter(replaced);
    for name in plan.names.iter().map(String::as_str).chain(earlier) {
        let path = folder.join(name);
        let standing = manifest.standing(folder, name).map_err(|error| OutputError::new(&path, error))?;
        let same = || name == "case.toml" && plan.case.is_some() && disk::read_text(&path).ok() == plan.case;
        if let Some(reason) = foreign(standing).filter(|_| !same()) {
            return Err(FolderError::Foreign { path, reason });
        }
    }
    let is_of_nobody = |folder: &Path| names(folder).is_ok_and(|names| names.is_empty());
    let staging = staging(folder, plan.writer);
    let unmarked = || !disk::is_file(&staging.join(MARK)) && !is_of_nobody(&staging);
    if [Writer::Solve, Writer::Sweep].contains(&plan.writer) && disk::is_folder(&staging) && unmarked() {
        return Err(FolderError::Foreign { path: staging, reason: "is not of percoat" });
    }
    // No result is on the way to its place any more, or was decided about.
    let second = own(folder, PLACING);
    if matches!(disk::found(&second), Ok(Some(_))) {
        return Err(FolderError::Foreign { path: second, reason: "is not of percoat" });
    }
    Ok(())
}

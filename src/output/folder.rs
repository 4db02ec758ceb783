//! An output folder that a run has for itself, see the [module's head](super) for its life.

use super::gathered::{is_moved, is_partial, remove_gathered, remove_own, remove_temporary, remove_waiting, set_aside};
use super::layout::{COARSER, FolderError, MARK, OWN, SWEEP_LOG, foreign, names, own, remove_folder, staging};
use super::manifest::{Manifest, Scope, Writer, Written};
use super::publication::Publication;
use super::{Files, OutputError, make_folder, write_text};
use super::{checkpoint, steps_log};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
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
        if !folder.join(OWN).is_dir() {
            let adopted = |name: &&String| !plan.adopted.contains(name);
            let names = plan.names.iter().filter(adopted).cloned().collect();
            refuse_foreign(folder, &Manifest::empty(), &Plan { names, ..plan.clone() })?;
        }
        make_folder(&folder.join(OWN))?;
        let lock = lock(folder)?;
        let mut aside = None;
        for writer in Writer::ALL {
            aside = Publication::new(folder, writer).complete()?.or(aside);
        }
        refuse_foreign(folder, &adopting(folder, &plan)?, &plan)?;
        let mut claimed = Self { folder: folder.to_owned(), plan, set_aside: None, resumed: false, _lock: lock };
        if claimed.plan.resumes && claimed.is_begun() {
            settle(&claimed.staging())?;
            claimed.resumed = true;
            claimed.set_aside = aside;
            return Ok(claimed);
        }
        claimed.set_aside = claimed.clear_staging()?.or(aside);
        claimed.make_staging()?;
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
            let entries = fs::read_dir(folder).into_iter().flatten().flatten();
            let own = |entry: fs::DirEntry| match entry.metadata() {
                Ok(own) if own.is_dir() => size(&entry.path()),
                own => own.map_or(0, |own| own.len()),
            };
            entries.map(own).sum()
        }
        size(&staging(folder, Writer::Solve))
    }

    /// Ends without a result: where it would have been gathered goes.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be removed.
    pub fn leave(self) -> Result<(), OutputError> {
        remove_gathered(&self.staging(), self.plan.writer, &|_| false).map(|_| ())
    }

    /// Begins anew although this run was to go on: the steps that an earlier one finished are moved aside; where to.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_anew(&mut self) -> Result<Option<PathBuf>, OutputError> {
        self.resumed = false;
        let aside = self.clear_staging()?;
        self.make_staging()?;
        Ok(aside)
    }

    /// Begins anew because what an earlier run has finished is damaged: all of it is moved aside, nothing removed; where to.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_after_damage(&mut self) -> Result<Option<PathBuf>, OutputError> {
        self.resumed = false;
        let aside = set_aside(&self.staging(), &self.folder)?;
        self.make_staging()?;
        Ok(aside)
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
        Some(staging.join(COARSER)).filter(|path| path.is_dir())
    }

    /// Whether anything has been solved in the place where a result is gathered, on its grid or a coarser one, be it a load
    /// of which nothing is read off yet.
    pub fn has_begun(staging: &Path) -> bool {
        has_finished(staging) || staging.join(checkpoint::NAME).is_file()
    }

    /// Whether an earlier `solve` into a folder has solved its first load, or begun to, and finished no step: nothing that
    /// could be set aside, and something with which a run of the same case can go on.
    pub fn has_solved_alone(folder: &Path) -> bool {
        let staging = staging(folder, Writer::Solve);
        staging.join(MARK).is_file() && Self::has_begun(&staging) && !has_finished(&staging)
    }

    /// Begins again on a finer grid. The steps of the coarser one stand in `coarser/` until the result is published.
    /// What somebody else has put there before is moved aside: where to.
    ///
    /// # Errors
    /// [`OutputError`] with the path that cannot be moved.
    pub fn begin_finer(&self) -> Result<Option<PathBuf>, OutputError> {
        let staging = self.staging();
        if !has_steps(&staging) {
            // A run that was killed may have begun here, without coming to the end of a step.
            let mut aside = None;
            for name in names(&staging)?.iter().filter(|name| self.resumed && is_partial(name)) {
                let partial = staging.join(name);
                if !remove_waiting(&partial)? {
                    aside = set_aside(&partial, &self.folder)?;
                }
            }
            return Ok(aside);
        }
        let coarser = staging.join(COARSER);
        // A folder without a log is one on its way, see `settle`.
        let log = coarser.join(steps_log::NAME);
        if log.is_file() {
            fs::remove_file(&log).map_err(|error| OutputError::new(&log, error))?;
        }
        let aside = if remove_own(&coarser, &|_| false)? { None } else { set_aside(&coarser, &self.folder)? };
        make_folder(&coarser)?;
        move_steps(&staging, &coarser)?;
        Ok(aside)
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
        staging.join(MARK).is_file() && Self::has_begun(&staging)
    }

    /// Moves what an earlier run of this writer left unfinished to `interrupted-1/` or the next free number; removes it
    /// where no step was finished and nobody else has put anything there.
    fn clear_staging(&self) -> Result<Option<PathBuf>, OutputError> {
        let staging = self.staging();
        if !staging.exists() {
            return Ok(None);
        }
        if !has_finished(&staging)
            && remove_gathered(&staging, self.plan.writer, &|name| self.plan.names.iter().any(|own| own == name))?
        {
            return Ok(None);
        }
        settle(&staging)?;
        set_aside(&staging, &self.folder)
    }

    /// An empty place for the result, marked as percoat's from the moment it is there.
    fn make_staging(&self) -> Result<(), OutputError> {
        let new = own(&self.folder, "new");
        remove_folder(&new)?;
        make_folder(&new)?;
        let version = env!("CARGO_PKG_VERSION");
        write_text(&new.join(MARK), &format!("A run of percoat {version} that is not finished.\n"))?;
        let staging = self.staging();
        fs::rename(&new, &staging).map_err(|error| OutputError::new(&staging, error))
    }
}

/// Gives up what percoat keeps for itself in a folder whose files become part of another result: those that were solved there.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn release(folder: &Path) -> Result<Files, OutputError> {
    let files = Files::published(folder, Writer::Solve);
    remove_folder(&folder.join(OWN))?;
    Ok(files)
}

/// Whether a folder is one that was [released](release): a result stands there, and nobody has it.
pub fn is_released(folder: &Path) -> bool {
    !folder.join(OWN).exists() && names(folder).is_ok_and(|names| !names.is_empty())
}

/// Whether a step or a combination has been finished where a result is gathered, on its grid or a coarser one.
fn has_finished(staging: &Path) -> bool {
    has_steps(staging) || has_steps(&staging.join(COARSER))
}

/// Whether steps have been finished on one grid: its log has a whole line. A summary is one too: earlier versions of percoat
/// wrote it after every step, and no log.
fn has_steps(folder: &Path) -> bool {
    [steps_log::NAME, SWEEP_LOG].iter().any(|name| steps_log::has_whole_line(&folder.join(name)))
        || folder.join("summary.json").is_file()
}

/// Puts in order what a run that was killed has left where its result is gathered: files that were being written go, logs
/// end with their last whole line, and steps of a coarser grid that were on the way to `coarser/` come there.
fn settle(staging: &Path) -> Result<(), OutputError> {
    let coarser = staging.join(COARSER);
    if coarser.is_dir() && !coarser.join(steps_log::NAME).is_file() && staging.join(steps_log::NAME).is_file() {
        move_steps(staging, &coarser)?;
    }
    for folder in [staging, &coarser].into_iter().filter(|folder| folder.is_dir()) {
        remove_temporary(folder)?;
        for name in [steps_log::NAME, SWEEP_LOG] {
            steps_log::cut(&folder.join(name))?;
        }
    }
    Ok(())
}

/// Moves the steps of a grid where those of the coarser one stand, the log as the last: what it lists is there when it comes.
fn move_steps(staging: &Path, coarser: &Path) -> Result<(), OutputError> {
    let names = names(staging)?;
    let log = names.iter().filter(|name| *name == steps_log::NAME);
    for name in names.iter().filter(|name| is_moved(name)).chain(log) {
        let (path, to) = (staging.join(name), coarser.join(name));
        // What a grid before has left there.
        if is_partial(name) {
            remove_waiting(&to)?;
        }
        fs::rename(&path, &to).map_err(|error| OutputError::new(&path, error))?;
    }
    Ok(())
}

/// The list of a folder, with the adopted names on it.
fn adopting(folder: &Path, plan: &Plan) -> Result<Manifest, OutputError> {
    let list = own(folder, "written.json");
    let mut manifest = Manifest::read(&list);
    let there: Vec<&String> = plan.adopted.iter().filter(|name| folder.join(name).is_file()).collect();
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
        let same = || name == "case.toml" && plan.case.is_some() && fs::read_to_string(&path).ok() == plan.case;
        if let Some(reason) = foreign(standing).filter(|_| !same()) {
            return Err(FolderError::Foreign { path, reason });
        }
    }
    let staging = staging(folder, plan.writer);
    let unmarked = || !staging.join(MARK).is_file() && !names(&staging).is_ok_and(|names| names.is_empty());
    if [Writer::Solve, Writer::Sweep].contains(&plan.writer) && staging.exists() && unmarked() {
        return Err(FolderError::Foreign { path: staging, reason: "is not of percoat" });
    }
    Ok(())
}

/// Has the folder for this process as long as the file is open; the system ends that however the process ends.
fn lock(folder: &Path) -> Result<File, FolderError> {
    let path = own(folder, "lock");
    let failed = |error| OutputError::new(&path, error);
    let mut file = OpenOptions::new().create(true).truncate(false).write(true).open(&path).map_err(failed)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let owner = fs::read_to_string(&path).unwrap_or_default().trim().to_owned();
            return Err(FolderError::Busy { folder: folder.to_owned(), owner });
        }
        // Some network file systems have no locks; their users are on their own.
        Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
        Err(TryLockError::Error(error)) => return Err(failed(error).into()),
    }
    let written = file.set_len(0).and_then(|()| writeln!(file, "process {}", std::process::id()));
    written.map_err(failed)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        Plan { names: vec!["summary.json".to_owned()], ..Plan::new(Writer::Solve) }
    }

    /// The grid before was finished, the finer one is not.
    #[test]
    fn steps_of_a_coarser_grid_alone_are_set_aside_after_a_kill() {
        let place = tempfile::tempdir().unwrap();
        let claim = RunFolder::claim(place.path(), plan()).unwrap();
        for name in ["steps.jsonl", "contact.partial/gap.0001.npy"] {
            let path = claim.staging().join(name);
            make_folder(path.parent().unwrap()).unwrap();
            write_text(&path, "{}\n").unwrap();
        }
        assert_eq!(claim.begin_finer().unwrap(), None);
        assert_eq!(names(&claim.staging()).unwrap(), [MARK, COARSER]);
        drop(claim);
        let again = RunFolder::claim(place.path(), plan()).unwrap();
        let aside = again.set_aside().unwrap();
        assert!(
            ["steps.jsonl", "contact.partial/gap.0001.npy"].iter().all(|name| aside.join(COARSER).join(name).is_file())
        );
        assert_eq!(names(&again.staging()).unwrap(), [MARK]);
    }

    #[test]
    fn steps_that_only_a_summary_tells_of_are_set_aside() {
        let place = tempfile::tempdir().unwrap();
        let claim = RunFolder::claim(place.path(), plan()).unwrap();
        make_folder(&claim.staging().join("contact.partial")).unwrap();
        write_text(&claim.staging().join("summary.json"), "{}\n").unwrap();
        drop(claim);
        let again = RunFolder::claim(place.path(), plan()).unwrap();
        assert!(again.set_aside().is_some_and(|aside| aside.join("summary.json").is_file()));
    }

    /// As a kill leaves them: before the first line, within it, and after the solution of a load is saved.
    #[test]
    fn a_folder_whose_log_has_no_whole_line_is_cleared_and_one_with_a_part_of_a_line_is_cut() {
        for (writer, log) in [(Writer::Solve, "steps.jsonl"), (Writer::Sweep, "sweep.jsonl")] {
            for beside in ["case.toml", "checkpoint.npz", ".checkpoint.npz.17.tmp"] {
                for (begun, left) in [("", None), ("{\"poi", None), ("{}\n{}\n{\"po", Some("{}\n{}\n"))] {
                    let place = tempfile::tempdir().unwrap();
                    let claim = || RunFolder::claim(place.path(), Plan { writer, ..plan() }).unwrap();
                    let first = claim();
                    write_text(&first.staging().join(beside), "content").unwrap();
                    write_text(&first.staging().join(log), begun).unwrap();
                    drop(first);
                    let again = claim();
                    let found = again.set_aside().map(|aside| fs::read_to_string(aside.join(log)).unwrap());
                    assert_eq!(found.as_deref(), left, "{log}: {begun:?} beside {beside}");
                    assert_eq!(names(&again.staging()).unwrap(), [MARK]);
                    if let Some(aside) = again.set_aside() {
                        assert!(!aside.join(".checkpoint.npz.17.tmp").exists());
                    }
                }
            }
        }
    }

    #[test]
    fn a_load_that_is_solved_without_a_finished_step_is_gone_on_with_or_cleared() {
        let place = tempfile::tempdir().unwrap();
        let claim = |resumes| RunFolder::claim(place.path(), Plan { resumes, ..plan() }).unwrap();
        let first = claim(false);
        write_text(&first.staging().join("checkpoint.npz"), "solved").unwrap();
        drop(first);
        assert!(RunFolder::has_solved_alone(place.path()));
        let mut next = claim(true);
        assert!(next.resumes() && next.staging().join("checkpoint.npz").is_file());
        assert_eq!(next.begin_anew().unwrap(), None);
        assert_eq!(names(place.path()).unwrap(), [OWN, "unfinished"]);
        write_text(&next.staging().join("checkpoint.npz"), "solved").unwrap();
        write_text(&next.staging().join("steps.jsonl"), "{}\n").unwrap();
        assert!(!RunFolder::has_solved_alone(place.path()));
    }

    /// Killed between any two of the changes with which a finer grid begins: old coarser steps go, the log first; fields
    /// come, the log last.
    #[test]
    fn steps_on_their_way_aside_when_a_finer_grid_begins_come_there_whole() {
        let fields = ["contact.partial/gap.0001.npy", "stress.partial/p.0001.npy", "stress.0001.vts"];
        for moved in 0..=fields.len() {
            for resumes in [false, true] {
                let place = tempfile::tempdir().unwrap();
                let claim = |resumes| RunFolder::claim(place.path(), Plan { resumes, ..plan() }).unwrap();
                let first = claim(false);
                let write = |name: &str, text: &str| {
                    let path = first.staging().join(name);
                    make_folder(path.parent().unwrap()).unwrap();
                    write_text(&path, text).unwrap();
                };
                make_folder(&first.staging().join(COARSER)).unwrap();
                for (index, name) in fields.iter().enumerate() {
                    if index < moved {
                        write(&format!("{COARSER}/{name}"), "fine");
                    } else {
                        write(name, "fine");
                        // Not yet removed.
                        write(&format!("{COARSER}/{name}"), "coarse");
                    }
                }
                write("steps.jsonl", "{}\n");
                write("checkpoint.npz", "of the finest");
                drop(first);
                let next = claim(resumes);
                let found = next.set_aside().map_or(next.staging(), Path::to_owned);
                assert_eq!(next.set_aside().is_none(), resumes);
                let read = |name: &str| fs::read_to_string(found.join(COARSER).join(name)).unwrap();
                assert!(fields.iter().all(|name| read(name) == "fine"), "{moved} moved");
                assert_eq!(read("steps.jsonl"), "{}\n");
                assert!(!found.join("steps.jsonl").exists() && found.join("checkpoint.npz").is_file());
            }
        }
    }

    #[test]
    fn nothing_is_set_aside_where_no_step_was_finished() {
        let place = tempfile::tempdir().unwrap();
        let claim = RunFolder::claim(place.path(), plan()).unwrap();
        make_folder(&claim.staging().join("contact.partial")).unwrap();
        drop(claim);
        assert_eq!(RunFolder::claim(place.path(), plan()).unwrap().set_aside(), None);
        assert_eq!(names(place.path()).unwrap(), [OWN, "unfinished"]);
    }
}

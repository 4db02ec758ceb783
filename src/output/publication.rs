//! A complete result takes the place of the one before, file by file, so that a kill at any moment loses neither.
//!
//! [`decide`](Publication::decide) puts the list of the new result beside it; from then on the next run completes what
//! this one does not. A file gets a second name in the output folder and keeps the one where it was gathered: until all
//! are in place and listed the whole new result stands there, and then that folder goes in one move.

use super::gathered::{remove_gathered, set_aside};
use super::layout::{DECIDED, FolderError, OWN, foreign, own, retired, staging};
use super::manifest::{Manifest, Scope, Standing, Writer, Written};
use super::{OutputError, disk, make_folder, write_text};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

/// The result a writer has gathered in an output folder.
#[derive(Debug)]
pub(super) struct Publication<'a> {
    folder: &'a Path,
    writer: Writer,
    staging: PathBuf,
}

/// One change that happens at once or not at all.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Action {
    /// A file of the new result takes its place.
    Place(String),
    /// A file of the result before, which the new one does not have, goes.
    Remove(String),
    /// The new list replaces the one before.
    List,
    /// The folder in which the result was gathered goes.
    Retire,
}

impl<'a> Publication<'a> {
    /// Of a writer in an output folder, decided or not.
    pub(super) fn new(folder: &'a Path, writer: Writer) -> Self {
        Self { folder, writer, staging: staging(folder, writer) }
    }

    fn list(&self) -> PathBuf {
        own(self.folder, "written.json")
    }

    /// Lists the gathered files of the planned names as the new result, in the place of the earlier files in `scope`.
    /// Nothing is decided if that fails.
    pub(super) fn decide(&self, planned: &[String], scope: &Scope) -> Result<(), FolderError> {
        let old = Manifest::read(&self.list());
        let others = self.writer.takes_along().iter().filter(|writer| **writer != self.writer);
        let mut new =
            others.fold(old.without(self.writer, scope), |list, &writer| list.without(writer, &Scope::default()));
        let mut folders = BTreeSet::from([self.staging.clone()]);
        for name in planned {
            let [gathered, path] = [self.staging.join(name), self.folder.join(name)];
            if !disk::is_file(&gathered) {
                continue;
            }
            folders.extend(above(name).map(|part| self.staging.join(part)));
            let file = Written::of(&gathered, self.writer).map_err(|error| OutputError::new(&gathered, error))?;
            match foreign(self.standing(&old, name)?) {
                None => new.add(name, file),
                // The same file stays its owner's.
                Some(_) if Written::of(&path, self.writer).is_ok_and(|there| there == file) => {}
                Some(reason) => return Err(FolderError::Foreign { path, reason }),
            }
        }
        // All of it is on the disk before that is decided, and the decision before anything is done about it.
        sync_folders(&folders)?;
        write_text(&self.staging.join(DECIDED), &new.to_json())?;
        Ok(sync_folders(&BTreeSet::from([self.staging.clone()]))?)
    }

    /// Does what is left of a decided publication, and sweeps up after a retired one; where what is not percoat's there
    /// has been moved. Where that fails, the next call goes on.
    pub(super) fn complete(&self) -> Result<Option<PathBuf>, FolderError> {
        let mut aside = None;
        for action in self.actions()? {
            if action == Action::Retire {
                aside = self.sweep()?;
            }
            self.act(&action)?;
        }
        Ok(self.sweep()?.or(aside))
    }

    /// Removes what is percoat's of a retired folder; anything else there is moved aside.
    fn sweep(&self) -> Result<Option<PathBuf>, OutputError> {
        let (retired, list) = (retired(self.folder, self.writer), Manifest::read(&self.list()));
        let own = |name: &str| list.names(self.writer).any(|listed| listed == name);
        if !disk::is_folder(&retired) || remove_gathered(&retired, &own)? {
            Ok(None)
        } else {
            set_aside(&retired, self.folder)
        }
    }

    /// The list of the new result, once it is decided.
    fn decided(&self) -> Option<Manifest> {
        Manifest::at(&self.staging.join(DECIDED)).filter(|_| disk::is_folder(&self.staging))
    }

    fn standing(&self, manifest: &Manifest, name: &str) -> Result<Standing, OutputError> {
        let found = manifest.standing(self.folder, name);
        found.map_err(|error| OutputError::new(&self.folder.join(name), error))
    }

    /// What is left to do, in order: `summary.json` is the last name, and so the last file to come.
    fn actions(&self) -> Result<Vec<Action>, FolderError> {
        let (old, Some(new)) = (Manifest::read(&self.list()), self.decided()) else { return Ok(Vec::new()) };
        let mut actions = Vec::new();
        for name in new.names(self.writer) {
            if self.standing(&new, name)? == Standing::Written || !disk::is_file(&self.staging.join(name)) {
                continue;
            }
            if let Some(reason) = foreign(self.standing(&old, name)?) {
                return Err(FolderError::Foreign { path: self.folder.join(name), reason });
            }
            actions.push(Action::Place(name.to_owned()));
        }
        let earlier = self.writer.takes_along().iter().flat_map(|&writer| old.names(writer));
        for name in earlier.filter(|name| !new.has(name)) {
            // What its owner has changed in the meantime stays.
            if self.standing(&old, name)? == Standing::Written {
                actions.push(Action::Remove(name.to_owned()));
            }
        }
        actions.extend([Action::List, Action::Retire]);
        Ok(actions)
    }

    fn act(&self, action: &Action) -> Result<(), OutputError> {
        match action {
            Action::Place(name) => {
                let path = self.folder.join(name);
                path.parent().map_or(Ok(()), make_folder)?;
                self.place(name, &path).map_err(|error| OutputError::new(&path, error))
            }
            Action::Remove(name) => {
                let path = self.folder.join(name);
                disk::remove(&path).map_err(|error| OutputError::new(&path, error))
            }
            Action::List => {
                let [old, new] = [self.list(), self.staging.join(DECIDED)].map(|path| Manifest::read(&path));
                // What is in its place stays there, and what has gone does not come back.
                let names = self.writer.takes_along().iter().flat_map(|&own| old.names(own).chain(new.names(own)));
                let folders = names.flat_map(above).map(|part| self.folder.join(part)).filter(|part| part.is_dir());
                sync_folders(&folders.chain([self.folder.to_owned()]).collect())?;
                write_text(&self.list(), &new.to_json())?;
                sync_folders(&BTreeSet::from([self.folder.join(OWN)]))
            }
            Action::Retire => {
                let moved = disk::move_to(&self.staging, &retired(self.folder, self.writer));
                moved.map_err(|error| OutputError::new(&self.staging, error))?;
                // A list that is gone ahead of its folder would leave a result that nobody has decided about.
                sync_folders(&BTreeSet::from([self.folder.to_owned(), self.folder.join(OWN)]))
            }
        }
    }

    /// Gives a gathered file its place, by a second name under which it waits for the move.
    fn place(&self, name: &str, path: &Path) -> io::Result<()> {
        let (gathered, second) = (self.staging.join(name), own(self.folder, PLACING));
        if disk::is_file(&second) && self.is_placed(&second) {
            disk::remove(&second)?;
        }
        match disk::link(&gathered, &second) {
            Ok(()) => disk::replace(&second, path),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                let reason = format!("{} is not of percoat: move it away", second.display());
                Err(io::Error::new(io::ErrorKind::AlreadyExists, reason))
            }
            // Where a file cannot have two names it leaves the other place.
            Err(_) => disk::replace(&gathered, path),
        }
    }

    /// Whether a file is one of the decided result.
    fn is_placed(&self, file: &Path) -> bool {
        let decided = self.decided();
        let own = Written::of(file, self.writer).ok();
        decided.zip(own).is_some_and(|(decided, own)| decided.holds(&own))
    }
}

/// The second name of a file that is on its way to its place.
pub(super) const PLACING: &str = "placing";

/// The folders that lead to a name, innermost first, relative to that in which it stands.
fn above(name: &str) -> impl Iterator<Item = &Path> {
    Path::new(name).ancestors().skip(1).filter(|part| *part != Path::new(""))
}

fn sync_folders(folders: &BTreeSet<PathBuf>) -> Result<(), OutputError> {
    folders.iter().try_for_each(|folder| disk::sync_folder(folder).map_err(|error| OutputError::new(folder, error)))
}

#[cfg(test)]
mod tests {
    use super::super::layout::names;
    use super::super::{Plan, RunFolder};
    use super::*;
    use std::collections::BTreeMap;
    use std::fs;

    const PLAN: [&str; 5] = ["case.toml", "curve.csv", "stress.npz", "study/figure.png", "summary.json"];

    fn claim_for(folder: &Path, writer: Writer) -> Result<RunFolder, FolderError> {
        let names = PLAN.map(str::to_owned).to_vec();
        RunFolder::claim(folder, Plan { names, ..Plan::new(writer) })
    }

    fn claim(folder: &Path) -> Result<RunFolder, FolderError> {
        claim_for(folder, Writer::Solve)
    }

    /// A run that has gathered some of the files, each with its content.
    fn gathered_by(writer: Writer, folder: &Path, names: &[&str], content: &str) -> RunFolder {
        let run = claim_for(folder, writer).unwrap();
        for name in names {
            let path = run.staging().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, format!("{name}: {content}")).unwrap();
        }
        run
    }

    fn gathered(folder: &Path, names: &[&str], content: &str) -> RunFolder {
        gathered_by(Writer::Solve, folder, names, content)
    }

    /// Files in a folder, and in the folders of its studies, with their content.
    fn files(folder: &Path) -> BTreeMap<String, String> {
        let within = |place: &str| {
            let names =
                names(&folder.join(place)).unwrap_or_default().into_iter().filter(|name| !name.starts_with('.'));
            names.map(|name| format!("{place}{name}")).collect::<Vec<_>>()
        };
        let names = within("").into_iter().chain(within("study/"));
        names.filter_map(|name| Some((name.clone(), fs::read_to_string(folder.join(name)).ok()?))).collect()
    }

    #[test]
    fn killed_between_any_two_changes_the_old_or_the_new_result_is_whole_and_the_next_run_ends_it() {
        let new = ["case.toml", "curve.csv", "summary.json"];
        let result = |names: &[&str], content: &str| -> BTreeMap<String, String> {
            names.iter().map(|&name| (name.to_owned(), format!("{name}: {content}"))).collect()
        };
        for (writer, moment) in Writer::ALL.into_iter().flat_map(|writer| (0..=6).map(move |moment| (writer, moment))) {
            let folder = tempfile::tempdir().unwrap();
            let folder = folder.path();
            // Studies alone have folders.
            let gone = if writer == Writer::Validate { "study/figure.png" } else { "stress.npz" };
            let old = ["case.toml", gone, "summary.json"];
            gathered_by(writer, folder, &old, "old").publish().unwrap();
            let run = gathered_by(writer, folder, &new, "new");
            let publication = Publication::new(folder, writer);
            publication.decide(&PLAN.map(str::to_owned), &Scope::default()).unwrap();
            let actions = publication.actions().unwrap();
            // Three files to place, one to remove, the list and the folder.
            assert_eq!(actions.len(), 6);
            for action in actions.iter().take(moment) {
                publication.act(action).unwrap();
            }
            let staging = run.staging();
            drop(run);
            let whole = [files(folder), files(&staging)];
            assert!(whole.contains(&result(&new, "new")), "{writer:?} killed at {moment}: {whole:?}");
            assert!(moment > 0 || whole[0] == result(&old, "old"));

            // Whoever comes next ends it.
            for next in Writer::ALL {
                let next = claim_for(folder, next).unwrap();
                assert_eq!(files(folder), result(&new, "new"), "{writer:?} killed at {moment}");
                assert_eq!((next.set_aside(), files(&next.staging()).len()), (None, 0));
            }
            claim_for(folder, writer).unwrap().publish().unwrap();
            assert!(files(folder).is_empty(), "a run without files removes those of the one before");
            assert!(names(folder).unwrap().iter().all(|name| !name.starts_with("interrupted")));
        }
    }

    #[test]
    fn a_result_replaces_the_files_of_its_scope_alone() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        gathered(folder, &["case.toml", "study/figure.png", "summary.json"], "old").publish().unwrap();
        let scope = Scope { within: "study/".to_owned(), except: Vec::new() };
        let plan = Plan { scope, ..Plan::new(Writer::Solve) };
        let mut failed = RunFolder::claim(folder, plan.clone()).unwrap();
        failed.keeps("study/fig".to_owned());
        failed.publish().unwrap();
        assert_eq!(files(folder).len(), 3, "what is kept stays");
        RunFolder::claim(folder, plan).unwrap().publish().unwrap();
        assert_eq!(files(folder).into_keys().collect::<Vec<_>>(), ["case.toml", "summary.json"]);
        let mut renewed = gathered(folder, &["summary.json"], "new");
        renewed.keeps("summary.json".to_owned());
        renewed.publish().unwrap();
        assert_eq!(files(folder)["summary.json"], "summary.json: new", "what is kept can be renewed");
    }

    #[test]
    fn what_its_content_shows_to_be_percoats_is_adopted() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        fs::write(folder.join("case.toml"), "percoat's by its content").unwrap();
        assert!(matches!(claim(folder), Err(FolderError::Foreign { .. })));
        let adopted = vec!["case.toml".to_owned()];
        let plan = Plan { names: adopted.clone(), adopted, ..Plan::new(Writer::Solve) };
        let run = RunFolder::claim(folder, plan).unwrap();
        fs::write(run.staging().join("case.toml"), "new").unwrap();
        run.publish().unwrap();
        assert_eq!(files(folder)["case.toml"], "new");
    }

    #[test]
    fn what_comes_into_the_way_during_a_run_stays_and_the_result_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        gathered(folder, &["case.toml", "stress.npz"], "old").publish().unwrap();
        let run = gathered(folder, &["case.toml", "summary.json"], "new");
        fs::write(run.staging().join("steps.jsonl"), "new\n").unwrap();
        fs::write(folder.join("case.toml"), "mine").unwrap();
        let error = run.publish().unwrap_err().to_string();
        assert!(error.contains("case.toml") && error.contains("changed"), "{error}");
        assert_eq!(files(folder)["case.toml"], "mine");
        assert_eq!(files(folder)["stress.npz"], "stress.npz: old");
        assert_eq!(files(&folder.join("unfinished")).len(), 3);

        // The next run is refused too, and takes nothing.
        assert!(matches!(claim(folder), Err(FolderError::Foreign { .. })));
        assert_eq!(files(&folder.join("unfinished")).len(), 3);
        fs::remove_file(folder.join("case.toml")).unwrap();
        let next = claim(folder).unwrap();
        assert_eq!(files(next.set_aside().unwrap()).len(), 3);
    }

    #[test]
    fn what_somebody_puts_beside_a_result_that_is_gathered_is_neither_published_nor_lost() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let foreign = |staging: &Path| {
            for name in ["mine/x.txt", "2024/case.toml", "contact.partial/notes.txt", "notes.txt"] {
                let path = staging.join(name);
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(path, "mine").unwrap();
            }
        };
        let run = gathered(folder, &["case.toml", "summary.json"], "new");
        foreign(&run.staging());
        assert_eq!(run.publish().unwrap(), Some(folder.join("interrupted-1")));
        assert_eq!(files(folder).len(), 2);
        // Killed before its first step.
        let own =
            ["case.toml", ".curve.csv.17.tmp", "stress.0001.vts", "coarser/curve.csv", "stress.partial/p.0001.npy"];
        let run = gathered(folder, &own, "killed");
        foreign(&run.staging());
        drop(run);
        let next = claim(folder).unwrap();
        assert!(next.set_aside().unwrap().ends_with("interrupted-2"));
        assert!(own.iter().all(|name| !folder.join("interrupted-2").join(name).exists()), "percoat's own is removed");
        for place in ["interrupted-1", "interrupted-2"] {
            for name in ["mine/x.txt", "2024/case.toml", "contact.partial/notes.txt", "notes.txt"] {
                assert_eq!(fs::read_to_string(folder.join(place).join(name)).unwrap(), "mine", "{place}/{name}");
            }
        }
    }

    #[test]
    fn two_runs_do_not_share_a_folder_and_a_dropped_one_lets_it_go() {
        let folder = tempfile::tempdir().unwrap();
        let run = claim(folder.path()).unwrap();
        let Err(error @ FolderError::Busy { .. }) = claim(folder.path()) else { panic!("both have it") };
        assert!(error.to_string().contains(&std::process::id().to_string()), "{error}");
        drop(run);
        claim(folder.path()).unwrap();
    }

    #[test]
    fn a_folder_called_unfinished_that_percoat_did_not_make_is_not_touched() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("unfinished")).unwrap();
        fs::write(folder.path().join("unfinished/thesis.tex"), "mine").unwrap();
        assert!(matches!(claim(folder.path()), Err(FolderError::Foreign { .. })));
        assert_eq!(names(folder.path()).unwrap(), ["unfinished"]);
    }

    #[test]
    fn a_finer_grid_keeps_the_coarser_steps_until_it_is_published() {
        let folder = tempfile::tempdir().unwrap();
        let run = gathered(folder.path(), &["case.toml", "stress.npz"], "coarse");
        run.begin_finer().unwrap();
        assert!(!run.staging().join("coarser").exists(), "no step is done");
        fs::write(run.staging().join("steps.jsonl"), "coarse\n").unwrap();
        run.begin_finer().unwrap();
        assert_eq!(files(&run.staging().join("coarser")).len(), 3);
        fs::write(run.staging().join("steps.jsonl"), "fine\n").unwrap();
        run.begin_finer().unwrap();
        assert_eq!(files(&run.staging().join("coarser"))["steps.jsonl"], "fine\n");
        fs::write(run.staging().join("summary.json"), "finest").unwrap();
        run.publish().unwrap();
        assert_eq!(files(folder.path()), BTreeMap::from([("summary.json".to_owned(), "finest".to_owned())]));
        assert_eq!(names(folder.path()).unwrap(), [".percoat", "summary.json"]);
    }
}

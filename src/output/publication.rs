//! A complete result takes the place of the one before, file by file, so that a kill at any moment loses neither.
//!
//! [`decide`](Publication::decide) puts the list of the new result beside it; from then on the next run completes what
//! this one does not. A file gets a second name in the output folder and keeps the one where it was gathered: until all
//! are in place and listed the whole new result stands there, and then that folder goes in one move.

use super::gathered::{remove_gathered, set_aside};
use super::layout::{FolderError, foreign, own, staging};
use super::manifest::{Manifest, Scope, Standing, Writer, Written};
use super::{OutputError, write_text};
use std::fs;
use std::path::{Path, PathBuf};

/// The list of a result that is to be published, beside its files.
const DECIDED: &str = ".publish.json";

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
        for name in planned {
            let [gathered, path] = [self.staging.join(name), self.folder.join(name)];
            if !gathered.is_file() {
                continue;
            }
            let file = Written::of(&gathered, self.writer).map_err(|error| OutputError::new(&gathered, error))?;
            match foreign(self.standing(&old, name)?) {
                None => new.add(name, file),
                // The same file stays its owner's.
                Some(_) if Written::of(&path, self.writer).is_ok_and(|there| there == file) => {}
                Some(reason) => return Err(FolderError::Foreign { path, reason }),
            }
        }
        Ok(write_text(&self.staging.join(DECIDED), &new.to_json())?)
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
        let (retired, list) = (self.retired(), Manifest::read(&self.list()));
        let own = |name: &str| name == DECIDED || list.names(self.writer).any(|listed| listed == name);
        if remove_gathered(&retired, self.writer, &own)? { Ok(None) } else { set_aside(&retired, self.folder) }
    }

    fn retired(&self) -> PathBuf {
        let name = match self.writer {
            Writer::Solve => "retired",
            Writer::Check => "retired-check",
            Writer::Compare => "retired-compare",
            Writer::Limit => "retired-limit",
            Writer::Validate => "retired-validate",
            Writer::Sweep => "retired-sweep",
            Writer::Report => "retired-report",
        };
        own(self.folder, name)
    }

    fn standing(&self, manifest: &Manifest, name: &str) -> Result<Standing, OutputError> {
        let found = manifest.standing(self.folder, name);
        found.map_err(|error| OutputError::new(&self.folder.join(name), error))
    }

    /// What is left to do, in order: `summary.json` is the last name, and so the last file to come.
    fn actions(&self) -> Result<Vec<Action>, FolderError> {
        let decided = self.staging.join(DECIDED);
        if !decided.is_file() {
            return Ok(Vec::new());
        }
        let [old, new] = [self.list(), decided].map(|path| Manifest::read(&path));
        let mut actions = Vec::new();
        for name in new.names(self.writer) {
            if self.standing(&new, name)? == Standing::Written || !self.staging.join(name).is_file() {
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
                let [gathered, path] = [self.staging.join(name), self.folder.join(name)];
                let second = own(self.folder, "placing");
                let place = || {
                    path.parent().map_or(Ok(()), fs::create_dir_all)?;
                    if second.exists() {
                        fs::remove_file(&second)?;
                    }
                    // Where a file cannot have two names it leaves the other place.
                    match fs::hard_link(&gathered, &second) {
                        Ok(()) => fs::rename(&second, &path),
                        Err(_) => fs::rename(&gathered, &path),
                    }
                };
                place().map_err(|error| OutputError::new(&path, error))
            }
            Action::Remove(name) => {
                let path = self.folder.join(name);
                fs::remove_file(&path).map_err(|error| OutputError::new(&path, error))
            }
            Action::List => write_text(&self.list(), &Manifest::read(&self.staging.join(DECIDED)).to_json()),
            Action::Retire => {
                let retired = self.retired();
                fs::rename(&self.staging, &retired).map_err(|error| OutputError::new(&self.staging, error))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::names;
    use super::super::{Plan, RunFolder};
    use super::*;
    use std::collections::BTreeMap;

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
            for name in ["mine/x.txt", "contact.partial/notes.txt", "notes.txt"] {
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
            for name in ["mine/x.txt", "contact.partial/notes.txt", "notes.txt"] {
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

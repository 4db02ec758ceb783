//! Publication: a complete result in a staging folder replaces the earlier one.
//!
//! 1. *Gathered*: the staging folder has every file, `written.json` lists the old result. Nothing is decided.
//! 2. *Decided*: `.publish.json` beside the files lists those of this command to come, kept and new ones. From here on any run
//!    that claims the folder completes what this one does not.
//! 3. *Placed*: every staged file of that list has its place, and every unchanged file of this command's earlier result that has
//!    no successor is gone. An old file is removed before the new one is linked, so that for a moment neither is there. A rename
//!    has no such moment, but would overwrite a file that a user puts there just then.
//! 4. *Listed*: `written.json` has these files beside those of other commands.
//! 5. *Retired*: the staging folder has gone to `.percoat/retired` in one move, and is removed there.
//!
//! Each step can be repeated after a kill. Foreign files in the way are refused before the first change. A file is placed by a
//! second name (hard link), so that the new result is complete in the staging folder until it is listed; without hard links
//! the files are moved one by one. The disk is synced before each step.

use super::error::AtPath;
use super::files::{FileRecord, Ownership, parents};
use super::folder_error::FolderError;
use super::layout::{DECIDED, LIST, OWN, is_staging};
use super::manifest::{self, published};
use super::plan::Plan;
use super::staging::discard;
use super::writer::Writer;
use super::{OutputError, disk, make_folder};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};

/// Writes the list of the new result, the staged files of the planned names. On failure nothing is decided.
pub(super) fn decide(folder: &Path, plan: &Plan) -> Result<(), FolderError> {
    let (staging, writer, old) = (plan.writer.staging(folder), plan.writer.listed(), published(folder));
    let mut new = old.clone().filtered(|name, by| by == writer && !plan.replaces(name, by));
    let staged = |name: &&String| disk::is_file(&staging.join(name));
    for name in plan.names.iter().filter(staged) {
        let [gathered, path] = [&staging, folder].map(|place| place.join(name));
        let file = FileRecord::of(&gathered, writer).at(&gathered)?;
        match old.ownership(folder, name).at(&path)?.refusal() {
            None => new.insert(name, file),
            // A user's file of equal content stays the user's.
            Some(_) if FileRecord::of(&path, writer).is_ok_and(|there| there == file) => {}
            Some(reason) => return Err(FolderError::Foreign { path, reason }),
        }
    }
    sync_folders(&staging, plan.names.iter().map(String::as_str))?;
    manifest::write(&staging.join(DECIDED), new)?;
    Ok(disk::sync_folder(&staging).at(&staging)?)
}

/// Completes a publication that was decided; after a failure the next call continues. Returns the folder to which the staging
/// folder was moved if it has foreign files.
pub(super) fn complete(folder: &Path, writer: Writer) -> Result<Option<PathBuf>, FolderError> {
    let staging = writer.staging(folder);
    let decided = manifest::read(&staging.join(DECIDED)).filter(|_| disk::is_folder(&staging) && is_staging(&staging));
    let (old, Some(decided)) = (published(folder), decided) else { return Ok(None) };
    let new = decided.filtered(|_, by| by == writer.listed());
    let goes = |by: Writer| by == writer.listed() || writer.outdates(by);
    let mut waiting = Vec::new();
    for name in new.names().filter(|name| disk::is_file(&staging.join(name))) {
        let path = folder.join(name);
        if new.ownership(folder, name).at(&path)? == Ownership::AsWritten {
            continue;
        }
        let before = old.ownership(folder, name).at(&path)?;
        if let Some(reason) = before.refusal() {
            return Err(FolderError::Foreign { path, reason });
        }
        waiting.push((name, before));
    }
    for (name, before) in waiting {
        let path = folder.join(name);
        path.parent().map_or(Ok(()), make_folder)?;
        place(&staging.join(name), &path, before).at(&path)?;
    }
    // A file changed in the meantime stays.
    for name in old.clone().filtered(|name, by| goes(by) && !new.has(name)).as_written(folder)? {
        disk::remove(&folder.join(name)).at(&folder.join(name))?;
    }
    // New names and removals are on the disk before the list.
    sync_folders(folder, old.names().chain(new.names()))?;
    // What another command has listed in the meantime stays listed: not every file system keeps the lock.
    let mut list = published(folder).filtered(|_, by| !goes(by));
    list.append(new);
    manifest::write(&folder.join(LIST), list)?;
    disk::sync_folder(&folder.join(OWN)).at(folder)?;
    Ok(discard(&staging, folder)?)
}

/// Places a staged file at a path where nothing stands or a file of percoat.
fn place(staged: &Path, path: &Path, before: Ownership) -> io::Result<()> {
    if before == Ownership::AsWritten {
        disk::remove(path)?;
    }
    match disk::link(staged, path) {
        // Without hard links the file is moved.
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => disk::move_to(staged, path),
        linked => linked,
    }
}

/// Syncs the names in a folder, and in the parent folders of `names` below it.
fn sync_folders<'a>(folder: &Path, names: impl Iterator<Item = &'a str>) -> Result<(), OutputError> {
    let below: BTreeSet<PathBuf> = names.flat_map(parents).map(|part| folder.join(part)).collect();
    let there = below.iter().map(PathBuf::as_path).filter(|folder| disk::is_folder(folder));
    there.chain([folder]).try_for_each(|folder| disk::sync_folder(folder).at(folder))
}

#[cfg(test)]
mod tests {
    use super::super::layout::names;
    use super::super::{RunFolder, write_text};
    use super::*;
    use std::collections::BTreeMap;
    use std::fs;

    const PLAN: [&str; 6] =
        ["case.toml", "curve.csv", "stress.0001.vts", "stress.npz", "study/figure.png", "summary.json"];

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
            make_folder(path.parent().unwrap()).unwrap();
            write_text(&path, &format!("{name}: {content}")).unwrap();
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
    fn a_result_replaces_the_files_of_its_scope_alone() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        gathered(folder, &["case.toml", "study/figure.png", "summary.json"], "old").publish().unwrap();
        let plan = Plan { within: "study/".to_owned(), ..Plan::new(Writer::Solve) };
        let mut failed = RunFolder::claim(folder, plan.clone()).unwrap();
        failed.keep("study/fig".to_owned());
        failed.publish().unwrap();
        assert_eq!(files(folder).len(), 3, "what is kept stays");
        RunFolder::claim(folder, plan).unwrap().publish().unwrap();
        assert_eq!(files(folder).into_keys().collect::<Vec<_>>(), ["case.toml", "summary.json"]);
        let mut renewed = gathered(folder, &["summary.json"], "new");
        renewed.keep("summary.json".to_owned());
        renewed.publish().unwrap();
        assert_eq!(files(folder)["summary.json"], "summary.json: new", "what is kept can be renewed");
    }

    /// Two commands that write at once, as on a file system without locks.
    #[test]
    fn what_another_command_lists_in_the_meantime_stays_listed() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path();
        gathered(folder, &["case.toml"], "old").publish().unwrap();
        let run = gathered(folder, &["case.toml", "summary.json"], "new");
        let plan = Plan { names: PLAN.map(str::to_owned).to_vec(), ..Plan::new(Writer::Solve) };
        decide(folder, &plan).unwrap();
        let other = folder.join("limit.json");
        fs::write(&other, "limit").unwrap();
        let mut list = published(folder);
        list.insert("limit.json", FileRecord::of(&other, Writer::Limit).unwrap());
        manifest::write(&folder.join(LIST), list).unwrap();
        complete(folder, Writer::Solve).unwrap();
        drop(run);
        assert_eq!(published(folder).names().collect::<Vec<_>>(), ["case.toml", "limit.json", "summary.json"]);
        assert_eq!(files(folder).len(), 3);
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

        // The next run is refused too, and changes nothing.
        assert!(matches!(claim(folder), Err(FolderError::Foreign { .. })));
        assert_eq!(files(&folder.join("unfinished")).len(), 3);
        fs::remove_file(folder.join("case.toml")).unwrap();
        let next = claim(folder).unwrap();
        assert_eq!(files(next.set_aside().unwrap()).len(), 3);
    }

    #[test]
    fn foreign_files_in_a_staging_folder_are_neither_published_nor_lost() {
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
        let gathered_names =
            ["case.toml", ".curve.csv.17.tmp", "stress.0001.vts", "coarser/curve.csv", "stress.partial/p.0001.npy"];
        let run = gathered(folder, &gathered_names, "killed");
        foreign(&run.staging());
        drop(run);
        let next = claim(folder).unwrap();
        assert!(next.set_aside().unwrap().ends_with("interrupted-2"));
        assert!(
            gathered_names.iter().all(|name| !folder.join("interrupted-2").join(name).exists()),
            "percoat's own is removed"
        );
        for place in ["interrupted-1", "interrupted-2"] {
            for name in ["mine/x.txt", "2024/case.toml", "contact.partial/notes.txt", "notes.txt"] {
                assert_eq!(fs::read_to_string(folder.join(place).join(name)).unwrap(), "mine", "{place}/{name}");
            }
        }
    }

    /// Commands without resume gather files that the same command makes again; a run, a sweep and a life keep what they have solved.
    #[test]
    fn a_killed_command_without_resume_leaves_nothing_once_the_same_command_is_run_again() {
        for writer in Writer::all() {
            let place = tempfile::tempdir().unwrap();
            let folder = place.path();
            let names = ["study/figure.png", "summary.json"];
            let killed = gathered_by(writer, folder, &names, "killed");
            for name in ["study/.figure.png.17.tmp", "sweep.jsonl"] {
                fs::write(killed.staging().join(name), "begun\n").unwrap();
            }
            drop(killed);
            let next = claim_for(folder, writer).unwrap();
            assert_eq!(next.set_aside().is_some(), writer.is_resumable(), "{writer:?}");
            assert_eq!(next.abandon().unwrap(), None);
            assert!(!writer.staging(folder).exists(), "{writer:?}");
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

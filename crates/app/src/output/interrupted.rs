//! The staging folder of an interrupted run, and the steps on a coarser grid.

use super::error::AtPath;
use super::layout::{ARCHIVES, COARSER, LIFE_STATE, MARK, SWEEP_LOG, is_staging, partial};
use super::log::{cut, has_whole_line};
use super::staging::{Entry, entries, remove_or_set_aside, remove_own};
use super::writer::Writer;
use super::{OutputError, checkpoint, disk, steps_log};
use std::path::{Path, PathBuf};

/// Whether a staging folder has a finished step or a checkpoint, on any grid.
pub fn has_begun(staging: &Path) -> bool {
    has_finished(staging) || disk::is_file(&staging.join(checkpoint::NAME))
}

/// Whether an interrupted `solve` into a folder has a checkpoint and no finished step: nothing to set aside, but a run of this
/// case can be resumed.
pub fn has_solved_alone(folder: &Path) -> bool {
    let staging = Writer::Solve.staging(folder);
    disk::is_folder(&staging) && is_staging(&staging) && has_begun(&staging) && !has_finished(&staging)
}

/// Size of the staging folder of an interrupted `solve`, bytes.
pub fn staged_bytes(folder: &Path) -> u64 {
    let entries = entries(&Writer::Solve.staging(folder)).unwrap_or_default();
    entries.iter().filter(|entry| entry.there.is_file()).map(|entry| entry.there.len()).sum()
}

/// The folder of the steps on a coarser grid in a staging folder; `None` where there is none.
pub fn coarser(staging: &Path) -> Option<PathBuf> {
    Some(staging.join(COARSER)).filter(|path| disk::is_folder(path))
}

/// Whether a step or a combination is finished, on the present grid or a coarser one.
pub(super) fn has_finished(staging: &Path) -> bool {
    has_steps(staging) || coarser(staging).is_some_and(|coarser| has_steps(&coarser))
}

/// Whether a step is finished on the grid of a folder: its log has a whole line, or there is a summary, which earlier versions
/// wrote after every step in place of a log, or the state of a life.
pub(super) fn has_steps(folder: &Path) -> bool {
    [steps_log::NAME, SWEEP_LOG].iter().any(|name| has_whole_line(&folder.join(name)))
        || [LIFE_STATE, "summary.json"].iter().any(|name| disk::is_file(&folder.join(name)))
}

/// Repairs a staging folder: removes temporary files, cuts logs after their last whole line, and completes an interrupted move
/// to `coarser/`. Every item of percoat must be of the right kind.
pub(super) fn settle(staging: &Path) -> Result<(), OutputError> {
    let [log, coarser_log] = [staging, &staging.join(COARSER)].map(|folder| folder.join(steps_log::NAME));
    if coarser(staging).is_some() && !disk::is_file(&coarser_log) && disk::is_file(&log) {
        move_steps(staging)?;
    }
    for entry in entries(staging)?.iter().filter(|entry| entry.is_temporary()) {
        let path = staging.join(&entry.path);
        disk::remove(&path).at(&path)?;
    }
    [log, coarser_log, staging.join(SWEEP_LOG)].iter().try_for_each(|log| cut(log))
}

/// Removes the fields of a grid without a finished step. Returns the folder to which foreign files there were moved.
pub(super) fn remove_fields(staging: &Path, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    let mut aside = None;
    for name in ARCHIVES {
        aside = remove_or_set_aside(staging, &partial(name), output)?.or(aside);
    }
    Ok(aside)
}

/// Moves finished steps to `coarser/`, where they replace those of the grid before. Returns the folder to which foreign files
/// there were moved.
pub(super) fn move_to_coarser(staging: &Path, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    // The checkpoint that begins the finer grid is on the disk before.
    disk::sync_folder(staging).at(staging)?;
    let coarser = staging.join(COARSER);
    // A folder without a log is an interrupted move, see `settle`.
    let log = coarser.join(steps_log::NAME);
    if disk::is_file(&log) {
        disk::remove(&log).and_then(|()| disk::sync_folder(&coarser)).at(&log)?;
    }
    let aside = remove_or_set_aside(staging, COARSER, output)?;
    disk::create_folder(&coarser).at(&coarser)?;
    move_steps(staging)?;
    Ok(aside)
}

/// Moves the steps of a grid to `coarser/`, the log last, after the files that it lists.
fn move_steps(staging: &Path) -> Result<(), OutputError> {
    let coarser = staging.join(COARSER);
    let settled = || disk::sync_folder(&coarser).and_then(|()| disk::sync_folder(staging)).at(&coarser);
    let stays = [MARK, checkpoint::NAME, steps_log::NAME, COARSER].map(Path::new);
    let moves = |entry: &&Entry| {
        let is_at_top = entry.path.iter().count() == 1 && !stays.contains(&entry.path.as_path());
        is_at_top && entry.is_own() && !entry.is_temporary()
    };
    for Entry { path: name, there, .. } in entries(staging)?.iter().filter(moves) {
        let (path, to) = (staging.join(name), coarser.join(name));
        if there.is_file() {
            disk::replace(&path, &to).at(&path)?;
        } else {
            // Remaining files of the grid before.
            remove_own(staging, &format!("{COARSER}/{}", name.display()))?;
            disk::move_to(&path, &to).at(&path)?;
        }
    }
    settled()?;
    let log = staging.join(steps_log::NAME);
    disk::replace(&log, &coarser.join(steps_log::NAME)).at(&log)?;
    settled()
}

#[cfg(test)]
mod tests {
    use super::super::layout::{OWN, names};
    use super::super::{Plan, RunFolder, Writer, make_folder, write_text};
    use super::*;
    use std::fs;

    fn plan() -> Plan {
        let names = ["case.toml", "stress.0001.vts", "summary.json"].map(str::to_owned).to_vec();
        Plan { names, ..Plan::new(Writer::Solve) }
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
    fn steps_that_a_summary_alone_records_are_set_aside() {
        let place = tempfile::tempdir().unwrap();
        let claim = RunFolder::claim(place.path(), plan()).unwrap();
        make_folder(&claim.staging().join("contact.partial")).unwrap();
        write_text(&claim.staging().join("summary.json"), "{}\n").unwrap();
        drop(claim);
        let again = RunFolder::claim(place.path(), plan()).unwrap();
        assert!(again.set_aside().is_some_and(|aside| aside.join("summary.json").is_file()));
    }

    /// Folders as a kill leaves them: before the first line, within it, and after the solution of a load is saved.
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
        assert!(has_solved_alone(place.path()));
        let mut next = claim(true);
        assert!(next.resumes() && next.staging().join("checkpoint.npz").is_file());
        assert_eq!(next.begin_anew().unwrap(), None);
        assert_eq!(names(place.path()).unwrap(), [OWN, "unfinished"]);
        write_text(&next.staging().join("checkpoint.npz"), "solved").unwrap();
        write_text(&next.staging().join("steps.jsonl"), "{}\n").unwrap();
        assert!(!has_solved_alone(place.path()));
    }

    #[test]
    fn a_run_that_goes_on_may_write_more_files_than_the_interrupted_one() {
        let place = tempfile::tempdir().unwrap();
        let claim = |names: [&str; 2]| {
            let names = names.map(str::to_owned).to_vec();
            RunFolder::claim(place.path(), Plan { names, resumes: true, ..plan() }).unwrap()
        };
        let first = claim(["old.png", "summary.json"]);
        for (name, text) in [("old.png", "drawn"), ("steps.jsonl", "{}\n")] {
            write_text(&first.staging().join(name), text).unwrap();
        }
        drop(first);
        let next = claim(["new.png", "summary.json"]);
        assert!(next.resumes() && next.staging().join("old.png").is_file());
        for name in ["new.png", "summary.json"] {
            write_text(&next.staging().join(name), "new").unwrap();
        }
        assert_eq!(next.publish().unwrap(), None, "nothing is a user's");
        assert_eq!(names(place.path()).unwrap(), [OWN, "new.png", "summary.json"]);
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

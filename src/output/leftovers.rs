//! What a run that was killed has left where its result is gathered, and the steps that a finer grid leaves behind.

use super::gathered::{is_moved, is_partial, remove_own, remove_temporary, remove_waiting, set_aside};
use super::layout::{COARSER, SWEEP_LOG, names};
use super::{OutputError, checkpoint, disk, steps_log};
use std::path::{Path, PathBuf};

/// Whether anything has been solved, be it a load of which nothing is read off yet.
pub(super) fn has_begun(staging: &Path) -> bool {
    has_finished(staging) || disk::is_file(&staging.join(checkpoint::NAME))
}

/// Whether a step or a combination has been finished where a result is gathered, on its grid or a coarser one.
pub(super) fn has_finished(staging: &Path) -> bool {
    let coarser = staging.join(COARSER);
    has_steps(staging) || disk::is_folder(&coarser) && has_steps(&coarser)
}

/// Whether steps have been finished on one grid: its log has a whole line. A summary is one too: earlier versions of percoat
/// wrote it after every step, and no log.
pub(super) fn has_steps(folder: &Path) -> bool {
    [steps_log::NAME, SWEEP_LOG].iter().any(|name| steps_log::has_whole_line(&folder.join(name)))
        || disk::is_file(&folder.join("summary.json"))
}

/// Puts in order what a run that was killed has left where its result is gathered: files that were being written go, logs
/// end with their last whole line, and steps of a coarser grid that were on the way to `coarser/` come there.
pub(super) fn settle(staging: &Path) -> Result<(), OutputError> {
    let coarser = staging.join(COARSER);
    let log = |folder: &Path| disk::is_file(&folder.join(steps_log::NAME));
    if disk::is_folder(&coarser) && !log(&coarser) && log(staging) {
        move_steps(staging, &coarser)?;
    }
    for folder in [staging, &coarser].into_iter().filter(|folder| disk::is_folder(folder)) {
        remove_temporary(folder)?;
        for name in [steps_log::NAME, SWEEP_LOG] {
            steps_log::cut(&folder.join(name))?;
        }
    }
    Ok(())
}

/// Moves the steps of a grid to `coarser/`, in the place of those of one before. What somebody else has put there is moved
/// aside in the output folder: where to.
pub(super) fn move_aside(staging: &Path, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |error| OutputError::new(&path, error)
    };
    // That the finer grid has begun is saved before.
    disk::sync_folder(staging).map_err(failed(staging))?;
    let coarser = staging.join(COARSER);
    // A folder without a log is one on its way, see `settle`.
    let log = coarser.join(steps_log::NAME);
    if disk::is_file(&log) {
        disk::remove(&log).and_then(|()| disk::sync_folder(&coarser)).map_err(failed(&log))?;
    }
    let aside = if remove_own(&coarser, &|_| false)? { None } else { set_aside(&coarser, output)? };
    disk::create_folder(&coarser).map_err(failed(&coarser))?;
    move_steps(staging, &coarser)?;
    Ok(aside)
}

/// Removes fields of a grid on which no step was finished. What somebody else has put there is moved aside in the output
/// folder: where to.
pub(super) fn remove_begun(staging: &Path, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    let mut aside = None;
    for name in names(staging)?.iter().filter(|name| is_partial(name)) {
        let partial = staging.join(name);
        if !remove_waiting(&partial)? {
            aside = set_aside(&partial, output)?;
        }
    }
    Ok(aside)
}

/// Moves the steps of a grid where those of the coarser one stand, the log as the last: what it lists is there when it comes.
fn move_steps(staging: &Path, coarser: &Path) -> Result<(), OutputError> {
    let both = || [coarser, staging].into_iter().try_for_each(disk::sync_folder);
    let settled = |done: std::io::Result<()>| done.map_err(|error| OutputError::new(coarser, error));
    for name in names(staging)?.iter().filter(|name| is_moved(name)) {
        let (path, to) = (staging.join(name), coarser.join(name));
        // What a grid before has left there.
        if is_partial(name) {
            remove_waiting(&to)?;
        }
        let moved = if disk::is_folder(&path) { disk::move_to(&path, &to) } else { disk::replace(&path, &to) };
        moved.map_err(|error| OutputError::new(&path, error))?;
    }
    settled(both())?;
    let log = staging.join(steps_log::NAME);
    disk::replace(&log, &coarser.join(steps_log::NAME)).map_err(|error| OutputError::new(&log, error))?;
    settled(both())
}

#[cfg(test)]
mod tests {
    use super::super::layout::{MARK, OWN};
    use super::super::{Plan, RunFolder, Writer, make_folder, write_text};
    use super::*;
    use std::fs;

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

//! Publications that a kill or a power cut ends at any moment.

use super::image::{self, Image, laid};
use super::journal::Journal;
use crate::output::layout::DECIDED;
use crate::output::{Plan, RunFolder, Writer, disk, make_folder, publication, write_text};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const PLAN: [&str; 5] = ["case.toml", "curve.csv", "stress.npz", "study/figure.png", "summary.json"];

fn claim(folder: &Path, writer: Writer) -> RunFolder {
    RunFolder::claim(folder, Plan { names: PLAN.map(str::to_owned).to_vec(), ..Plan::new(writer) }).unwrap()
}

/// A run that has gathered some of the files, each with its content.
fn gathered(folder: &Path, writer: Writer, names: &[&str], content: &str) -> RunFolder {
    let run = claim(folder, writer);
    for name in names {
        let path = run.staging().join(name);
        make_folder(path.parent().unwrap()).unwrap();
        write_text(&path, &format!("{name}: {content}")).unwrap();
    }
    run
}

/// Names and contents of the files of a command, as [`gathered`] reads them.
fn expected(names: &[&str], content: &str) -> BTreeMap<String, String> {
    names.iter().map(|&name| (name.to_owned(), format!("{name}: {content}"))).collect()
}

/// Files in a folder, and in that of a study in it, with their content.
fn files(folder: &Path) -> BTreeMap<String, String> {
    let image = if disk::is_folder(folder) { image::read(folder) } else { Image::new() };
    let file = |(path, content): (PathBuf, Option<Vec<u8>>)| {
        let is_result = path.iter().count() == 1 || path.starts_with("study");
        let name = path.to_str().filter(|name| is_result && !name.starts_with('.'))?;
        Some((name.to_owned(), String::from_utf8(content?).unwrap()))
    };
    image.into_iter().filter_map(file).collect()
}

/// States that a kill may leave of a publication that replaces files of the `old` names by those of the `new` ones.
fn killed(writer: Writer, old: &[&str], new: &[&str], has_links: bool) -> Vec<Image> {
    let place = tempfile::tempdir().unwrap();
    let journal = Journal::begin(place.path());
    journal.lock().unwrap().has_links = has_links;
    gathered(place.path(), writer, old, "old").publish().unwrap();
    let run = gathered(place.path(), writer, new, "new");
    journal.lock().unwrap().kills = Some(Vec::new());
    run.publish().unwrap();
    Journal::end(&journal);
    journal.lock().unwrap().kills.take().unwrap()
}

/// States that a power cut may leave of a folder in which a result of `old` names is replaced by one of `new` names.
fn cut(writer: Writer, old: &[&str], new: &[&str], ignores_syncs: bool) -> Vec<Image> {
    let place = tempfile::tempdir().unwrap();
    let journal = Journal::begin(place.path());
    gathered(place.path(), writer, old, "old").publish().unwrap();
    {
        let mut journal = journal.lock().unwrap();
        journal.settle();
        journal.ignores_syncs = ignores_syncs;
    }
    gathered(place.path(), writer, new, "new").publish().unwrap();
    Journal::end(&journal);
    std::mem::take(&mut journal.lock().unwrap().images)
}

#[test]
fn killed_after_any_change_the_old_or_the_new_result_is_whole_and_the_next_run_ends_it() {
    let new = ["case.toml", "curve.csv", "summary.json"];
    let commands = Writer::all();
    for (writer, has_links) in commands.into_iter().flat_map(|writer| [(writer, true), (writer, false)]) {
        // Studies alone have folders.
        let gone = if writer == Writer::Validate { "study/figure.png" } else { "stress.npz" };
        let old = ["case.toml", gone, "summary.json"];
        let kills = killed(writer, &old, &new, has_links);
        let (old, new) = (expected(&old, "old"), expected(&new, "new"));
        assert!(kills.len() > 20, "{} changes", kills.len());
        for (moment, image) in kills.iter().enumerate() {
            let (place, what) = (laid(image), format!("{writer:?} killed after change {moment}"));
            let folder = place.path();
            let whole = [files(folder), files(&writer.staging(folder))];
            let is_decided = disk::is_file(&writer.staging(folder).join(DECIDED));
            if has_links {
                assert!(whole[0] == old || whole.contains(&new), "{what}: {whole:?}");
            } else {
                // Each file that has left the staging folder has come to its place.
                let moved = new.iter().all(|file| whole.iter().any(|place| place.get(file.0) == Some(file.1)));
                assert!(whole[0] == old || moved, "{what}: {whole:?}");
            }

            // The next run completes it, with any command.
            let other = commands[moment % commands.len()];
            for next in [other, writer] {
                let next = claim(folder, next);
                let found = files(folder);
                assert!(found == new || !is_decided && found == old, "{what}: {found:?}");
                let is_ended = is_decided || whole[0] == new;
                assert!(!is_ended || next.set_aside().is_none(), "{what}: {:?}", next.set_aside());
                assert_eq!(files(&next.staging()).len(), 0);
            }
            claim(folder, writer).publish().unwrap();
            assert!(files(folder).is_empty(), "a run without files removes those of the one before");
            let left =
                image::read(folder).into_keys().filter(|path| path.extension().is_some_and(|ending| ending == "tmp"));
            assert_eq!(left.collect::<Vec<_>>(), Vec::<PathBuf>::new(), "{what}");
        }
    }
}

#[test]
fn a_power_cut_while_a_result_is_published_leaves_the_old_one_or_the_new_one_whole() {
    let old = ["case.toml", "study/figure.png", "summary.json"];
    let new = ["case.toml", "curve.csv", "summary.json"];
    let wanted = [expected(&old, "old"), expected(&new, "new")];
    for writer in Writer::all() {
        let images = cut(writer, &old, &new, false);
        assert!(images.len() > 50, "{} images", images.len());
        let mut ends = [0; 2];
        for image in &images {
            let place = laid(image);
            // The next run can claim the folder and finds one whole result.
            let next = claim(place.path(), writer);
            let found = files(place.path());
            let end = wanted.iter().position(|result| *result == found);
            ends[end.unwrap_or_else(|| panic!("{writer:?}: {found:?} of {image:#?}"))] += 1;
            drop(next);
            gathered(place.path(), writer, &["summary.json"], "newest").publish().unwrap();
            assert_eq!(files(place.path()), expected(&["summary.json"], "newest"));
        }
        assert!(ends.iter().all(|count| *count > 0), "{ends:?}");
    }
}

#[test]
fn were_nothing_brought_to_the_disk_results_would_be_lost() {
    let (old, new) = (["case.toml", "summary.json"], ["curve.csv", "summary.json"]);
    let wanted = [expected(&old, "old"), expected(&new, "new")];
    let lost = cut(Writer::Solve, &old, &new, true).iter().any(|image| {
        let place = laid(image);
        // A list that is empty decides nothing.
        let completed = publication::complete(place.path(), Writer::Solve);
        completed.is_err() || !wanted.contains(&files(place.path()))
    });
    assert!(lost, "without syncing something is lost");
}

//! `percoat cases`, and every file of `cases/` through the command line.

use crate::program::{Desk, number};
use percoat::case::{Case, Source};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Name and path of every file in `cases/`.
fn files() -> Vec<(String, PathBuf)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), path))
        .collect();
    files.sort();
    files
}

#[test]
fn the_list_names_every_file_and_its_title() {
    let answer = Desk::new().percoat(&["cases"]);
    assert_eq!(answer.code, 0);
    let listed: BTreeSet<&str> = answer.out.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let files = files();
    assert_eq!(listed, files.iter().map(|(name, _)| name.as_str()).collect());
    for (name, path) in &files {
        let title = Case::read(&Source::file(path).unwrap(), &[]).unwrap().title;
        let line = answer.out.lines().find(|line| line.starts_with(name.as_str())).unwrap();
        assert!(!title.is_empty() && line.contains(&title), "{line}");
    }
    assert!(answer.out.lines().any(|line| line.starts_with("fig2 ") && line.contains("(default)")));
}

#[test]
fn a_case_is_printed_byte_for_byte() {
    let desk = Desk::new();
    for (name, path) in files() {
        let answer = desk.percoat(&["cases", &name]);
        assert_eq!((answer.code, answer.err.as_str()), (0, ""));
        assert!(answer.out.as_bytes() == fs::read(&path).unwrap(), "{name} is printed with changes");
    }
}

/// At the first and the last of its loads.
#[test]
fn every_case_runs() {
    let desk = Desk::new();
    for (name, path) in files() {
        let case = Case::read(&Source::file(&path).unwrap(), &[]).unwrap();
        let values = case.load.values();
        let ends: Vec<f64> = [&values[..1], &values[values.len() - 1..]].concat();
        let loads = format!("load.{}={ends:?}", case.load.quantity());
        // A given pressure is one load.
        let is_given = case.problem().kind().is_given;
        // A contact that sticks has its own steps, and so have loads in time, which begin without any.
        let has_own = case.tangential.is_some() || case.time.is_some();
        let set = if is_given || has_own { vec![] } else { vec!["--set", &loads] };
        let folder = desk.solve(&name, &[&[path.to_str().unwrap(), "--set", "grid.points=48"], &set[..]].concat());
        let steps = folder.steps();
        let count = if has_own { case.step_count() } else { 2 };
        assert_eq!(steps.len(), if is_given { 1 } else { count }, "{name}");
        for (index, step) in steps.iter().enumerate() {
            assert_eq!(step["converged"], true, "{name}");
            // Surfaces that adhere may have come apart at the end.
            let is_pressed = number(step, "/penetration") > 0.0 && number(step, "/contact_area") > 0.0;
            let is_free = if index == 0 { case.time.is_some() } else { case.adhesion.is_some() };
            assert!(is_pressed || is_free, "{name}");
        }
    }
}

//! The studies of `percoat validate`, each as a test in its quick form, and what stands beside them in `validation/`.
//!
//! `cargo test --test validation -- --include-ignored` runs the whole of those that have a quick form, too.

#![cfg(feature = "validate")]

use percoat::validation::paper::table;
use percoat::validation::{Check, Outcome, Report, STUDIES, Study, contradictions, differences, find};
use std::fs;
use std::path::PathBuf;

/// Runs a study, in its quick form where it has one: every check holds, and its rows are those of the committed report.
#[track_caller]
fn holds(name: &str) {
    let study = find(name).expect("a study");
    let Some(quick) = study.quick else { return holds_whole(study) };
    let outcome = quick().expect("the study runs");
    all_hold(&outcome, name);
    let committed = committed();
    assert_eq!(contradictions(&committed, &reported(study, outcome), Some(&[name])), Vec::<String>::new());
}

/// Runs the whole of a study: neither files nor rows are more or fewer than those committed.
#[track_caller]
fn holds_whole(study: &'static Study) {
    let outcome = (study.run)().expect("the study runs");
    all_hold(&outcome, study.name);
    assert_eq!(outcome.files(), study.files, "files the study does not list");
    let rows: Vec<String> = outcome.claims.iter().map(|claim| claim.row(study.name)).collect();
    let page: Vec<(&str, Vec<String>)> = if rows.is_empty() { Vec::new() } else { vec![(study.name, rows)] };
    assert_eq!(
        table::differences(&page),
        Vec::<String>::new(),
        "validation/paper/README.md is not what this run finds"
    );
    let committed = committed();
    assert_eq!(differences(&committed, &reported(study, outcome), Some(&[study.name])), Vec::<String>::new());
}

#[track_caller]
fn all_hold(outcome: &Outcome, name: &str) {
    let failing: Vec<&Check> = outcome.checks.iter().filter(|check| !check.holds()).collect();
    assert!(outcome.holds(), "{failing:#?}");
    let numbers = outcome.data.len() + outcome.published.len();
    assert!(!outcome.figures.is_empty() && numbers > 0, "{name} shows nothing");
}

fn reported(study: &'static Study, outcome: Outcome) -> String {
    let mut report = Report::default();
    report.add(study, Ok(outcome));
    report.markdown()
}

fn committed() -> String {
    fs::read_to_string(folder().join("REPORT.md")).unwrap()
}

macro_rules! studies {
    ($($test:ident = $name:literal),* $(,)?) => {
        $(#[test] fn $test() { holds($name); })*

        #[test]
        fn every_study_is_among_these() {
            assert_eq!(STUDIES.map(|study| study.name), [$($name),*]);
        }
    };
}

studies! {
    kernel = "kernel",
    lattice_sums = "lattice-sums",
    hertz = "hertz",
    periodic_hertz = "periodic-hertz",
    westergaard = "westergaard",
    sliding_wave = "sliding-wave",
    sliding_coated = "sliding-coated",
    wavy = "wavy",
    isolated = "isolated",
    free_space = "free-space",
    two_bodies = "two-bodies",
    identification = "identification",
    partial_slip = "partial-slip",
    adhesion = "adhesion",
    moving = "moving",
    relaxing_layers = "relaxing-layers",
    heat = "heat",
    creep = "creep",
    thin_coatings = "thin-coatings",
    rings = "rings",
    hertz_stresses = "hertz-stresses",
    sliding_sphere = "sliding-sphere",
    limit = "limit",
    plasticity = "plasticity",
    wear = "wear",
    fatigue = "fatigue",
    sinusoidal_stresses = "sinusoidal-stresses",
    convergence = "convergence",
    discretisation = "discretisation",
    iterations = "iterations",
    peer = "peer",
    disc = "disc",
    localized = "localized",
    paper_fig2 = "paper/fig2",
    paper_fig3 = "paper/fig3",
    paper_table1 = "paper/table1",
    paper_fig4 = "paper/fig4",
    paper_fig5 = "paper/fig5",
    paper_fig6 = "paper/fig6",
    paper_fig7 = "paper/fig7",
}

/// The others are run whole anyway.
#[test]
#[ignore = "minutes: every point of every study"]
fn the_whole_of_each_study_that_has_a_quick_form_holds() {
    for study in STUDIES.iter().filter(|study| study.quick.is_some()) {
        holds_whole(study);
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("validation")
}

#[test]
fn every_study_has_its_folder_with_a_readme_that_says_how_to_run_it_and_a_figure() {
    for study in &STUDIES {
        let folder = folder().join(study.name);
        let readme = fs::read_to_string(folder.join("README.md")).expect(study.name);
        assert!(readme.contains(&format!("percoat validate {}", study.name)), "{}: no command", study.name);
        assert!(readme.contains("**Verdict:**"), "{}: no verdict", study.name);
        assert!(readme.contains("(figure.png)"), "{}: the figure is not shown", study.name);
        assert!(folder.join("figure.png").is_file(), "{}: no figure", study.name);
    }
}

#[test]
fn the_committed_report_is_whole_and_nothing_in_it_fails() {
    let report = committed();
    for study in &STUDIES {
        assert!(report.contains(&format!("\n## {}\n", study.name)), "{} is not in the report", study.name);
    }
    assert!(!report.contains("| fails |"));
    // Every row counts: without the last one, or with another verdict, it is another report.
    assert!(differences(&report, &report, None).is_empty());
    let shorter = report.trim_end().rsplit_once('\n').unwrap().0;
    assert_eq!(differences(&report, shorter, None).len(), 1);
    let (before, after) = report.rsplit_once("| holds |").unwrap();
    assert_eq!(differences(&report, &format!("{before}| fails |{after}"), None).len(), 1);
}

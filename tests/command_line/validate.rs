//! `percoat validate`.

use crate::program::{Desk, Folder, assert_says};
use std::collections::BTreeSet;

#[test]
fn one_study_prints_its_table_and_leaves_report_figure_and_data() {
    let desk = Desk::new();
    let answer = desk.succeeds(&["validate", "kernel"]);
    assert_says(
        &answer.out,
        &["study", "quantity", "value", "reference", "error", "tolerance", "verdict", "kernel", "holds"],
    );
    let folder = Folder(desk.path("out/validate/kernel"));
    let expected = ["REPORT.md", "figure.png", "compliance.data.csv", "interior.data.csv", "tangential.data.csv"];
    assert_eq!(folder.names(), expected.map(str::to_owned).into());
    assert!(folder.text("REPORT.md").contains("| holds |"));
    assert!(folder.bytes("figure.png").starts_with(b"\x89PNG"));
    assert_eq!(folder.text("compliance.data.csv").lines().count(), 701);
}

#[test]
fn an_unknown_study_is_refused_with_the_names_of_all() {
    let desk = Desk::new();
    desk.percoat(&["validate", "kernal"]).complains(2, &["kernal", "kernel", "periodic-hertz", "peer"]);
    desk.percoat(&["validate", "kernel", "--set", "grid.points=64"]).complains(2, &["--set"]);
    desk.percoat(&["validate", "kernel", "--expect", "absent.md"]).complains(4, &["absent.md"]);
    assert_eq!(desk.names(), BTreeSet::new(), "something is written");
}

#[test]
fn another_verdict_or_row_than_expected_fails() {
    let desk = Desk::new();
    desk.succeeds(&["validate", "kernel", "--quiet", "--output", "first"]);
    let report = Folder(desk.path("first/kernel")).text("REPORT.md");
    let expect = |report: String| {
        desk.write("expected.md", report);
        let answer = desk.percoat(&["validate", "kernel", "--quiet", "--expect", "expected.md"]);
        (answer.code, answer.err)
    };
    assert_eq!(expect(report.clone()), (0, String::new()));
    // Digits may differ between machines.
    let row = report.lines().find(|line| line.starts_with("| compliance, largest relative error")).unwrap();
    let value = row.split('|').nth(2).unwrap();
    assert_eq!(expect(report.replace(value, " 1.2345e-15 ")).0, 0);
    let (code, complaint) = expect(report.replace(row, &row.replace("holds", "fails")));
    assert!(
        code == 1 && complaint.contains("compliance, largest relative error: holds, expected fails"),
        "{complaint}"
    );
    let (code, complaint) = expect(report.replace(&format!("{row}\n"), ""));
    assert!(code == 1 && complaint.contains("not expected"), "{complaint}");
    let (code, complaint) = expect(report.replace(row, &format!("{row}\n{}", row.replace("compliance", "stiffness"))));
    assert!(code == 1 && complaint.contains("stiffness, largest relative error: missing"), "{complaint}");
}

#[test]
fn reports_and_studies_of_somebody_else_are_not_written_over() {
    let desk = Desk::new();
    for name in ["report/kernel/REPORT.md", "study/kernel/figure.png", "page/paper/README.md"] {
        let path = desk.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, "# My own\n").unwrap();
        let folder = name.split('/').next().unwrap();
        let study = if folder == "page" { "paper/table1" } else { "kernel" };
        desk.percoat(&["validate", study, "-o", folder]).complains(2, &[name, "-o"]);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "# My own\n");
        assert_eq!(Folder(path.parent().unwrap().to_owned()).all_names().len(), 1);
    }
}

#[test]
fn a_study_renews_its_own_files_and_what_was_changed_since_stays() {
    let desk = Desk::new();
    let validate = |study: &str| desk.percoat(&["validate", study, "-o", "mine", "-q"]);
    for study in ["kernel", "lattice-sums", "kernel"] {
        validate(study).succeeds();
    }
    let folder = Folder(desk.path("mine"));
    assert!(["kernel/figure.png", "lattice-sums/figure.png"].iter().all(|name| !folder.bytes(name).is_empty()));
    // A page of one's own beside them is no obstacle, a figure that was drawn over is.
    desk.write("mine/kernel/README.md", "# Mine\n");
    validate("kernel").succeeds();
    desk.write("mine/kernel/figure.png", "mine");
    validate("kernel").complains(2, &["kernel/figure.png", "changed", "-o"]);
    assert_eq!(["figure.png", "README.md"].map(|name| folder.text(&format!("kernel/{name}"))), ["mine", "# Mine\n"]);
    assert_eq!(validate("lattice-sums").code, 0, "the other study has nothing to do with it");
}

#[test]
fn what_stands_in_the_place_of_a_study_is_refused_before_it_is_run() {
    let desk = Desk::new();
    desk.write("kernel", "mine");
    desk.percoat(&["validate", "kernel", "-o", "."]).complains(2, &["kernel/", "not listed", "-o"]);
    assert_eq!(desk.names(), ["kernel".to_owned()].into());
    // Other pictures beside those of a study are nobody's business.
    std::fs::create_dir(desk.path("lattice-sums")).unwrap();
    desk.write("lattice-sums/photo.png", "mine");
    desk.succeeds(&["validate", "lattice-sums", "-o", ".", "-q"]);
    assert_eq!(Folder(desk.path("lattice-sums")).text("photo.png"), "mine");
}

/// The studies as they are committed, with their list.
#[test]
fn the_committed_studies_can_be_renewed() {
    let desk = Desk::new();
    let committed = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("validation");
    for place in [".percoat", "kernel", "paper", "paper/table1"] {
        let (from, to) = (committed.join(place), desk.path("validation").join(place));
        std::fs::create_dir_all(&to).unwrap();
        for entry in std::fs::read_dir(from).unwrap().map(|entry| entry.unwrap()) {
            if entry.file_type().unwrap().is_file() && entry.file_name() != "lock" {
                std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
            }
        }
    }
    for study in ["kernel", "paper/table1"] {
        let answer = desk.percoat(&["validate", study, "-o", "validation", "-q"]);
        assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{study}");
    }
    // Who edits the page builds it into the program; one of somebody else's is refused.
    let page = Folder(desk.path("validation")).text("paper/README.md");
    desk.write("validation/paper/README.md", page.clone() + "Mine.\n");
    desk.percoat(&["validate", "paper/table1", "-o", "validation"]).complains(2, &["paper/README.md", "changed"]);
    std::fs::remove_dir_all(desk.path("validation/.percoat")).unwrap();
    desk.write("validation/paper/README.md", page);
    desk.percoat(&["validate", "kernel", "-o", "validation"]).complains(2, &["kernel/", "not listed"]);
}

//! Exit codes 2, 3 and 4, what is said and what is written.

use crate::program::{Answer, Desk, Folder};
use std::collections::BTreeSet;
use std::process::Stdio;

#[test]
fn a_search_ends_at_the_load_of_a_test() {
    let desk = Desk::new();
    for (load, words) in [("20 µm", "must be a force"), ("-1", "above 0"), ("much", "needed is a number")] {
        desk.percoat(&["limit", "ball-on-disc", "--up-to", load, "-o", "out"]).complains(2, &[load, words]);
    }
    let search = ["limit", "ball-on-disc", "--up-to", "20N", "--set", "grid.points=48", "--no-pictures", "-o", "out"];
    let found = desk.percoat(&search);
    assert!(found.code == 0 && found.out.contains("nothing fails up to the force 20.000\u{a0}N"), "{}", found.out);
}

#[test]
fn a_misspelt_key_is_refused_with_its_place_and_a_suggestion() {
    let desk = Desk::new();
    let text = desk.percoat(&["cases", "fig2"]).out.replace("thickness", "thicknes");
    let line = 1 + text.lines().position(|line| line.starts_with("thicknes")).unwrap();
    desk.write("mine.toml", text);
    desk.percoat(&["solve", "mine.toml"])
        .complains(2, &[&format!("mine.toml:{line}:1"), "`layers[0].thicknes`", "did you mean `thickness`?"]);
    assert_eq!(desk.names(), BTreeSet::from(["mine.toml".to_owned()]), "something is written");
}

#[test]
fn a_misspelt_override_is_refused_with_a_suggestion() {
    let desk = Desk::new();
    desk.percoat(&["solve", "--set", "load.men_pressure=1"]).complains(2, &["--set", "did you mean `mean_pressure`?"]);
    assert!(desk.names().is_empty());
}

#[test]
fn what_the_command_line_does_not_know_is_refused() {
    let desk = Desk::new();
    desk.percoat(&["solve", "--ouput", "x"]).complains(2, &["--ouput", "--output"]);
    desk.percoat(&["slove"]).complains(2, &["slove", "solve"]);
    desk.percoat(&["solve", "fig9"]).complains(2, &["fig9", "fig2", "tin-on-steel"]);
    desk.percoat(&["cases", "fig9"]).complains(2, &["fig9", "fig2", "tin-on-steel"]);
    desk.percoat(&["solve", "--quiet", "--verbose"]).complains(2, &["--quiet", "--verbose"]);
    desk.percoat(&["solve", "--threads", "0"]).complains(2, &["--threads"]);
    desk.percoat(&[]).complains(2, &["Usage"]);
    assert!(desk.names().is_empty(), "{:?} is written", desk.names());
}

/// A run that ends without having converged.
const SHORT: [&str; 8] =
    ["solve", "-o", "short", "--no-pictures", "--set", "grid.points=64", "--set", "solver.max_iterations=2"];

#[test]
fn too_few_iterations_are_told_and_what_is_there_is_written() {
    let desk = Desk::new();
    let answer = desk.percoat(&SHORT);
    answer.complains(3, &["warning: not converged: step 1"]);
    assert!(answer.out.contains("0 of 1 load steps converged"), "{}", answer.out);
    let short = Folder(desk.path("short"));
    let steps = short.steps();
    assert_eq!((&steps[0]["converged"], &steps[0]["stop_reason"]), (&false.into(), &"iteration_limit".into()));
    assert_eq!(short.contact().field("pressure").shape, [1, 64, 64]);
    assert_eq!(short.text("curve.csv").lines().count(), 2);
    assert!(!short.names().contains("contact.partial"));
}

/// A reader that stops, as in `percoat solve | head -1`.
#[test]
fn who_stops_reading_still_learns_that_a_run_has_not_converged() {
    let desk = Desk::new();
    let mut child = desk.command(&SHORT).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    Answer::from(child).complains(3, &["warning: not converged: step 1"]);
}

#[test]
fn a_penetration_that_reaches_no_sample_is_told() {
    let desk = Desk::new();
    let case = "[lattice]\nkind = \"oblique\"\na1 = [1.0, 0.0]\na2 = [0.0, 1.0]\n\
                [[levels]]\nshape = \"paraboloid\"\nradius = 1.0\nheight = 0.0\nsites = [[0.26, 0.27]]\n\
                [substrate]\nyoung = 1.0\npoisson = 0.3\n[load]\npenetration = [1e-5, 1e-3]\n[grid]\npoints = 64\n";
    desk.write("between.toml", case);
    let answer = desk.percoat(&["solve", "between.toml", "-o", "out", "--no-pictures"]);
    answer
        .complains(3, &["warning: the penetration of step 1 brings hardly a sample into contact", "raise grid.points"]);
    assert!(!answer.err.contains("not converged"), "{}", answer.err);
    let steps = Folder(desk.path("out")).steps();
    assert_eq!((&steps[0]["converged"], &steps[0]["stop_reason"]), (&false.into(), &"unresolved".into()));
    assert_eq!(steps[1]["converged"], true);
}

#[test]
fn a_case_file_that_cannot_be_read_is_an_input_failure() {
    let desk = Desk::new();
    desk.percoat(&["solve", "absent.toml"]).complains(4, &["absent.toml"]);
    desk.percoat(&["check", "absent.toml"]).complains(4, &["absent.toml"]);
    assert!(desk.names().is_empty());
}

#[test]
fn a_folder_that_cannot_be_made_is_an_output_failure() {
    let desk = Desk::new();
    desk.write("taken", "a file");
    for folder in ["taken", "taken/below"] {
        desk.percoat(&["solve", "--set", "grid.points=48", "-o", folder]).complains(4, &["cannot write", folder]);
    }
    assert_eq!(desk.names(), BTreeSet::from(["taken".to_owned()]));
}

#[test]
fn a_folder_with_the_name_of_an_embedded_case_does_not_hide_it() {
    let desk = Desk::new();
    let small = ["--no-pictures", "--set", "grid.points=48"];
    desk.solve("fig2", &small);
    desk.solve("fig2", &small);
    desk.solve("again", &[&["fig2"], &small[..]].concat());
    desk.write("fig3a", "no case");
    desk.percoat(&["solve", "fig3a"]).complains(2, &["fig3a:1"]);
}

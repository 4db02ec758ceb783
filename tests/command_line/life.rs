//! `percoat life`: what it prints, writes, refuses, and goes on with.

use crate::program::{Desk, number};
use serde_json::Value;
use std::fs;

const COARSE: [&str; 2] = ["--set", "grid.points=64"];

fn file(desk: &Desk) -> Value {
    serde_json::from_str(&fs::read_to_string(desk.path("out/life.json")).unwrap()).unwrap()
}

#[test]
fn without_a_case_a_coating_that_tires_is_followed_to_its_end() {
    let desk = Desk::new();
    let answer = desk.percoat(&[&["life", "-o", "out"], &COARSE[..]].concat());
    assert_eq!(answer.code, 0, "{}", answer.err);
    let life = file(&desk);
    let first = &life["first"];
    assert!(first["interface"] == 1 && first["name"] == "TiN/tool steel" && number(first, "/z") == 2.0, "{first}");
    assert_eq!(life["criteria"].as_array().unwrap().len(), 3);
    let events = life["events"].as_array().unwrap();
    assert!(events[0]["what"] == "delamination" && number(&events[0], "/thickness") == 0.0 && events.len() > 2);
    assert_eq!(number(&events[0], "/passes"), number(first, "/passes"));
    assert!(number(&life, "/distance") == 40.0 && life["end"] == "passes");
    let course = life["wear"].as_array().unwrap();
    assert!(number(course.last().unwrap(), "/passes") == 2e7 && number(&course[0], "/thickness") == 2.0);
    for name in ["damage.png", "damage.npz", "life.png", "life.csv", "case.toml"] {
        assert!(desk.path("out").join(name).is_file(), "{name}");
    }
    assert!(!desk.path("out/unfinished-life").exists());
    for words in ["first damage at", "delamination", "passes until damage 1", "loads solved"] {
        assert!(answer.out.contains(words), "\"{words}\" does not stand in\n{}", answer.out);
    }
    assert!(answer.out.lines().all(|line| line.chars().count() <= 80), "wider than a terminal:\n{}", answer.out);
    let report = desk.percoat(&["report", "out"]);
    assert_eq!(report.code, 0, "{}", report.err);
    let page = fs::read_to_string(desk.path("out/report.html")).unwrap();
    assert!(page.contains("Passes until damage 1") && page.contains("Delamination") || page.contains("delamination"));
}

/// Passes of `life` are those of `solve`, and to the first failure one solution is enough.
#[test]
fn the_passes_are_those_of_a_solved_case() {
    let desk = Desk::new();
    desk.percoat(&[&["life", "tin-fatigue", "-o", "out", "--no-pictures", "--set", "life={}"], &COARSE[..]].concat());
    let life = file(&desk);
    assert!(life["solved"] == 1 && life["end"].is_null() && life["events"].as_array().unwrap().len() == 1);
    let solved = desk.percoat(&[&["solve", "tin-fatigue", "-o", "run", "--no-pictures"], &COARSE[..]].concat());
    assert_eq!(solved.code, 0, "{}", solved.err);
    let summary: Value = serde_json::from_str(&fs::read_to_string(desk.path("run/summary.json")).unwrap()).unwrap();
    assert_eq!(number(&summary, "/steps/0/fatigue/first/passes"), number(&life, "/first/passes"));
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let desk = Desk::new();
    desk.percoat(&["life", "fig2"]).complains(2, &["nothing tires or wears", "interface_fatigue", "life.passes"]);
    desk.percoat(&["life", "tin-fatigue", "--set", "load.mean_pressure=[0.01, 0.02]"])
        .complains(2, &["one load in all passes", "--set load.mean_pressure="]);
    assert!(desk.names().is_empty());
}

/// A state that is left by a life that was killed is gone on with, and the result is the same.
#[test]
fn a_life_that_was_interrupted_is_resumed_to_the_same_end() {
    let desk = Desk::new();
    let arguments = |folder: &'static str| {
        let set = ["--set", "grid.points=32", "--set", "life.passes=1e5"];
        [&["life", "running-in", "-o", folder, "--no-pictures"][..], &set].concat()
    };
    let whole = desk.percoat(&arguments("out"));
    assert_eq!(whole.code, 0, "{}", whole.err);
    let expected = file(&desk);
    let mut killed = desk.begin(&arguments("killed"), "killed/unfinished-life/life-state.json", 1);
    killed.kill().unwrap();
    killed.wait().unwrap();
    let resumed = desk.percoat(&[&arguments("killed")[..], &["--resume"]].concat());
    assert_eq!(resumed.code, 0, "{}", resumed.err);
    assert!(resumed.err.contains("goes on after"), "{}", resumed.err);
    let text = fs::read_to_string(desk.path("killed/life.json")).unwrap();
    let resumed: Value = serde_json::from_str(&text).unwrap();
    for key in ["first", "events", "wear", "end", "solved"] {
        assert_eq!(resumed[key], expected[key], "{key}");
    }
}

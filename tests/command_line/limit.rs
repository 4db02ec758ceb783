//! `percoat limit`: what it prints and writes.

use crate::program::{Desk, Folder, assert_says, number};
use serde_json::Value;
use std::fs;

fn limit(desk: &Desk, arguments: &[&str]) -> (Value, String) {
    let answer = desk.succeeds(&[&["limit", "-o", "out"], arguments].concat());
    (desk.json("out/limit.json"), answer.out)
}

#[test]
fn without_a_case_a_coating_in_service_is_answered_with_what_fails_first() {
    let desk = Desk::new();
    let (limits, out) = limit(&desk, &["--set", "grid.points=64"]);
    let sections = ["-2.png", "-2.svg", "-3.png", "-3.svg", "-4.png", "-4.svg", ".png", ".svg"];
    let sections = sections.map(|ending| format!("limit-section{ending}"));
    let names = [&sections[..], &["limit.csv", "limit.json", "limit.png", "limit.svg"].map(str::to_owned)].concat();
    assert_eq!(Folder(desk.path("out")).names(), names.into_iter().collect());
    // Chromium below the coating, right under the sphere.
    let first = &limits["first"];
    assert_eq!((first["criterion"].as_str(), first["material"].as_u64()), (Some("yield"), Some(2)));
    assert!(number(first, "/mean_pressure") > 0.0 && first["reached"] == "under_load");
    assert!((2.0..=2.5).contains(&number(first, "/z")) && number(first, "/x").abs() < 1.0);
    let all = limits["limits"].as_array().unwrap();
    assert_eq!(all.len(), 6);
    for limit in all {
        for key in ["criterion", "mean_pressure", "error", "x", "y", "z", "reached"] {
            assert!(limit.get(key).is_some(), "{key} is missing in {limit}");
        }
        assert!(limit["mean_pressure"].is_null() || number(limit, "/mean_pressure") >= number(first, "/mean_pressure"));
    }
    let steps = limits["steps"].as_array().unwrap().len();
    assert_eq!(fs::read_to_string(desk.path("out/limit.csv")).unwrap().lines().count(), steps + 1);
    assert_says(
        &out,
        &["first: yield of chromium at the mean pressure", "delamination of DLC/chromium", "loads solved"],
    );
    assert!(out.lines().all(|line| line.chars().count() <= 80), "wider than a terminal:\n{out}");
}

/// The utilisation of a step is its largest stress over the strength, and the table of `solve` says first what governs.
#[test]
fn a_solved_case_with_strengths_says_what_governs() {
    let desk = Desk::new();
    let answer = desk.succeeds(&["solve", "dlc-on-steel", "-o", "out", "--no-pictures", "--set", "grid.points=96"]);
    assert!(
        answer.out.contains("\nfirst: yield of chromium between p̄ = 0.020000\u{a0}GPa and 0.050397\u{a0}GPa\n"),
        "{}",
        answer.out
    );
    let steps = Folder(desk.path("out")).steps();
    let step = steps.last().unwrap();
    let taken = |index: usize| number(step, &format!("/strength/{index}/utilisation"));
    let stress = |path: &str| number(step, &format!("/stress/{path}/value"));
    let known = [
        stress("materials/0/max_mises") / 12.0,
        stress("materials/1/max_mises") / 1.5,
        stress("materials/2/max_mises") / 2.0,
        stress("materials/0/max_tension") / 1.5,
    ];
    for (index, known) in known.into_iter().enumerate() {
        assert!((taken(index) / known - 1.0).abs() < 1e-12, "{index}: {} {known}", taken(index));
    }
    // Nothing opens these interfaces: shear alone over its strength, where it is largest.
    for (index, shear) in [(4, 1.0), (5, 0.9)] {
        let bears = stress(&format!("interfaces/{}/max_shear", index - 4)) / shear;
        assert!((taken(index) / bears - 1.0).abs() < 1e-6, "{index}: {} {bears}", taken(index));
    }
}

/// On a coarse grid the tension at the edge of contact is known to hardly more than its size.
#[test]
fn what_the_errors_leave_open_is_said_to_be_open() {
    let desk = Desk::new();
    let sets = ["grid.points=64", "friction.coefficient=0.5", "layers.0.residual_stress=0", "load.mean_pressure=0.004"];
    let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
    let answer = desk.succeeds(&[&["solve", "dlc-on-steel", "-o", "out", "--no-pictures"], &sets[..]].concat());
    let step = &Folder(desk.path("out")).steps()[0];
    let taken = |row: &Value| [number(row, "/utilisation"), row["error"].as_f64().unwrap_or(0.0)];
    let all = step["strength"].as_array().unwrap();
    let [first, error] = taken(all.iter().max_by(|a, b| taken(a)[0].total_cmp(&taken(b)[0])).unwrap());
    assert!(first - error < 1.0 && first + error >= 1.0, "{first} ± {error} decides it");
    for row in all {
        let [value, error] = taken(row);
        let state = match () {
            () if value - error >= 1.0 => "fails",
            () if value + error < 1.0 => "holds",
            () => "undecided",
        };
        assert_eq!(row["state"], state, "{row}");
    }
    let governing = &step["governing"];
    assert_eq!((&governing["criterion"], &governing["state"]), (&"cracking".into(), &"undecided".into()));
    let rivals = all.iter().filter(|row| taken(row)[0] != first && taken(row).iter().sum::<f64>() >= first - error);
    assert_eq!(governing["rivals"].as_array().unwrap().len(), rivals.count());
    assert!(answer.out.contains("undecided by the errors whether anything fails"), "{}", answer.out);
}

/// Spheres on a coating of which nothing but the bond has a strength.
pub const BOND: &str = r#"
title = "Spheres on a bond"
lattice = { kind = "square", period = 20.0 }
levels = [{ shape = "sphere", radius = 50.0 }]
layers = [{ thickness = 1.0, young = 400.0, poisson = 0.25, interface_strength = { shear = 1.0 } }]
substrate = { young = 210.0, poisson = 0.3 }
load = { mean_pressure = 0.07 }
grid = { points = 48 }
"#;

/// Without friction four places around a sphere fail alike; the cut goes through the one that is marked.
#[test]
fn the_place_that_fails_is_marked_whatever_the_first_load() {
    let desk = Desk::new();
    desk.write("bond.toml", BOND);
    for load in ["0.05", "0.06", "0.09", "0"] {
        let load = format!("load.mean_pressure={load}");
        let (found, _) = limit(&desk, &["bond.toml", "--pictures", "svg", "--set", &load]);
        let picture = fs::read_to_string(desk.path("out/limit-section.svg")).unwrap();
        let words: Vec<&str> = picture.split('<').filter_map(|tag| Some(tag.split_once('>')?.1.trim())).collect();
        let words = words.join(" ").split_whitespace().collect::<Vec<&str>>().join(" ");
        assert!(words.contains("At or beyond its strength, 1: delamination of interface 1"), "{load}: {words}");
        let mut first = found["first"].clone();
        assert_eq!(first.as_object_mut().unwrap().shift_remove("rivals"), Some(Value::Array(Vec::new())));
        assert_eq!(first, found["limits"][0]);
    }
}

#[test]
fn what_residual_stress_alone_breaks_needs_no_load() {
    let desk = Desk::new();
    let broken = BOND.replace("interface_strength = { shear = 1.0 }", "residual_stress = 3.0, tensile_strength = 1.0");
    desk.write("broken.toml", broken);
    let (found, out) = limit(&desk, &["broken.toml"]);
    assert_eq!((&found["first"]["mean_pressure"], number(&found, "/first/error")), (&0.0.into(), 0.0));
    assert!(out.contains("cracking of material 1, without load") && !desk.path("out/limit.csv").exists(), "{out}");
    let answer = desk.percoat(&["solve", "broken.toml", "-o", "solved", "--no-pictures"]);
    assert!(
        answer.out.contains("first: cracking of material 1, without load, by residual stress alone"),
        "{}",
        answer.out
    );
}

#[test]
fn what_has_no_strength_is_refused_and_nothing_written() {
    let desk = Desk::new();
    let answer = desk.percoat(&["limit", "fig2"]);
    assert_eq!(answer.code, 2, "{}", answer.err);
    assert!(answer.err.contains("yield_strength") && desk.names().is_empty(), "{}", answer.err);
}

#[test]
fn a_limit_that_is_not_converged_is_written_and_marked() {
    let desk = Desk::new();
    desk.write("bond.toml", BOND);
    let arguments =
        ["limit", "bond.toml", "-o", "out", "--no-pictures", "--set=solver.max_iterations=1", "--set=grid.points=24"];
    let answer = desk.percoat(&arguments);
    assert_eq!(answer.code, 3, "{}", answer.err);
    assert!(answer.err.contains("not converged") && desk.path("out/limit.json").is_file(), "{}", answer.err);
}

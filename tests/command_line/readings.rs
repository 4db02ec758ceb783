//! Remarks of a run on its numbers: errors, rings, merged contacts, tips, too few samples.

use crate::program::{Desk, Folder, number};
use npyz::WriterBuilder;
use serde_json::Value;
use std::f64::consts::TAU;

/// A cone on a coating, with stresses.
const CONE: [&str; 8] = [
    "fig6b",
    "--no-pictures",
    "--set",
    "levels.0.shape=cone",
    "--set",
    "levels.0.slope=0.3",
    "--set",
    "load.mean_pressure=0.02",
];

#[test]
fn under_a_tip_nothing_is_a_number_that_is_infinite() {
    let desk = Desk::new();
    let answer = desk.succeeds(&[&["solve", "-o", "cone", "--set", "grid.points=72"], &CONE[..]].concat());
    // Values and places stand below each other where a place is undecided.
    let tau1: Vec<&str> = answer.out.lines().filter(|line| line.contains("τ₁ in material 1")).collect();
    assert!(tau1[0].contains("singular") && tau1[tau1.len() - 1].ends_with("(0, 0, 0)"), "{tau1:?}");
    let row = answer.out.lines().find(|line| line.contains("singular")).unwrap();
    assert!(row.contains("0.02000"), "{row}");
    let step = &Folder(desk.path("cone")).steps()[0];
    let level = &step["levels"][0];
    for place in [step, level] {
        assert_eq!((&place["max_pressure"], &place["singular"]), (&Value::Null, &true.into()), "{place}");
        assert_eq!(place["errors"]["max_pressure"], Value::Null);
    }
    // The other levels have no tips.
    let paraboloid = &step["levels"][1];
    assert!(paraboloid["singular"] == false && number(paraboloid, "/max_pressure") > 0.0, "{paraboloid}");
    let tau1 = &step["stress"]["max_tau1"];
    assert_eq!((&tau1["value"], &tau1["singular"]), (&Value::Null, &true.into()));
    assert_eq!(tau1["error"], Value::Null);
    // On the far side of the interface all is finite.
    let substrate = &step["stress"]["materials"][1]["max_tau1"];
    assert!(number(substrate, "/value") > 0.0 && substrate["singular"] == false, "{substrate}");
    let curve = Folder(desk.path("cone")).text("curve.csv");
    let column = curve.lines().next().unwrap().split(',').position(|name| name == "levels_1_max_pressure").unwrap();
    assert_eq!(curve.lines().nth(1).unwrap().split(',').nth(column), Some(""), "no number");
}

#[test]
fn an_accuracy_leaves_out_what_is_infinite_and_says_when_it_is_not_reached() {
    let desk = Desk::new();
    let accuracy = |accuracy: &str| {
        let set = format!("grid={{ accuracy = {accuracy} }}");
        desk.percoat(&[&["solve", "-o", "cone", "--set", &set], &CONE[..], &["--threads", "2"]].concat())
    };
    accuracy("0.05").succeeds();
    let steps = Folder(desk.path("cone")).steps();
    assert!(number(&steps[0], "/points/0") <= 768.0, "{}", steps[0]["points"]);
    // No grid is that fine.
    let answer = accuracy("1e-9");
    answer.complains(3, &["grid.accuracy is not reached", "the last change was", "too slowly"]);
    let summary = Folder(desk.path("cone")).summary();
    assert!(number(&summary, "/accuracy") > 1e-9);
}

#[test]
fn rings_and_merged_contacts_are_called_so() {
    let desk = Desk::new();
    let answer = desk.succeeds(&["solve", "ring", "-o", "ring", "--no-pictures", "--set", "grid.points=128"]);
    let rows: Vec<&str> = answer.out.lines().collect();
    assert!(rows.iter().any(|row| row.contains("ring 0.1") && row.contains(" to 0.19")), "{}", answer.out);
    let steps = Folder(desk.path("ring")).steps();
    let [open, closed] = [0, 1].map(|step| &steps[step]["levels"][0]);
    assert_eq!((&open["ring"], &closed["ring"]), (&true.into(), &false.into()));
    let of = |name: &str| number(open, &format!("/{name}"));
    let (inner, outer) = (of("radius_inner"), of("radius_outer"));
    let area = TAU / 2.0 * (outer * outer - inner * inner);
    assert!((area / of("contact_area") - 1.0).abs() < 1e-12 && 0.1 < inner && inner < outer);
    for name in ["radius_inner", "radius_outer", "radius_min", "radius_max", "contact_area", "asymmetry"] {
        assert!(of(&format!("errors/{name}")) > 0.0, "{name} has no error");
    }
    assert_eq!((&closed["radius_inner"], &closed["errors"]["radius_inner"]), (&Value::Null, &Value::Null));

    let merged = ["grid.points=48", "load.mean_pressure=1.2"].map(|set| ["--set", set]).concat();
    let answer = desk.percoat(&[&["solve", "-o", "wide", "--no-pictures"][..], &merged].concat());
    assert!(answer.code == 0 && answer.out.matches("merged").count() == 3, "{}", answer.out);
    for level in Folder(desk.path("wide")).steps()[0]["levels"].as_array().unwrap() {
        assert_eq!((&level["merged"], &level["contact_radius"]), (&true.into(), &Value::Null));
    }
}

#[test]
fn contacts_of_few_samples_are_warned_of() {
    let desk = Desk::new();
    let warned = |answer: crate::program::Answer, words: &[&str]| {
        assert_eq!(answer.code, 0, "{}", answer.err);
        words.iter().for_each(|word| assert!(answer.err.contains(word), "no {word} in {}", answer.err));
    };
    let coarse = ["--no-pictures", "--set", "grid.points=24"];
    let solve = desk.percoat(&[&["solve", "-o", "few"], &coarse[..]].concat());
    warned(solve, &["warning: a contact radius has fewer than 10 samples in step 1", "raise grid.points"]);
    let small = ["--set", "localized.elements=12", "--set", "localized.indenters=[7]"];
    let compare = desk.percoat(&[&["compare", "-o", "few"], &coarse[..], &small[..]].concat());
    warned(compare, &["warning: a contact radius has only 3.", "in the spectral solution", "raise grid.points"]);

    // Sharp peaks in a cell of 48 points: a few samples each.
    let peak =
        |i: usize, j: usize| (0.5 + 0.25 * ((TAU * i as f64 / 12.0).cos() + (TAU * j as f64 / 12.0).cos())).powi(4);
    let mut file = Vec::new();
    let options = npyz::WriteOptions::new().default_dtype().shape(&[48, 48]);
    let mut array = options.writer(&mut file).begin_nd().unwrap();
    array.extend((0..48 * 48).map(|k| 0.02 * peak(k / 48, k % 48))).unwrap();
    array.finish().unwrap();
    desk.write("peaks.npy", file);
    let case = |load: f64| {
        let case = format!(
            "[lattice]\nkind = \"square\"\nperiod = 1.0\n[surface]\nheights = \"peaks.npy\"\n[substrate]\nyoung = 1.0\n\
             poisson = 0.3\n[load]\nmean_pressure = {load}\n"
        );
        desk.write("peaks.toml", case);
        desk.percoat(&["solve", "peaks.toml", "-o", "peaks", "--no-pictures"])
    };
    let words =
        ["half of the load lies on contact spots of fewer than 10 samples", "give the topography on more points"];
    warned(case(0.002), &words);
    let step = &Folder(desk.path("peaks")).steps()[0];
    assert_eq!(step["contact_spots"], 16);
    assert!((1.0..10.0).contains(&number(step, "/spot_resolution")), "{step}");
    // Complete contact has no edge that could be seen badly.
    let complete = case(0.4);
    assert_eq!(number(&Folder(desk.path("peaks")).steps()[0], "/contact_fraction"), 1.0);
    assert!(complete.code == 0 && !complete.err.contains("samples"), "{}", complete.err);
}

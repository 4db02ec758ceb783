//! `percoat identify`: what it prints, writes and refuses.

use crate::program::{Desk, assert_says, number};
use crate::report::{assert_has_cells, report};
use std::fs;

const CURVE: &str = include_str!("../../validation/identification/indentation_noisy.csv");

/// The ball and the coating of the curve, its moduli not yet known.
const CASE: &str = r#"
title = "Ball of 10 µm on a coating of 1 µm"
lattice = { kind = "isolated", size = 4.0 }
levels = [{ shape = "paraboloid", radius = 10.0 }]
layers = [{ thickness = 1.0, young = 200.0, poisson = 0.2 }]
substrate = { young = 100.0, poisson = 0.3 }
load = { force = 10.0 }
units = { length = "µm", pressure = "GPa" }
grid = { points = 48 }
"#;

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("case.toml", CASE);
    // Every fifth point of the curve, from 1 mN on.
    let content = CURVE.lines().filter(|line| !line.starts_with('#')).enumerate();
    let lines: Vec<&str> = content.filter(|(k, _)| *k == 0 || *k > 20 && k % 5 == 0).map(|(_, line)| line).collect();
    desk.write("curve.csv", lines.join("\n"));
    desk
}

/// Noise of 0.5 nm; the values lie within the interval that is stated, or near to it.
#[test]
fn moduli_are_found_and_written_with_their_fit() {
    let desk = desk();
    let free = ["identify", "curve.csv", "case.toml", "--free", "layers.0.young,substrate.young", "-o", "out"];
    let answer = desk.succeeds(&free);
    assert_says(
        &answer.out,
        &["layers.0.young", "substrate.young", "95 % interval", "correlation of", "8 points", "written to out"],
    );
    let found = desk.json("out/identification.json");
    for (index, known) in [300.0, 70.0].into_iter().enumerate() {
        let read = |key: &str| number(&found, &format!("/parameters/{index}/{key}"));
        assert!((read("value") - known).abs() < 3.0 * read("standard_error") + 5e-3 * known, "{found:#}");
        assert!(read("interval_95/0") < read("value") && read("value") < read("interval_95/1"));
    }
    // The case of the result has the values found.
    assert_eq!(number(&found, "/case/substrate/young"), number(&found, "/parameters/1/value"));
    let fit = fs::read_to_string(desk.path("out/identification.csv")).unwrap();
    assert!(fit.starts_with("force,penetration,fitted,fitted_error,curve\n") && fit.lines().count() == 9, "{fit}");
    for picture in ["identification.png", "identification.svg"] {
        assert!(desk.path(&format!("out/{picture}")).is_file());
    }
    let page = report(&desk, "out");
    let (table, rest) = answer.out.split_once("correlation of").expect("a correlation behind the table");
    assert_has_cells(&page, table, 14);
    let (correlation, _) = rest.split_once('\n').expect("a line");
    assert_says(&page, &[&format!("Correlation of{correlation}"), "<figure id=\"identification\"", "8 points"]);
}

#[test]
fn what_cannot_be_identified_is_refused_with_what_to_do() {
    let desk = desk();
    let refused = |arguments: &[&str], words: &[&str]| {
        let answer = desk.percoat(&[&["identify"], arguments, &["-o", "none"]].concat());
        answer.complains(2, words);
        assert!(!desk.path("none/identification.json").exists());
    };
    refused(&["curve.csv", "case.toml", "--free", "layers.0.yuong"], &["layers.0.yuong", "layers.0.young", "offset"]);
    refused(&["curve.csv", "case.toml", "--free", "offset,offset"], &["`offset` is there twice"]);
    refused(&["curve.csv", "fig2", "--free", "layers.0.thickness"], &["does not name SI units"]);
    refused(
        &["curve.csv", "case.toml", "--free", "layers.0.young", "--set", "levels.0.sites=[[-0.2,0],[0.2,0]]"],
        &["one indenter alone"],
    );
    // A light load on a thick coating does not feel the substrate.
    desk.write("light.csv", "force_mN,penetration_nm\n0.05,1.4\n0.1,2.3\n0.2,3.6\n0.3,4.9\n");
    refused(
        &["light.csv", "case.toml", "--free", "substrate.young", "--set", "layers.0.thickness=20"],
        &["does not determine substrate.young", "contact radii"],
    );
    desk.write("short.csv", "force,penetration\n1,0.01\n2\n");
    refused(&["short.csv", "case.toml", "--free", "layers.0.young"], &["short.csv: line 3: 1 cells"]);
    desk.write("one.csv", "force,penetration\n1,0.01\n");
    refused(&["one.csv", "case.toml", "--free", "layers.0.young"], &["more points than parameters"]);
}

/// A test as an instrument exports it, with a preamble, decimal commas, points before contact, a hold and unloading.
#[test]
fn the_loading_of_an_exported_test_is_taken() {
    let desk = desk();
    let curve = fs::read_to_string(desk.path("curve.csv")).unwrap();
    let points: Vec<[f64; 2]> = curve
        .lines()
        .skip(1)
        .map(|line| line.split_once(',').map(|(force, depth)| [force, depth].map(|x| x.parse().unwrap())).unwrap())
        .collect();
    let [top, depth] = points[points.len() - 1];
    let before = [[0.0, -0.004], [-0.001 * top, -0.001]];
    let after = [[top, depth + 0.002], [0.5 * top, 0.8 * depth], [0.0, 0.01]];
    let row = |[force, depth]: &[f64; 2]| format!("0;{};{}\r\n", 1e3 * force, 1e3 * depth).replace('.', ",");
    let rows: String = before.iter().chain(&points).chain(&after).map(row).collect();
    desk.write("exported.txt", format!("Sample;DLC\r\n\r\nTime [s];Load (µN);Depth [nm];\r\n{rows}"));
    let free = ["case.toml", "--free", "substrate.young", "--set", "layers.0.young=300", "--no-pictures", "-o"];
    desk.percoat(&[&["identify", "exported.txt"][..], &free, &["none"]].concat())
        .complains(2, &["exported.txt: line", "the force must be above 0", "--segment loading"]);
    let whole = desk.succeeds(&[&["identify", "curve.csv"][..], &free, &["whole"]].concat());
    let taken = desk.succeeds(&[&["identify", "exported.txt", "--segment", "loading"][..], &free, &["taken"]].concat());
    assert_says(&taken.err, &["3 of 13 points are left out", "2 of 13 points before contact"]);
    assert!(!whole.err.contains("left out"), "{}", whole.err);
    let value = |folder: &str| number(&desk.json(&format!("{folder}/identification.json")), "/parameters/0/value");
    assert!((value("taken") / value("whole") - 1.0).abs() < 1e-9, "{} {}", value("taken"), value("whole"));
}

/// The lines of the curve with its penetrations changed, force and penetration as they are.
fn changed(desk: &Desk, name: &str, change: impl Fn(usize, f64) -> f64) {
    let curve = fs::read_to_string(desk.path("curve.csv")).unwrap();
    let mut lines = curve.lines();
    let mut text = format!("{}\n", lines.next().unwrap());
    for (index, line) in lines.enumerate() {
        let (force, penetration) = line.split_once(',').unwrap();
        text += &format!("{force},{}\n", change(index, penetration.parse().unwrap()));
    }
    desk.write(name, text);
}

/// A zero missed by 10 nm is told with its size, and no longer where it is stated; pressures above the hardness are told; the derivatives by what
/// is known stand in the table and in the file.
#[test]
fn what_the_fit_does_not_know_is_told() {
    let desk = desk();
    changed(&desk, "shifted.csv", |_, penetration| penetration - 0.01);
    let free = ["identify", "shifted.csv", "case.toml", "--free", "substrate.young", "--set", "layers.0.young=300"];
    let answer = desk.succeeds(&[&free[..], &["--no-pictures", "-o", "out"]].concat());
    let zero = "the zero of the penetration seems to be off by -";
    assert!(answer.err.contains(zero) && answer.err.contains("free `offset`"), "{}", answer.err);
    assert_says(
        &answer.out,
        &["d substrate.young", "levels.0.radius", "substrate.poisson", "frame_compliance", "offset"],
    );
    let file = desk.json("out/identification.json");
    let names: Vec<&str> =
        file["sensitivities"].as_array().unwrap().iter().map(|row| row["name"].as_str().unwrap()).collect();
    let known = ["levels.0.radius", "layers.0.thickness", "layers.0.young", "layers.0.poisson", "substrate.poisson"];
    assert!(known.iter().all(|name| names.contains(name)) && !names.contains(&"substrate.young"), "{names:?}");
    assert!(file["warnings"].as_array().unwrap().iter().any(|warning| warning.as_str().unwrap().contains(zero)));
    let known = ["--known", "offset=-0.01", "--set", "layers.0.hardness=2", "--no-pictures", "-o", "known"];
    let answer = desk.percoat(&[&free[..], &known].concat());
    assert!(answer.code == 0 && !answer.err.contains(zero), "{}", answer.err);
    assert!(answer.err.contains("exceeds the hardness 2.0000\u{a0}GPa of the body in 8 of 8 points"), "{}", answer.err);
    let file = desk.json("known/identification.json");
    let read = |key: &str| number(&file, &format!("/parameters/0/{key}"));
    assert!((read("value") - 70.0).abs() < 3.0 * read("standard_error") + 0.35, "{file:#}");
}

#[test]
fn records_of_more_than_loading_are_refused_with_their_lines() {
    let desk = desk();
    let curve = fs::read_to_string(desk.path("curve.csv")).unwrap();
    let lines: Vec<&str> = curve.lines().collect();
    let back = lines[1..].iter().rev().copied();
    desk.write("falls.csv", lines.iter().copied().chain(back).collect::<Vec<_>>().join("\n"));
    let refused = |arguments: &[&str], words: &[&str]| {
        let all = [&["identify"], arguments, &["--free", "substrate.young", "-o", "none"]].concat();
        desk.percoat(&all).complains(2, words);
        assert!(!desk.path("none").exists());
    };
    refused(&["falls.csv", "case.toml"], &["falls.csv: line 9, points 8 to 16: the force falls", "the loading alone"]);
    for (known, words) in [("offset", "is no `offset=LENGTH`"), ("offset=1,offset=2", "`offset` is there twice")] {
        refused(&["curve.csv", "case.toml", "--known", known], &[words]);
    }
}

/// A shell that may take little memory stands for a machine that has little.
#[cfg(target_os = "linux")]
#[test]
fn what_memory_does_not_hold_is_refused_before_anything_is_written() {
    let desk = desk();
    let arguments = ["curve.csv", "case.toml", "--free", "layers.0.young", "--threads", "1", "-o", "out"];
    // glibc reserves address space for an arena of each thread, how much varies from run to run: one arena for all. The outcome is the same
    // for limits from 130 to 200 MB.
    let limits = "ulimit -v 180000; export MALLOC_ARENA_MAX=1";
    desk.limited(limits, &[&["identify"], &arguments[..]].concat()).complains(2, &["48 × 48 samples take about"]);
    assert!(!desk.path("out").exists());
}

/// A whole test on the coating of 300 GPa as an instrument exports it: semicolons, decimal commas, a hold with creep, and an unloading with a contact of this
/// radius, µm.
fn whole_test(radius: f64) -> String {
    let material = |young, poisson| percoat::Material::from_young(young, poisson).unwrap();
    let layer = percoat::Layer::new(material(300.0, 0.2), 1.0, percoat::Interface::Bonded).unwrap();
    let body = percoat::HalfSpace::new(vec![layer], material(70.0, 0.3));
    let punch = percoat::identification::Punch::new(&body.into(), radius);
    // A hardness of 10 GPa, m = 1.5; f = a²/(2R).
    let force = 10.0 * std::f64::consts::PI * radius * radius;
    let most = radius * radius / 20.0 + punch.epsilon * force / punch.stiffness;
    let elastic = 1.5 * force / punch.stiffness;
    let loading = (1..=40).map(|k| f64::from(k) / 40.0).map(|x| [x * force, 0.95 * most * x.sqrt()]);
    let hold = (1..=20).map(|k| [force, most * (0.95 + 0.0025 * f64::from(k))]);
    let unloading = (1..=80).map(|k| 1.0 - f64::from(k) / 80.0);
    let unloading = unloading.map(|x| [x * force, most + elastic * (x.powf(1.0 / 1.5) - 1.0)]);
    let points = loading.chain(hold).chain(unloading).enumerate();
    let row =
        |(time, [force, depth]): (usize, [f64; 2])| format!("{time};{force};{}\r\n", 1e3 * depth).replace('.', ",");
    format!("Sample;Film 3\r\n\r\nTime [s];Load (mN);Depth [nm];\r\n{}", points.map(row).collect::<String>())
}

/// The modulus is that with which the tests were made, to the 1e-4 by which points between 0.25 and 0.95 of a power law fix its slope; tables, file, picture and page
/// have hardness and the formula for bare bodies.
#[test]
fn the_modulus_of_a_coating_follows_from_the_unloading_of_exported_tests() {
    let desk = desk();
    desk.write("small.txt", whole_test(0.6));
    desk.write("large.txt", whole_test(1.2));
    let free = ["--free", "layers.0.young", "--set", "substrate.young=70", "--segment", "unloading"];
    let run = |words: &[&str]| desk.percoat(&[&["identify"], words, &free[..]].concat());
    let one = run(&["small.txt", "case.toml", "--no-pictures", "-o", "one"]);
    assert_eq!(one.code, 0, "{}", one.err);
    let both = run(&["small.txt", "large.txt", "case.toml", "-o", "out"]);
    assert_says(
        &both.out,
        &["small.txt", "large.txt", "hardness", "bare E_r", "2 unloadings", "taken for granted", "β = 1"],
    );
    for folder in ["one", "out"] {
        let found = desk.json(&format!("{folder}/identification.json"));
        let value = number(&found, "/parameters/0/value");
        assert!((value / 300.0 - 1.0).abs() < 1e-4, "{found:#}");
        assert!((number(&found, "/unloading/tests/0/hardness") / 10.0 - 1.0).abs() < 1e-4);
        assert!((number(&found, "/unloading/tests/0/contact_radius") / 0.6 - 1.0).abs() < 1e-4);
        assert!(number(&found, "/unloading/tests/0/bare_young") < 250.0, "{found:#}");
    }
    let lines = fs::read_to_string(desk.path("out/identification.csv")).unwrap();
    assert!(lines.starts_with("force,penetration,fitted,fitted_error,curve\n") && lines.trim_end().ends_with(",,1"));
    assert!(desk.path("out/identification.svg").is_file());
    let page = report(&desk, "out");
    assert_says(&page, &["<figure id=\"identification\"", "bare E_r", "small.txt", "Taken for granted"]);
    let known = run(&["small.txt", "case.toml", "--known", "beta=1.034", "--no-pictures", "-o", "king"]);
    assert!(known.code == 0 && known.out.contains("β = 1.034"), "{}{}", known.out, known.err);
    let value = number(&desk.json("king/identification.json"), "/parameters/0/value");
    assert!(value < 295.0, "a wider factor takes a softer coating: {value}");
}

#[test]
fn tests_without_an_unloading_to_fit_are_refused_with_what_to_do() {
    let desk = desk();
    let whole = whole_test(0.6);
    let cut = |lines: usize| whole.lines().take(lines).collect::<Vec<_>>().join("\n");
    let rises = |line: &str| {
        let cells: Vec<&str> = line.split(';').collect();
        let time: f64 = cells[0].parse().unwrap_or(0.0);
        if time < 60.0 { line.to_owned() } else { format!("{};{};{}", cells[0], cells[1], 900.0 + time) }
    };
    desk.write("loading.txt", cut(63));
    desk.write("short.txt", cut(70));
    desk.write("rises.txt", whole.lines().map(rises).collect::<Vec<_>>().join("\n"));
    desk.write("whole.txt", &whole);
    let refused = |words: &[&str], told: &[&str]| {
        let all = [&["identify"], words, &["--free", "layers.0.young", "-o", "none"]].concat();
        desk.percoat(&all).complains(2, told);
        assert!(!desk.path("none/identification.json").exists());
    };
    refused(&["case.toml"], &["tables of curves and behind them a case"]);
    let unloading = |file: &'static str| [file, "case.toml", "--segment", "unloading"];
    refused(&unloading("loading.txt"), &["loading.txt: there is no unloading", "give the whole test"]);
    refused(&unloading("short.txt"), &["short.txt: ", "points of the unloading lie between", "5 are needed"]);
    refused(
        &unloading("rises.txt"),
        &["rises.txt: line", "the penetration does not fall with the force", "hold longer"],
    );
    refused(&["whole.txt", "whole.txt", "case.toml"], &["whole.txt: line", "--segment loading"]);
    refused(
        &["whole.txt", "case.toml", "--segment", "loading", "--part", "0.3,0.9"],
        &["a fitted part is that of unloading"],
    );
    let parts = [("0.9,0.3", "0 < low < high < 1"), ("0.5", "two bounds")];
    for (part, told) in parts {
        refused(&[&unloading("whole.txt")[..], &["--part", part]].concat(), &[told]);
    }
    for (known, told) in [("beta=0", "above 0"), ("beta=1,beta=2", "`beta` is there twice")] {
        refused(&[&unloading("whole.txt")[..], &["--known", known]].concat(), &[told]);
    }
    refused(&["curve.csv", "case.toml", "--known", "beta=1.034"], &["other segments do not have"]);
    let two = ["--free", "substrate.young"];
    refused(&[&unloading("whole.txt")[..], &two].concat(), &["1 unloading does not determine 2 parameters"]);
}

/// Two loading curves whose zeros were missed by 5 nm up and down: each has a zero of its own, and the modulus is that of the curve as it was.
#[test]
fn several_curves_of_loading_are_fitted_together() {
    let desk = desk();
    changed(&desk, "high.csv", |_, penetration| penetration + 0.005);
    changed(&desk, "low.csv", |_, penetration| penetration - 0.005);
    let free = ["--free", "substrate.young,offset", "--set", "layers.0.young=300", "--no-pictures"];
    let answer = desk.succeeds(&[&["identify", "high.csv", "low.csv", "case.toml", "-o", "both"], &free[..]].concat());
    assert_says(&answer.out, &["offset.0", "offset.1", "high.csv", "low.csv", "16 points"]);
    let alone = desk.succeeds(&[&["identify", "curve.csv", "case.toml", "-o", "alone"], &free[..]].concat());
    assert!(!alone.out.contains("offset.0"), "{}", alone.out);
    let [both, alone] = ["both", "alone"].map(|folder| desk.json(&format!("{folder}/identification.json")));
    let read = |key: &str| number(&both, key);
    // Both curves have the same points but for their zero: values, and zeros 10 nm apart, are those of one curve to the search.
    assert!((read("/parameters/0/value") / number(&alone, "/parameters/0/value") - 1.0).abs() < 1e-4, "{both:#}");
    assert!((read("/parameters/1/value") - read("/parameters/2/value") - 0.01).abs() < 1e-6, "{both:#}");
    assert_eq!((both["curves"][1]["name"].as_str(), both["curves"][1]["points"].as_u64()), (Some("low.csv"), Some(8)));
    let lines = fs::read_to_string(desk.path("both/identification.csv")).unwrap();
    assert!(lines.lines().count() == 17 && lines.trim_end().ends_with(",1"), "{lines}");
}

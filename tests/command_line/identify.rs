//! `percoat identify`: what it prints, writes and refuses.

use crate::program::{Desk, number};
use serde_json::Value;
use std::fs;
#[cfg(target_os = "linux")]
use std::process::Command;

const CURVE: &str = include_str!("../../validation/identification/indentation_noisy.csv");

/// The ball and the coating of the curve, its moduli not yet known.
const CASE: &str = r#"
title = "Ball of 10 µm on a coating of 1 µm"
[lattice]
kind = "isolated"
size = 4.0
[[levels]]
shape = "paraboloid"
radius = 10.0
[[layers]]
thickness = 1.0
young = 200.0
poisson = 0.2
[substrate]
young = 100.0
poisson = 0.3
[load]
force = 10.0
[units]
length = "µm"
pressure = "GPa"
[grid]
points = 48
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
    let answer = desk.percoat(&free);
    assert_eq!(answer.code, 0, "{}", answer.err);
    for words in ["layers.0.young", "substrate.young", "95 % interval", "correlation of", "8 points", "written to out"]
    {
        assert!(answer.out.contains(words), "\"{words}\" does not stand in\n{}", answer.out);
    }
    let found: Value =
        serde_json::from_str(&fs::read_to_string(desk.path("out/identification.json")).unwrap()).unwrap();
    for (index, known) in [300.0, 70.0].into_iter().enumerate() {
        let own = |key: &str| number(&found, &format!("/parameters/{index}/{key}"));
        assert!((own("value") - known).abs() < 3.0 * own("standard_error") + 5e-3 * known, "{found:#}");
        assert!(own("interval_95/0") < own("value") && own("value") < own("interval_95/1"));
    }
    // The case of the result has the values found.
    assert_eq!(number(&found, "/case/substrate/young"), number(&found, "/parameters/1/value"));
    let fit = fs::read_to_string(desk.path("out/identification.csv")).unwrap();
    assert!(fit.starts_with("force,penetration,fitted,fitted_error\n") && fit.lines().count() == 9, "{fit}");
    for picture in ["identification.png", "identification.svg"] {
        assert!(desk.path(&format!("out/{picture}")).is_file());
    }
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

/// A shell that may take little memory stands for a machine that has little.
#[cfg(target_os = "linux")]
#[test]
fn what_memory_does_not_hold_is_refused_before_anything_is_written() {
    let desk = desk();
    let percoat = assert_cmd::cargo::cargo_bin!("percoat");
    let arguments = "identify curve.csv case.toml --free layers.0.young --threads 1 -o out";
    // glibc reserves address space for an arena of each thread, how much varies from run to run: one arena for all. The outcome is the same
    // for limits from 130 to 200 MB.
    let command = format!("ulimit -v 180000 && MALLOC_ARENA_MAX=1 exec {} {arguments}", percoat.display());
    let ended = Command::new("sh").args(["-c", &command]).current_dir(desk.path("")).output().unwrap();
    let said = String::from_utf8(ended.stderr).unwrap();
    assert!(ended.status.code() == Some(2) && said.contains("48 × 48 samples take about"), "{said}");
    assert!(!desk.path("out").exists());
}

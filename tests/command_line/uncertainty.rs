//! `percoat sweep --vary`: how far results spread, and which of the uncertain keys makes it.

use crate::program::{Desk, Folder, kill, number};
use crate::sweep::sweep;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

/// A rigid ball on a bare body: the contact of Hertz. In µm and GPa: a = (3 F R / 4E*)^⅓ = 7.4 µm at E* = 230.8.
const HERTZ: &str = r#"
title = "A ball on a bare body"
lattice = { kind = "isolated", size = 24.0 }
levels = [{ shape = "paraboloid", radius = 500.0 }]
substrate = { young = 210.0, poisson = 0.3 }
load = { force = 250.0 }
grid = { points = 48 }
units = { length = "µm", pressure = "GPa" }
"#;

/// Balls on a bare body, side by side, whose contacts merge under high loads.
const PERIODIC: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "paraboloid", radius = 1.0 }]
substrate = { young = 1.0, poisson = 0.3 }
load = { mean_pressure = 0.01 }
grid = { points = 32 }
"#;

const KEYS: [&str; 6] =
    ["--vary", "substrate.young=10%", "--vary", "load.force=200:300", "--vary", "levels.0.radius=normal:500:25"];

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("case.toml", HERTZ);
    desk
}

/// The row of a result of the first load step, by the names of the columns.
struct Found(Vec<(String, String)>);

impl Found {
    fn of(desk: &Desk, folder: &str, result: &str) -> Self {
        let text = Folder(desk.path(folder)).text("uncertainty.csv");
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let head = lines.next().unwrap();
        let row = lines.find(|line| line[1] == result).unwrap_or_else(|| panic!("no {result} in {text}"));
        Self(head.into_iter().zip(row).collect())
    }

    fn number(&self, name: &str) -> f64 {
        let (_, cell) = self.0.iter().find(|(head, _)| head == name).unwrap_or_else(|| panic!("no {name}"));
        cell.parse().unwrap_or_else(|_| panic!("{name} is {cell}"))
    }
}

/// Mean of x^p of a uniform x, or by its series of a normal one of 5 %.
fn mean_of_power(key: usize, p: f64) -> f64 {
    let uniform = |from: f64, to: f64| (to.powf(p + 1.0) - from.powf(p + 1.0)) / ((p + 1.0) * (to - from));
    match key {
        0 => uniform(0.9 * 210.0, 1.1 * 210.0),
        1 => uniform(200.0, 300.0),
        // ⟨(1 + s z)^p⟩ up to s⁴, ⟨z²⟩ = 1, ⟨z⁴⟩ = 3.
        _ => {
            let s2 = 0.05_f64.powi(2);
            let fourth = p * (p - 1.0) * (p - 2.0) * (p - 3.0) / 8.0;
            500_f64.powf(p) * (1.0 + 0.5 * p * (p - 1.0) * s2 + fourth * s2 * s2)
        }
    }
}

/// p₀ = (6 F E*²/π³R²)^⅓, δ = (9F²/16RE*²)^⅓ and a = (3FR/4E*)^⅓ are products of powers of the keys: with 1 + cᵢ = ⟨gᵢ²⟩/⟨gᵢ⟩² of each factor
/// gᵢ, V = ⟨f⟩² (Π(1 + cᵢ) − 1), Sᵢ = cᵢ/(Π(1 + cⱼ) − 1) and Tᵢ = Sᵢ Π(1 + cⱼ) over the other keys.
#[test]
fn the_contact_of_hertz_spreads_as_its_powers_do() {
    let desk = desk();
    let answer = sweep(&desk, "out", &[&KEYS[..], &["--samples", "64"]].concat()).succeeds();
    assert!(answer.out.contains("320 of 320 combinations done"), "{}", answer.out);
    let third = 1.0 / 3.0;
    let plane = 1.0 / (1.0 - 0.3_f64.powi(2));
    let pi3 = std::f64::consts::PI.powi(3);
    for (result, constant, powers) in [
        ("max_pressure", (6.0 * plane * plane / pi3).powf(third), [2.0 * third, third, -2.0 * third]),
        ("penetration", (9.0 / (16.0 * plane * plane)).powf(third), [-2.0 * third, 2.0 * third, -third]),
        ("levels_1_contact_radius", (0.75 / plane).powf(third), [-third, third, third]),
    ] {
        let found = Found::of(&desk, "out", result);
        let means: Vec<f64> = (0..3).map(|key| mean_of_power(key, powers[key])).collect();
        let excess: Vec<f64> =
            (0..3).map(|key| mean_of_power(key, 2.0 * powers[key]) / means[key].powi(2) - 1.0).collect();
        let mean = constant * means.iter().product::<f64>();
        let whole: f64 = excess.iter().map(|c| 1.0 + c).product();
        let relative = (whole - 1.0).sqrt();
        assert!((found.number("mean") / mean - 1.0).abs() < 0.01, "{result}: {} {mean}", found.number("mean"));
        let deviation = found.number("deviation") / found.number("mean");
        assert!((deviation / relative - 1.0).abs() < 0.06, "{result}: {deviation} {relative}");
        for (key, name) in ["substrate_young", "load_force", "levels_0_radius"].into_iter().enumerate() {
            let first = excess[key] / (whole - 1.0);
            for (kind, exact) in [("first", first), ("total", first * whole / (1.0 + excess[key]))] {
                let [value, low, high] = ["", "_low", "_high"].map(|end| found.number(&format!("{kind}_{name}{end}")));
                assert!((value - exact).abs() < 0.1, "{result} {kind} {name}: {value} {exact}");
                assert!(low - 0.02 < exact && exact < high + 0.02, "{result} {kind} {name}: {low} {exact} {high}");
            }
        }
        assert_eq!(["known", "above", "below", "unknown"].map(|name| found.number(name)), [128.0, 0.0, 0.0, 0.0]);
    }
    // The radius of the apex is uncertain, the force spreads too: the table has what matters most first.
    let line = answer.out.lines().find(|line| line.contains("peak pressure")).unwrap();
    assert!(line.contains("\u{a0}GPa") && line.contains("force 0.") && line.contains("radius 0."), "{line}");
}

#[test]
fn the_same_is_told_on_any_number_of_threads_in_parts_and_after_a_kill() {
    let desk = desk();
    let keys = [&KEYS[..], &["--samples", "16", "--seed", "7"]].concat();
    sweep(&desk, "whole", &keys).succeeds();
    let names = Folder(desk.path("whole")).names();
    assert_eq!(names, BTreeSet::from(["sweep.csv", "sweep.json", "sweep.jsonl", "uncertainty.csv"].map(str::to_owned)));
    let files = |folder: &str| ["sweep.csv", "uncertainty.csv"].map(|name| Folder(desk.path(folder)).text(name));
    let whole = files("whole");
    sweep(&desk, "threads", &[&keys[..], &["--threads", "3"]].concat()).succeeds();
    assert_eq!(files("threads"), whole);
    for part in ["1/3", "2/3", "3/3"] {
        let folder = format!("parts/{}", &part[..1]);
        let answer = sweep(&desk, &folder, &[&keys[..], &["--shard", part]].concat()).succeeds();
        assert!(!answer.out.contains("uncertainty") && !desk.path(&folder).join("uncertainty.csv").exists());
    }
    let answer = desk.succeeds(&["merge", "--no-pictures", "parts/1", "parts/2", "parts/3"]);
    assert!(answer.out.contains("uncertainty by 32 draws of 3 uncertain keys"), "{}", answer.out);
    assert_eq!(files("parts"), whole);
    let command = [&["sweep", "case.toml", "-o", "killed", "--no-pictures", "--threads", "1"], &keys[..]].concat();
    kill(desk.begin(&command, "killed/unfinished-sweep/sweep.jsonl", 5));
    let again = desk.succeeds(&[&command[..], &["--resume"]].concat());
    assert!(again.err.contains("of 80 combinations are done already"), "{}", again.err);
    assert_eq!(files("killed"), whole);
    // Twice as many samples go on from these.
    let more = [&KEYS[..], &["--samples", "32", "--seed", "7", "--resume"]].concat();
    let more = sweep(&desk, "killed", &more).succeeds();
    assert!(more.err.contains("80 of 160 combinations are done already"), "{}", more.err);
    assert_ne!(files("killed")[1], whole[1]);
    // Another sweep into the same folder has no uncertainty.
    sweep(&desk, "killed", &["--set", "load.force=200,300"]).succeeds();
    assert!(!desk.path("killed/uncertainty.csv").exists());
}

/// A limit grows with its strength: the median is the limit of the median strength, up to the distance of the draws, of which each eighth
/// of the range has two; the limit is about as the cube of the strength. Strengths beyond those of complete contact are not reached.
#[test]
fn limits_are_uncertain_and_draws_without_a_limit_are_counted() {
    let desk = Desk::new();
    desk.write("case.toml", PERIODIC);
    let task = ["--samples", "8", "--limit"];
    let answer = sweep(&desk, "out", &[&["--vary", "substrate.yield_strength=0.1:0.2"], &task[..]].concat()).succeeds();
    assert!(
        answer.out.contains("first limit, mean pressure") && answer.out.contains("1 uncertain key;"),
        "{}",
        answer.out
    );
    let found = Found::of(&desk, "out", "first_mean_pressure");
    let strength = ["--set", "substrate.yield_strength=0.15"];
    desk.succeeds(&[&["limit", "case.toml", "-o", "median", "--no-pictures"], &strength[..]].concat());
    let limit = number(&desk.json("median/limit.json"), "/first/mean_pressure");
    assert!((found.number("median") / limit - 1.0).abs() < 0.15, "{} {limit}", found.number("median"));
    assert_eq!(found.number("known"), 16.0);
    // What is printed with --json has the same numbers.
    let told = sweep(&desk, "json", &[&["--vary", "substrate.yield_strength=0.1:0.2", "--json"], &task[..]].concat());
    let told: Value = serde_json::from_str(&told.succeeds().out).unwrap();
    let rows = told["uncertainty"].as_array().unwrap();
    let row = rows.iter().find(|row| row["result"] == "first_mean_pressure").unwrap();
    for name in ["q05", "median_low", "q95", "total_substrate_yield_strength"] {
        assert_eq!(row[name].as_f64(), Some(found.number(name)), "{name}: {row}");
    }
    assert_eq!(desk.json("json/sweep.json"), told);
    let answer = sweep(&desk, "far", &[&["--vary", "substrate.yield_strength=0.1:1"], &task[..]].concat()).succeeds();
    let found = Found::of(&desk, "far", "first_mean_pressure");
    let [known, above, below, unknown] = ["known", "above", "below", "unknown"].map(|name| found.number(name));
    assert!(above > 0.0 && known + above + below + unknown == 16.0, "{known} {above} {below} {unknown}");
    assert!(answer.out.contains(&format!("{above} above all that was searched")), "{}", answer.out);
    assert!(answer.out.contains("to not reached"), "{}", answer.out);
}

#[test]
fn the_page_and_the_picture_of_an_uncertain_sweep_have_its_table_and_ranges() {
    let desk = desk();
    let keys = [&KEYS[..], &["--samples", "8"]].concat();
    desk.succeeds(&[&["sweep", "case.toml", "-o", "out", "--pictures", "svg"], &keys[..]].concat());
    assert!(!desk.path("out/sweep.svg").exists());
    let picture = Folder(desk.path("out")).text("uncertainty.svg").replace('\u{a0}', " ");
    for words in [
        "16 draws of 3 uncertain keys",
        "part of the variance",
        "Young's modulus of the substrate: 0.",
        "peak pressure",
    ] {
        assert!(picture.contains(words), "no {words}");
    }
    desk.succeeds(&["report", "out"]);
    let page = fs::read_to_string(desk.path("out/report.html")).unwrap().replace('\u{a0}', " ");
    for words in [
        "Uncertain keys: 8 samples, seed 0",
        "189 to 231",
        "normal, 500 ± 25",
        "what matters: total index",
        "id=\"uncertainty\"",
    ] {
        assert!(page.contains(words), "no {words}");
    }
    assert!(!page.contains("est and worst of") && !page.contains("NaN"));
    let description: Value = desk.json("out/sweep.json");
    assert_eq!(description["uncertain"]["samples"], 8);
    assert_eq!(
        description["uncertain"]["keys"][1],
        serde_json::json!({"key": "load.force", "distribution": "uniform", "from": 200.0, "to": 300.0})
    );
}

#[test]
fn what_cannot_be_varied_is_refused_and_nothing_written() {
    let desk = desk();
    for (arguments, words) in [
        (&["--vary", "substrate.young=3:2"][..], "below the second one"),
        (&["--vary", "substrate.young=10%", "--samples", "100"], "powers of 2"),
        (&["--vary", "substrate.young=10%", "--set", "load.force=1,2"], "--set gives several of `load.force`"),
        (&["--vary", "substrate.young=10%", "--vary", "substrate.young=5%"], "`substrate.young` is given twice"),
        (&["--vary", "substrate.poisson=0.4:0.6"], "it reaches 0.6"),
        (&["--vary", "substrate.youn=1:2"], "unknown key `substrate.youn`"),
        (&["--vary", "substrate.young=10%", "--zip"], "cannot be used with"),
        (&["--set", "load.force=1,2", "--samples", "8"], "--vary"),
    ] {
        sweep(&desk, "out", arguments).complains(2, &[words]);
        assert!(!desk.path("out").exists(), "{arguments:?}");
    }
}

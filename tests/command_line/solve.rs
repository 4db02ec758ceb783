//! `percoat solve`: the table, the load steps, and what must not change the answer.

use crate::program::{Desk, Folder, assert_close, assert_says, number};
use std::fs;
use std::time::Instant;

#[test]
fn without_a_case_the_default_is_solved_and_shown() {
    let desk = Desk::new();
    let answer = desk.succeeds(&["solve", "--no-pictures", "--set", "grid.points=64"]);
    assert_says(
        &answer.out,
        &["Fig. 2", "mean pressure", "penetration", "0.060000", "1 of 1 load steps converged on 64 × 64 samples"],
    );
    assert!(!answer.out.contains('\u{1b}') && !answer.err.contains('\u{1b}'), "escape sequences in a pipe");
    assert!(desk.path("out/fig2/summary.json").is_file(), "the default folder is out/<case name>");
}

#[test]
fn what_a_single_level_cannot_share_has_no_column() {
    let desk = Desk::new();
    let ball = desk.percoat(&["solve", "ball-on-disc", "--no-pictures", "--set", "grid.points=48"]).out;
    assert!(ball.contains("contact radius") && !ball.contains("load on one") && !ball.contains("share"), "{ball}");
    assert!(!ball.contains("  level"), "{ball}");
    let single = [
        "solve",
        "--no-pictures",
        "--set",
        "grid.points=48",
        "--set",
        "levels=[{ shape = \"paraboloid\", radius = 0.8, height = 0 }]",
    ];
    let lattice = desk.percoat(&single).out;
    assert!(lattice.contains("load on one") && !lattice.contains("share"), "{lattice}");
    let many = desk
        .percoat(&[&single[..], &["--set", "load.mean_pressure={ from = 0.01, to = 0.07, steps = 7 }"]].concat())
        .out;
    assert!(many.contains("peak pressure") && !many.contains("peak 1") && !many.contains("share"), "{many}");
}

#[test]
fn quiet_prints_nothing() {
    let desk = Desk::new();
    let answer = desk.percoat(&["solve", "--quiet", "--set", "grid.points=64"]);
    assert_eq!((answer.code, answer.out, answer.err), (0, String::new(), String::new()));
    assert!(desk.path("out/fig2/contact.npz").is_file());
}

#[test]
fn load_steps_solved_together_equal_those_solved_alone() {
    let desk = Desk::new();
    let loads = ["0.002", "0.02", "0.06"];
    let solve = |name: &str, load: &str| {
        let load = format!("load.mean_pressure={load}");
        desk.solve(name, &["--no-pictures", "--set", "grid.points=96", "--set", &load]).steps()
    };
    let steps = solve("all", "[0.002, 0.02, 0.06]");
    assert_eq!(steps.len(), loads.len());
    for (load, step) in loads.iter().zip(&steps) {
        let alone = solve(load, load);
        assert_close(number(step, "/mean_pressure"), load.parse().unwrap(), 1e-12);
        assert_close(number(step, "/penetration"), number(&alone[0], "/penetration"), 1e-6);
        for level in 0..3 {
            let pointer = format!("/levels/{level}/load_share");
            let apart = number(step, &pointer) - number(&alone[0], &pointer);
            assert!(apart.abs() < 1e-5, "load {load}, level {}: shares differ by {apart:e}", level + 1);
        }
        assert_close(number(step, "/max_pressure"), number(&alone[0], "/max_pressure"), 1e-4);
    }
}

#[test]
fn an_accuracy_asked_for_is_reached_and_stated_and_one_grid_has_none() {
    let desk = Desk::new();
    let solve = |name: &str, grid: &str| desk.solve(name, &["--no-pictures", "--set", grid]);
    let refined = solve("refined", "grid.accuracy=1e-3");
    let reached = number(&refined.summary(), "/accuracy");
    assert!(reached > 0.0 && reached < 1e-3, "change {reached:e}");
    let finer = solve("finer", &format!("grid.points={}", refined.steps()[0]["points"][0]));
    assert!(finer.summary().get("accuracy").is_none(), "no accuracy without a second grid");
    assert!(finer.contact().field("pressure").values == refined.contact().field("pressure").values);
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let desk = Desk::new();
    let contact = ["--set", "grid.points=192", "--set", "load.mean_pressure=[0.01, 0.06]"];
    let awry = "stress.section={from=\"level 1\",toward=[1.0,0.7312],length=0.6,depth=0.1}";
    let stresses = ["fig6b", "--set", "grid.points=90", "--set", "stress.planes=[0.0, 0.1]", "--set", awry];
    for settings in [&contact[..], &stresses] {
        let of = |threads: &str| desk.solve(threads, &[settings, &["--threads", threads]].concat());
        let [one, three] = ["1", "3"].map(of);
        assert_eq!(one.names(), three.names());
        for name in one.names() {
            assert!(one.result(&name) == three.result(&name), "{name} depends on the number of threads");
        }
        [one, three].iter().for_each(|folder| fs::remove_dir_all(&folder.0).unwrap());
    }
}

#[test]
fn a_run_says_where_its_time_went() {
    let desk = Desk::new();
    let began = Instant::now();
    let loads = "load.mean_pressure=[0.0, 0.002]";
    let answer = desk.percoat(&["solve", "fig6b", "-o", "out", "--set", "grid.points=48", "--set", loads]);
    let wall = began.elapsed().as_secs_f64();
    let summary = Folder(desk.path("out")).summary();
    let parts = ["setup", "solve", "stress", "output"].map(|part| number(&summary["timing"], &format!("/{part}")));
    assert!(parts.iter().all(|&seconds| seconds > 0.0), "{parts:?}: stresses and pictures are in the case");
    assert!(parts.iter().sum::<f64>() <= wall, "{parts:?} are more than the {wall} s of the run");
    let steps = summary["steps"].as_array().unwrap();
    let seconds: Vec<f64> = steps.iter().map(|step| number(step, "/seconds")).collect();
    assert!(seconds.iter().all(|&seconds| seconds >= 0.0));
    assert!(seconds.iter().sum::<f64>() <= parts[1] + parts[2] + 1e-6, "{seconds:?} of {parts:?}");
    let last = answer.out.lines().last().unwrap();
    assert!(["setup", "solution", "stresses", "output"].iter().all(|word| last.contains(word)), "{last}");
}

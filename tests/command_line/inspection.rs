//! `percoat check` and `percoat kernel`: a look at a case without solving it.

use crate::program::{Desk, assert_close, assert_says, number};
use serde_json::Value;

#[test]
fn check_says_what_a_case_means_with_its_loads_of_first_touch_and_writes_nothing() {
    let desk = Desk::new();
    let answer = desk.succeeds(&["check", "fig5"]);
    let words = [
        "Fig. 5",
        "cell",
        "a₁",
        "a₂",
        "level 3",
        "layer 1",
        "χ 3",
        "substrate",
        "grid 512 × 512",
        "memory: about",
        "MiB",
        "40 steps",
        "first touch",
    ];
    assert_says(&answer.out, &words);
    assert!(desk.names().is_empty(), "check wrote {:?}", desk.names());
    // The loads that the comments of `fig5.toml` give from a grid of 1024 points.
    let touch = |level: usize| -> f64 {
        let mark = format!("  level {level}: mean pressure ");
        let stated = answer.out.lines().find_map(|line| line.strip_prefix(&mark)).unwrap();
        stated.split(" ± ").next().unwrap().parse().unwrap()
    };
    assert_eq!(touch(1), 0.0);
    assert_eq!(answer.out.matches(" ± ").count(), 2, "{}", answer.out);
    assert_close(touch(2), 0.0179, 0.02);
    assert_close(touch(3), 0.0759, 0.02);
}

#[test]
fn check_heeds_overrides_and_refuses_what_solve_refuses() {
    let desk = Desk::new();
    let answer = desk.percoat(&["check", "fig2", "--set", "grid.points=64", "--set", "layers.0.shear_ratio=7"]);
    assert!(answer.out.contains("grid 64 × 64") && answer.out.contains("χ 7"), "{}", answer.out);
    desk.percoat(&["check", "fig2", "--set", "layers.0.thicknes=1"]).complains(2, &["thickness"]);
    desk.percoat(&["check"]).complains(2, &["CASE"]);
}

/// Samples as dense along the long side as along the short one would be 37 million.
#[test]
fn first_touches_in_a_long_cell_take_no_more_than_the_grid_of_the_case() {
    let desk = Desk::new();
    let lattice = "lattice={kind=\"oblique\",a1=[1000.0,0.0],a2=[0.0,1.0]}";
    let sites = "levels=[{shape=\"paraboloid\",radius=0.8,sites=[[0,0]]}]";
    let answer = desk.percoat(&["check", "fig2", "--set", lattice, "--set", sites, "--set", "grid.points=[1024,16]"]);
    assert!(answer.code == 0 && answer.out.contains("first touch, on 1024 × 16 samples"), "{}", answer.out);
}

fn lines(arguments: &[&str]) -> Vec<Value> {
    let desk = Desk::new();
    let answer = desk.succeeds(&[&["kernel"], arguments].concat());
    assert!(desk.names().is_empty(), "kernel wrote {:?}", desk.names());
    answer.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn kernel_prints_one_json_line_a_wavenumber() {
    let lines = lines(&["--wavenumber", "1e-3,1,1e3"]);
    let wavenumbers: Vec<f64> = lines.iter().map(|line| number(line, "/wavenumber")).collect();
    assert_eq!(wavenumbers, [1e-3, 1.0, 1e3]);
    assert!(lines.iter().all(|line| line.get("depths").is_none()));
    // Long waves feel the substrate alone, 2(1 − ν²)/(E q); short ones the coating, (1 − ν)/(G q).
    assert_close(number(&lines[0], "/compliance"), 2.0 * (1.0 - 0.09) / 1e-3, 1e-3);
    let shear = 2.0 / 2.6;
    assert_close(number(&lines[2], "/compliance"), (1.0 - 0.2) / (shear * 1e3), 1e-9);
}

#[test]
fn kernel_gives_both_sides_of_an_interface() {
    let lines = lines(&["fig2", "--wavenumber", "2", "--depth", "0,0.25,0.5,1"]);
    let depths = lines[0]["depths"].as_array().unwrap();
    let places: Vec<(f64, u64)> = depths.iter().map(|at| (number(at, "/z"), at["side"].as_u64().unwrap())).collect();
    assert_eq!(places, [(0.0, 1), (0.25, 1), (0.5, 1), (0.5, 2), (1.0, 2)]);
    let (above, below) = (&depths[2], &depths[3]);
    for name in ["/szz", "/sqz", "/uz", "/uq"] {
        assert_close(number(above, name), number(below, name), 1e-12);
    }
    for name in ["/sqq", "/stt"] {
        assert!((number(above, name) - number(below, name)).abs() > 1e-3, "{name} jumps between two materials");
    }
    assert_eq!((number(&depths[0], "/szz"), number(&depths[0], "/sqz")), (-1.0, 0.0));
    assert_close(number(&depths[0], "/uz"), number(&lines[0], "/compliance"), 1e-12);
}

#[test]
fn kernel_refuses_wavenumbers_that_are_not_positive() {
    let desk = Desk::new();
    for wavenumber in ["0", "-1", "1,0", "nan", "inf", "one", ""] {
        desk.percoat(&["kernel", &format!("--wavenumber={wavenumber}")]).complains(2, &["--wavenumber"]);
    }
    desk.percoat(&["kernel"]).complains(2, &["--wavenumber"]);
    desk.percoat(&["kernel", "--wavenumber=1", "--depth=-1"]).complains(2, &["--depth", "not less than 0"]);
}

/// a/l = 0.03 at the first load of Fig. 5: six samples of a grid of 48, sixty of 512.
#[test]
fn check_foresees_the_samples_at_the_lowest_load() {
    let desk = Desk::new();
    let few = desk.percoat(&["check", "fig5", "--set", "grid.points=48"]);
    assert!(few.code == 0 && few.err.contains("samples, by the formulas"), "{}", few.err);
    // The smallest load decides, wherever it stands.
    let loads = "load.mean_pressure=[0.05, 1e-6, 0.06]";
    let tiny = desk.percoat(&["check", "fig5", "--set", loads]);
    assert!(tiny.err.contains("at load.mean_pressure = 1.0000e-6"), "{}", tiny.err);
    let enough = desk.percoat(&["check", "fig2"]);
    assert!(enough.code == 0 && !enough.err.contains("samples"), "{}", enough.err);
}

//! `[surface]`: topographies from a file and from a seed through the command line.

use crate::program::{Desk, Folder, assert_close, number};
use npyz::WriterBuilder;
use std::f64::consts::TAU;

const POINTS: [usize; 2] = [40, 48];
const AMPLITUDE: f64 = 0.01;

const CASE: &str = r#"
title = "Waves"
[lattice]
kind = "oblique"
a1 = [1.0, 0.0]
a2 = [0.2, 1.5]
[surface]
heights = "surface.npy"
[[layers]]
thickness = 0.3
shear_ratio = 2.0
poisson = 0.3
interface = "bonded"
[substrate]
young = 1.0
poisson = 0.3
[load]
mean_pressure = 0.003
"#;

/// Protrusion at a sample: two waves, so that neither a transposed nor a mirrored surface is the same.
fn height(i: usize, j: usize) -> f64 {
    let (s, t) = (i as f64 / POINTS[0] as f64, j as f64 / POINTS[1] as f64);
    AMPLITUDE * ((TAU * s).cos() + 0.5 * (TAU * (s + 2.0 * t) + 0.3).cos())
}

fn solve(desk: &Desk) -> Folder {
    let [n1, n2] = POINTS;
    let mut file = Vec::new();
    let shape = POINTS.map(|n| n as u64);
    let mut array = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut file).begin_nd().unwrap();
    array.extend((0..n1 * n2).map(|k| height(k / n2, k % n2))).unwrap();
    array.finish().unwrap();
    desk.write("surface.npy", file);
    desk.write("waves.toml", CASE);
    desk.solve("waves", &["waves.toml", "--no-pictures"])
}

#[test]
fn a_topography_is_pressed_where_it_is_high() {
    let desk = Desk::new();
    let folder = solve(&desk);
    let mut contact = folder.contact();
    let [pressure, displacement, gap] = ["pressure", "displacement", "gap"].map(|name| contact.field(name));
    assert_eq!(pressure.shape, [1, POINTS[0], POINTS[1]]);
    let samples = POINTS[0] * POINTS[1];
    assert_close(pressure.values.iter().sum::<f64>() / samples as f64, 0.003, 1e-12);
    let penetration = contact.field("penetration").values[0];
    let heights: Vec<f64> = (0..samples).map(|k| height(k / POINTS[1], k % POINTS[1])).collect();
    // Both crests meet between the samples.
    let apex = 1.5 * AMPLITUDE;
    assert!(heights.iter().all(|height| *height < apex - 1e-6));
    for k in 0..samples {
        let gap_expected = displacement.values[k] + apex - heights[k] - penetration;
        assert!((gap.values[k] - gap_expected).abs() < 1e-12, "sample {k}");
    }
    assert!(pressure.values.contains(&0.0), "contact is partial");
    assert!(folder.steps()[0]["levels"].as_array().unwrap().is_empty(), "a topography has no levels");
}

const ROUGH: [&str; 6] =
    ["--set", "grid.points=64", "--set", "surface.random.shortest=2.5", "--set", "load.mean_pressure=[0.05,0.1,0.2]"];

#[test]
fn a_rough_contact_has_its_area_spots_gap_stiffness_and_histograms() {
    let desk = Desk::new();
    let folder = desk.solve("rough", &[&["rough", "--no-pictures"], &ROUGH[..]].concat());
    let steps = folder.steps();
    let mut contact = folder.contact();
    let gap = contact.field("gap");
    let samples = 64 * 64;
    for (k, step) in steps.iter().enumerate() {
        let rough = |key: &str| number(step, &format!("/rough/{key}"));
        let (counted, corrected) = (rough("counted_fraction"), rough("corrected_fraction"));
        assert!(0.0 < corrected && corrected < counted && counted < 1.0);
        let mean = gap.values[k * samples..][..samples].iter().map(|gap| gap.max(0.0)).sum::<f64>() / samples as f64;
        assert_close(rough("mean_gap"), mean, 1e-6);
        assert!(rough("stiffness") > 0.0 && rough("stiffness_error") < 0.2 * rough("stiffness"));
        assert_eq!(rough("spots/count"), number(step, "/contact_spots"));
    }
    let text = folder.text("histograms.csv");
    let mut sums = [0.0; 2];
    for line in text.lines().skip(1).filter(|line| line.starts_with("2,")) {
        let cells: Vec<&str> = line.split(',').collect();
        let part =
            cells[5].parse::<f64>().unwrap() * (cells[3].parse::<f64>().unwrap() - cells[2].parse::<f64>().unwrap());
        match cells[1] {
            "pressure" => sums[0] += part,
            "gap" => sums[1] += part,
            other => assert_eq!(other, "spot_area"),
        }
    }
    assert_close(sums[0], number(&steps[1], "/rough/counted_fraction"), 1e-12);
    assert_close(sums[0] + sums[1], 1.0, 1e-12);
    assert!(!folder.text("curve.csv").lines().next().unwrap().contains("histogram"));
}

/// A number with its error as the table and the report have it.
#[test]
fn the_table_and_the_report_of_a_topography_print_the_same_numbers_with_their_errors() {
    let desk = Desk::new();
    let sets =
        ["--set", "grid.points=64", "--set", "surface.random.shortest=5", "--set", "load.mean_pressure=[0.05, 0.1]"];
    let answer = desk.succeeds(&[&["solve", "rough", "-o", "out", "--no-pictures"], &sets[..]].concat());
    desk.succeeds(&["report", "out"]);
    let page = Folder(desk.path("out")).text("report.html").replace('\u{a0}', " ");
    let mut rows = answer.out.lines().filter(|line| line.contains('%') && line.contains(" ± "));
    let last = rows.next_back().expect("a row of the last step");
    let cells: Vec<&str> = last.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect();
    // Penetration, contact, peak pressure and elastic energy; the mean pressure is prescribed.
    assert_eq!(cells.len(), 5, "{last}");
    for cell in &cells[1..] {
        assert!(cell.contains(" ± "), "{cell} has no error: {last}");
        assert!(page.matches(cell.trim_end_matches(" %")).count() >= 2, "{cell} is not in the answer and the table");
    }
}

#[test]
fn check_describes_a_surface_and_writes_its_spectrum_where_it_is_asked_to() {
    let desk = Desk::new();
    let asked = [&["check", "rough"], &ROUGH[..]].concat();
    let answer = desk.percoat(&asked);
    assert!(answer.code == 0 && desk.names().is_empty(), "{} {:?}", answer.err, desk.names());
    assert!(answer.out.contains("rms slope 0.020000") && answer.out.contains("kurtosis"), "{}", answer.out);
    for _ in 0..2 {
        let answer = desk.percoat(&[&asked[..], &["-o", "spectrum"]].concat());
        assert!(answer.code == 0 && answer.out.contains("written to spectrum"), "{}", answer.err);
        let table = std::fs::read_to_string(desk.path("spectrum/spectrum.csv")).unwrap();
        assert!(table.starts_with("wavenumber,density,waves,density_times_4pi2\n") && table.lines().count() > 10);
        assert!(answer.out.contains("h_rms² = ∫ C d²q"), "{}", answer.out);
        // Σ C over the waves times their share (2π/l)² of the plane of wavevectors is the mean square of the heights.
        let rows: Vec<Vec<f64>> =
            table.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
        let square: f64 = rows.iter().map(|row| row[1] * row[2] * (TAU / 40.0).powi(2)).sum();
        let mut told = answer.out.split("rms height ").nth(1).unwrap().split(&[' ', '\u{a0}', ','][..]);
        let (rms, unit): (f64, &str) = (told.next().unwrap().parse().unwrap(), told.next().unwrap());
        assert_close(square.sqrt(), rms * if unit == "nm" { 1e-3 } else { 1.0 }, 1e-3);
        assert!(rows.iter().all(|row| (row[3] / (TAU * TAU * row[1]) - 1.0).abs() < 1e-12));
        assert!(std::fs::read(desk.path("spectrum/spectrum.png")).unwrap().starts_with(b"\x89PNG"));
    }
    desk.write("spectrum/spectrum.csv", "mine");
    desk.percoat(&[&asked[..], &["-o", "spectrum"]].concat()).complains(2, &["was changed since percoat wrote it"]);
    desk.percoat(&["check", "fig2", "-o", "some"]).complains(2, &["[surface]"]);
}

#[test]
fn check_draws_which_index_runs_where() {
    let desk = Desk::new();
    desk.write("surface.csv", "0,0,0\n0,1,0\n0,0,0\n");
    desk.write("waves.toml", CASE.replace("surface.npy", "surface.csv"));
    let answer = desk.percoat(&["check", "waves.toml"]);
    assert!(answer.code == 0 && answer.out.contains("\n   a₂ ↑"), "{}", answer.err);
}

/// The border of a window lies below all heights: it carries nothing at loads at which a border at the mean plane is pressed.
#[test]
fn the_border_of_a_window_carries_nothing_and_load_on_tapered_heights_is_told() {
    let desk = Desk::new();
    let height = |i: usize, j: usize| {
        let (s, t) = (i as f64 / 48.0, j as f64 / 48.0);
        AMPLITUDE * ((TAU * 5.3 * s).cos() + (TAU * 4.7 * t + 1.0).cos() + s)
    };
    let line = |i: usize| (0..48).map(|j| format!("{:.8}", height(i, j))).collect::<Vec<_>>().join(" ") + "\n";
    desk.write("surface.txt", (0..48).map(line).collect::<String>());
    desk.write("waves.toml", CASE.replace("surface.npy", "surface.txt"));
    for (window, load, told) in [("tukey", "0.05", "press less"), ("hann", "0.03", "made for spectra")] {
        let set = format!("surface={{ heights = \"surface.txt\", level = true, window = \"{window}\" }}");
        let arguments = ["solve", "waves.toml", "-o", window, "--no-pictures", "--set", &set, "--set"];
        let load = format!("load.mean_pressure={load}");
        let answer = desk.succeeds(&[&arguments[..], &[&load]].concat());
        let folder = Folder(desk.path(window));
        let pressure = folder.contact().field("pressure").values;
        let is_border = |k: usize| [k / 48, k % 48].iter().any(|index| [0, 47].contains(index));
        assert!((0..48 * 48).all(|k| !is_border(k) || pressure[k] == 0.0), "{window}");
        let step = &folder.steps()[0];
        let parts = ["load", "area"].map(|part| number(step, &format!("/tapered/{part}")));
        assert!(parts.iter().all(|part| (0.02..=1.0).contains(part)), "{parts:?}");
        assert!(answer.err.contains("surface.window: up to") && answer.err.contains(told), "{}", answer.err);
    }
    let set = "surface={ heights = \"surface.txt\", level = true }";
    let plain = desk.percoat(&["solve", "waves.toml", "-o", "plain", "--no-pictures", "--set", set]);
    assert!(!plain.err.contains("surface.window: up to"), "{}", plain.err);
}

/// Treatment of a measured ball with noise and a hole stands in the check with its rms values, and in Python's JSON.
#[test]
fn check_says_what_was_done_to_the_heights_of_a_file() {
    let desk = Desk::new();
    // splitmix64, between −½ and ½.
    let noise = |i: usize, j: usize| {
        let state = ((64 * i + j + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) as f64 / u64::MAX as f64 - 0.5
    };
    let height = |i: usize, j: usize| {
        let (x, y) = (i as f64 - 31.5, j as f64 - 31.5);
        if (i, j) == (20, 30) { f64::NAN } else { (4e6 - x * x - y * y).sqrt() - 2000.0 + 0.01 * noise(i, j) }
    };
    let text: String =
        (0..64).map(|i| (0..64).map(|j| format!("{:.6}", height(i, j))).collect::<Vec<_>>().join(" ") + "\n").collect();
    desk.write("ball.txt", text);
    let case = |more: &str| {
        format!(
            "[units]\nlength = \"µm\"\n[surface]\nheights = \"ball.txt\"\npixel = 1\n{more}\n[substrate]\nyoung = 1\npoisson = 0.3\n[load]\n\
             mean_pressure = 1e-3\n"
        )
    };
    desk.write("case.toml", case("form = \"sphere\"\nwindow = true"));
    let answer = desk.percoat(&["check", "case.toml"]);
    let out = answer.out.replace('\u{a0}', " ");
    assert_eq!(answer.code, 0, "{}", answer.err);
    assert!(
        out.contains("heights of the file, rms height and rms slope of neighbours:\n  as read: 0.1")
            && out.contains("  without its sphere of radius "),
        "{out}"
    );
    assert!(out.contains("  0.024414 % of the places filled: "), "{out}");
    assert!(
        answer.err.contains("1 of 4096 places") && answer.err.contains("look like noise of the instrument"),
        "{}",
        answer.err
    );
    desk.write("case.toml", case("form = \"sphere\"\ncutoff = 8\nwindow = true"));
    let answer = desk.percoat(&["check", "case.toml"]);
    assert!(
        answer.out.contains("  waves below 8.0000\u{a0}µm weakened (border: only samples that exist): "),
        "{}",
        answer.out
    );
    assert!(!answer.err.contains("noise"), "{}", answer.err);
}

//! `[surface]`: a topography from a NumPy file through the command line.

use crate::program::{Desk, Folder, assert_close};
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
    desk.solve("waves", &["waves.toml"])
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
    let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for k in 0..samples {
        let gap_expected = displacement.values[k] + highest - heights[k] - penetration;
        assert!((gap.values[k] - gap_expected).abs() < 1e-12, "sample {k}");
    }
    assert!(pressure.values.contains(&0.0), "contact is partial");
    assert!(folder.steps()[0]["levels"].as_array().unwrap().is_empty(), "a topography has no levels");
}

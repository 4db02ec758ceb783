//! `[stress]` of a case, through to `stress.npz`, the summary and the volume.

use crate::archive::Archive;
use crate::program::{Desk, number};
use std::fs;

const STRESS: [&str; 13] = [
    "fig6b",
    "--no-pictures",
    "--set",
    "grid.points=72",
    "--set",
    "load.mean_pressure=[0.002, 0.004]",
    "--set",
    "stress.planes=[0.0, 0.023, 0.1]",
    "--set",
    "stress.points=[[0.0, 0.0, 0.01], [0.1, 0.0, 0.023]]",
    "--set",
    "stress.volume={ depth = 0.1, rows = 5, points = 12 }",
    "--quiet",
];

#[test]
fn stresses_have_their_shapes_and_agree_with_each_other() {
    let desk = Desk::new();
    let folder = desk.solve("out", &STRESS);
    let mut stress = Archive::open(&folder.0.join("stress.npz"));
    assert_eq!(stress.field("planes_z").values, [0.0, 0.023, 0.023, 0.1]);
    assert_eq!(stress.array::<i32>("planes_side").values, [1, 1, 2, 2]);
    let (s, z) = (stress.field("section_s").values, stress.field("section_z").values);
    assert!(s[0] == 0.0 && (s[s.len() - 1] - 0.6).abs() < 1e-12 && z[0] == 0.0);
    assert_eq!(z.iter().filter(|&&z| z == 0.023).count(), 2, "both sides of the interface");
    for name in ["xx", "yy", "zz", "xy", "xz", "yz", "tau1", "mises", "s1", "ux", "uy", "uz"] {
        assert_eq!(stress.field(&format!("planes_{name}")).shape, [2, 4, 72, 72], "{name}");
        assert_eq!(stress.field(&format!("section_{name}")).shape, [2, z.len(), s.len()], "{name}");
        assert_eq!(stress.field(&format!("points_{name}")).shape, [2, 3], "the second point has two sides");
    }
    // The section starts at the indenter of level 1, which is sample (0, 0): σ_zz = −p there.
    let pressure = Archive::open(&folder.0.join("contact.npz")).field("pressure").values;
    let (planes, section) = (stress.field("planes_zz").values, stress.field("section_zz").values);
    // The section smooths what the grid cannot hold: a pressure like √(1 − r²/a²) by (1.24/n)⁴ of its peak at most, with
    // n ≥ 4 samples along the radius.
    assert!((planes[0] + pressure[0]).abs() < 1e-12 && (section[0] / pressure[0] + 1.0).abs() < 1e-2);
    // The largest values stand in the summary, and are not below those of any plane or of the section.
    let summary = folder.summary();
    for (step, name) in [(0, "tau1"), (1, "tau1"), (0, "s1"), (1, "s1")] {
        let stress_of_step = &summary["steps"][step]["stress"];
        let key = if name == "tau1" { "max_tau1" } else { "max_tension" };
        let largest = number(&stress_of_step[key], "/value");
        let section = stress.field(&format!("section_{name}")).values;
        let half = section.len() / 2;
        let found = section[step * half..(step + 1) * half].iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // At the surface samples are taken as they are: the error there is the one the step states.
        let error = number(stress_of_step, "/surface_error");
        assert!(largest >= found - error * largest.abs(), "{name} of step {step}: {largest} below {found}");
        assert_eq!(stress_of_step["materials"].as_array().unwrap().len(), 2);
        assert_eq!(stress_of_step["faces"].as_array().unwrap().len(), 3, "surface, and both sides of the interface");
    }
    let curve = fs::read_to_string(folder.0.join("curve.csv")).unwrap();
    assert!(curve.lines().next().unwrap().contains("stress_materials_1_max_tau1_value"));
    assert!(folder.names().contains("stress.0002.vts") && !folder.names().contains("stress.partial"));
}

/// Hooke's law on planes, on the section and at points of both materials; every other number and file is that of a run without strains.
#[test]
fn strains_stand_beside_the_stresses_and_change_nothing_else() {
    let desk = Desk::new();
    let (without, with) = (
        desk.solve("without", &STRESS),
        desk.solve("with", &[&STRESS[..], &["--set", "stress.strain=true"][..]].concat()),
    );
    let (mut unstrained, mut strained) =
        (Archive::open(&without.0.join("stress.npz")), Archive::open(&with.0.join("stress.npz")));
    let summary = with.summary();
    let layer = &summary["case"]["layers"][0];
    let [nu, lower] =
        [&layer["poisson"], &summary["case"]["substrate"]["poisson"]].map(|poisson| poisson.as_f64().unwrap());
    let substrate = summary["case"]["substrate"]["young"].as_f64().unwrap();
    let coating = layer["shear_ratio"].as_f64().unwrap() * substrate * (1.0 + nu) / (1.0 + lower);
    let sides = ["planes", "section", "points"].map(|place| strained.array::<i32>(&format!("{place}_side")).values);
    for (place, sides) in ["planes", "section", "points"].into_iter().zip(sides) {
        let mut read = |name: &str| strained.field(&format!("{place}_{name}")).values;
        let [xx, yy, zz, xz] = ["xx", "yy", "zz", "xz"].map(&mut read);
        let [exx, eyy, ezz, exz, e1, e3, ev] = ["exx", "eyy", "ezz", "exz", "e1", "e3", "ev"].map(&mut read);
        assert_eq!(xx, unstrained.field(&format!("{place}_xx")).values, "{place}");
        // Arrays are (steps, sides, …).
        let count = xx.len() / 2 / sides.len();
        for k in 0..xx.len() {
            let (modulus, nu) = if sides[k / count % sides.len()] == 1 { (coating, nu) } else { (substrate, lower) };
            let trace = xx[k] + yy[k] + zz[k];
            let size = (xx[k].abs() + yy[k].abs() + zz[k].abs() + xz[k].abs()) / modulus;
            let due = [((1.0 + nu) * xx[k] - nu * trace) / modulus, ((1.0 + nu) * zz[k] - nu * trace) / modulus];
            assert!((exx[k] - due[0]).abs() < 1e-12 * size && (ezz[k] - due[1]).abs() < 1e-12 * size, "{place}, {k}");
            assert!((exz[k] - (1.0 + nu) * xz[k] / modulus).abs() < 1e-12 * size, "{place}, {k}");
            assert!((ev[k] - (exx[k] + eyy[k] + ezz[k])).abs() < 1e-12 * size, "{place}, {k}");
            let most = exx[k].max(eyy[k]).max(ezz[k]);
            assert!(e1[k] >= most - 1e-7 * size && e3[k] <= ezz[k].min(exx[k]) + 1e-7 * size, "{place}, {k}");
        }
    }
    assert!(
        unstrained.names().iter().all(|name| !name.ends_with("_exx") && !name.ends_with("_ev")),
        "{:?}",
        unstrained.names()
    );
    assert_eq!(with.names(), without.names());
    let curves = [&with, &without].map(|run| run.text("curve.csv"));
    assert!(curves[0].contains("stress_materials_1_max_strain_value") && !curves[1].contains("strain"));
    let [case, plain] = [&with, &without].map(|run| run.text("case.toml"));
    assert!(case.replace("strain = true\n", "") == plain && case != plain, "{case}");
}

#[test]
fn a_direction_is_as_good_as_a_level_and_the_mean_has_two_names() {
    let desk = Desk::new();
    let section = |toward: &str, mean: &str, name: &str| {
        let cut = format!("stress.section={{ from = \"level 1\", toward = {toward}, length = 0.3, depth = 0.05 }}");
        let mean = format!("stress.mean=\"{mean}\"");
        let grid = ["fig6b", "--no-pictures", "--set", "grid.points=48"];
        let more = [&grid[..], &["--set", "stress.planes=[]", "--set", &cut, "--set", &mean]].concat();
        Archive::open(&desk.solve(name, &more).0.join("stress.npz")).field("section_xx").values
    };
    let toward_level = section("\"level 2\"", "confined", "a");
    let along = section("[3.0, 1.7320508075688772]", "confined", "b");
    let scale = toward_level.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(toward_level.iter().zip(&along).all(|(a, b)| (a - b).abs() < 1e-9 * scale));
    // The means differ by a constant in each material.
    let wide = section("\"level 2\"", "half-space", "c");
    let shift = wide[0] - toward_level[0];
    assert!(shift.abs() > 1e-5 && (wide[5] - toward_level[5] - shift).abs() < 1e-9 * scale);
    desk.percoat(&["solve", "fig6b", "--set", "stress.mean=\"free\""]).complains(2, &["confined", "half-space"]);
    let nowhere = "stress.section={ from = \"level 1\", toward = [0.0, 0.0], length = 1.0, depth = 1.0 }";
    desk.percoat(&["solve", "fig6b", "--set", nowhere]).complains(2, &["direction"]);
}

#[test]
fn a_step_without_contact_has_no_largest_stresses_and_the_curve_keeps_its_columns() {
    let desk = Desk::new();
    let sets = ["--set", "grid.points=48", "--set", "load.mean_pressure=[0.0, 0.002]"];
    let folder = desk.solve("out", &[&["fig6b", "--no-pictures"], &sets[..]].concat());
    let none = &folder.steps()[0];
    assert_eq!((number(none, "/penetration"), number(none, "/contact_fraction")), (0.0, 0.0));
    assert_eq!((&none["stop_reason"], &none["converged"]), (&"no_contact".into(), &true.into()));
    let curve = fs::read_to_string(folder.0.join("curve.csv")).unwrap();
    let lines: Vec<Vec<&str>> = curve.lines().map(|line| line.split(',').collect()).collect();
    assert!(lines.iter().all(|line| line.len() == lines[0].len()));
    let column = lines[0].iter().position(|name| *name == "stress_max_tau1_value").unwrap();
    assert!(lines[1][column].is_empty() && lines[2][column].parse::<f64>().unwrap() > 0.0);
}

//! The output folder: which files, which keys, and that they agree with one another.

use crate::program::{Desk, Folder, assert_close, number};
use serde_json::Value;
use std::collections::BTreeSet;

const FILES: [&str; 4] = ["case.toml", "contact.npz", "curve.csv", "summary.json"];

const SMALL: [&str; 3] = ["--no-pictures", "--set", "grid.points=48"];

/// The default case in two steps on a grid that has a sample at each apex.
fn two_steps(desk: &Desk) -> Folder {
    desk.solve("two", &[&SMALL[..], &["--set", "load.mean_pressure=[0.02, 0.06]"]].concat())
}

/// Whether the folder holds the files of a finished run, and beside them at most pictures.
fn assert_finished(folder: &Folder) {
    let is_picture = |name: &String| name.ends_with(".png") || name.ends_with(".svg");
    let files: BTreeSet<String> = folder.names().into_iter().filter(|name| !is_picture(name)).collect();
    assert_eq!(files, FILES.map(str::to_owned).into());
}

fn assert_keys(value: &Value, keys: &[&str]) {
    for key in keys {
        assert!(value.get(key).is_some(), "no `{key}` in {value}");
    }
}

#[test]
fn a_finished_run_leaves_its_files_and_nothing_temporary_and_a_second_one_replaces_them() {
    let desk = Desk::new();
    assert_finished(&two_steps(&desk));
    let again = desk.solve("two", &["--set", "grid.points=64", "--set", "load.mean_pressure=0.03"]);
    let fresh = desk.solve("fresh", &["--set", "grid.points=64", "--set", "load.mean_pressure=0.03"]);
    assert_finished(&again);
    for name in FILES {
        assert!(again.result(name) == fresh.result(name), "{name} is not that of the second run");
    }
}

#[test]
fn the_summary_has_the_keys_of_the_interface() {
    let summary = two_steps(&Desk::new()).summary();
    assert_keys(&summary, &["percoat", "title", "case", "steps", "timing"]);
    assert_eq!(summary["percoat"], env!("CARGO_PKG_VERSION"));
    assert_keys(&summary["case"], &["title", "lattice", "levels", "layers", "substrate", "load", "grid", "solver"]);
    let steps = summary["steps"].as_array().unwrap();
    assert_eq!(steps.len(), 2);
    for step in steps {
        #[rustfmt::skip]
        assert_keys(step, &[
            "mean_pressure", "penetration", "additional_displacement", "contact_fraction", "converged", "stop_reason",
            "iterations", "convolutions", "residual", "certificate", "points", "levels",
        ]);
        assert_keys(&step["certificate"], &["energy_gap", "penetration", "load"]);
        assert_eq!((&step["converged"], &step["stop_reason"]), (&true.into(), &"converged".into()));
        assert!(number(step, "/residual") < 1e-8);
        assert_eq!(step["points"], serde_json::json!([48, 48]));
        let levels = step["levels"].as_array().unwrap();
        assert_eq!(levels.len(), 3);
        for (index, level) in (1..).zip(levels) {
            #[rustfmt::skip]
            assert_keys(level, &[
                "level", "load", "load_share", "max_pressure", "contact_area", "contact_radius", "radius_min",
                "radius_max", "asymmetry",
            ]);
            assert_eq!(level["level"], index);
        }
    }
}

#[test]
fn loads_areas_and_radii_of_the_levels_are_consistent() {
    let desk = Desk::new();
    let folder = two_steps(&desk);
    let cell = 1.5 * 3f64.sqrt();
    for step in folder.steps() {
        let levels = step["levels"].as_array().unwrap();
        let sum = |key: &str| levels.iter().map(|level| number(level, key)).sum::<f64>();
        assert_close(sum("/load_share"), 1.0, 1e-12);
        assert_close(sum("/load"), number(&step, "/mean_pressure") * cell, 1e-12);
        assert_close(sum("/contact_area"), number(&step, "/contact_fraction") * cell, 1e-12);
        let peak = levels.iter().map(|level| number(level, "/max_pressure")).fold(0.0, f64::max);
        assert_eq!(peak, number(&step, "/max_pressure"));
        for level in levels {
            assert_close(
                number(level, "/contact_radius").powi(2) * std::f64::consts::PI,
                number(level, "/contact_area"),
                1e-12,
            );
        }
    }
}

#[test]
fn the_fields_have_their_shapes() {
    let desk = Desk::new();
    let mut contact = two_steps(&desk).contact();
    #[rustfmt::skip]
    let shapes: [(&str, &[usize]); 10] = [
        ("a1", &[2]), ("a2", &[2]), ("x", &[48, 48]), ("y", &[48, 48]), ("mean_pressure", &[2]), ("penetration", &[2]),
        ("force", &[2]), ("pressure", &[2, 48, 48]), ("displacement", &[2, 48, 48]), ("gap", &[2, 48, 48]),
    ];
    for (name, shape) in shapes {
        assert_eq!(contact.field(name).shape, shape, "{name}");
    }
    assert_eq!(contact.array::<i32>("owner").shape, [48, 48]);
    assert_eq!(contact.names().len(), shapes.len() + 1);
}

#[test]
fn samples_stand_where_the_cell_vectors_put_them() {
    let desk = Desk::new();
    let mut contact = two_steps(&desk).contact();
    let (a1, a2) = (contact.field("a1").values, contact.field("a2").values);
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        for (index, here) in contact.field(name).values.into_iter().enumerate() {
            let (s, t) = ((index / 48) as f64 / 48.0, (index % 48) as f64 / 48.0);
            assert!((here - (s * a1[axis] + t * a2[axis])).abs() < 1e-12, "{name}[{}, {}]", index / 48, index % 48);
        }
    }
}

#[test]
fn the_fields_are_in_equilibrium_and_complementary() {
    let desk = Desk::new();
    let folder = two_steps(&desk);
    let mut contact = folder.contact();
    let [pressure, displacement, gap] = ["pressure", "displacement", "gap"].map(|name| contact.field(name).values);
    let [loads, penetrations] = ["mean_pressure", "penetration"].map(|name| contact.field(name).values);
    let samples = 48 * 48;
    for (index, step) in folder.steps().iter().enumerate() {
        assert_eq!(loads[index], number(step, "/mean_pressure"));
        assert_eq!(penetrations[index], number(step, "/penetration"));
        let of_step = |field: &'_ [f64]| field[index * samples..(index + 1) * samples].to_vec();
        let (p, w, g) = (of_step(&pressure), of_step(&displacement), of_step(&gap));
        let mean = p.iter().sum::<f64>() / samples as f64;
        assert_close(mean, [0.02, 0.06][index], 1e-12);
        assert!(p.iter().all(|&p| p >= 0.0));
        assert!(w.iter().sum::<f64>().abs() / (samples as f64) < 1e-12, "displacements have zero mean");
        let complementarity = p.iter().zip(&g).map(|(p, g)| p * g.abs()).sum::<f64>();
        assert!(complementarity < 1e-8 * penetrations[index] * mean * samples as f64, "Σ p|g| = {complementarity:e}");
        let deepest = g.iter().zip(&p).filter(|(_, p)| **p == 0.0).map(|(g, _)| -g).fold(0.0, f64::max);
        assert!(deepest < 1e-7 * penetrations[index], "the bodies overlap by {deepest:e}");
        let touching = p.iter().filter(|p| **p > 0.0).count() as f64 / samples as f64;
        assert!((touching - number(step, "/contact_fraction")).abs() < 0.02);
    }
}

/// The surface of the indenters the slow way: every image of every one.
#[test]
fn gap_is_displacement_plus_shape_less_penetration() {
    let desk = Desk::new();
    let folder = two_steps(&desk);
    let mut contact = folder.contact();
    let [x, y, a1, a2] = ["x", "y", "a1", "a2"].map(|name| contact.field(name).values);
    let [displacement, gap, penetration] =
        ["displacement", "gap", "penetration"].map(|name| contact.field(name).values);
    let owner: Vec<i32> = contact.array("owner").values;
    assert_eq!(owner.iter().copied().collect::<BTreeSet<i32>>(), BTreeSet::from([1, 2, 3]));

    let shape = |step: usize, i: usize| gap[step * 48 * 48 + i] - displacement[step * 48 * 48 + i] + penetration[step];
    // Paraboloids of radius 0.8 whose apexes lie 0, 0.01 and 0.02 below the highest one.
    let (radius, drops) = (0.8, [0.0, 0.01, 0.02]);
    let apexes: Vec<usize> = (1..=3)
        .map(|level| {
            let samples = (0..48 * 48).filter(|&i| owner[i] == level);
            samples.min_by(|&a, &b| shape(0, a).total_cmp(&shape(0, b))).unwrap()
        })
        .collect();
    for index in 0..48 * 48 {
        let heights = (0..3).map(|level| {
            let apart = [x[index] - x[apexes[level]], y[index] - y[apexes[level]]];
            let square = (-2..=2)
                .flat_map(|m| (-2..=2).map(move |n| [f64::from(m), f64::from(n)]))
                .map(|[m, n]| [0, 1].map(|axis| apart[axis] - m * a1[axis] - n * a2[axis]))
                .map(|[x, y]| x * x + y * y)
                .fold(f64::INFINITY, f64::min);
            (level, square / (2.0 * radius) + drops[level])
        });
        let (level, least) = heights.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        for step in 0..2 {
            assert!((shape(step, index) - least).abs() < 1e-12, "sample {index}: {} ≠ {least}", shape(step, index));
        }
        let facing = owner[index] as usize - 1;
        // On a border between two levels either may be the owner.
        let border = facing != level && shape(0, index) - least > -1e-12;
        assert!(facing == level || border, "sample {index} faces level {}", level + 1);
    }
}

#[test]
fn the_curve_has_a_row_a_step_and_a_column_a_scalar() {
    let desk = Desk::new();
    let folder = two_steps(&desk);
    let text = folder.text("curve.csv");
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = rows.next().unwrap();
    let rows: Vec<Vec<&str>> = rows.collect();
    let steps = folder.steps();
    assert_eq!(rows.len(), steps.len());
    for (row, step) in rows.iter().zip(&steps) {
        assert_eq!(row.len(), names.len());
        let scalars = scalars(step, "");
        assert_eq!(scalars.len(), names.len());
        for (name, value) in scalars {
            let column = names.iter().position(|known| *known == name);
            let cell = row[column.unwrap_or_else(|| panic!("no column {name}"))];
            match value {
                Value::Number(value) => assert_eq!(cell.parse(), Ok(value.as_f64().unwrap()), "{name}"),
                Value::String(value) => assert_eq!(cell, value, "{name}"),
                Value::Null => assert_eq!(cell, "", "{name}"),
                value => assert_eq!(cell, value.to_string(), "{name}"),
            }
        }
    }
}

/// Every scalar of a step with its name, items of lists counted from 1.
fn scalars(value: &Value, name: &str) -> Vec<(String, Value)> {
    let joined = |key: &str| if name.is_empty() { key.to_owned() } else { format!("{name}_{key}") };
    match value {
        Value::Object(map) => map.iter().flat_map(|(key, value)| scalars(value, &joined(key))).collect(),
        Value::Array(items) => {
            (1..).zip(items).flat_map(|(item, value): (usize, _)| scalars(value, &joined(&item.to_string()))).collect()
        }
        scalar => vec![(name.to_owned(), scalar.clone())],
    }
}

#[test]
fn the_case_as_run_runs_again_to_the_same_numbers() {
    let desk = Desk::new();
    let first = two_steps(&desk);
    let again = desk.solve("again", &["two/case.toml", "--no-pictures"]);
    for name in FILES {
        assert!(first.result(name) == again.result(name), "{name} differs");
    }
}

/// A case of the user's own with a comment, in the folder `name`.
fn own_case(desk: &Desk, name: &str) -> String {
    let text = format!("# Measured on Monday.\n{}", desk.percoat(&["cases", "fig2"]).out);
    std::fs::create_dir(desk.path(name)).unwrap();
    desk.write(&format!("{name}/case.toml"), &text);
    text
}

fn solve_into(desk: &Desk, name: &str, arguments: &[&str]) -> crate::program::Answer {
    desk.percoat(&[&["solve", "-o", name], arguments, &SMALL[..]].concat())
}

#[test]
fn a_users_own_case_is_not_rewritten_and_nothing_is_written_beside_it() {
    let desk = Desk::new();
    let text = own_case(&desk, "mine");
    solve_into(&desk, "mine", &["mine/case.toml"]).complains(2, &["mine/case.toml", "not listed", "-o", "move it"]);
    let mine = Folder(desk.path("mine"));
    assert_eq!((mine.text("case.toml"), mine.all_names()), (text, ["case.toml".to_owned()].into()));
}

#[test]
fn a_users_case_that_is_the_one_to_be_written_stays_theirs() {
    let desk = Desk::new();
    let text = desk.solve("run", &SMALL).text("case.toml");
    std::fs::create_dir(desk.path("mine")).unwrap();
    desk.write("mine/case.toml", &text);
    solve_into(&desk, "mine", &["mine/case.toml"]).succeeds();
    assert_finished(&Folder(desk.path("mine")));
    solve_into(&desk, "mine", &["--set", "load.mean_pressure=0.01"]).complains(2, &["mine/case.toml"]);
    assert_eq!(Folder(desk.path("mine")).text("case.toml"), text);
}

#[test]
fn a_users_picture_is_in_the_way_only_of_a_run_that_draws_one_of_that_name() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("mine")).unwrap();
    desk.write("mine/section.png", "an electron micrograph");
    let mine = Folder(desk.path("mine"));
    let with_section = ["solve", "-o", "mine", "fig6b", "--set", "grid.points=48"];
    desk.percoat(&with_section).complains(2, &["mine/section.png"]);
    assert_eq!(mine.all_names(), ["section.png".to_owned()].into());
    solve_into(&desk, "mine", &["fig6b"]).succeeds();
    assert_eq!(mine.text("section.png"), "an electron micrograph");
    assert!(mine.names().contains("stress.npz"));
}

#[test]
fn files_and_folders_of_a_user_that_a_run_does_not_write_stay_whatever_they_are_called() {
    let desk = Desk::new();
    std::fs::create_dir_all(desk.path("mine/contact.partial")).unwrap();
    let names =
        ["mine/stress.0007.vts", "mine/contact.partial/notes.txt", "mine/.summary.json.4711.tmp", "mine/curve.svg"];
    names.iter().for_each(|name| desk.write(name, "mine"));
    for _ in 0..2 {
        solve_into(&desk, "mine", &[]).succeeds();
        let texts = names.map(|name| std::fs::read_to_string(desk.path(name)).unwrap());
        assert_eq!(texts, names.map(|_| "mine".to_owned()));
    }
}

#[test]
fn files_of_the_run_before_that_the_next_one_does_not_have_go() {
    let desk = Desk::new();
    let stress = ["fig6b", "--set", "load.mean_pressure=[0.001, 0.002]", "--set"];
    let volume = "stress.volume={ depth = 1.0, points = 8, rows = 8 }";
    solve_into(&desk, "run", &[&stress[..], &[volume]].concat()).succeeds();
    let run = Folder(desk.path("run"));
    assert!(["stress.npz", "stress.0001.vts", "stress.0002.vts"].iter().all(|&name| run.names().contains(name)));
    desk.write("run/stress.0003.vts", "mine");
    solve_into(&desk, "run", &[]).succeeds();
    let left: BTreeSet<String> = FILES.iter().copied().chain(["stress.0003.vts"]).map(str::to_owned).collect();
    assert_eq!(run.names(), left);
    let kept = Folder(desk.path("run/.percoat")).all_names();
    assert_eq!(kept, ["lock", "written.json"].map(str::to_owned).into());
}

#[test]
fn a_result_that_was_edited_or_is_not_listed_is_not_replaced() {
    let desk = Desk::new();
    let run = desk.solve("run", &SMALL);
    let curve = run.text("curve.csv");
    desk.write("run/curve.csv", format!("{curve}# compare with Monday\n"));
    let mut before = run.files();
    solve_into(&desk, "run", &[]).complains(2, &["run/curve.csv", "changed since"]);
    assert!(run.files() == before && !run.names().contains("unfinished"));
    desk.write("run/curve.csv", &curve);
    solve_into(&desk, "run", &[]).succeeds();
    before = run.files();
    // The folder as versions that kept no list left it.
    std::fs::remove_dir_all(desk.path("run/.percoat")).unwrap();
    solve_into(&desk, "run", &[]).complains(2, &["run/contact.npz", "not listed"]);
    assert!(run.files() == before);
}

#[test]
fn solve_and_compare_share_a_folder_and_replace_their_own_files_alone() {
    let desk = Desk::new();
    let compare = || {
        let small = ["--set", "localized.elements=8", "--set", "localized.indenters=[7]"];
        desk.succeeds(&[&["compare", "-o", "run"], &SMALL[..], &small].concat());
    };
    let run = desk.solve("run", &SMALL);
    let solved = run.files();
    compare();
    let mut both = run.files();
    assert!(solved.iter().all(|(name, content)| both[name] == *content));
    solve_into(&desk, "run", &["--set", "load.mean_pressure=0.01"]).succeeds();
    assert!(run.bytes("compare.json") == both["compare.json"] && run.bytes("curve.csv") != both["curve.csv"]);
    both = run.files();
    compare();
    assert!(run.files() == both);
    desk.write("run/compare.json", "mine");
    desk.percoat(&[&["compare", "-o", "run"], &SMALL[..]].concat()).complains(2, &["compare.json"]);
    assert_eq!(run.text("compare.json"), "mine");
}

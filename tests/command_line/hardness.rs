//! Words where hardness ends an answer: refused, in the table, in warnings, in the summary and in the report.

use crate::program::{Desk, Folder};

/// A hard thin coating on steel under a small ball: the coating bears the pressure, the steel below it does not.
const THIN: &str = r#"
lattice = { kind = "isolated", size = 12.0 }
levels = [{ shape = "sphere", radius = 20.0 }]
layers = [{ material = "TiN", thickness = 0.25 }]
substrate = { material = "C45" }
load = { force = [20.0, 60.0] }
units = { length = "µm", pressure = "GPa" }
grid = { points = 48 }
"#;

#[test]
fn the_end_of_the_elastic_answer_stands_beside_the_numbers_once() {
    let desk = Desk::new();
    desk.write("thin.toml", THIN);
    let answer = desk.percoat(&["solve", "thin.toml", "-o", "run", "--no-pictures"]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    let words = "the elastic answer has ended in step 1, 2: yield of C45 has the utilisation";
    assert_eq!(answer.err.matches("the elastic answer has ended").count(), 1, "{}", answer.err);
    assert!(answer.err.contains(words), "{}", answer.err);
    // Lines are broken to the width.
    let table = answer.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(table.contains("reaches C45 beneath, of hardness"), "{}", answer.out);
    let folder = Folder(desk.path("run"));
    let summary = folder.summary();
    assert!(summary["warnings"].as_array().unwrap().iter().any(|own| own.as_str().unwrap().starts_with(words)));
    let beneath = &folder.steps()[1]["beneath"];
    assert_eq!((&beneath["material"], &beneath["name"]), (&2.into(), &"C45".into()), "{beneath}");
    let report = desk.percoat(&["report", "run"]);
    assert_eq!(report.code, 0, "{}", report.err);
    assert!(folder.text("report.html").contains(words));
    // A load that the steel bears.
    let light = desk.percoat(&["solve", "thin.toml", "-o", "light", "--no-pictures", "--set", "load.force=1e-4"]);
    assert!(!light.err.contains("has ended") && !light.out.contains("beneath"), "{}{}", light.err, light.out);
}

#[test]
fn a_penetration_that_takes_all_of_the_surface_to_its_hardness_is_refused() {
    let desk = Desk::new();
    let settings = ["--set=layers.0.hardness=0.2", "--set=grid.points=48", "--set=load.penetration=[0.01, 10.0]"];
    for command in ["check", "solve"] {
        let answer = desk.percoat(&[&[command, "fig2"], &settings[..]].concat());
        answer.complains(2, &["load.penetration = 10", "hardness 0.2", "prescribe less"]);
        assert_eq!(answer.out, "");
    }
}

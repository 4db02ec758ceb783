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
    let answer = desk.succeeds(&["solve", "thin.toml", "-o", "run", "--no-pictures"]);
    let words = "the elastic solution no longer holds in step 1, 2: yield of C45 has the utilisation";
    assert_eq!(answer.err.matches("the elastic solution no longer holds").count(), 1, "{}", answer.err);
    assert!(answer.err.contains(words), "{}", answer.err);
    // Lines are broken to the width.
    let table = answer.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(table.contains("reaches C45 beneath, of hardness"), "{}", answer.out);
    let folder = Folder(desk.path("run"));
    let summary = folder.summary();
    assert!(summary["warnings"].as_array().unwrap().iter().any(|warning| warning.as_str().unwrap().starts_with(words)));
    let beneath = &folder.steps()[1]["beneath"];
    assert_eq!((&beneath["material"], &beneath["name"]), (&2.into(), &"C45".into()), "{beneath}");
    desk.succeeds(&["report", "run"]);
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

/// The thin coating takes the hardness of the steel as its penetration grows, in check, table, summary and report; resumed and refused.
#[test]
fn a_composite_hardness_is_stated_with_its_law_and_depth() {
    let desk = Desk::new();
    let thin = THIN.replace("[20.0, 60.0]", "[100.0, 150.0]");
    desk.write("thin.toml", format!("{thin}composite_hardness = {{ law = \"korsunsky\", constant = 3.0 }}\n"));
    let check = desk.percoat(&["check", "thin.toml"]);
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words(&check.out).contains("composite hardness by Korsunsky and others (1998), k = 3"), "{}", check.out);
    let answer = desk.succeeds(&["solve", "thin.toml", "-o", "run", "--no-pictures"]);
    assert!(words(&answer.out).contains("composite hardness of the penetration: where"), "{}", answer.out);
    assert!(!answer.err.contains("not theirs alone"), "{}", answer.err);
    let folder = Folder(desk.path("run"));
    let steps = folder.steps();
    let of = |step: usize, key: &str| steps[step]["plastic"][key].as_f64().unwrap();
    // By two loads the hardness of coating and substrate in the law, and the second one by hand.
    let part = |step: usize| 1.0 / (1.0 + 3.0 * (of(step, "hardness_depth") / 0.25).powi(2));
    for (step, record) in steps.iter().enumerate() {
        assert_eq!(record["penetration"].as_f64().unwrap(), of(step, "hardness_depth"));
        assert!(of(step, "depth") > 0.0, "{record}");
        // The largest pressure is the hardness, and errs with it.
        let [error, of_peak] = [of(step, "hardness_error"), record["errors"]["max_pressure"].as_f64().unwrap()];
        assert!(error > 0.0 && (of_peak / error - 1.0).abs() < 1e-9, "{record}");
        let [coating, substrate] = [24.0, 2.12];
        let known = substrate + part(step) * (coating - substrate);
        assert!((of(step, "hardness") / known - 1.0).abs() < 1e-4, "{record}, {known}");
    }
    assert!(of(1, "hardness") < of(0, "hardness"), "{}", answer.out);
    desk.succeeds(&["report", "run"]);
    assert!(folder.text("report.html").contains("omposite hardness"));
    for (set, says) in [
        ("load.force=[150.0, 100.0]", "the loads fall"),
        ("lattice={kind=\"square\",period=12.0}", "no isolated contact"),
        ("layers=[{material=\"TiN\",thickness=0.1},{material=\"TiN\",thickness=0.15}]", "has 2 layers"),
        ("substrate={young=210,poisson=0.3}", "no hardness of the substrate"),
        ("counterbody={material=\"100Cr6\"}", "may yield first"),
    ] {
        let refused = desk.percoat(&["check", "thin.toml", "--set", set]);
        assert_eq!(refused.code, 2, "{set}: {}", refused.out);
        assert!(words(&refused.err).contains(says), "{set}: {}", refused.err);
    }
}

/// A coating alone bears less than this load spread over the window; with the substrate, which is harder, it bears it.
#[test]
fn a_load_is_judged_by_the_largest_composite_hardness() {
    let desk = Desk::new();
    let soft = THIN
        .replace("[20.0, 60.0]", "150.0")
        .replace("material = \"TiN\"", "young = 70, poisson = 0.3, hardness = 0.5");
    desk.write("alone.toml", &soft);
    let alone = desk.percoat(&["check", "alone.toml"]);
    alone.complains(2, &["hardness 0.5", "no solution"]);
    desk.write("both.toml", format!("{soft}composite_hardness = {{ law = \"korsunsky\", constant = 3.0 }}\n"));
    let check = desk.percoat(&["check", "both.toml"]);
    assert!(check.out.contains("at most 2.12"), "{}{}", check.out, check.err);
    desk.succeeds(&["solve", "both.toml", "-o", "run", "--no-pictures"]);
    let steps = Folder(desk.path("run")).steps();
    let hardness = steps[0]["plastic"]["hardness"].as_f64().unwrap();
    assert!(steps[0]["converged"] == true && 0.5 < hardness && hardness < 2.12, "{hardness}");
}

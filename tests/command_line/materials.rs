//! `percoat materials`, and cases that take materials from it.

use crate::program::{Desk, Folder, assert_says};

const CASE: &str = "title = \"TiN on steel\"\nmaterials = \"own.toml\"\n[lattice]\nkind = \"square\"\nperiod = 20.0\n\
                    [[levels]]\nshape = \"sphere\"\nradius = 50.0\n[[layers]]\nthickness = 2.0\nmaterial = \"TiN\"\n\
                    [substrate]\nmaterial = \"shop steel\"\n[load]\nmean_pressure = 50.0\n[grid]\npoints = 32\n\
                    [units]\nlength = \"µm\"\npressure = \"MPa\"\n";

const OWN: &str = "[[material]]\nname = \"shop steel\"\nkind = \"steel\"\nyoung = 205.0\npoisson = 0.29\n\
                   yield_strength = { value = 0.9, source = \"certificate\" }\n";

#[test]
fn the_list_has_every_material_and_fits_a_terminal() {
    let desk = Desk::new();
    let answer = desk.percoat(&["materials"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    assert_says(
        &answer.out,
        &["\n steel", "  100Cr6 ", "207 (190 to 213)", "  DLC a-C:H ", "~0.25", "yield 0.215", "tensile 0.38"],
    );
    let widest = answer.out.lines().map(|line| line.chars().count()).max();
    assert!(widest <= Some(80) && answer.out.matches("Poisson").count() == 1, "{}", answer.out);
    desk.write("own.toml", OWN);
    let both = desk.percoat(&["materials", "--file", "own.toml"]).out;
    assert!(both.contains("  shop steel ") && both.contains("yield 0.9") && both.contains("  DLC a-C:H "), "{both}");
}

#[test]
fn a_material_is_printed_as_a_file_of_materials() {
    let desk = Desk::new();
    let printed = desk.percoat(&["materials", "DLC a-C:H"]).out;
    assert_says(
        &printed,
        &["[[material]]\n", "about = ", "[material.young]\n", "range = [100.0, 300.0]", "source = ", "certainty = "],
    );
    desk.write("own.toml", printed.replace("value = 200.0", "value = 150.0"));
    let changed = desk.percoat(&["materials", "DLC a-C:H", "--file", "own.toml"]).out;
    assert!(changed.contains("value = 150.0"), "{changed}");
}

#[test]
fn names_and_files_that_are_none_are_refused() {
    let desk = Desk::new();
    desk.percoat(&["materials", "dlc a-c:h"]).complains(2, &["there is no material", "did you mean \"DLC a-C:H\"?"]);
    let kinds = "did you mean \"DLC a-C:H\", \"DLC ta-C\" or \"DLC WC/a-C:H\"?";
    desk.percoat(&["materials", "DLC"]).complains(2, &["there is no material \"DLC\"", kinds]);
    assert!(desk.percoat(&["materials", "SUJ2"]).out.starts_with("[[material]]\nname = \"100Cr6\"\naliases = ["));
    desk.percoat(&["materials", "xyz"]).complains(2, &["no material \"xyz\"", "percoat materials lists them"]);
    desk.percoat(&["materials", "--file", "absent.toml"]).complains(4, &["absent.toml"]);
    desk.write("own.toml", OWN.replace("0.29", "0.92"));
    let words = ["own.toml:5:11", "`material[0].poisson` must be", "between 0 and 0.5", "not 0.92"];
    desk.percoat(&["materials", "--file", "own.toml"]).complains(2, &words);
    desk.write("case.toml", CASE);
    desk.percoat(&["check", "case.toml"]).complains(2, &words);
}

#[test]
fn a_case_takes_its_materials_and_keeps_their_numbers() {
    let desk = Desk::new();
    desk.write("own.toml", OWN);
    desk.write("case.toml", CASE);
    let run = desk.solve("run", &["case.toml", "--no-pictures"]);
    let case = run.text("case.toml");
    assert_says(
        &case,
        &[
            "material = \"TiN\"",
            "young = 430000.0",
            "hardness = 24000.0",
            "name = \"shop steel\"",
            "young = 205000.0",
            "yield_strength = 900.0",
        ],
    );
    // The case of the result is solved to the same fields when the file has gone.
    std::fs::remove_file(desk.path("own.toml")).unwrap();
    let again = desk.solve("again", &["run/case.toml", "--no-pictures"]);
    assert!(run.bytes("contact.npz") == again.bytes("contact.npz"));
    let summary = run.summary();
    assert_eq!(summary["case"]["substrate"]["material"], "shop steel");
    assert_eq!(summary["steps"][0]["strength"][0]["name"], "shop steel");
}

#[test]
fn materials_can_be_swept() {
    let desk = Desk::new();
    let sweep =
        ["sweep", "tin-on-steel", "-o", "out", "--set", "layers.0.material=CrN,DLC ta-C", "--set", "grid.points=32"];
    desk.succeeds(&[&sweep[..], &["--set", "load.mean_pressure=1e8", "--no-pictures"]].concat());
    let table = Folder(desk.path("out")).text("sweep.csv");
    assert!(table.contains("CrN") && table.contains("DLC ta-C"), "{table}");
    let peak = |name: &str| table.lines().find(|line| line.contains(name)).map(str::to_owned);
    assert_ne!(peak("CrN").unwrap().replace("CrN", ""), peak("DLC ta-C").unwrap().replace("DLC ta-C", ""));
}

//! `[units]`: names where people read, the case's own numbers where programs do.

use crate::program::{Desk, Folder, assert_close, assert_says, number};
use serde_json::json;

const SMALL: [&str; 4] = ["--set", "grid.points=24", "--set", "load.mean_pressure=5e7"];

#[test]
fn tables_and_captions_have_prefixes_and_files_the_numbers_of_the_case() {
    let desk = Desk::new();
    let answer = desk.percoat(&[&["solve", "tin-on-steel", "-o", "si", "--pictures", "svg"], &SMALL[..]].concat());
    let (out, folder) = (answer.out.replace('\u{a0}', " "), Folder(desk.path("si")));
    for head in ["mean pressure (MPa)", "penetration (nm)", "load on one (mN)", "peak pressure (GPa)", "p̄ = 50.000 MPa"]
    {
        assert!(out.contains(head), "{head}: {out}");
    }
    let summary = folder.summary();
    assert_eq!(summary["units"], json!({ "length": "m", "pressure": "Pa" }));
    assert_close(number(&summary, "/steps/0/mean_pressure"), 5e7, 1e-12);
    assert_eq!(number(&summary, "/case/substrate/young"), 2.1e11);
    let picture = folder.text("pressure.svg").replace('\u{a0}', " ");
    assert_says(&picture, &["x (µm)", "contact pressure p (GPa)", "h = 3 µm", "E₂ = 210 GPa", "p̄ = 50 MPa"]);
}

#[test]
fn any_name_stands_behind_numbers_as_they_are_and_none_is_null() {
    let desk = Desk::new();
    let names = ["--set=units.length=in", "--set=units.pressure=psi"];
    let solve = |name: &str, more: &[&str]| {
        let arguments = ["solve", "tin-on-steel", "-o", name, "--no-pictures"];
        desk.percoat(&[&arguments[..], &SMALL, more].concat()).out
    };
    let out = solve("other", &names);
    assert!(out.contains("mean pressure (psi)") && out.contains("load on one (psi·in²)"), "{out}");
    assert!(out.contains("5.0000e7") && out.contains("contact radius (in)"), "{out}");
    let arguments = ["solve", "fig2", "-o", "relative", "--no-pictures", "--set", "grid.points=24"];
    let out = desk.percoat(&arguments).out;
    assert!(out.contains("mean pressure ") && !out.contains("mean pressure ("), "{out}");
    assert_eq!(desk.json("relative/summary.json")["units"], json!({ "length": null, "pressure": null }));
    let check = desk.percoat(&["check", "dlc-on-steel"]).out;
    assert!(check.contains("units: lengths in µm, pressures in GPa, forces in mN"), "{check}");
}

#[test]
fn the_tables_of_check_have_units() {
    let desk = Desk::new();
    let check = |arguments: &[&str]| {
        let answer = desk.succeeds(&[&["check"], arguments].concat());
        answer.out.replace('\u{a0}', " ")
    };
    let out = check(&["tin-on-steel"]);
    assert_says(
        &out,
        &[
            "cell a₁ = (34.641, 0.0000) µm",
            "area 1.0392e-9 m²",
            "level 1: sphere, radius 80.000 µm, drop 0.0000 m",
            "level 2: sphere, radius 80.000 µm, drop 100.00 nm",
            "layer 1 (TiN): thickness 3.0000 µm",
            "E 450.00 GPa",
            "spacing 67.658 nm",
            "load: mean_pressure 0.050000 … 1.0000 GPa, 10 steps",
            "  level 2: mean pressure ",
            "Pa\n",
        ],
    );
    let spring = "layers.1.interface={ tangential_stiffness = 3.0 }";
    let out = check(&["dlc-on-steel", "--set", spring]);
    assert!(out.contains("σ_r -2.0000 GPa") && out.contains("tangential stiffness 3.0000 GPa/µm"), "{out}");
    desk.write("surface.csv", "0,0,0\n0,1,0\n0,0,0\n");
    desk.write("rough.toml", "[units]\nlength = \"nm\"\n[surface]\nheights = \"surface.csv\"\npixel = [2, 3]\n[substrate]\nyoung = 1\npoisson = 0.3\n[load]\npenetration = 0.1\n");
    let out = check(&["rough.toml"]);
    assert_says(
        &out,
        &["2.0000 nm apart along a₁ and 3.0000 nm along a₂", "range 1.0000 nm", "load: penetration 0.10000 nm"],
    );
    // Without names numbers stand as they are.
    let out = check(&["fig2"]);
    assert!(
        out.contains("layer 1: thickness 0.50000, χ 2.0000, E ") && out.contains("cell a₁ = (1.7321, 0.0000), a₂"),
        "{out}"
    );
}

#[test]
fn units_that_no_body_has_are_doubted_by_name() {
    let desk = Desk::new();
    for (set, words) in [
        ("units.pressure=mm", "units.pressure = \"mm\" is a unit of length"),
        ("substrate.young=210e9", "Young's modulus 2.1000e11 of the substrate"),
        ("substrate.young=210000", "Young's modulus 210000 of the substrate"),
        ("units.length=m", "levels[0].radius = 50.000"),
        ("units.pressure=kN", "units.pressure = \"kN\" is a unit of force"),
    ] {
        let answer = desk.percoat(&["check", "dlc-on-steel", "--set", set]);
        assert!(answer.code == 0 && answer.err.contains(words), "{set}: {}", answer.err);
    }
}

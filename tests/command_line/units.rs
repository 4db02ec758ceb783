//! `[units]`: names where people read, the case's own numbers where programs do.

use crate::program::{Desk, Folder, assert_close, number};
use serde_json::{Value, json};

const SMALL: [&str; 4] = ["--set", "grid.points=24", "--set", "load.mean_pressure=5e7"];

#[test]
fn tables_and_captions_have_prefixes_and_files_the_numbers_of_the_case() {
    let desk = Desk::new();
    let answer = desk.percoat(&[&["solve", "tin-on-steel", "-o", "si", "--pictures", "svg"], &SMALL[..]].concat());
    let (out, folder) = (answer.out.replace('\u{a0}', " "), Folder(desk.path("si")));
    for head in ["mean pressure (MPa)", "penetration (nm)", "load on one (N)", "peak pressure (GPa)", "p̄ = 50.000 MPa"]
    {
        assert!(out.contains(head), "{head}: {out}");
    }
    let summary: Value = serde_json::from_str(&folder.text("summary.json")).unwrap();
    assert_eq!(summary["units"], json!({ "length": "m", "pressure": "Pa" }));
    assert_close(number(&summary, "/steps/0/mean_pressure"), 5e7, 1e-12);
    assert_eq!(number(&summary, "/case/substrate/young"), 2.1e11);
    let picture = folder.text("pressure.svg").replace('\u{a0}', " ");
    for words in ["x (µm)", "contact pressure p (GPa)", "h = 3 µm", "E₂ = 210 GPa", "p̄ = 50 MPa"] {
        assert!(picture.contains(words), "{words}");
    }
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
    let summary: Value = serde_json::from_str(&Folder(desk.path("relative")).text("summary.json")).unwrap();
    assert_eq!(summary["units"], json!({ "length": null, "pressure": null }));
    let check = desk.percoat(&["check", "dlc-on-steel"]).out;
    assert!(check.contains("units: lengths in µm, pressures in GPa, forces in mN"), "{check}");
}

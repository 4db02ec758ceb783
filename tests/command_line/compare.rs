//! `percoat compare`: what it leaves behind, whom it refuses, and what it says of what cannot be compared.

use crate::program::{Desk, Folder, assert_close, assert_says, number};
use crate::report::{assert_has_cells, report};
use serde_json::Value;
use std::collections::BTreeSet;

/// Small grids, few elements.
const SMALL: [&str; 4] = ["--set", "grid.points=64", "--set", "localized.elements=12"];
/// Indenters inside the circles: of one, or of two that can be compared.
const ONE: [&str; 2] = ["--set", "localized.indenters=[7]"];
const TWO: [&str; 2] = ["--set", "localized.indenters=[7, 13]"];

fn compare(desk: &Desk, name: &str, circles: &[&str], arguments: &[&str]) -> Folder {
    desk.succeeds(&[&["compare", "--output", name], &SMALL[..], circles, arguments].concat());
    Folder(desk.path(name))
}

fn read(folder: &Folder) -> Value {
    folder.json("compare.json")
}

fn list<'a>(value: &'a Value, pointer: &str) -> &'a Vec<Value> {
    value.pointer(pointer).and_then(Value::as_array).unwrap_or_else(|| panic!("no list at {pointer} in {value}"))
}

#[test]
fn both_solutions_stand_side_by_side_in_a_file_and_a_picture() {
    let desk = Desk::new();
    let printed = desk.succeeds(&[&["compare", "--output", "both"], &SMALL[..], &TWO].concat()).out;
    let folder = Folder(desk.path("both"));
    assert_eq!(folder.names(), ["compare.json", "comparison.png", "comparison.svg"].map(str::to_owned).into());
    let file = read(&folder);
    assert_eq!(file["percoat"], env!("CARGO_PKG_VERSION"));
    assert_eq!((&file["rule"], &file["other_rule"]["rule"]), (&"load-balanced".into(), &"area-balanced".into()));
    let spectral = &file["spectral"];
    assert_close(number(spectral, "/mean_pressure"), 0.06, 1e-12);
    assert_eq!(spectral["converged"], true);
    for (circles, tolerance) in [("/localized", 0.04), ("/other_rule/localized", 0.5)] {
        for (circle, inside) in list(&file, circles).iter().zip([7, 13]) {
            assert_eq!((&circle["indenters"], &circle["converged"]), (&inside.into(), &true.into()));
            assert_eq!(list(circle, "/radius").len(), 3);
            let whole: f64 = (0..3).map(|m| number(circle, &format!("/levels/{m}/load_share"))).sum();
            assert_close(whole, 1.0, 1e-6);
            for (level, m) in list(circle, "/levels").iter().zip(0..) {
                assert_eq!(level["level"], m + 1);
                for key in ["load", "max_pressure", "contact_radius"] {
                    let expected = number(spectral, &format!("/levels/{m}/{key}"));
                    assert_close(number(level, &format!("/{key}")), expected, tolerance);
                }
            }
            for key in ["penetration", "load", "load_share", "max_pressure", "contact_radius"] {
                assert!(number(circle, &format!("/difference/{key}")) < tolerance);
                // Six elements across the largest contact.
                assert!(number(circle, &format!("/mesh_error/{key}")) < 0.2);
            }
            // Eq. (8) is the penetration.
            assert_close(number(circle, "/additional_displacement"), number(circle, "/penetration"), 1e-5);
        }
    }
    let page = report(&desk, "both");
    let (tables, _) = printed.split_once("stresses at").expect("stresses behind the tables");
    let (_, tables) = tables.split_once("\n\n").expect("tables behind the title");
    assert_has_cells(&page, tables, 100);
    assert_says(&page, &["<figure id=\"comparison\"", "Stresses at", "Energy gap"]);
    // The lattice sum outside leaves six elements across the contact, whatever the circle.
    let lattice_sum = &file["lattice_sum"];
    assert_eq!((&lattice_sum["indenters"], &lattice_sum["converged"]), (&7.into(), &true.into()));
    assert!(number(lattice_sum, "/difference/load") < 0.01 && number(lattice_sum, "/difference/penetration") < 0.01);
    let largest = list(&file, "/stresses").iter().map(|pair| number(pair, "/spectral/zz").abs()).fold(0.0, f64::max);
    for pair in list(&file, "/stresses") {
        for component in ["xx", "yy", "zz", "xy", "xz", "yz"] {
            let [a, b] = ["spectral", "localized"].map(|method| number(pair, &format!("/{method}/{component}")));
            assert!((a - b).abs() < 0.02 * largest, "{component}: {pair}");
        }
    }
    // Earlier pictures go when none are wanted.
    let again = compare(&desk, "both", &TWO, &["--no-pictures"]);
    assert_eq!(again.names(), BTreeSet::from(["compare.json".to_owned()]));
}

#[test]
fn without_mutual_effect_every_indenter_is_alone() {
    let desk = Desk::new();
    let file = read(&compare(&desk, "alone", &ONE, &["--no-pictures", "--set", "localized.mutual_effect=false"]));
    let [circle] = &list(&file, "/localized")[..] else { panic!("one solution") };
    assert_eq!((&circle["indenters"], &file["other_rule"]), (&1.into(), &Value::Null));
    assert!(list(circle, "/radius").iter().all(Value::is_null));
    // Isolated exact laws under one plate with the whole load.
    assert_close(number(circle, "/penetration"), 0.10462, 3e-3);
}

#[test]
fn with_the_lattice_sum_outside_circles_of_any_size_agree() {
    let desk = Desk::new();
    let file = read(&compare(&desk, "sum", &TWO, &["--no-pictures", "--set", "localized.radius=lattice-sum"]));
    assert_eq!((&file["rule"], &file["other_rule"]["rule"]), (&"lattice-sum".into(), &"load-balanced".into()));
    assert_eq!(file["lattice_sum"], Value::Null);
    let [seven, thirteen] = &list(&file, "/localized")[..] else { panic!("two circles") };
    assert_eq!((&seven["indenters"], &thirteen["indenters"]), (&7.into(), &13.into()));
    for key in
        ["/penetration", "/additional_displacement", "/levels/0/load", "/levels/2/load", "/levels/1/max_pressure"]
    {
        assert_close(number(seven, key), number(thirteen, key), 1e-6);
    }
    // Eq. (8), summed anew.
    assert_close(number(seven, "/additional_displacement"), number(seven, "/penetration"), 1e-6);
}

#[test]
fn a_topography_is_refused() {
    let desk = Desk::new();
    desk.write(
        "waves.toml",
        "[lattice]\nkind = \"square\"\nperiod = 1.0\n[surface]\nheights = \"waves.npy\"\n[substrate]\nyoung = 1.0\n\
         poisson = 0.3\n[load]\nmean_pressure = 0.003\n",
    );
    let mut file = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    file.extend(format!("{:<117}\n", "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }").bytes());
    file.extend([0.0f64, 0.01, 0.0, 0.01].iter().flat_map(|height| height.to_le_bytes()));
    desk.write("waves.npy", file);
    desk.percoat(&["compare", "waves.toml"]).complains(2, &["[[levels]]", "[surface]", "percoat solve"]);
    assert_eq!(desk.names(), BTreeSet::from(["waves.npy".to_owned(), "waves.toml".to_owned()]), "something is written");
}

#[test]
fn merged_contacts_are_told_and_what_is_there_is_written() {
    let desk = Desk::new();
    let arguments = ["compare", "-o", "merged", "--no-pictures", "--set", "load.mean_pressure=1.5"];
    desk.percoat(&[&arguments[..], &SMALL, &ONE].concat()).complains(3, &["7 indenters", "merged"]);
    let file = read(&Folder(desk.path("merged")));
    let circle = &file["localized"][0];
    assert_eq!(circle["converged"], false);
    assert_eq!(circle["stop_reason"], "merged", "{circle}");
    assert!(list(&file, "/stresses").is_empty());
}

#[test]
fn an_isolated_contact_is_refused() {
    let desk = Desk::new();
    desk.percoat(&["compare", "ball-on-disc"]).complains(2, &["isolated", "solve it", "lattice"]);
    assert!(desk.names().is_empty(), "something is written");
}

#[test]
fn penetrations_near_complete_contact_come_to_an_end_and_those_beyond_are_refused() {
    let desk = Desk::new();
    let compare = |penetration: f64| {
        let load = format!("load={{ penetration = [{penetration}] }}");
        let arguments = ["compare", "-o", "deep", "--no-pictures", "--set", &load];
        desk.percoat(&[&arguments[..], &SMALL, &TWO].concat())
    };
    compare(0.1).complains(2, &["load.penetration", "0.1", "complete"]);
    assert!(desk.names().is_empty(), "{:?} is written", desk.names());
    compare(0.0966).complains(3, &["7 indenters"]);
}

#[test]
fn loads_too_small_for_the_grid_are_solved_by_the_localized_method() {
    let desk = Desk::new();
    let file = read(&compare(&desk, "tiny", &ONE, &["--no-pictures", "--set", "load.mean_pressure=1e-9"]));
    let circle = &file["localized"][0];
    // Hertz on the coating: a³ = 3PR/(4E₁*), E₁* = 2G₁/(1 − ν₁).
    let radius = (0.6 * 1e-9 * 1.5 * 3f64.sqrt() / (4.0 / 2.6 / 0.8)).cbrt();
    assert_close(number(circle, "/levels/0/contact_radius"), radius, 5e-3);
    assert!(number(circle, "/mesh_error/max_pressure") < 0.02);
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let desk = Desk::new();
    let [one, two] = ["1", "2"].map(|threads| compare(&desk, threads, &ONE, &["--no-pictures", "--threads", threads]));
    assert!(one.bytes("compare.json") == two.bytes("compare.json"));
}

#[test]
fn what_the_localized_method_does_not_know_is_refused() {
    let desk = Desk::new();
    for (case, word) in
        [("pin-on-disc-hot", "steady motion"), ("rubber-creep", "loads in time"), ("rubber-sliding", "[[levels]]")]
    {
        let answer = desk.percoat(&["compare", case]);
        assert!(answer.code == 2 && answer.err.contains(word), "{case}: {}", answer.err);
    }
}

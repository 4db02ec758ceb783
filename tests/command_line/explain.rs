//! `percoat explain`: what the keys of a case are, for people and for editors.

use crate::program::{Desk, assert_says};
use serde_json::Value;

#[test]
fn without_a_key_every_section_of_a_case_is_listed_with_how_to_go_on() {
    let desk = Desk::new();
    let answer = desk.percoat(&["explain"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    for section in ["[lattice]", "[[levels]]", "[[layers]]", "[load]", "[localized]"] {
        assert!(answer.out.contains(&format!("\n  {section} ")), "{}", answer.out);
    }
    assert!(answer.out.contains("percoat explain --schema"));
}

#[test]
fn a_key_is_told_with_type_range_unit_default_and_an_example_that_runs() {
    let desk = Desk::new();
    let told = |key: &str| desk.percoat(&["explain", key]).out;
    let poisson = told("layers.poisson");
    assert_says(
        &poisson,
        &["type      number", "range     0 to 0.5", "unit      none", "it, graded or material must be given"],
    );
    let set = poisson.split("--set ").nth(1).unwrap().trim();
    desk.succeeds(&["check", "fig2", "--set", "grid.points=48", "--set", set]);
    let from = told("load.mean_pressure.from");
    assert!(from.contains("unit      pressure") && from.contains("[load]\n"), "{from}");
    let points = told("points");
    assert_says(&points, &["grid.points:", "stress.points:", "stress.volume.points:"]);
    let layers = told("layers");
    assert!(layers.contains("\n  thickness ") && layers.contains("length > 0; required"), "{layers}");
    assert!(told("levels.slope").contains("only for  cone") && told("layers.young").contains("excludes  shear_ratio"));
    assert!(desk.names().is_empty());
}

#[test]
fn a_misspelt_key_is_refused_with_what_may_be_meant() {
    let desk = Desk::new();
    desk.percoat(&["explain", "layers.thicknes"])
        .complains(2, &["error: there is no key", "did you mean `layers.thickness`?"]);
    desk.percoat(&["explain", "poison"])
        .complains(2, &["`layers.poisson`, ", " or `counterbody.layers.graded.poisson`?"]);
    desk.percoat(&["explain", "xyzzy"]).complains(2, &["no key `xyzzy`", "lists the sections"]);
    desk.percoat(&["explain", "grid", "--schema"]).complains(2, &["--schema"]);
}

#[test]
fn the_schema_is_json_with_every_section_and_its_bounds() {
    let answer = Desk::new().percoat(&["explain", "--schema"]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    let schema: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    let poisson = &schema["properties"]["layers"]["items"]["properties"]["poisson"];
    assert_eq!((&poisson["minimum"], &poisson["maximum"]), (&0.0.into(), &0.5.into()));
    assert_eq!(schema["properties"]["grid"]["properties"]["points"]["default"], 512);
}

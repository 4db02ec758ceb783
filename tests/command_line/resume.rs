//! `solve --resume`: a run that was stopped at any moment and goes on ends as one that was not.

use crate::mortal::{case, run};
use crate::program::{Desk, Folder, kill};
use std::collections::BTreeMap;
use std::fs;

/// Loads up and down on a coating with strengths; stresses of every kind; on one grid.
const STRESSES: &str = r#"
lattice = { kind = "oblique", a1 = [1.0, 0.0], a2 = [0.3, 0.9] }
levels = [{ shape = "sphere", radius = 0.8, sites = [[0.0, 0.0]] }]
substrate = { young = 1.0, poisson = 0.3 }
load = { mean_pressure = [0.01, 0.03, 0.0, 0.02] }
friction = { coefficient = 0.3 }
grid = { points = [24, 20] }
[[layers]]
thickness = 0.1
young = 3.0
poisson = 0.25
yield_strength = 0.3
interface_strength = { normal = 0.1, shear = 0.2 }
[stress]
planes = [0.0, 0.1]
points = [[0.1, 0.2, 0.05]]
section = { from = [0.0, 0.0], toward = [1.0, 0.0], length = 0.5, depth = 0.3 }
volume = { depth = 0.2, rows = 2, points = 4 }
"#;

/// Cones between spheres, refined; the second grid is the last that is allowed here. The finite peaks have a part in the
/// change.
const REFINED: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "cone", slope = 0.2, sites = [[0.0, 0.0]] }, { shape = "sphere", radius = 0.5, sites = [[0.5, 0.5]] }]
substrate = { young = 1.0, poisson = 0.3 }
load = { mean_pressure = [0.001, 0.01] }
grid = { accuracy = 1e-9 }
"#;

/// A rough surface, one of whose penetrations touches too little to be resolved, and one iteration too few for some.
const ROUGH: &str = r#"
lattice = { kind = "square", period = 1.0 }
surface.random = { hurst = 0.8, shortest = 0.1, rms_slope = 0.1 }
substrate = { young = 1.0, poisson = 0.3 }
load = { penetration = [1e-6, 0.002, 0.01, 0.012] }
grid = { points = 32 }
solver = { max_iterations = 9 }
"#;

/// Bodies that creep under loads up and down in time.
const IN_TIME: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "sphere", radius = 0.8 }]
substrate = { young = 1.0, poisson = 0.3, relaxation = { shear = [2.0, 1.0], times = [0.1, 3.0] } }
time = { load = [[0.0, 0.0], [1.0, 0.02], [2.0, 0.02], [3.0, 0.01]] }
grid = { points = 24 }
"#;

/// Kills a run after every call, its successor some calls later, and compares what the third leaves.
fn survives_every_call(text: &str, fields: bool) {
    let (desk, case) = (Desk::new(), case(text));
    let results = |name: &str| -> BTreeMap<String, Vec<u8>> { Folder(desk.path(name)).results() };
    let (_, whole) = run(&case, &desk.path("whole"), fields, usize::MAX).unwrap();
    let expected = results("whole");
    let mut resumed = 0;
    for calls in 0.. {
        let name = format!("killed-{calls}");
        let folder = desk.path(&name);
        if run(&case, &folder, fields, calls).is_some() {
            assert!(resumed >= 2 * case.run().loads.len(), "only {resumed} of {calls} runs went on");
            return;
        }
        let second = run(&case, &folder, fields, 2 + calls % 3);
        let (went_on, outcome) = second.unwrap_or_else(|| run(&case, &folder, fields, usize::MAX).unwrap());
        resumed += usize::from(went_on);
        assert_eq!((outcome.change, outcome.end), (whole.change, whole.end));
        assert_eq!(outcome.warnings, whole.warnings);
        let found = results(&name);
        assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
        for (file, content) in &found {
            assert!(*content == expected[file], "{file} of a run killed after {calls} calls differs");
        }
        fs::remove_dir_all(folder).unwrap();
    }
}

#[test]
fn a_run_in_time_killed_after_any_call_ends_bit_for_bit_as_if_it_had_not_been() {
    survives_every_call(IN_TIME, true);
}

#[test]
fn a_run_with_stresses_killed_after_any_call_ends_bit_for_bit_as_if_it_had_not_been() {
    survives_every_call(STRESSES, true);
}

#[test]
fn so_does_a_refinement() {
    survives_every_call(REFINED, true);
}

#[test]
fn and_one_on_a_rough_surface_whose_steps_do_not_all_converge() {
    survives_every_call(ROUGH, true);
}

const LONG: [&str; 3] = ["fig5", "--set", "grid.points=96"];

#[test]
fn a_killed_run_goes_on_and_leaves_the_same_files_and_pictures() {
    let desk = Desk::new();
    let whole = desk.solve("whole", &LONG);
    let folder = Folder(desk.path("killed"));
    kill(desk.begin(&[&["solve", "-o", "killed"], &LONG[..]].concat(), "killed/unfinished/steps.jsonl", 5));
    let resume = |change: &[&str]| desk.percoat(&[&["solve", "-o", "killed", "--resume"], &LONG[..], change].concat());
    // Another run is refused, and nothing is lost.
    for change in [&["--no-fields"][..], &["--set", "substrate.poisson=0.2"]] {
        resume(change).complains(2, &["is of another run", "--resume"]);
    }
    let again = resume(&[]).succeeds();
    assert!(again.err.contains("note: goes on after step"), "{}", again.err);
    let (found, expected) = (folder.results(), whole.results());
    assert_eq!(folder.names(), whole.names());
    assert!(found.iter().all(|(name, content)| *content == expected[name]), "{:?}", folder.names());
    // A finished result stays, and is told so.
    let before = folder.files();
    let after = resume(&["--json"]);
    assert!(after.code == 0 && after.err.contains("is finished"), "{}", after.err);
    assert_eq!(after.out, folder.text("summary.json"));
    assert!(folder.files() == before && !folder.names().contains("unfinished"));
    let other = resume(&["--set", "substrate.poisson=0.2", "--set", "load.mean_pressure=0.01"]);
    assert!(other.code == 0 && !other.err.contains("is finished"), "{}", other.err);
}

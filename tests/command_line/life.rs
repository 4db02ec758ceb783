//! `percoat life`: what it prints, writes, refuses, and goes on with.

use crate::damages::{BLOWS, strike};
use crate::program::{Answer, Desk, Folder, assert_says, kill, number};
use percoat::case::{Case, embedded};
use percoat::life::LifeState;
use percoat::output::{self, Plan, RunFolder, Writer};
use std::fs;
use std::path::Path;

const COARSE: [&str; 2] = ["--set", "grid.points=64"];

#[test]
fn without_a_case_a_coating_that_tires_is_followed_to_its_end() {
    let desk = Desk::new();
    let answer = desk.succeeds(&[&["life", "-o", "out"], &COARSE[..]].concat());
    let life = desk.json("out/life.json");
    let first = &life["first"];
    assert!(first["interface"] == 1 && first["name"] == "TiN/tool steel" && number(first, "/z") == 2.0, "{first}");
    assert!(
        first["kind"] == "delamination" && number(first, "/distance") == 40.0 * number(first, "/passes"),
        "{first}"
    );
    for record in [&life["criteria"][2], &life["events"][1], &life["wear"][1]] {
        assert!((number(record, "/distance") / number(record, "/passes") - 40.0).abs() < 1e-12, "{record}");
    }
    assert_eq!(life["criteria"].as_array().unwrap().len(), 3);
    let events = life["events"].as_array().unwrap();
    assert!(events[0]["what"] == "delamination" && number(&events[0], "/thickness") == 0.0 && events.len() > 2);
    assert_eq!(number(&events[0], "/passes"), number(first, "/passes"));
    assert!(number(&life, "/distance") == 40.0 && life["end"] == "passes");
    let course = life["wear"].as_array().unwrap();
    assert!(number(course.last().unwrap(), "/passes") == 2e7 && number(&course[0], "/thickness") == 2.0);
    for name in ["damage.png", "damage.npz", "life.png", "life.csv", "case.toml"] {
        assert!(desk.path("out").join(name).is_file(), "{name}");
    }
    assert!(!desk.path("out/unfinished-life").exists());
    assert_says(
        &answer.out,
        &["first damage at", "after sliding", "delamination", "distance (", "passes until damage 1", "loads solved"],
    );
    assert!(answer.out.lines().all(|line| line.chars().count() <= 80), "wider than a terminal:\n{}", answer.out);
    desk.succeeds(&["report", "out"]);
    let page = fs::read_to_string(desk.path("out/report.html")).unwrap();
    assert_says(&page, &["Passes until damage 1", "<td class=\"number\">delamination</td>"]);
}

/// Passes of `life` are those of `solve`, and to the first failure one solution is enough.
#[test]
fn the_passes_are_those_of_a_solved_case() {
    let desk = Desk::new();
    desk.percoat(&[&["life", "tin-fatigue", "-o", "out", "--no-pictures", "--set", "life={}"], &COARSE[..]].concat());
    let life = desk.json("out/life.json");
    assert!(life["solved"] == 1 && life["end"].is_null() && life["events"].as_array().unwrap().len() == 1);
    desk.succeeds(&[&["solve", "tin-fatigue", "-o", "run", "--no-pictures"], &COARSE[..]].concat());
    assert_eq!(number(&desk.json("run/summary.json"), "/steps/0/fatigue/first/passes"), number(&life, "/first/passes"));
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let desk = Desk::new();
    desk.percoat(&["life", "fig2"])
        .complains(2, &["neither a fatigue law nor wear is given", "interface_fatigue", "life.passes"]);
    desk.percoat(&["life", "tin-fatigue", "--set", "load.mean_pressure=[0.01, 0.02]"])
        .complains(2, &["one load in all passes", "--set load.mean_pressure="]);
    assert!(desk.names().is_empty());
}

/// A state that is left by a life that was killed is gone on with, and the result is the same.
#[test]
fn a_life_that_was_interrupted_is_resumed_to_the_same_end() {
    let desk = Desk::new();
    let arguments = |folder: &'static str| {
        let set = ["--set", "grid.points=32", "--set", "life.passes=1e5"];
        [&["life", "running-in", "-o", folder, "--no-pictures"][..], &set].concat()
    };
    desk.succeeds(&arguments("out"));
    let expected = desk.json("out/life.json");
    kill(desk.begin(&arguments("killed"), "killed/unfinished-life/life-state.json", 1));
    let resumed = desk.succeeds(&[&arguments("killed")[..], &["--resume"]].concat());
    assert!(resumed.err.contains("goes on after"), "{}", resumed.err);
    let resumed = desk.json("killed/life.json");
    for key in ["first", "events", "wear", "end", "solved"] {
        assert_eq!(resumed[key], expected[key], "{key}");
    }
}

/// A coating and a substrate that come off piece by piece.
const PIECES: [&str; 3] = ["grid.points=48", "life.passes=2e7", "layers.0.fatigue.amplitude=0.8"];
/// A coating that wears while it tires.
const WORN: [&str; 3] = ["grid.points=48", "life.passes=2e5", "layers.0.wear=1e-8"];

/// `percoat life` into a folder, without pictures, with settings and other options.
fn life(desk: &Desk, folder: &str, settings: &[&str], more: &[&str]) -> Answer {
    let set = settings.iter().flat_map(|setting| ["--set", *setting]);
    let arguments = ["life", "tin-fatigue", "-o", folder, "--no-pictures"].into_iter().chain(set);
    desk.percoat(&arguments.chain(more.iter().copied()).collect::<Vec<_>>())
}

fn case(settings: &[&str]) -> Case {
    let settings: Vec<String> = settings.iter().map(|setting| (*setting).to_owned()).collect();
    Case::read(&embedded::source("tin-fatigue").unwrap(), &settings).unwrap()
}

/// All states of a life, the last one with its end.
fn states(case: &Case) -> Vec<LifeState> {
    let task = case.life_task().unwrap();
    let begun = task.beginning(&|_| true, &|| true).unwrap();
    let next = |state: &LifeState| {
        let goes_on = state.end.is_none();
        goes_on.then(|| task.advance(state.clone(), &begun, &|| true).unwrap())
    };
    std::iter::successors(Some(task.unworn(&begun)), next).skip(1).collect()
}

/// The saved state of a life.
const STATE: &str = "unfinished-life/life-state.json";

/// Leaves in a folder what a life leaves that is killed after a state was saved.
fn killed_after(state: &LifeState, case: &Case, folder: &Path) {
    let claim = RunFolder::claim(folder, Plan::new(Writer::Life)).unwrap();
    output::save_state(&claim.staging(), &output::fingerprint(case, "life"), state).unwrap();
}

/// Also from the last state, after which a life that is killed had only files to write.
#[test]
fn damage_goes_on_from_every_state_to_the_same_files() {
    for settings in [&PIECES, &WORN] {
        let desk = Desk::new();
        let (answer, whole) = (life(&desk, "whole", settings, &[]), Folder(desk.path("whole")));
        assert_eq!(answer.code, 0, "{}", answer.err);
        let (case, killed) = (case(settings), Folder(desk.path("killed")));
        let states = states(&case);
        assert!(states.len() > 2 && states.last().unwrap().end.is_some(), "{} states", states.len());
        for state in &states {
            killed_after(state, &case, &killed.0);
            let saved = killed.text(STATE);
            assert!(saved.contains("\"bottom\":null"), "the substrate has no lower face");
            let again = life(&desk, "killed", settings, &["--resume"]);
            let note = format!("note: goes on after {} passes", output::number(state.passes));
            assert!(again.code == 0 && again.err.contains(&note), "{note}: {}", again.err);
            assert_eq!(killed.names(), whole.names());
            assert!(killed.results() == whole.results(), "{settings:?} after {} passes", state.passes);
            fs::remove_dir_all(&killed.0).unwrap();
        }
    }
}

#[test]
fn a_life_of_another_case_is_refused_and_a_damaged_one_is_kept_aside() {
    let desk = Desk::new();
    let (case, killed) = (case(&PIECES), Folder(desk.path("killed")));
    let state = &states(&case)[0];
    killed_after(state, &case, &killed.0);
    let before = killed.bytes(STATE);
    for change in ["friction.coefficient=0.2", "life.passes=1e7"] {
        let key = change.split('=').next();
        let others = PIECES.into_iter().filter(|piece| piece.split('=').next() != key);
        let refused = life(&desk, "killed", &others.chain([change]).collect::<Vec<_>>(), &["--resume"]);
        refused.complains(2, &["killed/unfinished-life is of another run", "same command", "leave --resume out"]);
        assert_eq!(killed.names(), ["unfinished-life".to_owned()].into());
        assert!(killed.bytes(STATE) == before, "{change}");
    }
    // Case unchanged, but solved on another grid.
    fs::remove_dir_all(&killed.0).unwrap();
    killed_after(&LifeState { points: [40; 2], ..state.clone() }, &case, &killed.0);
    life(&desk, "killed", &PIECES, &["--resume"]).complains(2, &["is of another run", "the grid"]);

    life(&desk, "whole", &PIECES, &[]).succeeds();
    let whole = Folder(desk.path("whole")).results();
    for (what, blow) in BLOWS.iter().filter(|(what, _)| *what != "missing") {
        fs::remove_dir_all(&killed.0).unwrap();
        killed_after(state, &case, &killed.0);
        strike(&killed.0.join(STATE), *blow);
        let damaged = killed.bytes(STATE);
        let again = life(&desk, "killed", &PIECES, &["--resume", "--quiet"]).succeeds();
        assert_says(
            &again.err,
            &["warning: killed/unfinished-life/life-state.json: it", "interrupted-1; all passes are followed again"],
        );
        assert!(killed.results() == whole && killed.bytes("interrupted-1/life-state.json") == damaged, "{what}");
    }
}

/// A ball whose counterbody tires, and of the body nothing.
const COUNTERBODY: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "sphere", radius = 0.8 }]
substrate = { young = 1.0, poisson = 0.3 }
counterbody = { name = "pin", young = 1.0, poisson = 0.3, fatigue = { amplitude = 0.1, passes = 1e3, exponent = 6 } }
load = { mean_pressure = 0.02 }
grid = { points = 32 }
"#;

#[test]
fn a_counterbody_that_fails_is_warned_of_since_only_the_body_is_followed() {
    let desk = Desk::new();
    desk.write("case.toml", COUNTERBODY);
    let life = |passes: &str| {
        let answer = desk.succeeds(&["life", "case.toml", "-o", "out", "--set", passes]);
        (answer, desk.json("out/life.json"))
    };
    let warning = "warning: the counterbody fails: pin of the counterbody after ";
    let (answer, first) = life("life={}");
    assert!(answer.err.contains(warning), "{}", answer.err);
    assert!(answer.out.contains("no part of the body ever fails by fatigue"), "{}", answer.out);
    assert!(first["end"] == "endless" && first["first"]["body"] == "counterbody", "{}", first["first"]);
    assert!(first["events"].as_array().unwrap().is_empty());
    let passes = number(&first, "/first/passes");
    let (longer, followed) = life(&format!("life.passes={}", 1.01 * passes));
    assert!(longer.err.contains(warning) && followed["end"] == "passes", "{}", longer.err);
}

/// A ball on a coated disc that wear both.
const BALL: &str = r#"
lattice = { kind = "isolated", size = 100.0 }
levels = [{ shape = "sphere", radius = 3000.0 }]
layers = [{ name = "soft layer", thickness = 0.02, young = 100.0, poisson = 0.3, wear = 1e-5 }]
substrate = { name = "base", young = 210.0, poisson = 0.3 }
counterbody = { name = "ball", young = 210.0, poisson = 0.3, wear = 1e-7 }
load = { force = 100 }
friction = { coefficient = 0.2 }
units = { length = "µm", pressure = "GPa" }
grid = { points = 40 }
life = { passes = 2000, tolerance = 0.1 }
"#;

#[test]
fn a_ball_that_wears_needs_the_length_of_its_track_and_has_a_scar() {
    let desk = Desk::new();
    desk.write("case.toml", BALL);
    let track = ["life.distance", "circumference", "life.stroke"];
    desk.percoat(&["life", "case.toml"]).complains(2, &track);
    desk.percoat(&["life", "case.toml", "--set", "life.distance=1e4", "--set", "life.stroke=1e4"])
        .complains(2, &["`life.stroke` and `life.distance`", "there and back"]);
    let answer = desk.succeeds(&["life", "case.toml", "-o", "out", "--set", "life.distance=1e4"]);
    let life = desk.json("out/life.json");
    let last = life["wear"].as_array().unwrap().last().unwrap();
    assert!(last["body"].is_null() && last["counterbody"].is_null() && number(last, "/distance") == 2e7, "{last}");
    assert!((number(last, "/specific_rate") / 1e-7 - 1.0).abs() < 1e-2, "{last}");
    // k s P in µm³.
    assert!((number(last, "/scar/volume") / (1e-7 * 2e7 * 100.0) - 1.0).abs() < 1e-2, "{last}");
    assert!(number(last, "/scar/diameter") > 0.0 && number(last, "/scar/depth") > 0.0);
    let text = answer.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_says(
        &text,
        &[
            "the scar of the counterbody has a diameter of",
            "a specific wear rate of",
            "mm³/(N·m)",
            "µm³",
            "its groove is",
        ],
    );
    // Without a law of fatigue the layer that is worn through is what happens first.
    let first = &life["first"];
    assert!(first["kind"] == "worn_through" && first["name"] == "soft layer" && first["range"].is_null(), "{first}");
    assert!(text.contains("first event: soft layer") && text.contains("is worn through after"), "{}", answer.out);
    assert_eq!(number(&life["events"][0], "/depth"), 0.02);
    assert!(answer.err.contains("base is uncovered and has no `wear`"), "{}", answer.err);
    let csv = fs::read_to_string(desk.path("out/life.csv")).unwrap();
    for column in ["scar_diameter", "scar_depth", "scar_volume", "specific_rate", "groove", "distance"] {
        assert!(csv.lines().next().unwrap().split(',').any(|head| head == column), "{column}");
    }
    desk.succeeds(&["report", "out"]);
    let page = fs::read_to_string(desk.path("out/report.html")).unwrap();
    assert!(page.contains("is worn through after") && page.contains("specific wear rate"));
}

const SHAKEN: &str = r#"
title = "ball that is shaken"
lattice = { kind = "isolated", size = 220.0 }
levels = [{ shape = "sphere", radius = 5000.0 }]
layers = [{ young = 400.0, poisson = 0.25, thickness = 3.0, tensile_strength = 2.0, wear = 1e-4 }]
substrate = { young = 210.0, poisson = 0.3 }
counterbody = { young = 210.0, poisson = 0.3, wear = 1e-4 }
load = { force = [20000.0] }
friction = { coefficient = 0.5, coupling = false }
tangential = { path = { amplitude = 0.6, cycles = 1, steps = 4 } }
units = { length = "µm", pressure = "GPa" }
grid = { points = 48 }
life = { passes = 2000, tolerance = 0.1 }
"#;

#[test]
fn a_ball_that_is_shaken_has_limits_and_wears_in_place() {
    let desk = Desk::new();
    desk.write("case.toml", SHAKEN);
    let text = |out: &str| out.split_whitespace().collect::<Vec<_>>().join(" ");
    let answer = desk.succeeds(&["limit", "case.toml", "-o", "limit"]);
    let limit = desk.json("limit/limit.json");
    assert!(limit["first"]["criterion"] == "cracking" && number(&limit, "/first/force") > 0.0, "{limit}");
    assert!(text(&answer.out).contains("cracking"), "{}", answer.out);
    desk.succeeds(&["report", "limit"]);
    let answer = desk.succeeds(&["life", "case.toml", "-o", "life"]);
    let life = desk.json("life/life.json");
    let last = life["wear"].as_array().unwrap().last().unwrap();
    assert!(number(last, "/passes") == 2000.0 && last["distance"].is_null() && last["groove"].is_null(), "{last}");
    let [body, ball] = ["/body_scar/volume", "/scar/volume"].map(|key| number(last, key));
    assert!(body > 0.0 && (body / ball - 1.0).abs() < 1e-9, "{last}");
    assert!(text(&answer.out).contains("the scar of the body has a diameter of"), "{}", answer.out);
    assert!(desk.path("life/life.svg").exists() || desk.path("life/life.png").exists());
    desk.succeeds(&["report", "life"]);
    desk.percoat(&["life", "case.toml", "--set", "life.stroke=5"]).complains(2, &["a cycle of [tangential]"]);
    let open = ["life", "case.toml", "--set", "tangential={ force = [0.3, -0.3] }"];
    desk.percoat(&open).complains(2, &["does not come back", "tangential.path"]);
    let rising =
        ["limit", "case.toml", "--set", "tangential={ force = [0.3, -0.3] }", "--set", "load.force=[1e4, 2e4]"];
    desk.percoat(&rising).complains(2, &["give `load` one value"]);
    desk.percoat(&["compare", "case.toml"]).complains(2, &["partial slip"]);
}

//! `percoat sweep` and `percoat merge`: every combination a row, whatever happens on the way.

use crate::program::{Answer, Desk, Folder, kill, number, send, whole_lines};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

const CASE: &str = r#"
title = "A small one"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "paraboloid", radius = 1.0 }]
layers = [{ thickness = 0.2, shear_ratio = 2.0, poisson = 0.3 }]
substrate = { young = 1.0, poisson = 0.3 }
load = { mean_pressure = [0.01, 0.02] }
grid = { points = 32 }
"#;

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("case.toml", CASE);
    desk
}

/// A sweep of `case.toml` into a folder, without pictures.
pub fn sweep(desk: &Desk, name: &str, arguments: &[&str]) -> Answer {
    desk.percoat(&[&["sweep", "case.toml", "-o", name, "--no-pictures"], arguments].concat())
}

/// Cells of a CSV file without quotes.
fn cells(text: &str) -> Vec<Vec<&str>> {
    text.lines().map(|line| line.split(',').collect()).collect()
}

fn column<'a>(table: &[Vec<&'a str>], name: &str) -> Vec<&'a str> {
    let at = table[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("no column {name}"));
    table[1..].iter().map(|row| row[at]).collect()
}

#[test]
fn every_combination_and_step_is_a_row_with_what_solve_finds() {
    let desk = desk();
    let answer =
        sweep(&desk, "out", &["--set", "layers.0.thickness=0.1,0.3", "--set", "layers[0].poisson=0.2,0.4,0.5"])
            .succeeds();
    assert!(answer.out.contains("6 of 6 combinations done"), "{}", answer.out);
    let folder = Folder(desk.path("out"));
    assert_eq!(folder.names(), BTreeSet::from(["sweep.csv", "sweep.json", "sweep.jsonl"].map(str::to_owned)));
    let text = folder.text("sweep.csv");
    let table = cells(&text);
    assert_eq!(table[0][..5], ["combination", "set_layers_0_thickness", "set_layers_0_poisson", "status", "step"]);
    assert_eq!(table[0].last(), Some(&"reason"));
    let allowed = |name: &&str| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    assert!(table[0].iter().all(allowed) && table.iter().all(|row| row.len() == table[0].len()));
    assert_eq!(column(&table, "combination").join(""), "112233445566");
    assert_eq!(column(&table, "step").join(""), "121212121212");
    assert_eq!(column(&table, "set_layers_0_poisson")[..6], ["0.2", "0.2", "0.4", "0.4", "0.5", "0.5"]);
    // The fourth combination by itself.
    let solved = desk.solve(
        "alone",
        &["case.toml", "--no-pictures", "--set", "layers.0.thickness=0.3", "--set", "layers.0.poisson=0.2"],
    );
    for (row, step) in (6..).zip(solved.steps()) {
        for (name, pointer) in
            [("penetration", "/penetration"), ("levels_1_contact_radius", "/levels/0/contact_radius")]
        {
            assert_eq!(column(&table, name)[row].parse::<f64>().unwrap(), number(&step, pointer), "{name}");
        }
    }
    // Whatever the number of threads.
    let again = ["--set", "layers.0.thickness=0.1,0.3", "--set", "layers.0.poisson=0.2,0.4,0.5", "--threads", "3"];
    let again = sweep(&desk, "again", &[&again[..], &["-q"]].concat());
    assert_eq!((again.code, &again.out[..]), (0, ""));
    assert_eq!(Folder(desk.path("again")).text("sweep.csv"), text);
    // The best has the least peak pressure, the worst the largest, by the last load steps.
    let peaks: Vec<f64> =
        column(&table, "max_pressure").iter().skip(1).step_by(2).map(|cell| cell.parse().unwrap()).collect();
    assert!(answer.out.contains("best and worst of 6 combinations, last load steps"), "{}", answer.out);
    for (word, end) in [("best", f64::total_cmp as fn(&f64, &f64) -> _), ("worst", |a, b| b.total_cmp(a))] {
        let at = (0..6).min_by(|a, b| end(&peaks[*a], &peaks[*b])).unwrap();
        let [thickness, poisson] =
            ["thickness", "poisson"].map(|key| column(&table, &format!("set_layers_0_{key}"))[2 * at]);
        let settings = format!("{}: thickness = {thickness}, poisson = {poisson}", at + 1);
        let is_it = |line: &str| line.split_whitespace().any(|written| written == word) && line.ends_with(&settings);
        assert!(answer.out.lines().any(is_it), "no {word} with {settings}: {}", answer.out);
    }
}

#[test]
fn what_fails_is_a_row_that_says_why() {
    let desk = desk();
    let answer = sweep(&desk, "out", &["--set", "layers.0.poisson=0.3,0.7", "--set", "solver.max_iterations=1,100"]);
    answer.complains(3, &["combination 3 (layers.0.poisson=0.7", "`layers[0].poisson`"]);
    let text = Folder(desk.path("out")).text("sweep.csv");
    let table = cells(&text);
    let status = ["not_converged", "not_converged", "done", "done", "failed", "failed"];
    assert_eq!(column(&table, "status"), status);
    assert!(column(&table, "reason")[4].contains("poisson") && column(&table, "reason")[3].is_empty());
    assert!(column(&table, "penetration")[4].is_empty() && !column(&table, "penetration")[0].is_empty());
    let summary = desk.json("out/sweep.json");
    assert_eq!(
        [&summary["done"], &summary["not_converged"], &summary["failed"]],
        [&1, &1, &2].map(|n| Value::from(*n)).each_ref()
    );
}

#[test]
fn what_can_be_no_sweep_is_refused_and_nothing_written() {
    let desk = desk();
    desk.write("table.csv", "layers.0.thickness,grid.points\n0.1\n");
    desk.write("twice.csv", "layers.0.thickness,grid.points\n0.1,16\n0.1,32\n0.10,16.0\n");
    desk.write("good.csv", "layers.0.thickness,grid.points\n0.1,16\n0.1,32\n");
    for (arguments, words) in [
        (
            &["--set", "grid.points=16,32", "--set", "layers.0.thickness=0.1", "--set", "layers[0].thickness=0.2"][..],
            "twice",
        ),
        (
            &["--set", "layers.0.thickness=0.1", "--set", "layers.0.thickness=0.2,0.3"],
            "`layers.0.thickness` is given twice",
        ),
        (&["--set", "layers.0.thickness=0.2,0.3", "--set", "layers.0.thickness=0.1"], "give a key once"),
        (&["--set", "layers.0.thickness=0.1,0.2", "--set", "layers.0.thickness=0.3,0.4"], "give a key once"),
        (&["--table", "good.csv", "--set", "grid.points=48"], "`grid.points` is given twice"),
        (&["--table", "good.csv", "--set", "grid.points=48,64"], "`grid.points` is given twice"),
        (&["--set", "layers.0.thickness=0.1,0.2,0.10"], "layers.0.thickness = 0.10 is given twice"),
        (&["--set", "layers.0.thickness=0.1:0.1:3"], "layers.0.thickness = 0.1 is given twice"),
        (&["--table", "twice.csv"], "layers.0.thickness = 0.10, grid.points = 16.0 is given twice"),
        (&["--zip", "--set", "layers.0.thickness=1,1", "--set", "grid.points=16,16"], "is given twice"),
        (&[], "needs a key with several values"),
        (&["--set", "layers.0.thickness=0.3"], "needs a key with several values"),
        (&["--set", "layers.0.thicknes=0.1,0.2"], "thickness"),
        (&["--set", "layers.0.thickness=0.1:0.2:0"], "number of values"),
        (&["--set", "layers.0.thickness=0.1,0.2", "--set", "grid.points=16,32,64", "--zip"], "--zip pairs"),
        (&["--table", "table.csv"], "table.csv, line 2: 1 values for 2 keys"),
        (&["--set", "grid.points=16,32", "--shard", "4/3"], "1 ≤ I ≤ N"),
        (&["--set", "grid.points=16,32", "--limit"], "strength"),
    ] {
        sweep(&desk, "out", arguments).complains(2, &[words]);
        assert!(!desk.path("out").exists(), "{arguments:?}");
    }
    fs::create_dir(desk.path("mine")).unwrap();
    desk.write("mine/sweep.csv", "my own");
    sweep(&desk, "mine", &["--set", "grid.points=16,32"]).complains(2, &["sweep.csv", "choose another folder"]);
    assert_eq!(Folder(desk.path("mine")).text("sweep.csv"), "my own");
}

#[test]
fn pairs_and_tables_make_the_same_rows() {
    let desk = desk();
    desk.write("table.csv", "# mine\nlayers.0.thickness; layers.0.interface\n0.1; bonded\n0.2; \"frictionless\"\n");
    let zip = ["--zip", "--set", "layers.0.thickness=0.1,0.2", "--set", "layers.0.interface=bonded,frictionless"];
    sweep(&desk, "zip", &zip).succeeds();
    sweep(&desk, "table", &["--table", "table.csv"]).succeeds();
    let [zip, table] = ["zip", "table"].map(|name| Folder(desk.path(name)).text("sweep.csv"));
    assert_eq!(zip, table);
    assert_eq!(zip.lines().count(), 5);
}

const MANY: [&str; 4] = ["--set", "layers.0.thickness=0.05:0.5:10", "--set", "layers.0.poisson=0:0.5:6"];

#[test]
fn a_killed_sweep_goes_on_and_ends_with_the_same_table() {
    let desk = desk();
    let larger = ["--set", "grid.points=96"];
    sweep(&desk, "whole", &[&MANY[..], &larger].concat()).succeeds();
    let log = "killed/unfinished-sweep/sweep.jsonl";
    let command = ["sweep", "case.toml", "-o", "killed", "--no-pictures"];
    kill(desk.begin(&[&command[..], &MANY, &larger].concat(), log, 5));
    let log = desk.path(log);
    // The log as if the sweep had been killed within a line.
    let text = fs::read_to_string(&log).unwrap();
    let done: Vec<&str> = text.split_inclusive('\n').filter(|line| line.ends_with('\n')).collect();
    fs::write(&log, format!("{text}{}", &done[0][..40])).unwrap();
    let answer = sweep(&desk, "killed", &[&MANY[..], &larger, &["--resume"]].concat()).succeeds();
    assert!(answer.err.contains(&format!("{} of 60 combinations are done already", done.len())), "{}", answer.err);
    let [whole, killed] = ["whole", "killed"].map(|name| Folder(desk.path(name)));
    assert_eq!(whole.text("sweep.csv"), killed.text("sweep.csv"));
    assert_eq!(whole.names(), killed.names());
    // Combinations that were done are not solved again: even the times are the same.
    let log = killed.text("sweep.jsonl");
    assert!(done.iter().all(|line| log.contains(line.trim_end())));
    // Without --resume nothing is lost either, and a finished sweep can be continued by more values.
    let more =
        ["--set", "layers.0.thickness=0.05:0.5:10", "--set", "layers.0.poisson=0,0.1,0.2,0.25,0.3,0.4,0.5", "--resume"];
    let answer = sweep(&desk, "killed", &[&more[..], &larger].concat());
    assert!(answer.err.contains("60 of 70 combinations are done already"), "{}", answer.err);
    assert_eq!(killed.text("sweep.csv").lines().count(), 141);
}

/// The hundred and thirtieth exit code is the shell's for what the keyboard ends.
#[test]
fn a_sweep_that_is_interrupted_keeps_its_rows_and_goes_on() {
    let desk = desk();
    let values = ["--set", "layers.0.thickness=0.05:0.5:12", "--set", "grid.points=64"];
    sweep(&desk, "out", &values).succeeds();
    let whole = Folder(desk.path("out")).text("sweep.csv");
    let log = "out/unfinished-sweep/sweep.jsonl";
    let command = ["sweep", "case.toml", "-o", "out", "--no-pictures"];
    let child = desk.begin(&[&command[..], &values].concat(), log, 3);
    // Files read while the sweep writes might not belong together.
    desk.percoat(&["report", "out"]).complains(2, &["out", "another run"]);
    send("INT", &child);
    let Answer { code, err: said, .. } = child.into();
    assert_eq!(code, 130, "{said}");
    let done = whole_lines(&desk.path(log));
    assert!(done >= 3 && said.contains(&format!("interrupted: {done} of 12 combinations")), "{said}");
    let answer = sweep(&desk, "out", &[&values[..], &["--resume"]].concat());
    assert!(
        answer.code == 0 && answer.err.contains(&format!("{done} of 12 combinations are done already")),
        "{}",
        answer.err
    );
    assert_eq!(Folder(desk.path("out")).text("sweep.csv"), whole);
}

#[test]
fn a_part_without_combinations_is_a_part() {
    let desk = desk();
    let values = ["--set", "layers.0.thickness=0.1,0.2"];
    for part in ["1/3", "2/3", "3/3"] {
        sweep(&desk, &format!("parts/{}", &part[..1]), &[&values[..], &["--shard", part]].concat()).succeeds();
    }
    desk.succeeds(&["merge", "--no-pictures", "parts/1", "parts/2", "parts/3"]);
    sweep(&desk, "whole", &values).succeeds();
    assert_eq!(Folder(desk.path("whole")).text("sweep.csv"), Folder(desk.path("parts")).text("sweep.csv"));
}

#[test]
fn what_cannot_be_used_again_is_not_lost() {
    let desk = desk();
    let done = |name: &str| fs::read_to_string(desk.path(name)).unwrap_or_default().lines().count();
    let values = ["--set", "layers.0.thickness=0.1,0.2,0.3"];
    sweep(&desk, "out", &values).succeeds();
    // The folder as a sweep that was killed at its end leaves it.
    fs::create_dir(desk.path("out/unfinished-sweep")).unwrap();
    desk.write("out/unfinished-sweep/.percoat", "");
    fs::copy(desk.path("out/sweep.jsonl"), desk.path("out/unfinished-sweep/sweep.jsonl")).unwrap();
    let other = sweep(&desk, "out", &[&values[..], &["--set", "substrate.poisson=0.2", "--resume"]].concat());
    other.complains(2, &["none of the 3 combinations", "--set", "--resume"]);
    assert_eq!((done("out/unfinished-sweep/sweep.jsonl"), done("out/sweep.jsonl")), (3, 3));
    let fewer = sweep(&desk, "out", &["--set", "layers.0.thickness=0.1,0.2,0.4", "--resume"]).succeeds();
    assert!(fewer.err.contains("interrupted-1") && fewer.err.contains("2 of 3 combinations"), "{}", fewer.err);
    assert_eq!((done("out/interrupted-1/sweep.jsonl"), done("out/sweep.jsonl")), (3, 3));
}

#[test]
fn parts_are_joined_to_the_table_of_the_whole() {
    let desk = desk();
    sweep(&desk, "whole", &MANY).succeeds();
    for part in ["1/3", "2/3", "3/3"] {
        let folder = format!("parts/shard-{}", &part[..1]);
        sweep(&desk, &folder, &[&MANY[..], &["--shard", part]].concat()).succeeds();
    }
    let merge = |folders: &[&str]| desk.percoat(&[&["merge", "--no-pictures"], folders].concat());
    merge(&["parts/shard-1", "parts/shard-3"]).complains(3, &["20 of 60 combinations are missing: 2, 5, 8"]);
    merge(&["parts/shard-3", "parts/shard-1", "parts/shard-2"]).succeeds();
    let [whole, parts] = ["whole", "parts"].map(|name| Folder(desk.path(name)));
    assert_eq!(whole.text("sweep.csv"), parts.text("sweep.csv"));
    sweep(&desk, "other", &["--set", "grid.points=16,24"]).succeeds();
    // Another sweep of as many combinations.
    let others = ["--set", "layers.0.thickness=0.05:0.6:10", "--set", "layers.0.poisson=0:0.5:6", "--shard", "2/3"];
    sweep(&desk, "changed", &others).succeeds();
    merge(&["parts/shard-1", "changed", "-o", "both"]).complains(2, &["not parts of one sweep", "fingerprint"]);
    merge(&["parts/shard-1", "other"]).complains(2, &["not parts of one sweep"]);
    merge(&["parts/shard-1", "."]).complains(2, &["holds no sweep"]);
}

/// The parts are there still, from which it is joined again.
#[cfg(unix)]
#[test]
fn what_a_merge_that_ended_rudely_has_left_goes_with_the_next_one() {
    let desk = desk();
    for part in ["1/2", "2/2"] {
        let arguments = ["--set", "layers.0.thickness=0.1,0.2,0.3,0.4", "--shard", part];
        sweep(&desk, &format!("parts/shard-{}", &part[..1]), &arguments).succeeds();
    }
    let merge = ["merge", "parts/shard-1", "parts/shard-2", "--pictures", "png"];
    // There is room for the log, and none for the picture.
    desk.limited("ulimit -f 32", &merge).complains(4, &["sweep.png: File too large"]);
    let again = desk.succeeds(&merge);
    assert!(!again.err.contains("interrupted"), "{}", again.err);
    let names = Folder(desk.path("parts")).names();
    assert!(names.iter().all(|name| !name.starts_with("interrupted") && !name.starts_with("unfinished")), "{names:?}");
    assert!(!desk.path("parts/.percoat/merge").exists());
}

#[test]
fn fields_are_kept_where_they_are_asked_for() {
    let desk = desk();
    sweep(&desk, "out", &["--keep-fields", "--set", "layers.0.thickness=0.1,0.2"]).succeeds();
    let alone = desk.solve("alone", &["case.toml", "--no-pictures", "--set", "layers.0.thickness=0.2"]);
    let kept = |number: &str| Folder(desk.path(&format!("out/combinations/{number}"))).results();
    assert_eq!(kept("0002"), alone.results());
    assert_eq!(Folder(desk.path("out/combinations/0002")).all_names(), alone.names(), "nothing else is left there");
    // Fields of another sweep stay until a new one is complete, and those of the same are taken over.
    let before = Folder(desk.path("out/combinations/0001")).bytes("contact.npz");
    let more = sweep(&desk, "out", &["--keep-fields", "--resume", "--set", "layers.0.thickness=0.1,0.2,0.3"]);
    assert!(more.code == 0 && more.err.contains("2 of 3 combinations are done already"), "{}", more.err);
    assert_eq!(Folder(desk.path("out/combinations/0001")).bytes("contact.npz"), before);
    assert_eq!(Folder(desk.path("out/combinations")).names().len(), 3);
    let fewer = sweep(&desk, "out", &["--set", "layers.0.thickness=0.1,0.2"]);
    assert!(fewer.code == 0 && !desk.path("out/combinations/0001/contact.npz").exists(), "they go with their result");
}

/// A combination that cannot be written is no failed one: the sweep ends with the error, however quiet, and goes on once there is room.
#[cfg(unix)]
#[test]
fn fields_without_room_end_the_sweep_with_an_error_also_when_quiet() {
    let desk = desk();
    let options = ["--keep-fields", "-q", "--resume", "--threads", "1", "--set", "layers.0.thickness=0.1,0.2"];
    let arguments = [&["sweep", "case.toml", "-o", "out", "--no-pictures"], &options[..]].concat();
    let full = desk.limited("ulimit -f 8", &arguments);
    full.complains(4, &["File too large"]);
    assert!(full.err.starts_with("error: cannot write out/"), "{}", full.err);
    assert!(!desk.path("out/sweep.csv").exists());
    assert_eq!(desk.succeeds(&arguments).err, "");
    assert_eq!(Folder(desk.path("out/combinations")).names().len(), 2);
}

#[test]
fn limits_of_every_combination_are_a_row() {
    let desk = desk();
    let strengths = ["--set", "layers.0.yield_strength=0.1", "--set", "substrate.yield_strength=0.05"];
    let keys = ["--set", "layers.0.shear_ratio=1,2", "--limit", "--json"];
    let answer = sweep(&desk, "out", &[&strengths[..], &keys].concat()).succeeds();
    let printed: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!((&printed["task"], &printed["done"]), (&"limit".into(), &2.into()));
    let text = Folder(desk.path("out")).text("sweep.csv");
    let table = cells(&text);
    let limits: Vec<f64> = column(&table, "first_mean_pressure").iter().map(|cell| cell.parse().unwrap()).collect();
    assert!(limits.len() == 2 && limits.iter().all(|limit| *limit > 0.0));
    desk.succeeds(&[&["limit", "case.toml", "-o", "own", "--no-pictures"], &strengths[..]].concat());
    let limit = desk.json("own/limit.json");
    assert_eq!(limits[1], number(&limit, "/first/mean_pressure"));
    let material = column(&table, "first_material")[1];
    assert_eq!(column(&table, &format!("yield_of_material_{material}_mean_pressure"))[1], limits[1].to_string());
}

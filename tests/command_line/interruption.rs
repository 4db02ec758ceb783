//! A run that is stopped, however rudely, leaves what it has finished and what stood there before.

use crate::archive::{Archive, read_npy};
use crate::damages::copy;
use crate::program::{Answer, Desk, Folder, LONG_ENOUGH, SIGNALS, kill, number, send, timeless};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How a run that is stopped ends its last line.
const GO_ON: &str = "; the same command with --resume goes on from there";
/// Forty steps that take their time.
const LONG: [&str; 4] = ["fig5", "--set", "grid.points=256", "--no-pictures"];
/// Some steps that do not, and others on the same grid.
const FIRST: [&str; 6] = [
    "fig2",
    "--no-pictures",
    "--set",
    "grid.points=96",
    "--set",
    "load.mean_pressure=[0.01, 0.02, 0.03, 0.04, 0.05, 0.06]",
];
const SECOND: [&str; 6] =
    ["fig5", "--no-pictures", "--set", "grid.points=96", "--set", "load.mean_pressure=[0.001, 0.002, 0.003, 0.004]"];

/// `percoat solve` with `arguments` into the folder `name`, on its way.
fn start(desk: &Desk, name: &str, arguments: &[&str]) -> Child {
    desk.start(&SIGNALS, &[&["solve", "-o", name], arguments].concat())
}

/// [`LONG`] into the folder `name`, on its way, once it has finished so many steps.
fn begin_long(desk: &Desk, name: &str, steps: usize) -> Child {
    desk.wait_for(start(desk, name, &LONG), &format!("{name}/unfinished/steps.jsonl"), steps)
}

/// The finished steps of an unfinished folder: every line that ends is a whole one.
fn finished_steps(unfinished: &Path) -> Vec<Value> {
    let log = fs::read_to_string(unfinished.join("steps.jsonl")).unwrap_or_default();
    let whole = log.split_inclusive('\n').filter(|line| line.ends_with('\n'));
    whole.map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Number of finished steps in an unfinished folder, each with its fields.
fn readable_steps(unfinished: &Path) -> usize {
    let steps = finished_steps(unfinished);
    if unfinished.join("contact.npz").exists() {
        let pressure = Archive::open(&unfinished.join("contact.npz")).field("pressure");
        assert_eq!(pressure.shape[0], steps.len());
        return steps.len();
    }
    for (number_of_step, step) in (1..).zip(&steps) {
        for name in ["pressure", "displacement", "gap"] {
            let array = read_npy(&unfinished.join(format!("contact.partial/{name}.{number_of_step:04}.npy")));
            assert_eq!(serde_json::json!(array.shape), step["points"]);
            let mean = array.values.iter().sum::<f64>() / array.values.len() as f64;
            if name == "pressure" {
                assert!((mean / number(step, "/mean_pressure") - 1.0).abs() < 1e-12);
            }
        }
    }
    steps.len()
}

#[test]
fn a_killed_run_leaves_its_finished_steps_and_the_next_one_keeps_them() {
    let desk = Desk::new();
    let folder = Folder(desk.path("long"));
    kill(begin_long(&desk, "long", 2));
    assert_eq!(folder.names(), ["unfinished".to_owned()].into());
    let killed = Folder(folder.0.join("unfinished"));
    let steps = readable_steps(&killed.0);
    assert!((2..40).contains(&steps), "{steps} steps");
    let names = killed.names();
    assert!(!names.contains("summary.json") && !names.contains("curve.csv"), "{names:?} of a run that is not complete");

    let again = desk.percoat(&["solve", "-o", "long", "fig5", "--set", "grid.points=48", "--no-pictures"]);
    assert!(again.code == 0 && again.err.contains("long/interrupted-1"), "{}", again.err);
    assert_eq!(folder.steps().len(), 40);
    assert_eq!(readable_steps(&folder.0.join("interrupted-1")), steps);
    assert!(!folder.names().contains("unfinished"));
}

#[test]
fn an_end_that_is_asked_for_is_answered_with_the_steps_that_are_saved() {
    for signal in ["INT", "TERM"] {
        let desk = Desk::new();
        let child = begin_long(&desk, "long", 2);
        send(signal, &child);
        let Answer { code, err: said, .. } = child.into();
        assert_eq!(code, 130, "{signal}: {said}");
        let steps = readable_steps(&desk.path("long/unfinished"));
        // Between the files of a step and the count of it.
        let expected = |steps: usize| format!("interrupted: {steps} of 40 steps saved in long/unfinished{GO_ON}\n");
        assert!([steps, steps - 1].iter().any(|&steps| said == expected(steps)), "{signal}: {said}, found {steps}");
    }
}

#[test]
fn a_signal_that_is_ignored_stays_so_and_the_others_are_answered() {
    let desk = Desk::new();
    let signals = ["--default-signal=TERM", "--ignore-signal=INT"];
    let child = desk.start(&signals, &[&["solve", "-o", "long"], &LONG[..]].concat());
    let mut child = desk.wait_for(child, "long/unfinished/steps.jsonl", 2);
    send("INT", &child);
    sleep(Duration::from_millis(100));
    assert!(child.try_wait().unwrap().is_none(), "an ignored signal is answered");
    send("TERM", &child);
    let Answer { code, err: said, .. } = child.into();
    assert!(code == 130 && said.starts_with("interrupted: "), "{said}");
    assert!(readable_steps(&desk.path("long/unfinished")) >= 2);
}

#[test]
fn a_run_that_cannot_say_anything_ends_as_it_would_have() {
    let desk = Desk::new();
    let run = |arguments: &[&str]| {
        let full = || fs::OpenOptions::new().write(true).open("/dev/full");
        // The other end of a pipe is closed where there is no such device.
        let mut child = desk
            .command(arguments)
            .stdout(Stdio::null())
            .stderr(full().map_or_else(|_| Stdio::piped(), Stdio::from))
            .spawn()
            .unwrap();
        drop(child.stderr.take());
        child.wait().unwrap().code()
    };
    assert_eq!(run(&["solve", "fig9"]), Some(2));
    let short = ["grid.points=48", "solver.max_iterations=2"].map(|set| ["--set", set]).concat();
    assert_eq!(run(&[&["solve", "-o", "short", "--no-pictures"], &short[..]].concat()), Some(3));
    assert_eq!(Folder(desk.path("short")).steps().len(), 1);
}

#[test]
fn a_second_run_into_a_folder_is_refused_and_the_first_goes_on() {
    let desk = Desk::new();
    let mut child = begin_long(&desk, "shared", 1);
    let process = format!("process {}", child.id());
    let solve = ["solve", "-o", "shared", "--set", "grid.points=48"];
    desk.percoat(&solve).complains(2, &["another run", &process, "shared", "-o"]);
    desk.percoat(&["compare", "-o", "shared"]).complains(2, &["another run"]);
    let before = readable_steps(&desk.path("shared/unfinished"));
    while readable_steps(&desk.path("shared/unfinished")) == before {
        assert!(child.try_wait().unwrap().is_none(), "the first run has ended");
        sleep(Duration::from_millis(2));
    }
    kill(child);
    desk.solve("shared", &[&solve[3..], &["--no-pictures"]].concat());
}

/// Files of a run beside the result before it, in order of appearance; a number waits for so many finished steps.
const PHASES: [&str; 14] = [
    "unfinished",
    "unfinished/case.toml",
    "unfinished/contact.partial",
    "unfinished/checkpoint.npz",
    "unfinished/contact.partial/gap.0001.npy",
    "1",
    "unfinished/contact.partial/gap.0002.npy",
    "2",
    "3",
    "4",
    "unfinished/contact.npz",
    "unfinished/summary.json",
    "unfinished/.publish.json",
    "after its end",
];

/// Waits until a run has come to a phase, or has ended.
fn wait_for_phase(phase: &str, folder: &Path, child: &mut Child) {
    let started = Instant::now();
    let reached = || match phase.parse() {
        Ok(steps) => finished_steps(&folder.join("unfinished")).len() >= steps,
        Err(_) => folder.join(phase).exists(),
    };
    while !reached() && child.try_wait().unwrap().is_none() {
        assert!(started.elapsed() < LONG_ENOUGH, "{phase} does not come");
        // Some phases are shorter than the pause of a thread.
        std::thread::yield_now();
    }
}

/// Asserts that runs set aside have a finished step at least, end with a whole line, and have no file half written.
fn aside_is_readable(folder: &Folder) {
    for name in folder.names().iter().filter(|name| name.starts_with("interrupted-")) {
        let aside = Folder(folder.0.join(name));
        assert!(readable_steps(&aside.0) > 0, "{name} has no steps: {:?}", aside.all_names());
        assert!(aside.text("steps.jsonl").ends_with('\n'), "{name}");
        assert!(aside.all_names().iter().all(|name| !name.ends_with(".tmp")), "{:?}", aside.all_names());
    }
}

#[test]
fn killed_in_every_phase_the_old_result_or_the_finished_steps_stand_readable() {
    let desk = Desk::new();
    let [first, second] =
        [("first", &FIRST), ("second", &SECOND)].map(|(name, arguments)| desk.solve(name, arguments).results());
    let whole = |folder: &Folder, files: &BTreeMap<String, Vec<u8>>| {
        files
            .iter()
            .all(|(name, content)| fs::read(folder.0.join(name)).is_ok_and(|found| timeless(name, found) == *content))
    };
    let (old, folder) = (Folder(desk.path("first")).files(), Folder(desk.path("run")));
    for phase in PHASES {
        copy(&desk.path("first"), &folder.0);
        let mut child = start(&desk, "run", &SECOND);
        wait_for_phase(phase, &folder.0, &mut child);
        kill(child);
        let unfinished = Folder(folder.0.join("unfinished"));
        let found = folder.files();
        let is_old = old.iter().all(|(name, content)| found.get(name) == Some(content));
        let stands = [is_old, whole(&folder, &second), whole(&unfinished, &second)];
        assert!(stands.contains(&true), "{phase}: {stands:?}, {:?}", folder.names());
        // A published result leaves no folder `unfinished/`.
        let finished = if stands[1] || stands[2] { 0 } else { readable_steps(&unfinished.0) };
        desk.solve("run", &FIRST);
        assert!(whole(&folder, &first) && !folder.names().contains("unfinished"), "{phase}");
        aside_is_readable(&folder);
        let aside = folder.0.join("interrupted-1");
        assert!(finished == 0 || readable_steps(&aside) == finished, "{phase}: {finished} steps were finished");
        fs::remove_dir_all(&folder.0).unwrap();
    }
}

/// `percoat solve` of `fig2` into the folder `run`, killed while it writes a file whose name begins so, before its first step is
/// finished. Where the kill came too late, it is tried again.
fn killed_while_writing(beginning: &str, desk: &Desk, arguments: &[&str]) {
    const TRIES: usize = 100;
    let unfinished = Folder(desk.path("run/unfinished"));
    let is_written = || unfinished.0.is_dir() && unfinished.names().iter().any(|name| name.starts_with(beginning));
    for _ in 0..TRIES {
        let mut child = start(desk, "run", &[&["fig2", "--no-pictures", "-q"], arguments].concat());
        while !is_written() && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        kill(child);
        if is_written() && !unfinished.0.join("steps.jsonl").exists() {
            return;
        }
        let _ = fs::remove_dir_all(&unfinished.0);
    }
    panic!("no kill came while {beginning}… was written");
}

/// The solution of the first load is saved, and its stresses are being written.
#[test]
fn killed_within_its_first_step_a_run_leaves_nothing_to_set_aside_and_the_same_one_goes_on() {
    let desk = Desk::new();
    let volume = "stress={ volume = { depth = 1.0, points = 64, rows = 16 } }";
    let case = ["--set", "grid.points=48", "--set", "load.mean_pressure=[0.02, 0.06]", "--set", volume];
    let folder = Folder(desk.path("run"));
    let killed = || {
        killed_while_writing(".stress.0001.vts", &desk, &case);
        assert!(folder.0.join("unfinished/checkpoint.npz").is_file());
    };
    killed();
    let other = ["solve", "-o", "run", "fig2", "--no-pictures", "--set", "grid.points=48"];
    let other = desk.percoat(&other);
    assert!(other.code == 0 && !other.err.contains("interrupted"), "{}", other.err);
    assert!(folder.names().iter().all(|name| !name.starts_with("interrupted-")), "{:?}", folder.names());
    killed();
    let same = [&["solve", "-o", "run", "fig2", "--no-pictures"], &case[..]].concat();
    let again = desk.percoat(&same);
    assert!(again.code == 0 && again.err.contains("note: goes on after step 1"), "{}", again.err);
    assert!(folder.names().iter().all(|name| !name.starts_with("interrupted-")), "{:?}", folder.names());
    let fresh = desk.solve("fresh", &same[3..]);
    assert!(fresh.results() == folder.results(), "{:?}", folder.names());
}

#[test]
fn a_line_that_was_being_written_is_cut_off_what_is_set_aside() {
    let desk = Desk::new();
    let loads: Vec<String> = (1..=200).map(|load| format!("{}", 1e-4 * f64::from(load))).collect();
    let loads = format!("load.mean_pressure=[{}]", loads.join(", "));
    let arguments = ["--no-fields", "--set", "grid.points=16", "--set", &loads];
    solve_without_room(&desk, 32, &arguments).complains(4, &["steps.jsonl: File too large"]);
    let folder = Folder(desk.path("run"));
    let log = folder.text("unfinished/steps.jsonl");
    let whole = &log[..=log.rfind('\n').unwrap()];
    assert!(whole.len() < log.len(), "the last line is a part of one");
    let next = desk.percoat(&["solve", "-o", "run", "fig2", "--no-pictures", "--set", "grid.points=48"]);
    assert!(next.code == 0 && next.err.contains("run/interrupted-1"), "{}", next.err);
    assert_eq!(folder.text("interrupted-1/steps.jsonl"), whole);
}

/// `percoat solve` of `fig2` into the folder `run`, where files of more than so many KiB fail within a write as on a full disk.
fn solve_without_room(desk: &Desk, size: usize, arguments: &[&str]) -> Answer {
    let solve = ["solve", "-o", "run", "fig2", "--no-pictures"];
    desk.limited(&format!("ulimit -f {size}"), &[&solve, arguments].concat())
}

/// The state of the solver takes 189 KiB on 96² samples and its coarser grids, on 192² four times as much.
#[test]
fn a_run_that_fails_on_a_finer_grid_says_what_the_coarser_one_has_saved() {
    let desk = Desk::new();
    let answer = solve_without_room(&desk, 225, &["--set", "grid.accuracy=1e-9"]);
    answer.complains(4, &["run/unfinished/checkpoint.npz: File too large"]);
    assert!(
        answer.err.ends_with(&format!(
            "0 of 1 steps saved in run/unfinished, all of them on a coarser grid in run/unfinished/coarser{GO_ON}\n"
        )),
        "{}",
        answer.err
    );
    assert_eq!(readable_steps(&desk.path("run/unfinished/coarser")), 1);
}

#[test]
fn a_disk_without_room_is_one_error_with_path_and_reason_and_the_steps_stay() {
    let desk = Desk::new();
    let folder = desk.solve("run", &FIRST);
    let before = folder.files();
    // The archive has twelve times 96² numbers.
    let load = "load.mean_pressure=[0.01, 0.02, 0.03]";
    let Answer { code, err: said, .. } = solve_without_room(&desk, 225, &["--set", "grid.points=96", "--set", load]);
    assert_eq!(code, 4, "{said}");
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        matches!(lines[..], [error, saved] if error.starts_with("error: cannot write run/unfinished/contact.npz: File too large")
            && saved == format!("3 of 3 steps saved in run/unfinished{GO_ON}")),
        "{said}"
    );
    assert_eq!(readable_steps(&folder.0.join("unfinished")), 3);
    assert!(folder.files() == before);
}

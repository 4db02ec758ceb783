//! A run that is stopped, however rudely, leaves what it has finished and what stood there before.

use crate::archive::{Archive, read_npy};
use crate::program::{Desk, Folder, number, timeless};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How a run that is stopped ends its last line.
const GO_ON: &str = "; the same command with --resume goes on from there";
const LONG_ENOUGH: Duration = Duration::from_secs(120);
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

/// `percoat solve` with `arguments` into `folder`, on its way.
fn start(folder: &Path, arguments: &[&str]) -> Child {
    // Whoever runs the tests may have signals ignored.
    start_with(&["--default-signal=HUP,INT,TERM"], folder, arguments)
}

/// The same with signals treated as `env` is told.
fn start_with(signals: &[&str], folder: &Path, arguments: &[&str]) -> Child {
    Command::new("env")
        .args(signals)
        .arg(assert_cmd::cargo::cargo_bin!("percoat"))
        .args(["solve", "--output"])
        .arg(folder)
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Starts a run and waits until it has finished so many steps.
fn start_and_wait(steps: usize, folder: &Path, arguments: &[&str]) -> Child {
    wait_for(steps, folder, start(folder, arguments))
}

/// Waits until a run on its way has finished so many steps.
fn wait_for(steps: usize, folder: &Path, mut child: Child) -> Child {
    let started = Instant::now();
    let unfinished = folder.join("unfinished");
    while finished_steps(&unfinished).len() < steps {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before it could be stopped");
        assert!(started.elapsed() < LONG_ENOUGH, "no step is finished after {LONG_ENOUGH:?}");
        sleep(Duration::from_millis(2));
    }
    child
}

fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
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
    kill(start_and_wait(2, &folder.0, &LONG));
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
fn a_finished_result_stands_untouched_until_the_next_one_is_complete() {
    let desk = Desk::new();
    let folder = desk.solve("run", &FIRST);
    let before = folder.files();
    kill(start_and_wait(1, &folder.0, &LONG));
    assert!(folder.files() == before, "{:?}", folder.names());
    assert!(readable_steps(&folder.0.join("unfinished")) >= 1);
}

#[test]
fn an_end_that_is_asked_for_is_answered_with_the_steps_that_are_saved() {
    for signal in ["INT", "TERM"] {
        let desk = Desk::new();
        let folder = desk.path("long");
        let child = start_and_wait(2, &folder, &LONG);
        Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{signal}: {said}");
        let steps = readable_steps(&folder.join("unfinished"));
        // Between the files of a step and the count of it.
        let expected = |steps: usize| {
            format!("interrupted: {steps} of 40 steps saved in {}{GO_ON}\n", folder.join("unfinished").display())
        };
        assert!([steps, steps - 1].iter().any(|&steps| said == expected(steps)), "{signal}: {said}, found {steps}");
    }
}

#[test]
fn a_signal_that_is_ignored_stays_so_and_the_others_are_answered() {
    let desk = Desk::new();
    let folder = desk.path("long");
    let signals = ["--default-signal=TERM", "--ignore-signal=INT"];
    let mut child = wait_for(2, &folder, start_with(&signals, &folder, &LONG));
    let id = child.id().to_string();
    let send = |signal: &str| Command::new("kill").args(["-s", signal, &id]).status().unwrap();
    send("INT");
    sleep(Duration::from_millis(100));
    assert!(child.try_wait().unwrap().is_none(), "an ignored signal is answered");
    send("TERM");
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(130) && said.starts_with("interrupted: "), "{said}");
    assert!(readable_steps(&folder.join("unfinished")) >= 2);
}

#[test]
fn a_run_that_cannot_say_anything_ends_as_it_would_have() {
    let desk = Desk::new();
    let run = |arguments: &[&str]| {
        let full = || fs::OpenOptions::new().write(true).open("/dev/full");
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("percoat"));
        let command = command.args(arguments).current_dir(desk.path(".")).stdout(Stdio::null());
        // Where there is no such device the other end of a pipe is closed.
        let mut child = command.stderr(full().map_or_else(|_| Stdio::piped(), Stdio::from)).spawn().unwrap();
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
    let mut child = start_and_wait(1, &desk.path("shared"), &LONG);
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
    desk.solve("shared", &solve[3..]);
}

/// Two runs into one folder by turns, each killed at a moment of its time, half of them toward its end where the result
/// is gathered and published.
fn survives_kills(moments: usize) {
    let desk = Desk::new();
    let mut runs = Vec::new();
    for (name, arguments) in [("first", &FIRST), ("second", &SECOND)] {
        let started = Instant::now();
        runs.push((arguments, desk.solve(name, arguments).results(), started.elapsed()));
    }
    let folder = desk.solve("run", &FIRST);
    let whole = |folder: &Folder, files: &BTreeMap<String, Vec<u8>>| {
        files
            .iter()
            .all(|(name, content)| fs::read(folder.0.join(name)).is_ok_and(|found| timeless(name, found) == *content))
    };
    let (mut random, mut found) = (0x2545_f491_4f6c_dd1d_u64, [0; 4]);
    for moment in 0..moments {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let fraction = (random >> 11) as f64 / (1u64 << 53) as f64;
        let (arguments, files, time) = &runs[(moment + 1) % 2];
        let part = if moment % 4 < 2 { fraction } else { 0.85 + 0.3 * fraction };
        let child = start(&folder.0, &arguments[..]);
        sleep(time.mul_f64(part));
        kill(child);

        let unfinished = Folder(folder.0.join("unfinished"));
        let stands = [whole(&folder, &runs[0].1), whole(&folder, &runs[1].1), whole(&unfinished, files)];
        assert!(stands.contains(&true), "moment {moment}: {stands:?}, {:?}", folder.names());
        let steps = readable_steps(&unfinished.0);
        found[if whole(&folder, files) {
            3
        } else if steps == 0 {
            0
        } else if steps < 2 {
            1
        } else {
            2
        }] += 1;
        for name in folder.names().iter().filter(|name| name.starts_with("interrupted-")) {
            assert!(readable_steps(&folder.0.join(name)) > 0, "{name} has no steps");
        }
    }
    eprintln!("killed {moments} times: after no step, one, more, and with nothing unfinished: {found:?}");
    desk.solve("run", &SECOND);
    assert!(whole(&folder, &runs[1].1) && !folder.names().contains("unfinished"));
}

#[test]
fn killed_at_a_dozen_moments_the_old_result_or_the_finished_steps_stand_readable() {
    survives_kills(12);
}

#[test]
#[ignore = "takes a minute"]
fn killed_at_fifty_moments_the_old_result_or_the_finished_steps_stand_readable() {
    survives_kills(50);
}

/// Into the folder `run`, where files of more than 225 or 450 KiB fail as they do on a full disk: blocks are of 512 or
/// 1024 bytes. The code, and what is said.
fn solve_without_room(desk: &Desk, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 450; exec \"$0\" \"$@\""])
        .arg(assert_cmd::cargo::cargo_bin!("percoat"))
        .args(["solve", "-o", "run", "fig2", "--no-pictures"])
        .args(arguments)
        .current_dir(desk.path("."))
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// What the solver knows takes 189 KiB on 96² samples and its coarser grids, on 192² four times as much.
#[test]
fn a_run_that_fails_on_a_finer_grid_says_what_the_coarser_one_has_saved() {
    let desk = Desk::new();
    let (code, said) = solve_without_room(&desk, &["--set", "grid.accuracy=1e-9"]);
    assert_eq!(code, Some(4), "{said}");
    assert!(said.contains("run/unfinished/checkpoint.npz: File too large"), "{said}");
    assert!(
        said.ends_with(&format!(
            "0 of 1 steps saved in run/unfinished, all of them on a coarser grid in run/unfinished/coarser{GO_ON}\n"
        )),
        "{said}"
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
    let (code, said) = solve_without_room(&desk, &["--set", "grid.points=96", "--set", load]);
    assert_eq!(code, Some(4), "{said}");
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        matches!(lines[..], [error, saved] if error.starts_with("error: cannot write run/unfinished/contact.npz: File too large")
            && saved == format!("3 of 3 steps saved in run/unfinished{GO_ON}")),
        "{said}"
    );
    assert_eq!(readable_steps(&folder.0.join("unfinished")), 3);
    assert!(folder.files() == before);
}

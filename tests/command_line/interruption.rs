//! A run that is killed leaves what it has finished.

use crate::archive::read_npy;
use crate::program::{Desk, Folder, number};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const LONG_ENOUGH: Duration = Duration::from_secs(120);

/// Kills `percoat solve` with `arguments` once `steps` steps stand in the curve.
fn kill_after(steps: usize, desk: &Desk, folder: &str, arguments: &[&str]) -> Folder {
    let folder = Folder(desk.path(folder));
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("percoat"))
        .args(["solve", "--output"])
        .arg(&folder.0)
        .args(arguments)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let started = Instant::now();
    let done = || std::fs::read_to_string(folder.0.join("curve.csv")).map_or(0, |curve| curve.lines().count());
    while done() < 1 + steps {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before it could be killed");
        assert!(started.elapsed() < LONG_ENOUGH, "no step is finished after {LONG_ENOUGH:?}");
        sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    folder
}

#[test]
fn a_killed_run_leaves_its_finished_steps_and_the_next_one_cleans_up() {
    let desk = Desk::new();
    let killed = kill_after(2, &desk, "long", &["fig5", "--set", "grid.points=256"]);
    let summary = killed.summary();
    let steps = summary["steps"].as_array().unwrap();
    assert_eq!(summary["complete"], false);
    assert!((2..40).contains(&steps.len()), "{} steps", steps.len());
    // The curve is written right after the summary; the end may come between the two.
    let rows = killed.text("curve.csv").lines().count() - 1;
    assert!(rows == steps.len() || rows + 1 == steps.len(), "{rows} rows of {} steps", steps.len());
    for (number_of_step, step) in (1..).zip(steps) {
        for name in ["pressure", "displacement", "gap"] {
            let array = read_npy(&killed.0.join(format!("contact.partial/{name}.{number_of_step:04}.npy")));
            assert_eq!(array.shape, [256, 256]);
            let mean = array.values.iter().sum::<f64>() / array.values.len() as f64;
            if name == "pressure" {
                assert!((mean / number(step, "/mean_pressure") - 1.0).abs() < 1e-12);
            }
        }
    }
    assert!(!killed.names().contains("contact.npz"), "an archive of unfinished steps");

    let again = desk.solve("long", &["fig5", "--set", "grid.points=48", "--set", "load.mean_pressure=0.01"]);
    assert_eq!(again.summary()["complete"], true);
    assert_eq!(again.contact().field("pressure").shape, [1, 48, 48]);
    assert_eq!(again.text("curve.csv").lines().count(), 2);
    assert!(!again.names().contains("contact.partial"), "the killed run's steps are still there");
}

#[test]
fn a_run_leaves_no_fields_or_temporary_files_of_an_earlier_one() {
    let desk = Desk::new();
    desk.solve("long", &["fig2", "--set", "grid.points=48"]);
    desk.write("long/.contact.npz.4711.tmp", "half an archive");
    let killed = kill_after(2, &desk, "long", &["fig5", "--set", "grid.points=256"]);
    assert!(!killed.names().contains("contact.npz"), "fields of another run beside the summary of this one");
    assert!(!killed.names().contains(".contact.npz.4711.tmp"));
}

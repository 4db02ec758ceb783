//! A process that may take little: few threads, small stacks, few addresses, a full disk. It ends with an error of one line.

#![cfg(target_os = "linux")]

use crate::program::{Answer, Desk};
use std::fs::{self, File, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::process::Command;
use std::time::Instant;

/// Asserts that the command has done its work, or says in a line why not.
fn assert_ended_well(answer: &Answer, what: &str) {
    assert!([0, 2, 4].contains(&answer.code), "{what} ends with {}: {}", answer.code, answer.err);
    if answer.code != 0 {
        assert!(answer.err.starts_with("error: ") && answer.err.lines().count() == 1, "{what}: {}", answer.err);
    }
}

#[test]
fn few_threads_are_an_error_of_one_line() {
    let desk = Desk::new();
    fs::set_permissions(desk.path("."), Permissions::from_mode(0o777)).unwrap();
    let is_bound = Command::new("id").arg("-u").output().is_ok_and(|output| output.stdout != b"0\n");
    // An administrator is not bound by limits of threads: the shell of somebody who is.
    let shell = || {
        let mut shell = Command::new(if is_bound { "bash" } else { "setpriv" });
        shell.args(["--reuid=4242", "--clear-groups", "bash"].iter().filter(|_| !is_bound));
        shell
    };
    let mut failed = 0;
    for most in 1..=8 {
        let folder = format!("out{most}");
        for arguments in [
            &["check", "fig2", "--set=grid.points=48"][..],
            &["solve", "fig2", "--set=grid.points=32", "--no-pictures", "-o", &folder],
            &["sweep", "fig2", "--set=grid.points=32,36,40", "--no-pictures", "-o", &folder],
            &["kernel", "fig2", "--wavenumber", "1"],
            &["check", "fig2", "--threads", "7"],
        ] {
            let Ok(output) = desk.limited_by(shell(), &format!("ulimit -u {most}"), arguments).output() else { return };
            if output.status.code() == Some(126) {
                return;
            }
            let answer = Answer::from(output);
            let what = format!("{most} threads: {arguments:?}");
            if answer.code == 0 {
                // A coarse grid is warned of.
                continue;
            }
            assert_eq!(answer.code, 4, "{what}: {}", answer.err);
            assert_ended_well(&answer, &what);
            assert!(answer.err.contains("cannot start") && answer.err.contains("ulimit -u"), "{what}: {}", answer.err);
            failed += 1;
        }
    }
    assert!(failed >= 5, "no limit was felt: {failed}");
}

#[test]
fn a_small_stack_is_enough() {
    let desk = Desk::new();
    // Less than 64 kB are needed before the program begins.
    for most in [64, 80, 100, 500] {
        for arguments in
            [&["check", "fig2"][..], &["explain"], &["--help"], &["cases", "fig2", "--set", "grid.points=64"]]
        {
            let answer = desk.limited(&format!("ulimit -s {most}"), arguments);
            assert_eq!(answer.code, 0, "{most} kB, {arguments:?}: {}", answer.err);
        }
    }
}

#[test]
fn few_addresses_are_an_error_of_one_line() {
    let desk = Desk::new();
    let mut failed = 0;
    // In small steps where the stacks of the first threads take the last of them.
    for most in (36_000..60_000).step_by(1_000).chain([60_000, 90_000, 130_000, 180_000, 230_000, 300_000]) {
        for arguments in [
            &["check", "fig2"][..],
            &["solve", "fig2", "--set=grid.points=2048", "--no-pictures"],
            &["limit", "--set=grid.points=1024", "--no-pictures"],
            &["sweep", "fig2", "--set=grid.points=1024,2048", "--no-pictures"],
            &["check", "fig2", "--threads", "8"],
        ] {
            let answer = desk.limited(&format!("ulimit -v {most}"), arguments);
            assert_ended_well(&answer, &format!("{most} kB of addresses: {arguments:?}"));
            failed += usize::from(answer.code != 0);
        }
    }
    assert!(failed >= 10, "no limit was felt: {failed}");
}

/// A scheduler's limit of processor time ends a run as it is asked to end: what is saved is said.
#[test]
fn the_end_of_the_time_allowed_is_answered_with_what_is_saved() {
    let desk = Desk::new();
    // The whole search takes many times as long.
    let answer = desk.limited("ulimit -St 1", &["limit", "--set=grid.points=192", "--no-pictures"]);
    answer.complains(130, &["interrupted: nothing is saved"]);
}

/// A file that may not grow is a full disk: what is finished stays, and the same command ends once it may.
#[test]
fn small_files_are_an_error_and_what_is_finished_stays() {
    let desk = Desk::new();
    let mut failed = 0;
    for most in [0, 1, 4, 16, 64] {
        for arguments in [
            &["solve", "fig2", "--set=grid.points=32", "--set=load.mean_pressure=[0.02,0.06]", "--no-pictures"][..],
            &["solve", "fig2", "--set=grid.points=32"],
            &["sweep", "fig2", "--set=grid.points=32,36", "--no-pictures"],
            &["limit", "--set=grid.points=16", "--no-pictures"],
            &["check", "rough", "--set=grid.points=128", "-o", "checked"],
        ] {
            let arguments =
                if arguments[0] == "check" { arguments.to_vec() } else { [arguments, &["-o", "out"]].concat() };
            let what = format!("files of {most} kB: {arguments:?}");
            let answer = desk.limited(&format!("ulimit -f {most}"), &arguments);
            if answer.code == 0 {
                continue;
            }
            failed += 1;
            assert!(
                answer.code == 4 && answer.err.contains("error: cannot write"),
                "{what}: {} {}",
                answer.code,
                answer.err
            );
            assert!(
                answer.err.contains("File too large") && !answer.err.contains("panicked"),
                "{what}: {}",
                answer.err
            );
            let again = desk.percoat(&arguments);
            assert_eq!(again.code, 0, "{what}, then allowed: {}", again.err);
            for folder in ["out", "checked"] {
                let _ = fs::remove_dir_all(desk.path(folder));
            }
        }
    }
    assert!(failed >= 10, "no limit was felt: {failed}");
}

#[test]
fn help_that_cannot_be_written_is_an_error() {
    let desk = Desk::new();
    for arguments in [
        &["--help"][..],
        &["-h"],
        &["--version"],
        &["help"],
        &["help", "solve"],
        &["solve", "--help"],
        &["sweep", "-h"],
        &["cases", "--version"],
        &["cases"],
        &["explain", "grid.points"],
        &["completions", "bash"],
        &["man"],
        &["kernel", "fig2", "--wavenumber", "1"],
    ] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = desk.command(arguments).stdout(full).output().unwrap();
        Answer::from(output).complains(4, &["error: cannot write standard output"]);
    }
}

#[test]
fn more_threads_than_cores_have_use_for_are_lowered_with_a_word() {
    let desk = Desk::new();
    let arguments = ["check", "fig2", "--set", "grid.points=48"];
    let with = |variable: Option<&str>, more: &[&str]| {
        let mut command = desk.command(&[&arguments[..], more].concat());
        command.env_remove("RAYON_NUM_THREADS");
        if let Some(value) = variable {
            command.env("RAYON_NUM_THREADS", value);
        }
        let began = Instant::now();
        let answer = Answer::from(command.output().unwrap());
        assert!(began.elapsed().as_secs() < 60, "{variable:?} {more:?}");
        answer
    };
    for (variable, more, source) in [
        (None, &["--threads", "1000"][..], "--threads"),
        (None, &["--threads", "5000"], "--threads"),
        (None, &["--threads", "65535"], "--threads"),
        (Some("1000"), &[], "RAYON_NUM_THREADS"),
        (Some("99999999999999999999999"), &[], "RAYON_NUM_THREADS"),
        (Some("3"), &["--threads", "20000"], "--threads"),
    ] {
        let answer = with(variable, more).succeeds();
        assert!(
            answer.err.contains("note: ") && answer.err.contains(&format!("of {source}: more than 4")),
            "{}",
            answer.err
        );
    }
    for (variable, more) in
        [(None, &["--threads", "1"][..]), (Some("2"), &[]), (Some(""), &[]), (Some("many"), &["--threads", "2"])]
    {
        let answer = with(variable, more);
        assert_eq!((answer.code, answer.err.contains("threads")), (0, false), "{}", answer.err);
    }
    for variable in ["many", "-1", "2.5", "1e3", "0x10", "4 cores", "\u{1b}[2J"] {
        let answer = with(Some(variable), &[]);
        answer.complains(2, &["error: RAYON_NUM_THREADS", "is no number of threads"]);
        assert!(!answer.err.contains('\u{1b}'), "{:?}", answer.err);
    }
    let quiet = ["solve", "fig2", "-q", "--no-pictures", "--set=grid.points=32", "--threads", "1000"];
    assert_eq!(desk.percoat(&quiet).err, "");
}

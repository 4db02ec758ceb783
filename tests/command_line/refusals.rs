//! Options without effect, files that are no case, what memory does not hold, and how a refusal looks.

use crate::program::Desk;
use std::env;
use std::process::{Command, Stdio};

#[test]
fn an_option_without_effect_is_refused_with_the_reason() {
    let desk = Desk::new();
    for (arguments, words) in [
        (
            &["kernel", "--wavenumber=1", "-o", "x"][..],
            &["-o has no effect in `percoat kernel`", "writes no files"][..],
        ),
        (&["check", "fig2", "--output=x"], &["-o is for the power spectrum of a [surface]"]),
        (&["merge", "x", "--set=a=1"], &["--set has no effect in `percoat merge`", "leave it out"]),
        (&["check", "fig2", "-q"], &["-q has no effect in `percoat check`"]),
        (&["kernel", "--wavenumber=1", "--threads", "2"], &["--threads has no effect"]),
        (&["cases", "-o", "x"], &["-o has no effect in `percoat cases`"]),
        (&["cases", "--verbose"], &["--verbose has no effect in `percoat cases`"]),
        (&["validate", "--set", "a=1"], &["--set has no effect in `percoat validate`", "reads no case"]),
        (&["check", "fig2", "--no-pictures"], &["--no-pictures has no effect", "draws none"]),
        (&["validate", "--pictures", "svg"], &["--pictures has no effect in `percoat validate`", "fixed"]),
        (&["--quiet", "solve"], &["percoat solve --quiet"]),
        (&["cases", "--set", "grid.points=64"], &["say which one"]),
    ] {
        desk.percoat(arguments).complains(2, &[words, &["error: "]].concat());
    }
    assert!(desk.names().is_empty());
}

/// Whichever command, and whichever of the two spellings of a list.
#[test]
fn a_key_that_is_set_twice_is_refused() {
    let desk = Desk::new();
    let [first, other] = ["--set=layers.0.thickness=0.3", "--set=layers[0].thickness=0.4"];
    for command in [
        &["solve", "fig2"][..],
        &["compare", "fig2"],
        &["limit", "fig2"],
        &["life", "fig2"],
        &["kernel", "fig2", "--wavenumber=1"],
        &["check", "fig2"],
        &["cases", "fig2"],
        &["sweep", "fig2", "--set=grid.points=16,32"],
    ] {
        desk.percoat(&[command, &[first, other]].concat()).complains(2, &["`layers[0].thickness`", "twice"]);
        desk.percoat(&[command, &[first, first]].concat()).complains(2, &["`layers.0.thickness`", "twice"]);
    }
    assert!(desk.names().is_empty());
}

#[test]
fn cases_prints_a_changed_case_that_runs_as_the_override_would() {
    let desk = Desk::new();
    let changed = desk.percoat(&["cases", "fig2", "--set", "grid.points=48", "--set", "layers.0.thickness=0.3"]);
    assert_eq!((changed.code, changed.err.as_str()), (0, ""));
    assert!(changed.out.contains("thickness = 0.3") && changed.out.contains("points = [48, 48]"), "{}", changed.out);
    desk.write("mine.toml", &changed.out);
    let mine = desk.solve("mine", &["mine.toml", "--no-pictures"]);
    let direct = desk.solve("own", &["fig2", "--set=grid.points=48", "--set=layers.0.thickness=0.3", "--no-pictures"]);
    assert!(mine.results() == direct.results());
    desk.percoat(&["cases", "fig2", "--set", "grid.point=48"]).complains(2, &["did you mean `points`?"]);
    let list = desk.percoat(&["cases", "fig2", "--set", "load.mean_pressure=0.02,0.06"]);
    list.complains(2, &["'load.mean_pressure=[0.02,0.06]'", "percoat sweep"]);
}

#[test]
fn every_refusal_begins_with_the_same_word() {
    let desk = Desk::new();
    desk.write("bad.toml", "[lattice]\nkind = 3\n");
    for arguments in [
        &["solve", "bad.toml"][..],
        &["solve", "fig9"],
        &["slove"],
        &["solve", "absent.toml"],
        &["check", "-q", "fig2"],
    ] {
        let answer = desk.percoat(arguments);
        assert!(answer.err.starts_with("error: "), "{arguments:?}: {}", answer.err);
        assert!(!answer.err.contains("Error:"), "{}", answer.err);
    }
}

#[test]
fn a_case_that_is_not_utf8_is_refused_with_its_place() {
    let desk = Desk::new();
    desk.write("latin.toml", b"title = \"a\"\n# 5 \xb5m\n");
    desk.percoat(&["check", "latin.toml"]).complains(2, &["latin.toml:2:5", "not UTF-8", "byte 0xb5", "Latin-1"]);
    desk.write("wide.toml", b"\xff\xfet\0i\0");
    desk.percoat(&["solve", "wide.toml"]).complains(2, &["wide.toml:1:1", "UTF-16"]);
    desk.write("long.toml", vec![b'#'; (16 << 20) + 1]);
    desk.percoat(&["solve", "long.toml"]).complains(2, &["long.toml", "longer than 16 MiB"]);
}

#[test]
fn check_refuses_a_penetration_that_solve_refuses() {
    let desk = Desk::new();
    let settings = ["--set=grid.points=64", "--set=load.penetration=[0.01, 0.2]"];
    for command in ["check", "solve"] {
        let answer = desk.percoat(&[&[command, "fig2"], &settings[..]].concat());
        answer.complains(2, &["load.penetration = 0.2 is out of reach", "complete"]);
        assert_eq!(answer.out, "");
    }
    assert!(desk.names().is_empty(), "{:?} is written", desk.names());
}

#[test]
fn what_double_precision_cannot_carry_is_refused_and_not_printed() {
    let desk = Desk::new();
    for wavenumber in ["1e300", "1e-300", "5e-324", "1e61"] {
        let wavenumber = format!("--wavenumber={wavenumber}");
        desk.percoat(&["kernel", &wavenumber]).complains(2, &["between 1e-60 and 1e60"]);
    }
    let edges = desk.succeeds(&["kernel", "--wavenumber=1e-60,1e60", "--depth=0,1e-60,1,1e60"]);
    assert!(!edges.out.contains("null"), "{}", edges.out);
    for set in ["layers.0.thickness=1e155", "substrate.young=1e200", "layers.0.young=1e200"] {
        desk.percoat(&["solve", "--set", set]).complains(2, &["between 1e-60 and 1e60"]);
    }
    assert!(desk.names().is_empty());
}

#[test]
fn mixed_units_are_told_by_check_and_solve_and_stand_in_the_summary() {
    let desk = Desk::new();
    let settings = ["--set=grid.points=48", "--set=load.mean_pressure=0.9"];
    let checked = desk.succeeds(&[&["check", "fig2"], &settings[..]].concat());
    assert!(
        checked.err.contains("warning: load.mean_pressure = 0.90000 is 0.90 of Young's modulus"),
        "{}",
        checked.err
    );
    let answer = desk.percoat(&[&["solve", "fig2", "-o", "run", "--no-pictures"], &settings[..]].concat());
    assert!(answer.err.contains("warning: load.mean_pressure"), "{}", answer.err);
    // The substrate is the softer one, and a mean pressure reaches it.
    assert!(answer.err.contains("the pressure that reaches material 2 at the depth 0.5"), "{}", answer.err);
    let few = ["--set=localized={indenters=[7],elements=8}", "--no-pictures"];
    let compared = desk.percoat(&[&["compare", "fig2", "-o", "both"], &settings[..], &few].concat());
    assert!(compared.err.contains("warning: load.mean_pressure"), "{}", compared.err);
    let summary = desk.json("run/summary.json");
    let warnings = summary["warnings"].as_array().unwrap();
    assert!(warnings.iter().any(|text| text.as_str().unwrap().contains("MPa")), "{warnings:?}");
}

/// A shell that may take little memory stands for a machine that has little.
#[cfg(target_os = "linux")]
#[test]
fn a_grid_that_memory_does_not_hold_is_refused_with_the_largest_that_fits() {
    let desk = Desk::new();
    let limited = |arguments: &[&str]| desk.limited("ulimit -v 1000000", arguments);
    for command in ["solve", "check", "compare"] {
        let answer = limited(&[command, "fig2", "--set=grid.points=8192", "--threads=1"]);
        answer.complains(2, &["8192 × 8192 samples take about"]);
        let fits = answer.err.split("the largest grid that fits is grid.points = [").nth(1).unwrap();
        let points: usize = fits.split(',').next().unwrap().parse().unwrap();
        assert!((512..4096).contains(&points), "{}", answer.err);
    }
    let volume = "--set=stress={volume={depth=1.0,rows=2048,points=2048}}";
    limited(&["solve", "fig2", "--set=grid.points=64", volume])
        .complains(2, &["fewer rows or points in stress.volume"]);
    assert!(desk.names().is_empty());
}

/// Four hundred terabytes of stresses: no disk of ours has them.
#[test]
fn a_result_that_the_disk_does_not_hold_is_refused_before_anything_is_written() {
    let desk = Desk::new();
    let planes: Vec<String> = (0..400).map(|plane| format!("{}", f64::from(plane) / 400.0)).collect();
    let case = [
        "--set=grid.points=1024".to_owned(),
        "--set=load.mean_pressure={from=0.001,to=0.06,steps=10000}".to_owned(),
        format!("--set=stress={{planes=[{}]}}", planes.join(",")),
    ];
    let case: Vec<&str> = case.iter().map(String::as_str).collect();
    for command in ["solve", "check"] {
        let refused = desk.percoat(&[&[command, "fig2"], &case[..]].concat());
        refused.complains(2, &["1024 × 1024 samples take about", "of disk", "are free", "the largest grid that fits"]);
    }
    assert!(desk.names().is_empty());
}

/// The estimate holds for this build and this machine too: −0/+25 % of the peak that the system saw.
#[cfg(target_os = "linux")]
#[test]
fn the_memory_that_check_states_is_the_peak_of_the_run() {
    let desk = Desk::new();
    for settings in [&["--set=grid.points=512"][..], &["--set=grid.points=512", "--set=stress={planes=[0.0]}"]] {
        let checked = desk.percoat(&[&["check", "fig2"], settings].concat());
        let stated: f64 = between(&checked.out, "(", " MiB without pictures").parse().unwrap();
        let solve = [&["solve", "fig2", "--no-pictures", "-q", "-o", "run"], settings].concat();
        let mut run = desk.command(&solve).stdin(Stdio::null()).spawn().unwrap();
        let mut peak = 0.0;
        while run.try_wait().unwrap().is_none() {
            let status = std::fs::read_to_string(format!("/proc/{}/status", run.id())).unwrap_or_default();
            if let Some(line) = status.lines().find_map(|line| line.strip_prefix("VmHWM:")) {
                peak = line.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0;
            }
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        println!("{settings:?}: {stated} MiB stated, {peak:.1} MiB taken");
        assert!((peak..1.25 * peak).contains(&stated), "{settings:?}: {stated} MiB stated, {peak:.1} MiB taken");
        let disk = checked.out.split("disk: about ").nth(1).unwrap();
        let disk: f64 = disk.split(" MiB").next().unwrap().parse().unwrap();
        let written: u64 =
            std::fs::read_dir(desk.path("run")).unwrap().map(|it| it.unwrap().metadata().unwrap().len()).sum();
        // `check` counts three pictures, a fifth of a MiB each, that were not drawn.
        let written = written as f64 / f64::from(1 << 20);
        assert!((written..1.1 * written + 0.6).contains(&disk), "{disk} MiB stated, {written:.1} MiB written");
    }
}

/// Text between two words, from the last `before` in front of the first `after`.
#[cfg(target_os = "linux")]
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let end = text.find(after).unwrap();
    &text[text[..end].rfind(before).unwrap() + before.len()..end]
}

/// `PERCOAT_PYTHON` names the Python to use (default `python3`), which makes the terminal; without one the test is skipped.
#[cfg(unix)]
#[test]
fn a_terminal_that_wants_no_colour_gets_none() {
    const TERMINAL: &str = "import os, pty, sys\npty.spawn(sys.argv[1:])\n";
    let desk = Desk::new();
    desk.write("bad.toml", "[lattice]\nkind = 3\n");
    let python = env::var_os("PERCOAT_PYTHON").unwrap_or_else(|| "python3".into());
    let said = |arguments: &[&str], variable: (&str, &str)| {
        let mut command = Command::new(&python);
        command.args(["-c", TERMINAL]).arg(assert_cmd::cargo::cargo_bin!("percoat")).args(arguments);
        // Continuous integration sets CI, for which libraries colour what is no terminal.
        command.current_dir(desk.path("")).env("CI", "true").env("TERM", "xterm");
        command.env_remove("NO_COLOR").env(variable.0, variable.1);
        let output = command.stdin(Stdio::null()).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let Some(coloured) = said(&["solve", "bad.toml"], ("SOME", "1")) else {
        println!("skipped: no Python that opens a terminal");
        return;
    };
    assert!(coloured.contains('\u{1b}'), "{coloured}");
    let solve = ["solve", "--set=grid.points=48", "--no-pictures", "-o", "run"];
    assert!(said(&solve, ("SOME", "1")).unwrap().contains('\u{1b}'), "no progress is drawn");
    for arguments in [&["solve", "bad.toml"][..], &["slove"], &solve] {
        let plain = said(arguments, ("TERM", "dumb")).unwrap();
        assert!(!plain.contains('\u{1b}'), "{arguments:?}: {plain:?}");
    }
    for arguments in [&["solve", "bad.toml"][..], &["slove"]] {
        let plain = said(arguments, ("NO_COLOR", "1")).unwrap();
        assert!(!plain.contains('\u{1b}'), "{arguments:?}: {plain:?}");
    }
}

//! Expectations of any command line: help, completions, a manual, colour, standard input, JSON.

use crate::program::{Answer, Desk, Folder, assert_says};
use serde_json::Value;
use std::io::Write;
use std::process::Stdio;

const COMMANDS: [&str; 14] = [
    "solve",
    "compare",
    "limit",
    "identify",
    "sweep",
    "merge",
    "report",
    "kernel",
    "check",
    "cases",
    "explain",
    "validate",
    "completions",
    "man",
];

#[test]
fn every_help_has_an_example_and_the_exit_codes_and_fits_a_terminal() {
    let desk = Desk::new();
    let listed = desk.percoat(&["--help"]).out;
    for command in COMMANDS {
        assert!(listed.contains(&format!("\n  {command}")), "{command} does not stand in\n{listed}");
        let help = desk.percoat(&[command, "--help"]).out;
        assert_says(&help, &["Examples:\n  percoat ", "Exit codes: 0 "]);
        let examples = help.split("Examples:").nth(1).unwrap();
        assert!(examples.lines().all(|line| line.chars().count() <= 80), "{examples}");
    }
    let named = listed.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   ")).count();
    assert!(named >= COMMANDS.len() && listed.contains("Exit codes"), "{listed}");
}

#[test]
fn examples_of_the_help_are_read() {
    // Files that the examples name.
    let desk = Desk::new();
    desk.write("mine.toml", desk.percoat(&["cases", "dlc-on-steel"]).out);
    desk.write("settings.csv", "layers.0.thickness\n1.5\n");
    for command in COMMANDS {
        let help = desk.percoat(&[command, "--help"]).out;
        let examples = help.split("Examples:\n").nth(1).unwrap().split("\n\n").next().unwrap();
        for example in examples.lines() {
            let words = example.split('#').next().unwrap().split(['>', '|', '<']).next().unwrap().split_whitespace();
            let words: Vec<&str> = words.skip(1).collect();
            // A command line that is refused says so with its usage; with `--help` nothing is solved.
            let probe: Vec<&str> = words.iter().copied().chain(["--help"]).collect();
            desk.succeeds(&probe);
            let known = words[1..].iter().filter(|word| word.starts_with("--"));
            let unknown: Vec<_> = known.filter(|word| !help.contains(**word)).collect();
            assert!(unknown.is_empty(), "{example}: {unknown:?}");
        }
    }
}

#[test]
fn completions_and_the_manual_know_every_command() {
    let desk = Desk::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let answer = desk.succeeds(&["completions", shell]);
        assert!(COMMANDS.iter().all(|command| answer.out.contains(command)), "{shell}");
    }
    let page = desk.percoat(&["man"]).out;
    assert!(page.contains(".TH percoat 1") && COMMANDS.iter().all(|command| page.contains(command)), "{page}");
    let page = desk.percoat(&["man", "sweep"]).out;
    assert!(page.contains("\\-\\-resume") && page.contains("Exit codes"), "{page}");
    desk.percoat(&["man", "weep"]).complains(2, &["no command weep", "sweep"]);
    desk.percoat(&["completions", "tcsh"]).complains(2, &["tcsh", "bash"]);
}

#[test]
fn colour_is_as_it_is_asked_for() {
    let desk = Desk::new();
    let wrong = ["check", "fig2", "--set", "layers.0.poisson=2"];
    let with = |colour: &[&str]| desk.percoat(&[&wrong[..], colour].concat()).err.contains('\u{1b}');
    assert!(!with(&[]) && !with(&["--color", "never"]) && with(&["--color=always"]) && with(&["--color", "always"]));
    assert!(desk.percoat(&["--color=always", "solv"]).err.contains('\u{1b}'));
    desk.percoat(&["check", "fig2", "--color", "pink"]).complains(2, &["pink", "auto"]);
}

#[test]
fn a_case_comes_from_standard_input_and_its_summary_goes_to_standard_output() {
    let desk = Desk::new();
    let case = desk.percoat(&["cases", "fig2"]).out;
    let run = |arguments: &[&str]| {
        let [stdin, stdout, stderr] = [(); 3].map(|()| Stdio::piped());
        let mut child = desk.command(arguments).stdin(stdin).stdout(stdout).stderr(stderr).spawn().unwrap();
        child.stdin.take().unwrap().write_all(case.as_bytes()).unwrap();
        Answer::from(child)
    };
    let solved = run(&["solve", "-", "--json", "--no-pictures", "--no-fields", "--set", "grid.points=48"]);
    let printed: Value = serde_json::from_str(&solved.succeeds().out).unwrap();
    let folder = Folder(desk.path("out/stdin"));
    assert_eq!(printed, folder.summary());
    let names: Vec<String> = folder.names().into_iter().collect();
    assert_eq!(names, ["case.toml", "curve.csv", "summary.json"], "--no-fields keeps scalars");
    run(&["check", "-", "--set", "layers.0.poisson=2"]).complains(2, &["poisson"]);
}

#[test]
fn studies_are_listed_and_not_run() {
    let desk = Desk::new();
    let listed = desk.percoat(&["validate", "--list"]);
    assert!(listed.code == 0 && listed.out.lines().count() > 15 && listed.out.contains("\nhertz "), "{}", listed.out);
    assert_eq!(desk.percoat(&["validate", "paper", "--list"]).out.lines().count(), 7);
    desk.percoat(&["validate", "nothing", "--list"]).complains(2, &["no study nothing"]);
    assert!(desk.names().is_empty());
}

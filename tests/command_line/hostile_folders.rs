//! Links, pipes, folders and files that a user, or somebody else, has put into an output folder, in every place where
//! percoat has something of its own. Every command ends, and nothing of theirs is lost.

#![cfg(unix)]

use crate::damages::copy;
use crate::program::{Answer, Desk, Folder};
use percoat::case::{Case, Source};
use percoat::output::{self, Clock, Recording, RunFolder, solved_plan};
use std::fs;
use std::os::unix::fs::{FileTypeExt, MetadataExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const CASE: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "sphere", radius = 0.8 }]
substrate = { young = 1.0, poisson = 0.3, yield_strength = 0.3 }
load = { mean_pressure = [0.01, 0.02] }
grid = { points = 16 }
localized = { indenters = [5], elements = 6 }
"#;
const ROUGH: &str = r#"
lattice = { kind = "square", period = 1.0 }
surface.random = { hurst = 0.8, shortest = 0.1, rms_slope = 0.1 }
substrate = { young = 1.0, poisson = 0.3 }
load = { mean_pressure = 0.01 }
grid = { points = 32 }
"#;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Attack {
    LinkToFile,
    LinkToFolder,
    LinkToNothing,
    Pipe,
    FolderWithFiles,
    HardLink,
    File,
}

use Attack::{File, FolderWithFiles, HardLink, LinkToFile, LinkToFolder, LinkToNothing, Pipe};

const ATTACKS: [Attack; 7] = [LinkToFile, LinkToFolder, LinkToNothing, Pipe, FolderWithFiles, HardLink, File];

/// Contents of the folder `run` before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Before {
    Nothing,
    /// A solved case and a sweep.
    Finished,
    /// A case and a sweep as a kill has left them.
    Killed,
}

const COMMANDS: [(&str, &[&str]); 9] = [
    ("solve", &["solve", "case.toml", "-o", "run", "--no-pictures"]),
    ("resume", &["solve", "case.toml", "-o", "run", "--no-pictures", "--resume"]),
    ("check", &["check", "rough.toml", "-o", "run"]),
    ("compare", &["compare", "case.toml", "-o", "run", "--no-pictures"]),
    ("limit", &["limit", "case.toml", "-o", "run", "--no-pictures"]),
    ("sweep", &["sweep", "case.toml", "-o", "run", "--no-pictures", "--set", "levels.0.radius=0.7,0.9"]),
    (
        "sweep-resume",
        &["sweep", "case.toml", "-o", "run", "--no-pictures", "--set", "levels.0.radius=0.7,0.9", "--resume"],
    ),
    ("merge", &["merge", "run", "-o", "run", "--no-pictures"]),
    ("report", &["report", "run"]),
];

fn arguments(command: &str) -> &'static [&'static str] {
    COMMANDS.iter().find(|(name, _)| *name == command).unwrap().1
}

/// A desk with the cases, files of a user in `mine`, and the folders that are attacked.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("case.toml", CASE);
    desk.write("rough.toml", ROUGH);
    for folder in ["mine", "mine/folder", "nothing", "killed"] {
        fs::create_dir(desk.path(folder)).unwrap();
    }
    desk.write("mine/notes.txt", "notes");
    desk.write("mine/folder/thesis.tex", "thesis");
    for command in ["solve", "sweep"] {
        desk.succeeds(arguments(command));
    }
    fs::rename(desk.path("run"), desk.path("finished")).unwrap();
    kill(&desk);
    desk
}

/// Leaves in `killed` what a kill leaves after the second of two steps, and after the first of two combinations.
fn kill(desk: &Desk) {
    let folder = desk.path("killed");
    let source = Source { name: "case".to_owned(), text: CASE.to_owned(), ..Source::default() };
    let case = Case::read(&source, &[]).unwrap();
    let run = case.run();
    let claim = RunFolder::claim(&folder, solved_plan(&case, run.loads.len(), true)).unwrap();
    let print = output::fingerprint(&case, "fields");
    let mut recording = Recording::new(&claim, &run, case.to_toml(), Clock::start()).resumable(print, None);
    run.solve(&mut recording).unwrap();
    drop(recording);
    drop(claim);
    let sweep = folder.join("unfinished-sweep");
    fs::create_dir(&sweep).unwrap();
    fs::copy(folder.join("unfinished/.percoat"), sweep.join(".percoat")).unwrap();
    for name in ["sweep.json", "sweep.jsonl"] {
        fs::copy(desk.path("finished").join(name), sweep.join(name)).unwrap();
    }
    let log = Folder(sweep.clone()).text("sweep.jsonl");
    fs::write(sweep.join("sweep.jsonl"), log.split_inclusive('\n').next().unwrap()).unwrap();
}

/// Puts an attack in a place, and in the place of what stands there.
fn put(desk: &Desk, attack: Attack, place: &Path) {
    fs::create_dir_all(place.parent().unwrap()).unwrap();
    match fs::symlink_metadata(place) {
        Ok(found) if found.is_dir() => fs::remove_dir_all(place).unwrap(),
        Ok(_) => fs::remove_file(place).unwrap(),
        Err(_) => {}
    }
    match attack {
        LinkToFile => symlink(desk.path("mine/notes.txt"), place).unwrap(),
        LinkToFolder => symlink(desk.path("mine/folder"), place).unwrap(),
        LinkToNothing => symlink(desk.path("mine/nothing"), place).unwrap(),
        Pipe => assert!(Command::new("mkfifo").arg(place).status().unwrap().success()),
        FolderWithFiles => {
            fs::create_dir(place).unwrap();
            fs::write(place.join("thesis.tex"), "thesis of mine").unwrap();
        }
        HardLink => fs::hard_link(desk.path("mine/notes.txt"), place).unwrap(),
        File => fs::write(place, "a file of mine").unwrap(),
    }
}

/// Whether a path is what was put there, or a folder that has it.
fn has(desk: &Desk, attack: Attack, path: &Path) -> bool {
    let found = fs::symlink_metadata(path).unwrap();
    let links_to = |name: &str| found.is_symlink() && fs::read_link(path).unwrap() == desk.path(name);
    let says = |text: &str| found.is_file() && fs::read(path).unwrap() == text.as_bytes();
    let is = match attack {
        LinkToFile => links_to("mine/notes.txt"),
        LinkToFolder => links_to("mine/folder"),
        LinkToNothing => links_to("mine/nothing"),
        Pipe => found.file_type().is_fifo(),
        FolderWithFiles => says("thesis of mine"),
        HardLink => found.ino() == fs::metadata(desk.path("mine/notes.txt")).unwrap().ino(),
        File => says("a file of mine"),
    };
    let within = || fs::read_dir(path).unwrap().any(|entry| has(desk, attack, &entry.unwrap().path()));
    is || found.is_dir() && within()
}

/// Runs a command that must end; its exit code, and what it says.
fn ended(desk: &Desk, command: &str) -> (i32, String) {
    let mut child = desk
        .command(arguments(command))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let started = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if started.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            child.wait().unwrap();
            return (-1, "it does not end".to_owned());
        }
        sleep(Duration::from_millis(2));
    }
    let output = child.wait_with_output().unwrap();
    (output.status.code().unwrap_or(-2), String::from_utf8(output.stderr).unwrap())
}

/// Tries attacks in a place of the folder `run`, each with each command: what went wrong, and how often a command was refused.
fn attacked(desk: &Desk, before: Before, place: &str, commands: &[&str], attacks: &[Attack]) -> (Vec<String>, usize) {
    let template = match before {
        Before::Nothing => "nothing",
        Before::Finished => "finished",
        Before::Killed => "killed",
    };
    let (mut wrong, mut refused) = (Vec::new(), 0);
    for (&attack, command) in attacks.iter().flat_map(|attack| commands.iter().map(move |command| (attack, command))) {
        copy(&desk.path(template), &desk.path("run"));
        put(desk, attack, &desk.path("run").join(place));
        let (code, said) = ended(desk, command);
        let mut complain = |what: &str| {
            wrong.push(format!(
                "{attack:?} at {place} before {command}, {before:?}: {what} (exit {code}: {})",
                said.trim_end()
            ));
        };
        if !(0..=4).contains(&code) {
            complain("no end of a command");
        }
        let mine = |name: &str| fs::read_to_string(desk.path("mine").join(name)).unwrap_or_default();
        if mine("notes.txt") != "notes" || mine("folder/thesis.tex") != "thesis" {
            complain("a file behind a link is not what it was");
        }
        if Folder(desk.path("mine/folder")).all_names().len() != 1 || Folder(desk.path("mine")).all_names().len() != 2 {
            complain("something was written through a link");
        }
        if !has(desk, attack, &desk.path("run")) {
            complain("it is gone");
        }
        let lines = said.lines().filter(|line| line.starts_with("error:")).count();
        if matches!(code, 2 | 4) && lines != 1 {
            complain("no error of one line");
        }
        refused += usize::from(code == 2);
        desk.write("mine/notes.txt", "notes");
        desk.write("mine/folder/thesis.tex", "thesis");
        fs::remove_dir_all(desk.path("run")).unwrap();
    }
    (wrong, refused)
}

/// Contents of the folder before, places, commands and attacks: each with each.
type Row<'a> = (Before, &'a [&'a str], &'a [&'a str], &'a [Attack]);

/// Tries all rows of a table; `least` is how many commands are refused at least.
fn try_all(rows: &[Row<'_>], least: usize) {
    let desk = desk();
    let (mut wrong, mut refused) = (Vec::new(), 0);
    for (before, places, commands, attacks) in rows {
        for place in *places {
            let (new, count) = attacked(&desk, *before, place, commands, attacks);
            wrong.extend(new);
            refused += count;
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(refused >= least, "{refused} refused");
}

const WRITING: [&str; 6] = ["solve", "resume", "check", "compare", "limit", "sweep"];
const READING: [&str; 2] = ["merge", "report"];

/// Every attack but a user's file, where one of percoat's would have the same name and nothing tells them apart.
const TOLD_APART: [Attack; 5] = [LinkToFile, LinkToFolder, LinkToNothing, Pipe, FolderWithFiles];

#[test]
fn what_stands_in_the_place_of_percoats_own_folder_lock_or_list_is_kept_whatever_is_run() {
    let places = [".percoat", ".percoat/lock", ".percoat/written.json"];
    try_all(
        &[
            (Before::Nothing, &places, &WRITING, &ATTACKS),
            (Before::Finished, &places, &READING, &ATTACKS),
            (Before::Finished, &places[1..], &["resume", "sweep-resume"], &[LinkToFile, HardLink, Pipe]),
        ],
        150,
    );
}

#[test]
fn what_stands_where_results_are_made_and_go_is_kept() {
    let nothing = Before::Nothing;
    let at: [(&[&str], &[&str]); 6] = [
        (&["unfinished", ".percoat/retired"], &["solve", "resume"]),
        (&["unfinished-sweep", ".percoat/retired"], &["sweep", "sweep-resume"]),
        (&[".percoat/check", ".percoat/retired"], &["check"]),
        (&[".percoat/compare", ".percoat/retired"], &["compare"]),
        (&[".percoat/limit", ".percoat/retired"], &["limit"]),
        (&[".percoat/validate"], &["solve"]),
    ];
    let rows: Vec<_> = at.iter().map(|(places, commands)| (nothing, *places, *commands, &ATTACKS[..])).collect();
    try_all(&rows, 80);
    let reading = [".percoat/retired", ".percoat/report", ".percoat/merge", "unfinished-sweep"];
    try_all(&[(Before::Finished, &reading, &READING, &ATTACKS)], 25);
}

#[test]
fn what_stands_in_the_place_of_a_result_is_kept() {
    let (nothing, finished) = (Before::Nothing, Before::Finished);
    try_all(
        &[
            (nothing, &["summary.json", "case.toml", "contact.npz"], &["solve", "resume"], &ATTACKS),
            (nothing, &["spectrum.csv"], &["check"], &ATTACKS),
            (nothing, &["compare.json"], &["compare"], &ATTACKS),
            (nothing, &["limit.json"], &["limit"], &ATTACKS),
            (nothing, &["sweep.json", "sweep.csv"], &["sweep"], &ATTACKS),
            (nothing, &["sweep.jsonl"], &["sweep", "sweep-resume"], &ATTACKS),
            (finished, &["summary.json"], &["solve", "resume", "report"], &ATTACKS),
            (finished, &["sweep.json", "sweep.jsonl", "sweep.csv"], &["merge", "report", "sweep-resume"], &ATTACKS),
            (finished, &["limit.json", "report.html", "pressure.png"], &["report"], &ATTACKS),
        ],
        100,
    );
}

#[test]
fn what_stands_in_what_a_kill_has_left_is_kept() {
    let steps = [
        "unfinished/.percoat",
        "unfinished/.publish.json",
        "unfinished/steps.jsonl",
        "unfinished/checkpoint.npz",
        "unfinished/coarser",
        "unfinished/contact.partial",
        "unfinished/contact.partial/gap.0001.npy",
        "unfinished/contact.npz",
        "unfinished/summary.json",
        "unfinished/case.toml",
        "unfinished/.notes.tmp",
    ];
    let rows = ["unfinished-sweep/.percoat", "unfinished-sweep/sweep.jsonl", "unfinished-sweep/sweep.json"];
    let more = ["unfinished-sweep/combinations", "unfinished-sweep/sweep.csv"];
    try_all(
        &[
            (Before::Killed, &steps, &["solve", "resume"], &TOLD_APART),
            (Before::Killed, &rows, &["sweep", "sweep-resume"], &TOLD_APART),
            (Before::Killed, &more, &["sweep-resume"], &TOLD_APART),
            (Before::Killed, &["unfinished/notes.txt", "unfinished/mine.npz"], &["solve", "resume"], &ATTACKS),
        ],
        50,
    );
    // Links to files of a user are not cut, added to or emptied.
    let desk = desk();
    for name in ["unfinished/steps.jsonl", "unfinished-sweep/sweep.jsonl"] {
        for command in ["solve", "resume", "sweep", "sweep-resume"] {
            copy(&desk.path("killed"), &desk.path("run"));
            let mut log = Folder(desk.path("run")).bytes(name);
            log.extend(b"{\"half a line");
            desk.write("mine/log", &log);
            let place = desk.path("run").join(name);
            fs::remove_file(&place).unwrap();
            fs::hard_link(desk.path("mine/log"), &place).unwrap();
            let (code, said) = ended(&desk, command);
            assert_eq!(code, 0, "{command} with {name}: {said}");
            assert!(Folder(desk.path("mine")).bytes("log") == log, "{command} with {name}");
            fs::remove_dir_all(desk.path("run")).unwrap();
        }
    }
}

#[test]
fn an_output_folder_that_is_a_link_is_the_choice_of_its_user() {
    let desk = desk();
    fs::create_dir(desk.path("scratch")).unwrap();
    symlink(desk.path("scratch"), desk.path("run")).unwrap();
    for command in ["solve", "sweep", "report", "solve", "merge"] {
        let (code, said) = ended(&desk, command);
        assert_eq!(code, 0, "{command}: {said}");
    }
    let names = Folder(desk.path("scratch")).names();
    assert!(["summary.json", "sweep.json"].iter().all(|&name| names.contains(name)), "{names:?}");
    assert!(desk.path("run").is_symlink());
}

#[test]
fn a_case_whose_name_leads_elsewhere_writes_nothing_there() {
    let desk = Desk::new();
    fs::create_dir_all(desk.path("deep/out")).unwrap();
    let names =
        ["...toml", "....toml", ".. .toml", "a..toml", ".percoat.toml", "\n.toml", "a\u{1b}[2J.toml", "\u{202e}a.toml"];
    for name in names {
        desk.write(&format!("deep/{name}"), CASE);
        let before = Folder(desk.path("deep")).all_names();
        for command in [&["solve"][..], &["limit"], &["compare"], &["sweep", "--set", "levels.0.radius=0.7,0.9"]] {
            let [verb, rest @ ..] = command else { unreachable!() };
            let path = format!("./{name}");
            let arguments = [&[*verb, &path, "--no-pictures"], rest].concat();
            let answer = Answer::from(desk.command(&arguments).current_dir(desk.path("deep")).output().unwrap());
            answer.complains(2, &["-o"]);
            assert_eq!(answer.err.lines().count(), 1, "{name:?} {verb}: {}", answer.err);
        }
        assert_eq!(Folder(desk.path("deep")).all_names(), before);
        assert!(Folder(desk.path("deep/out")).all_names().is_empty());
    }
    desk.succeeds(&["solve", "deep/...toml", "-o", "run", "--no-pictures"]);
}

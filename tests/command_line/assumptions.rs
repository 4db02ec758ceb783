//! Assumptions behind largest stresses and limits are said beside them: rigid indenters, and which mean lateral stress.

use crate::program::{Desk, Folder};

const SMALL: [&str; 2] = ["--set=grid.points=24", "--no-pictures"];
const CONFINED: &str = "stress.mean = \"confined\"";
const HALF_SPACE: &str = "stress.mean = \"half-space\"";

/// A page without what HTML makes of quotes and of what stays on one line.
fn words(page: &str) -> String {
    page.replace("&quot;", "\"").replace('\u{a0}', " ")
}

/// Printed text in one line.
fn line(out: &str) -> String {
    out.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_mean_stress_that_was_used_stands_beside_stresses_and_limits() {
    let desk = Desk::new();
    for (number, set, said, not) in [
        (0, "stress={}", CONFINED, HALF_SPACE),
        (1, "stress.mean=confined", CONFINED, HALF_SPACE),
        (2, "stress.mean=half-space", HALF_SPACE, CONFINED),
    ] {
        for command in ["solve", "limit", "compare"] {
            if command != "solve" && number == 1 {
                continue;
            }
            let folder = format!("{command}{number}");
            let case = ["dlc-on-steel", "--set", set, "--set=friction.coefficient=0", "-o", &folder];
            let case = if command == "compare" {
                ["fig2", "--set", set, "--set=localized={ indenters = [7], elements = 16 }", "-o", &folder]
            } else {
                case
            };
            let answer = desk.percoat(&[&[command], &case[..], &SMALL].concat());
            assert!([0, 3].contains(&answer.code), "{}", answer.err);
            let out = line(&answer.out);
            assert!(out.contains(said) && !out.contains(not), "{command} {set}:\n{}", answer.out);
            if command != "compare" {
                desk.succeeds(&["report", &folder]);
                let page = words(&Folder(desk.path(&folder)).text("report.html"));
                assert!(
                    page.contains(&format!("with {said}")) && !page.contains(&format!("with {not}")),
                    "{command} {set}"
                );
            }
        }
    }
}

#[test]
fn rigid_indenters_are_said_where_strengths_and_limits_are_and_nowhere_else() {
    let desk = Desk::new();
    let said = ["the indenters are rigid", "[counterbody]"];
    for (folder, arguments, is_said) in [
        ("strong", &["solve", "dlc-on-steel"][..], true),
        ("limit", &["limit", "dlc-on-steel"], true),
        ("plain", &["solve", "fig2"], false),
        ("stressed", &["solve", "fig2", "--set=stress={}"], false),
    ] {
        let answer = desk.percoat(&[arguments, &["-o", folder], &SMALL].concat());
        assert!([0, 3].contains(&answer.code), "{}", answer.err);
        desk.succeeds(&["report", folder]);
        let page = words(&Folder(desk.path(folder)).text("report.html"));
        for words in said {
            assert_eq!(line(&answer.out).contains(words), is_said, "{folder}: {words}\n{}", answer.out);
            let words = words.trim_start_matches("the ");
            assert_eq!(page.contains(words), is_said, "{folder}: {words}");
        }
    }
}

#[test]
fn materials_without_a_strength_are_named_beside_strengths() {
    let desk = Desk::new();
    let said = "no strength is given for TiAlN and 100Cr6 of the counterbody";
    let solve =
        ["solve", "ball-on-disc", "-o", "solved", "--set=grid.points=48", "--set=load.force=1000", "--no-pictures"];
    let answer = desk.percoat(&solve);
    assert!(line(&answer.out).contains(said), "{}", answer.out);
    desk.succeeds(&["report", "solved"]);
    assert!(words(&Folder(desk.path("solved")).text("report.html")).contains(&said.replacen('n', "N", 1)));
    let all = ["--set=layers.0.tensile_strength=1", "--set=counterbody.yield_strength=2"];
    let answer = desk.percoat(&[&solve[..], &all].concat());
    assert!(!answer.out.contains("no strength is given"), "{}", answer.out);
}

/// Heights that change along x alone, on six samples along y: the mean stress of lines is said with their direction, errors are stated, and
/// a surface that changes along both is refused.
#[test]
fn lines_are_said_with_their_direction_and_have_their_errors() {
    let desk = Desk::new();
    let heights = |ripple: f64| -> String {
        let height = |i: usize, j: usize| (std::f64::consts::TAU * i as f64 / 64.0).cos() + ripple * (j % 2) as f64;
        let row = |i: usize| (0..6).map(|j| format!("{:.12}", 0.01 * height(i, j))).collect::<Vec<_>>().join(" ");
        (0..64).map(|i| row(i) + "\n").collect()
    };
    let case = "lattice = { kind = \"oblique\", a1 = [1, 0], a2 = [0, 0.1] }\nsurface = { heights = \"wave.txt\" }\n\
                substrate = { young = 1, poisson = 0.3 }\nload = { mean_pressure = 0.002 }\nstress = { mean = \"line\" }\n";
    desk.write("wave.toml", case);
    desk.write("wave.txt", heights(0.0));
    let answer = desk.succeeds(&["solve", "wave.toml", "-o", "wave", "--no-pictures"]);
    let out = line(&answer.out);
    assert!(out.contains("stress.mean = \"line\"") && out.contains("lines far apart along a₂"), "{out}");
    assert!(out.contains('±'), "{out}");
    desk.succeeds(&["report", "wave"]);
    assert!(words(&Folder(desk.path("wave")).text("report.html")).contains("with stress.mean = \"line\""));
    desk.write("wave.txt", heights(0.1));
    desk.percoat(&["solve", "wave.toml", "-o", "rippled"])
        .complains(2, &["stress.mean", "not constant along one side"]);
}

/// A verdict by a strength of the library is told with it, its kind of test and its range, by limit, solve, report and check; one by a number of
/// the case is not.
#[test]
fn strengths_of_the_library_are_stated_with_their_range() {
    let desk = Desk::new();
    let name = "Al2O3";
    let said = [
        "strengths of the library, not of your part:".to_owned(),
        format!("tensile strength of {name} 0.38 GPa (flexural, 0.25 to 0.43 GPa)"),
        "tensile strengths of the library are those of test bars".to_owned(),
        "no strength is given for 100Cr6 of the counterbody".to_owned(),
    ];
    let set = format!("--set=layers.0.material={name}");
    for (folder, command) in [("solved", "solve"), ("limit", "limit"), ("", "check")] {
        let mut arguments = vec![command, "ball-on-disc", &set, "--set=grid.points=48", "--set=load.force=1000"];
        if command != "check" {
            arguments.extend(["-o", folder, "--no-pictures"]);
        }
        let answer = desk.percoat(&arguments);
        let of_check = [
            format!(
                "layer 1 ({name}): tensile strength 0.38 GPa (library: flexural, 0.25 to 0.43 GPa); no residual stress given"
            ),
            "substrate (D2): yield strength 2.15 GPa (library: ".to_owned(),
            "counterbody (100Cr6): no strength given".to_owned(),
            said[2].clone(),
        ];
        for words in if command == "check" { &of_check } else { &said } {
            assert!(line(&answer.out).contains(words), "{command}: {words}\n{}", answer.out);
        }
        if command != "check" {
            desk.succeeds(&["report", folder]);
            let page = words(&Folder(desk.path(folder)).text("report.html"));
            assert!(page.contains(&said[1]) && page.contains(&said[3].replacen('n', "N", 1)), "{command}");
        }
    }
    let given = desk.percoat(&["check", "ball-on-disc", &set, "--set=layers.0.tensile_strength=1"]);
    assert!(line(&given.out).contains(&format!("layer 1 ({name}): tensile strength 1 GPa (given)")), "{}", given.out);
}

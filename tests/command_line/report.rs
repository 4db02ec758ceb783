//! `percoat report`: a page that is whole, says what the command line says, and takes nothing from anybody.

use crate::limit::BOND;
use crate::program::{Answer, Desk, Folder, assert_says};
use percoat::sweep::{Description, Log, Row, Task};
use serde_json::{Value, json};

/// A small run without pictures.
fn run(desk: &Desk, arguments: &[&str]) -> Answer {
    desk.percoat(&[&["solve", "-o", "run", "--no-pictures", "--set", "grid.points=48"], arguments].concat())
}

/// The page of a folder, whole and alone.
pub fn report(desk: &Desk, folder: &str) -> String {
    let answer = desk.percoat(&["report", folder]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    assert_eq!(answer.out, format!("written to {folder}/report.html\n"));
    let page = Folder(desk.path(folder)).text("report.html");
    assert_well_formed(&page);
    assert_alone(&page);
    page
}

/// Elements without content, which have no end.
const VOID: [&str; 2] = ["meta", "img"];

/// Every element that is opened is closed, in order, and no two have one name.
fn assert_well_formed(page: &str) {
    let body = page.strip_prefix("<!DOCTYPE html>\n").expect("a document of HTML 5");
    let (mut open, mut names): (Vec<&str>, Vec<&str>) = (Vec::new(), Vec::new());
    for piece in body.split('<').skip(1).filter(|piece| !piece.starts_with("!--")) {
        let (tag, _) = piece.split_once('>').expect("a tag ends");
        match tag.strip_prefix('/') {
            Some(name) => assert_eq!(open.pop(), Some(name)),
            None => {
                let name = tag.split_whitespace().next().unwrap();
                assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
                open.extend(Some(name).filter(|name| !VOID.contains(name)));
                names.extend(tag.split_once(" id=\"").and_then(|(_, rest)| rest.split('"').next()));
            }
        }
    }
    assert!(open.is_empty(), "{open:?} stays open");
    let mut unlike = names.clone();
    unlike.sort_unstable();
    unlike.dedup();
    assert_eq!(unlike.len(), names.len(), "{names:?}");
    for link in page.split("href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(link.strip_prefix('#').is_some_and(|name| names.contains(&name)), "{link} leads nowhere");
    }
    assert_says(page, &["lang=\"en\"", "name=\"viewport\"", "<main>", "@media print", "prefers-color-scheme: dark"]);
}

/// Asserts that the page loads nothing and that nothing in it runs.
fn assert_alone(page: &str) {
    for words in ["http://", "https://", "<script", "<link", "@import", "url(", " onload", "<iframe"] {
        assert!(!page.contains(words), "{words}");
    }
    assert!(page.split(" src=\"").skip(1).all(|rest| rest.starts_with("data:image/")));
}

/// Cells of a table of the command line.
fn cells(table: &str) -> impl Iterator<Item = String> {
    let cells = table.lines().flat_map(|line| line.split("  ")).map(|cell| cell.trim().to_owned());
    cells.filter(|cell| !cell.is_empty() && !cell.starts_with('─'))
}

/// Asserts that a page has each cell of printed tables, more than so many.
pub fn assert_has_cells(page: &str, printed: &str, more_than: usize) {
    let page = words(page);
    let printed = words(printed);
    let all: Vec<String> = cells(&printed).collect();
    assert!(all.len() > more_than, "{all:?}");
    for cell in all {
        assert!(page.contains(&format!(">{cell}<")), "\"{cell}\" does not stand on the page");
    }
}

/// A page in which nothing is tied to its neighbour.
fn words(page: &str) -> String {
    page.replace('\u{a0}', " ").replace("&#39;", "'")
}

#[test]
fn the_page_of_a_run_holds_what_the_command_line_printed() {
    let desk = Desk::new();
    let arguments = ["solve", "-o", "run", "dlc-on-steel", "--set", "grid.points=48"];
    let answer = desk.succeeds(&[&arguments[..], &["--set", "load.mean_pressure=[0.05, 0.2]"]].concat());
    let page = words(&report(&desk, "run"));
    // Title, tables and sentences up to the line of times.
    let out = words(&answer.out);
    let (printed, _) = out.split_once("estimated relative").expect("the last line but one");
    let mut count = 0;
    // The sentence on intervals stands in captions.
    let is_table = |cell: &str| {
        !cell.contains("load steps converged") && !cell.starts_with("first: ") && !cell.starts_with("an error beyond")
    };
    assert!(!printed.contains("an error beyond") || page.contains("an error beyond"));
    for cell in cells(printed).filter(|cell| is_table(cell)) {
        assert!(page.contains(&format!(">{cell}<")), "\"{cell}\" does not stand on the page");
        count += 1;
    }
    assert!(count > 100, "{count} cells");
    let out = out.lines().find_map(|line| line.strip_prefix("first: ")).expect("what fails first");
    assert!(page.contains(&format!("First: {out}.")));
    for warning in answer.err.lines().filter_map(|line| line.strip_prefix("warning: ")) {
        assert!(page.contains(warning), "{warning}");
    }
    let images = ["pressure", "contact", "profiles", "curve", "section", "lines"];
    assert_eq!(page.matches("data:image/svg+xml;base64,").count(), images.len());
    assert!(images.iter().all(|name| page.contains(&format!("<figure id=\"{name}\""))));
    assert_says(&page, &["Energy gap", "times below", "48 × 48", "residual_stress = -2.0", "2 (layer 2)", "level 1"]);
    let case = Folder(desk.path("run")).text("case.toml").replace('"', "&quot;");
    assert!(page.contains(&case), "the case can be copied as it was run");
}

/// A page without the case at its end.
fn told(page: &str) -> &str {
    page.split_once("Case</h2>").expect("the case").0
}

#[test]
fn the_page_of_an_isolated_contact_has_its_force_its_window_and_hertz_beside() {
    let desk = Desk::new();
    let answer = desk.succeeds(&["solve", "-o", "run", "ball-on-disc", "--no-pictures", "--set", "grid.points=48"]);
    let page = words(&report(&desk, "run"));
    let page = told(&page);
    let out = words(&answer.out);
    let hertz: Vec<&str> = out.lines().skip_while(|line| !line.starts_with("Hertz, ")).take(2).collect();
    assert!(hertz.len() == 2 && page.contains(&format!("{}.", hertz.join(" "))), "{hertz:?}");
    assert_says(
        page,
        &[
            "An elastic ball is pressed into an elastic half-space with a coating of one layer.",
            "The indenter<",
            "The counterbody, from its surface inward",
            "Under the force 5.0000 N",
            "contact area",
            "mean pressure where there is contact",
            "contact radius<",
            "elastic energy<",
            "samples of the window",
            "140 × 140",
            "mean pressure, force or penetration",
        ],
    );
    for words in ["NaN", "cell", "confined", "igid"] {
        assert!(!page.contains(words), "{words}");
    }
    let (_, mean) = page.split_once("mean pressure where there is contact").unwrap();
    let of_tags: String = mean.chars().take(120).collect();
    let numbers: Vec<f64> = of_tags.split(['<', '>', ' ']).filter_map(|word| word.parse().ok()).take(2).collect();
    let step = &Folder(desk.path("run")).steps()[1];
    let expected = step["force"].as_f64().unwrap() / step["contact_area"].as_f64().unwrap();
    assert!((numbers[0] - expected).abs() <= numbers[1] && numbers[1] < 0.05 * expected, "{of_tags}: {expected}");
}

#[test]
fn the_page_of_a_sweep_of_isolated_contacts_has_forces_and_areas() {
    let desk = Desk::new();
    let keys = ["--set", "layers.0.thickness=2,3", "--set", "grid.points=48"];
    desk.succeeds(&[&["sweep", "ball-on-disc", "-o", "out", "--pictures", "svg"], &keys[..]].concat());
    let page = words(&report(&desk, "out"));
    let page = told(&page);
    assert_says(
        page,
        &[">force<", ">contact area<", ">1000.0<", ">5000.0<", "in the last load step of each combination"],
    );
    assert!(!page.contains("NaN") && !page.contains(">mean pressure<") && !page.contains(">contact<"), "{page}");
    let picture = Folder(desk.path("out")).text("sweep.svg").replace('\u{a0}', " ");
    assert!(picture.contains("P = 5 N") && picture.contains("contact area A"), "{picture}");
    assert!(!picture.contains("step 1") && !picture.contains("fraction in contact"), "{picture}");
}

/// The case has a mean pressure and the sweep sets a force, or the reverse.
#[test]
fn a_sweep_states_loads_in_the_quantity_that_was_set() {
    let desk = Desk::new();
    for (fixed, swept, [said, axis], other) in [
        ("mean_pressure = 0.07", "load.force=20,28", ["force", "force P (unit of force)"], "mean pressure"),
        ("force = 28", "load.mean_pressure=0.05,0.07", ["mean pressure", "mean pressure p̄ (unit of E)"], "force"),
    ] {
        desk.write("case.toml", BOND.replace("mean_pressure = 0.07", fixed));
        let keys = ["--set", "layers.0.thickness=1,2", "--set", swept, "--zip"];
        for task in [&[][..], &["--limit"]] {
            let folder = format!("{said}{}", task.len());
            let begin = ["sweep", "case.toml", "-o", &folder, "--pictures", "svg"];
            let answer = desk.percoat(&[&begin[..], &keys, task].concat());
            assert!([0, 3].contains(&answer.code), "{}", answer.err);
            let page = words(&report(&desk, &folder));
            let (page, picture) = (told(&page), Folder(desk.path(&folder)).text("sweep.svg").replace('\u{a0}', " "));
            if task.is_empty() {
                let has = |name: &str| page.contains(&format!("<th scope=\"col\" class=\"number\">{name}<"));
                assert!(has(said) && !has(other), "{page}");
            } else {
                assert!(page.contains(&format!("the {said} of each limit")), "{page}");
                assert!(picture.contains(axis) && !picture.contains(other), "{picture}");
            }
        }
    }
}

#[test]
fn the_page_of_a_limit_says_first_what_fails_first() {
    let desk = Desk::new();
    desk.write("bond.toml", BOND);
    let answer = desk.succeeds(&["limit", "bond.toml", "-o", "out"]);
    let page = words(&report(&desk, "out"));
    let sentence = "First: delamination of interface 1 at the mean pressure 0.06";
    let (answer_at, problem_at) = (page.find(sentence).expect("the limit"), page.find("Problem</h2>").unwrap());
    assert!(answer_at < problem_at && page[answer_at..problem_at].contains(" ± "));
    let (table, _) = answer.out.split_once("\n\n").map(|(_, rest)| rest).unwrap().split_once("stresses with").unwrap();
    let (first, table) = table.split_once("criterion").unwrap();
    assert!(first.contains("first: delamination of interface 1"));
    assert!(cells(table).filter(|cell| cell.parse::<usize>().is_err()).all(|cell| page.contains(&format!(">{cell}<"))));
    assert_eq!(page.matches("data:image/svg+xml;base64,").count(), 2);
    assert!(page.contains("save this as case.toml and type percoat limit case.toml"));
}

/// A row of a sweep with a step of a summary, or with the reason for which it failed.
fn swept(combination: usize, thickness: &str, result: Result<&Value, &str>) -> Row {
    let (status, results) = result.map_or(("failed", json!([])), |step| ("done", json!([{ "step": step }])));
    serde_json::from_value(json!({
        "combination": combination,
        "settings": [["layers.0.thickness", thickness]],
        "fingerprint": "",
        "status": status,
        "reason": result.err(),
        "warnings": ["mind the gap"],
        "results": results,
        "seconds": 0.5,
    }))
    .unwrap()
}

#[test]
fn the_page_of_a_sweep_counts_what_is_solved_and_says_why_the_rest_is_not() {
    let desk = Desk::new();
    run(&desk, &[]).succeeds();
    let folder = Folder(desk.path("run"));
    let mut step = folder.summary()["steps"][0].take();
    (step["contact_fraction"], step["levels"][0]["load_share"]) = (0.25.into(), 0.5.into());
    (step["errors"]["contact_fraction"], step["levels"][0]["errors"]["load_share"]) = (Value::Null, Value::Null);
    let asked = Description::new("Thickness", &folder.text("case.toml"), Task::Solve, "1-2".to_owned(), 2);
    let write = |rows: &[Row]| {
        let described = Description { of: rows.len(), ..asked.clone() }.after(rows, 1.5);
        std::fs::create_dir_all(desk.path("sweep")).unwrap();
        drop(Log::begin(&desk.path("sweep"), &described.identity(), rows).unwrap());
        desk.write("sweep/sweep.json", described.to_json());
        desk.write("sweep/sweep.csv", percoat::sweep::table(rows));
    };
    let mut rows = vec![swept(1, "0.1", Ok(&step)), swept(2, "0.2", Err("the <penetration> is too small"))];
    write(&rows);
    let page = words(&report(&desk, "sweep"));
    assert_says(
        &page,
        &[
            "1 of 2 combinations are solved, 1 failed.",
            ">0.060000<",
            ">25.00 %<",
            ">50.00 %<",
            "mind the gap",
            ">layers.0.thickness<",
            "the &lt;penetration&gt; is too small",
            "All columns are in sweep.csv.",
            "shear_ratio = 2.0",
        ],
    );
    // Not listed, as in a copy; the list that a report makes does not change that.
    desk.write("sweep/sweep.svg", "<svg viewBox=\"0 0 400 100\"/>");
    rows.extend((3..500).map(|number| swept(number, "0.1", Ok(&step))));
    write(&rows);
    let page = report(&desk, "sweep");
    assert!(page.contains("<figure id=\"sweep\" class=\"wide\">"));
    assert!(page.contains("199 further rows and all columns are in sweep.csv."));
}

#[test]
fn steps_that_are_not_converged_are_marked_at_the_top() {
    let desk = Desk::new();
    let answer = run(&desk, &["--set", "solver.max_iterations=2"]);
    assert_eq!(answer.code, 3, "{}", answer.err);
    let page = report(&desk, "run");
    let doubt = page.find("Not converged: load step 1 (iteration limit)").expect("the doubt");
    assert!(doubt < page.find("Under the mean pressure").unwrap() && page.contains("times above, not met"));
}

#[test]
fn a_pressure_that_is_infinite_under_a_tip_is_no_reason_not_to_have_converged() {
    let desk = Desk::new();
    desk.write(
        "cone.toml",
        "lattice = { kind = \"square\", period = 1 }\nlevels = [{ shape = \"cone\", slope = 0.2 }]\n\
         substrate = { young = 1, poisson = 0.3 }\nload = { mean_pressure = 0.01 }\n",
    );
    desk.succeeds(&["solve", "cone.toml", "-o", "run", "--no-pictures", "--set", "grid.points=64"]);
    let page = words(&report(&desk, "run"));
    assert!(page.contains("1 of 1 load steps converged") && !page.contains("Not converged"), "{page}");
}

#[test]
fn a_title_is_a_text_whatever_stands_in_it() {
    let desk = Desk::new();
    let title = "title=\"\"\"<script src='http:x'>alert(1)</script> & \"</title>\"\"\"\"";
    run(&desk, &["--set", title]).succeeds();
    let page = report(&desk, "run");
    let escaped = "&lt;script src=&#39;http:x&#39;&gt;alert(1)&lt;/script&gt; &amp; &quot;&lt;/title&gt;&quot;";
    assert!(page.contains(&format!("<h1>{escaped}</h1>")));
}

#[test]
fn where_nothing_is_finished_nothing_is_written() {
    let desk = Desk::new();
    desk.percoat(&["report", "nowhere"]).complains(2, &["nowhere is not a folder"]);
    std::fs::create_dir_all(desk.path("begun/unfinished")).unwrap();
    desk.percoat(&["report", "begun"]).complains(2, &["no finished result", "unfinished/", "run the command again"]);
    std::fs::create_dir(desk.path("empty")).unwrap();
    desk.percoat(&["report", "empty", "-o", "page.html"]).complains(2, &["no finished result", "percoat solve"]);
    assert!(Folder(desk.path("empty")).all_names().is_empty() && !desk.path("page.html").exists());
}

#[test]
fn files_of_another_version_are_refused_with_what_is_missing() {
    let desk = Desk::new();
    run(&desk, &[]).succeeds();
    let folder = Folder(desk.path("run"));
    let mut summary: Value = folder.summary();
    summary["percoat"] = "7.0.0".into();
    summary["steps"][0]["levels"][1].as_object_mut().unwrap().remove("load_share");
    summary["steps"][0]["levels"][1].as_object_mut().unwrap().remove("resolution");
    desk.write("run/summary.json", summary.to_string());
    let words = ["summary.json", "`steps[0]`", "load_share", "percoat 7.0.0", "compute it again"];
    desk.percoat(&["report", "run"]).complains(2, &words);
    assert!(!folder.names().contains("report.html"));
}

#[test]
fn a_file_of_somebody_else_is_not_replaced_and_an_earlier_report_is() {
    let desk = Desk::new();
    run(&desk, &[]).succeeds();
    let folder = Folder(desk.path("run"));
    for name in ["run/report.html", "elsewhere.html"] {
        desk.write(name, "mine");
        desk.percoat(&["report", "run", "-o", name]).complains(2, &[name, "-o", "move it away"]);
        assert_eq!(std::fs::read_to_string(desk.path(name)).unwrap(), "mine");
        std::fs::remove_file(desk.path(name)).unwrap();
    }
    desk.percoat(&["report", "run", "-o", "run/summary.json"]).complains(2, &["summary.json"]);
    desk.percoat(&["report", "run", "-o", "run"]).complains(2, &["run is not a report"]);
    let first = report(&desk, "run");
    assert_eq!(report(&desk, "run"), first, "an earlier one of the same result is the same");
    for _ in 0..2 {
        desk.succeeds(&["report", "run", "-q", "-o", "new/page.html"]);
    }
    assert_eq!(std::fs::read_to_string(desk.path("new/page.html")).unwrap(), first);
    assert!(Folder(desk.path("new")).all_names() == ["page.html".to_owned()].into(), "nothing else is made there");
    desk.write("run/report.html", first.replace("0.06", "0.07"));
    desk.percoat(&["report", "run"]).complains(2, &["report.html", "changed since"]);
    // A page beside it, under another name.
    desk.succeeds(&["report", "run", "-o", "run/page.html"]);
    assert_eq!(folder.text("page.html"), first);
    // A copy without percoat's list is a finished result too, and its page is known by its content.
    std::fs::remove_dir_all(desk.path("run/.percoat")).unwrap();
    desk.write("run/report.html", &first);
    assert_eq!(report(&desk, "run"), first);
}

/// A page outside the folder of its result is written beside its place; a kill leaves it there, empty or as far as it was written.
#[test]
fn what_a_killed_report_has_left_goes_with_the_next_one_and_nothing_else_does() {
    let desk = Desk::new();
    run(&desk, &[]).succeeds();
    let page = report(&desk, "run").into_bytes();
    std::fs::create_dir(desk.path("new")).unwrap();
    for (name, content) in [
        (".page.html.1.tmp", &page[..9000]),
        (".page.html.1.2.tmp", b""),
        (".page.html.2.tmp", &page),
        (".page.html.3.tmp", b"mine"),
        (".other.html.1.tmp", &page),
        (".page.html.notes.tmp", &page),
        (".page.html.4.tmp", &page),
    ] {
        desk.write(&format!("new/{name}"), content);
    }
    // Another process writes it just now.
    let written = std::fs::File::open(desk.path("new/.page.html.4.tmp")).unwrap();
    written.lock().unwrap();
    desk.succeeds(&["report", "run", "-q", "-o", "new/page.html"]);
    let left: Vec<String> = Folder(desk.path("new")).all_names().into_iter().collect();
    let kept = [".other.html.1.tmp", ".page.html.3.tmp", ".page.html.4.tmp", ".page.html.notes.tmp", "page.html"];
    assert_eq!(left, kept);
}

#[test]
fn a_report_goes_with_the_result_that_it_shows_and_stays_where_its_owner_has_changed_it() {
    let desk = Desk::new();
    let folder = Folder(desk.path("run"));
    let solve = || {
        let answer = run(&desk, &["--set", "load.mean_pressure=0.02"]).succeeds();
        answer.err.contains("report.html showed the earlier result and is removed")
    };
    assert!(!solve());
    report(&desk, "run");
    assert_eq!(run(&desk, &["--set", "load.mean_pressure=[]"]).code, 2);
    assert!(folder.names().contains("report.html"), "a run that is refused takes nothing");
    assert!(solve(), "who runs it learns that it goes");
    assert!(!folder.names().contains("report.html"), "it would show numbers of a result that is gone");
    let page = report(&desk, "run");
    desk.write("run/report.html", page.replace("</h1>", " – for Monday</h1>"));
    assert!(!solve());
    assert!(folder.text("report.html").contains("for Monday"));
}

#[test]
fn a_picture_of_somebody_else_is_not_taken_for_one_of_the_run() {
    let desk = Desk::new();
    run(&desk, &[]).succeeds();
    desk.write("run/pressure.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    assert!(!report(&desk, "run").contains("<figure"));
}

//! Words that act on who reads them: escape sequences, marks of direction and letters without width in titles, keys, values, paths,
//! tables and results. Nothing of it reaches a terminal, a picture or a page as it is.

use crate::program::{Answer, Desk, Folder};
use serde_json::Value;
use std::fs;

/// Clears the screen, renames the window, colours by one byte, rings, goes back to the beginning of the line.
const SEQUENCES: [&str; 5] =
    ["\u{1b}[2J\u{1b}[H", "\u{1b}]0;mine\u{7}", "\u{9b}31m", "\u{8}\u{8}\u{7f}", "\rerror: none"];
/// Turns and isolates the direction of writing, letters without width, ends of lines that are none, tags, and what XML forbids.
const UNSEEN: [&str; 9] = [
    "\u{202e}dne",
    "\u{2067}\u{2069}",
    "\u{200b}\u{200d}\u{feff}",
    "\u{ad}\u{61c}",
    "\u{2028}\u{2029}\u{85}",
    "\u{b}\u{c}",
    "\u{e0067}\u{e007f}",
    "\u{ffff}\u{fffe}\u{fdd0}",
    "\u{3164}\u{115f}",
];

fn hostile() -> impl Iterator<Item = &'static str> {
    SEQUENCES.into_iter().chain(UNSEEN)
}

/// All of them in two words, where a word is told whole.
fn together() -> [String; 2] {
    [SEQUENCES.concat(), UNSEEN.concat()]
}

/// Whether a character acts instead of being seen; not by the rule of the program, but by the blocks of Unicode.
fn acts(c: char) -> bool {
    let hidden =
        ["\u{ad}\u{34f}\u{61c}\u{3164}\u{115f}\u{1160}\u{180e}\u{feff}", "\u{200b}\u{200c}\u{200d}\u{200e}\u{200f}"];
    c.is_control() && c != '\n'
        || hidden.iter().any(|all| all.contains(c))
        || ('\u{2028}'..='\u{202e}').contains(&c)
        || ('\u{2060}'..='\u{206f}').contains(&c)
        || ('\u{e0000}'..='\u{e0fff}').contains(&c)
        || ['\u{fffe}', '\u{ffff}', '\u{fdd0}'].contains(&c)
}

fn assert_plain(text: &str, what: &str) {
    let found = text.chars().find(|c| acts(*c));
    assert!(found.is_none(), "{what}: {found:?} in {text:?}");
}

/// Neither standard output nor standard error acts.
fn says_plainly(answer: &Answer, what: &str) {
    assert_plain(&answer.out, what);
    assert_plain(&answer.err, what);
}

/// A text as a value of TOML that any parser reads.
fn toml(text: &str) -> String {
    text.chars().map(|c| format!("\\U{:08X}", u32::from(c))).collect()
}

/// A small case with a title.
fn case(desk: &Desk, title: &str) -> String {
    let text = desk.percoat(&["cases", "fig2", "--set", "grid.points=32"]).out;
    text.lines().fold(String::new(), |text, line| {
        let line = if line.starts_with("title") { format!("title = \"{}\"", toml(title)) } else { line.to_owned() };
        text + &line + "\n"
    })
}

/// Every element of an XML file that is opened is closed, and every reference is one of XML's.
fn assert_well_formed(file: &str, what: &str) {
    let mut open = Vec::new();
    for piece in file.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').expect(what);
        match (tag.strip_prefix('/'), tag.strip_suffix('/')) {
            (Some(name), _) => assert_eq!(open.pop(), Some(name), "{what}"),
            (None, None) if !tag.starts_with('?') => open.extend(tag.split_whitespace().next()),
            _ => assert_eq!(tag.matches('"').count() % 2, 0, "{what}: {tag}"),
        }
        for reference in text.split('&').skip(1) {
            assert!(
                ["amp;", "lt;", "gt;", "quot;"].iter().any(|entity| reference.starts_with(entity)),
                "{what}: {text}"
            );
        }
    }
    assert_eq!(open, Vec::<&str>::new(), "{what}");
    assert_plain(file, what);
}

#[test]
fn a_title_reaches_no_terminal_picture_volume_or_page_as_it_is() {
    let desk = Desk::new();
    let tags = ["</text></svg><script>]]>&#27;&quot;", "-->\u{202e}<!--"];
    // One by one they are tried where a title is a line (`a_summary_on_standard_output_means_what_it_meant`).
    let titles = tags.map(str::to_owned).into_iter().chain(together());
    for (number, title) in titles.enumerate() {
        let title = format!("a {title} b");
        desk.write("mine.toml", case(&desk, &title));
        let folder = format!("run{number}");
        let volume = ["--set", "stress.volume={depth=1.0,rows=4,points=8}"];
        let answer = desk.percoat(&[&["solve", "mine.toml", "-o", &folder, "--pictures", "svg"], &volume[..]].concat());
        assert_eq!(answer.code, 0, "{title:?}: {}", answer.err);
        says_plainly(&answer, "solve");
        assert!(answer.out.starts_with("a "), "{}", answer.out);
        says_plainly(&desk.percoat(&["check", "mine.toml"]), "check");
        says_plainly(&desk.percoat(&["report", &folder]), "report");
        let run = Folder(desk.path(&folder));
        assert_plain(&run.text("report.html"), "the page");
        assert_plain(&run.text("case.toml"), "the case as run");
        // Nothing is lost: what is replaced is read back.
        assert_eq!(run.summary()["title"], Value::from(&*title));
        assert_eq!(run.text("case.toml").parse::<toml::Table>().unwrap()["title"].as_str(), Some(&*title));
        let (mut pictures, mut volumes) = (0, 0);
        for name in run.names() {
            if name.ends_with(".svg") {
                assert_well_formed(&run.text(&name), &name);
                pictures += 1;
            } else if name.ends_with(".vts") {
                let bytes = run.bytes(&name);
                let head = bytes.windows(13).position(|some| some == b"<AppendedData").unwrap();
                let head = format!("{}</VTKFile>", String::from_utf8(bytes[..head].to_vec()).unwrap());
                assert_well_formed(&head, &name);
                volumes += 1;
            }
        }
        assert!(pictures > 0 && volumes == 1, "{pictures} {volumes}");
    }
}

#[test]
fn a_summary_on_standard_output_means_what_it_meant() {
    let desk = Desk::new();
    for title in hostile() {
        desk.write("mine.toml", case(&desk, title));
        let answer = desk.percoat(&["solve", "mine.toml", "--no-pictures", "--json"]);
        says_plainly(&answer, "--json");
        let summary: Value = serde_json::from_str(&answer.out).unwrap();
        assert_eq!(summary["title"], Value::from(title));
        let set =
            format!("title='{title}'").replace(['\r', '\u{8}', '\u{b}', '\u{c}', '\u{1b}', '\u{7}', '\u{7f}'], "");
        let changed = desk.percoat(&["cases", "fig2", "--set", &set]);
        says_plainly(&changed, "cases");
        assert_eq!(changed.code, 0, "{}", changed.err);
        assert!(changed.out.parse::<toml::Table>().is_ok(), "{}", changed.out);
    }
}

#[test]
fn keys_values_and_words_of_the_command_line_are_told_plainly() {
    let desk = Desk::new();
    for word in hostile() {
        let key = toml(word);
        for text in [
            format!("\"lat{key}tice\" = 3\n"),
            format!("[lattice]\nkind = \"{key}\"\n"),
            format!("[lattice]\nkind = \"hexagonal\"\nperiod = 1.0\n\"{key}\" = 1\n"),
            format!("[surface]\nheights = \"{key}.npy\"\n[substrate]\nyoung = 1\npoisson = 0.3\n"),
            // The words as they are, which TOML forbids in part: the excerpt shows the line.
            format!("# {word}\n[lattice]\nkind = 3 # {word}\n"),
            format!("title = \"{word}\"\nlattice = 3\n"),
            format!("{word} = {word}\n"),
            format!("[units]\nlength = \"µ{key}m\"\n"),
        ] {
            desk.write("bad.toml", &text);
            let answer = desk.percoat(&["solve", "bad.toml"]);
            assert_eq!(answer.code, 2, "{text:?}: {}", answer.err);
            says_plainly(&answer, &text);
        }
    }
    for word in together().iter().map(String::as_str) {
        let set = format!("layers.0.thick{word}ness=1");
        let values = format!("layers.0.thickness={word},{word}");
        for arguments in [
            &["solve", "fig2", "--set", &set][..],
            &["solve", "fig2", "--set", &values],
            &["sweep", "fig2", "--set", &set],
            &["sweep", "fig2", "--set", &values],
            &["solve", word],
            &["check", word],
            &["report", word],
            &["merge", word, "x"],
            &["cases", word],
            &["explain", word],
            &["man", word],
            &["validate", word],
            &[word],
            &["solve", "--threads", word],
            &["solve", &format!("--{word}")],
            &["kernel", "fig2", "--wavenumber", word],
            &["completions", word],
        ] {
            let answer = desk.percoat(arguments);
            assert!([2, 4].contains(&answer.code), "{arguments:?}: {} {}", answer.code, answer.err);
            says_plainly(&answer, &format!("{arguments:?}"));
        }
    }
}

#[cfg(unix)]
#[test]
fn names_of_files_and_folders_are_told_plainly() {
    let desk = Desk::new();
    let small = case(&desk, "small");
    for word in together().into_iter().chain(["\nerror: nothing is done".to_owned()]) {
        let (file, folder) = (format!("a{word}.toml"), format!("out{word}"));
        desk.write(&file, &small);
        let solved = desk.succeeds(&["solve", &file, "-o", &folder, "--no-pictures"]);
        says_plainly(&solved, "solve");
        assert_eq!(solved.out.lines().filter(|line| line.starts_with("error")).count(), 0, "{}", solved.out);
        says_plainly(&desk.percoat(&["check", &file]), "check");
        says_plainly(&desk.percoat(&["solve", &file, "-o", &folder, "--no-pictures", "--resume"]), "resume");
        // Somebody else's file is in the way.
        fs::remove_dir_all(desk.path(&folder)).unwrap();
        fs::create_dir(desk.path(&folder)).unwrap();
        desk.write(&format!("{folder}/summary.json"), "mine");
        let refused = desk.percoat(&["solve", &file, "-o", &folder, "--no-pictures"]);
        assert_eq!(refused.code, 2, "{}", refused.err);
        says_plainly(&refused, "a folder of somebody else");
        assert_eq!(refused.err.lines().count(), 1, "{}", refused.err);
        // A table of a sweep, its keys and its values.
        desk.write("table.csv", format!("layers.0.thickness,{}\n0.2,1\n", word.replace('\n', "")));
        says_plainly(&desk.percoat(&["sweep", &file, "--table", "table.csv"]), "a table");
        desk.write("table.csv", format!("layers.0.thickness\n{}\n0.2\n", word.replace('\n', "")));
        says_plainly(&desk.percoat(&["sweep", &file, "--table", "table.csv", "-o", "sweep", "-v"]), "its values");
    }
}

#[test]
fn what_somebody_wrote_into_a_result_is_shown_plainly() {
    let desk = Desk::new();
    desk.write("mine.toml", case(&desk, "plain"));
    desk.solve("run", &["mine.toml", "--no-pictures"]);
    let run = Folder(desk.path("run"));
    let summary = run.text("summary.json");
    for word in together() {
        for place in ["plain", "preconditioned", "tolerance", "hexagonal", "converged\""] {
            if !summary.contains(place) {
                continue;
            }
            let escaped = Value::from(format!("a{word}b")).to_string();
            let tampered = summary.replace(place, &format!("{}{}", escaped.trim_matches('"'), place));
            fs::write(desk.path("run/summary.json"), tampered).unwrap();
            let answer = desk.percoat(&["report", "run", "-o", "page.html"]);
            says_plainly(&answer, place);
            if answer.code == 0 {
                assert_plain(&fs::read_to_string(desk.path("page.html")).unwrap(), place);
            }
        }
    }
}

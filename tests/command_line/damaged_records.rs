//! `solve --resume` after any damage: it goes on only with what is whole. It ends with what it would have ended with had nothing
//! been damaged, bit for bit, or is refused with the file; what is damaged is kept.

use crate::damages::{BLOWS, CASE, copy, ending_with, ends, flipped, relined, replaced, resealed, rezipped, strike};
use crate::mortal::{case, run};
use crate::program::{Answer, Desk, Folder};
use percoat::output::{self, CannotGoOn, without_checksum};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// After these calls all four loads are solved and recorded; after one more their fields are gathered too.
const RECORDED: usize = 8;

/// Folder of the steps of a run that was killed.
const UNFINISHED: &str = "killed/unfinished";

/// A desk with the case, its whole result, and the files of a run that is killed after so many calls.
struct Killed {
    desk: Desk,
    whole: Folder,
}

impl Killed {
    fn after(calls: usize) -> Self {
        let desk = Desk::new();
        desk.write("case.toml", CASE);
        let whole = desk.solve("whole", &["case.toml", "--no-pictures"]);
        assert!(run(&case(CASE), &desk.path("base"), true, calls).is_none());
        Self { desk, whole }
    }

    /// Does something to what the killed run has left, and goes on with it.
    fn resumed(&self, damage: impl FnOnce(&Path)) -> Answer {
        let _ = fs::remove_dir_all(self.desk.path("killed"));
        copy(&self.desk.path("base"), &self.desk.path("killed"));
        damage(&self.desk.path(UNFINISHED));
        self.desk.percoat(&["solve", "case.toml", "-o", "killed", "--no-pictures", "--resume"])
    }

    /// The result is that of a run that was never interrupted.
    fn is_whole(&self, what: &str, answer: &Answer) {
        ends(what, answer);
        assert_eq!(answer.code, 0, "{what}: {}", answer.err);
        let (found, expected) = (Folder(self.desk.path("killed")).results(), self.whole.results());
        for (name, content) in &expected {
            assert!(found.get(name) == Some(content), "{what}: {name} differs");
        }
    }

    /// Asserts that the resumed run names the file in one line, keeps it, and ends as if nothing had been.
    fn is_solved_again(&self, what: &str, file: &str, damage: impl Fn(&Path)) -> Answer {
        let answer = self.resumed(&damage);
        self.is_whole(what, &answer);
        let warnings: Vec<&str> = answer.err.lines().filter(|line| line.contains("solved again")).collect();
        assert!(
            matches!(warnings[..], [line] if line.contains(file) && line.contains("solved again") && line.contains("interrupted-1")),
            "{what}: {}",
            answer.err
        );
        let (aside, expected) = (self.desk.path("killed/interrupted-1"), self.desk.path("expected"));
        let _ = fs::remove_dir_all(&expected);
        copy(&self.desk.path("base/unfinished"), &expected);
        damage(&expected);
        assert_eq!(Folder(aside).all_files(), Folder(expected).all_files(), "{what}: all is kept as it was found");
        answer
    }
}

#[test]
fn a_step_whose_files_are_not_as_they_were_written_is_solved_again_with_all_others_and_said_so() {
    let killed = Killed::after(RECORDED);
    let whole = killed.resumed(|_| ());
    killed.is_whole("nothing", &whole);
    assert!(whole.err.contains("note: goes on after step 4") && !whole.err.contains("solved again"), "{}", whole.err);
    let files = [
        "contact.partial/pressure.0001.npy",
        "contact.partial/mean_pressure.0003.npy",
        "stress.partial/planes_zz.0002.002.npy",
        "stress.0003.vts",
    ];
    for (file, (what, blow)) in files.iter().flat_map(|file| BLOWS.iter().map(move |blow| (file, blow))) {
        killed.is_solved_again(&format!("{file}: {what}"), file, |place| strike(&place.join(file), *blow));
    }
    let file = "contact.partial/gap.0001.npy";
    let header = |from: &'static str, to: &'static str| {
        move |place: &Path| {
            let bytes = fs::read(place.join(file)).unwrap();
            let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
            fs::write(place.join(file), [&bytes[..at], to.as_bytes(), &bytes[at + to.len()..]].concat()).unwrap();
        }
    };
    killed.is_solved_again("a huge shape", file, header("(16, 12, ), }", "(99999999999, 99999999, ), }"));
    killed.is_solved_again("another type", file, header("<f8", "<f4"));
    for value in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
        killed.is_solved_again(&format!("a value is {value}"), file, |place| {
            let bytes = fs::read(place.join(file)).unwrap();
            fs::write(place.join(file), ending_with(bytes, value)).unwrap();
        });
    }
    killed.is_solved_again("two steps exchanged", "pressure.0001.npy", |place| {
        let [first, second] = [1, 2].map(|step| place.join(format!("contact.partial/pressure.000{step}.npy")));
        fs::rename(&first, place.join("between")).unwrap();
        fs::rename(&second, &first).unwrap();
        fs::rename(place.join("between"), &second).unwrap();
    });
    // A link that percoat has not made is nothing that it could move.
    #[cfg(unix)]
    {
        let answer = killed.resumed(|place| {
            fs::rename(place.join(file), place.join("mine.npy")).unwrap();
            std::os::unix::fs::symlink("../mine.npy", place.join(file)).unwrap();
        });
        answer.complains(2, &[file, "is a link", "move it away"]);
        assert!(killed.desk.path(UNFINISHED).join(file).is_symlink());
    }
}

#[test]
fn a_log_that_is_not_as_it_was_written_is_not_believed_line_by_line() {
    let killed = Killed::after(RECORDED);
    let log = "steps.jsonl";
    for (what, blow) in BLOWS.iter().filter(|(what, _)| !what.contains("near the end") && !what.contains("doubled")) {
        // Logs that are cut or emptied have their whole lines left.
        let answer = killed.resumed(|place| strike(&place.join(log), *blow));
        killed.is_whole(what, &answer);
        assert!(answer.err.contains(log) && answer.err.contains("solved again"), "{what}: {}", answer.err);
    }
    // The last line is that of a step that is read off again.
    for (what, blow) in BLOWS.iter().filter(|(what, _)| what.contains("near the end") || what.contains("doubled")) {
        let answer = killed.resumed(|place| strike(&place.join(log), *blow));
        killed.is_whole(what, &answer);
    }
    let other = Desk::new();
    let other_case = CASE.replace("young = 3.0", "young = 4.0");
    assert!(run(&case(&other_case), &other.path("killed"), true, RECORDED).is_none());
    let foreign = fs::read_to_string(other.path(UNFINISHED).join(log)).unwrap();
    let foreign: Vec<String> = foreign.lines().map(str::to_owned).collect();
    let edited = |from: &'static str, to: &'static str| {
        move |lines: &mut Vec<String>| {
            assert!(lines[1].contains(from), "{from} does not stand in {}", lines[1]);
            lines[1] = lines[1].replacen(from, to, 1);
        }
    };
    let sealed_anew = |key: &'static str, value: Value| {
        move |lines: &mut Vec<String>| lines[1] = resealed(&lines[1], |step| step[key] = value.clone())
    };
    type Change = Box<dyn Fn(&mut Vec<String>)>;
    let changes: Vec<(&str, &str, Change)> = vec![
        ("a line twice", "line 2", Box::new(|lines| lines.insert(1, lines[0].clone()))),
        ("a line less", "line 2", Box::new(|lines| drop(lines.remove(1)))),
        ("lines exchanged", "line 1", Box::new(|lines| lines.swap(0, 1))),
        ("two lines alone", "2 whole lines", Box::new(|lines| lines.truncate(2))),
        ("a line of another case", "line 2", Box::new(move |lines| lines[1] = foreign[1].clone())),
        ("an edited number", "line 2", Box::new(edited("\"penetration\":", "\"penetration\":1"))),
        ("a text for a number", "line 2", Box::new(edited("\"iterations\":", "\"iterations\":\"x\",\"was\":"))),
        ("null for a number", "line 2", Box::new(edited("\"residual\":", "\"residual\":null,\"was\":"))),
        ("not a number", "line 2", Box::new(edited("\"convolutions\":", "\"convolutions\":NaN,\"was\":"))),
        ("an earlier version", "no checksum", Box::new(|lines| lines[0] = without_checksum(&lines[0]).unwrap())),
        ("another step", "step 3", Box::new(sealed_anew("step", 3.into()))),
        ("another run", "another run", Box::new(sealed_anew("run", "1-2".into()))),
        ("no run", "another run", Box::new(sealed_anew("run", Value::Null))),
        ("another load", "another load", Box::new(sealed_anew("load", serde_json::json!({"mean_pressure": 0.04})))),
        ("another grid", "another grid", Box::new(sealed_anew("points", serde_json::json!([12, 16])))),
        ("a sealed null", "`penetration` is null", Box::new(sealed_anew("penetration", Value::Null))),
        ("a sealed pressure below zero", "below zero", Box::new(sealed_anew("mean_pressure", (-0.03).into()))),
        ("no files", "line 2", Box::new(sealed_anew("files", Value::Null))),
    ];
    for (what, words, change) in &changes {
        let answer = killed.is_solved_again(what, log, |place| relined(&place.join(log), |lines| change(lines)));
        assert!(answer.err.contains(words), "{what}: {}", answer.err);
    }
}

#[test]
fn a_checkpoint_is_believed_with_every_entry_or_not_at_all() {
    let killed = Killed::after(RECORDED);
    let file = "checkpoint.npz";
    for (what, blow) in BLOWS.iter().filter(|(what, _)| !["doubled", "missing"].contains(what)) {
        killed.is_solved_again(what, file, |place| strike(&place.join(file), *blow));
    }
    let first = {
        let desk = Desk::new();
        assert!(run(&case(CASE), &desk.path("killed"), true, 2).is_none());
        fs::read(desk.path(UNFINISHED).join(file)).unwrap()
    };
    let foreign = {
        let desk = Desk::new();
        assert!(run(&case(&CASE.replace("young = 3.0", "young = 4.0")), &desk.path("killed"), true, 2).is_none());
        fs::read(desk.path(UNFINISHED).join(file)).unwrap()
    };
    type Change = Box<dyn Fn(Vec<u8>) -> Vec<u8>>;
    let entry = |wanted: &'static str, change: fn(Vec<u8>) -> Option<Vec<u8>>| -> Change {
        Box::new(move |bytes| {
            rezipped(bytes, |name, content| if name == wanted { change(content) } else { Some(content) })
        })
    };
    let place = |from: &'static str, to: &'static str| -> Change { Box::new(move |bytes| replaced(bytes, from, to)) };
    let changes: Vec<(&str, Change)> = vec![
        ("without a pressure", entry("pressure_0.npy", |_| None)),
        ("without its place", entry("place.json", |_| None)),
        ("a pressure that is none", entry("pressure_0.npy", |array| Some(ending_with(array, f64::NAN)))),
        ("a pressure below zero", entry("pressure_0.npy", |array| Some(ending_with(array, -1e-9)))),
        ("an infinite gap", entry("gap_0.npy", |array| Some(ending_with(array, f64::INFINITY)))),
        ("a pressure too few", entry("pressure_0.npy", |array| Some(array[..array.len() - 8].to_vec()))),
        ("a text for an array", entry("gap_0.npy", |_| Some(b"none".to_vec()))),
        ("an array for a text", entry("place.json", |_| Some(vec![0xff; 100]))),
        ("of no step", place("\"steps\":4", "\"steps\":0")),
        ("of a step too far", place("\"steps\":4", "\"steps\":5")),
        ("of many steps", place("\"steps\":4", "\"steps\":18446744073709551615")),
        ("of another grid", place("\"points\":[16,12]", "\"points\":[12,16]")),
        ("of a huge grid", place("\"points\":[16,12]", "\"points\":[9223372036854775807,9223372036854775807]")),
        ("of a refinement", place("\"refined\":false", "\"refined\":true")),
        ("of more grids", place("\"grids\":", "\"grids\":184467440737095516")),
        ("of a route that is none", place("\"route\":\"", "\"route\":\"un")),
    ];
    for (what, change) in &changes {
        killed.is_solved_again(what, file, |place| {
            let path = place.join(file);
            fs::write(&path, change(fs::read(&path).unwrap())).unwrap();
        });
    }
    // A checkpoint of an earlier step will do too; the steps after it are solved again.
    let answer = killed.resumed(|place| fs::write(place.join(file), &first).unwrap());
    killed.is_whole("of the first step", &answer);
    assert!(answer.err.contains("goes on after step 1") && !answer.err.contains("solved again"), "{}", answer.err);
    // The checkpoint of another run is refused, with what helps, and nothing is moved.
    let answer = killed.resumed(|place| fs::write(place.join(file), &foreign).unwrap());
    answer.complains(2, &["is of another run", "same command", "leave --resume out"]);
    assert_eq!(Folder(killed.desk.path("killed")).names(), ["unfinished".to_owned()].into());
    // Without one nothing that was finished can be gone on with; it is kept.
    let answer = killed.resumed(|place| fs::remove_file(place.join(file)).unwrap());
    killed.is_whole("missing", &answer);
    assert!(answer.err.contains("checkpoint.npz is missing") && answer.err.contains("interrupted-1"), "{}", answer.err);
}

/// A bit here and there of the checkpoint, the log and a field: what is read is what was written, or nothing is.
#[test]
fn no_bit_of_a_record_can_be_flipped_and_believed_otherwise() {
    let desk = Desk::new();
    let case = case(CASE);
    assert!(run(&case, &desk.path("killed"), true, RECORDED).is_none());
    let (folder, fingerprint, run) = (desk.path(UNFINISHED), output::fingerprint(&case, "fields"), case.run());
    let read = || output::finished(&folder, &fingerprint, &run).map(|found| format!("{found:?}"));
    let whole = read().unwrap();
    for (file, stride) in [("checkpoint.npz", 61), ("steps.jsonl", 211), ("stress.partial/planes_xx.0001.001.npy", 37)]
    {
        let bytes = fs::read(folder.join(file)).unwrap();
        let mut refused = 0;
        for at in (0..bytes.len()).step_by(stride) {
            let mut other = bytes.clone();
            other[at] ^= 1 << (at % 8);
            fs::write(folder.join(file), other).unwrap();
            match read() {
                Ok(found) => assert!(found == whole, "{file}, byte {at}"),
                Err(CannotGoOn::Damaged { path, .. }) => {
                    assert!(path.starts_with(&folder));
                    refused += 1;
                }
                Err(other) => panic!("{file}, byte {at}: {other}"),
            }
        }
        assert!(refused * stride * 3 > bytes.len(), "{file}: {refused} bits of {} bytes", bytes.len());
        fs::write(folder.join(file), bytes).unwrap();
    }
}

#[test]
fn fields_that_were_gathered_already_are_taken_apart_again_or_solved_again() {
    let killed = Killed::after(RECORDED + 1);
    let place = killed.desk.path("base/unfinished");
    assert!(place.join("contact.npz").is_file() && !place.join("contact.partial").exists());
    let whole = killed.resumed(|_| ());
    killed.is_whole("nothing", &whole);
    assert!(whole.err.contains("note: goes on after step 4") && !whole.err.contains("solved again"), "{}", whole.err);
    for (file, (what, blow)) in
        ["contact.npz", "stress.npz"].iter().flat_map(|file| BLOWS.iter().map(move |blow| (file, blow)))
    {
        let answer = killed.resumed(|place| strike(&place.join(file), *blow));
        killed.is_whole(&format!("{file}: {what}"), &answer);
        // The end of an archive is made anew.
        let name = file.trim_end_matches("npz");
        let is_told = answer.err.contains(name) && answer.err.contains("solved again");
        assert!(is_told || what.contains("bit") || what.contains("doubled"), "{file}: {what}: {}", answer.err);
    }
    for (what, change) in [
        ("an array less", (|_, _| None) as fn(&str, Vec<u8>) -> Option<Vec<u8>>),
        ("a value changed", |_, array| Some(ending_with(array.repeat(1), 0.5))),
    ] {
        let answer = killed.resumed(|place| {
            let path = place.join("contact.npz");
            let wanted = |name: &str, array| if name == "gap.npy" { change(name, array) } else { Some(array) };
            fs::write(&path, rezipped(fs::read(&path).unwrap(), wanted)).unwrap();
        });
        killed.is_whole(what, &answer);
    }
}

#[test]
fn a_finished_result_of_which_a_file_is_missing_is_solved_again_and_a_changed_one_is_its_owners() {
    let desk = Desk::new();
    desk.write("case.toml", CASE);
    let whole = desk.solve("run", &["case.toml", "--no-pictures"]);
    let (expected, resume) = (whole.results(), ["solve", "case.toml", "-o", "run", "--no-pictures", "--resume"]);
    assert!(desk.percoat(&resume).err.contains("is finished"));
    for file in ["stress.npz", "stress.0002.vts", "curve.csv", "contact.npz"] {
        fs::remove_file(whole.0.join(file)).unwrap();
        let answer = desk.percoat(&resume);
        assert!(answer.code == 0 && answer.err.contains(&format!("{file} is missing")), "{}", answer.err);
        assert!(whole.results() == expected, "{file}");
    }
    for file in ["stress.npz", "contact.npz", "summary.json"] {
        let before = whole.bytes(file);
        fs::write(whole.0.join(file), flipped(before.clone(), 2)).unwrap();
        desk.percoat(&resume).complains(2, &[file, "was changed since", "move it away"]);
        fs::write(whole.0.join(file), before).unwrap();
    }
}

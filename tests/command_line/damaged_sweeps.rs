//! `sweep --resume` solves damaged combinations again and the others not; `merge` refuses a part that is not whole.

use crate::damages::{BLOWS, CASE, VALUES, copy, ends, relined, resealed, strike};
use crate::program::{Desk, Folder};
use percoat::output::without_checksum;
use std::fs;
use std::path::Path;

/// Leaves the combinations of a whole sweep as one does that was killed before it was published.
fn killed_sweep(desk: &Desk, whole: &str, killed: &str) {
    let place = desk.path(killed).join("unfinished-sweep");
    copy(&desk.path(whole), &place);
    fs::remove_dir_all(place.join(".percoat")).unwrap();
    fs::remove_file(place.join("sweep.csv")).unwrap();
    fs::write(place.join(".percoat"), "").unwrap();
}

#[test]
fn a_combination_that_is_damaged_is_solved_again_and_the_others_are_not() {
    let desk = Desk::new();
    desk.write("case.toml", CASE.replace("[0.01, 0.03, 0.0, 0.02]", "[0.01, 0.02]"));
    let sweep = |name: &str, more: &[&str]| {
        desk.percoat(&[&["sweep", "case.toml", "-o", name, "--keep-fields"], &VALUES[..], more].concat())
    };
    sweep("whole", &[]).succeeds();
    killed_sweep(&desk, "whole", "base");
    let expected = |name: &str| {
        let folder = Folder(desk.path(name));
        let kept = ["0001", "0002", "0003"].map(|number| Folder(folder.0.join("combinations").join(number)).results());
        (folder.text("sweep.csv"), kept)
    };
    let whole = expected("whole");
    let resumed = |damage: &dyn Fn(&Path)| {
        let _ = fs::remove_dir_all(desk.path("killed"));
        copy(&desk.path("base"), &desk.path("killed"));
        damage(&desk.path("killed/unfinished-sweep"));
        let answer = sweep("killed", &["--resume"]);
        ends("sweep --resume", &answer);
        assert_eq!(answer.code, 0, "{}", answer.err);
        assert!(expected("killed") == whole, "{}", answer.err);
        answer
    };
    let answer = resumed(&|_| ());
    assert!(
        answer.err.contains("3 of 3 combinations are done") && !answer.err.contains("solved again"),
        "{}",
        answer.err
    );
    let again = |what: &str, file: &str, done: usize, damage: &dyn Fn(&Path)| {
        let answer = resumed(damage);
        assert!(answer.err.contains(file) && answer.err.contains("solved again"), "{what}: {}", answer.err);
        assert!(answer.err.contains(&format!("{done} of 3 combinations are done")), "{what}: {}", answer.err);
        let _ = fs::remove_dir_all(desk.path("expected"));
        copy(&desk.path("base/unfinished-sweep"), &desk.path("expected"));
        damage(&desk.path("expected"));
        // All but the mark of the folder, which percoat writes itself.
        let [found, damaged] = ["killed/interrupted-1", "expected"].map(|name| {
            let mut files = Folder(desk.path(name)).all_files();
            files.remove(Path::new(".percoat"));
            files
        });
        assert!(found == damaged, "{what}: all is kept as it was found");
    };
    for (at, file) in ["contact.npz", "stress.npz", "stress.0002.vts", "summary.json", "case.toml"].iter().enumerate() {
        let name = format!("combinations/0002/{file}");
        // Every kind of damage once, some twice.
        for (what, blow) in BLOWS.iter().cycle().skip(2 * at).take(2) {
            again(&format!("{name}: {what}"), &name, 2, &|place| strike(&place.join(&name), *blow));
        }
    }
    again("combinations exchanged", "combinations/0001/", 1, &|place| {
        let [first, second] = ["0001", "0002"].map(|number| place.join("combinations").join(number));
        fs::rename(&first, place.join("between")).unwrap();
        fs::rename(&second, &first).unwrap();
        fs::rename(place.join("between"), &second).unwrap();
    });
    let lines = |what: &str, words: &str, done: usize, change: &dyn Fn(&mut Vec<String>)| {
        again(what, words, done, &|place| relined(&place.join("sweep.jsonl"), change));
    };
    lines("an edited number", "sweep.jsonl, line 2", 2, &|lines| lines[1] = lines[1].replacen("0.0", "0.1", 1));
    lines("null", "sweep.jsonl, line 2", 2, &|lines| {
        lines[1] = lines[1].replacen("\"residual\":", "\"residual\":null,\"was\":", 1);
    });
    lines("text", "sweep.jsonl, line 2", 2, &|lines| {
        lines[1] = lines[1].replacen("\"iterations\":", "\"iterations\":\"x\",\"was\":", 1);
    });
    lines("a line twice", "stands on line", 2, &|lines| lines.push(lines[0].clone()));
    lines("an earlier version", "no checksum", 2, &|lines| lines[0] = without_checksum(&lines[0]).unwrap());
    lines("nothing of a combination", "line 2", 2, &|lines| {
        lines[1] = resealed(&lines[1], |row| row["results"] = serde_json::json!([]));
    });
    // A line that is gone, or was not written before a kill, leaves its combination undone, whatever stands in its folder.
    let answer = resumed(&|place| relined(&place.join("sweep.jsonl"), |lines| drop(lines.remove(1))));
    assert!(answer.err.contains("2 of 3 combinations are done"), "{}", answer.err);
    // Killed while it gave up what percoat keeps for itself in the combination's folder.
    for left in [&[][..], &["lock"]] {
        let answer = resumed(&|place| {
            relined(&place.join("sweep.jsonl"), |lines| drop(lines.remove(1)));
            let kept = place.join("combinations/0002/.percoat");
            fs::create_dir(&kept).unwrap();
            left.iter().for_each(|name| fs::write(kept.join(name), "process 1\n").unwrap());
        });
        assert!(answer.err.contains("2 of 3 combinations are done"), "{}", answer.err);
    }
    // No damaged line makes this sweep of another one.
    let _ = fs::remove_dir_all(desk.path("killed"));
    copy(&desk.path("base"), &desk.path("killed"));
    relined(&desk.path("killed/unfinished-sweep/sweep.jsonl"), |lines| lines[1] = lines[1].replacen("0.0", "0.1", 1));
    sweep("killed", &["--resume", "--set", "substrate.young=2"]).complains(2, &["none of the 2 combinations"]);
    // Lines stand in the order in which combinations end.
    let answer = resumed(&|place| relined(&place.join("sweep.jsonl"), |lines| lines.swap(0, 2)));
    assert!(answer.err.contains("3 of 3 combinations are done"), "{}", answer.err);
}

#[test]
fn parts_that_are_damaged_or_of_another_sweep_are_refused_with_file_line_and_what_to_do() {
    let desk = Desk::new();
    desk.write("case.toml", CASE.replace("[0.01, 0.03, 0.0, 0.02]", "[0.01, 0.02]"));
    let shard = |name: &str, part: &str, more: &[&str]| {
        desk.succeeds(&[&["sweep", "case.toml", "-o", name, "--shard", part], &VALUES[..], more].concat());
    };
    shard("one", "1/2", &[]);
    shard("two", "2/2", &[]);
    shard("foreign", "1/2", &["--set", "substrate.poisson=0.2"]);
    killed_sweep(&desk, "one", "begun");
    let merge = |folders: &[&str]| {
        let _ = fs::remove_dir_all(desk.path("joined"));
        let answer = desk.percoat(&[&["merge", "-o", "joined", "--no-pictures"], folders].concat());
        ends("merge", &answer);
        answer
    };
    merge(&["one", "two"]).succeeds();
    let whole = Folder(desk.path("joined")).text("sweep.csv");
    merge(&["two", "begun"]).succeeds();
    assert_eq!(Folder(desk.path("joined")).text("sweep.csv"), whole);
    let twice = merge(&["one", "begun", "two"]);
    assert!(twice.code == 0 && twice.err.contains("2 combinations stand in several parts"), "{}", twice.err);
    assert_eq!(Folder(desk.path("joined")).text("sweep.csv"), whole);

    let foreign = fs::read_to_string(desk.path("foreign/sweep.jsonl")).unwrap();
    let refused = |what: &str, words: &[&str], damage: &dyn Fn(&Path)| {
        // The part as it was published, as a copy without its list, and as it was killed.
        for (base, place, advice) in [
            ("one", "", "move it away and give the command of this part again"),
            ("copy", "", "move it away and give the command of this part again"),
            ("begun", "unfinished-sweep", "give the command of this part again with --resume"),
        ] {
            let _ = fs::remove_dir_all(desk.path("damaged"));
            copy(&desk.path(if base == "copy" { "one" } else { base }), &desk.path("damaged"));
            if base == "copy" {
                fs::remove_dir_all(desk.path("damaged/.percoat")).unwrap();
            }
            damage(&desk.path("damaged").join(place));
            let answer = merge(&["damaged", "two"]);
            assert_eq!(answer.code, 2, "{what} of {base}: {}", answer.err);
            let told = |word: &&&str| answer.err.contains(**word) || base == "one" && word.contains("line");
            assert!(words.iter().all(|word| told(&word)), "{what} of {base}: {}", answer.err);
            assert!(answer.err.contains(advice), "{what} of {base}: {}", answer.err);
            assert!(!desk.path("joined").exists(), "{what}");
        }
    };
    let lines = |what: &str, words: &[&str], change: &dyn Fn(&mut Vec<String>)| {
        refused(what, words, &|place| relined(&place.join("sweep.jsonl"), change));
    };
    lines("an edited number", &["sweep.jsonl", "line 1"], &|lines| lines[0] = lines[0].replacen("0.0", "0.1", 1));
    lines("null", &["sweep.jsonl", "line 2"], &|lines| {
        lines[1] = lines[1].replacen("\"residual\":", "\"residual\":null,\"was\":", 1);
    });
    lines("a line twice", &["sweep.jsonl", "line 1"], &|lines| lines.insert(1, lines[0].clone()));
    lines("another sweep", &["sweep.jsonl", "line 2"], &|lines| {
        lines[1] = foreign.lines().next().unwrap().to_owned();
    });
    lines("an earlier version", &["sweep.jsonl", "line 1"], &|lines| lines[0] = without_checksum(&lines[0]).unwrap());
    lines("a combination that is none", &["sweep.jsonl", "line 2"], &|lines| {
        lines[1] = resealed(&lines[1], |row| row["combination"] = 7.into());
    });
    for (what, from, to) in [
        ("another title", "\"title\": \"", "\"title\": \"My "),
        ("another number of combinations", "\"of\": 3", "\"of\": 2"),
        ("a text for a number", "\"of\": 3", "\"of\": \"3\""),
        ("a key less", "\"fingerprint\"", "\"was\""),
        ("no JSON", "{", ""),
    ] {
        refused(what, &["sweep.json"], &|place| {
            let path = place.join("sweep.json");
            let text = fs::read_to_string(&path).unwrap();
            // Beside a part that says otherwise it would be refused as one of another sweep.
            assert!(text.contains(from));
            fs::write(&path, text.replacen(from, to, 1)).unwrap();
        });
    }
    // Combinations lost from a finished part are missed; those of a killed one are not done, which is told as before.
    let _ = fs::remove_dir_all(desk.path("damaged"));
    copy(&desk.path("one"), &desk.path("damaged"));
    fs::remove_dir_all(desk.path("damaged/.percoat")).unwrap();
    relined(&desk.path("damaged/sweep.jsonl"), |lines| drop(lines.remove(0)));
    merge(&["damaged", "two"]).complains(2, &["sweep.jsonl has 1 lines", "tells of 2", "command of this part again"]);
    copy(&desk.path("begun"), &desk.path("less"));
    relined(&desk.path("less/unfinished-sweep/sweep.jsonl"), |lines| drop(lines.remove(0)));
    merge(&["less", "two"]).complains(3, &["1 of 3 combinations are missing: 1"]);
    // Results of one combination that differ are not of one sweep, whatever their seals say.
    relined(&desk.path("begun/unfinished-sweep/sweep.jsonl"), |lines| {
        lines[0] = resealed(&lines[0], |row| row["results"][0]["step"]["penetration"] = 0.5.into());
    });
    merge(&["one", "begun", "two"]).complains(2, &["different results of combination 1", "one/sweep.jsonl, line 1"]);
}

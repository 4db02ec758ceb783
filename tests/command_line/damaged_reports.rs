//! `report` shows no number of a result that is not whole, and tells what is missing.

use crate::damages::{BLOWS, CASE, VALUES, copy, ends, relined, resealed, strike};
use crate::program::{Desk, Folder};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Changes a key of the first step of the second line of a sweep's log.
fn step(lines: &mut [String], key: &str, value: Value) {
    lines[1] = resealed(&lines[1], |row| row["results"][0]["step"][key] = value);
}

#[test]
fn a_report_is_made_of_whole_results_alone() {
    let desk = Desk::new();
    desk.write("case.toml", CASE.replace("[0.01, 0.03, 0.0, 0.02]", "[0.01, 0.02]"));
    desk.solve("run", &["case.toml"]);
    let strong = ["--set", "layers.0.yield_strength=0.2", "--set", "substrate.yield_strength=0.05"];
    desk.succeeds(&[&["limit", "case.toml", "-o", "limit", "--no-pictures"], &strong[..]].concat());
    desk.succeeds(&[&["sweep", "case.toml", "-o", "sweep"], &VALUES[..]].concat());
    let report = |base: &str, listed: bool, damage: &dyn Fn(&Path)| {
        let _ = fs::remove_dir_all(desk.path("damaged"));
        copy(&desk.path(base), &desk.path("damaged"));
        if !listed {
            fs::remove_dir_all(desk.path("damaged/.percoat")).unwrap();
        }
        damage(&desk.path("damaged"));
        let answer = desk.percoat(&["report", "damaged"]);
        ends("report", &answer);
        answer
    };
    for (base, listed) in ["run", "limit", "sweep"].iter().flat_map(|base| [true, false].map(|listed| (base, listed))) {
        let answer = report(base, listed, &|_| ());
        assert!(answer.code == 0 && answer.err.is_empty(), "{base}: {}", answer.err);
    }
    let edited = |file: &'static str, pointer: &'static str, value: Value| {
        move |place: &Path| {
            let text = fs::read_to_string(place.join(file)).unwrap();
            let mut whole: Value = serde_json::from_str(&text).unwrap();
            *whole.pointer_mut(pointer).unwrap_or_else(|| panic!("no {pointer} in {file}")) = value.clone();
            fs::write(place.join(file), format!("{whole:#}\n")).unwrap();
        }
    };
    let replaced = |file: &'static str, from: &'static str, to: &'static str| {
        move |place: &Path| {
            let text = fs::read_to_string(place.join(file)).unwrap();
            assert!(text.contains(from), "no {from} in {file}");
            fs::write(place.join(file), text.replacen(from, to, 1)).unwrap();
        }
    };
    // Any change of a result that percoat's list knows.
    for (base, file) in
        [("run", "summary.json"), ("limit", "limit.json"), ("sweep", "sweep.json"), ("sweep", "sweep.jsonl")]
    {
        for (what, blow) in BLOWS.iter().filter(|(what, _)| *what != "missing") {
            let answer = report(base, true, &|place| strike(&place.join(file), *blow));
            assert!([2, 4].contains(&answer.code), "{file}: {what}: {}", answer.err);
            assert!(
                answer.err.contains(file) && !desk.path("damaged/report.html").exists(),
                "{file}: {what}: {}",
                answer.err
            );
        }
    }
    let other = report("run", true, &edited("summary.json", "/steps/0/penetration", 0.125.into()));
    other.complains(2, &["summary.json is not as it was written", "compute it again"]);
    // Values that cannot be, also in a copy without the list.
    for (base, file, pointer, value, words) in [
        ("run", "summary.json", "/steps/0/penetration", Value::Null, "step 1: `penetration` is null"),
        ("run", "summary.json", "/steps/1/mean_pressure", Value::Null, "step 2: `mean_pressure` is null"),
        ("run", "summary.json", "/steps/0/mean_pressure", (-0.01).into(), "below zero"),
        ("run", "summary.json", "/steps/0/max_pressure", Value::Null, "`max_pressure` is null"),
        ("run", "summary.json", "/steps/0/levels/0/load_share", Value::Null, "`load_share of level 1` is null"),
        ("run", "summary.json", "/steps/0/contact_fraction", "x".into(), "invalid type"),
        ("run", "summary.json", "/steps/0/certificate", Value::Null, "invalid type"),
        ("run", "summary.json", "/steps/0/stop_reason", "x".into(), "unknown variant `x`"),
        ("run", "summary.json", "/steps/0/route", "x".into(), "unknown variant `x`"),
        ("run", "summary.json", "/steps/0/stress/materials/0/max_mises/value", Value::Null, "`max_mises` is null"),
        ("run", "summary.json", "/warnings", "none".into(), "`warnings`"),
        ("run", "summary.json", "/case/load", Value::Null, "`case` is no case"),
        ("run", "summary.json", "/case", Value::Null, "`case` is missing"),
        ("run", "summary.json", "/title", Value::Null, "`title`: invalid type"),
        ("limit", "limit.json", "/units", 5.into(), "`units`: invalid type"),
        ("run", "summary.json", "/steps", Value::Null, "`steps`"),
        ("limit", "limit.json", "/limits/0/criterion", "x".into(), "`limits[0]`: unknown variant `x`"),
        ("limit", "limit.json", "/limits/0/reached", "x".into(), "`limits[0].reached`: unknown variant `x`"),
        ("limit", "limit.json", "/limits", Value::Null, "`limits`"),
        ("limit", "limit.json", "/warnings", 3.into(), "`warnings`"),
        ("sweep", "sweep.json", "/failed", "0".into(), "invalid type"),
        ("sweep", "sweep.json", "/warnings", Value::Null, "invalid type"),
    ] {
        let answer = report(base, false, &edited(file, pointer, value));
        assert_eq!(answer.code, 2, "{file}: {pointer}: {}", answer.err);
        assert!(answer.err.contains(file) && answer.err.contains(words), "{pointer}: {}", answer.err);
    }
    let answer = report("sweep", false, &edited("sweep.json", "/combinations", 2.into()));
    answer.complains(2, &["sweep.jsonl has 3 lines", "tells of 2"]);
    for (base, file, words, from, to) in [
        ("run", "summary.json", "not JSON", "\"residual\": ", "\"residual\": NaN, \"was\": "),
        ("sweep", "sweep.jsonl", "changed or damaged", "\"done\"", "\"dun\""),
    ] {
        let answer = report(base, false, &replaced(file, from, to));
        assert_eq!(answer.code, 2, "{file}: {from} → {to}: {}", answer.err);
        assert!(answer.err.contains(file) && answer.err.contains(words), "{from} → {to}: {}", answer.err);
    }
    let answer = report("run", false, &|place| {
        let path = place.join("summary.json");
        let mut summary: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        summary["steps"].as_array_mut().unwrap().remove(0);
        fs::write(&path, summary.to_string()).unwrap();
    });
    answer.complains(2, &["summary.json", "1 steps", "2 loads"]);
    for (what, change) in [
        ("has 2 lines", (|lines| drop(lines.remove(1))) as fn(&mut Vec<String>)),
        ("line 1: combination 1 stands on line 2 too", |lines| lines[1] = lines[0].clone()),
        ("line 2: it is no row", |lines| lines[1] = resealed(&lines[1], |row| row["status"] = "dun".into())),
        ("line 2: it is no row", |lines| lines[1] = resealed(&lines[1], |row| drop(row["results"].take()))),
        ("`mean_pressure` is null", |lines| step(lines, "mean_pressure", Value::Null)),
        ("`mean_pressure` is -1, which is below zero", |lines| step(lines, "mean_pressure", (-1.0).into())),
        ("line 2: it is no row", |lines| step(lines, "max_pressure", "x".into())),
        ("line 2: it is no row", |lines| step(lines, "stop_reason", "x".into())),
    ] {
        let answer = report("sweep", false, &|place| relined(&place.join("sweep.jsonl"), change));
        assert!(answer.code == 2 && answer.err.contains("sweep.jsonl"), "{what}: {}", answer.err);
        assert!(answer.err.contains(what), "{what}: {}", answer.err);
    }
    let answer = report("sweep", true, &|place| strike(&place.join("sweep.csv"), BLOWS[0].1));
    assert!(answer.code == 0 && answer.err.contains("warning: sweep.csv is "), "{}", answer.err);
    // Files that are not shown because they are missing or damaged are told, on the page too.
    for (file, blow) in ["contact.npz", "stress.npz", "pressure.svg", "curve.csv"]
        .iter()
        .flat_map(|file| BLOWS.map(|blow| (file, blow)))
    {
        let answer = report("run", true, &|place| strike(&place.join(file), blow.1));
        assert!(
            answer.code == 0 && answer.err.contains(&format!("warning: {file} is ")),
            "{file}: {}: {}",
            blow.0,
            answer.err
        );
        let page = Folder(desk.path("damaged")).text("report.html");
        assert!(page.contains(&format!("{file} is ")) && page.contains("it is not shown"), "{file}: {}", blow.0);
    }
}

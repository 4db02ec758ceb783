//! Damages to files: every kind, and how a command may end after each.

use crate::program::Answer;
use percoat::output::{with_checksum, without_checksum};
use serde_json::Value;
use std::fs;
use std::io::{Cursor, Read, Write};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

/// Loads up and down on a coating, with fields of every kind.
pub const CASE: &str = r#"
lattice = { kind = "square", period = 1.0 }
levels = [{ shape = "sphere", radius = 0.8 }]
layers = [{ thickness = 0.1, young = 3.0, poisson = 0.25 }]
substrate = { young = 1.0, poisson = 0.3 }
load = { mean_pressure = [0.01, 0.03, 0.0, 0.02] }
grid = { points = [16, 12] }
stress = { planes = [0.0, 0.1], volume = { depth = 0.2, rows = 2, points = 4 } }
"#;

/// Values of a sweep, and two loads of each.
pub const VALUES: [&str; 3] = ["--no-pictures", "--set", "layers.0.thickness=0.1,0.2,0.3"];

/// Something done to a file, by its content.
pub type Blow = fn(Vec<u8>) -> Vec<u8>;

/// Damages to files of any kind by name; `None` takes the file away.
pub const BLOWS: [(&str, Option<Blow>); 7] = [
    ("a bit is flipped in the middle", Some(|bytes| flipped(bytes, 2))),
    ("a bit is flipped near the end", Some(|bytes| flipped(bytes, 1))),
    ("cut in the middle", Some(|bytes| bytes[..bytes.len() / 2].to_vec())),
    ("emptied", Some(|_| Vec::new())),
    ("all zeros", Some(|bytes| vec![0; bytes.len()])),
    ("doubled", Some(|bytes| bytes.repeat(2))),
    ("missing", None),
];

pub fn flipped(mut bytes: Vec<u8>, part: usize) -> Vec<u8> {
    let at = bytes.len() - 1 - (bytes.len() - 1) / 2 * (part - 1);
    let at = at.saturating_sub(20);
    bytes[at] ^= 4;
    bytes
}

pub fn strike(path: &Path, blow: Option<Blow>) {
    match blow {
        Some(blow) => fs::write(path, blow(fs::read(path).unwrap())).unwrap(),
        None => fs::remove_file(path).unwrap(),
    }
}

pub fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let (path, new) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &new);
        } else {
            fs::copy(&path, &new).unwrap();
        }
    }
}

/// The lines of a log, changed.
pub fn relined(path: &Path, change: impl FnOnce(&mut Vec<String>)) {
    let text = fs::read_to_string(path).unwrap();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    change(&mut lines);
    fs::write(path, lines.iter().map(|line| line.clone() + "\n").collect::<String>()).unwrap();
}

/// A line with a seal that fits, whatever its content has become.
pub fn resealed(line: &str, change: impl FnOnce(&mut Value)) -> String {
    let mut value: Value = serde_json::from_str(&without_checksum(line).unwrap()).unwrap();
    change(&mut value);
    with_checksum(&value.to_string())
}

/// An archive with other entries; `None` leaves one out.
pub fn rezipped(bytes: Vec<u8>, change: impl Fn(&str, Vec<u8>) -> Option<Vec<u8>>) -> Vec<u8> {
    let mut zip = ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut new = ZipWriter::new(Cursor::new(Vec::new()));
    for at in 0..zip.len() {
        let mut entry = zip.by_index(at).unwrap();
        let (name, mut content) = (entry.name().unwrap().to_string(), Vec::new());
        entry.read_to_end(&mut content).unwrap();
        if let Some(content) = change(&name, content) {
            new.start_file(name, SimpleFileOptions::default().compression_method(CompressionMethod::Stored)).unwrap();
            new.write_all(&content).unwrap();
        }
    }
    new.finish().unwrap().into_inner()
}

/// An array with its last value changed.
pub fn ending_with(mut array: Vec<u8>, value: f64) -> Vec<u8> {
    let end = array.len() - size_of::<f64>();
    array[end..].copy_from_slice(&value.to_ne_bytes());
    array
}

/// The text of a place in an archive of a checkpoint, changed.
pub fn replaced(bytes: Vec<u8>, from: &str, to: &str) -> Vec<u8> {
    rezipped(bytes, |name, content| {
        let text = String::from_utf8(content.clone());
        Some(if name == "place.json" { text.unwrap().replace(from, to).into_bytes() } else { content })
    })
}

/// The command has ended as commands end, and not by a fault of its own.
pub fn ends(what: &str, answer: &Answer) {
    assert!((0..=4).contains(&answer.code) && !answer.err.contains("panicked"), "{what}: {}", answer.err);
}

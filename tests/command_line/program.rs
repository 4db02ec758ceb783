//! The program in a temporary folder of its own.

use crate::archive::Archive;
use crate::temporary;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A temporary folder in which commands run.
pub struct Desk(TempDir);

/// How a command ended and what it said.
pub struct Answer {
    pub code: i32,
    pub out: String,
    pub err: String,
}

/// An output folder.
pub struct Folder(pub PathBuf);

impl Desk {
    pub fn new() -> Self {
        Self(temporary::folder())
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    /// Names of the files and folders on the desk.
    pub fn names(&self) -> BTreeSet<String> {
        names(self.0.path())
    }

    /// Runs `percoat` with `arguments`.
    pub fn percoat(&self, arguments: &[&str]) -> Answer {
        let output =
            assert_cmd::cargo::cargo_bin_cmd!("percoat").args(arguments).current_dir(self.0.path()).output().unwrap();
        Answer {
            code: output.status.code().unwrap(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Starts `percoat` with `arguments` and waits until its log has so many lines: on its way, and ready to be stopped.
    pub fn begin(&self, arguments: &[&str], log: &str, lines: usize) -> Child {
        // Whoever runs the tests may have signals ignored.
        let mut child = Command::new("env")
            .arg("--default-signal=HUP,INT,TERM")
            .arg(assert_cmd::cargo::cargo_bin!("percoat"))
            .args(arguments)
            .current_dir(self.0.path())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let started = Instant::now();
        while whole_lines(&self.path(log)) < lines {
            assert!(child.try_wait().unwrap().is_none(), "it ended before it could be stopped");
            assert!(started.elapsed() < Duration::from_secs(120));
            sleep(Duration::from_millis(1));
        }
        child
    }

    /// `percoat solve` with `arguments` into the folder `name`; it must converge.
    pub fn solve(&self, name: &str, arguments: &[&str]) -> Folder {
        let answer = self.percoat(&[&["solve", "--output", name], arguments].concat());
        assert_eq!(answer.code, 0, "{arguments:?}: {}", answer.err);
        Folder(self.path(name))
    }
}

impl Answer {
    /// The command was refused or failed with `code`, and says each of `words`.
    pub fn complains(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, code, "{}", self.err);
        for word in words {
            assert!(self.err.contains(word), "\"{word}\" does not stand in\n{}", self.err);
        }
    }
}

impl Folder {
    /// Names of what stands in it, but for what percoat keeps for itself.
    pub fn names(&self) -> BTreeSet<String> {
        names(&self.0).into_iter().filter(|name| name != ".percoat").collect()
    }

    /// Names of all that stands in it.
    pub fn all_names(&self) -> BTreeSet<String> {
        names(&self.0)
    }

    /// The files in it, but not below it, with their content.
    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let files = self.names().into_iter().filter(|name| self.0.join(name).is_file());
        files.map(|name| (name.clone(), self.bytes(&name))).collect()
    }

    /// All files in it and below it, with their content; a link with where it leads.
    pub fn all_files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        fn add(files: &mut BTreeMap<PathBuf, Vec<u8>>, root: &Path, folder: &Path) {
            for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
                let name = path.strip_prefix(root).unwrap().to_owned();
                match fs::read_link(&path) {
                    Ok(to) => drop(files.insert(name, to.to_string_lossy().into_owned().into_bytes())),
                    Err(_) if path.is_dir() => add(files, root, &path),
                    Err(_) => drop(files.insert(name, fs::read(&path).unwrap())),
                }
            }
        }
        let mut files = BTreeMap::new();
        add(&mut files, &self.0, &self.0);
        files
    }

    pub fn text(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap()
    }

    /// A file without the times that no two runs share.
    pub fn result(&self, name: &str) -> Vec<u8> {
        timeless(name, self.bytes(name))
    }

    /// [`Self::files`] without the times that no two runs share.
    pub fn results(&self) -> BTreeMap<String, Vec<u8>> {
        self.files().into_iter().map(|(name, content)| (name.clone(), timeless(&name, content))).collect()
    }

    pub fn summary(&self) -> Value {
        serde_json::from_str(&self.text("summary.json")).unwrap()
    }

    /// The load steps of the summary.
    pub fn steps(&self) -> Vec<Value> {
        self.summary()["steps"].as_array().unwrap().clone()
    }

    pub fn contact(&self) -> Archive {
        Archive::open(&self.0.join("contact.npz"))
    }
}

/// Number of the lines of a file that end; none where it is not.
pub fn whole_lines(path: &Path) -> usize {
    fs::read_to_string(path).unwrap_or_default().matches('\n').count()
}

/// A file of a result without its times: `timing` of the summary, `seconds` of its steps and of the curve's rows.
pub fn timeless(name: &str, content: Vec<u8>) -> Vec<u8> {
    match name {
        "summary.json" => {
            let mut summary: Value = serde_json::from_slice(&content).unwrap();
            summary.as_object_mut().unwrap().remove("timing").unwrap();
            for step in summary["steps"].as_array_mut().unwrap() {
                step.as_object_mut().unwrap().remove("seconds").unwrap();
            }
            summary.to_string().into_bytes()
        }
        "curve.csv" => {
            let text = String::from_utf8(content).unwrap();
            let at = text.lines().next().unwrap().split(',').position(|name| name == "seconds").unwrap();
            let rest = |line: &str| {
                let mut cells: Vec<&str> = line.split(',').collect();
                cells.remove(at);
                cells.join(",") + "\n"
            };
            text.lines().map(rest).collect::<String>().into_bytes()
        }
        _ => content,
    }
}

/// The number at a JSON pointer.
pub fn number(value: &Value, pointer: &str) -> f64 {
    value.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number at {pointer} in {value}"))
}

/// Asserts that `a` and `b` agree to the relative `tolerance`.
pub fn assert_close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} and {b} differ by {:e}", (a - b).abs() / b.abs());
}

fn names(folder: &Path) -> BTreeSet<String> {
    fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

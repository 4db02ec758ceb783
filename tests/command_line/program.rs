//! The program in a temporary folder of its own.

use crate::archive::Archive;
use crate::temporary;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Options of `env` by which signals act as they do in a terminal.
pub const SIGNALS: [&str; 1] = ["--default-signal=HUP,INT,TERM"];
/// Longest wait of a test.
pub const LONG_ENOUGH: Duration = Duration::from_secs(120);

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

    /// `percoat` with `arguments`, not yet started.
    pub fn command(&self, arguments: &[&str]) -> Command {
        self.here(Command::new(assert_cmd::cargo::cargo_bin!("percoat")), arguments)
    }

    fn here(&self, mut command: Command, arguments: &[&str]) -> Command {
        command.args(arguments).current_dir(self.0.path());
        command
    }

    /// Runs `percoat` with `arguments`.
    pub fn percoat(&self, arguments: &[&str]) -> Answer {
        self.command(arguments).output().unwrap().into()
    }

    /// Runs `percoat` with `arguments`; it must end with the exit code 0.
    pub fn succeeds(&self, arguments: &[&str]) -> Answer {
        self.percoat(arguments).succeeds()
    }

    /// Runs `percoat` in a shell that first limits itself by `ulimit`, sizes in KiB.
    pub fn limited(&self, limits: &str, arguments: &[&str]) -> Answer {
        self.limited_by(Command::new("bash"), limits, arguments).output().unwrap().into()
    }

    /// The same, not yet started, by the command of a shell.
    pub fn limited_by(&self, mut shell: Command, limits: &str, arguments: &[&str]) -> Command {
        shell.args(["-c", &format!("{limits}; exec \"$0\" \"$@\"")]).arg(assert_cmd::cargo::cargo_bin!("percoat"));
        self.here(shell, arguments)
    }

    /// Starts `percoat` with `arguments`, by `env` with these options for signals: whoever runs the tests may have some ignored.
    pub fn start(&self, signals: &[&str], arguments: &[&str]) -> Child {
        let mut env = Command::new("env");
        env.args(signals).arg(assert_cmd::cargo::cargo_bin!("percoat"));
        self.here(env, arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    }

    /// Starts `percoat` with `arguments` and waits until its log has so many lines: on its way, and ready to be stopped.
    pub fn begin(&self, arguments: &[&str], log: &str, lines: usize) -> Child {
        self.wait_for(self.start(&SIGNALS, arguments), log, lines)
    }

    /// Waits until the log of what was started has so many lines.
    pub fn wait_for(&self, mut child: Child, log: &str, lines: usize) -> Child {
        let started = Instant::now();
        while whole_lines(&self.path(log)) < lines {
            assert!(child.try_wait().unwrap().is_none(), "it ended before it could be stopped");
            assert!(started.elapsed() < LONG_ENOUGH, "{log} has not {lines} lines after {LONG_ENOUGH:?}");
            sleep(Duration::from_millis(1));
        }
        child
    }

    /// `percoat solve` with `arguments` into the folder `name`; it must converge.
    pub fn solve(&self, name: &str, arguments: &[&str]) -> Folder {
        self.succeeds(&[&["solve", "--output", name], arguments].concat());
        Folder(self.path(name))
    }

    /// The content of a JSON file.
    pub fn json(&self, name: &str) -> Value {
        Folder(self.path("")).json(name)
    }
}

impl From<Output> for Answer {
    fn from(output: Output) -> Self {
        let [out, err] = [output.stdout, output.stderr].map(|said| String::from_utf8(said).unwrap());
        Self { code: output.status.code().unwrap_or_else(|| panic!("{}: {err}", output.status)), out, err }
    }
}

impl From<Child> for Answer {
    fn from(child: Child) -> Self {
        child.wait_with_output().unwrap().into()
    }
}

impl Answer {
    /// The command was refused or failed with `code`, and says each of `words`.
    pub fn complains(&self, code: i32, words: &[&str]) {
        assert_eq!(self.code, code, "{}", self.err);
        assert_says(&self.err, words);
    }

    /// The command ended with the exit code 0.
    pub fn succeeds(self) -> Self {
        assert_eq!(self.code, 0, "{}", self.err);
        self
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

    /// The content of a JSON file.
    pub fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.text(name)).unwrap()
    }

    pub fn summary(&self) -> Value {
        self.json("summary.json")
    }

    /// The load steps of the summary.
    pub fn steps(&self) -> Vec<Value> {
        self.summary()["steps"].as_array().unwrap().clone()
    }

    pub fn contact(&self) -> Archive {
        Archive::open(&self.0.join("contact.npz"))
    }
}

pub fn kill(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Sends a signal, such as `INT`.
pub fn send(signal: &str, child: &Child) {
    assert!(Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap().success());
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

/// Asserts that each of `words` stands in the text.
pub fn assert_says(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "\"{word}\" does not stand in\n{text}");
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

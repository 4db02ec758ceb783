//! Runs the cells of a page in an empty folder and compares what they print.

use crate::cells::{Cell, Page};
use crate::python::Session;
use anyhow::{Context, Result, bail};
use regex::Regex;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// The programs that run the cells of pages.
#[derive(Debug)]
pub struct Tools {
    /// A folder with the program `percoat` under its name.
    programs: TempDir,
    python: Option<PathBuf>,
    time: Regex,
    counts: Regex,
    progress: Regex,
}

/// Exit code of a program in Rust that panics.
const PANIC: i32 = 101;
/// First exit code by which a shell names the signal that has ended a command.
const KILLED: i32 = 128;

/// Difference between the output of a cell and what the page shows.
#[derive(Debug)]
pub struct Difference {
    /// Output and page, in words.
    pub text: String,
    /// Whether the output has taken the place of what the page has; "…" stands for lines that only a person can choose.
    pub is_taken: bool,
}

/// Outputs of the cells of a page that differ from what it shows, and the pictures that they made.
#[derive(Debug)]
pub struct Ran {
    /// Outputs that differ from what the page shows.
    pub differences: Vec<Difference>,
    /// Pictures of the page that its cells have made: their paths in the page.
    pub pictures: Vec<String>,
}

impl Tools {
    /// Tools with the program at a path, and a Python if there is one.
    pub fn new(percoat: &Path, python: Option<&Path>) -> Result<Self> {
        let programs = tempfile::tempdir()?;
        let program = percoat.canonicalize().with_context(|| format!("no program {}", percoat.display()))?;
        std::os::unix::fs::symlink(program, programs.path().join("percoat"))?;
        // A link of a virtual environment is not followed: it is found by its place.
        let python = python.map(std::path::absolute).transpose()?;
        let time = Regex::new(r"\b\d+(\.\d+)?(e-?\d+)?( s\b|[,)])")?;
        let counts = Regex::new(r"(at most |below |^)([\d.e-]+)( iterations| of the elastic| steps of the search)")?;
        // Printed every ten seconds, where a command takes as long.
        let progress = Regex::new(r"(?m)^.*, (\d+ min )?\d+ s(, about .* left)?\n")?;
        Ok(Self { programs, python, time, counts, progress })
    }

    /// Runs a line in the shell in a folder, as a user does; returns its output and exit code. A command that is killed
    /// or panics is an error.
    pub fn shell(&self, line: &str, folder: &Path) -> Result<(String, i32)> {
        let path = format!("{}:{}", self.programs.path().display(), std::env::var("PATH").unwrap_or_default());
        let mut command = Command::new("sh");
        command.args(["-c", &format!("exec 2>&1\n{line}")]).current_dir(folder).stdin(Stdio::null());
        command.env("PATH", path).env("COLUMNS", "80").env_remove("RAYON_NUM_THREADS");
        let output = command.output().with_context(|| line.to_owned())?;
        let printed = String::from_utf8(output.stdout)?;
        match output.status.code() {
            Some(code) if code != PANIC && code < KILLED => {
                Ok((self.progress.replace_all(&printed, "").into_owned(), code))
            }
            _ => bail!("{line}\n{}\n{printed}", output.status),
        }
    }

    /// Output of a command that must not fail.
    pub fn printed(&self, line: &str) -> Result<String> {
        match self.shell(line, Path::new("."))? {
            (printed, 0) => Ok(printed),
            (printed, code) => bail!("{line}: exit code {code}\n{printed}"),
        }
    }

    /// Whether a page can be run: Python is needed where it has any.
    pub fn can_run(&self, page: &Page) -> bool {
        self.python.is_some() || !page.cells.iter().any(|cell| matches!(cell, Cell::Python { .. }))
    }

    /// Runs the cells of a page in their order, all Python as one program. The pictures that they make are copied beside its file `to`.
    /// The output of a cell takes the place of what the page has, where they differ; returns the differences.
    pub fn run(&self, page: &mut Page, to: &Path) -> Result<Ran> {
        let folder = tempfile::tempdir()?;
        let mut differences = Vec::new();
        let mut session = None;
        for cell in &mut page.cells {
            match cell {
                Cell::Text(_) => {}
                Cell::File { name, content, .. } => fs::write(folder.path().join(name), content)?,
                Cell::Console(commands) => {
                    for command in commands {
                        let (found, _) = self.shell(&command.line, folder.path())?;
                        differences.extend(self.take(&command.line, &mut command.prints, found));
                    }
                }
                Cell::Python { code, prints } => {
                    let Some(python) = &self.python else { bail!("there is no Python for\n{code}") };
                    let session = match &mut session {
                        Some(begun) => begun,
                        none => none.insert(Session::begin(python, folder.path())?),
                    };
                    let found = session.run(code)?;
                    // Output need not be shown.
                    if let Some(shown) = prints {
                        differences.extend(self.take(code, shown, found));
                    }
                }
            }
        }
        drop(session);
        let pictures = copy_made(&page.source(), folder.path(), to)?;
        Ok(Ran { differences, pictures })
    }

    /// Takes over what was found where it differs from what is shown.
    pub fn take(&self, what: &str, shown: &mut String, mut found: String) -> Option<Difference> {
        if !found.is_empty() && !found.ends_with('\n') {
            found.push('\n');
        }
        if self.alike(shown, &found) {
            return None;
        }
        let text = format!("{what}\nshows\n{shown}\nbut prints\n{found}");
        let is_taken = !shown.lines().any(|line| line == "…");
        if is_taken {
            *shown = found;
        }
        Some(Difference { text, is_taken })
    }

    /// Whether a shown text is what was found, but for times, numbers of iterations and steps, what differs between processors, and the
    /// lines that "…" leaves out.
    pub fn alike(&self, shown: &str, found: &str) -> bool {
        let plain = |text: &str| -> Vec<String> {
            let without_times =
                |line: &str| match line.contains(" s (") || line.ends_with(" s") || line.contains(" s; ") {
                    true => self.time.replace_all(line, "t$3").into_owned(),
                    false => line.to_owned(),
                };
            text.lines().map(|line| self.counts.replace_all(&without_times(line), "$1n$3").into_owned()).collect()
        };
        matches(&plain(shown), &plain(found))
    }
}

/// Whether lines match a pattern of lines, in which "…" stands for any number of them.
fn matches(pattern: &[String], lines: &[String]) -> bool {
    match pattern {
        [] => lines.is_empty(),
        [first, rest @ ..] if first == "…" => (0..=lines.len()).any(|skipped| matches(rest, &lines[skipped..])),
        [first, rest @ ..] => lines.first().is_some_and(|line| equal(first, line)) && matches(rest, &lines[1..]),
    }
}

/// Whether two lines have the same words, and numbers that differ by no more than processors do.
fn equal(shown: &str, found: &str) -> bool {
    let (a, b): (Vec<&str>, Vec<&str>) = (shown.split_whitespace().collect(), found.split_whitespace().collect());
    // Ends of an interval, "0.2 to 0.4", hold the error as well.
    let word = |i: usize| a.get(i).copied().unwrap_or_default();
    let number = |i: usize| word(i).trim_matches(['(', ')', ',']).parse::<f64>().ok();
    let width = |i: usize| Some((number(i + 1)? - number(i.checked_sub(1)?)?).abs()).filter(|_| word(i) == "to");
    let room = |i: usize| width(i + 1).or(i.checked_sub(1).and_then(width)).map_or(0.0, |width| 0.25 * width);
    let has_error = |i: usize| i > 0 && word(i - 1) == "±";
    let is_near = |i: usize| near(a[i], b[i], has_error(i), room(i));
    a.len() == b.len() && (0..a.len()).all(|i| a[i] == b[i] || is_near(i))
}

/// Whether two words are rules of a table, or numbers that differ by a thousandth, or by the `room` that an interval leaves; errors have one
/// digit, and may differ by half.
fn near(shown: &str, found: &str, is_error: bool, room: f64) -> bool {
    let is_rule = |word: &str| word.chars().all(|letter| letter == '─');
    let parts = |word: &str| -> Option<(String, f64, String)> {
        let number = word.trim_start_matches('(');
        let rest = number.trim_end_matches([')', ',', ';', ':', '.']);
        let around = (&word[..word.len() - number.len()], &number[rest.len()..]);
        Some((around.0.to_owned(), rest.parse().ok()?, around.1.to_owned()))
    };
    match (parts(shown), parts(found)) {
        (Some((before, a, behind)), Some((other, b, end))) => {
            let most = if is_error { 0.5 } else { 1e-3 };
            (before, behind) == (other, end) && (a - b).abs() <= (most * a.abs().max(b.abs())).max(room)
        }
        _ => is_rule(shown) && is_rule(found),
    }
}

/// Copies the pictures of a page that its commands have made beside its file; returns their paths in the page.
fn copy_made(text: &str, folder: &Path, to: &Path) -> Result<Vec<String>> {
    let mut pictures = crate::source::pictures(text);
    pictures.retain(|name| folder.join(name).is_file());
    for name in &pictures {
        crate::source::copy(&folder.join(name), &crate::source::beside(to, name))?;
    }
    Ok(pictures)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<String> {
        text.lines().map(str::to_owned).collect()
    }

    #[test]
    fn dots_stand_for_lines() {
        assert!(matches(&lines("a\n…\nd"), &lines("a\nb\nc\nd")));
        assert!(matches(&lines("a\n…"), &lines("a")));
        assert!(!matches(&lines("a\n…\nd"), &lines("a\nb")));
        assert!(!matches(&lines("a"), &lines("a\nb")));
    }

    #[test]
    fn times_are_not_compared_and_numbers_are() {
        let percoat = std::env::current_exe().unwrap();
        let tools = Tools::new(&percoat, None).unwrap();
        let line = "1.18 s (setup 0.07, solution 0.45, output 0.66); written to out/fig2";
        assert!(tools.alike(line, "12.5 s (setup 0.1, solution 11, output 1e-3); written to out/fig2"));
        assert!(!tools.alike(line, "1.18 s (setup 0.07, solution 0.45, output 0.66); written to out/fig3"));
        assert!(!tools.alike("radius 0.25, 3", "radius 0.26, 3"));
        assert!(!tools.alike("radius 0.25", "length 0.25"));
    }

    #[test]
    fn what_differs_between_processors_is_no_difference() {
        let tools = Tools::new(&std::env::current_exe().unwrap(), None).unwrap();
        assert!(
            tools.alike("4 steps of the search; 2.43 s; written to out", "3 steps of the search; 1 s; written to out")
        );
        assert!(tools.alike(
            "at most 6 iterations each, energy below 4e-8 of the elastic",
            "at most 7 iterations each, energy below 3e-8 of the elastic"
        ));
        assert!(tools.alike("───\n 0.30461 ± 0.00006  (1.5, 2)", "────\n  0.30462 ± 0.00008  (1.5, 2)"));
        assert!(!tools.alike("0.305 ± 0.001", "0.301 ± 0.001"));
        assert!(tools.alike("0.22 to 0.44 %", "0.20 to 0.45 %") && !tools.alike("0.22 to 0.44 %", "0.22 to 0.55 %"));
    }
}

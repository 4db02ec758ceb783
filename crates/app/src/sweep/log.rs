//! `sweep.jsonl`: a line for every combination that is done, appended when it ends.
//!
//! However the sweep ends, every line with an end is whole; the beginning of one more is cut off when the sweep goes on. A line
//! has the identity of its sweep and a [checksum](crate::output::with_checksum): one that is not as it was written is no row.

use super::row::Row;
use crate::output::{LineLog, OutputError, SWEEP_LOG as LOG, disk, whole_lines, with_checksum, without_checksum};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashMap;
use std::fmt;
use std::io;
use std::path::Path;

/// The log of an unfinished sweep.
#[derive(Debug)]
pub struct Log {
    lines: LineLog,
    /// [Identity](super::Description::identity) of the sweep.
    sweep: String,
}

/// A line: the row, and the identity of its sweep.
#[derive(Serialize, Deserialize)]
struct Line<R> {
    sweep: String,
    #[serde(flatten)]
    row: R,
}

/// An undamaged row of a log.
#[derive(Debug, Clone, PartialEq)]
pub struct Logged {
    /// Number of its line, from 1.
    pub line: usize,
    /// The [identity](super::Description::identity) of its sweep.
    pub sweep: String,
    /// The combination.
    pub row: Row,
}

/// A line that is not as a sweep wrote it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Damage {
    /// Number of the line, from 1.
    pub line: usize,
    /// The damage of the line.
    pub reason: String,
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.reason)
    }
}

impl Log {
    /// Begins the log of a sweep of this [identity](super::Description::identity) in a folder, with the `known` rows. The file is
    /// made with the first row.
    ///
    /// # Errors
    /// [`OutputError`] with the path.
    pub fn begin(folder: &Path, sweep: &str, known: &[Row]) -> Result<Self, OutputError> {
        let mut log = Self { lines: LineLog::new(folder.join(LOG), lines(sweep, known)), sweep: sweep.to_owned() };
        if !known.is_empty() {
            log.lines.add("")?;
        }
        Ok(log)
    }

    /// Appends a combination.
    ///
    /// # Errors
    /// [`OutputError`] with the path.
    pub fn add(&mut self, row: &Row) -> Result<(), OutputError> {
        self.lines.add(&line(&self.sweep, row))
    }
}

/// The lines of rows of a sweep.
pub(super) fn lines(sweep: &str, rows: &[Row]) -> String {
    rows.iter().map(|row| line(sweep, row)).collect()
}

/// The line of a row, with its checksum.
fn line(sweep: &str, row: &Row) -> String {
    let line = serde_json::to_string(&Line { sweep: sweep.to_owned(), row });
    with_checksum(&line.expect("a row is numbers and texts under names")) + "\n"
}

/// The whole lines of a log, each a row or its damage; none without a file, as of a sweep that was killed before its first
/// combination. Of a combination that stands on two lines neither is a row.
///
/// # Errors
/// When the file cannot be read.
pub fn read(path: &Path) -> io::Result<Vec<Result<Logged, Damage>>> {
    let whole = if matches!(disk::found(path), Ok(None)) { Vec::new() } else { whole_lines(path)? };
    let mut lines: Vec<Result<Logged, Damage>> = (1..).zip(&whole).map(|(number, line)| logged(number, line)).collect();
    let mut first: HashMap<usize, usize> = HashMap::new();
    for at in 0..lines.len() {
        let Ok(Logged { row, .. }) = &lines[at] else { continue };
        let combination = row.combination;
        if let Some(&before) = first.get(&combination) {
            for (line, other) in [(before, at), (at, before)] {
                let reason = format!("combination {combination} stands on line {} too", other + 1);
                lines[line] = Err(Damage { line: line + 1, reason });
            }
        } else {
            first.insert(combination, at);
        }
    }
    Ok(lines)
}

fn logged(line: usize, text: &str) -> Result<Logged, Damage> {
    let damage = |reason: String| Damage { line, reason };
    let object = without_checksum(text).map_err(|error| damage(error.to_string()))?;
    let Line { sweep, row }: Line<Row> = serde_json::from_str(&object).map_err(|error| {
        damage(if is_of_earlier_version(&object) {
            "an earlier version of percoat wrote it, whose rows this one does not read".to_owned()
        } else {
            format!("it is no row of a sweep: {error}")
        })
    })?;
    row.checked().map_err(damage)?;
    Ok(Logged { line, sweep, row })
}

/// Whether a line has results without their kind, as versions before [`SweepResult`](super::SweepResult) wrote them.
fn is_of_earlier_version(line: &str) -> bool {
    let line: Value = serde_json::from_str(line).unwrap_or_default();
    line["results"][0]
        .as_object()
        .is_some_and(|result| ["step", "limits"].iter().all(|kind| !result.contains_key(*kind)))
}

#[cfg(test)]
mod tests {
    use super::super::examples::{self, step};
    use super::super::result::SweepResult;
    use super::super::row::Status;
    use super::*;
    use std::io::Write;

    fn row(combination: usize) -> Row {
        let results = vec![SweepResult::Step(Box::new(step(0.1 + 0.2, None, 0.5)))];
        let row = examples::row(combination, &[("a.b", "0.1".to_owned())], results);
        Row { warnings: vec!["thin".to_owned()], seconds: 1.5, ..row }
    }

    #[test]
    fn a_log_is_read_back_bit_for_bit_but_for_what_a_kill_left_of_a_line() {
        let folder = tempfile::tempdir().unwrap();
        let rows =
            |path: &Path| -> Vec<Row> { read(path).unwrap().into_iter().map(|line| line.unwrap().row).collect() };
        let mut log = Log::begin(folder.path(), "1-2", &[row(1)]).unwrap();
        log.add(&row(2)).unwrap();
        // Killed within a letter.
        let path = folder.path().join(LOG);
        let mut file = std::fs::File::options().append(true).open(&path).unwrap();
        file.write_all(&"{\"combination\": 3, \"µ".as_bytes()[..21]).unwrap();
        assert_eq!(rows(&path), [row(1), row(2)]);
        // Resuming cuts it off.
        let mut log = Log::begin(folder.path(), "1-2", &rows(&path)).unwrap();
        log.add(&row(3)).unwrap();
        assert_eq!(rows(&path), [row(1), row(2), row(3)]);
        assert!(read(&path).unwrap().iter().all(|line| line.as_ref().unwrap().sweep == "1-2"));
    }

    #[test]
    fn a_line_that_is_not_as_it_was_written_or_stands_there_twice_is_no_row_and_the_others_are() {
        let folder = tempfile::tempdir().unwrap();
        drop(Log::begin(folder.path(), "1-2", &[row(1), row(2), row(3)]).unwrap());
        let path = folder.path().join(LOG);
        let whole = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = whole.split_inclusive('\n').collect();
        let unsigned = lines[1].rsplit_once(",\"seal\"").unwrap().0.to_owned() + "}\n";
        let failed = Row { status: Status::Failed, ..row(2) };
        for (second, damaged, words) in [
            (lines[1].replace("0.30000000000000004", "0.30000000000000005"), &[2][..], "changed or damaged"),
            (lines[1].replace("0.30000000000000004", "null"), &[2], "changed or damaged"),
            (unsigned, &[2], "no checksum"),
            (with_checksum("{\"steps\":3}") + "\n", &[2], "no row of a sweep"),
            (with_checksum("{\"results\":[{\"penetration\":1}]}") + "\n", &[2], "an earlier version of percoat"),
            (lines[0].to_owned(), &[1, 2], "combination 1 stands on line"),
            (line("1-2", &failed), &[2], "has results"),
        ] {
            std::fs::write(&path, [lines[0], &second, lines[2]].concat()).unwrap();
            let found = read(&path).unwrap();
            for (number, line) in (1..).zip(&found) {
                match line {
                    Ok(logged) => assert!(!damaged.contains(&number) && logged.line == number, "{second}"),
                    Err(damage) => {
                        assert!(damaged.contains(&number) && damage.line == number, "{second}");
                        assert!(damage.to_string().contains(words), "{damage}");
                    }
                }
            }
        }
        // Bytes that are not UTF-8 are not a row.
        let mut bytes = whole.clone().into_bytes();
        bytes[lines[0].len() + 20] = 0xff;
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(read(&path).unwrap().iter().map(Result::is_ok).collect::<Vec<_>>(), [true, false, true]);
    }
}

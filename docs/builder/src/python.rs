//! Python that goes on from cell to cell of a page.

use anyhow::{Result, bail};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Ends what a cell prints.
const MARK: u8 = 1;

/// Runs each line of its input, the bytes of a cell as hexadecimal digits.
const DRIVER: &str = "\
import sys
names = {'__name__': '__main__'}
for line in sys.stdin:
    exec(bytes.fromhex(line).decode(), names)
    print('\\x01', end='', flush=True)
";

/// A Python program that runs.
#[derive(Debug)]
pub struct Session {
    child: Child,
    cells: ChildStdin,
    prints: BufReader<ChildStdout>,
    errors: File,
}

impl Session {
    /// Begins a program in a folder.
    pub fn begin(python: &Path, folder: &Path) -> Result<Self> {
        let errors = tempfile::tempfile()?;
        let mut command = Command::new(python);
        command.args(["-c", DRIVER]).current_dir(folder).env("MPLBACKEND", "Agg").env("COLUMNS", "80");
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(errors.try_clone()?);
        let mut child = command.spawn()?;
        let (Some(cells), Some(prints)) = (child.stdin.take(), child.stdout.take()) else { bail!("no pipes") };
        Ok(Self { child, cells, prints: BufReader::new(prints), errors })
    }

    /// Runs a cell; returns its output.
    pub fn run(&mut self, code: &str) -> Result<String> {
        let digits: String = code.bytes().map(|byte| format!("{byte:02x}")).collect();
        writeln!(self.cells, "{digits}")?;
        let mut printed = Vec::new();
        self.prints.read_until(MARK, &mut printed)?;
        if printed.pop() == Some(MARK) {
            return Ok(String::from_utf8(printed)?);
        }
        self.child.wait()?;
        let mut errors = String::new();
        self.errors.rewind()?;
        self.errors.read_to_string(&mut errors)?;
        bail!("{code}{errors}")
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // A failure stands in the answer to its cell.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_share_their_names_and_a_failure_has_its_reason() {
        let mut session = Session::begin(Path::new("python3"), Path::new(".")).unwrap();
        assert_eq!(session.run("x = 'é'\n").unwrap(), "");
        assert_eq!(session.run("print(x)\nprint(2)\n").unwrap(), "é\n2\n");
        let error = session.run("print(3)\nnone / 1\n").unwrap_err().to_string();
        assert!(error.contains("NameError"), "{error}");
    }
}

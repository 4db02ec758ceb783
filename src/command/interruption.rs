//! Ctrl-C and SIGTERM: the command ends at once and says what it has saved.

use percoat::output::RunFolder;
use std::fmt;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::exit;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What a shell calls the end of a program by Ctrl-C.
const INTERRUPTED: i32 = 130;

static SAVED: Mutex<Saved> = Mutex::new(Saved::Nothing);

/// What stands on disk.
#[derive(Debug)]
pub enum Saved {
    /// Nothing that a run would have written.
    Nothing,
    /// Load steps of an unfinished run.
    Steps { done: usize, of: usize, folder: PathBuf },
    /// All of it.
    Result(PathBuf),
}

impl fmt::Display for Saved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Steps { done, of, folder } => {
                let coarser = RunFolder::coarser(folder);
                match done {
                    0 if coarser.is_none() => write!(f, "none of {of} steps is finished, nothing is saved")?,
                    _ => write!(f, "{done} of {of} steps saved in {}", folder.display())?,
                }
                coarser.map_or(Ok(()), |path| write!(f, ", all of them on a coarser grid in {}", path.display()))
            }
            Self::Nothing => f.write_str("nothing is saved"),
            Self::Result(folder) => write!(f, "the whole result is saved in {}", folder.display()),
        }
    }
}

/// From now on a signal to end is answered with what is saved. Where signals are ignored, as under nohup, they stay so
/// and nothing is answered.
pub fn watch() {
    let answer = || {
        let saved = hold();
        if std::io::stderr().is_terminal() {
            eprint!("\r\x1b[K");
        }
        eprintln!("interrupted: {saved}");
        exit(INTERRUPTED);
    };
    // A command that cannot watch ends as any other program does.
    let _ = ctrlc::try_set_handler(answer);
}

/// What is saved; a signal waits as long as it is held.
pub fn hold() -> MutexGuard<'static, Saved> {
    SAVED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// So many load steps are on disk.
pub fn steps(done: usize, of: usize, folder: &Path) {
    *hold() = Saved::Steps { done, of, folder: folder.to_owned() };
}

/// Says what is saved of a run that fails.
pub fn tell_saved() {
    let saved = hold();
    if matches!(*saved, Saved::Steps { done: 1.., .. }) {
        eprintln!("{saved}");
    }
}

//! Ctrl-C, SIGTERM, a hang-up and the end of the time allowed (`ulimit -t`): the command ends at once and prints what it has saved.

use super::terminal::{self, tell};
use percoat_app::output::{self, OutputError, RunFolder};
use percoat_common::plain;
use std::fmt;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::exit;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Exit code of a program that Ctrl-C ends, as shells have it.
const INTERRUPTED: i32 = 130;

static SAVED: Mutex<Saved> = Mutex::new(Saved::Nothing);

/// The part of the result that is on the disk.
#[derive(Debug)]
pub enum Saved {
    /// Nothing.
    Nothing,
    /// Load steps of an unfinished run.
    Steps { done: usize, of: usize, folder: PathBuf },
    /// Combinations of an unfinished sweep.
    Combinations { done: usize, of: usize, folder: PathBuf },
    /// A life after some passes.
    Passes { passes: f64, folder: PathBuf },
    /// The whole result.
    Result(PathBuf),
}

impl Saved {
    /// Whether anything is on the disk.
    fn anything(&self) -> bool {
        match self {
            Self::Nothing => false,
            Self::Steps { folder, .. } => output::has_begun(folder),
            Self::Combinations { done, .. } => *done > 0,
            Self::Passes { .. } | Self::Result(_) => true,
        }
    }
}

impl fmt::Display for Saved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (done, of, folder, units, ended) = match self {
            Self::Nothing => return f.write_str("nothing is saved"),
            Self::Result(folder) => return write!(f, "the whole result is saved in {}", plain::path(folder)),
            Self::Passes { passes, folder } => {
                let (passes, folder) = (output::number(*passes), plain::path(folder));
                return write!(
                    f,
                    "{passes} passes saved in {folder}; the same command with --resume goes on from there"
                );
            }
            Self::Steps { done, of, folder } => (done, of, folder, "steps", "finished"),
            Self::Combinations { done, of, folder } => (done, of, folder, "combinations", "done"),
        };
        if !self.anything() {
            return write!(f, "none of {of} {units} is {ended}, nothing is saved");
        }
        write!(f, "{done} of {of} {units} saved in {}", plain::path(folder))?;
        if let Some(path) = output::coarser(folder) {
            write!(f, ", all of them on a coarser grid in {}", plain::path(&path))?;
        }
        f.write_str("; the same command with --resume goes on from there")
    }
}

/// Installs the handler of signals to end: it prints which files are saved, and ends the process. A signal that is ignored,
/// as under nohup or behind `&` in a script, stays so, see [`watched`].
pub fn watch() {
    // Without this the signal ends the process at once, as it does any other program.
    #[cfg(unix)]
    if let Ok(mut signals) = signal_hook::iterator::Signals::new(watched()) {
        let handle = signals.handle();
        let waiting = std::thread::Builder::new().spawn(move || signals.forever().for_each(|_| answer()));
        if waiting.is_err() {
            handle.close();
        }
    }
    #[cfg(not(unix))]
    let _ = ctrlc::set_handler(answer);
}

/// Makes a file beyond the largest size allowed (`ulimit -f`) an error of writing; otherwise the system ends the
/// process, and no message is printed.
pub fn outlive_large_files() {
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

/// Numbers of the signals to end that are not ignored. Where the system does not list those, a hang-up alone counts as ignored.
#[cfg(unix)]
fn watched() -> Vec<i32> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXCPU};
    let status = std::fs::read_to_string("/proc/self/status").ok();
    let ignored = status.as_deref().and_then(|status| {
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
        u64::from_str_radix(mask.trim(), 16).ok()
    });
    let ignored = ignored.unwrap_or(1 << (SIGHUP - 1));
    [SIGHUP, SIGINT, SIGTERM, SIGXCPU].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0).collect()
}

fn answer() {
    let saved = hold();
    if std::io::stderr().is_terminal() {
        terminal::clear_line();
    }
    tell!("interrupted: {saved}");
    exit(INTERRUPTED);
}

/// Locks the record of the saved files; the handler of signals waits until the guard is dropped.
pub fn hold() -> MutexGuard<'static, Saved> {
    SAVED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Publishes a result in its `folder`, in the place of the one before; the handler of signals waits until this is done.
pub fn publish(claim: RunFolder, folder: &Path, quiet: bool) -> Result<(), OutputError> {
    let mut saved = hold();
    let aside = claim.publish()?;
    *saved = Saved::Result(folder.to_owned());
    drop(saved);
    terminal::tell_aside(aside.as_deref(), quiet);
    Ok(())
}

/// Prints which part of a failed run is saved, if any.
pub fn tell_saved() {
    let saved = hold();
    if saved.anything() {
        tell!("{saved}");
    }
}

//! The threads of a command.

use super::ending::Failure;
use super::terminal::tell;
use percoat_common::machine::{RESERVED, Threads, addresses_left, bytes};
use std::error::Error;
use std::thread;

/// Stack of a thread, bytes; the stack of the process may be small (`ulimit -s`), and reading the command line alone takes 100 kB.
const STACK: usize = 8 << 20;
/// Address space that remains beside those of the threads, bytes.
const BESIDE: u64 = 4 << 20;

/// Runs a command on a stack that is large enough, whatever the stack of the process; returns the exit code.
pub fn on_own_stack(command: impl FnOnce() -> u8 + Send + 'static) -> u8 {
    let spawned = has_room(1, STACK as u64).and_then(|()| {
        let spawned = thread::Builder::new().stack_size(STACK).spawn(command);
        spawned.map_err(|error| Failure::Threads { count: 1, error: error.to_string() })
    });
    match spawned {
        // A panic has printed its message.
        Ok(running) => running.join().unwrap_or(101),
        Err(failure) => {
            failure.tell();
            failure.code()
        }
    }
}

/// Refuses threads that reserve more of the address space, `each` so many bytes, than is left: once it is taken nothing can be printed.
fn has_room(count: usize, each: u64) -> Result<(), Failure> {
    match addresses_left() {
        Some(left) if left < count as u64 * each + BESIDE => {
            Err(Failure::Threads { count, error: format!("{} of addresses are left", bytes(left)) })
        }
        _ => Ok(()),
    }
}

/// Starts as many threads as `--threads` or the environment prescribe, else one for each core; a note says if their number is
/// lowered.
pub fn start(prescribed: Option<u16>, quiet: bool) -> Result<(), Failure> {
    let threads = Threads::new("--threads", prescribed.map(usize::from)).map_err(Failure::Refused)?;
    if let (Some(lowered), false) = (&threads.lowered, quiet) {
        tell!("note: {lowered}");
    }
    threads.are_used();
    let count = threads.count;
    has_room(count, RESERVED)?;
    match rayon::ThreadPoolBuilder::new().num_threads(count).stack_size(STACK).build_global() {
        // Errors of the system alone have a source; any other error means that the threads run already.
        Err(error) if error.source().is_some() => Err(Failure::Threads { count, error: error.to_string() }),
        _ => Ok(()),
    }
}

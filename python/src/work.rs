//! Work on threads that never touch the interpreter, with progress and Ctrl-C.
//!
//! The thread of the caller waits without the lock of the interpreter, calls the callable `progress`, and checks for Ctrl-C, on
//! which it raises at once. The work then stops: a solution between two iterations, stresses between two rows, points or planes, a
//! search for parameters between two trials; other work ends when it is done.

use crate::errors::refused;
use crate::progress::Progress;
use crate::row::Row;
use percoat::machine::{Capacity, Threads, available_memory};
use percoat::output::OutputError;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::VecDeque;
use std::error::Error;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Longest time between two checks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);
/// Shortest time between two reports of one phase.
const PAUSE: Duration = Duration::from_millis(50);

/// A message from the work to the thread of the caller.
enum Event<T> {
    Told(Message),
    Done(thread::Result<T>),
}

/// Message for the callable of the caller.
enum Message {
    /// A report, and whether it is passed on even where a later one is there.
    Progress(Progress, bool),
    /// A combination that is done.
    Row(Row),
}

/// Events in the order in which they came.
type Events<T> = VecDeque<Event<T>>;

/// The caller as seen from the work: receives reports and may stop it.
pub struct Listener {
    stop: Arc<AtomicBool>,
    tell: Option<Box<dyn Fn(Message) + Send>>,
    began: Instant,
    told: Option<Instant>,
}

/// The work was stopped before its end.
#[derive(Debug, thiserror::Error)]
#[error("stopped before its end")]
pub struct Stopped;

/// A sweep of the package keeps no fields, so that none of its files fails.
impl From<OutputError> for Stopped {
    fn from(_: OutputError) -> Self {
        Self
    }
}

impl Listener {
    /// Whether the work is to stop.
    pub fn stops(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// [`Stopped`] where the work is to stop.
    pub fn check(&self) -> Result<(), Stopped> {
        if self.stops() { Err(Stopped) } else { Ok(()) }
    }

    /// The flag that becomes true when the work is to stop.
    pub fn stop(&self) -> &Arc<AtomicBool> {
        &self.stop
    }

    /// A function that says whether the work goes on, for use beside [`Self::tell`].
    pub fn goes_on(&self) -> impl Fn() -> bool + use<> {
        let stop = Arc::clone(&self.stop);
        move || !stop.load(Ordering::Relaxed)
    }

    /// Reports progress with the time so far: a `new` phase always, the present one at most once a [`PAUSE`].
    pub fn tell(&mut self, new: bool, progress: impl FnOnce() -> Progress) {
        let Some(tell) = &self.tell else { return };
        if new || self.told.is_none_or(|told| told.elapsed() > PAUSE) {
            self.told = Some(Instant::now());
            let seconds = self.began.elapsed().as_secs_f64();
            tell(Message::Progress(Progress { seconds, ..progress() }, new));
        }
    }

    /// Passes on a combination that is done.
    pub fn row(&self, row: Row) {
        self.tell.iter().for_each(|tell| tell(Message::Row(row.clone())));
    }
}

/// Memory of this machine for work that writes nothing.
pub fn room() -> Capacity {
    Capacity { disk: u64::MAX, memory: available_memory() }
}

/// Why work has no result.
pub type Reason = Box<dyn Error + Send + Sync>;

/// The result of the work as of [`run`]; the reason why it has none becomes a `CaseError`.
pub fn try_run<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<i64>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut Listener) -> Result<T, Reason> + Send + 'static,
) -> PyResult<T> {
    run(py, threads, progress, work)?.map_err(refused)
}

/// The result of the work on this number of threads, without one on all cores; `progress` receives reports, and rows of a sweep.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    threads: Option<i64>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&mut Listener) -> T + Send + 'static,
) -> PyResult<T> {
    let most = Threads::most();
    if let Some(threads) = threads.filter(|threads| !(1..=most as i64).contains(threads)) {
        return Err(refused(format!("threads must be between 1 and {most}, four for each core, not {threads}")));
    }
    let pool = pool(threads)?;
    let stop = Arc::new(AtomicBool::new(false));
    let (send, mut receive) = mpsc::channel();
    let tell = progress.is_some_and(|progress| !progress.is_none()).then(|| {
        let send: Sender<Event<T>> = send.clone();
        // After Ctrl-C the receiver is gone.
        Box::new(move |message| drop(send.send(Event::Told(message)))) as Box<dyn Fn(Message) + Send>
    });
    let mut listener = Listener { stop: Arc::clone(&stop), tell, began: Instant::now(), told: None };
    let spawned = thread::Builder::new().name("percoat".to_owned()).spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(&mut listener))));
        drop(listener);
        drop(send.send(Event::Done(done)));
    });
    spawned.map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;
    let mut events = Events::new();
    let ended = loop {
        if events.is_empty() {
            // A receiver belongs to one thread at a time.
            let waiting = receive;
            let (come, back) = py.detach(move || wait(waiting));
            receive = back;
            match come {
                Ok(come) => events = come,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err("a thread of percoat has ended"));
                }
            }
        }
        let heard = py.check_signals().and_then(|()| match (next(&mut events), progress) {
            (Some(Event::Told(Message::Progress(progress, _))), Some(callable)) => {
                callable.call1((progress,)).map(|_| None)
            }
            (Some(Event::Told(Message::Row(row))), Some(callable)) => callable.call1((row,)).map(|_| None),
            (Some(Event::Done(done)), _) => Ok(Some(done)),
            _ => Ok(None),
        });
        match heard {
            Ok(None) => {}
            Ok(Some(done)) => break done,
            Err(error) => {
                stop.store(true, Ordering::Relaxed);
                return Err(error);
            }
        }
    };
    ended.map_err(|panic| {
        let told = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
        PyRuntimeError::new_err(format!(
            "percoat itself failed, which is a fault of the program: {}",
            told.unwrap_or("?")
        ))
    })
}

/// The events that have come: at least one, or the error of none within [`PATIENCE`].
fn wait<T>(receive: Receiver<Event<T>>) -> (Result<Events<T>, RecvTimeoutError>, Receiver<Event<T>>) {
    let first = receive.recv_timeout(PATIENCE);
    (first.map(|first| std::iter::once(first).chain(receive.try_iter()).collect()), receive)
}

/// The next event, past reports that a later one replaces: a slow callable receives the latest.
fn next<T>(events: &mut Events<T>) -> Option<Event<T>> {
    let replaceable = |event: Option<&Event<T>>| matches!(event, Some(Event::Told(Message::Progress(_, false))));
    let stale = |events: &Events<T>| replaceable(events.front()) && replaceable(events.get(1));
    while stale(events) {
        events.pop_front();
    }
    events.pop_front()
}

/// Threads of a process; after a fork the child has none of its parent's.
struct Pool {
    process: u32,
    threads: Option<i64>,
    pool: Arc<ThreadPool>,
}

static POOLS: Mutex<Vec<Pool>> = Mutex::new(Vec::new());

/// A pool of this number of threads, without one as many as the environment says, at most four a core; the pool without a number and
/// the last one with a number are kept. While one with a number is at work, another caller gets threads of its own.
fn pool(threads: Option<i64>) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    let is_free = |pool: &Pool| threads.is_none() || Arc::strong_count(&pool.pool) == 1;
    if let Some(pool) = pools.iter().find(|pool| pool.process == process && pool.threads == threads && is_free(pool)) {
        return Ok(Arc::clone(&pool.pool));
    }
    let count = Threads::new("threads", threads.map(|threads| threads as usize)).map_err(refused)?.count;
    let pool = ThreadPoolBuilder::new().num_threads(count).build();
    let told = |error| {
        PyRuntimeError::new_err(format!(
            "cannot start {count} threads: {error}; allow this process more, or give threads=1"
        ))
    };
    let pool = Arc::new(pool.map_err(told)?);
    let (here, gone): (Vec<Pool>, Vec<Pool>) = pools.drain(..).partition(|pool| pool.process == process);
    // Dropping a pool waits for its threads, which the parent has.
    gone.into_iter().for_each(std::mem::forget);
    pools.extend(here.into_iter().filter(|pool| pool.threads.is_none() || threads.is_none()));
    pools.push(Pool { process, threads, pool: Arc::clone(&pool) });
    Ok(pool)
}

//! Work that takes time: the interpreter is free meanwhile, hears of it, and can end it.
//!
//! The work is done by threads of their own, which never touch the interpreter. The thread that asked for it waits, calls the
//! callable that wants to hear, and looks for Ctrl-C. When that comes it raises at once; solutions then end between two
//! iterations, stresses between two rows, points or planes, and what is neither when it is done.

use crate::errors::refused;
use crate::progress::Progress;
use percoat::machine::Threads;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Between two looks for Ctrl-C.
const PATIENCE: Duration = Duration::from_millis(50);
/// Between two calls of the callable while the same thing goes on.
const PAUSE: Duration = Duration::from_millis(50);

/// What goes from the work to the thread that waits for it.
enum Event<T> {
    /// With whether it must be heard even when more has come since.
    Progress(Progress, bool),
    Done(thread::Result<T>),
}

/// Events in the order in which they came.
type Events<T> = VecDeque<Event<T>>;

/// What hears of the work from within.
pub struct Listener {
    stop: Arc<AtomicBool>,
    tell: Option<Box<dyn Fn(Progress, bool) + Send>>,
    began: Instant,
    told: Option<Instant>,
}

impl Listener {
    /// Whether nobody waits for the work any more.
    pub fn stops(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The same, to be handed on.
    pub fn stop(&self) -> &Arc<AtomicBool> {
        &self.stop
    }

    /// Tells how far it is: always of what is `new`, of the same as before not too often.
    pub fn tell(&mut self, new: bool, progress: impl FnOnce(f64) -> Progress) {
        let Some(tell) = &self.tell else { return };
        if new || self.told.is_none_or(|told| told.elapsed() > PAUSE) {
            self.told = Some(Instant::now());
            tell(progress(self.began.elapsed().as_secs_f64()), new);
        }
    }
}

/// Does the work on so many threads, all cores if it is not said.
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
        // Whoever waits may have gone.
        Box::new(move |progress, new| drop(send.send(Event::Progress(progress, new))))
            as Box<dyn Fn(Progress, bool) + Send>
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
        let heard = py.check_signals().and_then(|()| match next(&mut events) {
            Some(Event::Progress(own, _)) => progress.map_or(Ok(None), |callable| callable.call1((own,)).map(|_| None)),
            Some(Event::Done(done)) => Ok(Some(done)),
            None => Ok(None),
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

/// What has come, at least one event unless none comes for a while.
fn wait<T>(receive: Receiver<Event<T>>) -> (Result<Events<T>, RecvTimeoutError>, Receiver<Event<T>>) {
    let first = receive.recv_timeout(PATIENCE);
    (first.map(|first| std::iter::once(first).chain(receive.try_iter()).collect()), receive)
}

/// The next of them. Whoever hears slowly is spared what is out of date.
fn next<T>(events: &mut Events<T>) -> Option<Event<T>> {
    let stale = |events: &Events<T>| {
        matches!(events.front(), Some(Event::Progress(_, false)))
            && matches!(events.get(1), Some(Event::Progress(_, false)))
    };
    while stale(events) {
        events.pop_front();
    }
    events.pop_front()
}

/// The threads of a process: those of a parent are not there after a fork.
struct Pool {
    process: u32,
    threads: Option<i64>,
    pool: Arc<ThreadPool>,
}

static POOLS: Mutex<Vec<Pool>> = Mutex::new(Vec::new());

/// As many threads as asked for, else as the environment says, at most four a core; the last ones asked for, and as many as there are
/// cores, are kept.
fn pool(threads: Option<i64>) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some(own) = pools.iter().find(|own| own.process == process && own.threads == threads) {
        return Ok(Arc::clone(&own.pool));
    }
    let count = Threads::new("threads", threads.map(|threads| threads as usize)).map_err(refused)?.count;
    let pool = ThreadPoolBuilder::new().num_threads(count).build();
    let told = |error| {
        PyRuntimeError::new_err(format!(
            "cannot start {count} threads: {error}; allow this process more, or give threads=1"
        ))
    };
    let pool = Arc::new(pool.map_err(told)?);
    let (here, gone): (Vec<Pool>, Vec<Pool>) = pools.drain(..).partition(|own| own.process == process);
    // Nobody is there who could be told to end.
    gone.into_iter().for_each(std::mem::forget);
    pools.extend(here.into_iter().filter(|own| own.threads.is_none() || threads.is_none()));
    pools.push(Pool { process, threads, pool: Arc::clone(&pool) });
    Ok(pool)
}

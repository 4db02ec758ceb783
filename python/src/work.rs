//! Work that takes time: the interpreter is free meanwhile, hears of it, and can end it.
//!
//! The work is done by threads of their own, which never touch the interpreter. The thread that asked for it waits, calls the
//! callable that wants to hear, and looks for Ctrl-C. When that comes it raises at once, and the work ends between two of
//! its iterations.

use crate::errors::refused;
use crate::progress::Progress;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
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

/// More threads than any machine has cores do harm.
const MOST: i64 = 1024;

/// What goes from the work to the thread that waits for it.
enum Event<T> {
    Progress(Progress),
    Done(thread::Result<T>),
}

/// What hears of the work from within.
pub struct Listener {
    stop: Arc<AtomicBool>,
    tell: Option<Box<dyn Fn(Progress) + Send>>,
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
            tell(progress(self.began.elapsed().as_secs_f64()));
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
    if let Some(threads) = threads.filter(|threads| !(1..=MOST).contains(threads)) {
        return Err(refused(format!("threads must be between 1 and {MOST}, not {threads}")));
    }
    let pool = pool(threads)?;
    let stop = Arc::new(AtomicBool::new(false));
    let (send, mut receive) = mpsc::channel();
    let tell = progress.is_some_and(|progress| !progress.is_none()).then(|| {
        let send: Sender<Event<T>> = send.clone();
        // Whoever waits may have gone.
        Box::new(move |progress| drop(send.send(Event::Progress(progress)))) as Box<dyn Fn(Progress) + Send>
    });
    let mut listener = Listener { stop: Arc::clone(&stop), tell, began: Instant::now(), told: None };
    let spawned = thread::Builder::new().name("percoat".to_owned()).spawn(move || {
        let done = catch_unwind(AssertUnwindSafe(|| pool.install(|| work(&mut listener))));
        drop(listener);
        drop(send.send(Event::Done(done)));
    });
    spawned.map_err(|error| PyRuntimeError::new_err(format!("cannot start a thread: {error}")))?;
    let ended = loop {
        // A receiver belongs to one thread at a time.
        let waiting = receive;
        let (event, back) = py.detach(move || wait(waiting));
        receive = back;
        let heard = py.check_signals().and_then(|()| match event {
            Ok(Event::Progress(own)) => progress.map_or(Ok(None), |callable| callable.call1((own,)).map(|_| None)),
            Ok(Event::Done(done)) => Ok(Some(done)),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(PyRuntimeError::new_err("a thread of percoat has ended")),
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

fn wait<T>(receive: Receiver<T>) -> (Result<T, RecvTimeoutError>, Receiver<T>) {
    (receive.recv_timeout(PATIENCE), receive)
}

/// The threads of a process: those of a parent are not there after a fork.
struct Pool {
    process: u32,
    threads: Option<i64>,
    pool: Arc<ThreadPool>,
}

static POOLS: Mutex<Vec<Pool>> = Mutex::new(Vec::new());

/// As many threads as asked for; the last ones asked for, and as many as there are cores, are kept.
fn pool(threads: Option<i64>) -> PyResult<Arc<ThreadPool>> {
    let mut pools = POOLS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some(own) = pools.iter().find(|own| own.process == process && own.threads == threads) {
        return Ok(Arc::clone(&own.pool));
    }
    let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0) as usize).build();
    let pool = Arc::new(pool.map_err(|error| PyRuntimeError::new_err(format!("cannot start threads: {error}")))?);
    let (here, gone): (Vec<Pool>, Vec<Pool>) = pools.drain(..).partition(|own| own.process == process);
    // Nobody is there who could be told to end.
    gone.into_iter().for_each(std::mem::forget);
    pools.extend(here.into_iter().filter(|own| own.threads.is_none() || threads.is_none()));
    pools.push(Pool { process, threads, pool: Arc::clone(&pool) });
    Ok(pool)
}

//! The progress of a command: on a terminal a line that is redrawn, elsewhere a line every ten seconds.

use super::options::Common;
use super::terminal::{self, tell};
use indicatif::{ProgressBar, ProgressStyle};
use percoat_common::plain;
use std::fmt;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two lines where no line can be redrawn.
const PERIOD: Duration = Duration::from_secs(10);

/// The display of the progress.
#[derive(Debug)]
pub struct Progress {
    state: Arc<Mutex<ProgressState>>,
    bar: ProgressBar,
    /// Whether `--verbose` is given.
    verbose: bool,
    /// Ends the lines when it is dropped.
    _lines: Option<Sender<()>>,
}

/// The numbers and words of the display.
#[derive(Debug, Clone)]
struct ProgressState {
    /// Name of what is counted, such as `step`; empty where the number is not known.
    unit: &'static str,
    /// Number of units done.
    done: usize,
    /// Number of all units; 0 where it is not known.
    of: usize,
    /// Points of the present grid.
    points: Option<[usize; 2]>,
    /// Description of the present work.
    phase: String,
    began: Instant,
    /// Time at which the present count began, and the number of units done then.
    counted: (Instant, usize),
}

impl Progress {
    /// Progress over a number `of` units, some of which are `done`; over an unknown number when `of` is 0.
    pub fn new(unit: &'static str, of: usize, done: usize, common: &Common) -> Self {
        let now = Instant::now();
        let state =
            ProgressState { unit, done, of, points: None, phase: String::new(), began: now, counted: (now, done) };
        let state = Arc::new(Mutex::new(state));
        let drawn = !common.quiet && !common.verbose && terminal::moves();
        let bar = if drawn { ProgressBar::new(of as u64) } else { ProgressBar::hidden() };
        let template = if of > 0 { "{bar:16} {msg}" } else { "{spinner} {msg}" };
        bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_position(done as u64);
        // The line is redrawn by a thread of its own, if one can be started.
        if drawn && thread::Builder::new().spawn(|| ()).is_ok() {
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        let lines = (!common.quiet && !terminal::moves()).then(|| {
            let state = Arc::clone(&state);
            lines(PERIOD, move || tell!("{}", held(&state)))
        });
        Self { state, bar, verbose: common.verbose, _lines: lines }
    }

    /// Shows a description of the present work.
    pub fn say(&self, phase: impl Into<String>) {
        let mut state = held(&self.state);
        state.phase = plain::line(&phase.into()).into_owned();
        self.bar.set_message(state.to_string());
    }

    /// Counts one more unit as done.
    pub fn advance(&self) {
        let mut state = held(&self.state);
        state.done += 1;
        self.bar.set_position(state.done as u64);
        self.bar.set_message(state.to_string());
    }

    /// Begins the count anew, on a grid of `points`, with some units done.
    pub fn grid(&self, points: [usize; 2], done: usize) {
        let mut state = held(&self.state);
        (state.points, state.done, state.counted) = (Some(points), done, (Instant::now(), done));
        self.bar.set_position(done as u64);
        self.bar.set_message(state.to_string());
    }

    /// Prints a line between those of the progress where `--verbose` is given.
    pub fn tell(&self, line: impl fmt::Display) {
        if self.verbose {
            self.bar.suspend(|| tell!("{line}"));
        }
    }

    /// Ends the display.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

fn held(state: &Mutex<ProgressState>) -> MutexGuard<'_, ProgressState> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Calls `line` once a period until the sender is dropped.
fn lines(period: Duration, line: impl Fn() + Send + 'static) -> Sender<()> {
    let (sender, goes_on) = mpsc::channel();
    // Without a thread there are no lines.
    let _ = thread::Builder::new().spawn(move || {
        while goes_on.recv_timeout(period) == Err(RecvTimeoutError::Timeout) {
            line();
        }
    });
    sender
}

impl ProgressState {
    /// Time left if the rest takes as long as the units done since the count began.
    fn left(&self) -> Option<Duration> {
        let (since, from) = self.counted;
        let done = self.done.checked_sub(from).filter(|done| *done > 0)?;
        let left = self.of.checked_sub(self.done).filter(|left| *left > 0)?;
        Some(since.elapsed().mul_f64(left as f64 / done as f64))
    }
}

impl fmt::Display for ProgressState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        if self.of > 0 {
            parts.push(format!("{} {} of {}", self.unit, (self.done + 1).min(self.of), self.of));
        }
        parts.extend(self.points.map(|[n1, n2]| format!("{n1} × {n2} samples")));
        parts.extend(Some(self.phase.clone()).filter(|phase| !phase.is_empty()));
        parts.push(duration(self.began.elapsed()));
        parts.extend(self.left().map(|left| format!("about {} left", duration(left))));
        f.write_str(&parts.join(", "))
    }
}

/// A time in words: 12 s, 3 min 20 s, 2 h 5 min.
fn duration(time: Duration) -> String {
    let seconds = time.as_secs();
    match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m} min {s} s"),
        (h, m, _) => format!("{h} h {m} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn a_line_says_what_goes_on_and_how_long_it_takes() {
        let ago = |seconds: u64| Instant::now().checked_sub(Duration::from_millis(1000 * seconds + 500)).unwrap();
        let state = ProgressState {
            unit: "step",
            done: 4,
            of: 10,
            points: Some([64, 48]),
            phase: "stresses".to_owned(),
            began: ago(200),
            counted: (ago(20), 2),
        };
        assert_eq!(state.to_string(), "step 5 of 10, 64 × 48 samples, stresses, 3 min 20 s, about 1 min 1 s left");
        let last = ProgressState { done: 10, of: 10, ..state };
        assert_eq!(last.to_string(), "step 10 of 10, 64 × 48 samples, stresses, 3 min 20 s");
        assert_eq!(duration(Duration::from_secs(7510)), "2 h 5 min");
    }

    #[test]
    fn lines_come_until_their_sender_is_dropped() {
        let count = Arc::new(AtomicUsize::new(0));
        let counter = Arc::clone(&count);
        let sender = lines(Duration::from_millis(5), move || {
            counter.fetch_add(1, Ordering::SeqCst);
        });
        let started = Instant::now();
        while count.load(Ordering::SeqCst) < 3 {
            assert!(started.elapsed() < Duration::from_secs(60));
            thread::sleep(Duration::from_millis(1));
        }
        drop(sender);
        // The thread has ended when nothing holds the counter any more.
        while Arc::strong_count(&count) > 1 {
            assert!(started.elapsed() < Duration::from_secs(60));
            thread::sleep(Duration::from_millis(1));
        }
    }
}

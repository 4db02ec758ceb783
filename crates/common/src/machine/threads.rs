//! The number of threads of the process.

use std::env;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// Environment variable with the default number of threads.
const VARIABLE: &str = "RAYON_NUM_THREADS";
/// Most threads on one core.
const PER_CORE: usize = 4;

/// Number of threads of this process; 0 before it is set.
static USED: AtomicUsize = AtomicUsize::new(0);

/// A number of threads, at most four a core.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Threads {
    /// The number, at least 1.
    pub count: usize,
    /// Why the number is smaller than the wanted one, a sentence; `None` where it is not.
    pub lowered: Option<String>,
}

impl Threads {
    /// The number `wanted` of the option named `source`; without it that of `RAYON_NUM_THREADS`, else one thread a core.
    ///
    /// # Errors
    /// A sentence when the variable is not a number.
    pub fn new(source: &str, wanted: Option<usize>) -> Result<Self, String> {
        match wanted {
            Some(wanted) => Ok(Self::on(cores(), source, Some(wanted))),
            None => Ok(Self::on(
                cores(),
                VARIABLE,
                of_variable(env::var_os(VARIABLE).map(|value| value.to_string_lossy().into_owned()))?,
            )),
        }
    }

    /// The `wanted` number, lowered to four on each of `cores`.
    fn on(cores: usize, source: &str, wanted: Option<usize>) -> Self {
        let count = wanted.unwrap_or(cores).clamp(1, PER_CORE * cores);
        let lowered = wanted.filter(|&wanted| wanted > count).map(|wanted| {
            format!("{count} threads are used, not the {wanted} of {source}: more than {PER_CORE} on each of {cores} cores wait for one another")
        });
        Self { count, lowered }
    }

    /// Sets the number of threads of the process.
    pub fn are_used(&self) {
        USED.store(self.count, Ordering::Relaxed);
    }

    /// Most threads of the process: four a core.
    pub fn most() -> usize {
        PER_CORE * cores()
    }

    /// Number of threads of the process: the one that was set, else that of [`Threads::new`] without a wish.
    pub fn used() -> usize {
        match USED.load(Ordering::Relaxed) {
            0 => Self::new("", None).map_or_else(|_| cores(), |threads| threads.count),
            used => used,
        }
    }
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// The number in the variable; `None` for one thread a core.
fn of_variable(value: Option<String>) -> Result<Option<usize>, String> {
    let Some(value) = value.filter(|value| !value.is_empty()) else { return Ok(None) };
    let digits = value.trim();
    if digits.is_empty() || !digits.bytes().all(|digit| digit.is_ascii_digit()) {
        return Err(format!(
            "{VARIABLE} = \"{value}\" in the environment is no number of threads: set it to one (0: all cores), unset it, or say \
             how many threads are to be used"
        ));
    }
    // A number of digits that overflows is too large.
    Ok(Some(digits.parse().unwrap_or(usize::MAX)).filter(|&count| count > 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_threads_than_four_a_core_are_lowered_and_said_so() {
        for (wanted, count) in [(None, 2), (Some(1), 1), (Some(8), 8), (Some(9), 8), (Some(usize::MAX), 8)] {
            let threads = Threads::on(2, "--threads", wanted);
            assert_eq!(threads.count, count, "{wanted:?}");
            assert_eq!(threads.lowered.is_some(), wanted.is_some_and(|wanted| wanted > 8), "{wanted:?}");
        }
        let told = Threads::on(2, "--threads", Some(1000)).lowered.unwrap();
        assert!(told.contains("8 threads are used, not the 1000 of --threads"), "{told}");
    }

    #[test]
    fn a_variable_is_a_number_or_refused() {
        for (value, count) in [
            (None, None),
            (Some(""), None),
            (Some("0"), None),
            (Some("3"), Some(3)),
            (Some(" 3 "), Some(3)),
            (Some("99999999999999999999999"), Some(usize::MAX)),
        ] {
            assert_eq!(of_variable(value.map(str::to_owned)), Ok(count), "{value:?}");
        }
        for value in ["many", "-1", "2.5", "1e3", "0x4", "4 cores", " ", "٣", "+3", "\u{1b}[2J"] {
            assert!(of_variable(Some(value.to_owned())).unwrap_err().contains(VARIABLE), "{value}");
        }
    }
}

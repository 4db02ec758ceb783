//! Work that the stress fields of a run have taken, the same on any machine.

use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Work of stress fields: each number counts what was computed, not what was remembered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StressWork {
    /// Planes of one component that were transformed, at any depth and on any number of points.
    pub planes: usize,
    /// Points around which all stresses were expanded by the exact sum of the waves.
    pub expansions: usize,
}

/// Counters of the work of a run.
#[derive(Debug, Default)]
pub(super) struct WorkCounter {
    planes: AtomicUsize,
    expansions: AtomicUsize,
}

impl WorkCounter {
    /// Counts the planes of some components.
    pub fn add_planes(&self, components: usize) {
        self.planes.fetch_add(components, Ordering::Relaxed);
    }

    /// Counts an expansion.
    pub fn add_expansion(&self) {
        self.expansions.fetch_add(1, Ordering::Relaxed);
    }

    /// The work so far.
    pub fn so_far(&self) -> StressWork {
        StressWork { planes: self.planes.load(Ordering::Relaxed), expansions: self.expansions.load(Ordering::Relaxed) }
    }
}

impl fmt::Display for StressWork {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} planes transformed, {} points expanded", self.planes, self.expansions)
    }
}

//! Wall times of the phases of a run.

use serde::{Deserialize, Serialize};
use std::time::{Duration, Instant};

/// A phase of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The case, the surface on the grids, kernel tables, plans of the transforms.
    Setup,
    /// Solutions and what is read off them.
    Solve,
    /// Largest stresses, and those on planes, sections, points and volumes.
    Stress,
    /// Files and pictures.
    Output,
}

/// Wall time of a run by phases, seconds. The phases follow one another: their sum is the whole.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Time of [`Phase::Setup`].
    pub setup: f64,
    /// Time of [`Phase::Solve`].
    pub solve: f64,
    /// Time of [`Phase::Stress`].
    pub stress: f64,
    /// Time of [`Phase::Output`].
    pub output: f64,
}

/// A clock that adds up the wall time of each phase.
#[derive(Debug)]
pub struct Clock {
    began: Instant,
    phase: Phase,
    since: Instant,
    /// Time by [`Phase`], without the present one since it began.
    spent: [Duration; 4],
}

impl Clock {
    /// Starts the clock in the phase [setup](Phase::Setup).
    pub fn start() -> Self {
        let now = Instant::now();
        Self { began: now, phase: Phase::Setup, since: now, spent: [Duration::ZERO; 4] }
    }

    /// Ends the present phase and begins `phase`.
    pub fn turn(&mut self, phase: Phase) {
        let now = Instant::now();
        self.spent[self.phase as usize] += now - self.since;
        (self.phase, self.since) = (phase, now);
    }

    /// Wall time until now, seconds.
    pub fn seconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Wall time until now by phases.
    pub fn timing(&mut self) -> Timing {
        self.turn(self.phase);
        let [setup, solve, stress, output] = self.spent.map(|spent| spent.as_secs_f64());
        Timing { setup, solve, stress, output }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_phases_make_up_the_whole() {
        let mut clock = Clock::start();
        for phase in [Phase::Solve, Phase::Stress, Phase::Output, Phase::Setup, Phase::Solve] {
            clock.turn(phase);
        }
        let before = clock.seconds();
        let Timing { setup, solve, stress, output } = clock.timing();
        let (whole, after) = (setup + solve + stress + output, clock.seconds());
        assert!([setup, solve, stress, output].iter().all(|&seconds| seconds >= 0.0));
        assert!(before - 1e-9 <= whole && whole <= after + 1e-9, "{before} {whole} {after}");
    }
}

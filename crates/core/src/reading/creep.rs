//! Bodies that creep under a load step: its time, and what steps in time leave open.

use super::Reading;
use crate::numeric::serialised;
use crate::quantity::quantities;
use crate::spectral::{CreepStep, TimeError};
use serde::{Deserialize, Serialize};

quantities! {
    /// Bodies that creep under a load step.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct CreepReading {
        /// Time.
        #[serde(deserialize_with = "serialised::number")]
        pub time: f64 = Time "time" "t",
        /// Error of the penetration by all steps in time so far, a length; part of that of the reading. `None` where steps are not divided.
        pub time_error: Option<f64>,
        /// Error of the pressure by all steps in time so far, sums of magnitudes over that of the largest pressure.
        pub pressure_time_error: Option<f64>,
        /// Steps in time since the load step before.
        pub time_steps: usize,
    }
    table CreepQuantities as CREEP;
}

impl CreepReading {
    /// Reading of a step.
    pub fn of(step: &CreepStep) -> Self {
        Self {
            time: step.time,
            time_error: step.error.map(|error| error.penetration),
            pressure_time_error: step.error.map(|error| error.pressure),
            time_steps: step.steps,
        }
    }
}

impl Reading {
    /// The reading with errors of steps in time beside those of the grid, where these are known.
    #[must_use]
    pub(crate) fn with_time_error(mut self, error: Option<TimeError>, by_load: bool) -> Self {
        let Some(TimeError { penetration, pressure }) = error else { return self };
        if by_load {
            self.errors.penetration = self.errors.penetration.map(|error| error + penetration);
        } else {
            let (force, mean) = (self.force, self.mean_pressure.unwrap_or_default());
            self.errors.force = self.errors.force.map(|error| error + pressure * force);
            self.errors.mean_pressure = self.errors.mean_pressure.map(|error| error + pressure * mean);
        }
        self
    }
}

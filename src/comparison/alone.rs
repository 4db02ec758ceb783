//! Indenters as if each were alone, beside a solved step in which they act on each other.

use crate::counterbody::Level;
use crate::load::Load;
use crate::localized::isolated;
use crate::problem::Problem;
use crate::reading::Reading;

/// Largest fraction in contact at which indenters are still compared with one alone: beyond it the contacts alone would
/// reach far into each other's cells, which says nothing and takes minutes to find.
const MOST_CONTACT: f64 = 0.5;

/// Whether the contacts of a step stand apart, so that each can be compared with one alone.
fn stand_apart(reading: &Reading) -> bool {
    reading.contact_fraction < MOST_CONTACT && !reading.levels.iter().any(|level| level.merged)
}

/// Contact radius of each level, a length, without the mutual effect of the indenters under the load of a step; `None`
/// where contacts do not stand apart, or for a topography.
pub fn radii(problem: &Problem, reading: &Reading) -> Option<Vec<f64>> {
    let indenters = problem.counterbody().indenters().filter(|_| stand_apart(reading))?;
    isolated::radii(indenters, problem.half_space(), Load::MeanPressure(reading.mean_pressure))
}

/// Pressure of each level's indenter alone under the load it carries in a step: points (distance from the axis,
/// pressure), none where it carries nothing; `None` where contacts do not stand apart.
pub fn profiles(problem: &Problem, reading: &Reading) -> Option<Vec<Vec<[f64; 2]>>> {
    let size = problem.cell().reduced().longer_side();
    let loads = reading.levels.iter().map(|level| level.load);
    let profile =
        |(level, load): (&Level, f64)| isolated::profile(*level, problem.half_space(), load, size).unwrap_or_default();
    stand_apart(reading).then(|| problem.counterbody().levels().iter().zip(loads).map(profile).collect())
}

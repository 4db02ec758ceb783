//! Partial slip of a load step: where the contact sticks, what it bears, and what it dissipates.

use super::Reading;
use crate::lattice::Grid;
use crate::measured::Measured;
use crate::numeric::{serialised, sums};
use crate::quantity::quantities;
use crate::spectral::SlipStep;
use serde::{Deserialize, Serialize};

/// Largest difference of loads over the load, and of forces over μP, that ends a cycle.
const SAME: f64 = 1e-6;

quantities! {
    /// Partial slip of a load step. Errors are those of the grid and of the division of steps in which the pressure changes.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    pub struct SlipReading {
        /// Tangential force on the body, [x, y], on one cell or on the isolated contact.
        pub force: [f64; 2],
        /// Shift of the counterbody against the body since the first contact, [x, y], a length; in a periodic system between the mean planes, and
        /// of a contact that rolls over one contact length.
        pub shift: [f64; 2],
        /// Tangential force along the direction of friction.
        #[serde(deserialize_with = "serialised::number")]
        pub tangential_force: f64 = Force "tangential force" "Q" error tangential_force_error,
        /// Error of the tangential force.
        pub tangential_force_error: Option<f64>,
        /// Shift along the direction of friction, a length.
        #[serde(deserialize_with = "serialised::number")]
        pub tangential_shift: f64 = Length "tangential shift" "d" error tangential_shift_error,
        /// Error of the shift.
        pub tangential_shift_error: Option<f64>,
        /// Largest friction μP, a force.
        pub limit: f64,
        /// Tangential force over the largest friction μP.
        #[serde(deserialize_with = "serialised::number")]
        pub mobilised: f64 = Fraction "mobilised friction" "Q/μP",
        /// Part of the contact that sticks.
        #[serde(deserialize_with = "serialised::number")]
        pub stick_fraction: f64 = Fraction "stick fraction" "A_s/A" error stick_fraction_error,
        /// Error of the stick fraction.
        pub stick_fraction_error: Option<f64>,
        /// Area that sticks, of the cell or the isolated contact, a length squared.
        #[serde(deserialize_with = "serialised::number")]
        pub stick_area: f64 = Area "stick area" "A_s" error stick_area_error,
        /// Error of the stick area.
        pub stick_area_error: Option<f64>,
        /// Energy that slip dissipates in the step, of the cell or the isolated contact.
        #[serde(deserialize_with = "serialised::number")]
        pub work: f64 = Energy "dissipated energy" "W" error work_error,
        /// Error of the dissipated energy.
        pub work_error: Option<f64>,
        /// Certificate 𝒢: what Coulomb's law would dissipate in this slip less what the tractions did, an energy ≥ 0.
        #[serde(deserialize_with = "serialised::number")]
        pub gap: f64,
        /// Creepage, [x, y]: rise of the shift over the distance rolled; `None` unless the contact rolls.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub creepage_vector: Option<[f64; 2]>,
        /// Creepage along the direction of friction; `None` unless the contact rolls.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub creepage: Option<f64> = Fraction "creepage" "ξ" error creepage_error,
        /// Error of the creepage.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pub creepage_error: Option<f64>,
        /// Change against half as many parts of the step, the larger of that of the force over μP and of the shift over the largest so far; 0 where
        /// the step needs one part.
        #[serde(default)]
        pub change: f64,
        /// Whether the tractions of all parts of the step meet the tolerance.
        pub converged: bool,
        /// Iterations of the last part of the step.
        pub iterations: usize,
        /// Turns between normal and tangential problem in the last part of the step; 1 where they do not couple.
        pub turns: usize,
        /// Share of each level of indenters; empty under a topography.
        pub levels: Vec<SlipLevel>,
    }
    table SlipQuantities as SLIP;
}

/// Partial slip at the indenters of a level.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SlipLevel {
    /// Number of the level, from 1.
    pub level: usize,
    /// Tangential force on one indenter along the direction of friction.
    pub force: f64,
    /// Part of its contact that sticks; `None` where it does not touch.
    pub stick_fraction: Option<f64>,
}

impl SlipReading {
    /// Reading of a step whose friction acts along a direction, a unit vector.
    pub fn of(step: &SlipStep, direction: [f64; 2]) -> Self {
        let along = |[x, y]: [f64; 2]| x * direction[0] + y * direction[1];
        let grid = step.contact.grid();
        let pressures = step.contact.finest().pressures();
        let [touching] = sums::of(pressures.len(), |i| [f64::from(u8::from(pressures[i] > 0.0))]);
        let area = touching * grid.sample_area();
        let stick = step.stick_fraction;
        // A border of as many samples as the contact has along its circumference, half of them counted wrongly.
        let border = if touching > 0.0 { 1.0 / touching.sqrt() } else { 0.0 };
        let fraction_error =
            stick.error.map(|error| error.max(border * stick.value.min(1.0 - stick.value).max(border)));
        let [force, shift] = [&step.force, &step.shift];
        Self {
            force: force.value,
            shift: shift.value,
            tangential_force: along(force.value),
            tangential_force_error: stick.error.map(|_| force.error),
            tangential_shift: along(shift.value),
            tangential_shift_error: stick.error.map(|_| shift.error),
            limit: step.limit,
            mobilised: if step.limit > 0.0 { force.value[0].hypot(force.value[1]) / step.limit } else { 0.0 },
            stick_fraction: stick.value.clamp(0.0, 1.0),
            stick_fraction_error: fraction_error,
            stick_area: area * stick.value.clamp(0.0, 1.0),
            stick_area_error: fraction_error.map(|error| error * area),
            work: step.work.value,
            work_error: step.work.error,
            gap: step.report.gap,
            creepage_vector: step.creepage.map(|creepage| creepage.value),
            creepage: step.creepage.map(|creepage| along(creepage.value)),
            creepage_error: step.creepage.filter(|_| stick.error.is_some()).map(|creepage| creepage.error),
            change: step.change,
            converged: step.converged,
            iterations: step.report.iterations,
            turns: step.turns,
            levels: levels(step, grid, along),
        }
    }
}

/// Number of the steps of the closed cycle with which a path of states (load, x, y) ends, each part over its largest size: those since load and place
/// were what they are at the end, within a tolerance, and were come to from the same side; `None` where they never were. The path begins at its
/// first load with x = y = 0.
pub(crate) fn closed_cycle(states: &[[f64; 3]], tolerance: f64) -> Option<usize> {
    let end = states.len().checked_sub(1)?;
    let before = |k: usize| k.checked_sub(1).map_or([states[0][0], 0.0, 0.0], |k| states[k]);
    let way = |k: usize| std::array::from_fn::<f64, 3, _>(|part| states[k][part] - before(k)[part]);
    let is_closed = |k: &usize| {
        let is_same = (0..3).all(|part| (states[*k][part] - states[end][part]).abs() <= tolerance);
        is_same && way(*k).iter().zip(way(end)).map(|(a, b)| a * b).sum::<f64>() > 0.0
    };
    (0..end).rev().find(is_closed).map(|k| end - k).filter(|length| *length > 1)
}

/// Number of the steps of the last closed cycle by the forces of the steps, or by their shifts.
fn cycle_length<'a>(steps: impl Iterator<Item = (&'a Reading, &'a SlipReading)>) -> Option<usize> {
    let steps: Vec<(&Reading, &SlipReading)> = steps.collect();
    let largest =
        |of: &dyn Fn(&(&Reading, &SlipReading)) -> f64| steps.iter().map(of).fold(f64::MIN_POSITIVE, f64::max);
    let (load, limit) = (largest(&|step| step.0.force), largest(&|step| step.1.limit));
    let farthest = largest(&|step| step.1.shift[0].hypot(step.1.shift[1]));
    let by = |of: fn(&SlipReading) -> [f64; 2], size: f64| {
        let state = |(reading, slip): &(&Reading, &SlipReading)| {
            let [x, y] = of(slip);
            [reading.force / load, x / size, y / size]
        };
        closed_cycle(&steps.iter().map(state).collect::<Vec<_>>(), SAME)
    };
    by(|slip| slip.force, limit).or_else(|| by(|slip| slip.shift, farthest))
}

/// Energy that slip dissipates in the last closed cycle of a path; `None` without one.
pub fn cycle<'a>(steps: impl DoubleEndedIterator<Item = (&'a Reading, &'a SlipReading)> + Clone) -> Option<Measured> {
    let works =
        steps.clone().rev().take(cycle_length(steps)?).map(|(_, slip)| Measured::new(slip.work, slip.work_error));
    works.reduce(|a, b| Measured::new(a.value + b.value, a.error.zip(b.error).map(|(a, b)| a + b)))
}

/// Forces and stick fractions level by level; none under a topography.
fn levels(step: &SlipStep, grid: &Grid, along: impl Fn([f64; 2]) -> f64) -> Vec<SlipLevel> {
    let surface = step.contact.surface();
    let Some(shear) = step.contact.finest().shear() else { return Vec::new() };
    let [x, y] = &shear.traction;
    let count = surface.sites().iter().map(|site| site.level).max().unwrap_or(0);
    let mut sums = vec![[0.0; 3]; count];
    for (i, &p) in step.contact.finest().pressures().iter().enumerate().filter(|(_, p)| **p > 0.0) {
        if let Some(sum) = surface.level_at(i).checked_sub(1).and_then(|level| sums.get_mut(level)) {
            sum[0] += along([x[i], y[i]]) * grid.sample_area();
            sum[1] += 1.0;
            sum[2] += f64::from(u8::from(shear.sticks(i, p)));
        }
    }
    let sites = |level: usize| surface.sites().iter().filter(|site| site.level == level).count();
    let of = |(level, [force, touching, sticking]): (usize, [f64; 3])| SlipLevel {
        level,
        force: force / sites(level).max(1) as f64,
        stick_fraction: (touching > 0.0).then(|| sticking / touching),
    };
    (1..).zip(sums).map(of).collect()
}

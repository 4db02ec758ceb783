//! The loads between which limits are searched: a factor of two apart, and closer where a level begins to touch.
//!
//! They begin with the least load whose contact has samples enough for its stresses, and end where every criterion has failed by more than
//! its error, where contact is complete, where contact reaches the border of the largest window, or at the largest load that the caller has
//! prescribed.

use super::{LimitSearch, TRIALS};
use crate::body::{HalfSpace, Layer};
use crate::load::LoadQuantity;
use crate::reading::{Criterion, Reading};
use crate::run::{Recorder, RunError, StepRecord};
use crate::spectral::Stop;
use std::f64::consts::PI;

/// Largest number of doublings and of halvings of the first load.
const DOUBLINGS: usize = 40;
/// Largest number of times that a first load is halved whose contact has no room in its window.
const HALVINGS: usize = 8;
/// Least number of samples along the radius of a contact for its stresses to be read.
const LEAST_SAMPLES: f64 = 3.0;
/// The first load over that of complete contact.
const START: f64 = 1.0 / 1024.0;
/// Largest ratio of the load on an indenter with a shape of its own between neighbouring loads.
const GROWTH: f64 = 4.0;
/// Relative difference of loads below which they are not divided where a level begins to touch.
const TOUCHING: f64 = 1e-3;

impl<R: Recorder> LimitSearch<'_, R> {
    /// The first load: a part of that of complete contact, or the least strength where contact is complete under any
    /// load and stresses are proportional to it: an endurance limit, and Young's modulus times the strain of a life, among them.
    fn start(&self) -> f64 {
        if self.filling.is_finite() {
            return START * self.filling;
        }
        let bodies = || self.run.problem.bodies().each();
        let of_materials = bodies().flat_map(HalfSpace::strengths);
        let of_materials = of_materials.flat_map(|strength| [strength.yielding, strength.tensile]);
        let durable = bodies().flat_map(|body| body.materials().zip(body.durabilities()));
        let of_passes = durable.flat_map(|(material, durability)| {
            let by_strain = durability.strain_life.map(|life| material.young() * life.strain());
            [durability.endurance.map(|endurance| endurance.torsion()), by_strain]
        });
        let of_interfaces = bodies().flat_map(HalfSpace::layers).map(Layer::interface_strength);
        let of_interfaces = of_interfaces.flat_map(|strength| [strength.normal, strength.shear]);
        let least = of_materials.chain(of_passes).chain(of_interfaces).flatten().fold(f64::INFINITY, f64::min);
        let least = match self.quantity {
            LoadQuantity::MeanPressure => least,
            LoadQuantity::Force => least * self.run.problem.cell().area(),
        };
        least.min(self.hardness_load)
    }

    /// Solves loads a factor of two apart, from the least whose contact has samples enough on, until every criterion has
    /// failed by more than its error or contact is complete. They do not depend on the loads of the run.
    pub(super) fn scan(&mut self, sought: &[Criterion]) -> Result<(), RunError<R::Error>> {
        let mut lowest = self.start().min(self.most);
        let mut at_border = has_no_room(self.solve(lowest)?);
        for _ in 0..HALVINGS {
            if !at_border {
                break;
            }
            // Contact has no room in its window: a lower load may have.
            lowest *= 0.5;
            at_border = has_no_room(self.solve(lowest)?);
            self.steps.truncate(1);
        }
        while at_border && self.windows.end_at(0.0) {
            self.steps.clear();
            at_border = has_no_room(self.solve(lowest)?);
        }
        let mut highest = lowest;
        for _ in 0..DOUBLINGS {
            // Loads are halved until everything holds where contact is complete under any load.
            let holds = |search: &Self| {
                let failed = |&criterion: &Criterion| search.band(criterion).upper.first_failure() == Some(0);
                search.filling.is_infinite() && !sought.iter().any(failed)
            };
            if !self.is_readable(&self.steps[0].reading) || holds(self) {
                break;
            }
            lowest *= 0.5;
            self.solve(lowest)?;
        }
        for _ in 0..DOUBLINGS {
            let has_samples = self.steps.iter().any(|step| self.is_readable(&step.reading));
            let holds = |&criterion: &Criterion| !self.band(criterion).fails();
            if at_border || highest >= self.windows.largest() || has_samples && !sought.iter().any(holds) {
                break;
            }
            let before = highest;
            highest = (2.0 * highest).min(self.windows.largest());
            if has_no_room(self.solve(highest)?) {
                // Contact has no room in its window: the load says nothing.
                self.steps.pop();
                highest = before;
                if !self.windows.end_at(before) {
                    break;
                }
            }
        }
        let readable = self.steps.iter().position(|step| self.is_readable(&step.reading));
        let least = readable.unwrap_or(self.steps.len() - 1);
        self.steps.drain(..least);
        Ok(())
    }

    /// Whether the contact of the best resolved level, or that of a topography, has enough samples for its stresses.
    fn is_readable(&self, reading: &Reading) -> bool {
        // A given contact does not grow with the load.
        if self.run.problem.kind().is_given {
            return true;
        }
        let samples = reading.contact_area / self.solver.normal().grid().sample_area();
        let whole = (samples / PI).sqrt();
        let of_levels = reading.levels.iter().map(|level| level.resolution).reduce(f64::max);
        of_levels.unwrap_or(whole) >= LEAST_SAMPLES
    }

    /// Solves loads between those where a level of a shape of its own begins to touch: its small contacts may fail at loads
    /// of theirs that no doubling of the whole load meets. Levels of one shape fail at the highest of them first.
    pub(super) fn divide_touches(&mut self, sought: &[Criterion]) -> Result<(), RunError<R::Error>> {
        for _ in 0..TRIALS {
            let holds = |index: usize| {
                let holds =
                    |&criterion: &Criterion| self.band(criterion).lower.samples[..=index].iter().all(|[_, u]| *u < 1.0);
                sought.iter().any(holds)
            };
            let rough = (1..self.steps.len()).find(|&above| holds(above - 1) && self.grows_apart(above));
            let Some(above) = rough else { break };
            let [low, high] = [above - 1, above].map(|index| self.load_of(index));
            self.solve((low * high).sqrt())?;
        }
        Ok(())
    }

    /// Whether the load on one indenter of some level grows by more than [`GROWTH`] from the load before to load `above`, and
    /// the level has a shape that no higher one has.
    fn grows_apart(&self, above: usize) -> bool {
        let [before, after] = [above - 1, above].map(|index| &self.steps[index].reading);
        if after.load(self.quantity) <= before.load(self.quantity) * (1.0 + TOUCHING) {
            return false;
        }
        let Some(indenters) = self.run.problem.indenters() else { return false };
        let (levels, drops) = (indenters.levels(), indenters.drops());
        let is_new = |level: usize| {
            (0..levels.len()).all(|other| {
                let is_higher = drops[other] < drops[level] || drops[other] == drops[level] && other < level;
                !is_higher || levels[other].shape() != levels[level].shape()
            })
        };
        let grows = |level: usize| {
            let [low, high] = [before, after].map(|reading| &reading.levels[level]);
            high.resolution >= 2.0 * LEAST_SAMPLES && high.load > GROWTH * low.load
        };
        (0..levels.len()).any(|level| drops[level] > 0.0 && is_new(level) && grows(level))
    }
}

/// Whether a contact has no room in its window: it reaches the border, or would at the hardness everywhere.
fn has_no_room(step: &StepRecord) -> bool {
    matches!(step.stop, Stop::AtBorder | Stop::BeyondHardness)
}

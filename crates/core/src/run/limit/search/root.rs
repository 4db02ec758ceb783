//! The load at which the utilisation of a criterion reaches 1, by secants and bisection between the loads that were solved.
//!
//! The limit has the interval in which the utilisation with and without its error reaches 1. Where it never does, is undecided, or fails
//! under every load, that is said in its place.

use super::{LimitSearch, TRIALS};
use crate::reading::{Criterion, Utilisation};
use crate::run::limit::band::Crossing;
use crate::run::limit::{At, SearchEnd};
use crate::run::{Recorder, RunError};

impl<R: Recorder> LimitSearch<'_, R> {
    /// Whether the highest level, which touches under any load, has tips whose pressure is infinite.
    fn first_is_tip(&self) -> bool {
        let indenters = self.run.problem.indenters();
        let levels = indenters.into_iter().flat_map(|all| all.levels().iter().zip(all.drops()));
        levels.into_iter().any(|(level, drop)| drop == 0.0 && level.shape().singular_peak())
    }

    /// Solves loads until the limit of a criterion is known.
    pub(super) fn find(&mut self, criterion: Criterion) -> Result<(), RunError<R::Error>> {
        for trial in 0..TRIALS {
            // Every third load bisects the interval around the root.
            let Some(next) = self.band(criterion).next(trial % 3 == 2) else { break };
            self.solve(next)?;
        }
        Ok(())
    }

    /// Limit of a criterion, by the loads that were solved.
    pub(super) fn found(&self, criterion: Criterion) -> At {
        let band = self.band(criterion);
        let taken = |index: usize| self.utilisation(&self.steps[index], criterion);
        let load = |index: usize| self.load_of(index);
        let up_to = load(self.steps.len() - 1);
        let Crossing { from, at: crossing, to } = band.crossing();
        let undecided = |at: usize| {
            let Utilisation { value: utilisation, error, position, .. } = taken(at);
            // At another load it may be larger still.
            let most = band.upper.samples.iter().map(|[_, u]| *u).fold(f64::NEG_INFINITY, f64::max);
            let error = error.map(|error| error.max(most - utilisation));
            let at = load(at);
            if from.is_infinite() {
                let end = SearchEnd::of(up_to, self.complete, self.hardness_load);
                At::Never { up_to, end, utilisation, error, at }
            } else {
                At::Undecided { from, up_to, utilisation, error, at, position }
            }
        };
        match band.value.first_failure() {
            None => undecided(band.value.largest()),
            Some(0) => match band.lower.first_failure() {
                // Under no load is u − e ≥ 1: the utilisation there may be an error.
                None => undecided(0),
                Some(sure) => {
                    let Utilisation { value, position, .. } = taken(sure);
                    if sure == 0 && value.is_infinite() && self.first_is_tip() {
                        return At::Tip { position };
                    }
                    At::Below { load: load(sure), utilisation: value, position }
                }
            },
            Some(above) => {
                let enclosure = band.value.enclosure(above);
                let nearest = taken(if enclosure.first_is_nearer() { above - 1 } else { above });
                // The error of a jump by the grid is not known; its place is that of the load that fails.
                let jumps = enclosure.slope().is_none();
                let position = if jumps { taken(above).position } else { nearest.position };
                let error = (crossing - from).max(to - crossing);
                let error = Some(error).filter(|error| error.is_finite() && !jumps && nearest.error.is_some());
                At::Load { load: crossing, error, interval: [from, to], position }
            }
        }
    }
}

//! What a solver knows after a load: enough to have its step again, and to go on with the next load.

use super::iteration::{Report, Unknowns};
use super::{Solver, Step};
use crate::load::Load;

/// What a [`Solver`] knows after a load. It shares its fields with solver and step: keep it no longer than it takes to
/// write it.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    /// How the finest grid's solution was reached.
    pub report: Report,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
    /// Number of coarser grids whose contact the [step](Step::coarser) keeps.
    pub coarser: usize,
    /// What each grid has found, the finest first; after a load that is not solved, those of the step alone.
    pub grids: Vec<Unknowns>,
}

/// A checkpoint that does not fit the grids of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("what was saved of the run is of other grids or loads")]
pub struct OtherGrids;

impl Solver {
    /// What it knows after its last load, whose `step` is given.
    pub fn checkpoint(&self, step: &Step) -> Checkpoint {
        let grids = if step.report.stop.solved() {
            self.unknowns().cloned().collect()
        } else {
            // The solver has forgotten them; what a coarser grid proves is not looked at.
            let contacts = std::iter::once(&step.finest).chain(&step.coarser);
            contacts.map(|contact| contact.unknowns(step.certificate)).collect()
        };
        Checkpoint { report: step.report, convolutions: step.convolutions, coarser: step.coarser.len(), grids }
    }

    /// Takes the place of the solver that this is a checkpoint of, after `load`; gives the step again.
    ///
    /// # Errors
    /// [`OtherGrids`] when it is of a solver on other grids; this one stays as it is.
    pub fn restore(&mut self, load: Load, checkpoint: Checkpoint) -> Result<Step, OtherGrids> {
        let Checkpoint { report, convolutions, coarser, grids } = checkpoint;
        let solved = report.stop.solved();
        let count = if solved { self.unknowns().count() } else { 1 + coarser };
        let samples = |own: &Unknowns| [own.pressure.len(), own.gap.len()];
        let fit = |(own, grid): (&Unknowns, &Unknowns)| samples(own) == samples(grid);
        if grids.len() != count
            || coarser >= count
            || count > self.unknowns().count()
            || !self.unknowns().zip(&grids).all(fit)
        {
            return Err(OtherGrids);
        }
        self.adopt(grids);
        let step = self.step(load, report, convolutions, coarser);
        if !solved {
            self.forget();
        }
        Ok(step)
    }
}

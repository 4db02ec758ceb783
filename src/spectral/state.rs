//! What a solver knows after a load: enough to have its step again, and to go on with the next load.

use super::iteration::{Report, Unknowns};
use super::{Solver, Step};
use crate::load::Load;

/// What a [`Solver`] knows after a load. It shares its fields with solver and step: keep it no longer than it takes to
/// write it.
#[derive(Debug, Clone)]
pub struct State {
    /// How the finest grid's solution was reached.
    pub report: Report,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
    /// Number of coarser grids whose contact the [step](Step::coarser) keeps.
    pub coarser: usize,
    /// What each grid has found, the finest first; after a load that is not solved, those of the step alone.
    pub grids: Vec<Unknowns>,
}

/// A state that does not fit the grids of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("what was saved of the solver is of other grids")]
pub struct OtherGrids;

impl Solver {
    /// What it knows after its last load, whose `step` is given.
    pub fn state(&self, step: &Step) -> State {
        let grids = if step.report.stop.solved() {
            self.unknowns().cloned().collect()
        } else {
            // The solver has forgotten them; what a coarser grid proves is not looked at.
            let contacts = std::iter::once(&step.finest).chain(&step.coarser);
            contacts.map(|contact| contact.unknowns(step.certificate)).collect()
        };
        State { report: step.report, convolutions: step.convolutions, coarser: step.coarser.len(), grids }
    }

    /// Takes the place of the solver that had this state after `load`; gives the step again.
    ///
    /// # Errors
    /// [`OtherGrids`] when the state is of a solver on other grids; this one stays as it is.
    pub fn restore(&mut self, load: Load, state: State) -> Result<Step, OtherGrids> {
        let State { report, convolutions, coarser, grids } = state;
        let solved = report.stop.solved();
        let count = if solved { self.unknowns().count() } else { 1 + coarser };
        let samples = |own: &Unknowns| [own.pressure.len(), own.gap.len()];
        let fit = |(own, grid): (&Unknowns, &Unknowns)| samples(own) == samples(grid);
        if grids.len() != count || coarser >= count || !self.unknowns().zip(&grids).all(fit) {
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

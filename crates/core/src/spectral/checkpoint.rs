//! Checkpoint of a solver after a load: its step, and the start of the next load.

use super::iteration::{Method, Report, Unknowns};
use super::solver::nested_points;
use super::{Solver, Step};
use crate::load::Load;
use std::sync::Arc;

/// State of a [`Solver`] after a load. It shares its fields with solver and step, which copy them if it is kept while the next
/// load is solved. Depths that sliding has worn off are not part of it, but of a [`WearState`](super::WearState).
#[derive(Debug, Clone)]
pub struct Checkpoint {
    /// Report of the solution on the finest grid.
    pub report: Report,
    /// Convolutions on all grids, as equivalents of the finest one.
    pub convolutions: f64,
    /// Number of coarser grids whose contact the [step](Step::coarser) keeps.
    pub coarser: usize,
    /// Unknowns of all grids, the finest first; after a load that is not solved, those of the step alone.
    pub grids: Vec<Unknowns>,
    /// Depths that earlier loads have pressed in, sample by sample, lengths, on all grids, the finest first; none without any.
    pub indented: Vec<Arc<Vec<f64>>>,
}

/// Error of a checkpoint of other grids than those of the solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("what was saved of the run is of other grids or loads")]
pub struct OtherGrids;

impl Checkpoint {
    /// Whether the checkpoint is that of a solver by `method` whose finest grid has `points`, of a counterbody that is constant along the
    /// axis `line`, see [`LoadedBy::line`](crate::LoadedBy::line).
    pub fn fits(&self, points: [usize; 2], method: Method, line: Option<usize>) -> bool {
        self.is_of(nested_points(points, method, line).into_iter().map(|[n1, n2]| n1 * n2))
    }

    /// Whether the checkpoint is that of a solver whose grids have `samples`, the finest first.
    fn is_of(&self, samples: impl ExactSizeIterator<Item = usize> + Clone) -> bool {
        let count = if self.report.stop.solved() { samples.len() } else { self.coarser.saturating_add(1) };
        let fits = |(unknowns, samples): (&Unknowns, usize)| {
            unknowns.pressure.len() == samples && unknowns.gap.len() == samples
        };
        self.grids.len() == count
            && self.coarser < count
            && count <= samples.len()
            && (self.indented.is_empty() || self.indented.iter().map(|depths| depths.len()).eq(samples.clone()))
            && self.grids.iter().zip(samples).all(fits)
    }
}

impl Solver {
    /// State after the last load, whose `step` is given.
    pub fn checkpoint(&self, step: &Step) -> Checkpoint {
        let grids = if step.report.stop.solved() {
            self.unknowns().cloned().collect()
        } else {
            // The solver has dropped them; the certificate of a coarser grid is not used.
            let contacts = std::iter::once(&step.finest).chain(&step.coarser);
            contacts.map(|contact| contact.unknowns(step.certificate)).collect()
        };
        let indented = self.depths();
        Checkpoint {
            report: step.report,
            convolutions: step.convolutions,
            coarser: step.coarser.len(),
            grids,
            indented,
        }
    }

    /// Continues from a checkpoint after `load`, whose step is returned.
    ///
    /// # Errors
    /// [`OtherGrids`] for a checkpoint of a solver on other grids; this one is not changed.
    pub fn restore(&mut self, load: Load, checkpoint: Checkpoint) -> Result<Step, OtherGrids> {
        let samples: Vec<usize> = self.unknowns().map(|unknowns| unknowns.pressure.len()).collect();
        if !checkpoint.is_of(samples.into_iter()) {
            return Err(OtherGrids);
        }
        let Checkpoint { report, convolutions, coarser, grids, indented } = checkpoint;
        if !indented.is_empty() {
            self.press_in(indented);
        }
        let solved = report.stop.solved();
        self.set_unknowns(grids);
        let step = self.step(load, report, convolutions, coarser);
        if !solved {
            self.forget();
        }
        Ok(step)
    }
}

//! Warnings about a life, a sentence each, and whether it has converged.

use super::beginning::Beginning;
use super::state::{LifeEnd, LifeState};
use super::task::LifeTask;
use crate::notation::number;
use crate::reading::Life;
use crate::run::RefinementEnd;
use crate::run::warnings::warnings;

/// Relative error of the passes to the first failure from which on there is a warning.
const UNKNOWN: f64 = 0.5;

impl LifeTask {
    /// Warnings about the contact before the first pass, and about what follows it.
    pub fn warnings(&self, begun: &Beginning, state: &LifeState) -> Vec<String> {
        let mut warnings = warnings(&self.problem, std::slice::from_ref(&begun.record), begun.end, begun.change);
        if let Some(error) = begun.record.fatigue.as_ref().and_then(|own| own.first.error).filter(|own| *own > UNKNOWN)
        {
            warnings.push(format!(
                "the passes to the first failure are known to {:.0} % only: an error of the range of the shear stress counts as often as \
                 the exponent; raise grid.points, or prescribe grid.accuracy",
                100.0 * error
            ));
        }
        if let Some(life) = self.counterbody_failure(begun) {
            warnings.push(format!(
                "the counterbody fails: {}; only the body is followed, and the counterbody stays as it is",
                life.in_words(number)
            ));
        }
        if let Some(row) =
            state.course.iter().find(|row| row.body_depth > row.body + row.thickness && row.thickness > 0.0)
        {
            warnings.push(format!(
                "after {} passes a groove is deeper than the layers that are left: layers are taken as even, as thick as they are on the average",
                number(row.passes)
            ));
        }
        if state.end == Some(LifeEnd::LoadLimit) {
            warnings.push("the life is followed no further: it takes too many loads".to_owned());
        }
        warnings
    }

    /// The first failure of an elastic counterbody, where it comes before the end of the passes that are followed, or before any of the
    /// body.
    fn counterbody_failure(&self, begun: &Beginning) -> Option<Life> {
        let fatigue = begun.record.fatigue.as_ref()?;
        let own = fatigue.lives.iter().filter(|life| life.part.is_counterbody());
        let first = own.min_by(|a, b| a.passes.total_cmp(&b.passes)).filter(|life| life.passes.is_finite())?;
        let comes = first.part == fatigue.first.part || self.passes.is_some_and(|last| first.passes < last);
        comes.then_some(*first)
    }
}

impl LifeState {
    /// Whether every contact was solved, that before the first pass to the accuracy if one is prescribed.
    pub fn converged(&self, begun: &Beginning) -> bool {
        let is_accurate = begun.end.is_none_or(|end| end == RefinementEnd::Reached);
        is_accurate && begun.record.converged() && self.end != Some(LifeEnd::Unsolved)
    }
}

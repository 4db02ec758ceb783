//! Warnings about a life, a sentence each, and whether it has converged.

use super::advance::lowering;
use super::beginning::Beginning;
use super::state::{LifeEnd, LifeState};
use super::task::LifeTask;
use crate::notation::{number, power_error};
use crate::reading::{Life, contact_radii};
use crate::run::RefinementEnd;
use crate::run::warnings::warnings;

/// Relative error of the passes to the first failure from which on there is a warning.
const UNKNOWN: f64 = 0.5;

impl LifeTask {
    /// Warnings about the contact before the first pass, and about what follows it.
    pub fn warnings(&self, begun: &Beginning, state: &LifeState) -> Vec<String> {
        let mut warnings = warnings(&self.problem, std::slice::from_ref(&begun.record), begun.end, begun.change);
        if let Some(error) =
            begun.record.fatigue.as_ref().and_then(|fatigue| fatigue.first.error).filter(|error| *error > UNKNOWN)
        {
            warnings.push(format!(
                "the passes to the first failure are uncertain{}: a relative error of the range of the shear stress, or of the strain, \
                 is multiplied by the exponent; raise grid.points, or prescribe grid.accuracy",
                power_error(Some(error))
            ));
        }
        if let Some(life) = self.counterbody_failure(begun) {
            warnings.push(format!(
                "the counterbody fails: {}; only the body is followed, and the counterbody stays as it is",
                life.in_words(number)
            ));
        }
        if let Some(row) = state.course.iter().find(|row| self.motions.is_none() && row.is_grooved()) {
            warnings.push(format!(
                "after {} passes a groove is deeper than the remaining layers: layers are taken as even, with their mean thickness",
                number(row.passes)
            ));
        }
        let by_strain = self.motions.is_some() && self.problem.bodies().last_by_strain();
        let by_strain = by_strain.then(|| {
            "passes by strain are left out: `strain_life` counts passes of a counterbody that slides, not cycles in which points stay in place"
                .to_owned()
        });
        let more = [self.unworn_below(state), self.short_way(begun), self.wear_left_out(begun), by_strain];
        warnings.extend(more.into_iter().flatten());
        if state.end == Some(LifeEnd::LoadLimit) {
            warnings.push("the life is followed no further: it takes too many loads".to_owned());
        }
        warnings
    }

    /// A material without a coefficient of wear that is uncovered while those above it wore.
    fn unworn_below(&self, state: &LifeState) -> Option<String> {
        let original = self.problem.half_space();
        let (_, gone) = original.uncovered(state.removed())?;
        let wears: Vec<bool> =
            original.durabilities().map(|durability| durability.wear.is_some_and(|wear| wear > 0.0)).collect();
        let stays =
            self.passes.is_some() && wears.iter().take(gone).any(|wears| *wears) && wears.get(gone) == Some(&false);
        stays.then(|| {
            format!(
                "{} is uncovered and has no `wear`: from then on sliding does not wear the body; give it a coefficient",
                original.material_id(gone + 1)
            )
        })
    }

    /// A way of an isolated contact that is shorter than the contact is wide.
    fn short_way(&self, begun: &Beginning) -> Option<String> {
        let way = self.way().filter(|_| self.problem.kind().is_indentation() && begun.record.reading.touches())?;
        let [_, radius] = contact_radii(&begun.step, &begun.record.reading);
        (way < 2.0 * radius).then(|| {
            format!(
                "the counterbody slides {} one way, less than the width {} of the contact: points of the body do not go from rest to \
                 rest, as damage and wear assume; this is fretting",
                number(way),
                number(2.0 * radius)
            )
        })
    }

    /// Warning that surfaces wear, but not up to a number of passes.
    fn wear_left_out(&self, begun: &Beginning) -> Option<String> {
        if !self.wears() || self.passes.is_some() {
            return None;
        }
        let wear = self.wear(&self.problem).ok()?;
        let first = self.problem.half_space().layers().first();
        let lowered = self.slid() * lowering(&begun.step, &wear);
        let through = first.filter(|_| lowered > 0.0).map(|layer| layer.thickness() / lowered);
        let through = through.map_or(String::new(), |passes| {
            format!("; at the wear of the first pass the first layer is worn through after {} passes", number(passes))
        });
        Some(format!("wear is not followed, and the passes are those of unworn surfaces: give life.passes{through}"))
    }

    /// The first failure of an elastic counterbody, where it comes before the end of the passes that are followed, or before any of the
    /// body.
    fn counterbody_failure(&self, begun: &Beginning) -> Option<Life> {
        let fatigue = begun.record.fatigue.as_ref()?;
        let lives = fatigue.lives.iter().filter(|life| life.part.is_counterbody());
        let first = lives.min_by(|a, b| a.passes.total_cmp(&b.passes)).filter(|life| life.passes.is_finite())?;
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

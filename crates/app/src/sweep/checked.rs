//! Reading and checking every combination before the first is solved.

use super::combinations::{Combination, Combinations};
use super::memory::of_results;
use super::study::{Planned, Study, StudyError};
use super::task::Task;
use crate::output::{self, solved_plan};
use crate::task::{FindLimits, Solve};
use percoat_case::case::resources::needs;
use percoat_case::case::{Case, Document, Source};
use percoat_common::machine::{Capacity, bytes};
use percoat_core::run::Sampling;
use std::sync::Arc;

/// Samples of the largest grid on which several combinations are solved at once, each by one thread. On larger grids all
/// threads solve one combination after another: the memory of several does not fit the caches.
const SMALL: usize = 256 * 256;

/// Largest number of kinds of combinations for which memory is estimated from one combination each, before all are read.
const KINDS: usize = 64;

/// A study, and the refusal of the first of its combinations that is refused.
struct Checked<'a> {
    study: Study<'a>,
    refusal: Option<StudyError>,
}

impl<'a> Checked<'a> {
    /// The study, or the first refusal where every combination is refused.
    fn unless_all_are_refused(self) -> Result<Study<'a>, StudyError> {
        match self.refusal {
            Some(error) if self.study.planned.iter().all(|planned| planned.fingerprint.is_empty()) => Err(error),
            _ => Ok(self.study),
        }
    }
}

impl<'a> Study<'a> {
    /// Reads the case of every combination. A refused combination ends as a failed row, unless all are refused.
    ///
    /// # Errors
    /// [`StudyError`] of the first combination where every one is refused, or where memory does not suffice for all results.
    pub fn new(
        source: &'a Source,
        fixed: &'a [String],
        combinations: &'a Combinations,
        task: Task,
        room: Capacity,
    ) -> Result<Self, StudyError> {
        Self::read(source, fixed, (combinations, task), room, room.memory)?.unless_all_are_refused()
    }

    /// Reads the case of every combination, as [`Study::new`], for solutions elsewhere, each as a [part](Self::part): of the
    /// `memory` of this machine, bytes, the sweep needs that of all results alone.
    ///
    /// # Errors
    /// [`StudyError`], as of [`Study::new`].
    pub fn elsewhere(
        source: &'a Source,
        fixed: &'a [String],
        combinations: &'a Combinations,
        task: Task,
        memory: u64,
    ) -> Result<Self, StudyError> {
        let room = Capacity { memory: u64::MAX, disk: u64::MAX };
        Self::read(source, fixed, (combinations, task), room, memory)?.unless_all_are_refused()
    }

    /// Some combinations of a sweep that is checked already: one whose case is refused ends as a failed row, also where all are.
    ///
    /// # Errors
    /// [`StudyError`] of a source or a setting of all combinations that is refused, and where memory does not suffice for all results.
    pub fn part(
        source: &'a Source,
        fixed: &'a [String],
        combinations: &'a Combinations,
        task: Task,
        room: Capacity,
    ) -> Result<Self, StudyError> {
        Ok(Self::read(source, fixed, (combinations, task), room, room.memory)?.study)
    }

    /// Reads the case of every combination; `room` is that of the solutions, `memory` that of the results.
    fn read(
        source: &'a Source,
        fixed: &'a [String],
        (combinations, task): (&'a Combinations, Task),
        room: Capacity,
        memory: u64,
    ) -> Result<Checked<'a>, StudyError> {
        let (stop, planned) = (Arc::default(), Vec::new());
        let document = Document::new(source, fixed)?;
        let mut study = Self { document, combinations, task, room, keeps_fields: false, stop, planned };
        study.has_room_for(study.foreseen(), memory)?;
        let (mut refusal, mut results) = (None, 0);
        for combination in &combinations.all {
            let case = study.case(combination).map_err(StudyError::from);
            let planned = match case.and_then(|case| study.check(&case).map(|()| case)) {
                Ok(case) => {
                    results += of_results(&case, task);
                    study.has_room_for(results, memory)?;
                    study.planned(combination, case)
                }
                Err(error) => {
                    refusal.get_or_insert(error);
                    let (fingerprint, files) = (String::new(), Vec::new());
                    Planned { combination, fingerprint, memory: 0, is_small: true, files, case: None }
                }
            };
            study.planned.push(planned);
        }
        study.room.memory -= results;
        Ok(Checked { study, refusal })
    }

    /// A combination whose case is allowed.
    fn planned(&self, combination: &'a Combination, case: Case) -> Planned<'a> {
        let points = match case.grid {
            Sampling::Points(points) => Some(points),
            // The last grid is not known.
            Sampling::Accuracy(_) => None,
        };
        Planned {
            combination,
            fingerprint: output::fingerprint(&case, &format!("{:?}", self.task)),
            memory: points.map_or(self.room.memory, |points| needs(&case, points, self.job()).memory),
            is_small: points.is_some_and(|[n1, n2]| n1 * n2 <= SMALL),
            files: solved_plan(&case, case.step_count(), true).names,
            case: case.problem().topography().is_none().then(|| Box::new(case)),
        }
    }

    /// Bytes of the results of all combinations, estimated from one case of each kind; 0 for more than [`KINDS`] kinds.
    fn foreseen(&self) -> u64 {
        let kinds = self.combinations.kinds(KINDS).unwrap_or_default();
        let of_kind = |(combination, count): &(&Combination, usize)| {
            self.case(combination).map_or(0, |case| of_results(&case, self.task).saturating_mul(*count as u64))
        };
        kinds.iter().map(of_kind).fold(0, u64::saturating_add)
    }

    /// Refuses results for which `memory` does not suffice.
    fn has_room_for(&self, results: u64, memory: u64) -> Result<(), StudyError> {
        if results <= memory {
            return Ok(());
        }
        Err(StudyError::Refused(format!(
            "the results of {} combinations take about {} of memory, and {} are available: solve them in parts, with --shard",
            self.combinations.all.len(),
            bytes(results),
            bytes(memory)
        )))
    }

    /// Refuses a case that cannot be solved.
    fn check(&self, case: &Case) -> Result<(), StudyError> {
        let possible = match self.task {
            Task::Solve => Solve::into_files(case, self.room, self.keeps_fields, false).map(drop),
            Task::Limit => FindLimits::new(case, self.room, false).map(drop),
        };
        possible.map_err(|refused| StudyError::Refused(refused.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::super::examples::product;
    use super::*;
    use percoat_case::case::embedded;

    #[test]
    fn results_that_take_more_memory_than_there_is_are_refused() {
        let source = embedded::source("fig2").unwrap();
        let fixed = ["grid.points=32", "load.mean_pressure={ from = 0.01, to = 0.06, steps = 500 }"].map(str::to_owned);
        let combinations = product(&["layers.0.poisson=0.1:0.4:20"]);
        // 20 × 500 steps of three levels, 30 kB each, beside what a case takes.
        let study = |mebibytes: u64| {
            let room = Capacity { memory: mebibytes << 20, disk: u64::MAX };
            Study::new(&source, &fixed, &combinations, Task::Solve, room).map(|study| study.room.memory >> 20)
        };
        let why = study(200).unwrap_err().to_string();
        assert!(why.contains("the results of 20 combinations") && why.contains("--shard"), "{why}");
        // 283 MiB of them.
        assert_eq!(study(400).unwrap(), 116);
    }

    /// The memory is foreseen from four cases at most, not from each of up to a million.
    #[test]
    fn a_million_combinations_without_room_are_refused_by_their_number() {
        let source = embedded::source("fig2").unwrap();
        let room = Capacity { memory: 1 << 30, disk: u64::MAX };
        for axes in [
            &["layers.0.poisson=0.1:0.4:1000", "layers.0.thickness=0.1:1:1000"][..],
            &["layers.0.poisson=0.1:0.4:100000", "load.mean_pressure={ from = 0.01, to = 0.06, steps = 5 },0.01"],
            &[
                "layers.0.poisson=0.1:0.4:50000",
                "load.mean_pressure.steps=2,5",
                "solver.method=preconditioned,polonsky-keer",
            ],
            &["layers.0.poisson=0.1:0.4:100000", "stress={},{ planes = [0.1] }"],
        ] {
            let fixed = ["load.mean_pressure={ from = 0.01, to = 0.06, steps = 2 }".to_owned()];
            let combinations = product(axes);
            assert!(combinations.kinds(KINDS).is_some_and(|kinds| kinds.len() <= 4), "{axes:?}");
            let unplanned = Study {
                document: Document::new(&source, &fixed).unwrap(),
                combinations: &combinations,
                task: Task::Solve,
                room,
                keeps_fields: false,
                stop: Arc::default(),
                planned: Vec::new(),
            };
            assert!(unplanned.foreseen() > room.memory, "{axes:?}");
            let refused = Study::new(&source, &fixed, &combinations, Task::Solve, room).unwrap_err().to_string();
            assert!(refused.contains(&format!("the results of {} combinations", combinations.all.len())), "{refused}");
        }
    }
}

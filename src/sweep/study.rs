//! A sweep: every combination is read and checked before the first is solved, and ends as a row.

use super::combinations::{Combination, Combinations};
use super::fields::{Scalars, keep};
use super::memory::of_results;
use super::row::{Ended, Row};
use super::task::Task;
use super::workers;
use crate::case::feasibility::Allowed;
use crate::case::resources::{Job, needs};
use crate::case::{Case, CaseError, Source};
use crate::machine::{Capacity, bytes};
use crate::output::{self, COMBINATIONS, solved_plan};
use crate::run::Sampling;
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Samples of the largest grid on which several combinations are solved at once, each by one thread. On larger grids all
/// threads solve one combination after another: the memory of several does not fit the caches.
const SMALL: usize = 256 * 256;

/// Largest number of kinds of combinations for which memory is estimated from one combination each, before all are read.
const KINDS: usize = 64;

/// Why a sweep cannot be solved.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The case of its first combination is refused.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// Its first combination cannot be solved, or all together take too much memory.
    #[error("{0}")]
    Refused(String),
}

/// A sweep whose combinations are read and checked.
#[derive(Debug)]
pub struct Study<'a> {
    source: &'a Source,
    /// Settings of all combinations, `KEY=VALUE`.
    fixed: &'a [String],
    pub(super) combinations: &'a Combinations,
    task: Task,
    room: Capacity,
    pub(super) keeps_fields: bool,
    stop: Arc<AtomicBool>,
    pub(super) planned: Vec<Planned<'a>>,
}

/// A combination before it is solved.
#[derive(Debug)]
pub(super) struct Planned<'a> {
    pub(super) combination: &'a Combination,
    pub(super) fingerprint: String,
    /// Memory of its solution, bytes.
    memory: u64,
    is_small: bool,
    /// Names of its files where fields are kept.
    pub(super) files: Vec<String>,
    /// Its case; `None` where it is refused, and for a topography, whose heights are read again for the solution.
    case: Option<Box<Case>>,
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
        let (stop, planned) = (Arc::default(), Vec::new());
        let mut study = Self { source, fixed, combinations, task, room, keeps_fields: false, stop, planned };
        study.has_room_for(study.foreseen())?;
        let (mut first, mut results) = (None, 0);
        for combination in &combinations.all {
            let case = study.case(combination).map_err(StudyError::from);
            let planned = match case.and_then(|case| study.check(&case).map(|()| case)) {
                Ok(case) => {
                    results += of_results(&case, task);
                    study.has_room_for(results)?;
                    study.planned(combination, case)
                }
                Err(error) => {
                    first.get_or_insert(error);
                    let (fingerprint, files) = (String::new(), Vec::new());
                    Planned { combination, fingerprint, memory: 0, is_small: true, files, case: None }
                }
            };
            study.planned.push(planned);
        }
        study.room.memory -= results;
        match first {
            Some(error) if study.planned.iter().all(|planned| planned.fingerprint.is_empty()) => Err(error),
            _ => Ok(study),
        }
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
            files: solved_plan(&case, case.load.values().len(), true).names,
            case: case.counterbody().topography().is_none().then(|| Box::new(case)),
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

    /// Refuses results for which memory does not suffice.
    fn has_room_for(&self, results: u64) -> Result<(), StudyError> {
        if results <= self.room.memory {
            return Ok(());
        }
        Err(StudyError::Refused(format!(
            "the results of {} combinations take about {} of memory, and {} are available: solve them in parts, with --shard",
            self.combinations.all.len(),
            bytes(results),
            bytes(self.room.memory)
        )))
    }

    /// The same with the fields of every combination kept, as a solved case in `combinations/NNNN`.
    pub fn keeping_fields(self) -> Self {
        Self { keeps_fields: true, ..self }
    }

    /// The same, where combinations without fields fail at their next iteration once `stop` is true.
    pub fn stopped_by(self, stop: Arc<AtomicBool>) -> Self {
        Self { stop, ..self }
    }

    /// Names of the files of all combinations, relative to the output folder; empty where fields are not kept.
    pub fn files(&self) -> Vec<String> {
        let kept = self.planned.iter().filter(|_| self.keeps_fields);
        kept.flat_map(|planned| {
            let folder = folder_of(planned.combination.number);
            planned.files.iter().map(move |name| format!("{folder}/{name}"))
        })
        .collect()
    }

    /// Number of combinations that `threads` solve at once.
    pub fn workers(&self, threads: usize) -> usize {
        let small = self.planned.iter().filter(|planned| planned.is_small);
        let memory = small.map(|planned| planned.memory).max().unwrap_or(0).max(1);
        usize::try_from(self.room.memory / memory).unwrap_or(usize::MAX).min(threads).max(1)
    }

    /// Solves every combination whose number is not among the `known` ones; `done` receives the row of each when it ends.
    /// Kept fields are gathered in `folder`.
    ///
    /// # Errors
    /// Those of `done`.
    pub fn run<E>(
        &self,
        known: &HashSet<usize>,
        folder: &Path,
        mut done: impl FnMut(Row) -> Result<(), E>,
    ) -> Result<(), E> {
        let is_known = |planned: &&Planned| known.contains(&planned.combination.number);
        let pending = self.planned.iter().filter(|planned| !is_known(planned));
        let (small, large): (Vec<&Planned>, Vec<&Planned>) = pending.partition(|planned| planned.is_small);
        let workers = self.workers(rayon::current_num_threads());
        let share = Capacity { memory: self.room.memory / workers as u64, ..self.room };
        workers::each(&small, workers, |planned| self.row(planned, folder, share), &mut done)?;
        workers::each(&large, 1, |planned| self.row(planned, folder, self.room), &mut done)
    }

    /// Refuses a case that cannot be solved.
    fn check(&self, case: &Case) -> Result<(), StudyError> {
        let run = case.run();
        let possible = match self.task {
            Task::Solve => run.check(),
            Task::Limit => run.check_limits(),
        };
        possible.map_err(|error| StudyError::Refused(error.to_string()))?;
        Allowed::within(case, self.room, self.job()).map(drop).map_err(StudyError::Refused)
    }

    pub(super) fn settings(&self, combination: &Combination) -> Vec<(String, String)> {
        self.combinations.keys.iter().cloned().zip(combination.values.iter().cloned()).collect()
    }

    fn case(&self, combination: &Combination) -> Result<Case, CaseError> {
        Case::read(self.source, &[self.fixed, &self.combinations.settings(combination)].concat())
    }

    fn job(&self) -> Job {
        match self.task {
            Task::Solve => Job::Solve { pictures: false, fields: self.keeps_fields },
            Task::Limit => Job::Limit { pictures: false },
        }
    }

    fn row(&self, planned: &Planned, folder: &Path, room: Capacity) -> Row {
        let (combination, started) = (planned.combination, Instant::now());
        // A panic fails this combination alone.
        let ended = catch_unwind(AssertUnwindSafe(|| self.ended(planned, folder, room)));
        let Ended { status, reason, warnings, results, files } =
            ended.unwrap_or_else(|_| Ended::failed("percoat itself failed on it, which is a fault of the program"));
        Row {
            combination: combination.number,
            settings: self.settings(combination),
            fingerprint: planned.fingerprint.clone(),
            status,
            reason,
            warnings,
            results,
            seconds: started.elapsed().as_secs_f64(),
            files,
        }
    }

    fn ended(&self, planned: &Planned, folder: &Path, room: Capacity) -> Ended {
        let read;
        let case = match &planned.case {
            Some(case) => case,
            None => match self.case(planned.combination) {
                Ok(case) => {
                    read = case;
                    &read
                }
                Err(error) => return Ended::failed(error.message()),
            },
        };
        let allowed = match Allowed::within(case, room, self.job()) {
            Ok(allowed) => allowed,
            Err(why) => return Ended::failed(why),
        };
        let mut scalars = Scalars { allowed, stop: &self.stop };
        match (self.task, self.keeps_fields) {
            (Task::Solve, true) => {
                let folder = folder.join(folder_of(planned.combination.number));
                keep(case, &folder, allowed).unwrap_or_else(|error| Ended::failed(error.to_string()))
            }
            (Task::Solve, false) => match case.run().solve(&mut scalars) {
                Ok(outcome) => Ended::solved(&outcome, case),
                Err(error) => Ended::failed(error.told()),
            },
            (Task::Limit, _) => match case.run().limits(&mut scalars) {
                Ok(limits) => Ended::limited(&limits, case),
                Err(error) => Ended::failed(error.told()),
            },
        }
    }
}

/// Folder of the fields of a combination, relative to that of the result.
pub(super) fn folder_of(number: usize) -> String {
    format!("{COMBINATIONS}/{number:04}")
}

#[cfg(test)]
mod tests {
    use super::super::examples::product;
    use super::*;
    use crate::case::embedded;

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
                source: &source,
                fixed: &fixed,
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

    #[test]
    fn a_stopped_study_ends_with_failed_combinations() {
        let source = embedded::source("fig2").unwrap();
        let combinations = product(&["layers.0.poisson=0.1,0.2,0.3"]);
        let room = Capacity { memory: 1 << 30, disk: u64::MAX };
        for task in [Task::Solve, Task::Limit] {
            // Limits need strengths.
            let fixed = ["grid.points=48", "layers.0.yield_strength=1"].map(str::to_owned);
            let study = Study::new(&source, &fixed, &combinations, task, room).unwrap();
            let stop = Arc::new(AtomicBool::new(true));
            let (study, mut reasons) = (study.stopped_by(Arc::clone(&stop)), Vec::new());
            let done = study.run(&HashSet::new(), Path::new("."), |row| -> Result<(), ()> {
                reasons.push(row.reason);
                Ok(())
            });
            assert_eq!(done, Ok(()));
            assert_eq!(reasons, vec![Some("stopped before its end".to_owned()); 3]);
        }
    }
}

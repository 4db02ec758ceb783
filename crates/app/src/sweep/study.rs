//! A sweep: every combination is read and checked before the first is solved, and ends as a row.

use super::combinations::{Combination, Combinations};
use super::fields::{Scalars, keep};
use super::row::{Ended, Row};
use super::task::Task;
use super::workers;
use crate::output::{COMBINATIONS, OutputError};
use crate::task::{FindLimits, Refused, Solve};
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, CaseError, Document};
use percoat_common::machine::Capacity;
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Why a sweep cannot be solved.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The case of its first combination is refused.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The first combination cannot be solved, or all together take too much memory.
    #[error("{0}")]
    Refused(String),
}

/// A sweep whose combinations are read and checked.
#[derive(Debug)]
pub struct Study<'a> {
    /// The case, with the settings of all combinations.
    pub(super) document: Document<'a>,
    pub(super) combinations: &'a Combinations,
    pub(super) task: Task,
    pub(super) room: Capacity,
    pub(super) keeps_fields: bool,
    pub(super) stop: Arc<AtomicBool>,
    pub(super) planned: Vec<Planned<'a>>,
}

/// A combination before it is solved.
#[derive(Debug)]
pub(super) struct Planned<'a> {
    pub(super) combination: &'a Combination,
    pub(super) fingerprint: String,
    /// Memory of the solution, bytes.
    pub(super) memory: u64,
    pub(super) is_small: bool,
    /// Names of the files of the combination where fields are kept.
    pub(super) files: Vec<String>,
    /// The case of the combination; `None` where it is refused, and for a topography, whose heights are read again for the
    /// solution.
    pub(super) case: Option<Box<Case>>,
}

impl<'a> Study<'a> {
    /// The study with the fields of every combination kept, as a solved case in `combinations/NNNN`.
    pub fn keeping_fields(self) -> Self {
        Self { keeps_fields: true, ..self }
    }

    /// The study, where combinations without fields fail at their next iteration once `stop` is true.
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

    /// Fingerprints of the cases of all combinations with their task; an empty one where the case is refused.
    pub fn fingerprints(&self) -> Vec<String> {
        self.planned.iter().map(|planned| planned.fingerprint.clone()).collect()
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
    /// Errors of `done`, and of writing fields.
    pub fn run<E: From<OutputError>>(
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
        let mut done = |row: Result<Row, OutputError>| done(row?);
        workers::each(&small, workers, |planned| self.row(planned, folder, share), &mut done)?;
        workers::each(&large, 1, |planned| self.row(planned, folder, self.room), &mut done)
    }

    pub(super) fn case(&self, combination: &Combination) -> Result<Case, CaseError> {
        self.document.changed(&self.combinations.settings(combination))
    }

    pub(super) fn job(&self) -> Job {
        match self.task {
            Task::Solve => Job::Solve { pictures: false, fields: self.keeps_fields },
            Task::Limit => Job::Limit { pictures: false },
        }
    }

    fn row(&self, planned: &Planned, folder: &Path, room: Capacity) -> Result<Row, OutputError> {
        let (combination, started) = (planned.combination, Instant::now());
        // A panic fails this combination alone.
        let ended = catch_unwind(AssertUnwindSafe(|| self.ended(planned, folder, room)));
        let fault = "percoat itself failed on it, which is a fault of the program";
        let Ended { status, reason, warnings, results, files } = ended.unwrap_or_else(|_| Ok(Ended::failed(fault)))?;
        Ok(Row {
            combination: combination.number,
            settings: self.combinations.named_values(combination),
            fingerprint: planned.fingerprint.clone(),
            status,
            reason,
            warnings,
            results,
            seconds: started.elapsed().as_secs_f64(),
            files,
        })
    }

    fn ended(&self, planned: &Planned, folder: &Path, room: Capacity) -> Result<Ended, OutputError> {
        let read;
        let case = match &planned.case {
            Some(case) => case,
            None => match self.case(planned.combination) {
                Ok(case) => {
                    read = case;
                    &read
                }
                Err(error) => return Ok(Ended::failed(error.message())),
            },
        };
        let (mut scalars, refused) =
            (Scalars { stop: &self.stop }, |refused: Refused| Ended::failed(refused.to_string()));
        Ok(match self.task {
            Task::Solve => match Solve::into_files(case, room, self.keeps_fields, false) {
                Ok(task) if self.keeps_fields => {
                    keep(case, &task, &folder.join(folder_of(planned.combination.number)))?
                }
                Ok(task) => task.solve(&mut scalars).map_or_else(|error| Ended::failed(error.told()), Ended::solved),
                Err(why) => refused(why),
            },
            Task::Limit => match FindLimits::new(case, room, false) {
                Ok(task) => task.find(&mut scalars).map_or_else(|error| Ended::failed(error.told()), Ended::limited),
                Err(why) => refused(why),
            },
        })
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
    use percoat_case::case::embedded;

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
            let done = study.run(&HashSet::new(), Path::new("."), |row| -> Result<(), OutputError> {
                reasons.push(row.reason);
                Ok(())
            });
            done.unwrap();
            assert_eq!(reasons, vec![Some("stopped before its end".to_owned()); 3]);
        }
    }
}

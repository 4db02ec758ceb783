//! The last load of a case by both methods.

use super::refused::Refused;
use super::within::Within;
use crate::output::ComparisonFile;
use percoat_case::case::feasibility::Allowed;
use percoat_case::case::resources::Job;
use percoat_case::case::{Case, plausibility};
use percoat_common::machine::Capacity;
use percoat_core::comparison::{Comparison, ComparisonError, ComparisonTask};
use percoat_core::run::{Recorder, RefinementEnd, Run, RunError, Sampling};
use std::error::Error;
use std::ops::ControlFlow;

/// Both methods, to be compared.
#[derive(Debug)]
pub struct Compare<'a> {
    case: &'a Case,
    allowed: Allowed<'a>,
    task: ComparisonTask,
    /// The refinement of the spectral solution where an accuracy is prescribed.
    run: Run,
}

/// Both solutions.
#[derive(Debug)]
pub struct Compared<'a> {
    /// The case.
    pub case: &'a Case,
    /// The solutions, and how they differ.
    pub comparison: Comparison,
    /// How the refinement of the spectral grid ended.
    end: RefinementEnd,
    /// Warnings about the comparison and the case, a sentence each.
    pub warnings: Vec<String>,
}

/// Why a comparison has ended without a result; `E` is the error of the recorder.
#[derive(Debug, thiserror::Error)]
pub enum CompareError<E: Error + 'static> {
    /// The refinement of the spectral solution has ended.
    #[error(transparent)]
    Run(#[from] RunError<E>),
    /// The methods cannot be compared, or were stopped.
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
}

impl<E: Error + 'static> CompareError<E> {
    /// The reason in one sentence; of an error of the recorder its message.
    pub fn told(&self) -> String {
        match self {
            Self::Run(error) => error.told(),
            Self::Comparison(error) => error.to_string(),
        }
    }
}

impl<'a> Compare<'a> {
    /// The task in the memory and disk of `room`, with its `pictures` or without.
    ///
    /// # Errors
    /// [`Refused`] of a counterbody without indenters, where memory or disk do not suffice, of a load that has no solution, and of what
    /// the localized method cannot solve.
    pub fn new(case: &'a Case, room: Capacity, pictures: bool) -> Result<Self, Refused> {
        if case.problem().indenters().is_none() {
            return Err(Refused::new(
                "compare needs [[levels]]: the localized method knows indenters, not a [surface] or a given pressure; use percoat solve",
            ));
        }
        if case.tangential.is_some() {
            return Err(Refused::new(
                "compare has no partial slip: the localized method knows no tangential force; leave [tangential] out, or use percoat solve",
            ));
        }
        if case.adhesion.is_some() {
            return Err(Refused::new(
                "compare has no adhesion: the localized method knows no tension; leave [adhesion] out, or use percoat solve",
            ));
        }
        if case.time.is_some() {
            return Err(Refused::new(
                "compare has no loads in time: the localized method knows elastic bodies; give [load] instead of [time], or use percoat solve",
            ));
        }
        if case.motion.is_some() {
            return Err(Refused::new(
                "compare has no steady motion: the localized method knows neither bodies that relax nor heat; leave [motion] out, or use percoat solve",
            ));
        }
        let task = case.comparison();
        let run = Run { loads: vec![task.load], stress: None, ..case.run() };
        let allowed = Allowed::within(case, room, Job::Compare { pictures }).map_err(Refused::new)?;
        run.check().map_err(Refused::new)?;
        task.check().map_err(Refused::new)?;
        Ok(Self { case, allowed, task, run })
    }

    /// Solves by both methods. The recorder sees the refinement of the spectral grid; `stage` is called with the points of the last grid
    /// and the name of each stage before it begins, and may end the comparison.
    ///
    /// # Errors
    /// [`CompareError`].
    pub fn compare<R: Recorder>(
        &self,
        recorder: &mut R,
        stage: &mut dyn FnMut([usize; 2], &str) -> ControlFlow<()>,
    ) -> Result<Compared<'a>, CompareError<R::Error>> {
        let (points, end) = match self.case.grid {
            Sampling::Points(points) => (points, RefinementEnd::Reached),
            Sampling::Accuracy(_) => {
                let refined = self.run.solve(&mut Within { allowed: self.allowed, recorder })?;
                (refined.points, refined.end.unwrap_or(RefinementEnd::Reached))
            }
        };
        let comparison = self.task.compare(points, &mut |name| stage(points, name))?;
        let mut warnings = [comparison.warnings(), plausibility::of_case(self.case)].concat();
        if end != RefinementEnd::Reached {
            warnings.push(format!("grid.accuracy is not reached: {end}"));
        }
        Ok(Compared { case: self.case, comparison, end, warnings })
    }
}

impl Compared<'_> {
    /// Whether all solutions have converged, and the accuracy is reached.
    pub fn converged(&self) -> bool {
        self.comparison.converged() && self.end == RefinementEnd::Reached
    }

    /// The content of `compare.json`.
    pub fn file(&self) -> ComparisonFile {
        ComparisonFile::new(&self.comparison, self.case, self.case.step_count())
    }
}

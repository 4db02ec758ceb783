//! What a run leaves on disk while it goes on: its case, every finished step with its fields, and stresses.

use super::clock::{Clock, Phase};
use super::fields::Fields;
use super::steps_log::StepsLog;
use super::stress::Stresses;
use super::{OutputError, RunFolder, write_text};
use crate::load::Load;
use crate::run::{Recorder, Run, StepRecord, StressRequest};
use crate::spectral::{Solver, Step};
use crate::stress::{Section, StressField};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Records a run where its result is gathered.
#[derive(Debug)]
pub struct Recording<'a> {
    claim: &'a RunFolder,
    /// Content of `case.toml`.
    case: String,
    stress: Option<StressRequest>,
    /// Whether fields are kept.
    fields: bool,
    clock: Clock,
    /// None before the first grid.
    files: Option<Files>,
    set_aside: Option<PathBuf>,
}

/// Files of the steps on one grid.
#[derive(Debug)]
struct Files {
    /// None where fields are not kept.
    fields: Option<Fields>,
    /// None where fields are not kept, or no stresses wanted.
    stresses: Option<Stresses>,
    /// The section of the last step, where fields are not kept.
    section: Option<Section>,
    log: StepsLog,
    /// Number of finished steps.
    steps: usize,
}

impl<'a> Recording<'a> {
    /// Of a run into the folder it has claimed; `case` is the case as `case.toml` shows it. The clock goes on.
    pub fn new(claim: &'a RunFolder, run: &Run, case: String, clock: Clock) -> Self {
        Self { claim, case, stress: run.stress.clone(), fields: true, clock, files: None, set_aside: None }
    }

    /// The same without `contact.npz`, `stress.npz` and volumes: scalars, and what pictures show of the last step.
    pub fn without_fields(self) -> Self {
        Self { fields: false, ..self }
    }

    /// Number of load steps that are finished on the present grid.
    pub fn steps(&self) -> usize {
        self.files.as_ref().map_or(0, |files| files.steps)
    }

    /// Where files of somebody else stand now that were in the way of the present grid.
    pub fn set_aside(&self) -> Option<&Path> {
        self.set_aside.as_deref()
    }

    /// Gathers the fields of all steps; what the section shows of the last one, and the clock, busy with
    /// [output](Phase::Output).
    ///
    /// # Errors
    /// [`OutputError`] when an archive cannot be written.
    ///
    /// # Panics
    /// When nothing has been recorded.
    pub fn finish(mut self) -> Result<(Option<Section>, Clock), OutputError> {
        self.clock.turn(Phase::Output);
        let Files { fields, stresses, section, .. } = self.files.expect(BEGUN);
        fields.map_or(Ok(()), Fields::finish)?;
        let written = stresses.map_or(Ok(None), Stresses::finish)?;
        Ok((written.or(section), self.clock))
    }
}

const BEGUN: &str = "a run begins a grid before its steps";

impl Recorder for Recording<'_> {
    type Error = OutputError;

    fn begin(&mut self, solver: &Solver) -> Result<(), OutputError> {
        self.clock.turn(Phase::Output);
        self.files = None;
        let folder = self.claim.staging();
        self.set_aside = self.claim.begin_finer()?;
        write_text(&folder.join("case.toml"), &self.case)?;
        let half_space = solver.problem().half_space();
        let request = self.stress.clone().filter(|_| self.fields);
        let stresses = request.map(|request| Stresses::new(&folder, request, half_space.clone())).transpose()?;
        let fields = self.fields.then(|| Fields::new(&folder, Arc::clone(solver.surface()))).transpose()?;
        self.files = Some(Files { fields, stresses, section: None, log: StepsLog::new(&folder), steps: 0 });
        self.clock.turn(Phase::Setup);
        Ok(())
    }

    fn load(&mut self, _load: Load) {
        self.clock.turn(Phase::Solve);
    }

    fn stresses(&mut self) {
        self.clock.turn(Phase::Stress);
    }

    fn clock(&self) -> Option<f64> {
        Some(self.clock.seconds())
    }

    fn step(&mut self, step: &Step, record: &StepRecord, field: Option<&StressField>) -> Result<(), OutputError> {
        self.clock.turn(Phase::Output);
        let files = self.files.as_mut().expect(BEGUN);
        if let Some(fields) = &mut files.fields {
            fields.add(step, record.reading.mean_pressure)?;
        } else if let (Some(field), Some(cut)) = (field, self.stress.as_ref().and_then(|request| request.cut.as_ref()))
        {
            self.clock.turn(Phase::Stress);
            files.section = Some(field.section(&cut.line, &cut.depths(step.problem().half_space())));
            self.clock.turn(Phase::Output);
        }
        if let (Some(stresses), Some(field)) = (&mut files.stresses, field) {
            stresses.add(field, &mut self.clock)?;
        }
        files.log.add(record)?;
        files.steps += 1;
        self.clock.turn(Phase::Setup);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{HalfSpace, Material};
    use crate::counterbody::{Indenters, Level, Shape};
    use crate::lattice::Lattice;
    use crate::load::Load;
    use crate::output::{Plan, Writer};
    use crate::problem::Problem;
    use crate::run::{Sampling, StressRequest};

    #[test]
    fn a_recording_without_the_command_line_has_every_step_and_what_was_asked_for() {
        let level = Level::new(Shape::Paraboloid { radius: 0.8 }, 0.0).unwrap();
        let indenters = Indenters::new(Lattice::square(1.0, 1).unwrap(), vec![level]).unwrap();
        let half_space = HalfSpace::new(vec![], Material::from_young(1.0, 0.3).unwrap());
        let loads = [0.01, 0.02].map(Load::MeanPressure).to_vec();
        let planes = StressRequest { planes: vec![0.1], ..StressRequest::default() };
        let run = Run::new(Problem::new(indenters, half_space), loads, Sampling::Points([16, 16]));
        let run = Run { stress: Some(planes), ..run };
        let place = tempfile::tempdir().unwrap();
        let claim = RunFolder::claim(place.path(), Plan::new(Writer::Solve)).unwrap();
        let mut recording = Recording::new(&claim, &run, "title = \"\"\n".to_owned(), Clock::start());
        run.solve(&mut recording).unwrap();
        assert_eq!((recording.steps(), recording.set_aside()), (2, None));
        assert!(recording.finish().unwrap().0.is_none(), "no section was asked for");
        let files = ["case.toml", "contact.npz", "stress.npz", "steps.jsonl"].map(|name| claim.staging().join(name));
        assert!(files.iter().all(|file| file.is_file()));
        assert_eq!(std::fs::read_to_string(&files[3]).unwrap().lines().count(), 2);
    }
}

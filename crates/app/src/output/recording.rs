//! The recorder of a run on disk: its case, every finished step with its fields, and stresses.

use super::checkpoint::Checkpoints;
use super::clock::{Clock, Phase};
use super::fields::ContactArchive;
use super::layout::{CONTACT, archive};
use super::steps_log::StepsLog;
use super::stress::StressArchive;
use super::{Files, OutputError, RunFolder, disk, write_text};
use percoat_case::case::Case;
use percoat_core::load::Load;
use percoat_core::run::{EarlierRun, GridStart, Recorder, Run, StepRecord, StressRequest};
use percoat_core::spectral::{Checkpoint, Step};
use percoat_core::stress::{StressField, StressFields, TemperatureField, VerticalSection};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Name of the case as it is run.
const CASE: &str = "case.toml";

/// Names of the files that a recording of a case with so many load steps leaves, with its fields or without.
pub(super) fn files(case: &Case, steps: usize, fields: bool) -> Vec<String> {
    let mut names = vec![CASE.to_owned()];
    if fields {
        names.push(archive(CONTACT));
        if let Some(stress) = &case.stress {
            names.extend(StressArchive::files(stress.volume.is_some(), case.problem().bodies(), steps));
        }
    }
    names
}

/// Recorder of a run into its staging folder.
#[derive(Debug)]
pub struct Recording<'a> {
    claim: &'a RunFolder,
    /// Content of `case.toml`.
    case: String,
    stress: Option<StressRequest>,
    /// Number of all loads.
    loads: usize,
    /// Whether fields are kept.
    fields: bool,
    clock: Clock,
    /// When the present load began, by the clock.
    load_began: f64,
    /// `None` where the run cannot be resumed.
    checkpoints: Option<Checkpoints>,
    /// The steps of the interrupted run that is resumed, until the run takes them.
    earlier: Option<EarlierRun>,
    /// Number of steps on disk when the first grid begins; `None` for a run that is not resumed.
    standing: Option<usize>,
    /// `None` before the first grid.
    files: Option<OnGrid>,
    set_aside: Option<PathBuf>,
}

/// Files of the steps on one grid.
#[derive(Debug)]
struct OnGrid {
    /// `None` where fields are not kept.
    fields: Option<ContactArchive>,
    /// `None` where fields are not kept, or the case has no stresses.
    stresses: Option<StressArchive>,
    /// The sections of the last step, where stresses are not kept.
    sections: Vec<VerticalSection>,
    log: StepsLog,
    /// Number of finished steps.
    steps: usize,
}

impl<'a> Recording<'a> {
    /// Recorder of `run` into the folder that it has claimed; `case` is the content of `case.toml`. The clock keeps its times.
    pub fn new(claim: &'a RunFolder, run: &Run, case: String, clock: Clock) -> Self {
        Self {
            claim,
            case,
            stress: run.stress.clone(),
            loads: run.loads.len(),
            fields: true,
            clock,
            checkpoints: None,
            earlier: None,
            standing: None,
            files: None,
            load_began: 0.0,
            set_aside: None,
        }
    }

    /// The recorder with checkpoints, from which a run of this [fingerprint](super::fingerprint) can be resumed; this run
    /// itself resumes the `earlier` one.
    pub fn resumable(self, fingerprint: String, earlier: Option<EarlierRun>) -> Self {
        let checkpoints = Checkpoints::new(fingerprint, self.loads, earlier.as_ref());
        let standing = earlier.as_ref().and_then(|earlier| earlier.last.as_ref().map(|_| earlier.steps.len()));
        Self { checkpoints: Some(checkpoints), earlier, standing, ..self }
    }

    /// The recorder of scalars alone, and of the section of the last step for its picture: no `contact.npz`, `stress.npz`
    /// and volumes.
    pub fn without_fields(self) -> Self {
        Self { fields: false, ..self }
    }

    /// The files of the steps on a grid, after those that an interrupted run has finished.
    fn open(&self, start: &GridStart, steps: usize) -> Result<OnGrid, OutputError> {
        let folder = self.claim.staging();
        let bodies = start.problem().bodies().clone();
        let request = self.stress.clone().filter(|_| self.fields);
        let surface = self.fields.then(|| Arc::clone(start.surface()));
        let run = self.checkpoints.as_ref().map(|checkpoints| checkpoints.fingerprint.clone());
        Ok(OnGrid {
            fields: surface.map(|surface| ContactArchive::new(&folder, surface, steps)).transpose()?,
            stresses: request.map(|request| StressArchive::new(&folder, request, bodies, steps)).transpose()?,
            sections: Vec::new(),
            log: StepsLog::new(&folder, run, steps)?,
            steps,
        })
    }

    /// Number of finished load steps on the present grid.
    pub fn steps(&self) -> usize {
        self.files.as_ref().map_or(0, |files| files.steps)
    }

    /// Folder to which foreign files were moved that were in the way of the present grid.
    pub fn set_aside(&self) -> Option<&Path> {
        self.set_aside.as_deref()
    }

    /// Gathers the fields of all steps in their archives. Returns the sections of the last step, that of the body first, and the
    /// clock in the phase [output](Phase::Output).
    ///
    /// # Errors
    /// [`OutputError`] when an archive cannot be written.
    ///
    /// # Panics
    /// When nothing has been recorded.
    pub fn finish(mut self) -> Result<(Vec<VerticalSection>, Clock), OutputError> {
        self.clock.turn(Phase::Output);
        let OnGrid { fields, stresses, sections, .. } = self.files.expect(BEGUN);
        fields.map_or(Ok(()), ContactArchive::finish)?;
        let sections = stresses.map_or(Ok(sections), StressArchive::finish)?;
        Ok((sections, self.clock))
    }
}

const BEGUN: &str = "a run begins a grid before its steps";

impl Recorder for Recording<'_> {
    type Error = OutputError;

    fn begin(&mut self, start: &GridStart) -> Result<(), OutputError> {
        self.clock.turn(Phase::Output);
        let folder = self.claim.staging();
        self.files = None;
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.begin(&folder, start.grid().points())?;
        }
        let standing = self.standing.take();
        if standing.is_none() {
            self.set_aside = self.claim.begin_finer()?;
        }
        write_text(&folder.join(CASE), &self.case)?;
        self.files = Some(self.open(start, standing.unwrap_or(0))?);
        self.clock.turn(Phase::Setup);
        Ok(())
    }

    fn finished(&mut self) -> Option<EarlierRun> {
        self.earlier.take()
    }

    fn solved(&mut self, checkpoint: &Checkpoint) -> Result<(), OutputError> {
        let (Some(checkpoints), Some(files)) = (&mut self.checkpoints, &self.files) else { return Ok(()) };
        let seconds = self.clock.seconds() - self.load_began;
        self.clock.turn(Phase::Output);
        checkpoints.save(&self.claim.staging(), files.steps + 1, (checkpoint, seconds))?;
        self.clock.turn(Phase::Solve);
        Ok(())
    }

    fn refined(&mut self, _points: [usize; 2], change: f64) {
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.changes.push(change);
        }
    }

    fn load(&mut self, _load: Load) {
        self.load_began = self.clock.seconds();
        self.clock.turn(Phase::Solve);
    }

    fn stresses(&mut self, _step: &Step, _record: &StepRecord) {
        self.clock.turn(Phase::Stress);
    }

    fn clock(&self) -> Option<f64> {
        Some(self.clock.seconds())
    }

    fn step(&mut self, step: &Step, record: &StepRecord, fields: Option<&StressFields>) -> Result<(), OutputError> {
        self.clock.turn(Phase::Output);
        let (files, mut left) = (self.files.as_mut().expect(BEGUN), Files::default());
        if let Some(fields) = &mut files.fields {
            left.append(fields.add(step, &record.reading)?);
        }
        let cut = self.stress.as_ref().and_then(|request| request.cut.as_ref());
        match (fields, &mut files.stresses, cut) {
            (Some(fields), Some(stresses), _) => {
                let temperatures = || TemperatureField::of(step.finest());
                left.append(stresses.add(fields, &temperatures, &mut self.clock)?);
            }
            (Some(fields), None, Some(cut)) => {
                self.clock.turn(Phase::Stress);
                let section = |field: &StressField| field.section(&cut.line, &cut.depths(field.half_space()));
                files.sections = fields.each().map(section).collect();
                self.clock.turn(Phase::Output);
            }
            _ => {}
        }
        // The files that the line names are on the disk before it.
        files.fields.as_ref().map_or(Ok(()), ContactArchive::sync)?;
        files.stresses.as_ref().map_or(Ok(()), StressArchive::sync)?;
        let folder = self.claim.staging();
        disk::sync_folder(&folder).map_err(|error| OutputError::new(&folder, error))?;
        files.log.add(step.load, record, left)?;
        files.steps += 1;
        self.clock.turn(Phase::Setup);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Plan, Writer};
    use percoat_core::body::{HalfSpace, Material};
    use percoat_core::counterbody::{Indenters, Level, Shape};
    use percoat_core::lattice::Lattice;
    use percoat_core::load::Load;
    use percoat_core::problem::Problem;
    use percoat_core::run::{Sampling, StressRequest};

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
        assert!(recording.finish().unwrap().0.is_empty(), "no section was asked for");
        let files = ["case.toml", "contact.npz", "stress.npz", "steps.jsonl"].map(|name| claim.staging().join(name));
        assert!(files.iter().all(|file| file.is_file()));
        assert_eq!(std::fs::read_to_string(&files[3]).unwrap().lines().count(), 2);
    }
}
